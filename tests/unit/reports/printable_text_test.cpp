#include "reports/printable_text.h"

#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

TEST(PrintableText, StaysAsItIs) {
    for (const char* const text : {"", "10.05 mm", "Mittenmaß ± 0,5 µm", "校正", "a\u00A0b"}) {
        EXPECT_EQ(printable(text), text);
    }
}

TEST(PrintableText, HasBlanksForTabsAndLineFeeds) {
    EXPECT_EQ(printable("a\tb\nc"), "a b c");
}

TEST(PrintableText, HidesNothingAndTurnsNothing) {
    EXPECT_EQ(printable("a\x07"
                        "b"),
              "a\uFFFDb")
        << "a control character";
    EXPECT_EQ(printable("a\u202Eb"), "a\uFFFDb") << "right to left";
    EXPECT_EQ(printable("a\u200Bb"), "a\uFFFDb") << "a blank of no width";
    EXPECT_EQ(printable("a\xFF"
                        "b"),
              "a\uFFFDb")
        << "no UTF-8";
    EXPECT_EQ(printable("a\xC3"), "a\uFFFD") << "half a character";
}

TEST(PrintableText, IsShortenedByCharacters) {
    EXPECT_EQ(shortened("größer", 6), "größer");
    EXPECT_EQ(shortened("größer", 4), "größ…");
    EXPECT_EQ(shortened("", 0), "");
    EXPECT_EQ(shortened("a", 0), "…");
}

}  // namespace
}  // namespace gumcert::reports
