#include "reports/message_explanation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>

#include "tests/support/file_content.h"

namespace gumcert::reports {
namespace {

using testing::HasSubstr;

constexpr const char* k_small_register = R"({
  "finding": "About findings.",
  "outcomes": {"refused": {"severity": "error", "text": "Refused."}, "note": {"severity": "note", "text": "Told.", "certificate": "Issued."},
               "remark": {"severity": "note", "text": "Said."}},
  "families": {"GC-ONE": {"title": "One", "text": "The first."}, "GC-TWO": {"title": "Two", "text": "The second."}},
  "codes": {
    "GC-ONE-0001": {"outcome": ["refused", "note", "remark"], "meaning": "Short. Long.", "cause": "A cause.",
                    "remedy": "A remedy.", "rules": ["first", "second"],
                    "finding": {"id": "A01", "severity": "major"}, "formerly": "Something else."},
    "GC-ONE-0002": {"outcome": ["refused"], "meaning": "One sentence.", "cause": "C.", "remedy": "R.", "rules": ["r"]},
    "GC-ONE-0004": {"outcome": ["note"], "meaning": "One more.", "cause": "C.", "remedy": "R."},
    "GC-ONE-0003": {"retired": "It was."}}})";

MessageRegister small_register() {
    return {k_small_register, "messages.json"};
}

TEST(MessageExplanation, SaysAllOfACode) {
    EXPECT_EQ(explanation_of_code(small_register(), "GC-ONE-0001"),
              "GC-ONE-0001: error or note\n\n"
              "  Meaning      Short. Long.\n"
              "  Usual cause  A cause.\n"
              "  What to do   A remedy.\n"
              "  Rules        “first”\n"
              "               “second”\n"
              "  Result       As error: Refused.\n"
              "               As note: Told.\n"
              "               As note: Said.\n"
              "  Certificate  Finding A01: major. About findings.\n"
              "  Formerly     Something else.\n");
    EXPECT_EQ(explanation_of_code(small_register(), "GC-ONE-0002"),
              "GC-ONE-0002: error\n\n"
              "  Meaning      One sentence.\n"
              "  Usual cause  C.\n"
              "  What to do   R.\n"
              "  Rule         “r”\n"
              "  Result       Refused.\n");
}

TEST(MessageExplanation, SaysOfACertificateWhereNoFindingDoes) {
    EXPECT_THAT(explanation_of_code(small_register(), "GC-ONE-0004"), HasSubstr("  Result       Told. Issued.\n"));
    EXPECT_THAT(explanation_of_code(small_register(), "GC-ONE-0001"), testing::Not(HasSubstr("Issued.")));
}

TEST(MessageExplanation, SaysThatACodeIsRetired) {
    EXPECT_EQ(explanation_of_code(small_register(), "GC-ONE-0003"),
              "GC-ONE-0003: no longer in use\n\n"
              "  Was          It was.\n");
}

TEST(MessageExplanation, ListsCodesAndFamilies) {
    EXPECT_EQ(list_of_codes(small_register(), "GC-ONE"),
              "GC-ONE: One\n\nThe first.\n\n"
              "  GC-ONE-0001  Short.\n"
              "  GC-ONE-0002  One sentence.\n"
              "  GC-ONE-0004  One more.\n");
    const std::string families = list_of_families(small_register());
    EXPECT_THAT(families, HasSubstr("  GC-ONE           3  One\n"));
    EXPECT_THAT(families, HasSubstr("  GC-TWO           0  Two\n"));
}

TEST(MessageExplanation, BreaksLinesByCharactersAndNotByBytes) {
    EXPECT_EQ(in_lines("aa bb cc", 5, 2), "aa bb\n  cc");
    EXPECT_EQ(in_lines("aa bb cc", 4, 0), "aa\nbb\ncc");
    EXPECT_EQ(in_lines("µµ µµ µµ", 5, 2), "µµ µµ\n  µµ");
    EXPECT_EQ(in_lines("longer", 3, 2), "longer");
    EXPECT_EQ(in_lines("", 3, 2), "");
}

TEST(MessageExplanation, FitsOnATerminalForEveryCode) {
    constexpr std::ptrdiff_t k_widest = 100;
    const MessageRegister all(test::file_content(GUMCERT_SOURCE_DIR "/templates/messages.json"), "messages.json");
    std::string text = list_of_families(all);
    for (const auto& [family, described] : all.families()) {
        text += list_of_codes(all, family);
    }
    for (const auto& [code, entry] : all.codes()) {
        text += explanation_of_code(all, code);
    }
    std::istringstream lines(text);
    for (std::string line; std::getline(lines, line);) {
        const auto characters = std::count_if(line.begin(), line.end(),
                                              [](char c) { return (static_cast<unsigned char>(c) & 0xc0U) != 0x80U; });
        EXPECT_LE(characters, k_widest) << line;
    }
}

}  // namespace
}  // namespace gumcert::reports
