#include "evaluation/record_differences.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <vector>

namespace gumcert::evaluation {
namespace {

using nlohmann::json;

std::vector<std::string> places(const char* stated, const char* evaluated) {
    std::vector<std::string> found;
    tell_differences(json::parse(stated), json::parse(evaluated),
                     [&found](const std::string& pointer, const json* one, const json* other) {
                         found.push_back(pointer + " " + (one == nullptr ? "-" : shown_value(*one)) + " " +
                                         (other == nullptr ? "-" : shown_value(*other)));
                     });
    return found;
}

TEST(RecordDifferences, EqualRecordsHaveNone) {
    EXPECT_TRUE(places(R"({"a": [1, {"b": "x"}]})", R"({"a": [1, {"b": "x"}]})").empty());
}

TEST(RecordDifferences, NumbersAgreeWithinTheLastDigits) {
    EXPECT_TRUE(places(R"({"a": 1.0})", R"({"a": 1.0000000009})").empty());
    EXPECT_EQ(places(R"({"a": 1.0})", R"({"a": 1.000000002})").size(), 1U);
    EXPECT_TRUE(places("[1e3, 1e-10]", "[1e3, 9e-10]").empty());  // nothing beside the largest of the list
    EXPECT_EQ(places("[1, 1e-10]", "[1, 9e-10]").size(), 1U);
    // of covariances, against the two standard uncertainties
    EXPECT_TRUE(places("[[4, 1e-13], [1e-13, 4]]", "[[4, 2e-13], [2e-13, 4]]").empty());
    EXPECT_EQ(places("[[4e-8, 1e-13], [1e-13, 4e-8]]", "[[4e-8, 2e-13], [2e-13, 4e-8]]").size(), 2U);
}

TEST(RecordDifferences, EveryPlaceIsToldInOrder) {
    EXPECT_EQ(places(R"({"a": 1, "b/c": "x", "d": [1, 2], "e": true})", R"({"a": 2, "b/c": "y", "d": [1], "f": null})"),
              (std::vector<std::string>{"/a 1 2", "/b~1c \"x\" \"y\"", "/d a list of 2 a list of 1", "/e true -",
                                        "/f - null"}));
}

TEST(RecordDifferences, ALongTextIsShortenedBetweenCharacters) {
    std::string text;
    for (int i = 0; i < 100; ++i) {
        text += "µ";
    }
    const std::string shown = shown_value(text);
    EXPECT_LT(shown.size(), 130U);
    EXPECT_TRUE(shown.ends_with("µ…"));
}

}  // namespace
}  // namespace gumcert::evaluation
