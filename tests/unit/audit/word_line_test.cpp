#include "audit/word_line.h"

#include <string>

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

TEST(WordLine, finds_beginnings_words_and_parts) {
    const WordLine words("Wärmeausdehnung, Dead-Path of the standard deviation");
    EXPECT_TRUE(words.has("dead path"));
    EXPECT_TRUE(words.has("warme"));
    EXPECT_TRUE(words.has("*ausdehnung"));
    EXPECT_FALSE(words.has("ausdehnung"));
    EXPECT_FALSE(words.has("warme "));
    EXPECT_TRUE(words.has_any({"nothing", "standard"}));
    EXPECT_FALSE(words.has_word("standard", {"deviation"}));
    EXPECT_TRUE(WordLine("standard deviation of the standard").has_word("standard", {"deviation"}));
    EXPECT_FALSE(WordLine("").has("a"));
}

TEST(WordLine, reads_a_count_in_front_of_a_word) {
    EXPECT_EQ(WordLine("from 2 calibrations").count_of({"calibration"}), 2U);
    EXPECT_EQ(WordLine("aus 12 Kalibrierungen, zuletzt 3 Kalibrierungen").count_of({"kalibrierung"}), 3U);
    EXPECT_FALSE(WordLine("the calibration").count_of({"calibration"}));
    EXPECT_FALSE(WordLine("calibration").count_of({"calibration"}));
}

TEST(Cut, leaves_characters_whole) {
    EXPECT_EQ(cut("aµ", 2), "a");
    EXPECT_EQ(cut("aµ", 3), "aµ");
    EXPECT_EQ(cut("abc", 9), "abc");
}

}  // namespace
}  // namespace gumcert::audit
