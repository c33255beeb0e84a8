#include "jobs/json_object.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "jobs/file_source.h"
#include "text/visible_text.h"

namespace gumcert::jobs {
namespace {

using testing::HasSubstr;

std::vector<gum::Diagnostic> refusals(std::string_view text) {
    ProblemList problems("job.json");
    const bool read = read_json_document(text, problems).has_value();
    EXPECT_TRUE(read || problems.refusals() > 0) << "refused without a reason";
    return problems.refused();
}

struct Row {
    std::string text;
    InputCode code;
    std::string where;
    std::string message;  ///< part of it
};

void expect_row(const Row& row) {
    SCOPED_TRACE(row.text.substr(0, 60));
    const auto found = refusals(row.text);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, row.code.code);
    EXPECT_EQ(found[0].where, row.where);
    EXPECT_THAT(gum::message(found[0]), HasSubstr(row.message));
    EXPECT_FALSE(found[0].rule.empty());
    EXPECT_FALSE(found[0].action.empty());
}

TEST(JsonDocument, ReadsValuesAndPlaces) {
    const JsonDocument document = parse_json_document(
        "\xEF\xBB\xBF// a comment\r\n{ \"fixture\": {\r\n  \"ä\": 1, \"coordinates\": [\"f.csv\", "
        "-2.5e-1]},\r\n\"x/y~\": null, \"b\": true }  // the end",
        "job.json");
    EXPECT_EQ(document.value.at("fixture").at("coordinates").at(0), "f.csv");
    EXPECT_EQ(document.value.at("fixture").at("coordinates").at(1), -0.25);
    EXPECT_EQ(document.where("/fixture/coordinates"), "job.json#/fixture/coordinates (line 3, column 26)");
    EXPECT_EQ(document.where("/fixture/coordinates/1"), "job.json#/fixture/coordinates/1 (line 3, column 36)");
    EXPECT_EQ(document.where(""), "job.json# (line 2, column 1)");
    EXPECT_EQ(document.where(child_pointer("", "x/y~")), "job.json#/x~1y~0 (line 4, column 9)");
    EXPECT_EQ(document.where("/nowhere"), "job.json#/nowhere");
}

TEST(JsonDocument, RefusesWhatIsNotStrictText) {
    using namespace std::string_literals;
    expect_row({"", k_empty_file, "job.json", "the file is empty"});
    expect_row({" // only a comment\n", k_empty_file, "job.json", "the file is empty"});
    expect_row({"{\n\"a\": \"\xE4\"}", k_not_utf8, "job.json:2:7", "byte 0xE4 at byte offset 8 is not UTF-8"});
    expect_row({"\xEF\xBB\xBF{\"\xC0\xAF\": 1}", k_not_utf8, "job.json:1:3", "byte offset 5"});
    expect_row({"[\"\xED\xA0\x80\"]", k_not_utf8, "job.json:1:3", "byte 0xED"});
    expect_row({"\xFF\xFE{\0}\0"s, k_utf16, "job.json:1:1", "UTF-16"});
    expect_row({"{\0}\0"s, k_utf16, "job.json:1:1", "UTF-16"});
    expect_row({"{}\n \0"s, k_nul_character, "job.json:2:2", "byte offset 4"});
    expect_row({"{\r\"a\": 1}", k_lone_carriage_return, "job.json:1:2", "carriage return without a line feed"});
}

TEST(JsonDocument, GivesEachFaultOfTheTextItsCode) {
    expect_row({"{\"a\": 1,}", k_json_syntax, "job.json:1:9", "remove the comma"});
    expect_row({"{} {}", k_json_trailing_text, "job.json:1:4", "text after the end of the document"});
    expect_row({"{ /* a */ }", k_json_comment, "job.json:1:3", "only // comments"});
    expect_row({"[\"\\ud800\"]", k_not_utf8, "job.json:1:3", "half of a surrogate pair"});
    expect_row({"[\"\\u0000\"]", k_nul_character, "job.json:1:3", "NUL"});
    expect_row({std::string(65, '['), k_json_depth, "job.json:1:65",
                "nested more than 64 deep — the depth is at most 64 — check that the file is a job"});
    expect_row({"[\"" + std::string((std::size_t{1} << 20U) + 1, 'a') + "\"]", k_json_string_too_long, "job.json:1:2",
                "1048576 bytes"});
    std::string many = "[0";
    for (int i = 0; i < 1'999'999; ++i) {
        many += ",0";
    }
    expect_row({many + "]", k_json_too_many_values, "job.json:1:4000000", "move tables of numbers to CSV files"});
    expect_row({"{\"a\": -1e999}", k_json_number_range, "job.json:1:7", "the number \"-1e999\" at /a"});
    expect_row({"[9007199254740993]", k_json_inexact_integer, "job.json:1:2", "exact value in double precision"});
    expect_row({"{\"u\": Infinity}", k_json_not_finite, "job.json:1:7", "Infinity at /u"});
}

TEST(JsonDocument, RefusesTheFileThatIsTooLarge) {
    const std::string text(k_file_limit + 1, ' ');
    const auto found = refusals(text);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].code, k_file_too_large.code);
    EXPECT_THAT(gum::message(found[0]), HasSubstr("64 MiB"));
}

TEST(JsonDocument, RefusesDuplicateKeysAndReadsOn) {
    const auto found = refusals("{\"a\": 1,\n\"b\": {\"c\": 1, \"c\": 2},\n\"a\": 1e999}");
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].code, k_json_duplicate_key.code);
    EXPECT_EQ(found[0].where, "job.json#/b/c (line 2, column 15)");
    EXPECT_THAT(found[0].what, HasSubstr("\"c\" occurs twice, first in line 2"));
    EXPECT_EQ(found[1].where, "job.json#/a (line 3, column 1)");
    EXPECT_EQ(found[2].code, k_json_number_range.code);
    // The same key written with an escape is the same key.
    expect_row({"{\"a\": 1, \"\\u0061\": 2}", k_json_duplicate_key, "job.json#/a (line 1, column 10)", "occurs twice"});
}

TEST(JsonDocument, ThrowsEveryProblem) {
    try {
        (void)parse_json_document("{\"a\": NaN, \"b\": 1e999}", "x.json");
        FAIL() << "accepted";
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().size(), 2U);
    }
}

TEST(JsonDocument, ClosesALongListOfProblems) {
    std::string text = "[NaN";
    for (int i = 0; i < 300; ++i) {
        text += ",NaN";
    }
    const auto found = refusals(text + "]");
    ASSERT_EQ(found.size(), 201U);
    EXPECT_EQ(found.back().what, "and 101 more");
}

enum class Colour { red, green };
constexpr std::array<std::pair<std::string_view, Colour>, 2> k_colours{
    {{"red", Colour::red}, {"green", Colour::green}}};
constexpr std::array<std::string_view, 9> k_keys{"name", "count", "u_constant_um", "flag", "colour",
                                                 "sub",  "list",  "free",          "xyz"};
constexpr std::array<std::string_view, 1> k_sub_keys{"inner"};

TEST(JsonObject, ReadsTypedValues) {
    const JsonDocument document = parse_json_document(
        R"({"name": "n", "count": 3e0, "u_constant_um": 0.5, "flag": true, "colour": "green", "sub": {"inner": 1}, "list": [], "free": "a\nb", "xyz": [1, 2, 3]})",
        "job.json");
    ProblemList problems("job.json");
    const auto object = JsonObject::root(document, k_keys, problems);
    ASSERT_TRUE(object);
    EXPECT_EQ(object->required_name("name"), "n");
    EXPECT_EQ(object->required_integer("count"), 3);
    EXPECT_EQ(object->required_number("u_constant_um", above_zero("µm")), 0.5);
    EXPECT_EQ(object->optional_boolean("flag"), true);
    EXPECT_EQ(object->required_choice<Colour>("colour", k_colours), Colour::green);
    const auto sub = object->required_object("sub", k_sub_keys);
    ASSERT_TRUE(sub);
    EXPECT_EQ(sub->pointer("inner"), "/sub/inner");
    EXPECT_EQ(sub->required_integer("inner"), 1);
    EXPECT_NE(object->required_array("list"), nullptr);
    EXPECT_EQ(object->required_string("free"), "a\nb");
    EXPECT_EQ(object->required_numbers("xyz", 3), (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(problems.refusals(), 0U) << gum::message(problems.refused().at(0));
}

TEST(JsonObject, CollectsAllProblemsOfADocument) {
    const JsonDocument document = parse_json_document(
        R"({"u_constant": 1, "name": "a\u202eb", "count": 2.5, "flag": "yes", "colour": "gren", "sub": [], "free": 1, "xyz": [1, "2", 3]})",
        "job.json");
    ProblemList problems("job.json");
    const auto object = JsonObject::root(document, k_keys, problems);
    ASSERT_TRUE(object);
    EXPECT_FALSE(object->required_name("name"));
    EXPECT_FALSE(object->required_integer("count"));
    EXPECT_FALSE(object->required_number("u_constant_um", above_zero("µm")));
    EXPECT_FALSE(object->optional_boolean("flag"));
    EXPECT_FALSE(object->optional_choice<Colour>("colour", k_colours));
    EXPECT_FALSE(object->optional_object("sub", k_sub_keys));
    EXPECT_FALSE(object->optional_string("free"));
    EXPECT_FALSE(object->required_numbers("xyz", 3));
    EXPECT_FALSE(object->required_array("list"));
    const auto found = problems.refused();
    const std::vector<std::pair<InputCode, std::string>> expected{
        {k_unknown_key, "did you mean \"u_constant_um\"?"},
        {k_text_not_allowed, "\"a\\u{202E}b\" has the hidden or control character U+202E"},
        {k_not_an_integer, "2.5"},
        {k_missing_key, "the key \"u_constant_um\" is missing"},
        {k_wrong_type, "\"yes\" — must be true or false"},
        {k_unknown_choice, "must be red or green — did you mean \"green\"?"},
        {k_wrong_type, "an array — must be an object"},
        {k_wrong_type, "job.json#/free (line 1, column 105) — 1 — must be a string"},
        {k_wrong_type, "#/xyz/1 (line 1, column 119) — \"2\" — must be a number — write the number without quotes"},
        {k_missing_key, "\"list\""}};
    ASSERT_EQ(found.size(), expected.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].code, expected[i].first.code) << i;
        EXPECT_THAT(gum::message(found[i]), HasSubstr(expected[i].second));
    }
}

TEST(JsonObject, ChecksRanges) {
    const JsonDocument document =
        parse_json_document(R"({"u_constant_um": -2e-06, "count": 5000000000, "xyz": [1, 2]})", "job.json");
    ProblemList problems("job.json");
    const auto object = JsonObject::root(document, k_keys, problems);
    ASSERT_TRUE(object);
    EXPECT_FALSE(object->required_number("u_constant_um", above_zero("µm")));
    EXPECT_FALSE(object->required_integer("count", between(1.0, 2147483647.0, "")));
    EXPECT_FALSE(object->required_numbers("xyz", 3));
    const auto found = problems.refused();
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(
        gum::message(found[0]),
        "job.json#/u_constant_um (line 1, column 19) — -2e-06 µm — must be greater than 0 µm — correct the value, "
        "and check its unit");
    EXPECT_EQ(found[1].code, k_number_out_of_range.code);
    EXPECT_EQ(found[2].code, k_wrong_size.code);
}

TEST(JsonObject, RefusesADocumentThatIsNoObject) {
    const JsonDocument document = parse_json_document("[1]", "job.json");
    ProblemList problems("job.json");
    EXPECT_FALSE(JsonObject::root(document, k_keys, problems));
    ASSERT_EQ(problems.refusals(), 1U);
    EXPECT_EQ(problems.refused()[0].code, k_wrong_type.code);
}

// Pins: a refused number was null for the readers, which called it a second problem.
TEST(JsonObject, SaysNothingMoreAboutANumberThatWasRefused) {
    for (const std::string text : {R"({"u_constant_um": NaN, "xyz": [1, 1e999, 2], "name": -Infinity})", "NaN"}) {
        ProblemList problems("job.json");
        const auto document = read_json_document(text, problems);
        ASSERT_TRUE(document);
        const std::size_t refused = problems.refusals();
        EXPECT_GT(refused, 0U);
        if (const auto object = JsonObject::root(*document, k_keys, problems)) {
            EXPECT_FALSE(object->required_number("u_constant_um"));
            EXPECT_FALSE(object->required_numbers("xyz", 3));
            EXPECT_FALSE(object->required_name("name"));
        }
        EXPECT_EQ(problems.refusals(), refused);
    }
}

TEST(JsonObject, SaysWhatToDoInPlaceOfSectionsOfAnotherKind) {
    const auto told = [](const char* text) {
        ProblemList problems("job.json");
        const std::optional<JsonDocument> document = read_json_document(text, problems);
        (void)JsonObject::root(*document, k_keys, problems);
        std::vector<std::string> codes;
        for (const gum::Diagnostic& one : problems.refused()) {
            codes.push_back(one.code);
        }
        return codes;
    };
    EXPECT_THAT(told(R"({"kind": "rotary_table", "sections": {}})"),
                testing::ElementsAre(k_unknown_key.code, k_sections_of_other_kind.code))
        << "this table has no \"kind\" itself";
    EXPECT_THAT(told(R"({"sections": {}})"), testing::ElementsAre(k_unknown_key.code)) << "no job";
}

TEST(InputCodes, AreUniqueAndWellFormed) {
    std::string_view last;
    for (const InputCode& entry : k_input_codes) {
        EXPECT_TRUE(entry.code.starts_with("GC-INPUT-") || entry.code.starts_with("GC-STORAGE-") ||
                    entry.code.starts_with("GC-WARN-"))
            << entry.code;
        EXPECT_THAT(std::string(entry.code), testing::ContainsRegex("-[0-9][0-9][0-9][0-9]$"));
        EXPECT_LT(last, entry.code);
        EXPECT_FALSE(entry.meaning.empty());
        last = entry.code;
    }
}

TEST(InputText, ShowsHiddenCharactersAndShortensTexts) {
    EXPECT_EQ(text::visible("a\tb\n"), "a\\u{0009}b\\u{000A}");
    EXPECT_EQ(text::visible("\xE2\x80\xAE"), "\\u{202E}");
    EXPECT_EQ(text::visible("\xFF"), "\\x{FF}");
    EXPECT_EQ(text::visible(std::string(100, 'x')), std::string(80, 'x') + "…");
    EXPECT_FALSE(name_objection("Größe 1 – 溫度"));
    EXPECT_TRUE(name_objection(""));
    EXPECT_TRUE(name_objection(" a"));
    EXPECT_TRUE(name_objection("a\xC2\xA0"));
    EXPECT_TRUE(name_objection("a\x7F"));
    EXPECT_FALSE(name_objection(std::string(256, 'a')));
    EXPECT_TRUE(name_objection(std::string(257, 'a')));
}

TEST(JsonDocument, GivesNumbersAsTheyAreWritten) {
    const JsonDocument document =
        parse_json_document("{\n  // Größe\n  \"a\": [0.50, -1e-3 , 7],\n\t\"µ\": {\"b\": \"0.1\"}}", "job.json");
    EXPECT_EQ(document.number_as_written("/a/0"), "0.50");
    EXPECT_EQ(document.number_as_written("/a/1"), "-1e-3");
    EXPECT_EQ(document.number_as_written("/a/2"), "7");
    EXPECT_EQ(document.number_as_written("/µ/b"), "") << "a text";
    EXPECT_EQ(document.number_as_written("/a/3"), "") << "nothing there";
}

TEST(InputText, SuggestsOnlyNearWords) {
    constexpr std::array<std::string_view, 3> words{"datum", "method", "u_constant_um"};
    EXPECT_EQ(nearest_word("Datum", words), "datum");
    EXPECT_EQ(nearest_word("metod", words), "method");
    EXPECT_EQ(nearest_word("u_constant", words), "u_constant_um");
    EXPECT_EQ(nearest_word("colour", words), std::nullopt);
}

TEST(InputText, WordsTheRulesOfRanges) {
    EXPECT_EQ(above_zero("µm").rule(), "must be greater than 0 µm");
    EXPECT_EQ(between(-50.0, 100.0, "°C").rule(), "must be at least -50 °C and at most 100 °C");
    EXPECT_EQ(NumberRange{}.rule(), "must be finite");
    EXPECT_FALSE(NumberRange{}.contains(std::numeric_limits<double>::quiet_NaN()));
    EXPECT_FALSE(NumberRange{}.contains(std::numeric_limits<double>::infinity()));
}

}  // namespace
}  // namespace gumcert::jobs
