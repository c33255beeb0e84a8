#include "gum/quantity/unit_exponent.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace gumcert::gum {
namespace {

TEST(UnitExponent, IsTheFractionInLowestTerms) {
    EXPECT_EQ(unit_exponent(-2.5), (UnitExponent{-5, 2}));
    EXPECT_EQ(unit_exponent(1.0 / 3.0), (UnitExponent{1, 3}));
    EXPECT_EQ(unit_exponent(0.0), (UnitExponent{0, 1}));
    for (int denominator = 1; denominator <= k_largest_denominator; ++denominator) {
        for (int numerator = -40; numerator <= 40; ++numerator) {
            const int common = std::gcd(numerator, denominator);
            EXPECT_EQ(unit_exponent(static_cast<double>(numerator) / denominator),
                      (UnitExponent{numerator / common, denominator / common}))
                << numerator << "/" << denominator;
        }
    }
}

TEST(UnitExponent, ForgivesWhatRoundingLeaves) {
    EXPECT_EQ(unit_exponent(0.1 + 0.2 + 0.2), (UnitExponent{1, 2}));
    EXPECT_EQ(unit_exponent(std::nextafter(2.0 / 7.0, 1.0)), (UnitExponent{2, 7}));
    EXPECT_EQ(unit_exponent(0.5 + 1e-8), std::nullopt);
}

TEST(UnitExponent, OthersAreNone) {
    EXPECT_EQ(unit_exponent(0.1), std::nullopt) << "a denominator of 10";
    EXPECT_EQ(unit_exponent(0.37), std::nullopt);
    EXPECT_EQ(unit_exponent(99.0), (UnitExponent{99, 1}));
    EXPECT_EQ(unit_exponent(-100.0), std::nullopt);
    EXPECT_EQ(unit_exponent(1e300), std::nullopt);
    EXPECT_EQ(unit_exponent(std::numeric_limits<double>::quiet_NaN()), std::nullopt);
    EXPECT_EQ(unit_exponent(std::numeric_limits<double>::infinity()), std::nullopt);
}

TEST(UnitExponent, HasParenthesesWhereItIsAFraction) {
    EXPECT_EQ(exponent_text({2, 1}), "2");
    EXPECT_EQ(exponent_text({-1, 1}), "-1");
    EXPECT_EQ(exponent_text({1, 2}), "(1/2)");
    EXPECT_EQ(exponent_text({-5, 2}), "(-5/2)");
}

TEST(UnitExponent, OfADimension) {
    const Dimension length = Unit::parse("m").dimension();
    EXPECT_TRUE(is_of_a_unit(Dimension()));
    EXPECT_TRUE(is_of_a_unit(length.power(0.5)));
    EXPECT_FALSE(is_of_a_unit(length.power(0.123)));
    EXPECT_FALSE(is_of_a_unit(Unit::parse("kg").dimension() * length.power(0.37))) << "one of several";
}

}  // namespace
}  // namespace gumcert::gum
