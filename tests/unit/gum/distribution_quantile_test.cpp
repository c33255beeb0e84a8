#include "gum/distribution_quantile.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;

Distribution standard(DistributionKind kind, double shape = 0.0, double second_shape = 0.0) {
    return {.kind = kind, .scale = 1.0, .shape = shape, .second_shape = second_shape};
}

std::vector<Distribution> continuous_distributions() {
    return {standard(DistributionKind::normal),
            standard(DistributionKind::uniform),
            standard(DistributionKind::triangular),
            standard(DistributionKind::arcsine),
            standard(DistributionKind::trapezoidal, 0.0),
            standard(DistributionKind::trapezoidal, 0.33),
            standard(DistributionKind::trapezoidal, 1.0),
            standard(DistributionKind::curvilinear_trapezoid, 0.0),
            standard(DistributionKind::curvilinear_trapezoid, 0.1),
            standard(DistributionKind::curvilinear_trapezoid, 0.5),
            standard(DistributionKind::curvilinear_trapezoid, 1.0),
            standard(DistributionKind::student_t, 1.0),
            standard(DistributionKind::student_t, 5.0),
            standard(DistributionKind::student_t, 50.0),
            standard(DistributionKind::gamma, 0.5),
            standard(DistributionKind::gamma, 8.0),
            standard(DistributionKind::exponential),
            standard(DistributionKind::lognormal, 0.5),
            standard(DistributionKind::beta, 2.0, 5.0),
            standard(DistributionKind::beta, 0.5, 0.5)};
}

std::string name(const Distribution& distribution) {
    return std::string(distribution_name(distribution.kind)) + " " + std::to_string(distribution.shape);
}

TEST(DistributionQuantile, UndoesTheTailProbabilities) {
    for (const Distribution& distribution : continuous_distributions()) {
        for (const double p : {1e-12, 1e-6, 0.001, 0.02, 0.2, 0.3, 0.5, 0.7, 0.97}) {
            if (p < 0.001 && is_bounded(distribution)) {
                continue;  // so near to a limit that is not 0, the value has no digits left to tell how near
            }
            EXPECT_TRUE(agrees(lower_tail_probability(distribution, quantile(distribution, p)), p, 1e-9))
                << name(distribution) << " p " << p;
            EXPECT_TRUE(agrees(upper_tail_probability(distribution, upper_quantile(distribution, p)), p, 1e-9))
                << name(distribution) << " q " << p;
        }
    }
}

TEST(DistributionQuantile, TailsAddUpToOne) {
    for (const Distribution& distribution : continuous_distributions()) {
        for (const double x : {-3.0, -0.6, 0.0, 0.1, 0.9, 0.99, 1.2, 7.0}) {
            EXPECT_NEAR(lower_tail_probability(distribution, x) + upper_tail_probability(distribution, x), 1.0, 1e-14)
                << name(distribution) << " at " << x;
        }
        EXPECT_EQ(lower_tail_probability(distribution, -k_infinity), 0.0);
        EXPECT_EQ(lower_tail_probability(distribution, k_infinity), 1.0);
    }
}

// The density is the derivative of the distribution function, by a central difference.
TEST(DistributionQuantile, DensityIsTheDerivative) {
    for (const Distribution& distribution : continuous_distributions()) {
        for (const double p : {0.05, 0.3, 0.52, 0.8}) {
            const double x = quantile(distribution, p);
            const double step = 1e-5 * std::max(std::abs(x), 0.01);
            const double difference =
                (lower_tail_probability(distribution, x + step) - lower_tail_probability(distribution, x - step)) /
                (2.0 * step);
            EXPECT_TRUE(agrees(probability_density(distribution, x), difference, 1e-5)) << name(distribution) << p;
        }
    }
}

TEST(DistributionQuantile, ClosedForms) {
    EXPECT_NEAR(quantile(Distribution::normal(0.0, 1.0), 0.975), 1.959963984540054, 1e-14);
    EXPECT_NEAR(upper_quantile(Distribution::normal(0.0, 1.0), 1e-20), 9.262340089798408, 1e-12);
    EXPECT_NEAR(quantile(Distribution::uniform(10.0, 2.0), 0.75), 11.0, 1e-15);
    EXPECT_NEAR(quantile(standard(DistributionKind::triangular), 0.125), -0.5, 1e-15);
    EXPECT_NEAR(quantile(standard(DistributionKind::arcsine), 0.75), std::sin(std::numbers::pi / 4.0), 1e-15);
    EXPECT_NEAR(quantile(standard(DistributionKind::exponential), 0.5), std::numbers::ln2, 1e-15);
    EXPECT_NEAR(quantile(standard(DistributionKind::student_t, 2.0), 0.9), 1.885618083164127, 1e-13);
    EXPECT_NEAR(quantile(standard(DistributionKind::student_t, 1.0), 0.75), 1.0, 1e-13);
    EXPECT_EQ(quantile(Distribution::constant(3.0), 0.1), 3.0);
    EXPECT_EQ(quantile(Distribution::normal(0.0, 1.0), 1.0), k_infinity);
    EXPECT_EQ(quantile(standard(DistributionKind::gamma, 2.0), 0.0), 0.0);
}

// G(x) = 1/2 + x ln((w+d)/(w-d)) / (4d) inside the limits, from the density of JCGM 101:2008, 6.4.3.3; beyond them the
// integral of ln((w+d)/|x|)/(4d), here by Simpson's rule.
TEST(DistributionQuantile, CurvilinearTrapezoid) {
    const double d = 0.5;
    const Distribution distribution = standard(DistributionKind::curvilinear_trapezoid, d);
    EXPECT_NEAR(lower_tail_probability(distribution, 0.25), 0.5 + 0.25 * std::log(3.0) / 2.0, 1e-15);
    const double from = 0.8;
    double integral = 0.0;
    const int steps = 2000;
    const double h = (1.5 - from) / steps;
    for (int i = 0; i <= steps; ++i) {
        const double weight = i == 0 || i == steps ? 1.0 : (i % 2 == 1 ? 4.0 : 2.0);
        integral += weight * std::log(1.5 / (from + i * h)) / (4.0 * d) * h / 3.0;
    }
    EXPECT_NEAR(upper_tail_probability(distribution, from), integral, 1e-12);
    EXPECT_EQ(upper_tail_probability(distribution, 1.5), 0.0);
    EXPECT_NEAR(quantile(distribution, 1.0), 1.5, 1e-15);
    // Limits given as lower and upper: another program then sets the lower to the upper one.
    EXPECT_NEAR(
        quantile({.kind = DistributionKind::curvilinear_trapezoid, .location = 10.0, .scale = 2.0, .shape = 0.1}, 0.0),
        7.8, 1e-13);
}

// Conformance probabilities of measurands that are not normal.
TEST(DistributionQuantile, ConformanceProbabilities) {
    EXPECT_NEAR(lower_tail_probability(Distribution::uniform(10.05, 0.25), 10.2), 0.8, 1e-12);
    const Distribution t = Distribution::student_t(10.1, 0.05, 5.0);
    EXPECT_NEAR(lower_tail_probability(t, 10.2) - lower_tail_probability(t, 9.9), 0.943868552844655, 1e-12);
    const Distribution triangular{.kind = DistributionKind::triangular, .location = 10.0, .scale = 0.2};
    EXPECT_NEAR(lower_tail_probability(triangular, 10.1), 0.875, 1e-12);
}

TEST(DistributionQuantile, AgreesWithCoverageFactors) {
    for (const double nu : {1.0, 3.0, 8.0, 18.0, 120.5}) {
        EXPECT_TRUE(
            agrees(upper_quantile(standard(DistributionKind::student_t, nu), 0.025), coverage_factor(0.95, nu), 1e-12));
    }
}

TEST(DistributionQuantile, EmpiricalDistribution) {
    const Distribution samples{.kind = DistributionKind::empirical,
                               .location = 1.0,
                               .scale = 10.0,
                               .samples = std::make_shared<const std::vector<double>>(std::vector{1.0, 2.0, 2.0, 5.0})};
    EXPECT_EQ(quantile(samples, 0.0), 11.0);
    EXPECT_EQ(quantile(samples, 0.25), 11.0);
    EXPECT_EQ(quantile(samples, 0.26), 21.0);
    EXPECT_EQ(quantile(samples, 1.0), 51.0);
    EXPECT_EQ(upper_quantile(samples, 0.25), 21.0);
    EXPECT_EQ(lower_tail_probability(samples, 21.0), 0.75);
    EXPECT_EQ(upper_tail_probability(samples, 21.0), 0.25);
}

TEST(DistributionQuantile, RefusesWhatIsOutOfRange) {
    EXPECT_EQ(code_of<InputError>([] { static_cast<void>(quantile(Distribution::uniform(0.0, -1.0), 0.5)); }),
              "GC-GUM-0124");
    EXPECT_EQ(code_of<InputError>([] { static_cast<void>(quantile(Distribution::uniform(0.0, 1.0), 1.5)); }),
              "GC-GUM-0125");
    EXPECT_EQ(code_of<InputError>([] {
                  static_cast<void>(lower_tail_probability(Distribution::uniform(0.0, 1.0),
                                                           std::numeric_limits<double>::quiet_NaN()));
              }),
              "GC-GUM-0125");
    EXPECT_NE(distribution_problem(standard(DistributionKind::trapezoidal, 1.1)), "");
    EXPECT_NE(distribution_problem(standard(DistributionKind::student_t, 0.0)), "");
    EXPECT_NE(distribution_problem(standard(DistributionKind::beta, 1.0, 0.0)), "");
    EXPECT_NE(distribution_problem(standard(DistributionKind::empirical)), "");
    EXPECT_NE(distribution_problem({.kind = DistributionKind::constant, .location = k_infinity}), "");
    EXPECT_NE(distribution_problem({.kind = DistributionKind::constant, .scale = 1.0}), "");
    EXPECT_EQ(distribution_problem(Distribution::constant(1.0)), "");
}

// Densities at and beyond the ends of the standard distributions, from their formulae: JCGM 101:2008, 6.4, for those that it
// has; gamma and beta of the shape 1 are the exponential and a power.
TEST(DistributionQuantile, DensitiesAtTheEnds) {
    struct Case {
        Distribution distribution;
        double x, density;
    };
    const double r = 0.5;
    for (const Case& one :
         std::vector<Case>{{standard(DistributionKind::uniform), 1.0, 0.5},
                           {standard(DistributionKind::uniform), -1.1, 0.0},
                           {standard(DistributionKind::triangular), 1.0, 0.0},
                           {standard(DistributionKind::triangular), 0.0, 1.0},
                           {standard(DistributionKind::arcsine), 1.0, k_infinity},
                           {standard(DistributionKind::arcsine), -1.5, 0.0},
                           {standard(DistributionKind::trapezoidal, r), 0.5, 1.0 / 1.5},
                           {standard(DistributionKind::trapezoidal, r), 1.0, 0.0},
                           {standard(DistributionKind::trapezoidal, r), -1.01, 0.0},
                           {standard(DistributionKind::curvilinear_trapezoid, r), 1.5, 0.0},
                           {standard(DistributionKind::curvilinear_trapezoid, r), -1.6, 0.0},
                           {standard(DistributionKind::curvilinear_trapezoid, r), 0.2, std::log(3.0) / 2.0},
                           {standard(DistributionKind::curvilinear_trapezoid, 0.0), 0.9, 0.5},
                           {standard(DistributionKind::curvilinear_trapezoid, 0.0), 1.1, 0.0},
                           {standard(DistributionKind::student_t, 5.0), k_infinity, 0.0},
                           {standard(DistributionKind::student_t, 1.0), 1.0, 0.5 / std::numbers::pi},
                           {standard(DistributionKind::exponential), 0.0, 1.0},
                           {standard(DistributionKind::exponential), -1e-9, 0.0},
                           {standard(DistributionKind::lognormal, 0.5), 0.0, 0.0},
                           {standard(DistributionKind::lognormal, 0.5), k_infinity, 0.0},
                           {standard(DistributionKind::lognormal, 0.5), 1.0, 2.0 / std::sqrt(2.0 * std::numbers::pi)},
                           {standard(DistributionKind::gamma, 2.0), -1.0, 0.0},
                           {standard(DistributionKind::gamma, 2.0), k_infinity, 0.0},
                           {standard(DistributionKind::gamma, 2.0), 0.0, 0.0},
                           {standard(DistributionKind::gamma, 1.0), 0.0, 1.0},
                           {standard(DistributionKind::gamma, 0.5), 0.0, k_infinity},
                           {standard(DistributionKind::beta, 2.0, 3.0), -0.1, 0.0},
                           {standard(DistributionKind::beta, 2.0, 3.0), 1.1, 0.0},
                           {standard(DistributionKind::beta, 2.0, 3.0), 0.0, 0.0},
                           {standard(DistributionKind::beta, 2.0, 3.0), 1.0, 0.0},
                           {standard(DistributionKind::beta, 1.0, 3.0), 0.0, 3.0},
                           {standard(DistributionKind::beta, 4.0, 1.0), 1.0, 4.0},
                           {standard(DistributionKind::beta, 0.5, 3.0), 0.0, k_infinity},
                           {standard(DistributionKind::beta, 3.0, 0.5), 1.0, k_infinity},
                           {{.kind = DistributionKind::uniform, .location = 10.0, .scale = 4.0}, 13.0, 0.125}}) {
        const double found = probability_density(one.distribution, one.x);
        EXPECT_TRUE(found == one.density || agrees(found, one.density, 1e-14))
            << name(one.distribution) << " at " << one.x << ": " << found;
    }
}

TEST(DistributionQuantile, TailsAndQuantilesAtTheEnds) {
    for (const Distribution& distribution : continuous_distributions()) {
        const double low = quantile(distribution, 0.0), high = quantile(distribution, 1.0);
        EXPECT_EQ(upper_quantile(distribution, 1.0), low) << name(distribution);
        EXPECT_EQ(upper_quantile(distribution, 0.0), high) << name(distribution);
        EXPECT_EQ(lower_tail_probability(distribution, low), 0.0) << name(distribution);
        EXPECT_EQ(upper_tail_probability(distribution, low), 1.0) << name(distribution);
        EXPECT_EQ(lower_tail_probability(distribution, high), 1.0) << name(distribution);
        EXPECT_EQ(upper_tail_probability(distribution, high), 0.0) << name(distribution);
        EXPECT_EQ(lower_tail_probability(distribution, -k_infinity), 0.0) << name(distribution);
        EXPECT_EQ(upper_tail_probability(distribution, k_infinity), 0.0) << name(distribution);
    }
    const Distribution constant = Distribution::constant(3.0);
    EXPECT_EQ(lower_tail_probability(constant, std::nextafter(3.0, 0.0)), 0.0);
    EXPECT_EQ(upper_tail_probability(constant, std::nextafter(3.0, 0.0)), 1.0);
    EXPECT_EQ(lower_tail_probability(constant, 3.0), 1.0);
    EXPECT_EQ(upper_tail_probability(constant, 3.0), 0.0);
}

TEST(DistributionQuantile, SaysWhatCannotBeUsed) {
    const auto samples = [](std::vector<double> values) {
        return distribution_problem({.kind = DistributionKind::empirical,
                                     .scale = 1.0,
                                     .samples = std::make_shared<const std::vector<double>>(std::move(values))});
    };
    EXPECT_EQ(samples({}), "no samples; needs at least one");
    EXPECT_EQ(samples({1.0, k_infinity}), "a sample that is not finite; samples must be finite");
    EXPECT_EQ(samples({2.0, 1.0}), "samples not in ascending order; must be sorted");
    EXPECT_EQ(samples({1.0, 1.0, 2.0}), "");
    EXPECT_EQ(distribution_problem(standard(DistributionKind::trapezoidal, -0.1)), "shape -0.1; must be from 0 to 1");
    EXPECT_EQ(distribution_problem(standard(DistributionKind::gamma, 0.0)),
              "shape 0; must be finite and greater than 0");
    EXPECT_EQ(distribution_problem(standard(DistributionKind::lognormal, k_infinity)),
              "shape inf; must be finite and greater than 0");
    EXPECT_EQ(distribution_problem(standard(DistributionKind::beta, 0.0, 1.0)),
              "shape alpha 0; must be finite and greater than 0");
    for (const double none : {-0.1, 1.1, std::nan("")}) {
        EXPECT_EQ(code_of<InputError>([&] { (void)quantile(Distribution::normal(0.0, 1.0), none); }), "GC-GUM-0125");
        EXPECT_EQ(code_of<InputError>([&] { (void)upper_quantile(Distribution::normal(0.0, 1.0), none); }),
                  "GC-GUM-0125");
    }
    EXPECT_EQ(code_of<InputError>([] { (void)upper_tail_probability(Distribution::normal(0.0, 1.0), std::nan("")); }),
              "GC-GUM-0125");
    EXPECT_EQ(code_of<InputError>([] { (void)probability_density(Distribution::normal(0.0, 1.0), std::nan("")); }),
              "GC-GUM-0125");
}

}  // namespace
}  // namespace gumcert::gum
