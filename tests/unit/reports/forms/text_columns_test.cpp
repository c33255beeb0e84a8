#include "reports/forms/text_columns.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

using ::testing::ElementsAre;

TEST(TextColumns, CountsColumnsOfATerminal) {
    EXPECT_EQ(width(""), 0U);
    EXPECT_EQ(width("µm"), 2U);
    EXPECT_EQ(width("校正"), 4U);
    EXPECT_EQ(width("e\u0301"), 1U);
    EXPECT_EQ(glyphs("e\u0301x").size(), 2U);
}

TEST(TextColumns, BreaksAtBlanksAndInsideWordsOnlyWhereItMust) {
    EXPECT_THAT(wrapped("one two three", 8), ElementsAre("one two", "three"));
    EXPECT_THAT(wrapped("abcdefgh", 3), ElementsAre("abc", "def", "gh"));
    EXPECT_THAT(wrapped("校正，報告", 6), ElementsAre("校正，", "報告"));
    EXPECT_THAT(wrapped("", 8), ElementsAre(""));
}

TEST(TextColumns, PadsToAWidth) {
    EXPECT_EQ(padded("校", 4, false), "校  ");
    EXPECT_EQ(padded("1.2", 5, true), "  1.2");
    EXPECT_EQ(padded("long", 2, true), "long");
}

}  // namespace
}  // namespace gumcert::reports
