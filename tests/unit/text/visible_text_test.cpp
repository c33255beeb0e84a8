#include "text/visible_text.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::text {
namespace {

TEST(VisibleText, ShowsWhatIsHidden) {
    EXPECT_EQ(visible("length µ″"), "length µ″");
    EXPECT_EQ(visible("a\u202Eb"), "a\\u{202E}b");
    EXPECT_EQ(visible("a\nb\x01"), "a\\u{000A}b\\u{0001}");
    EXPECT_EQ(visible("a\xFF"), "a\\x{FF}");
    EXPECT_EQ(visible("\U000E0041"), "\\u{E0041}");
    EXPECT_EQ(one_line(std::string(500, 'a') + "\n\x1B[2J"), std::string(500, 'a') + "\\u{000A}\\u{001B}[2J");
    EXPECT_EQ(one_line(""), "");
}

TEST(VisibleText, JoinersAreShownWhereTheyWouldHide) {
    EXPECT_EQ(visible("a\u200Db"), "a\u200Db");
    EXPECT_EQ(visible("a\u200Db", 80, true), "a\\u{200D}b");
}

TEST(VisibleText, LongTextsAreCut) {
    EXPECT_EQ(visible("µµµµ", 3), "µµµ…");
    EXPECT_EQ(visible("µµµ", 3), "µµµ");
    EXPECT_EQ(in_quotes(""), "\"\"");
    EXPECT_EQ(in_quotes("R1"), "\"R1\"");
}

TEST(VisibleText, HexadecimalDigits) {
    EXPECT_EQ(hexadecimal(0xAD), "00AD");
    EXPECT_EQ(hexadecimal(0, 2), "00");
    EXPECT_EQ(hexadecimal(0x1F600), "1F600");
}

}  // namespace
}  // namespace gumcert::text
