#include "reports/record/make/comparison/comparison_print.h"

#include <gtest/gtest.h>

#include <optional>

namespace gumcert::reports {
namespace {

TEST(ComparisonPrint, ValueAndUncertaintyEndAtTheSamePlaceInTheSameNotation) {
    EXPECT_EQ(printed_value(1e-9, 4.4e-11), "0.000000001000");
    EXPECT_EQ(printed_uncertainty(4.4e-11), "0.000000000044");
    EXPECT_EQ(printed_value(12.26967, 0.12649), "12.27");
    EXPECT_EQ(printed_uncertainty(0.12649), "0.13");
    EXPECT_EQ(printed_value(12345.0, 240.0), "1.234E+4");
    EXPECT_EQ(printed_uncertainty(240.0), "2.4E+2");
}

TEST(ComparisonPrint, WithoutUncertainty) {
    EXPECT_EQ(printed_value(-0.0, std::nullopt), "0");
    EXPECT_EQ(printed_value(24.9, 0.0), "24.9");
    EXPECT_EQ(printed_uncertainty(0.0), "0");
    EXPECT_EQ(printed_uncertainty(std::nullopt), "");
}

TEST(ComparisonPrint, AProbabilityIsNeverPrintedAsZero) {
    EXPECT_EQ(printed_probability(0.0), "<1E-300");
    EXPECT_EQ(printed_probability(0.00183), "0.0018");
    EXPECT_EQ(printed_probability(3e-27), "3.0E-27");
    EXPECT_EQ(printed_probability(1.0), "1.0");
    EXPECT_EQ(printed_probability(std::nullopt), "");
}

}  // namespace
}  // namespace gumcert::reports
