#include "gum/monte_carlo/extreme_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <utility>
#include <vector>

#include "gum/coverage.h"

namespace gumcert::gum {
namespace {

constexpr double k_p = 0.9545;
constexpr double k_infinite = std::numeric_limits<double>::infinity();

ExtremeValues independent(const std::vector<double>& values) {
    const auto n = static_cast<Eigen::Index>(values.size());
    return range_of(Eigen::Map<const Eigen::VectorXd>(values.data(), n), Eigen::MatrixXd::Identity(n, n));
}

TEST(ExtremeUncertainty, IsThatOfTheLawWhereTheExtremesAreClear) {
    const ExtremeUncertainty clear = extreme_uncertainty(independent({30.0, 2.0, 0.0, -1.0, -30.0}), k_p, k_infinite);
    EXPECT_DOUBLE_EQ(clear.u, std::sqrt(2.0));
    EXPECT_EQ(clear.u, clear.law_u);
}

TEST(ExtremeUncertainty, OfEqualValuesIsTheStudentizedRange) {
    // Quantiles at 0.95 of the range of n standard normal deviates, and of the studentized range with ν degrees of freedom
    // (any table of the studentized range).
    struct Case {
        std::size_t n;
        double nu, quantile;
    };
    for (const auto& [n, nu, quantile] :
         std::vector<Case>{{4, k_infinite, 3.63}, {12, k_infinite, 4.62}, {4, 5.0, 5.22}}) {
        const ExtremeUncertainty equal = extreme_uncertainty(independent(std::vector<double>(n, 1.5)), 0.95, nu);
        EXPECT_NEAR(equal.u * coverage_factor(0.95, nu), quantile, 0.015 * quantile) << n << " " << nu;
    }
}

TEST(ExtremeUncertainty, OfALargestValueTakesNothingOff) {
    ExtremeValues largest = independent({1.0, 1.0, 1.0});
    largest.lower.clear();
    // |max of three deviates|: P(max <= x) = Φ(x)³, and below −x hardly anything.
    const double x = extreme_uncertainty(largest, k_p, k_infinite).u * coverage_factor(k_p, k_infinite);
    const double inside =
        std::pow(0.5 * std::erfc(-x / std::sqrt(2.0)), 3) - std::pow(0.5 * std::erfc(x / std::sqrt(2.0)), 3);
    EXPECT_NEAR(inside, k_p, 0.004);
}

TEST(ExtremeUncertainty, DoesNotDependOnALargerProbability) {
    const ExtremeValues equal = independent(std::vector<double>(6, 0.0));
    const double u = extreme_uncertainty(equal, k_p, 9.0).u;
    EXPECT_EQ(extreme_uncertainty(equal, 0.99, 9.0).u, u);
    EXPECT_EQ(extreme_uncertainty(equal, 0.999999999, 9.0).u, u);
    // The range of six deviates at 0.9999 is 6.36.
    EXPECT_GT(extreme_uncertainty(equal, 0.9999, k_infinite).u * coverage_factor(0.9999, k_infinite), 6.36);
    // Many degrees of freedom are none: a closure with little scatter has 1e11 of them.
    EXPECT_NEAR(extreme_uncertainty(equal, k_p, 1e12).u, extreme_uncertainty(equal, k_p, k_infinite).u, 1e-9);
}

TEST(ExtremeUncertainty, IsTheSameForOneQuantityTwice) {
    ExtremeValues twice = range_of(Eigen::Vector2d(1.0, 1.0), Eigen::Matrix2d::Ones());
    EXPECT_EQ(extreme_uncertainty(twice, k_p, k_infinite).u, 0.0);
}

// The law: k u holds the range of the true values with the stated probability or more, whatever they are, and the u of the law of
// propagation alone does not.
TEST(ExtremeUncertainty, CoversTheRangeOfAnyTrueValues) {
    std::mt19937_64 random(11);
    std::normal_distribution<double> deviate;
    const auto wave = [](double amplitude, std::size_t n) {
        std::vector<double> values;
        for (std::size_t i = 0; i < n; ++i) {
            values.push_back(amplitude * std::sin(2.0 * M_PI * static_cast<double>(i) / static_cast<double>(n)));
        }
        return values;
    };
    std::vector<double> two_levels(12, 10.0);
    std::fill(two_levels.begin() + 6, two_levels.end(), -10.0);
    const double k = coverage_factor(k_p, k_infinite);
    constexpr int k_trials = 300;
    double least_of_law = 1.0;
    for (const std::vector<double>& truth : {wave(0.0, 12), wave(1.0, 12), wave(4.0, 12), wave(40.0, 24), two_levels}) {
        const auto n = static_cast<Eigen::Index>(truth.size());
        const Eigen::VectorXd t = Eigen::Map<const Eigen::VectorXd>(truth.data(), n);
        // Errors that are correlated, and larger at some values than at others.
        Eigen::MatrixXd root = Eigen::MatrixXd::Constant(n, n, 0.3 / std::sqrt(static_cast<double>(n)));
        root.diagonal().array() += 0.8;
        root.row(1) *= 1.5;
        const Eigen::MatrixXd covariance = root * root.transpose();
        int held = 0;
        int held_by_law = 0;
        for (int trial = 0; trial < k_trials; ++trial) {
            const Eigen::VectorXd e = Eigen::VectorXd::NullaryExpr(n, [&] { return deviate(random); });
            const Eigen::VectorXd y = t + root * e;
            const ExtremeUncertainty found = extreme_uncertainty(range_of(y, covariance), k_p, k_infinite);
            const double error = std::abs(y.maxCoeff() - y.minCoeff() - (t.maxCoeff() - t.minCoeff()));
            held += error <= k * found.u ? 1 : 0;
            held_by_law += error <= k * found.law_u ? 1 : 0;
            ASSERT_GE(found.u, found.law_u);
        }
        // Three standard deviations of a count.
        EXPECT_GT(held, k_trials * k_p - 3.0 * std::sqrt(k_trials * k_p * (1.0 - k_p))) << n;
        least_of_law = std::min(least_of_law, static_cast<double>(held_by_law) / k_trials);
    }
    EXPECT_LT(least_of_law, 0.6);
}

TEST(StateExtreme, AddsAContributionThatMakesTheBudgetAddUp) {
    UncertaintyBudget budget;
    budget.value = Eigen::Vector2d(1.0, 2.0);
    budget.standard_uncertainty = Eigen::Vector2d(0.3, 0.4);
    budget.coverage_factor = Eigen::Vector2d(2.0, 2.0);
    budget.expanded_uncertainty = Eigen::Vector2d(0.6, 0.8);
    budget.budget.push_back(
        {.name = "noise", .variance = Eigen::Vector2d(0.09, 0.16), .share = Eigen::Vector2d(1.0, 1.0)});
    state_extreme(budget, 0, {.u = 0.3, .law_u = 0.3});
    EXPECT_EQ(budget.budget.size(), 1U);
    EXPECT_EQ(share_of_extremes(budget, 0), 0.0);
    state_extreme(budget, 0, {.u = 0.5, .law_u = 0.3});
    ASSERT_EQ(budget.budget.size(), 2U);
    EXPECT_DOUBLE_EQ(budget.standard_uncertainty[0], 0.5);
    EXPECT_DOUBLE_EQ(budget.expanded_uncertainty[0], 1.0);
    EXPECT_DOUBLE_EQ(budget.budget[0].share[0] + share_of_extremes(budget, 0), 1.0);
    EXPECT_DOUBLE_EQ(budget.budget[1].variance[0], 0.16);
    EXPECT_EQ(budget.standard_uncertainty[1], 0.4);
    EXPECT_EQ(share_of_extremes(budget, 1), 0.0);
}

}  // namespace
}  // namespace gumcert::gum
