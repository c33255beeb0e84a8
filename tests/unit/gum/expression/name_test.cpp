#include "gum/expression/name.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "equations.h"

namespace gumcert::gum {
namespace {

using testing::HasSubstr;

TEST(Names, OfOtherScripts) {
    EXPECT_EQ(codes(problems_of({"Δl = α*θ + T₀ + 長さ + x'"}, numbers({"α", "θ", "T₀", "長さ", "x'"}))), "");
    // The micro sign and the letter are one.
    EXPECT_EQ(codes(problems_of({"y = \u00b5 + 1"}, numbers({"\u03bc"}))), "");
    // ρ and p, ν and v are told apart; Cyrillic а and Latin a are not.
    EXPECT_EQ(codes(problems_of({"y = ρ + p + ν + v"}, numbers({"ρ", "p", "ν", "v"}))), "");
    EXPECT_EQ(codes(problems_of({"y = a"}, numbers({"a", "а"}))), "0029 input а");
    EXPECT_THAT(messages(problems_of({"y = а"}, numbers({"a"}))), HasSubstr("looks the same"));
    EXPECT_EQ(codes(problems_of({"y = a"}, numbers({"a", "b c", "2x", "", "exp"}))),
              "0029 input b c; 0029 input 2x; 0029 input ; 0023 input exp");
}

TEST(Names, ClassesOfCharacters) {
    for (const char32_t code : {U'a', U'_', U'é', U'Δ', U'μ', U'Ж', U'長'}) {
        EXPECT_EQ(character_class(code), CharacterClass::name_start) << code_point_text(code);
    }
    for (const char32_t code : {U'0', U'9', U'\'', U'₀', U'ₐ'}) {
        EXPECT_EQ(character_class(code), CharacterClass::name_part) << code_point_text(code);
    }
    EXPECT_EQ(character_class(0x301), CharacterClass::combining_mark);
    for (const char32_t code : {char32_t{0}, char32_t{0x200B}, char32_t{0x202E}}) {
        EXPECT_EQ(character_class(code), CharacterClass::control) << code_point_text(code);
    }
    for (const char32_t code : {U' ', U'+', U'²', U'∂'}) {
        EXPECT_EQ(character_class(code), CharacterClass::other) << code_point_text(code);
    }
}

TEST(Names, AreComparedInOneForm) {
    EXPECT_EQ(canonical_name("\u00b5_r"), "\u03bc_r");
    EXPECT_EQ(canonical_name("\u2126\u212a\u212b"), "\u03a9K\u00c5");
    EXPECT_EQ(canonical_name("l_s"), "l_s");
    EXPECT_EQ(canonical_name("a\xff"
                             "b"),
              "a\xff"
              "b")
        << "no UTF-8: left as it is";
}

TEST(Names, ThatLookTheSameHaveOneSkeleton) {
    EXPECT_EQ(look_alike_skeleton("Αρ"), "Aρ") << "Greek alpha looks like A, rho is told from p";
    EXPECT_EQ(look_alike_skeleton("ср"), "cp") << "Cyrillic";
    EXPECT_NE(look_alike_skeleton("ν"), look_alike_skeleton("v"));
}

TEST(Names, WhyATextIsNone) {
    for (const char* name : {"a", "_", "l_s", "x'", "T₀", "Δl", "長さ", "Жук"}) {
        EXPECT_EQ(reason_against_name(name), std::nullopt) << name;
    }
    EXPECT_EQ(reason_against_name(std::string(256, 'a')), std::nullopt);
    const std::vector<std::pair<std::string, std::string>> table{
        {"", "is empty"},
        {std::string(257, 'a'), "has 257 bytes, more than 256"},
        {"a\xff", "is not valid UTF-8"},
        {"2x", "begins with \"2\""},
        {"e\u0301", "has a combining mark (U+0301) in place of one letter with its accent"},
        {"a\u202e", "has the invisible character U+202E"},
        {"b c", "has a space"},
        {"a+b", "has the character \"+\""},
        {"аb", "mixes Latin letters with U+0430, which only looks like the Latin a"},
        {"Жé", "mixes Cyrillic letters with letters of another script"},
    };
    for (const auto& [name, reason] : table) {
        EXPECT_EQ(reason_against_name(name), reason) << name;
    }
}

TEST(Names, CodePointsInText) {
    EXPECT_EQ(code_point_text(0x202E), "U+202E");
    EXPECT_EQ(code_point_text(U'a'), "U+0061");
}

TEST(Names, NearestIsWithinASlip) {
    const std::vector<std::string> candidates{"alpha", "l_s", "delta_theta", "T"};
    EXPECT_EQ(nearest_name("aplha", candidates), "alpha");
    EXPECT_EQ(nearest_name("l_S", candidates), "l_s") << "the case is half a letter";
    EXPECT_EQ(nearest_name("ls", candidates), "l_s");
    EXPECT_EQ(nearest_name("deltatheta", candidates), "delta_theta");
    EXPECT_EQ(nearest_name("t", candidates), "T");
    EXPECT_EQ(nearest_name("x", candidates), std::nullopt) << "no letter of it is left";
    EXPECT_EQ(nearest_name("beta", candidates), std::nullopt);
    EXPECT_EQ(nearest_name("alpha", {}), std::nullopt);
    EXPECT_EQ(nearest_name(std::string(65, 'a'), std::vector<std::string>{std::string(65, 'a')}), std::nullopt)
        << "too long to compare";
}

}  // namespace
}  // namespace gumcert::gum
