// Monte Carlo of the median: against what is known of it, and the same bytes for any number of threads.
#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <vector>

#include "gum/comparison/reference_value.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;

constexpr double k_median_p = 0.95;

LaboratoryResults equal_results(Eigen::Index n, double x, double u) {
    return {.x = Eigen::VectorXd::Constant(n, x), .u = Eigen::VectorXd::Constant(n, u)};
}

LaboratoryResults key_comparison_of_medians() {
    return {.x = Eigen::VectorXd{{12.31, 12.18, 12.42, 12.25, 12.95, 12.05}},
            .u = Eigen::VectorXd{{0.10, 0.15, 0.20, 0.12, 0.15, 0.30}}};
}

// The variance of the median of three standard normal quantities is 1 − √3/π (order statistics of the normal
// distribution, H. L. Jones 1948). The median is symmetric about 0.
TEST(MedianTrials, MedianOfThreeNormalResults) {
    const std::size_t trials = 1'000'000;
    const MedianTrials outcome = median_trials(equal_results(3, 100.0, 0.5), trials, 7, k_median_p);
    const double u = 0.5 * std::sqrt(1.0 - std::sqrt(3.0) / 3.14159265358979323846);
    const double five_sigma = 5.0 / std::sqrt(2.0 * static_cast<double>(trials));
    EXPECT_TRUE(agrees(outcome.u, u, five_sigma));
    EXPECT_NEAR(outcome.median, 100.0, 5.0 * u / std::sqrt(static_cast<double>(trials)));
    EXPECT_EQ(outcome.trials, trials);
    // cov(x_i, median) = u²(x)/3: the median less the mean is independent of the mean, so that the three covariances,
    // equal to each other, add up to 3 u²(mean) = u²(x).
    const double u_d = std::sqrt(0.25 + u * u - 2.0 * 0.25 / 3.0);
    for (Eigen::Index i = 0; i < 3; ++i) {
        EXPECT_TRUE(agrees(outcome.u_d(i), u_d, five_sigma));
        EXPECT_NEAR(outcome.d(i), 0.0, 5.0 * u_d / std::sqrt(static_cast<double>(trials)));
        EXPECT_LT(outcome.d_low(i), 0.0);
        EXPECT_GT(outcome.d_high(i), 0.0);
    }
    // The shortest interval is about the symmetric one, ±1.96 u nearly: the median of three is nearly normal.
    EXPECT_NEAR(outcome.high - outcome.low, 2.0 * 1.96 * u, 0.03 * u);
}

TEST(MedianTrials, MedianOfTwoIsTheirMean) {
    const LaboratoryResults labs{.x = Eigen::VectorXd{{1.0, 4.0}}, .u = Eigen::VectorXd{{0.3, 0.4}}};
    const MedianTrials outcome = median_trials(labs, 400'000, 3, k_median_p);
    EXPECT_NEAR(outcome.median, 2.5, 5.0 * 0.25 / std::sqrt(4e5));
    EXPECT_TRUE(agrees(outcome.u, 0.25, 0.006));
    EXPECT_TRUE(agrees(outcome.u_d(0), 0.25, 0.006));
    EXPECT_NEAR(outcome.d(0), -1.5, 0.002);
    EXPECT_NEAR(outcome.d_high(0) - outcome.d_low(0), 2.0 * 1.959964 * 0.25, 0.005);
}

TEST(MedianTrials, FullyCorrelatedResultsMoveTogether) {
    LaboratoryResults labs = key_comparison_of_medians();
    labs.u.setConstant(0.2);
    labs.covariance = Eigen::MatrixXd::Constant(6, 6, 0.04);  // r = 1 everywhere
    const MedianTrials outcome = median_trials(labs, 100'000, 5, k_median_p);
    EXPECT_TRUE(agrees(outcome.u, 0.2, 0.012));
    EXPECT_LT(outcome.u_d.maxCoeff(), 1e-12);
    EXPECT_NEAR(outcome.d(4), 12.95 - 12.28, 1e-12);
}

TEST(MedianTrials, SameNumbersForAnyNumberOfThreads) {
    for (const bool correlated : {false, true}) {
        LaboratoryResults labs = key_comparison_of_medians();
        if (correlated) {
            labs.covariance = 0.3 * labs.u * labs.u.transpose();
            labs.covariance.diagonal() = labs.u.array().square();
        }
        const MedianTrials one = median_trials(labs, 60'001, 11, k_median_p, 1);
        for (const unsigned threads : {2u, 5u}) {
            const MedianTrials several = median_trials(labs, 60'001, 11, k_median_p, threads);
            EXPECT_EQ(one.median, several.median);
            EXPECT_EQ(one.u, several.u);
            EXPECT_EQ(one.low, several.low);
            EXPECT_EQ(one.high, several.high);
            EXPECT_EQ(one.d, several.d);
            EXPECT_EQ(one.u_d, several.u_d);
            EXPECT_EQ(one.d_low, several.d_low);
            EXPECT_EQ(one.d_high, several.d_high);
        }
        EXPECT_NE(one.median, median_trials(labs, 60'001, 12, k_median_p, 1).median);
    }
}

// Several blocks of results are needed where results times trials is large: every degree of equivalence must still
// belong to the same trials as the medians.
TEST(MedianTrials, BlocksOfResultsBelongToTheSameTrials) {
    const Eigen::Index n = 300;
    LaboratoryResults labs = equal_results(n, 0.0, 1.0);
    labs.u(0) = labs.u(n - 1) = 1e-9;  // u(d) of these is that of the median,
    labs.x(0) = -50.0;                 // which they do not touch
    labs.x(n - 1) = 50.0;
    for (const bool correlated : {false, true}) {
        if (correlated) {
            labs.covariance = labs.u.array().square().matrix().asDiagonal();
            labs.covariance(1, 2) = labs.covariance(2, 1) = 0.5;
        }
        const MedianTrials outcome = median_trials(labs, 60'000, 1, k_median_p);  // 279 results a block
        EXPECT_TRUE(agrees(outcome.u_d(0), outcome.u, 1e-6));
        EXPECT_TRUE(agrees(outcome.u_d(n - 1), outcome.u, 1e-6));
        EXPECT_NEAR(outcome.d(n - 1), 50.0 - outcome.median, 1e-9);
        EXPECT_TRUE(agrees(outcome.u, 1.2533 / std::sqrt(298.0), 0.02));  // √(π/2n) for large n
    }
}

TEST(MedianTrials, CommonOffsetCostsNoDigits) {
    LaboratoryResults near = key_comparison_of_medians();
    near.x = Eigen::VectorXd{{0.25, 0.5, 0.3125, 0.75, 0.4375, 0.625}};
    LaboratoryResults far = near;
    far.x.array() += 1073741824.0;
    const MedianTrials a = median_trials(near, 10'000, 2, k_median_p);
    const MedianTrials b = median_trials(far, 10'000, 2, k_median_p);
    EXPECT_EQ(a.u, b.u);
    EXPECT_EQ(a.d, b.d);
}

TEST(MedianTrials, RefusesTrialsThatCannotBeDone) {
    const LaboratoryResults labs = key_comparison_of_medians();
    EXPECT_EQ(code_of<InputError>([&] { (void)median_trials(labs, 999, 1, k_median_p); }), "GC-GUM-0136");
    EXPECT_EQ(code_of<InputError>([&] { (void)median_trials(labs, 10'000'001, 1, k_median_p); }), "GC-GUM-0136");
    EXPECT_EQ(code_of<InputError>([&] { (void)median_trials(equal_results(2000, 0, 1), 1'000'000, 1, k_median_p); }),
              "GC-GUM-0136");
    EXPECT_NE(test::message_of<InputError>([&] {
                  (void)median_trials(equal_results(2000, 0, 1), 1'000'000, 1, k_median_p);
              }).find("State at most 250000 trials"),
              std::string::npos);
    LaboratoryResults correlated = equal_results(100, 0.0, 1.0);
    correlated.covariance = Eigen::MatrixXd::Identity(100, 100);
    EXPECT_EQ(code_of<InputError>([&] { (void)median_trials(correlated, 1'000'000, 1, k_median_p); }), "GC-GUM-0136");
    EXPECT_EQ(code_of<InputError>([&] { (void)median_trials(labs, 10'000, 1, 1.0); }), "GC-GUM-0004");
    EXPECT_EQ(code_of<InputError>([] { (void)median_trials(equal_results(1, 0, 1), 10'000, 1, k_median_p); }),
              "GC-GUM-0131");
}

}  // namespace
}  // namespace gumcert::gum
