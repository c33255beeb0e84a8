#include "gum/monte_carlo/random_draws.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::message_of;

Distribution standard(DistributionKind kind, double shape = 0.0, double second_shape = 0.0) {
    return {.kind = kind, .scale = 1.0, .shape = shape, .second_shape = second_shape};
}

InputGroup independent(const std::vector<Distribution>& marginals) {
    InputGroup group;
    group.name = "x";
    group.value = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(marginals.size()));
    group.covariance = Eigen::MatrixXd::Ones(group.value.size(), 1);
    group.marginals = marginals;
    return group;
}

InputGroup correlated(const std::vector<Distribution>& marginals, double r, Dependence dependence) {
    InputGroup group = independent(marginals);
    group.covariance = Eigen::MatrixXd::Constant(group.value.size(), group.value.size(), r);
    group.covariance.diagonal().setOnes();
    group.dependence = dependence;
    return group;
}

Eigen::MatrixXd draw(const std::vector<InputGroup>& groups, Eigen::Index trials, std::uint64_t seed = 1,
                     std::uint64_t first = 0) {
    const InputDraws draws(groups, seed, {});
    Eigen::MatrixXd x(trials, draws.size());
    draws.draw(first, x);
    return x;
}

double correlation(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
    const Eigen::VectorXd da = a.array() - a.mean();
    const Eigen::VectorXd db = b.array() - b.mean();
    return da.dot(db) / (da.norm() * db.norm());
}

// Known answers that come with Random123 (kat_vectors).
TEST(Philox, KnownAnswers) {
    EXPECT_EQ(
        philox_4x64_10({0, 0}, {0, 0, 0, 0}),
        (std::array<std::uint64_t, 4>{0x16554d9eca36314c, 0xdb20fe9d672d0fdc, 0xd7e772cee186176b, 0x7e68b68aec7ba23b}));
    constexpr std::uint64_t ones = ~std::uint64_t{0};
    EXPECT_EQ(
        philox_4x64_10({ones, ones}, {ones, ones, ones, ones}),
        (std::array<std::uint64_t, 4>{0x87b092c3013fe90b, 0x438c3c67be8d0224, 0x9cc7d7c69cd777b6, 0xa09caebf594f0ba0}));
}

// The draws are those of the counters that the header promises: half of a word a trial, eight trials a counter.
TEST(Philox, CountersOfTheDraws) {
    InputGroup group = independent({Distribution::uniform(0.0, 1.0), Distribution::uniform(0.0, 1.0)});
    const std::vector<std::uint64_t> streams{77};
    const InputDraws draws({group}, 42, streams);
    Eigen::MatrixXd x(50, 2);
    draws.draw(13, x);
    for (Eigen::Index i = 0; i < x.rows(); ++i) {
        const std::uint64_t trial = 13 + static_cast<std::uint64_t>(i);
        for (Eigen::Index j = 0; j < 2; ++j) {
            const auto words = philox_4x64_10({42, 77}, {trial / 8, static_cast<std::uint64_t>(j), 0, 0});
            const auto word = static_cast<std::uint32_t>(words[trial % 8 / 2] >> (trial % 2 * 32));
            const double q = ((word & 0x7FFFFFFFU) + 0.5) * 0x1p-32;
            EXPECT_EQ(x(i, j), (word & 0x80000000U) != 0 ? 1.0 - 2.0 * q : 2.0 * q - 1.0);
        }
    }
}

TEST(RandomDraws, RangesOfTrialsFitTogether) {
    const std::vector<InputGroup> groups{
        independent({Distribution::normal(0.0, 1.0), standard(DistributionKind::gamma, 3.0)}),
        correlated({Distribution::student_t(0.0, 1.0, 4.0), Distribution::student_t(0.0, 1.0, 4.0)}, 0.5,
                   Dependence::student_t)};
    const Eigen::MatrixXd all = draw(groups, 3000);
    for (const Eigen::Index first : {0, 1, 7, 8, 511, 1030}) {
        for (const Eigen::Index count : {1, 3, 8, 515}) {
            EXPECT_EQ(draw(groups, count, 1, static_cast<std::uint64_t>(first)), all.middleRows(first, count))
                << first << " " << count;
        }
    }
}

// Relative error of the cubic pieces, and monotone draws from cell to cell.
TEST(RandomDraws, TablesFollowTheQuantiles) {
    for (const Distribution& distribution :
         {standard(DistributionKind::normal), standard(DistributionKind::triangular),
          standard(DistributionKind::arcsine), standard(DistributionKind::trapezoidal, 0.33),
          standard(DistributionKind::curvilinear_trapezoid, 0.1),
          standard(DistributionKind::curvilinear_trapezoid, 0.5), standard(DistributionKind::student_t, 1.0),
          standard(DistributionKind::student_t, 5.0), standard(DistributionKind::student_t, 100.0),
          standard(DistributionKind::gamma, 0.3), standard(DistributionKind::gamma, 8.0),
          standard(DistributionKind::exponential), standard(DistributionKind::lognormal, 0.5),
          standard(DistributionKind::beta, 2.0, 5.0), standard(DistributionKind::beta, 0.5, 0.5)}) {
        const QuantileTable table(distribution);
        const double floor = table.is_symmetric() ? 0.1 : 0.0;
        double left_out = 0.0;
        for (const bool upper : {false, true}) {
            double before = std::numeric_limits<double>::quiet_NaN();
            for (int octave = -13; octave <= -2; ++octave) {
                for (int i = 0; i < 200; ++i) {
                    const double q = std::ldexp(1.0 + (i + 0.37) / 200.0, octave);
                    const double x = table.tabulated(q * 0x1p32, upper);
                    const double exact = table.exact(q, upper);
                    if (std::isnan(x)) {
                        left_out += std::ldexp(1.0 / 200.0, octave);
                    } else {
                        ASSERT_LE(std::abs(x - exact), 1e-9 * std::max(std::abs(exact), floor))
                            << distribution_name(distribution.kind) << " " << distribution.shape << " q " << q;
                        ASSERT_FALSE(upper ? x >= before : x <= before);
                        before = x;
                    }
                }
            }
        }
        EXPECT_LT(left_out, 0.02) << distribution_name(distribution.kind) << " " << distribution.shape;
    }
}

// Chi-square goodness of fit with 200 classes of equal probability.
TEST(RandomDraws, FollowTheirDistributions) {
    constexpr Eigen::Index trials = 100'000;
    constexpr int classes = 200;
    const auto samples = std::make_shared<const std::vector<double>>(std::vector{-2.0, 0.0, 0.5, 4.0});
    std::vector<Distribution> distributions{Distribution::normal(3.0, 0.1),
                                            Distribution::uniform(-5.0, 2.0),
                                            standard(DistributionKind::triangular),
                                            standard(DistributionKind::arcsine),
                                            standard(DistributionKind::trapezoidal, 0.33),
                                            standard(DistributionKind::trapezoidal, 0.0),
                                            standard(DistributionKind::trapezoidal, 1.0),
                                            standard(DistributionKind::curvilinear_trapezoid, 0.0),
                                            standard(DistributionKind::curvilinear_trapezoid, 0.1),
                                            standard(DistributionKind::curvilinear_trapezoid, 0.5),
                                            standard(DistributionKind::curvilinear_trapezoid, 1.0),
                                            Distribution::student_t(1.0, 2.0, 5.0),
                                            Distribution::student_t(0.0, 1.0, 0.7),
                                            standard(DistributionKind::gamma, 8.0),
                                            standard(DistributionKind::gamma, 0.3),
                                            standard(DistributionKind::exponential),
                                            standard(DistributionKind::lognormal, 0.5),
                                            standard(DistributionKind::beta, 2.0, 5.0),
                                            standard(DistributionKind::beta, 0.5, 0.5)};
    const Eigen::MatrixXd x = draw({independent(distributions)}, trials, 7);
    for (std::size_t j = 0; j < distributions.size(); ++j) {
        std::vector<double> counts(classes, 0.0);
        for (Eigen::Index i = 0; i < trials; ++i) {
            const double p = lower_tail_probability(distributions[j], x(i, static_cast<Eigen::Index>(j)));
            counts[static_cast<std::size_t>(std::min(static_cast<int>(p * classes), classes - 1))] += 1.0;
        }
        double chi_square = 0.0;
        const double expected = static_cast<double>(trials) / classes;
        for (const double count : counts) {
            chi_square += (count - expected) * (count - expected) / expected;
        }
        const double p_high = chi_square_upper_tail(chi_square, classes - 1.0);
        const double p_low = chi_square_lower_tail(chi_square, classes - 1.0);
        EXPECT_GT(std::min(p_high, p_low), 1e-4)
            << distribution_name(distributions[j].kind) << " " << distributions[j].shape << ": " << chi_square;
    }
    const Distribution empirical{.kind = DistributionKind::empirical, .scale = 1.0, .samples = samples};
    const Eigen::MatrixXd drawn = draw({independent({empirical})}, trials, 7);
    for (const double sample : *samples) {
        const auto count = static_cast<double>((drawn.array() == sample).count());
        EXPECT_NEAR(count / trials, 0.25, 5.0 * std::sqrt(0.25 * 0.75 / trials));
    }
}

TEST(RandomDraws, TailsBeyondFiveStandardDeviations) {
    constexpr std::uint64_t blocks = 1000;
    constexpr Eigen::Index trials = 20'000;
    const InputDraws draws({independent({Distribution::normal(0.0, 1.0)})}, 3, {});
    Eigen::MatrixXd x(trials, 1);
    double beyond = 0.0;
    double far = 0.0;
    for (std::uint64_t block = 0; block < blocks; ++block) {
        draws.draw(block * trials, x);
        for (Eigen::Index i = 0; i < trials; ++i) {
            beyond += std::abs(x(i, 0)) > 5.0 ? 1.0 : 0.0;
            far += std::abs(x(i, 0)) > 4.0 ? 1.0 : 0.0;
        }
    }
    const double expected = static_cast<double>(blocks) * trials * std::erfc(5.0 / std::sqrt(2.0));  // 11.5
    EXPECT_NEAR(beyond, expected, 4.0 * std::sqrt(expected));
    const double expected_far = static_cast<double>(blocks) * trials * std::erfc(4.0 / std::sqrt(2.0));
    EXPECT_NEAR(far, expected_far, 4.0 * std::sqrt(expected_far));
}

TEST(RandomDraws, CompleteCorrelationIsExact) {
    const std::vector<Distribution> two{Distribution::normal(0.0, 1.0), Distribution::normal(0.0, 1.0)};
    const Eigen::MatrixXd same = draw({correlated(two, 1.0, Dependence::normal)}, 1000);
    EXPECT_EQ(same.col(0), same.col(1));
    const Eigen::MatrixXd opposite = draw({correlated(two, -1.0, Dependence::normal)}, 1000);
    EXPECT_EQ(opposite.col(0), -opposite.col(1));
}

TEST(RandomDraws, CorrelationsOfAGroup) {
    constexpr Eigen::Index trials = 100'000;
    const double r = 0.6;
    const double tolerance = 5.0 * (1.0 - r * r) / std::sqrt(static_cast<double>(trials));
    const std::vector<Distribution> normals(3, Distribution::normal(5.0, 2.0));
    const Eigen::MatrixXd x = draw({correlated(normals, r, Dependence::normal)}, trials);
    EXPECT_NEAR(correlation(x.col(0), x.col(1)), r, tolerance);
    EXPECT_NEAR(correlation(x.col(1), x.col(2)), r, tolerance);

    // Multivariate t: correlation r, variance ν/(ν-2), and large values that come together even where r = 0.
    const std::vector<Distribution> ts(2, Distribution::student_t(0.0, 1.0, 8.0));
    const Eigen::MatrixXd t = draw({correlated(ts, r, Dependence::student_t)}, trials);
    EXPECT_NEAR(correlation(t.col(0), t.col(1)), r, 2.0 * tolerance);
    EXPECT_NEAR(t.col(0).squaredNorm() / trials, 8.0 / 6.0, 0.05);

    const std::vector<Distribution> mixed{Distribution::uniform(0.0, 1.0), standard(DistributionKind::exponential)};
    const Eigen::MatrixXd copula = draw({correlated(mixed, r, Dependence::gaussian_copula)}, trials);
    EXPECT_NEAR(copula.col(0).mean(), 0.0, 5.0 / std::sqrt(3.0 * trials));
    EXPECT_NEAR(copula.col(1).mean(), 1.0, 5.0 / std::sqrt(static_cast<double>(trials)));
    // Kendall's coefficient does not depend on the marginals: 2/π arcsin r = 0.4097 (from pairs of neighbouring
    // trials).
    double concordant = 0.0;
    for (Eigen::Index i = 0; i + 1 < trials; i += 2) {
        concordant += (copula(i, 0) - copula(i + 1, 0)) * (copula(i, 1) - copula(i + 1, 1)) > 0.0 ? 1.0 : -1.0;
    }
    EXPECT_NEAR(2.0 * concordant / trials, 0.4096655, 5.0 * std::sqrt(2.0 / trials));

    const Eigen::MatrixXd together = draw({correlated(mixed, r, Dependence::same_probability)}, 1000);
    for (Eigen::Index i = 0; i < 1000; ++i) {
        const double p = 0.5 * (together(i, 0) + 1.0);
        EXPECT_NEAR(together(i, 1), -std::log1p(-p), 1e-6 * (1.0 + together(i, 1)));
    }
}

TEST(RandomDraws, GroupsWithoutMarginalsAreNormal) {
    InputGroup group;
    group.name = "x";
    group.value = Eigen::Vector2d(1.0, 2.0);
    group.covariance = Eigen::Vector2d(4.0, 0.0);  // diagonal
    const Eigen::MatrixXd x = draw({group}, 50'000);
    EXPECT_NEAR(x.col(0).mean(), 1.0, 5.0 * 2.0 / std::sqrt(5e4));
    EXPECT_EQ(x.col(1), Eigen::VectorXd::Constant(50'000, 2.0));
}

TEST(RandomDraws, StreamsDecideWhatInputsShare) {
    const std::vector<InputGroup> two{independent({Distribution::normal(0.0, 1.0)}),
                                      independent({Distribution::normal(0.0, 1.0)})};
    const std::vector<std::uint64_t> first{5, 9};
    const std::vector<std::uint64_t> second{9, 11};
    Eigen::MatrixXd a(100, 2);
    Eigen::MatrixXd b(100, 2);
    InputDraws(two, 1, first).draw(0, a);
    InputDraws(two, 1, second).draw(0, b);
    EXPECT_EQ(a.col(1), b.col(0));
    EXPECT_NE(a.col(0), b.col(1));
    const std::vector<std::uint64_t> twice{5, 5};
    EXPECT_EQ(code_of<InputError>([&] { InputDraws(two, 1, twice); }), "GC-GUM-0127");
    EXPECT_EQ(code_of<InputError>([&] { InputDraws(two, 1, std::vector<std::uint64_t>{1}); }), "GC-GUM-0127");
}

TEST(RandomDraws, RefusesGroupsThatCannotBeDrawn) {
    const Distribution broken{.kind = DistributionKind::trapezoidal, .scale = 1.0, .shape = 2.0};
    EXPECT_EQ(code_of<InputError>([&] { draw({independent({broken})}, 1); }), "GC-GUM-0122");
    const std::vector<Distribution> uniforms(2, Distribution::uniform(0.0, 1.0));
    EXPECT_EQ(code_of<InputError>([&] { draw({correlated(uniforms, 0.5, Dependence::normal)}, 1); }), "GC-GUM-0123");
    const std::vector<Distribution> ts{Distribution::student_t(0.0, 1.0, 5.0), Distribution::student_t(0.0, 1.0, 6.0)};
    EXPECT_EQ(code_of<InputError>([&] { draw({correlated(ts, 0.5, Dependence::student_t)}, 1); }), "GC-GUM-0123");
    InputGroup short_group = independent(uniforms);
    short_group.marginals.pop_back();
    EXPECT_EQ(code_of<InputError>([&] { draw({short_group}, 1); }), "GC-GUM-0122");
    // Correlations that contradict each other: u² of a - b - c would be negative.
    InputGroup indefinite = independent(std::vector<Distribution>(3, Distribution::normal(0.0, 1.0)));
    indefinite.covariance = (Eigen::Matrix3d() << 1.0, 0.9, 0.9, 0.9, 1.0, -0.9, 0.9, -0.9, 1.0).finished();
    EXPECT_EQ(code_of<InputError>([&] { draw({indefinite}, 1); }), "GC-GUM-0054");
}

}  // namespace
}  // namespace gumcert::gum
