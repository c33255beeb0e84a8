#include "json/json_document.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace gumcert::json {
namespace {

JsonDocument document(const std::string& text) {
    JsonDocument read{"a.json", {}, {}, text};
    read.value = parse(
                     text, {}, [](const ParsingProblem& problem) { ADD_FAILURE() << problem.what; }, &read.places)
                     .value();
    return read;
}

TEST(JsonDocument, SaysWhereAValueStands) {
    const JsonDocument read = document("{\"a\": [1,\n 2], \"b\\u202e\": 3}");
    EXPECT_EQ(read.where(""), "a.json# (line 1, column 1)");
    EXPECT_EQ(read.where("/a/1"), "a.json#/a/1 (line 2, column 2)");
    EXPECT_EQ(read.where("/b\u202e"), "a.json#/b\\u{202E} (line 2, column 17)") << "nothing hidden in a message";
    EXPECT_EQ(read.where("/c"), "a.json#/c");
}

TEST(JsonDocument, KeepsNumbersAsTheyWereWritten) {
    const JsonDocument read = document("{\"ä\": 0.50, \"b\": [-1.0E+02,\n12], \"c\": \"x\"}");
    EXPECT_EQ(read.number_as_written("/ä"), "0.50");
    EXPECT_EQ(read.number_as_written("/b/0"), "-1.0E+02");
    EXPECT_EQ(read.number_as_written("/b/1"), "12");
    EXPECT_EQ(read.number_as_written("/c"), "");
    EXPECT_EQ(read.number_as_written("/d"), "");
}

TEST(JsonDocument, KnowsWithHowManyDecimalsNumbersAreWritten) {
    const JsonDocument read = document(
        R"({"a": 0.50, "b": [1.10, 2.0, 3], "c": [1, 2], "d": 1.5e-3, "e": [0.10, 1e-30], "f": [], "g": "1.0", "h": 7})");
    EXPECT_EQ(read.decimals_as_written("/a"), 2);
    EXPECT_EQ(read.decimals_as_written("/b"), 2);
    EXPECT_EQ(read.decimals_as_written("/c"), 0);
    EXPECT_EQ(read.decimals_as_written("/d"), 4);
    EXPECT_EQ(read.decimals_as_written("/e"), 30);
    for (const char* nothing : {"/f", "/g", "/h", "/i", ""}) {
        EXPECT_EQ(read.decimals_as_written(nothing), 0) << nothing;
    }
}

TEST(JsonDocument, DescribesValues) {
    const auto words = [](const char* text) { return described(nlohmann::json::parse(text)); };
    EXPECT_EQ(words("null"), "null");
    EXPECT_EQ(words("true"), "true");
    EXPECT_EQ(words("-7"), "-7");
    EXPECT_EQ(words("18446744073709551615"), "18446744073709551615");
    EXPECT_EQ(words("2.50"), "2.5");
    EXPECT_EQ(words(R"("a\nb")"), "\"a\\u{000A}b\"");
    EXPECT_EQ(words("[1]"), "an array");
    EXPECT_EQ(words("{}"), "an object");
    EXPECT_EQ(described(nlohmann::json(nlohmann::json::value_t::discarded)), "not a number");
}

}  // namespace
}  // namespace gumcert::json
