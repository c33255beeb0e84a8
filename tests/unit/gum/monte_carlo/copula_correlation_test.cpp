#include "gum/monte_carlo/copula_correlation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include "gum/monte_carlo/random_draws.h"

namespace gumcert::gum {
namespace {

const Distribution k_exponential{.kind = DistributionKind::exponential, .location = 0.0, .scale = 3.0};

TEST(HermiteProfile, UniformPairInClosedForm) {
    const HermiteProfile uniform(Distribution::uniform(5.0, 2.0));
    for (const double r : {-0.9, -0.5, 0.1, 0.5, 0.99}) {
        EXPECT_NEAR(HermiteProfile::normal_correlation(uniform, uniform, r), 2.0 * std::sin(std::numbers::pi * r / 6.0),
                    1e-9);
    }
    EXPECT_EQ(HermiteProfile::normal_correlation(uniform, uniform, 0.0), 0.0);
}

TEST(HermiteProfile, NormalPairAndNormalWithUniform) {
    const HermiteProfile normal(Distribution::normal(0.0, 1.0));
    const HermiteProfile uniform(Distribution::uniform(0.0, 1.0));
    EXPECT_NEAR(HermiteProfile::normal_correlation(normal, normal, 0.37), 0.37, 1e-12);
    EXPECT_NEAR(HermiteProfile::pearson(normal, uniform, 0.5), 0.5 * std::sqrt(3.0 / std::numbers::pi), 1e-12);
    EXPECT_NEAR(HermiteProfile::attainable(normal, uniform)[1], std::sqrt(3.0 / std::numbers::pi), 1e-12);
}

TEST(HermiteProfile, AttainableOfExponentialsAndLognormals) {
    const HermiteProfile exponential(k_exponential);
    EXPECT_NEAR(HermiteProfile::attainable(exponential, exponential)[0], 1.0 - std::pow(std::numbers::pi, 2) / 6.0,
                1e-6);
    EXPECT_NEAR(HermiteProfile::attainable(exponential, exponential)[1], 1.0, 1e-12);
    EXPECT_EQ(HermiteProfile::normal_correlation(exponential, exponential, -0.9), -1.0);
    const HermiteProfile lognormal({.kind = DistributionKind::lognormal, .scale = 2.0, .shape = 1.0});
    EXPECT_NEAR(HermiteProfile::pearson(lognormal, lognormal, 0.5), std::expm1(0.5) / std::expm1(1.0), 1e-9);
    EXPECT_NEAR(HermiteProfile::attainable(lognormal, lognormal)[0], std::expm1(-1.0) / std::expm1(1.0), 1e-9);
}

TEST(HermiteProfile, HasNoneWithoutVariance) {
    EXPECT_FALSE(HermiteProfile(Distribution::student_t(0.0, 1.0, 2.0)).has_correlation());
    EXPECT_TRUE(HermiteProfile(Distribution::student_t(0.0, 1.0, 5.0)).has_correlation());
}

// The law: whatever the distributions, the draws have the stated coefficient.
TEST(HermiteProfile, DrawsHaveTheStatedCoefficient) {
    std::vector<Distribution> all{Distribution::uniform(1.0, 2.0),
                                  Distribution::normal(0.0, 1.0),
                                  k_exponential,
                                  {.kind = DistributionKind::arcsine, .scale = 1.0},
                                  {.kind = DistributionKind::triangular, .scale = 1.0},
                                  {.kind = DistributionKind::gamma, .scale = 1.0, .shape = 2.5},
                                  {.kind = DistributionKind::beta, .scale = 1.0, .shape = 0.7, .second_shape = 2.0},
                                  {.kind = DistributionKind::lognormal, .scale = 1.0, .shape = 0.5},
                                  {.kind = DistributionKind::curvilinear_trapezoid, .scale = 1.0, .shape = 0.5}};
    std::mt19937 random(3);
    for (int round = 0; round < 40; ++round) {
        const Distribution& a = all[random() % all.size()];
        const Distribution& b = all[random() % all.size()];
        const HermiteProfile of_a(a);
        const HermiteProfile of_b(b);
        const auto [low, high] = HermiteProfile::attainable(of_a, of_b);
        const double r = low + (high - low) * (0.02 + 0.96 * static_cast<double>(random()) / 4294967296.0);
        const double rho = HermiteProfile::normal_correlation(of_a, of_b, r);
        EXPECT_NEAR(HermiteProfile::pearson(of_a, of_b, rho), r, 1e-9);
        InputGroup group;
        group.name = "a, b";
        group.value = Eigen::Vector2d(expectation(a), expectation(b));
        const double u = standard_deviation(a);
        const double v = standard_deviation(b);
        group.covariance.resize(2, 2);
        group.covariance << u * u, r * u * v, r * u * v, v * v;
        group.marginals = {a, b};
        group.dependence = Dependence::gaussian_copula;
        group.normal_correlation.resize(2, 2);
        group.normal_correlation << 1.0, rho, rho, 1.0;
        const InputDraws draws({group}, 11, {});
        Eigen::MatrixXd x(200000, 2);
        draws.draw(0, x);
        const Eigen::MatrixXd d = x.rowwise() - x.colwise().mean();
        const double found = d.col(0).dot(d.col(1)) / (d.col(0).norm() * d.col(1).norm());
        EXPECT_NEAR(found, r, 0.012) << round << ": " << distribution_name(a.kind) << ", " << distribution_name(b.kind);
    }
}

}  // namespace
}  // namespace gumcert::gum
