#include "gum/quantity/distribution_shape.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace gumcert::gum {
namespace {

Distribution of(DistributionKind kind, double shape = 0.0, double second_shape = 0.0) {
    return {.kind = kind, .location = 5.0, .scale = 2.0, .shape = shape, .second_shape = second_shape};
}

/// Many values of a distribution at equal steps of probability, as an empirical one.
template <class Quantile>
Distribution empirical(const Quantile& quantile) {
    constexpr int k_values = 200'000;
    auto samples = std::make_shared<std::vector<double>>();
    for (int i = 0; i < k_values; ++i) {
        samples->push_back(quantile((i + 0.5) / k_values));
    }
    return {.kind = DistributionKind::empirical, .location = 0.0, .scale = 1.0, .samples = samples};
}

void expect_shape(const Distribution& distribution, double skew, double kurt, double tolerance = 1e-12) {
    EXPECT_NEAR(skewness(distribution), skew, tolerance * std::max(1.0, std::abs(skew)));
    EXPECT_NEAR(kurtosis(distribution), kurt, tolerance * kurt);
}

TEST(DistributionShape, IsThatOfTheTextbooks) {
    expect_shape(of(DistributionKind::normal), 0.0, 3.0);
    expect_shape(of(DistributionKind::uniform), 0.0, 1.8);
    expect_shape(of(DistributionKind::triangular), 0.0, 2.4);
    expect_shape(of(DistributionKind::arcsine), 0.0, 1.5);
    expect_shape(of(DistributionKind::trapezoidal, 0.0), 0.0, 2.4);
    expect_shape(of(DistributionKind::trapezoidal, 1.0), 0.0, 1.8);
    expect_shape(of(DistributionKind::curvilinear_trapezoid, 0.0), 0.0, 1.8);
    expect_shape(of(DistributionKind::student_t, 5.0), 0.0, 9.0);
    expect_shape(of(DistributionKind::gamma, 4.0), 1.0, 4.5);
    expect_shape(of(DistributionKind::exponential), 2.0, 9.0);
    expect_shape(of(DistributionKind::beta, 1.0, 1.0), 0.0, 1.8);
    expect_shape(of(DistributionKind::beta, 0.5, 0.5), 0.0, 1.5);
    expect_shape(of(DistributionKind::lognormal, 1.0), 6.184877138632554, 113.93639221514996, 1e-9);
}

TEST(DistributionShape, DoesNotExistInHeavyTails) {
    EXPECT_TRUE(std::isnan(skewness(of(DistributionKind::student_t, 3.0))));
    EXPECT_TRUE(std::isinf(kurtosis(of(DistributionKind::student_t, 4.0))));
}

// The formulas against values of the same distribution.
TEST(DistributionShape, IsThatOfTheValues) {
    expect_shape(empirical([](double p) { return -std::log1p(-p); }), 2.0, 9.0, 5e-3);
    expect_shape(empirical([](double p) { return std::sin(std::acos(-1.0) * (p - 0.5)); }), 0.0, 1.5, 1e-6);
    const auto trapezoid = [](double p) {  // β = 0.5: density 2/3 on the top, slopes of width 0.5
        const double q = p < 0.5 ? p : 1.0 - p;
        const double x = q < 1.0 / 6.0 ? -1.0 + std::sqrt(1.5 * q) : -0.5 + (q - 1.0 / 6.0) * 1.5;
        return p < 0.5 ? x : -x;
    };
    const Distribution exact = of(DistributionKind::trapezoidal, 0.5);
    expect_shape(empirical(trapezoid), 0.0, kurtosis(exact), 1e-6);
}

TEST(Support, HoldsAllValues) {
    EXPECT_EQ(support(of(DistributionKind::uniform)).low, 3.0);
    EXPECT_EQ(support(of(DistributionKind::uniform)).high, 7.0);
    EXPECT_EQ(support(of(DistributionKind::curvilinear_trapezoid, 0.5)).high, 8.0);
    EXPECT_EQ(support(of(DistributionKind::gamma, 2.0)).low, 5.0);
    EXPECT_TRUE(std::isinf(support(of(DistributionKind::gamma, 2.0)).high));
    EXPECT_TRUE(std::isinf(support(of(DistributionKind::normal)).low));
    EXPECT_EQ(support(of(DistributionKind::beta, 2.0, 3.0)).high, 7.0);
    EXPECT_EQ(support(empirical([](double p) { return p; })).low, 0.5 / 200'000);
}

TEST(DistributionShape, OfSamples) {
    const auto samples_of = [](std::vector<double> values) {
        return Distribution{.kind = DistributionKind::empirical,
                            .location = 1.0,
                            .scale = 10.0,
                            .samples = std::make_shared<const std::vector<double>>(std::move(values))};
    };
    // 0, 0, 0, 4 about 1: second moment 3, third (3·(−1) + 27)/4 = 6, fourth (3 + 81)/4 = 21.
    EXPECT_NEAR(skewness(samples_of({0.0, 0.0, 0.0, 4.0})), 6.0 / (3.0 * std::sqrt(3.0)), 1e-14);
    EXPECT_NEAR(kurtosis(samples_of({0.0, 0.0, 0.0, 4.0})), 21.0 / 9.0, 1e-14);
    EXPECT_EQ(skewness(samples_of({2.0, 2.0})), 0.0) << "they do not differ";
    EXPECT_EQ(kurtosis(samples_of({2.0, 2.0})), 3.0);
    EXPECT_EQ(support(samples_of({1.0, 2.0, 5.0})).low, 11.0);
    EXPECT_EQ(support(samples_of({1.0, 2.0, 5.0})).high, 51.0);
    EXPECT_EQ(support(samples_of({})).low, 1.0);
    EXPECT_EQ(support(samples_of({})).high, 1.0);
}

}  // namespace
}  // namespace gumcert::gum
