#include "gum/quantity/distribution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::gum {
namespace {

struct Moment {
    const char* name;
    Distribution distribution;
    double mean;
    double standard_deviation;
};

std::vector<Moment> moments_of_table_1() {
    const double centre = 1.0;  // of the limits -2 and 4
    const double half_width = 3.0;
    return {
        {"rectangular", Distribution::uniform(centre, half_width), 1.0, 1.73205080756888},
        {"triangular",
         {.kind = DistributionKind::triangular, .location = centre, .scale = half_width},
         1.0,
         1.22474487139159},
        {"trapezoid",
         {.kind = DistributionKind::trapezoidal, .location = centre, .scale = half_width, .shape = 0.33},
         1.0,
         1.28970926956427},
        {"curvilinear trapezoid, d = 0.4",
         {.kind = DistributionKind::curvilinear_trapezoid, .location = centre, .scale = half_width, .shape = 0.4 / 3.0},
         1.0,
         1.73717522943938},
        {"arcsine",
         {.kind = DistributionKind::arcsine, .location = centre, .scale = half_width},
         1.0,
         2.12132034355964},
        {"t, 5", Distribution::student_t(1.0, 2.0, 5.0), 1.0, 2.58198889747161},
        {"t, 18", Distribution::student_t(1.0, 2.0, 18.0), 1.0, 2.12132034355964},
        {"exponential", {.kind = DistributionKind::exponential, .scale = 3.0}, 3.0, 3.0},
        {"gamma after 7 counts", {.kind = DistributionKind::gamma, .scale = 1.0, .shape = 8.0}, 8.0, 2.82842712474619},
    };
}

// JCGM 101:2008, 6.4 and table 1; numbers recomputed independently.
TEST(Distribution, MomentsOfTable1) {
    for (const Moment& moment : moments_of_table_1()) {
        EXPECT_NEAR(expectation(moment.distribution), moment.mean, 1e-12 * moment.mean) << moment.name;
        EXPECT_NEAR(standard_deviation(moment.distribution), moment.standard_deviation,
                    1e-12 * moment.standard_deviation)
            << moment.name;
    }
}

// Other programs give 0.1768 for this arcsine distribution and 2 for this gamma distribution.
TEST(Distribution, MomentsThatOthersGetWrong) {
    const Distribution arcsine{.kind = DistributionKind::arcsine, .scale = 0.5};
    EXPECT_NEAR(standard_deviation(arcsine), 0.353553390593274, 1e-15);
    const Distribution gamma{.kind = DistributionKind::gamma, .scale = 1.0, .shape = 2.0};
    EXPECT_NEAR(standard_deviation(gamma), 1.414213562373095, 1e-15);
}

TEST(Distribution, OtherMoments) {
    const Distribution beta{
        .kind = DistributionKind::beta, .location = 1.0, .scale = 2.0, .shape = 2.0, .second_shape = 6.0};
    EXPECT_NEAR(expectation(beta), 1.5, 1e-15);
    EXPECT_NEAR(standard_deviation(beta), 2.0 * std::sqrt(12.0 / (64.0 * 9.0)), 1e-15);
    const Distribution lognormal{.kind = DistributionKind::lognormal, .scale = 1.0, .shape = 0.5};
    EXPECT_NEAR(expectation(lognormal), std::exp(0.125), 1e-14);
    EXPECT_NEAR(standard_deviation(lognormal), std::exp(0.125) * std::sqrt(std::exp(0.25) - 1.0), 1e-14);
    const Distribution empirical{.kind = DistributionKind::empirical,
                                 .location = 10.0,
                                 .scale = 2.0,
                                 .samples = std::make_shared<const std::vector<double>>(std::vector{1.0, 2.0, 6.0})};
    EXPECT_NEAR(expectation(empirical), 16.0, 1e-14);
    EXPECT_NEAR(standard_deviation(empirical), 2.0 * std::sqrt(14.0 / 3.0), 1e-14);
    EXPECT_EQ(standard_deviation(Distribution::constant(3.0)), 0.0);
}

TEST(Distribution, MomentsThatDoNotExist) {
    EXPECT_TRUE(std::isnan(expectation(Distribution::student_t(0.0, 1.0, 1.0))));
    EXPECT_TRUE(std::isinf(standard_deviation(Distribution::student_t(0.0, 1.0, 2.0))));
}

TEST(Distribution, InfiniteDegreesOfFreedomAreNormal) {
    const Distribution t = Distribution::student_t(1.0, 2.0, std::numeric_limits<double>::infinity());
    EXPECT_EQ(t.kind, DistributionKind::normal);
    EXPECT_EQ(t.scale, 2.0);
}

TEST(Distribution, SymmetryAndLimits) {
    EXPECT_TRUE(is_symmetric(Distribution::normal(1.0, 1.0)));
    EXPECT_FALSE(is_symmetric({.kind = DistributionKind::gamma, .scale = 1.0, .shape = 2.0}));
    EXPECT_TRUE(is_bounded(Distribution::uniform(0.0, 1.0)));
    EXPECT_FALSE(is_bounded(Distribution::normal(0.0, 1.0)));
    EXPECT_EQ(distribution_name(DistributionKind::curvilinear_trapezoid), "curvilinear_trapezoid");
}

TEST(Distribution, HasANameOfItsOwn) {
    using enum DistributionKind;
    const std::vector<DistributionKind> kinds{
        constant,  normal, uniform,     triangular, arcsine, trapezoidal, curvilinear_trapezoid,
        student_t, gamma,  exponential, lognormal,  beta,    empirical};
    const std::vector<std::string> names{
        "constant",  "normal", "uniform",     "triangular", "arcsine", "trapezoidal", "curvilinear_trapezoid",
        "student_t", "gamma",  "exponential", "lognormal",  "beta",    "empirical"};
    for (std::size_t i = 0; i < kinds.size(); ++i) {
        EXPECT_EQ(distribution_name(kinds[i]), names[i]);
    }
}

TEST(Distribution, MomentsOfSamples) {
    // 1, 2, 2, 5: mean 2.5, variance with 1/n (2.25 + 0.25 + 0.25 + 6.25)/4.
    const auto samples_of = [](std::vector<double> values) {
        return Distribution{.kind = DistributionKind::empirical,
                            .location = 1.0,
                            .scale = 10.0,
                            .samples = std::make_shared<const std::vector<double>>(std::move(values))};
    };
    EXPECT_DOUBLE_EQ(expectation(samples_of({1.0, 2.0, 2.0, 5.0})), 26.0);
    EXPECT_DOUBLE_EQ(standard_deviation(samples_of({1.0, 2.0, 2.0, 5.0})), 15.0);
    EXPECT_EQ(standard_deviation(samples_of({3.0, 3.0})), 0.0);
    EXPECT_EQ(expectation(samples_of({})), 1.0) << "none: refused where it is used";
    EXPECT_EQ(standard_deviation({.kind = DistributionKind::empirical, .scale = 10.0}), 0.0);
    EXPECT_EQ(standard_deviation(Distribution::constant(3.0)), 0.0);
}

}  // namespace
}  // namespace gumcert::gum
