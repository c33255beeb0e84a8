#include "certificate/text_words.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::certificate {
namespace {

using Words = std::vector<std::u32string>;

TEST(TextWords, AreRunsOfLettersAndDigitsInSmallLetters) {
    EXPECT_EQ(words_of("Head of Laboratory, room 2"), (Words{U"head", U"of", U"laboratory", U"room", U"2"}));
    EXPECT_EQ(words_of(" – "), Words{});
    EXPECT_EQ(words_of(""), Words{});
    EXPECT_EQ(words_of("見上、無"), (Words{U"見上", U"無"}));
}

TEST(TextWords, HaveNoAccentsAndNoFormsOfOtherScripts) {
    EXPECT_EQ(words_of("Véase Übung Straße"), (Words{U"vease", U"ubung", U"strasse"}));
    EXPECT_EQ(words_of("ve\u0301ase"), Words{U"vease"});
    EXPECT_EQ(words_of("ＮＯＮＥ"), Words{U"none"});
    EXPECT_EQ(words_of("nоne"), Words{U"none"});  // with a Cyrillic о
    EXPECT_EQ(words_of("no\u200bne"), Words{U"none"});
    EXPECT_EQ(words_of("no\u00adne"), Words{U"none"});
}

TEST(TextWords, OfOneTextInOne) {
    EXPECT_EQ(letters_of("EX-2026 0042"), U"ex20260042");
    EXPECT_EQ(letters_of("N/A"), U"na");
    EXPECT_EQ(letters_of("…"), U"");
}

TEST(TextWords, TellScriptsWithoutSpaces) {
    EXPECT_TRUE(is_ideograph(U'無'));
    EXPECT_TRUE(is_ideograph(U'の'));
    EXPECT_FALSE(is_ideograph(U'a'));
    EXPECT_FALSE(is_ideograph(U'7'));
}

}  // namespace
}  // namespace gumcert::certificate
