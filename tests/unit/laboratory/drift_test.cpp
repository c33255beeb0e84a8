#include "laboratory/drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::laboratory {
namespace {

TEST(DriftTest, LimitGrowsWithTime) {
    const Drift drift = drift_within_limit(0.12, 365.25 / 2.0);
    EXPECT_DOUBLE_EQ(drift.half_width, 0.06);
    EXPECT_DOUBLE_EQ(drift.u, 0.06 / std::sqrt(3.0));
    EXPECT_EQ(drift.value, 0.0);
    EXPECT_TRUE(std::isinf(drift.nu));
    EXPECT_EQ(drift_within_limit(0.12, 0.0).u, 0.0);
}

TEST(DriftTest, LastDifferenceIsScaledBeyondItsInterval) {
    const std::vector<SeriesPoint> series{{-300.0, 5.0, 0.1}, {-100.0, 1.0, 0.1}, {0.0, 1.5, 0.1}};
    EXPECT_DOUBLE_EQ(drift_as_last_difference(series, 20.0).half_width, 0.5);
    EXPECT_DOUBLE_EQ(drift_as_last_difference(series, 100.0).half_width, 0.5);
    EXPECT_DOUBLE_EQ(drift_as_last_difference(series, 250.0).half_width, 1.25);
    EXPECT_THROW((void)drift_as_last_difference(std::vector{series[2]}, 1.0), gum::InputError);
}

// By hand: t = -2, -1, 0; y = 7, 8, 10: slope 1.5, residuals 1/6, -1/3, 1/6, s² = 1/6, prediction one day later.
TEST(DriftTest, OrdinaryLineByHand) {
    const std::vector<SeriesPoint> series{{-2.0, 7.0, 0.1}, {-1.0, 8.0, 0.1}, {0.0, 10.0, 0.1}};
    const Drift drift = linear_drift(series, false, 1.0);
    EXPECT_NEAR(drift.value, 4.0 / 3.0, 1e-12);
    EXPECT_NEAR(drift.u, std::sqrt(1.0 / 6.0 * (1.0 + 1.0 / 3.0 + 2.0)), 1e-12);
    EXPECT_EQ(drift.nu, 1.0);
}

// JCGM 100:2008, H.3: the same line fitted to table H.6 (temperature in place of time). b(30 °C) = -0.1494 °C with
// u = 0.0041 °C of the line, s = 0.0035 °C of a reading; a prediction has both.
TEST(DriftTest, OrdinaryLineOfTheGuide) {
    const double t[] = {21.521, 22.012, 22.512, 23.003, 23.507, 23.999, 24.513, 25.002, 25.503, 26.010, 26.511};
    const double b[] = {-0.171, -0.169, -0.166, -0.159, -0.164, -0.165, -0.156, -0.157, -0.159, -0.161, -0.160};
    std::vector<SeriesPoint> series;
    for (int i = 0; i < 11; ++i) {
        series.push_back({t[i] - t[10], b[i], 0.0});
    }
    const Drift drift = linear_drift(series, false, 30.0 - t[10]);
    EXPECT_NEAR(b[10] + drift.value, -0.1494, 0.00005);
    EXPECT_NEAR(drift.u, std::hypot(0.0041, 0.0035), 0.00007);  // half a unit of the last digit of both
    EXPECT_EQ(drift.nu, 9.0);
}

// Two points of equal weight far away, one of weight 4 at 0: by hand.
TEST(DriftTest, WeightsAreThoseOfTheUncertainties) {
    const std::vector<SeriesPoint> series{{-2.0, 0.0, 2.0}, {-1.0, 1.0, 2.0}, {0.0, 2.0, 1.0}};
    const Drift drift = linear_drift(series, true, 1.0);
    // W = 1.5, t_mean = -0.5, S = 0.25·2.25 + 0.25·0.25 + 0.25 = 0.875; the points lie on a line, so c = 1.
    EXPECT_NEAR(drift.value, 1.0, 1e-12);
    EXPECT_NEAR(drift.u, std::sqrt(1.0 / 1.5 + 1.5 * 1.5 / 0.875), 1e-12);
    EXPECT_TRUE(std::isinf(drift.nu));
}

TEST(DriftTest, ScatterBeyondTheUncertaintiesIsAdded) {
    const std::vector<SeriesPoint> series{{-2.0, 7.0, 0.1}, {-1.0, 8.0, 0.1}, {0.0, 10.0, 0.1}};
    const Drift drift = linear_drift(series, true, 1.0);
    const double c = 1.0 / 6.0 / 0.01;
    EXPECT_NEAR(drift.u, std::sqrt(c * 0.01 * (1.0 / 3.0 + 2.0) + (c - 1.0) * 0.01), 1e-12);
    EXPECT_EQ(drift.nu, 1.0);
}

TEST(DriftTest, ALineNeedsThreeDaysAndWeights) {
    const std::vector<SeriesPoint> two{{-1.0, 8.0, 0.1}, {0.0, 10.0, 0.1}};
    EXPECT_THROW((void)linear_drift(two, false, 1.0), gum::InputError);
    const std::vector<SeriesPoint> one_day{{0.0, 8.0, 0.1}, {0.0, 9.0, 0.1}, {0.0, 10.0, 0.1}};
    EXPECT_THROW((void)linear_drift(one_day, false, 1.0), gum::InputError);
    const std::vector<SeriesPoint> without_u{{-2.0, 8.0, 0.1}, {-1.0, 9.0, 0.0}, {0.0, 10.0, 0.1}};
    EXPECT_THROW((void)linear_drift(without_u, true, 1.0), gum::InputError);
}

}  // namespace
}  // namespace gumcert::laboratory
