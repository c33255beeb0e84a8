#include "gum/nearest_turn.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gumcert::gum {
namespace {

constexpr double k_degree = std::numbers::pi / 180.0;

TEST(NearestTurn, IsWithinHalfATurn) {
    EXPECT_NEAR(nearest_turn(-179.0 * k_degree, 179.0 * k_degree), 181.0 * k_degree, 1e-12);
    EXPECT_EQ(nearest_turn(1.0, 0.5), 1.0);
    for (double angle = -20.0; angle < 20.0; angle += 0.37) {
        for (double to = -20.0; to < 20.0; to += 0.41) {
            const double turned = nearest_turn(angle, to);
            EXPECT_LE(std::abs(turned - to), std::numbers::pi + 1e-12);
            EXPECT_NEAR(std::remainder(turned - angle, 2.0 * std::numbers::pi), 0.0, 1e-12);
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
