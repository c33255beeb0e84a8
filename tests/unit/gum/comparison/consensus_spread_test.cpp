#include "gum/comparison/consensus_spread.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "gum/comparison/random_effects.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using test::code_of;

constexpr double k_coverage = 0.9545;

LaboratoryResults five() {
    return {.x = VectorXd{{10.0, 10.3, 9.8, 10.1, 10.9}}, .u = VectorXd{{0.1, 0.2, 0.1, 0.3, 0.2}}};
}

TEST(WeightedSpread, IsThatOfTheMeanForEqualWeights) {
    const LaboratoryResults results = five();
    const ReferenceValue mean = arithmetic_mean(results.x);
    const SpreadUncertainty spread = weighted_spread(results.x, mean, k_coverage);
    EXPECT_NEAR(spread.u, mean.u, 1e-14);
    EXPECT_EQ(spread.degrees_of_freedom, 4.0);
}

TEST(WeightedSpread, IsNotBelowHartungAndKnapp) {
    const LaboratoryResults results = five();
    for (const ReferenceValue& mean : {dersimonian_laird(results), mandel_paule(results)}) {
        EXPECT_GE(weighted_spread(results.x, mean, k_coverage).u, hartung_knapp_u(results, mean) * (1.0 - 1e-12));
    }
}

TEST(WeightedSpread, ResultsThatAgreeByChanceDoNotClaimToKnow) {
    const double k = coverage_factor(k_coverage, std::numeric_limits<double>::infinity());
    for (const Index n : {2, 3, 20}) {
        const LaboratoryResults equal{.x = VectorXd::Constant(n, 5.0), .u = VectorXd::Constant(n, 0.3)};
        const ReferenceValue mean = mandel_paule(equal);
        const SpreadUncertainty spread = weighted_spread(equal.x, mean, k_coverage);
        EXPECT_NEAR(coverage_factor(k_coverage, spread.degrees_of_freedom) * spread.u, k * mean.u, 1e-12);
    }
}

TEST(WeightedSpread, OneGoodLaboratoryDoesNotHideTheScatter) {
    // The weights leave 0.99 to the first result, and the two others lie as their uncertainties let expect.
    const LaboratoryResults results{.x = VectorXd{{10.0, 11.0, 9.2}}, .u = VectorXd{{0.1, 1.0, 1.0}}};
    const ReferenceValue mean = mandel_paule(results);
    EXPECT_EQ(mean.between_standard_deviation, 0.0);
    const VectorXd w = mean.weights / mean.weights.sum();
    const double plain = std::sqrt((results.x.array() - mean.value).square().sum() / 6.0);
    const double inequality = std::sqrt(1.0 - 1.0 / (3.0 * w.squaredNorm()));
    EXPECT_NEAR(weighted_spread(results.x, mean, k_coverage).u, std::sqrt(inequality) * plain, 1e-12);
}

TEST(WeightedSpread, RefusesWhatDoesNotFit) {
    ReferenceValue mean = mandel_paule(five());
    EXPECT_EQ(code_of<InputError>([&] { (void)weighted_spread(VectorXd::Ones(3), mean, k_coverage); }), "GC-GUM-0135");
    mean.weights = VectorXd::Ones(1);
    EXPECT_EQ(code_of<InputError>([&] { (void)weighted_spread(VectorXd::Ones(1), mean, k_coverage); }), "GC-GUM-0131");
}

TEST(SpreadOfOthers, DoesNotSeeTheResultItself) {
    VectorXd x{{10.0, 10.001, 1000.0}};
    const VectorXd weights = VectorXd::Ones(3);
    const std::vector<SpreadUncertainty> others = spread_of_others(x, weights);
    ASSERT_EQ(others.size(), 3U);
    EXPECT_NEAR(others[2].u, 0.0005, 1e-12);  // half of the range of the two others
    EXPECT_EQ(others[2].degrees_of_freedom, 1.0);
    x(2) = -4e9;
    EXPECT_EQ(spread_of_others(x, weights)[2].u, others[2].u);
    EXPECT_TRUE(spread_of_others(VectorXd::Ones(2), VectorXd::Ones(2)).empty());
}

TEST(SpreadOfOthers, ManyResultsGiveTheSameOneByOneAndTogether) {
    const Index n = 2001;  // from here on by a correction of the sum
    VectorXd x(n);
    VectorXd weights(n);
    for (Index i = 0; i < n; ++i) {
        x(i) = std::sin(static_cast<double>(7 * i));
        weights(i) = 1.0 + 0.5 * std::cos(static_cast<double>(i));
    }
    const std::vector<SpreadUncertainty> all = spread_of_others(x, weights);
    for (const Index i : {Index{0}, Index{1000}, n - 1}) {
        VectorXd rest(n - 1);
        VectorXd of_rest(n - 1);
        for (Index j = 0; j < n - 1; ++j) {
            rest(j) = x(j < i ? j : j + 1);
            of_rest(j) = weights(j < i ? j : j + 1);
        }
        const double mean = rest.dot(of_rest) / of_rest.sum();
        const double square = ((rest.array() - mean).square() * of_rest.array()).sum() / of_rest.sum();
        EXPECT_NEAR(all[static_cast<std::size_t>(i)].u, std::sqrt(square / static_cast<double>(n - 2)), 1e-12);
    }
}

TEST(RobustSpread, OfTwoResultsIsThatOfTheirMean) {
    // u = |difference|/2 with one degree of freedom, whatever the method calls its scale
    const std::vector<double> two{1.0, 3.0};
    for (const RobustMean kind : {RobustMean::median, RobustMean::algorithm_a}) {
        EXPECT_NEAR(robust_spread(kind, two).u, 1.0, 1e-3);
        EXPECT_EQ(robust_spread(kind, two).degrees_of_freedom, 1.0);
    }
    EXPECT_NEAR(robust_spread(RobustMean::q_hampel, two).u, 1.0, 1e-3);
}

TEST(RobustSpread, ManyResultsTendToTheAsymptoticUncertainty) {
    std::vector<double> many;
    for (int i = 0; i < 4001; ++i) {
        many.push_back(standard_normal_quantile((i + 0.5) / 4001.0));
    }
    const double root = std::sqrt(4001.0);
    EXPECT_NEAR(robust_spread(RobustMean::median, many).u * root, 1.2533, 0.01);  // √(π/2)
    EXPECT_NEAR(robust_spread(RobustMean::algorithm_a, many).u * root, 1.018, 0.01);
    EXPECT_NEAR(robust_spread(RobustMean::q_hampel, many).u * root, 1.01, 0.02);
}

TEST(RobustSpread, LeavesOutOneByOne) {
    const std::vector<double> x{1.0, 1.2, 0.9, 1.1, 30.0};
    const std::vector<SpreadUncertainty> others = robust_spread_of_others(RobustMean::algorithm_a, x);
    const std::vector<double> without_last{1.0, 1.2, 0.9, 1.1};
    ASSERT_EQ(others.size(), 5U);
    EXPECT_EQ(others[4].u, robust_spread(RobustMean::algorithm_a, without_last).u);
    // Without a good one, the gross outlier is one of four: its scale would be that of the outlier.
    EXPECT_GT(robust_spread(RobustMean::algorithm_a, std::vector<double>{1.0, 0.9, 1.1, 30.0}).u, 1.0);
    for (const RobustMean kind : {RobustMean::median, RobustMean::algorithm_a}) {
        for (const SpreadUncertainty& spread : robust_spread_of_others(kind, x)) {
            EXPECT_LT(spread.u, 0.3);
        }
    }
    EXPECT_EQ(robust_spread(RobustMean::algorithm_a, std::vector<double>{2.0, 2.0, 2.0}).u, 0.0);
    EXPECT_EQ(code_of<InputError>([] {
                  (void)robust_spread(RobustMean::median, std::vector<double>{1.0, std::nan("")});
              }),
              "GC-GUM-0001");
}

TEST(SpreadDifference, OfAResultOutsideAndInside) {
    const SpreadUncertainty exact{.u = 0.0};
    const SpreadDifference outside = spread_difference({.u = 3.0}, {.u = 4.0}, 0.0, 0.0, 0.0, 1.0, k_coverage);
    EXPECT_NEAR(outside.u, 5.0, 1e-12);
    EXPECT_NEAR(outside.U, 5.0 * coverage_factor(k_coverage, std::numeric_limits<double>::infinity()), 1e-9);
    const SpreadDifference inside = spread_difference({.u = 3.0}, {.u = 4.0}, 0.0, 0.0, 0.25, 1.5, k_coverage);
    EXPECT_NEAR(inside.u, 0.75 * 5.0, 1e-12);
    EXPECT_NEAR(inside.U, 1.5 * 0.75 * outside.U, 1e-9);
    EXPECT_NEAR(spread_difference({.u = 3.0}, exact, 4.0, 0.0, 0.0, 1.0, k_coverage).u, 5.0, 1e-12);
    EXPECT_NEAR(spread_difference({.u = 3.0}, {.u = 4.0}, 0.0, 4.5, 0.0, 1.0, k_coverage).u, 4.0, 1e-12);
    // Welch and Satterthwaite: (9 + 16)²/(16²/2)
    EXPECT_NEAR(spread_difference({.u = 3.0}, {4.0, 2.0}, 0.0, 0.0, 0.0, 1.0, k_coverage).degrees_of_freedom,
                625.0 / 128.0, 1e-9);
}

TEST(MedianDifferenceFactor, FallsTowardsOne) {
    EXPECT_EQ(median_difference_factor(2), 1.0);
    EXPECT_NEAR(median_difference_factor(3), 1.374, 1e-12);
    EXPECT_GT(median_difference_factor(31), 1.0);
    EXPECT_NEAR(median_difference_factor(100000), 1.0, 1e-4);
}

}  // namespace
}  // namespace gumcert::gum
