#include "engine/number_texts.h"

#include <gtest/gtest.h>

namespace gumcert::engine {
namespace {

TEST(NumberTexts, ShortestReadsBackTheSame) {
    EXPECT_EQ(shortest_text(0.1), "0.1");
    EXPECT_EQ(shortest_text(-1e-9), "-1e-09");
    EXPECT_EQ(shortest_text(1.0 / 3.0), "0.3333333333333333");
    EXPECT_EQ(degrees_text(22.5), "22.5°");
}

TEST(NumberTexts, SignificantAndFixedDigits) {
    EXPECT_EQ(significant_text(1234.5, 3), "1.23e+03");
    EXPECT_EQ(significant_text(5.334, 3), "5.33");
    EXPECT_EQ(significant_text(12345678.0, 12), "12345678");
    EXPECT_EQ(fixed_text(1234.567, 1), "1234.6");
    EXPECT_EQ(fixed_text(0.0, 0), "0");
}

}  // namespace
}  // namespace gumcert::engine
