#include "text/rounded_number.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace gumcert::text {
namespace {

TEST(RoundedNumber, IsTheNumberThatIsPrinted) {
    EXPECT_EQ(rounded_number(0.1 + 0.2, k_digits_held), 0.3);
    EXPECT_EQ(rounded_number(1234.5, 2), 1200.0);
    EXPECT_EQ(rounded_number(-0.00125, 1), -0.001);
    EXPECT_EQ(rounded_number(0.0, 2), 0.0);
    EXPECT_EQ(rounded_number(9.99e-310, 2), 1e-309);
    EXPECT_EQ(rounded_number(std::numeric_limits<double>::infinity(), 2), std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(rounded_number(std::numeric_limits<double>::quiet_NaN(), 2)));
}

TEST(RoundedNumber, ChangesNothingThatItHasRounded) {
    for (int i = 1; i < 2'000; ++i) {
        const double value = std::ldexp(std::sin(i), i % 120 - 60);
        for (const int digits : {1, 2, 7, k_digits_held}) {
            const double rounded = rounded_number(value, digits);
            EXPECT_EQ(rounded_number(rounded, digits), rounded) << value << ' ' << digits;
            EXPECT_LE(std::abs(rounded - value), std::abs(value) * 5.0 * std::pow(10.0, -digits)) << value;
        }
    }
}

}  // namespace
}  // namespace gumcert::text
