#include "certificate/stated_text.h"

#include <gtest/gtest.h>

#include <string>

namespace gumcert::certificate {
namespace {

TEST(StatedText, HasALetterOrADigit) {
    for (const char* text :
         {"A", "7", "SN-1001", "№ 7", "Ω", "µ", "é", "範例", "مختبر", "々", "none", "- 1", "２", "😀 a"}) {
        EXPECT_TRUE(is_stated(std::string(text))) << text;
    }
}

TEST(StatedText, IsNotADashOrABlank) {
    for (const char* text : {"",       "-",      "—",  "–",      ".",      "…",      "?",      "---",    "/",
                             "()",     "* * *",  " ",  "\u00a0", "\u3000", "\u200b", "\u200d", "\u2800", "\u3164",
                             "\u034f", "\uffa0", "、", "→",      "n/a",    "N/A",    "TBD"}) {
        EXPECT_FALSE(is_stated(std::string(text))) << text;
    }
}

TEST(StatedText, IsStatedInEveryLanguageOfIt) {
    LocalisedText text;
    EXPECT_FALSE(is_stated(text));
    text.by_language = {{"en", "Table"}, {"de", "Tisch"}};
    EXPECT_TRUE(is_stated(text));
    text.by_language = {{"en", "Table"}, {"de", "–"}};
    EXPECT_FALSE(is_stated(text));
    EXPECT_TRUE(is_stated(LocalisedText("Table")));
}

// Bytes that are no UTF-8 do not lead past the end.
TEST(StatedText, TakesAnyBytes) {
    for (int first = 0; first < 256; ++first) {
        (void)is_stated(std::string(1, static_cast<char>(first)));
        std::string text(1, '-');
        text.push_back(static_cast<char>(first));
        text.push_back('\x80');
        (void)is_stated(text);
    }
}

}  // namespace
}  // namespace gumcert::certificate
