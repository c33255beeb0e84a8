#include "gum/conformity/posterior_risk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>

#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

const ToleranceLimits k_tolerance_of_ten{.lower = 9.9, .upper = 10.1};
const Population k_population_of_ten{.centre = 10.0, .deviation = 0.05};

MeasuredValue measured(const Distribution& distribution) {
    const double u = standard_deviation(distribution);
    return {.value = expectation(distribution),
            .standard_uncertainty = u,
            .expanded_uncertainty = 2.0 * u,
            .distribution = [distribution](double x) { return lower_tail_probability(distribution, x); }};
}

/// P(Y > 10.1) by Bayes: the density of the population over the rectangle, in closed form.
double above_of_rectangle(double middle, double half_width) {
    const Distribution prior = Distribution::normal(k_population_of_ten.centre, k_population_of_ten.deviation);
    const auto P = [&](double x) { return lower_tail_probability(prior, x); };
    const double all = P(middle + half_width) - P(middle - half_width);
    return std::max(0.0, P(middle + half_width) - P(std::max(10.1, middle - half_width))) / all;
}

TEST(PosteriorRisk, OfARectangleIsThatOfTheClosedForm) {
    const MeasuredValue y = measured(Distribution::uniform(10.0739, 0.03));
    EXPECT_TRUE(
        test::prints_as(100.0 * PosteriorRisk(y, k_tolerance_of_ten, k_population_of_ten).at(y.value).above, "2.276"));
    for (double value = 10.0; value < 10.2; value += 0.003) {
        EXPECT_NEAR(PosteriorRisk(y, k_tolerance_of_ten, k_population_of_ten).at(value).above,
                    above_of_rectangle(value, 0.03), 2e-6)
            << value;
    }
}

TEST(PosteriorRisk, OfAStudentDistributionHasItsTails) {
    // t with 3 degrees of freedom, scale 0.015: 0.781314 % by adaptive quadrature.
    const MeasuredValue y{.value = 10.064,
                          .standard_uncertainty = 0.015,
                          .expanded_uncertainty = coverage_factor(0.9545, 3.0) * 0.015,
                          .degrees_of_freedom = 3.0};
    EXPECT_TRUE(
        test::prints_as(100.0 * PosteriorRisk(y, k_tolerance_of_ten, k_population_of_ten).at(y.value).both(), "0.781"));
}

TEST(PosteriorRisk, KnowsTailsThatDoNotEnd) {
    EXPECT_FALSE(has_long_tails(measured(Distribution::uniform(1.0, 2.0))));
    EXPECT_FALSE(has_long_tails(measured(Distribution::normal(1.0, 2.0))));
    EXPECT_TRUE(has_long_tails(measured(Distribution::student_t(1.0, 2.0, 5.0))));
}

TEST(PosteriorRisk, OfANormalMeasurementIsThatOfTheWeightedMean) {
    std::mt19937_64 random(41);
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int i = 0; i < 60; ++i) {
        const double u = 0.005 * std::pow(40.0, unit(random));
        const Population population{.centre = 9.95 + 0.1 * unit(random),
                                    .deviation = 0.01 * std::pow(20.0, unit(random))};
        const double value = population.centre + (unit(random) - 0.5) * 4.0 * std::hypot(u, population.deviation);
        const MeasuredValue closed{.value = value, .standard_uncertainty = u, .expanded_uncertainty = 2.0 * u};
        const OutsideProbabilities exact = PosteriorRisk(closed, k_tolerance_of_ten, population).at(value);
        const OutsideProbabilities integrated =
            PosteriorRisk(measured(Distribution::normal(value, u)), k_tolerance_of_ten, population).at(value);
        EXPECT_NEAR(integrated.below, exact.below, 2e-6);
        EXPECT_NEAR(integrated.above, exact.above, 2e-6);
    }
}

TEST(PosteriorRisk, KnowsWhatRestsOnATail) {
    const MeasuredValue normal = measured(Distribution::normal(10.0, 0.02));
    const PosteriorRisk risk(normal, k_tolerance_of_ten, k_population_of_ten);
    EXPECT_FALSE(risk.rests_on_tail(10.0));
    EXPECT_FALSE(risk.rests_on_tail(10.3)) << "6 standard deviations of the population: it moves, and not the tail";
    const PosteriorRisk narrow(normal, k_tolerance_of_ten, {.centre = 10.0, .deviation = 0.005});
    EXPECT_FALSE(narrow.rests_on_tail(10.06));
    EXPECT_TRUE(narrow.rests_on_tail(10.2)) << "10 u from where the population is";
    // The end of a rectangle is no tail: nothing lies beyond it, and that is known.
    const MeasuredValue rectangle = measured(Distribution::uniform(10.0, 0.03));
    EXPECT_FALSE(PosteriorRisk(rectangle, k_tolerance_of_ten, k_population_of_ten).rests_on_tail(10.4));
    MeasuredValue counted = normal;
    counted.trials = 1000.0;
    EXPECT_TRUE(PosteriorRisk(counted, k_tolerance_of_ten, {.centre = 10.0, .deviation = 0.005}).rests_on_tail(10.06))
        << "30 trials of 1000 lie beyond 1.9 u";
}

TEST(PosteriorRisk, WherePopulationAndMeasurementExcludeEachOtherTheValueDecides) {
    const MeasuredValue y = measured(Distribution::uniform(20.0, 0.03));
    EXPECT_EQ(PosteriorRisk(y, k_tolerance_of_ten, k_population_of_ten).at(20.0).above, 1.0);
    EXPECT_EQ(PosteriorRisk(y, k_tolerance_of_ten, k_population_of_ten).at(1.0).below, 1.0);
}

}  // namespace
}  // namespace gumcert::gum
