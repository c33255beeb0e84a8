#include "gum/comparison/agreement.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/case_count.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using test::agrees;
using test::code_of;
using test::prints_as;

constexpr double k_p = 0.9545;

/// Differences with U = 2 u, the method with nearly all of it.
MethodDifferences differences_of(const VectorXd& d, const MatrixXd& covariance) {
    MethodDifferences differences;
    differences.d = d;
    differences.covariance = covariance;
    differences.U = 2.0 * covariance.diagonal().cwiseSqrt();
    differences.U_method = differences.U;
    differences.U_reference = 0.1 * differences.U;
    return differences;
}

MethodDifferences independent_points(Index m, double en) {
    return differences_of(VectorXd::Constant(m, 2.0 * en), MatrixXd::Identity(m, m));
}

MatrixXd equicorrelated(Index m, double r) {
    MatrixXd R = MatrixXd::Constant(m, m, r);
    R.diagonal().setOnes();
    return R;
}

/// Six points with a common and a proportional part; the numbers expected of it are from numpy and scipy.
struct Example {
    VectorXd t{{0.0, 30.0, 75.0, 120.0, 200.0, 310.0}};
    MatrixXd covariance;

    Example() {
        const VectorXd u{{0.5, 0.4, 0.6, 0.5, 0.7, 0.8}};
        covariance = 0.3 * u * u.transpose();
        covariance.diagonal() = u.cwiseAbs2();
        covariance.array() += 0.3 * 0.3;
    }
};

TEST(Agreement, IndependentPointsAreChiSquare) {
    const Agreement ten = agreement(independent_points(10, 0.15), k_p);
    EXPECT_TRUE(prints_as(ten.p_low, "1.1e-4"));
    EXPECT_TRUE(prints_as(ten.rms_en, "0.15"));
    EXPECT_NEAR(ten.p_low, ten.p_low_independent, 1e-12);
    EXPECT_NEAR(ten.p_high, ten.p_high_independent, 1e-9);
    EXPECT_DOUBLE_EQ(ten.effective_points, 10.0);
    EXPECT_TRUE(prints_as(agreement(independent_points(20, 0.15), k_p).p_low, "4e-8"));
}

TEST(Agreement, BandOfRmsEnOfIndependentPoints) {
    // sqrt(quantiles of chi-square / 4m). The lower end for m = 10 is 0.28491; tables that round it twice print 0.29.
    struct Row {
        Index m;
        const char *low, *high;
    };
    for (const Row& row : {Row{5, "0.20", "0.80"},
                           {10, "0.28", "0.72"},
                           {20, "0.35", "0.65"},
                           {30, "0.37", "0.63"},
                           {50, "0.40", "0.60"}}) {
        const Agreement of = agreement(independent_points(row.m, 0.5), k_p);
        EXPECT_TRUE(prints_as(of.rms_en_low, row.low)) << row.m;
        EXPECT_TRUE(prints_as(of.rms_en_high, row.high)) << row.m;
    }
    EXPECT_TRUE(agrees(agreement(independent_points(10, 0.5), k_p).rms_en_low, 0.28491107, 1e-7));
}

TEST(Agreement, OfCorrelatedPoints) {
    // numpy and scipy; p_low by direct quadrature of Imhof's integral.
    const Example example;
    const VectorXd d{{0.3, -0.2, 0.5, 0.1, -0.4, 0.2}};
    const Agreement of = agreement(differences_of(d, example.covariance), k_p);
    EXPECT_TRUE(agrees(of.sum_of_squared_zeta, 1.3403297921278419, 1e-12));
    EXPECT_NEAR(of.p_low, 0.058833257974563735, 1e-9);
    EXPECT_NEAR(of.p_high, 0.9411667420254363, 1e-9);
    EXPECT_NEAR(of.p_low_independent, 0.030612626717896895, 1e-12);
    EXPECT_TRUE(agrees(of.effective_points, 2.9684537771939743, 1e-12));
    EXPECT_TRUE(agrees(of.mahalanobis_square, 2.360207428368632, 1e-12));
    EXPECT_TRUE(agrees(of.p_mahalanobis, 0.8837729198532733, 1e-12));
    EXPECT_TRUE(agrees(of.vector_en, 0.4285909016262403, 1e-9));
    EXPECT_EQ(of.rank, 6U);
    EXPECT_EQ(of.beyond_covariance, 0.0);
    EXPECT_DOUBLE_EQ(of.ratio_reference, 0.1);
}

TEST(Agreement, ScoresAndLimits) {
    MethodDifferences differences = differences_of(VectorXd{{1.0, -5.0, 0.0}}, VectorXd{{1.0, 4.0, 9.0}}.asDiagonal());
    differences.U_reference = VectorXd{{6.0, 0.0, 0.0}};
    differences.U_method = VectorXd{{0.0, 4.0, 0.0}};
    const Agreement of = agreement(differences, k_p);
    EXPECT_EQ(of.count_above_1, 1U);
    EXPECT_DOUBLE_EQ(of.largest_absolute_en, 1.25);
    EXPECT_DOUBLE_EQ(of.mean_absolute_en, 1.75 / 3.0);
    EXPECT_DOUBLE_EQ(of.rms_en, std::sqrt((0.25 + 1.5625) / 3.0));
    EXPECT_DOUBLE_EQ(of.d_fail_smallest, 2.0);
    EXPECT_DOUBLE_EQ(of.d_fail_largest, 6.0);
    EXPECT_DOUBLE_EQ(of.ratio_reference, 1.5);
    differences.U_method.setZero();
    EXPECT_TRUE(std::isinf(agreement(differences, k_p).ratio_reference));
}

TEST(Agreement, OnePointIsThatOfItsScore) {
    const Agreement of = agreement(differences_of(VectorXd{{1.0}}, MatrixXd::Constant(1, 1, 0.25)), k_p);
    EXPECT_DOUBLE_EQ(of.rms_en, 1.0);
    EXPECT_NEAR(of.p_high, 0.04550026389635842, 1e-10);  // two sides of 2 standard deviations
    EXPECT_EQ(of.count_above_1, 0U);
    EXPECT_NEAR(of.vector_en, 1.0, 1e-4);  // k_p = 2.00 for p = 0.9545
}

TEST(Agreement, FullyCorrelatedPointsAreOne) {
    const Agreement of = agreement(differences_of(VectorXd::Constant(12, 0.9), equicorrelated(12, 1.0)), k_p);
    const Agreement one = agreement(differences_of(VectorXd::Constant(1, 0.9), equicorrelated(1, 1.0)), k_p);
    EXPECT_EQ(of.rank, 1U);
    EXPECT_NEAR(of.effective_points, 1.0, 1e-12);
    EXPECT_NEAR(of.p_low, one.p_low, 1e-9);
    EXPECT_NEAR(of.p_high, one.p_high, 1e-9);
    EXPECT_NEAR(of.rms_en_high, one.rms_en_high, 1e-9);
    EXPECT_NEAR(of.mahalanobis_square, 0.81, 1e-9);
    EXPECT_NEAR(of.vector_en, one.vector_en, 1e-9);
    EXPECT_NEAR(of.beyond_covariance, 0.0, 1e-9);
}

TEST(Agreement, TellsWhatASingularCovarianceDoesNotAllow) {
    // All points share everything, and yet they differ by ±1 standard uncertainty.
    const Agreement of = agreement(differences_of(VectorXd{{1.0, -1.0, 1.0, -1.0}}, equicorrelated(4, 1.0)), k_p);
    EXPECT_EQ(of.rank, 1U);
    EXPECT_NEAR(of.beyond_covariance, 2.0, 1e-12);
    EXPECT_NEAR(of.mahalanobis_square, 0.0, 1e-20);
}

TEST(Agreement, ProportionalErrorsOfUnequalSize) {
    // V = a aᵀ: singular with unequal variances, as a common scale error makes it.
    const VectorXd a{{1.0, 2.0, 3.0, 40.0}};
    const Agreement of = agreement(differences_of(0.5 * a, a * a.transpose()), k_p);
    EXPECT_EQ(of.rank, 1U);
    EXPECT_NEAR(of.mahalanobis_square, 0.25, 1e-9);
    EXPECT_NEAR(of.beyond_covariance, 0.0, 1e-7);
}

TEST(Agreement, BandWithCoverageFactorsOfTheirOwn) {
    // One point with k = 2 and one with k = 4: E_n² = Z²/4 + Z²/16, whose quantiles follow from the weights.
    MethodDifferences differences = differences_of(VectorXd{{0.5, 0.5}}, MatrixXd::Identity(2, 2));
    differences.U = VectorXd{{2.0, 4.0}};
    const Agreement of = agreement(differences, k_p);
    const std::array<double, 2> weights{0.125, 0.03125};
    EXPECT_NEAR(of.rms_en_low, std::sqrt(weighted_chi_square_quantile(weights, 0.025)), 1e-9);
    EXPECT_NEAR(of.rms_en_high, std::sqrt(weighted_chi_square_quantile(weights, 0.975)), 1e-9);
}

TEST(Agreement, PLowIsUniformForCorrelatedPointsThatFollowTheirCovariance) {
    // 200 000 sets of 10 points drawn with their covariance: 2.5 % of them below the quantile for 0.025, within 3
    // standard deviations of a binomial count (0.1 %), and so on. For the first 500 of them agreement() itself is
    // asked: its p_low and p_high decide as the quantiles do. The independent formula calls many more sets suspicious.
    constexpr int k_sets = 200000;
    constexpr int k_asked = 500;
    constexpr Index k_points = 10;
    MatrixXd covariance = equicorrelated(k_points, 0.7);
    for (Index i = 0; i < k_points; ++i) {  // standard uncertainties of 1 to 1.9
        covariance.row(i) *= 1.0 + 0.1 * static_cast<double>(i);
        covariance.col(i) *= 1.0 + 0.1 * static_cast<double>(i);
    }
    const VectorXd u = covariance.diagonal().cwiseSqrt();
    const MatrixXd root = Eigen::LLT<MatrixXd>(covariance).matrixL();
    std::vector<double> weights(k_points, 0.3);  // eigenvalues of the correlation matrix
    weights.back() = 0.3 + 0.7 * k_points;
    const double q_low = weighted_chi_square_quantile(weights, 0.025);
    const double q_half = weighted_chi_square_quantile(weights, 0.5);
    const double q_high = weighted_chi_square_quantile(weights, 0.975);

    std::mt19937_64 engine(20);
    const auto normal = [&engine] {  // Box-Muller: the same numbers with every standard library
        const double a = (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
        const double b = (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
        return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
    };
    int low = 0;
    int below_half = 0;
    int high = 0;
    int low_if_independent = 0;
    for (int set = 0; set < k_sets; ++set) {
        VectorXd z(k_points);
        for (double& one : z) {
            one = normal();
        }
        const VectorXd d = root * z;
        const double sum = d.cwiseQuotient(u).squaredNorm();
        low += sum < q_low ? 1 : 0;
        below_half += sum < q_half ? 1 : 0;
        high += sum > q_high ? 1 : 0;
        low_if_independent += sum < 3.2469727802368413 ? 1 : 0;  // 0.025 quantile of chi-square with 10 (scipy.stats)
        if (set < k_asked) {
            const Agreement of = agreement(differences_of(d, covariance), k_p);
            EXPECT_EQ(of.p_low < 0.025, sum < q_low) << set;
            EXPECT_EQ(of.p_high<0.025, sum> q_high) << set;
            EXPECT_EQ(of.p_low_independent < 0.025, sum < 3.2469727802368413) << set;
            EXPECT_EQ(of.rms_en > of.rms_en_low && of.rms_en<of.rms_en_high, sum> q_low && sum < q_high) << set;
        }
    }
    const double sigma = std::sqrt(k_sets * 0.025 * 0.975);
    EXPECT_NEAR(low, 0.025 * k_sets, 3.0 * sigma);
    EXPECT_NEAR(high, 0.025 * k_sets, 3.0 * sigma);
    EXPECT_NEAR(below_half, 0.5 * k_sets, 3.0 * std::sqrt(k_sets * 0.25));
    EXPECT_GT(low_if_independent, 0.2 * k_sets);
}

TEST(Agreement, ManyPointsOfASingularCovariance) {
    // Blocks of four points that share everything are as many points as there are blocks. Beyond 500 points the
    // pseudo-inverse is not from eigenvectors.
    constexpr Index k_blocks = 150;
    constexpr Index k_size = 4;
    constexpr Index m = k_blocks * k_size;
    MatrixXd R = MatrixXd::Zero(m, m);
    for (Index b = 0; b < k_blocks; ++b) {
        R.block(b * k_size, b * k_size, k_size, k_size).setOnes();
    }
    const Agreement many = agreement(differences_of(VectorXd::Constant(m, 0.95), R), k_p);
    const Agreement blocks = agreement(independent_points(k_blocks, 0.475), k_p);
    EXPECT_NEAR(many.effective_points, 150.0, 1e-9);
    EXPECT_NEAR(many.p_low, blocks.p_low, 1e-9);
    EXPECT_NEAR(many.p_high, blocks.p_high, 1e-9);
    EXPECT_NEAR(many.rms_en_low, blocks.rms_en_low, 1e-9);
    EXPECT_EQ(many.rank, 150U);
    EXPECT_NEAR(many.mahalanobis_square, 150.0 * 0.95 * 0.95, 1e-6);
    EXPECT_NEAR(many.beyond_covariance, 0.0, 1e-9);
}

TEST(Agreement, PseudoInverseOfManyPointsIsThatOfFew) {
    // Three smooth common effects, and differences of which a part is beyond them. 600 points, which are 300 points
    // stated twice, tell what the 300 do, whose pseudo-inverse is from eigenvectors.
    constexpr Index k_half = 300;
    const VectorXd t = VectorXd::LinSpaced(k_half, 0.0, 6.0);
    MatrixXd effects(k_half, 3);
    effects << VectorXd::Constant(k_half, 0.7), 0.5 * t, t.array().sin().matrix();
    const VectorXd d = effects * VectorXd{{0.5, -1.0, 0.8}} + 0.1 * (7.0 * t.array()).cos().matrix();
    const Agreement few = agreement(differences_of(d, effects * effects.transpose()), k_p);
    MatrixXd twice(2 * k_half, 3);
    twice << effects, effects;
    VectorXd d_twice(2 * k_half);
    d_twice << d, d;
    const Agreement many = agreement(differences_of(d_twice, twice * twice.transpose()), k_p);
    EXPECT_EQ(few.rank, 3U);
    EXPECT_EQ(many.rank, 3U);
    EXPECT_TRUE(agrees(many.mahalanobis_square, few.mahalanobis_square, 1e-7));
    EXPECT_TRUE(agrees(many.beyond_covariance, std::numbers::sqrt2 * few.beyond_covariance, 1e-7));
    EXPECT_NEAR(many.p_low, few.p_low, 1e-9);
    EXPECT_GT(few.beyond_covariance, 0.5);
}

// ---- finite degrees of freedom
// ------------------------------------------------------------------------------------------

double normal_of(std::mt19937_64& engine) {  // Box-Muller: the same numbers with every standard library
    const double a = (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
    const double b = (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53;
    return std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * std::numbers::pi * b);
}

/// Honest differences: true u of 1, each estimated with ν degrees of freedom (all at once: by one estimate).
MethodDifferences honest(std::mt19937_64& engine, Index m, int nu, double r, bool at_once) {
    VectorXd d(m);
    VectorXd u(m);
    const auto estimate = [&] {
        double sum = 0.0;
        for (int i = 0; i < nu; ++i) {
            sum += std::pow(normal_of(engine), 2);
        }
        return nu > 0 ? std::sqrt(sum / nu) : 1.0;
    };
    const double common = normal_of(engine);
    const double of_all = estimate();
    for (Index i = 0; i < m; ++i) {
        d(i) = std::sqrt(r) * common + std::sqrt(1.0 - r) * normal_of(engine);
        u(i) = at_once ? of_all : estimate();
    }
    MethodDifferences differences = differences_of(d, MatrixXd(u.asDiagonal() * equicorrelated(m, r) * u.asDiagonal()));
    const double degrees = nu > 0 ? nu : std::numeric_limits<double>::infinity();
    differences.degrees_of_freedom = VectorXd::Constant(m, degrees);
    differences.one_estimate = at_once && nu > 0;
    differences.U = coverage_factor(k_p, degrees) * u;
    return differences;
}

TEST(TestOfUncertainty, TakesThirteenToEighteenIndependentPoints) {
    // As docs/comparison_job.md tells, by the ratio of the uncertainties of reference and method.
    for (const auto& [ratio, least] : {std::pair(0.05, 13), std::pair(0.25, 15), std::pair(1.0 / 3.0, 18)}) {
        for (const Index m : {static_cast<Index>(least - 1), static_cast<Index>(least)}) {
            MethodDifferences differences = independent_points(m, 0.5);
            const double of_method = 1.0 / (1.0 + ratio * ratio);
            differences.method_covariance = of_method * differences.covariance;
            differences.reference_covariance = (1.0 - of_method) * differences.covariance;
            EXPECT_EQ(agreement(differences, k_p).power_to_confirm >= k_least_power_to_confirm, m == least)
                << ratio << " " << m;
        }
    }
}

TEST(FiniteDegrees, SumOfSquaresIsOneOfSquaredT) {
    // 4·10⁵ trials of 20 t₄: P(Σ t² ≥ 42.4) = 0.309 ± 0.001; χ² says 0.0025.
    MethodDifferences differences = independent_points(20, 0.5 * std::sqrt(42.4 / 20.0));
    EXPECT_NEAR(agreement(differences, k_p).p_high, 0.00245, 1e-5);
    differences.degrees_of_freedom = VectorXd::Constant(20, 4.0);
    const Agreement of = agreement(differences, k_p);
    EXPECT_NEAR(of.p_high, 0.3091, 0.0015);
    EXPECT_NEAR(of.p_low + of.p_high, 1.0, 1e-9);
    EXPECT_FALSE(of.is_bounded);
    EXPECT_NEAR(of.p_mahalanobis, of.p_high, 1e-12);
    EXPECT_GT(of.rms_en_high, 1.0) << "t with 4 degrees of freedom, in units of U = 2 u";
    EXPECT_NE(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
}

// The p of 200 and more points were those of an integral that had not converged: p_low of 500 points with Σζ² = 0.85 m
// was 1 (0.0004), and a difference of two such tails was a power of −0.7.
TEST(FiniteDegrees, OfManyPoints) {
    for (const Index m : {60, 200, 500, 1000, 2000}) {
        if (m > gumcert::test::cases(500, 2000)) {
            break;  // the time grows with m³
        }
        double before = 0.0;
        for (const double f : {0.8, 0.95, 1.05, 1.2}) {
            MethodDifferences differences = independent_points(m, 0.5 * std::sqrt(f));
            differences.degrees_of_freedom = VectorXd::Constant(m, 30.0);
            const Agreement of = agreement(differences, k_p);
            EXPECT_NEAR(of.p_low + of.p_high, 1.0, 1e-9) << m << " " << f;
            EXPECT_GE(of.p_low, before) << m << " " << f;
            before = of.p_low;
            EXPECT_GT(of.power_to_confirm, k_least_power_to_confirm) << m;
            EXPECT_LE(of.power_to_confirm, 0.951) << m;
            EXPECT_LT(of.p_if_too_small, 1e-3) << m;
            EXPECT_LT(of.p_if_too_large, 1e-3) << m;
            EXPECT_LT(of.rms_en_low, of.rms_en_high);
            EXPECT_NEAR(of.rms_en_low, 0.5 * std::sqrt(30.0 / 28.0),
                        2.5 * 0.5 * std::sqrt(1.2 / static_cast<double>(m)));
        }
    }
    MethodDifferences differences = independent_points(500, 0.5 * std::sqrt(0.85));
    differences.degrees_of_freedom = VectorXd::Constant(500, 30.0);
    const Agreement of = agreement(differences, k_p);
    EXPECT_NEAR(of.p_low, 4.2e-4, 0.1e-4) << "trials: 3e-4 of 10 000";
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_too_large);
}

// One estimate behind correlated points: lower limits of rms E_n for 300 points are near those of F(300, 30).
TEST(FiniteDegrees, OfManyCorrelatedPoints) {
    MethodDifferences differences = differences_of(VectorXd::Constant(300, 0.9), equicorrelated(300, 1e-6));
    differences.degrees_of_freedom = VectorXd::Constant(300, 30.0);
    const Agreement of = agreement(differences, k_p);
    EXPECT_TRUE(of.is_bounded);
    EXPECT_NEAR(of.rms_en_low, 0.39, 0.01);
    EXPECT_GE(of.p_low + of.p_high, 1.0);
    EXPECT_LE(of.p_low_least + of.p_high_least, 1.0);
    EXPECT_GE(of.power_to_confirm, 0.0);
}

TEST(FiniteDegrees, LargestByChanceIsThatOfT) {
    MethodDifferences differences = independent_points(20, 0.3);
    differences.degrees_of_freedom = VectorXd::Constant(20, 4.0);
    const double k = coverage_factor(k_p, 4.0);
    differences.U = VectorXd::Constant(20, k);
    EXPECT_NEAR(agreement(differences, k_p).largest_en_by_chance, coverage_factor(std::pow(0.99, 1.0 / 20.0), 4.0) / k,
                1e-9);
    EXPECT_NEAR(agreement(differences, k_p).found_with_95_percent, k + 2.1318468, 1e-6);  // t_0.95(4)
}

TEST(FiniteDegrees, MeetCorrelationsInBounds) {
    MethodDifferences differences = differences_of(VectorXd::Constant(10, 1.8), equicorrelated(10, 0.3));
    differences.degrees_of_freedom = VectorXd::Constant(10, 4.0);
    const Agreement of = agreement(differences, k_p);
    EXPECT_TRUE(of.is_bounded);
    EXPECT_LT(of.p_high_least, 0.025);
    EXPECT_GT(of.p_high, 0.025);
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::joint_test_open);
    differences.degrees_of_freedom.setConstant(1e7);  // nothing is left open
    const Agreement many = agreement(differences, k_p);
    differences.degrees_of_freedom.resize(0);
    const Agreement infinite = agreement(differences, k_p);
    EXPECT_NEAR(many.p_low_least, std::min(infinite.p_low, chi_square_lower_tail(32.4, 10.0)), 1e-6);
    EXPECT_NEAR(many.p_high, infinite.p_high, 1e-6);
}

/// The law: whatever the degrees of freedom, the correlations and the way of estimation, honest comparisons are called a
/// disagreement no more often than the limits say: 2.5 % by the sum, 1 % each by the largest |E_n|, the pattern and
/// the bias.
TEST(FiniteDegrees, HonestComparisonsDisagreeAtTheLevel) {
    constexpr double k_level = 0.055;
    std::mt19937_64 engine(5);
    for (const int nu : {3, 4, 10, 50, 0}) {
        for (const double r : {0.0, 0.5}) {
            for (const bool at_once : {false, true}) {
                if (nu == 0 && at_once) {
                    continue;
                }
                const Index m = nu % 4 == 0 ? 20 : 8;
                const VectorXd t = VectorXd::LinSpaced(m, 0.0, 100.0);
                const bool is_exact = nu == 0 || (r == 0.0 && !at_once);  // bounds take longer, and leave room
                const int runs = is_exact ? gumcert::test::cases(80, 200) : gumcert::test::cases(16, 40);
                int disagreements = 0;
                for (int run = 0; run < runs; ++run) {
                    const MethodDifferences of = honest(engine, m, nu, r, at_once);
                    disagreements += agreement_verdict(agreement(of, k_p), std::nullopt, bias_test(of, t, {})) ==
                                             AgreementVerdict::disagreement
                                         ? 1
                                         : 0;
                }
                EXPECT_LE(disagreements, runs * k_level + 3.0 * std::sqrt(runs * k_level))
                    << "nu " << nu << ", r " << r << ", one estimate " << at_once;
            }
        }
    }
}

// 30 points tell a right U from one that is wrong by a factor of 2, where it has many degrees of freedom; with ν = 3 of
// each they do not, and no more points are what is missing.
TEST(FiniteDegrees, LimitThePowerAndNotTheNumberOfPoints) {
    const auto of = [](Index m, double nu) {
        MethodDifferences differences = independent_points(m, 0.5);
        differences.degrees_of_freedom = VectorXd::Constant(m, nu);
        return agreement(differences, k_p);
    };
    const Agreement few_degrees = of(30, 3.0);
    EXPECT_LT(few_degrees.power_to_confirm, k_least_power_to_confirm);
    EXPECT_TRUE(few_degrees.power_lacks_degrees);
    const Agreement few_points = of(5, 3.0);
    EXPECT_FALSE(few_points.power_lacks_degrees);
    EXPECT_FALSE(of(5, std::numeric_limits<double>::infinity()).power_lacks_degrees);
    EXPECT_FALSE(of(30, 1e6).power_lacks_degrees);
}

// ---- pattern and bias
// ------------------------------------------------------------------------------------------

TEST(Pattern, RefutesWhatTheSumOfSquaresDoesNotSee) {
    // Pairs of points with r = 0.95 that differ in opposite senses.
    const Index m = 40;
    MatrixXd R = MatrixXd::Identity(m, m);
    VectorXd d(m);
    for (Index i = 0; i < m; i += 2) {
        R(i, i + 1) = R(i + 1, i) = 0.95;
        d(i) = 0.9;
        d(i + 1) = -0.9;
    }
    const Agreement of = agreement(differences_of(d, R), k_p);
    EXPECT_GT(of.p_high, 0.025);
    EXPECT_LT(of.p_mahalanobis, 1e-30);
    EXPECT_TRUE(is_refuted_pattern(of));
    EXPECT_FALSE(is_too_large(of));
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
}

TEST(Pattern, RoundingOfStatedNumbersRefutesNothing) {
    // 12 points that share all but 1 % of u: values that are rounded by 4 % of u differ by more than that.
    const Index m = 12;
    VectorXd d = VectorXd::Constant(m, 0.4);
    for (Index i = 0; i < m; ++i) {
        d(i) += i % 2 == 0 ? 0.04 : -0.04;
    }
    const Agreement of = agreement(differences_of(d, equicorrelated(m, 1.0 - 1e-4)), k_p);
    EXPECT_LT(of.p_mahalanobis, 0.01);
    EXPECT_FALSE(is_refuted_pattern(of));
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::joint_test_open);
    // The same of points that share everything: the pseudo-inverse does not see it.
    EXPECT_FALSE(is_refuted_pattern(agreement(differences_of(d, equicorrelated(m, 1.0)), k_p)));
    const VectorXd larger = (10.0 * (d.array() - 0.4)).matrix();
    EXPECT_TRUE(is_refuted_pattern(agreement(differences_of(larger, equicorrelated(m, 1.0)), k_p)));
}

TEST(BiasTest, AConstantOfOneStandardUncertaintyIsNoChance) {
    const VectorXd t = VectorXd::LinSpaced(20, 0.0, 100.0);
    const MethodDifferences differences = differences_of(VectorXd::Ones(20), MatrixXd::Identity(20, 20));
    const BiasTest both = bias_test(differences, t, {}).value();
    EXPECT_EQ(both.degrees_of_freedom, 2);
    EXPECT_NEAR(both.p, std::exp(-10.0), 1e-12);  // χ² = 20 with 2 degrees of freedom
    EXPECT_EQ(both.p_least, both.p);
    EXPECT_EQ(agreement_verdict(agreement(differences, k_p), std::nullopt, both), AgreementVerdict::disagreement);
    EXPECT_NE(agreement_verdict(agreement(differences, k_p), std::nullopt), AgreementVerdict::disagreement);
    EXPECT_NEAR(bias_test(differences, t, {.slope = false}).value().p, chi_square_upper_tail(20.0, 1.0), 1e-15);
    EXPECT_NEAR(bias_test(differences, t, {.constant = false}).value().p, 1.0, 1e-9);
    EXPECT_FALSE(bias_test(differences, t, {.constant = false, .slope = false}));
    EXPECT_FALSE(bias_test(differences, VectorXd::Ones(20), {}));
}

TEST(BiasTest, ASlopeThatTheReferenceMakesIsNoEvidence) {
    const VectorXd t = VectorXd::LinSpaced(20, -1.0, 1.0);
    const MethodDifferences differences = differences_of(2.0 * t, MatrixXd::Identity(20, 20));
    EXPECT_LT(bias_test(differences, t, {}).value().p, 0.01);
    EXPECT_NEAR(bias_test(differences, t, {.slope_of_noise = 2.0}).value().p, 1.0, 1e-9);
    EXPECT_NEAR(bias_test(differences, t, {.slope_of_noise = 9.0}).value().p, 1.0, 1e-9);
    EXPECT_LT(bias_test(differences, t, {.slope_of_noise = -2.0}).value().p, 0.01);
}

TEST(Agreement, Refusals) {
    const auto code = [](const MethodDifferences& differences) {
        return code_of<InputError>([&] { (void)agreement(differences, k_p); });
    };
    EXPECT_EQ(code({}), "GC-GUM-0032");
    const MethodDifferences good = independent_points(3, 0.5);
    MethodDifferences bad = good;
    bad.U.resize(2);
    EXPECT_EQ(code(bad), "GC-GUM-0135");
    bad = good;
    bad.d(1) = std::nan("");
    EXPECT_EQ(code(bad), "GC-GUM-0001");
    bad = good;
    bad.covariance(1, 1) = 0.0;
    EXPECT_EQ(code(bad), "GC-GUM-0031");
    bad = good;
    bad.U(2) = 0.0;
    EXPECT_EQ(code(bad), "GC-GUM-0031");
    bad = good;
    bad.degrees_of_freedom = VectorXd{{4.0, 0.0, 4.0}};
    EXPECT_EQ(code(bad), "GC-GUM-0005");
    bad.degrees_of_freedom.resize(2);
    EXPECT_EQ(code(bad), "GC-GUM-0135");
    bad = good;
    bad.covariance(0, 1) = 0.3;
    EXPECT_EQ(code(bad), "GC-GUM-0052");
    bad = good;
    bad.covariance(0, 1) = bad.covariance(1, 0) = 1.1;
    EXPECT_EQ(code(bad), "GC-GUM-0053");
    bad = good;
    bad.covariance = equicorrelated(3, -0.6);
    EXPECT_EQ(code(bad), "GC-GUM-0054");
    EXPECT_EQ(code_of<InputError>([&] { (void)agreement(good, 1.0); }), "GC-GUM-0004");
    EXPECT_EQ(code(independent_points(static_cast<Index>(k_most_points_of_agreement) + 1, 0.5)), "GC-GUM-0141");
}

TEST(BiasLine, GeneralisedLeastSquares) {
    // numpy: (XᵀV⁻¹X)⁻¹XᵀV⁻¹d with t centred on its mean; p of scipy.stats.chi2 with 4 degrees of freedom.
    const Example example;
    const VectorXd d{{1.2, 0.7, 2.9, 2.1, 4.4, 5.0}};
    const std::optional<BiasLine> line = bias_line(differences_of(d, example.covariance), example.t);
    ASSERT_TRUE(line);
    EXPECT_EQ(line->centre, 122.5);
    EXPECT_TRUE(agrees(line->constant, 2.4215123955990054, 1e-12));
    EXPECT_TRUE(agrees(line->slope, 0.01426631892902952, 1e-12));
    EXPECT_TRUE(agrees(line->u_constant, 0.472483469009785, 1e-12));
    EXPECT_TRUE(agrees(line->u_slope, 0.002187728821066225, 1e-12));
    EXPECT_TRUE(agrees(line->covariance, 0.0003515769684302951, 1e-10));
    EXPECT_TRUE(agrees(line->chi_square, 9.94020720141913, 1e-12));
    EXPECT_TRUE(agrees(line->p_value, 0.04144701891949258, 1e-12));
}

TEST(BiasLine, KeepsItsDigitsFarFromTheOrigin) {
    const Example example;
    const VectorXd d = 0.5 + 0.01 * (example.t.array() - 122.5);
    const VectorXd far = example.t.array() + 1e9;
    const std::optional<BiasLine> line = bias_line(differences_of(d, example.covariance), far);
    ASSERT_TRUE(line);
    EXPECT_NEAR(line->constant, 0.5, 1e-9);
    EXPECT_NEAR(line->slope, 0.01, 1e-11);
    EXPECT_NEAR(line->chi_square, 0.0, 1e-12);
}

TEST(BiasLine, OfPointsThatShareAConstantAndAScale) {
    // Everything is common: nothing can be told of a slope beside two free directions.
    const Example example;
    const MatrixXd common = MatrixXd::Constant(6, 6, 0.04) + 1e-4 * example.t * example.t.transpose();
    EXPECT_FALSE(bias_line(differences_of(VectorXd::Ones(6), common), example.t));
    // A third direction makes a line with one degree of freedom; the constant cannot be known better than its u.
    const VectorXd bend{{1.0, -1.0, 0.5, -0.5, 0.2, -0.3}};
    const std::optional<BiasLine> line =
        bias_line(differences_of(VectorXd::Ones(6), common + bend * bend.transpose()), example.t);
    ASSERT_TRUE(line);
    EXPECT_TRUE(std::isfinite(line->u_slope));
    EXPECT_GT(line->u_constant, 0.1);
}

TEST(BiasLine, NeedsThreePointsAtDifferentPlaces) {
    EXPECT_FALSE(bias_line(independent_points(2, 0.5), VectorXd{{1.0, 2.0}}));
    EXPECT_FALSE(bias_line(independent_points(3, 0.5), VectorXd::Constant(3, 7.0)));
    EXPECT_FALSE(bias_line(differences_of(VectorXd::Ones(3), equicorrelated(3, 1.0)), VectorXd{{1.0, 2.0, 3.0}}));
    EXPECT_TRUE(bias_line(independent_points(3, 0.5), VectorXd{{1.0, 2.0, 2.0}}));
    EXPECT_EQ(code_of<InputError>([] { (void)bias_line(independent_points(3, 0.5), VectorXd{{1.0}}); }), "GC-GUM-0135");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)bias_line(independent_points(3, 0.5), VectorXd{{1.0, 2.0, std::nan("")}});
              }),
              "GC-GUM-0001");
}

TEST(VectorEn, OfOneQuantityIsEn) {
    const ComparisonScore one = score({1.0, 0.3, 0.6}, {0.4, 0.2, 0.4});
    const double of_vector = vector_en(VectorXd{{one.difference}},
                                       MatrixXd::Constant(1, 1, std::pow(one.u_difference, 2)), 0.95449973610364);
    EXPECT_NEAR(of_vector, std::abs(one.en), 1e-9);  // k = 2
}

TEST(VectorEn, SeesWhatTheScoresApartDoNot) {
    // Two quantities with r = 0.95 that differ in opposite senses: every E_n is 0.6, the vector is far outside.
    const VectorXd d{{1.2, -1.2}};
    const double of_vector = vector_en(d, equicorrelated(2, 0.95), k_p);
    // dᵀV⁻¹d = 2·1.44/(1 − 0.95); k_p² = −2 ln(1 − p)
    EXPECT_NEAR(of_vector, std::sqrt(2.88 / 0.05 / (-2.0 * std::log(1.0 - k_p))), 1e-9);
    EXPECT_GT(of_vector, 3.0);
    EXPECT_LT(vector_en(VectorXd{{1.2, 1.2}}, equicorrelated(2, 0.95), k_p), 0.6);
}

TEST(VectorEn, Refusals) {
    EXPECT_EQ(code_of<InputError>([] {
                  (void)vector_en(VectorXd{{1.0, 1.0}}, equicorrelated(2, 1.0), k_p);
              }),
              "GC-GUM-0031");
    EXPECT_EQ(code_of<InputError>([] { (void)vector_en(VectorXd{{1.0}}, equicorrelated(2, 0.5), k_p); }),
              "GC-GUM-0135");
    EXPECT_EQ(code_of<InputError>([] { (void)vector_en(VectorXd(), MatrixXd(), k_p); }), "GC-GUM-0135");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)vector_en(VectorXd{{1.0, 1.0}}, equicorrelated(2, -1.2), k_p);
              }),
              "GC-GUM-0053");
}

// ---- verdict, one rule each
// ------------------------------------------------------------------------------------------

Agreement sound() {
    Agreement of;
    of.p_low = 0.5;
    of.p_high = 0.5;
    of.p_mahalanobis = of.p_pattern = 0.5;
    of.effective_points = 20.0;
    of.power_to_confirm = 0.95;
    of.p_if_too_small = of.p_if_too_large = 0.01;
    of.largest_en_by_chance = 1.4;
    of.ratio_reference = 0.2;
    return of;
}

TEST(Verdict, NothingObjectsToIt) {
    EXPECT_EQ(agreement_verdict(sound(), std::nullopt), AgreementVerdict::validated);
    EXPECT_EQ(agreement_verdict(sound(), 1.0), AgreementVerdict::validated);
    Agreement at_the_limits = sound();
    at_the_limits.p_low = at_the_limits.p_high = 0.025;
    at_the_limits.ratio_reference = 1.0 / 3.0;
    at_the_limits.power_to_confirm = 0.92;
    at_the_limits.p_if_too_small = at_the_limits.p_if_too_large = 0.05;
    at_the_limits.count_above_1 = at_the_limits.count_by_chance = 3;
    EXPECT_EQ(agreement_verdict(at_the_limits, std::nullopt), AgreementVerdict::validated);
}

TEST(Verdict, APointAboveWhatChanceMakesIsDisagreement) {
    Agreement of = sound();
    of.count_above_1 = 1;
    of.largest_absolute_en = 1.4;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::points_above_1);
    of.largest_absolute_en = 1.401;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
}

TEST(Verdict, ASinglePointAbove1IsDisagreement) {
    MethodDifferences one{.d = VectorXd{{1.0}},
                          .covariance = MatrixXd{{0.25}},
                          .U = VectorXd{{1.0}},
                          .U_method = VectorXd{{1.0}},
                          .U_reference = VectorXd{{0.1}}};
    EXPECT_EQ(agreement(one, k_p).largest_en_by_chance, 1.0);
    EXPECT_EQ(agreement_verdict(agreement(one, k_p), std::nullopt), AgreementVerdict::agreement_few_points);
    one.d(0) = 1.0001;  // p_high of a point at the limit is 0.0455
    EXPECT_EQ(agreement_verdict(agreement(one, k_p), std::nullopt), AgreementVerdict::disagreement);
}

TEST(Verdict, FewPointsConfirmNoUncertainty) {
    Agreement of = sound();
    of.power_to_confirm = 0.919;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::agreement_few_points);
    of.ratio_reference = 0.5;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::agreement_few_points);
    of.p_low = 0.01;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_too_large);
}

TEST(Verdict, AnUncertaintyThatIsWrongByAFactorOfTwoMustBeRefuted) {
    Agreement of = sound();
    of.p_if_too_small = 0.0501;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_not_confirmed);
    of = sound();
    of.p_if_too_large = 0.0501;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_not_confirmed);
    of.ratio_reference = 0.5;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_not_confirmed);
}

TEST(Verdict, PowerOfIndependentPoints) {
    // P(max(q_.025, q_.95/4) <= chi-square <= min(q_.975, 4 q_.05)) from tables of chi-square, a negligible reference
    const auto power = [](Index m) {
        MethodDifferences of{.d = VectorXd::Ones(m),
                             .covariance = MatrixXd::Identity(m, m),
                             .U = VectorXd::Constant(m, 2.0),
                             .U_method = VectorXd::Constant(m, 2.0),
                             .U_reference = VectorXd::Zero(m)};
        return agreement(of, k_p).power_to_confirm;
    };
    EXPECT_NEAR(power(5), 0.266, 0.002);  // 2.768 to 4.582
    EXPECT_LT(power(12), 0.92);
    EXPECT_GT(power(14), 0.92);
    EXPECT_NEAR(power(100), 0.95, 1e-6);
}

TEST(Verdict, WhatTheReferenceContributesIsNotScaled) {
    const Index m = 10;
    MethodDifferences of{.d = VectorXd::Ones(m),
                         .covariance = 2.0 * MatrixXd::Identity(m, m),
                         .U = VectorXd::Constant(m, 2.0 * std::numbers::sqrt2),
                         .U_method = VectorXd::Constant(m, 2.0),
                         .U_reference = VectorXd::Constant(m, 2.0)};
    const double all = agreement(of, k_p).p_if_too_small;
    of.method_covariance = MatrixXd::Identity(m, m);
    of.reference_covariance = MatrixXd::Identity(m, m);
    // true variance 4 + 1 in place of 2: sum of zeta^2 is 5 = 2.5 times a chi-square of 2
    const Agreement found = agreement(of, k_p);
    EXPECT_NEAR(found.p_if_too_small, chi_square_lower_tail(2.0, 10.0), 1e-9);
    EXPECT_NEAR(found.p_if_too_large, chi_square_upper_tail(8.0, 10.0), 1e-9);  // 0.25 + 1 in place of 2
    EXPECT_GT(found.p_if_too_small, all);
}

TEST(Verdict, WhatIsFoundWithAProbability) {
    const MethodDifferences one{.d = VectorXd{{0.1}},
                                .covariance = MatrixXd{{1.0}},
                                .U = VectorXd{{2.0}},
                                .U_method = VectorXd{{2.0}},
                                .U_reference = VectorXd{{0.0}}};
    const Agreement found = agreement(one, k_p);
    EXPECT_NEAR(found.found_with_80_percent, 2.0 + 0.8416212, 1e-6);
    EXPECT_NEAR(found.found_with_95_percent, 2.0 + 1.6448536, 1e-6);
}

TEST(CountByChance, QuantileOfTheBinomialDistribution) {
    EXPECT_EQ(count_above_1_by_chance(1, 1.0, k_p), 0U);
    EXPECT_EQ(count_above_1_by_chance(36, 36.0, k_p), 5U);  // P(6 or more of 36) = 0.006, 5 or more 0.025
    EXPECT_EQ(count_above_1_by_chance(36, 1.0, k_p), 36U);  // one proof in 36 pieces: all or none
    EXPECT_EQ(code_of<InputError>([] { (void)count_above_1_by_chance(0, 1.0, k_p); }), "GC-GUM-0032");
}

TEST(LargestByChance, SidakLimitOfIndependentPoints) {
    // scipy: norm.isf(a/2) / norm.isf((1 - p)/2) with a = -expm1(log(p)/n)
    EXPECT_EQ(largest_en_by_chance(1, 0.9545), 1.0);
    EXPECT_NEAR(largest_en_by_chance(2, 0.9545), 1.13659270797793, 1e-11);
    EXPECT_NEAR(largest_en_by_chance(36, 0.9545), 1.60879474900853, 1e-11);
    EXPECT_NEAR(largest_en_by_chance(3000, 0.9545), 2.16056799603327, 1e-11);
    EXPECT_NEAR(largest_en_by_chance(10, 0.99), 1.2769694287835, 1e-11);
}

TEST(LargestByChance, RefusesWhatIsNoNumber) {
    EXPECT_EQ(code_of<InputError>([] { (void)largest_en_by_chance(0, k_p); }), "GC-GUM-0032");
    EXPECT_EQ(code_of<InputError>([] { (void)largest_en_by_chance(3, 1.0); }), "GC-GUM-0004");
}

TEST(LargestByChance, HoldsForCorrelatedPointsToo) {
    const Index m = 36;
    const MethodDifferences differences{.d = VectorXd::Constant(m, 0.3),
                                        .covariance = equicorrelated(m, 0.5),
                                        .U = VectorXd::Constant(m, 2.0),
                                        .U_method = VectorXd::Constant(m, 2.0),
                                        .U_reference = VectorXd::Constant(m, 0.1)};
    const Agreement of = agreement(differences, k_p);
    EXPECT_NEAR(of.effective_points, 36.0 * 36.0 / (36.0 + 36.0 * 35.0 * 0.25), 1e-12);
    // scipy: norm.isf(a/2) / norm.isf((1 - p)/2) with a = -expm1(log(0.99)/36)
    EXPECT_NEAR(of.largest_en_by_chance, largest_en_by_chance(36, 0.99) * 2.5758293035489 / 2.0, 2e-4);
}

TEST(Verdict, DifferencesTooLargeTogetherAreDisagreement) {
    Agreement of = sound();
    of.p_high = 0.0249;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
}

TEST(Verdict, UnknownCorrelationThatCouldHideAFailure) {
    EXPECT_EQ(agreement_verdict(sound(), 1.001), AgreementVerdict::correlation_unknown);
    EXPECT_EQ(agreement_verdict(sound(), std::numeric_limits<double>::infinity()),
              AgreementVerdict::correlation_unknown);
}

TEST(Verdict, ReferenceNotBetterThanTheMethod) {
    Agreement of = sound();
    of.ratio_reference = 1.0;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::reference_not_better);
    of.ratio_reference = std::numeric_limits<double>::infinity();
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::reference_not_better);
}

TEST(Verdict, UncertaintyTooLarge) {
    Agreement of = sound();
    of.p_low = 0.0249;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_too_large);
}

TEST(Verdict, ReferenceAboveAThird) {
    Agreement of = sound();
    of.ratio_reference = 0.34;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::agreement_reference_limited);
}

TEST(Verdict, TheStrongestObjectionIsStated) {
    Agreement of = sound();
    of.ratio_reference = 2.0;
    of.p_low = 0.0;
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::reference_not_better);
    EXPECT_EQ(agreement_verdict(of, 3.0), AgreementVerdict::correlation_unknown);
    of.count_above_1 = 2;
    EXPECT_EQ(agreement_verdict(of, 3.0), AgreementVerdict::points_above_1);
    of.p_high = 0.01;
    EXPECT_EQ(agreement_verdict(of, 3.0), AgreementVerdict::disagreement);
}

TEST(Verdict, WhatOneBoundRefutesIsOpen) {
    for (double Agreement::*p : {&Agreement::p_low_least, &Agreement::p_high_least, &Agreement::p_mahalanobis_least}) {
        Agreement of = sound();
        of.*p = 0.009;
        EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::joint_test_open);
        of.p_high = 0.01;
        EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
    }
    EXPECT_EQ(agreement_verdict(sound(), std::nullopt, BiasTest{.p = 0.02, .p_least = 0.009}),
              AgreementVerdict::joint_test_open);
    EXPECT_EQ(agreement_verdict(sound(), std::nullopt, BiasTest{.p = 0.02, .p_least = 0.02}),
              AgreementVerdict::validated);
}

TEST(Verdict, NumbersThatAreNoneNeverPass) {
    Agreement of = sound();
    of.p_pattern = std::nan("");
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
    of = sound();
    of.p_if_too_large = std::nan("");
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_not_confirmed);
    of.power_to_confirm = std::nan("");
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::agreement_few_points);
    of.p_low = std::nan("");
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::uncertainty_too_large);
    of.ratio_reference = std::nan("");
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::reference_not_better);
    of.largest_absolute_en = std::nan("");
    EXPECT_EQ(agreement_verdict(of, std::nullopt), AgreementVerdict::disagreement);
}

}  // namespace
}  // namespace gumcert::gum
