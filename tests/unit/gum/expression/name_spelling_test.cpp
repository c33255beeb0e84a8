#include "gum/expression/name_spelling.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "text/utf8.h"

namespace gumcert::gum {
namespace {

using testing::IsEmpty;

TEST(NameSpelling, LeavesSmallLettersAndNumbers) {
    EXPECT_EQ(without_spelling("Std-017 b"), "std17b");
    EXPECT_EQ(without_spelling("x_(2/3) \u00b1 y\u00b2"), "x23y2");
    EXPECT_EQ(without_spelling("No. 100"), "no100") << "zeros within a number count";
    EXPECT_EQ(without_spelling("1.05"), "105") << "so they do after a decimal sign: 1.05 is not 1.5";
    EXPECT_EQ(without_spelling("000"), "");
    EXPECT_EQ(without_spelling(" - _ "), "");
    EXPECT_EQ(without_spelling(""), "");
    for (char32_t i = 0; i < 26; ++i) {
        const std::string small(1, static_cast<char>('a' + static_cast<int>(i)));
        EXPECT_EQ(without_spelling(text::encode_utf8(U'A' + i)), small);
        EXPECT_EQ(without_spelling(text::encode_utf8(0xff21 + i)), small) << "full width";
    }
    for (char32_t i = 1; i < 10; ++i) {
        const std::string digit(1, static_cast<char>('0' + static_cast<int>(i)));
        for (const char32_t code : {0x2080 + i, 0xff10 + i, 0x245f + i}) {  // below the line, full width, in a circle
            EXPECT_EQ(without_spelling(text::encode_utf8(code)), digit);
        }
    }
}

TEST(NameSpelling, AccentsCountForNothingComposedOrNot) {
    for (const auto& [composed, apart, plain] :
         std::vector<std::array<std::string, 3>>{{"\u00c9talon", "E\u0301talon", "etalon"},
                                                 {"\u00c5ngstr\u00f6m", "A\u030angstro\u0308m", "angstrom"},
                                                 {"\u010capek", "C\u030capek", "capek"},
                                                 {"Se\u00f1al", "sen\u0303al", "senal"},
                                                 {"Bra\u015fov", "bras\u0327ov", "brasov"},
                                                 {"\u017b\u00f3\u0142w", "z\u0307o\u0301\u0142w", "zolw"}}) {
        EXPECT_EQ(without_spelling(composed), plain);
        EXPECT_EQ(without_spelling(apart), plain);
    }
    EXPECT_EQ(without_spelling("Ma\u00dfstab"), "massstab");
    EXPECT_EQ(without_spelling("\u0152uvre \u00c6\u00de"), "oeuvreaeth");
}

TEST(NameSpelling, LettersThatAreOneAreAlikeAndOthersAreNot) {
    for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{
             {"\u00b5", "\u039c\u0301"},           // micro sign, capital mu
             {"\u2126", "\u03c9"},                 // ohm, omega
             {"\u0398", "\u03b8"},                 // theta
             {"\u038f", "\u03ce"},                 // omega with tonos
             {"\u0401\u0416", "\u0435\u0436"},     // Cyrillic yo and zhe
             {"\u0492", "\u0493"},                 // Cyrillic letters that stand in pairs
             {"\u0421\u0422 5", "c\u0442-05"}}) {  // Cyrillic es looks like c
        EXPECT_EQ(without_spelling(one), without_spelling(other)) << one;
        EXPECT_NE(without_spelling(one), "") << one;
    }
    const std::vector<std::string> apart = {"\u03c3", "\u03c9", "\u03b8", "\u0436", "\u9577", "\u5206", "a", "1"};
    std::set<std::string> forms;
    for (const std::string& name : apart) {
        forms.insert(without_spelling(name));
    }
    EXPECT_EQ(forms.size(), apart.size());
}

TEST(NameSpelling, TheFormIsItsOwnForm) {
    for (const std::string& name : std::vector<std::string>{"Std-017 b", "\u00c5ngstr\u00f6m 3", "\u041d\u0418\u0418 1",
                                                            "\u039c\u03ac\u03b6\u03b1 2", "\u9577\u3055 2"}) {
        const std::string form = without_spelling(name);
        EXPECT_NE(form, name);
        EXPECT_EQ(without_spelling(form), form);
    }
}

TEST(NameSpelling, AsksOnceForEveryGroupOfNames) {
    const std::vector<Diagnostic> questions =
        similar_source_names({"Std 17", "std-17", "STD 017", "Std 170", "Air", "air"}, {});
    ASSERT_EQ(questions.size(), 2U);
    const Diagnostic air{
        "GC-COMPARE-0129",
        "sources",
        "the names \"Air\", \"air\" are taken as different sources of uncertainty; are they the same?",
        "results share a source where they name it alike, and a covariance that is left out hides failures",
        "Spell the source alike everywhere, or list the names in \"different_sources\".",
        Severity::warning};
    EXPECT_EQ(message(questions[0]), message(air));
    EXPECT_EQ(questions[0], air);
    EXPECT_EQ(questions[1].what,
              "the names \"STD 017\", \"Std 17\", \"std-17\" are taken as different sources of uncertainty; are they "
              "the same?");
}

TEST(NameSpelling, AsksNothingOfNamesThatAreKnownToDiffer) {
    const std::set<std::string> names = {"Std 17", "std-17", "STD 017"};
    EXPECT_THAT(similar_source_names(names, {"Std 17", "std-17"}), IsEmpty()) << "one name is left";
    const std::vector<Diagnostic> rest = similar_source_names(names, {"std-17", "Std 18"});
    ASSERT_EQ(rest.size(), 1U);
    EXPECT_THAT(rest[0].what, testing::StartsWith("the names \"STD 017\", \"Std 17\" are"));
    EXPECT_EQ(similar_source_names(names, {"std 17"}).size(), 1U) << "a name is known as it is spelled";
    EXPECT_THAT(similar_source_names({"-", "_", " "}, {}), IsEmpty()) << "names of signs alone say nothing";
    EXPECT_THAT(similar_source_names({}, {}), IsEmpty());
}

}  // namespace
}  // namespace gumcert::gum
