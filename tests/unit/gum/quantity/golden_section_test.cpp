#include "gum/quantity/golden_section.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gumcert::gum {
namespace {

TEST(GoldenSection, EndsWhereAFunctionIsLeast) {
    for (const double least : {-2.0, -0.3, 0.0, 1.7, 3.0}) {
        int asked = 0;
        const auto distance = [&](double x) {
            ++asked;
            return std::abs(x - least);
        };
        EXPECT_NEAR(least_by_golden_section(distance, -2.0, 3.0, 48), least, 1e-8);
        EXPECT_EQ(asked, 50);
    }
}

TEST(GoldenSection, KeepsTheLowerOfEqualValues) {
    EXPECT_NEAR(least_by_golden_section([](double) { return 1.0; }, 0.0, 1.0, 48), 0.0, 1e-9);
    EXPECT_EQ(least_by_golden_section([](double x) { return x; }, 2.0, 2.0, 48), 2.0);
}

}  // namespace
}  // namespace gumcert::gum
