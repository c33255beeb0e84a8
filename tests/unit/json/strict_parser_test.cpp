#include "json/strict_parser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::json {
namespace {

using testing::HasSubstr;

constexpr ParserOptions k_with_comments{.comments = true};

std::vector<ParsingProblem> faults_of(std::string_view text, const ParserOptions& options = k_with_comments) {
    std::vector<ParsingProblem> found;
    const bool read =
        parse(text, options, [&](ParsingProblem problem) { found.push_back(std::move(problem)); }).has_value();
    EXPECT_TRUE(read || !found.empty()) << "refused without a reason";
    return found;
}

struct Row {
    std::string text;
    Fault fault;
    text::Place place;
    std::string message;  ///< part of it
};

void expect_row(const Row& row, const ParserOptions& options = k_with_comments) {
    SCOPED_TRACE(row.text.substr(0, 60));
    const auto found = faults_of(row.text, options);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].fault, row.fault);
    EXPECT_EQ(found[0].place, row.place);
    EXPECT_THAT(found[0].what + " — " + found[0].rule + " — " + found[0].action, HasSubstr(row.message));
    EXPECT_FALSE(found[0].rule.empty());
    EXPECT_FALSE(found[0].action.empty());
}

TEST(StrictParser, AgreesWithNlohmann) {
    for (
        const std::string text :
        {R"({"a": [1, -0, 0.1, 1e22, 1.7976931348623157e308, 4.9e-320, -12E+3, 123456789012345678e-5], "b": {"c": "é\u00e9\ud83d\ude00\n\"\\\/"}})",
         "[]", "{}", "\"\"", "17", " [ true , false , null , { } ] ",
         "[9007199254740992, -9007199254740992, 1000000000000000000000]"}) {
        EXPECT_EQ(parse_faultless(text, {}), nlohmann::json::parse(text)) << text;
    }
    EXPECT_TRUE(parse_faultless("[-0]", {})->at(0).is_number_integer());
    EXPECT_TRUE(std::signbit(parse_faultless("[-0.0]", {})->at(0).get<double>()));
}

TEST(StrictParser, TellsWhereValuesStand) {
    Places places;
    const auto value = parse(
        "// a\r\n{\"ä\": 1,\n \"x/y~\": [true, {}]}", k_with_comments, [](const ParsingProblem&) {}, &places);
    ASSERT_TRUE(value);
    const Places expected{{"", {{2, 1}, 6}},
                          {"/ä", {{2, 7}, 13}},
                          {"/x~1y~0", {{3, 10}, 25}},
                          {"/x~1y~0/0", {{3, 11}, 26}},
                          {"/x~1y~0/1", {{3, 17}, 32}}};
    EXPECT_EQ(places, expected);
}

TEST(StrictParser, AllowsLibertiesOnlyWhereTheyAreAskedFor) {
    EXPECT_EQ(parse_faultless("\xEF\xBB\xBF[1]", {.byte_order_mark = true}), nlohmann::json::parse("[1]"));
    EXPECT_TRUE(parse_faultless("[1] // one", {.comments = true}));
    const nlohmann::json whole = *parse_faultless("[9007199254740993, -9223372036854775808, 18446744073709551615, 1e3]",
                                                  {.long_integers = true});
    EXPECT_EQ(whole[0].get<std::int64_t>(), 9007199254740993);
    EXPECT_EQ(whole[1].get<std::int64_t>(), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(whole[2].get<std::uint64_t>(), 18446744073709551615U);
    EXPECT_TRUE(whole[3].is_number_float());
    EXPECT_EQ(parse_faultless("18446744073709551616", {.long_integers = true})->get<double>(), 18446744073709551616.0);

    expect_row({"\xEF\xBB\xBF[1]", Fault::syntax, {1, 1}, "where a value is expected"}, {});
    expect_row({"[1] // one", Fault::comment, {1, 5}, "no comments are allowed"}, {});
    expect_row({"[9007199254740993]", Fault::inexact_integer, {1, 2}, "9007199254740993"}, {});
}

TEST(StrictParser, ReportsWhatIsNoJsonText) {
    using namespace std::string_literals;
    expect_row({"", Fault::empty, {1, 1}, "the file is empty"});
    expect_row({" // only a comment\n", Fault::empty, {2, 1}, "the file is empty"});
    expect_row({"{} {}", Fault::trailing_text, {1, 4}, "text after the end of the document"});
    expect_row({"{}\n]", Fault::trailing_text, {2, 1}, "\"]\""});
    expect_row({"{ /* a */ }", Fault::comment, {1, 3}, "only // comments"});
    expect_row({"# a\n{}", Fault::comment, {1, 1}, "only // comments"});
    // Bytes that nobody looked at before.
    expect_row({"[\"\xC0\xAF\"]", Fault::not_utf8, {1, 3}, "byte 0xC0"});
    expect_row({"[\"\xED\xA0\x80\"]", Fault::not_utf8, {1, 3}, "byte 0xED"});
    expect_row({"[\"\xE2\x82", Fault::not_utf8, {1, 3}, "byte 0xE2"});
    expect_row({"// \xFF\n[]", Fault::not_utf8, {1, 4}, "byte 0xFF"});
    expect_row({"[\xC3\xA4]", Fault::syntax, {1, 2}, "where a value is expected"});
    expect_row({"[\"\0\"]"s, Fault::syntax, {1, 3}, "control characters"});
    expect_row({"[\0]"s, Fault::syntax, {1, 2}, "where a value is expected"});
    expect_row({"// \0\n[]"s, Fault::nul_character, {1, 4}, "a NUL character"});
    expect_row({"[]\0"s, Fault::trailing_text, {1, 3}, "text after the end"});
}

TEST(StrictParser, ReportsSyntaxWithPlaceAndAdvice) {
    expect_row({"{\"a\": 1,}", Fault::syntax, {1, 9}, "remove the comma"});
    expect_row({"[1,]", Fault::syntax, {1, 4}, "remove the comma"});
    expect_row({"[1 2]", Fault::syntax, {1, 4}, "a comma"});
    expect_row({"{\"a\" 1}", Fault::syntax, {1, 6}, "a colon"});
    expect_row({"{\"a\": 1,5}", Fault::syntax, {1, 9}, "decimal point"});
    expect_row({"{'a': 1}", Fault::syntax, {1, 2}, "a key in double quotes"});
    expect_row({"{\"a\": 'b'}", Fault::syntax, {1, 7}, "double quotes"});
    expect_row({"{\"a\": 1", Fault::syntax, {1, 8}, "the file ends"});
    expect_row({"[\"abc", Fault::syntax, {1, 2}, "closing double quote"});
    expect_row({"[\"a\nb\"]", Fault::syntax, {1, 4}, "close the double quote in the same line"});
    expect_row({"[\"a\\qb\"]", Fault::syntax, {1, 4}, "an escape of JSON"});
    expect_row({"[\"\\u12g4\"]", Fault::syntax, {1, 5}, "four hexadecimal digits"});
    expect_row({"[\"\\ud800\"]", Fault::not_utf8, {1, 3}, "half of a surrogate pair"});
    expect_row({"[\"\\u0000\"]", Fault::nul_character, {1, 3}, "NUL"});
    expect_row({"[01]", Fault::syntax, {1, 2}, "leading zero"});
    expect_row({"[+1]", Fault::syntax, {1, 2}, "plus sign"});
    expect_row({"[.5]", Fault::syntax, {1, 2}, "a digit before the point"});
    expect_row({"[1.]", Fault::syntax, {1, 4}, "a digit after the decimal point"});
    expect_row({"[1e]", Fault::syntax, {1, 4}, "a digit of the exponent"});
    expect_row({"[-]", Fault::syntax, {1, 3}, "a digit"});
    expect_row({"[0x10]", Fault::syntax, {1, 3}, "a comma"});
    expect_row({"[truely]", Fault::syntax, {1, 2}, "a value"});
}

TEST(StrictParser, ReportsNumbersThatDoublesCannotHold) {
    expect_row({"{\"a\": 1e999}", Fault::number_range, {1, 7}, "1e999"});
    expect_row({"{\"a\": -1e999}", Fault::number_range, {1, 7}, "/a"});
    expect_row({"{\"a\": 1e-999}", Fault::number_range, {1, 7}, "1e-999"});
    expect_row({"[9007199254740993]", Fault::inexact_integer, {1, 2}, "9007199254740993"});
    expect_row({"[123456789012345678901]", Fault::inexact_integer, {1, 2}, "exact value in double precision"});
    expect_row({"[NaN]", Fault::not_finite, {1, 2}, "NaN at /0"});
    expect_row({"[-Infinity]", Fault::not_finite, {1, 2}, "must be finite"});
    expect_row({"{\"u\": Infinity}", Fault::not_finite, {1, 7}, "Infinity at /u"});
}

TEST(StrictParser, ReportsDuplicateKeysAndReadsOn) {
    const std::string text = "{\"a\": 1,\n\"b\": {\"c\": 1, \"c\": 2},\n\"a\": 1e999}";
    const auto found = faults_of(text);
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].fault, Fault::duplicate_key);
    EXPECT_EQ(found[0].pointer, "/b/c");
    EXPECT_EQ(found[0].place, (text::Place{2, 15}));
    EXPECT_EQ(found[0].offset, 23U);
    EXPECT_EQ(found[0].what, "the key \"c\" occurs twice");
    EXPECT_EQ(found[1].pointer, "/a");
    EXPECT_EQ(found[2].fault, Fault::number_range);
    const auto value = parse(text, {}, [](const ParsingProblem&) {});
    ASSERT_TRUE(value);
    EXPECT_EQ(*value, nlohmann::json::parse(R"({"a": 1, "b": {"c": 1}})")) << "the first one is kept";
    EXPECT_FALSE(parse_faultless(text, {}));
    // The same key written with an escape is the same key.
    expect_row({"{\"a\": 1, \"\\u0061\": 2}", Fault::duplicate_key, {1, 10}, "occurs twice"});
}

TEST(StrictParser, MarksNumbersThatItRefused) {
    const auto value = parse("[1, NaN, -Infinity, 1e999]", {}, [](const ParsingProblem&) {});
    ASSERT_TRUE(value);
    EXPECT_EQ(value->at(0), 1);
    for (const std::size_t i : {1U, 2U, 3U}) {
        EXPECT_TRUE(value->at(i).is_discarded()) << i;
    }
}

TEST(StrictParser, LimitsDepthStringsAndValues) {
    const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
    EXPECT_TRUE(faults_of(nested(64)).empty());
    expect_row({nested(65), Fault::depth, {1, 65}, "nested more than 64 deep"});
    expect_row({std::string(1'000'000, '['), Fault::depth, {1, 65}, "nested more than 64 deep"});
    EXPECT_EQ(faults_of(nested(65))[0].pointer.size(), 128U) << "64 tokens of the value that is too deep";
    std::string objects;
    for (int i = 0; i < 100'000; ++i) {
        objects += "{\"a\":";
    }
    expect_row({objects, Fault::depth, {1, 321}, "nested more than 64 deep"});

    const std::string longest(std::size_t{1} << 20U, 'a');
    EXPECT_TRUE(faults_of("[\"" + longest + "\"]").empty());
    expect_row({"[\"" + longest + "a\"]", Fault::string_too_long, {1, 2}, "1048576 bytes"});
    expect_row({"{\"" + longest + "a\": 1}", Fault::string_too_long, {1, 2}, "a key of more than"});

    const ParserOptions limits{.values = 3};
    EXPECT_TRUE(faults_of("[1, 2]", limits).empty());
    expect_row({"[1, 2, 3]", Fault::too_many_values, {1, 8}, "more than 3 values"}, limits);
}

// Pins: the table of places copied a key of 1 MiB for each of the values below it.
TEST(StrictParser, KeepsTheTableOfPlacesSmall) {
    std::string text = "{\"" + std::string(1'000'000, 'k') + "\": [0";
    for (int i = 0; i < 100'000; ++i) {
        text += ",1";
    }
    text += "], \"after\": 1}";
    Places places;
    const auto value = parse(
        text, {}, [](const ParsingProblem&) {}, &places);
    ASSERT_TRUE(value);
    EXPECT_LT(places.size(), 200U);
    EXPECT_EQ(value->size(), 2U);
}

}  // namespace
}  // namespace gumcert::json
