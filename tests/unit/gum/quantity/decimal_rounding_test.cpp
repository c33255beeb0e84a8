#include "gum/quantity/decimal_rounding.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gumcert::gum {
namespace {

TEST(DecimalRounding, IsNoneOfWhatADoubleHolds) {
    for (const double value : {0.0, 1.0, -3.0, 1e15, 9007199254740992.0, 0.5, 12.25, -1000000000.75, 0x1p-30}) {
        EXPECT_EQ(decimal_rounding(value), 0.0) << value;
    }
}

TEST(DecimalRounding, IsHalfAUnitOfTheLastBinaryPlace) {
    for (const double value : {0.1, -0.1, 1000000000.1, 429228004.229873, 3.3e-12, 1e17 / 3.0}) {
        const double unit = std::nextafter(std::fabs(value), INFINITY) - std::fabs(value);
        EXPECT_EQ(decimal_rounding(value), 0.5 * unit) << value;
    }
    EXPECT_EQ(decimal_rounding(INFINITY), 0.0);
}

}  // namespace
}  // namespace gumcert::gum
