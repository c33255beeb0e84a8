#include "evaluation/unprintable_characters.h"

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

namespace gumcert::evaluation {
namespace {

std::vector<std::string> asked;

/// As if the fonts lacked everything above U+FFFF.
std::vector<std::string> lacking(const std::vector<std::string>& characters) {
    asked = characters;
    std::vector<std::string> lacking;
    for (const std::string& character : characters) {
        if (character.size() == 4) {
            lacking.push_back(character);
        }
    }
    return lacking;
}

std::vector<gum::Diagnostic> warnings(const std::map<std::string, std::string>& contents) {
    const jobs::MemoryFileSource files(contents);
    std::vector<std::string> names{"job.json"};
    for (const auto& [name, bytes] : contents) {
        if (name != "job.json") {
            names.push_back(name);
        }
    }
    return unprintable_characters({files, names}, lacking);
}

TEST(UnprintableCharacters, AreNamedWithTheirFirstPlace) {
    const auto found = warnings({{"job.json",
                                  "{ // \U0001F4A9\n \"title\": \"Gauge \U0001F600 \u03A9\",\n"
                                  " \"notes\": \"\U0001F4A9\", \"inputs\": {\"a\": [1, \"\\uD83D\\uDE01\"]}}"},
                                 {"points.csv", "a,b\n1,\U0001F600\n2,\u00B5\U0001F602\n"},
                                 {"logo.svg", "\U0001F4A9"}});
    ASSERT_EQ(found.size(), 3U);
    for (const gum::Diagnostic& one : found) {
        EXPECT_EQ(one.code, "GC-REPORT-0045");
        EXPECT_EQ(one.severity, gum::Severity::warning);
    }
    std::map<std::string, std::string> places;
    for (const gum::Diagnostic& one : found) {
        places[one.what.substr(one.what.find("(U+"), 10)] = one.where;
    }
    EXPECT_EQ(places["(U+1F600) "], "job.json#/title (line 2, column 11)");
    EXPECT_EQ(places["(U+1F601) "].substr(0, 20), "job.json#/inputs/a/1") << "an escaped one";
    EXPECT_EQ(places["(U+1F602) "], "points.csv:3:4");
    EXPECT_EQ(asked.size(), 4U) << "with the omega, each once; neither comments, notes, pictures nor Latin letters";
}

TEST(UnprintableCharacters, NobodyIsToldOfWhatCanBePrinted) {
    EXPECT_TRUE(warnings({{"job.json", "{\"title\": \"Endma\u00DF \u2013 \u9F8D\"}"}}).empty());
    EXPECT_EQ(asked, (std::vector<std::string>{"\u2013", "\u9F8D"}));
}

}  // namespace
}  // namespace gumcert::evaluation
