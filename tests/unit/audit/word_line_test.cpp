#include "audit/word_line.h"

#include <string>
#include <vector>

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

/// Law: a beginning is found where it stands behind a space, of all lines that a few words make.
TEST(WordLine, finds_what_a_search_of_the_whole_line_finds) {
    const std::vector<std::string> words{"dead", "path", "deadpath", "a", "ad", "pa", "th"};
    for (const std::string& first : words) {
        for (const std::string& second : words) {
            for (const std::string& third : words) {
                const std::string line = first + ' ' + second + ' ' + third;
                for (const std::string& one : words) {
                    for (const std::string& beginning :
                         {one, one + ' ', one.substr(0, one.size() / 2 + 1), one + " p", first + ' ' + one}) {
                        EXPECT_EQ(WordLine(line).has(beginning),
                                  (' ' + line + ' ').find(' ' + beginning) != std::string::npos)
                            << line << ": " << beginning;
                    }
                }
            }
        }
    }
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
