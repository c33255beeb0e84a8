#include "text/edit_distance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <string>

namespace gumcert::text {
namespace {

TEST(EditDistance, CountsLettersToInsertDeleteOrReplace) {
    EXPECT_EQ(edit_distance("", ""), 0U);
    EXPECT_EQ(edit_distance("", "unit"), 4U);
    EXPECT_EQ(edit_distance("kitten", "sitting"), 3U);
    EXPECT_EQ(edit_distance("angle", "angel"), 2U);
}

TEST(EditDistance, TakesCapitalsForSmallLetters) {
    EXPECT_EQ(edit_distance("AXIS", "axis"), 0U);
    EXPECT_EQ(edit_distance("gc-rank-0001", "GC-RANK-0002"), 1U);
}

TEST(EditDistance, IsADistance) {
    std::mt19937_64 random(7);
    const auto word = [&] {
        std::string letters(random() % 9, 'a');
        for (char& letter : letters) {
            letter = static_cast<char>('a' + random() % 3);
        }
        return letters;
    };
    for (int i = 0; i < 2000; ++i) {
        const std::string a = word();
        const std::string b = word();
        const std::string c = word();
        EXPECT_EQ(edit_distance(a, b) == 0, a == b);
        EXPECT_EQ(edit_distance(a, b), edit_distance(b, a));
        EXPECT_LE(edit_distance(a, c), edit_distance(a, b) + edit_distance(b, c)) << a << " " << b << " " << c;
        EXPECT_GE(edit_distance(a, b), std::max(a.size(), b.size()) - std::min(a.size(), b.size()));
        EXPECT_LE(edit_distance(a, b), std::max(a.size(), b.size()));
    }
}

}  // namespace
}  // namespace gumcert::text
