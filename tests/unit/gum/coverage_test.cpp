#include "gum/coverage.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

constexpr double k_one_sigma = 0.682689492137086;
constexpr double k_two_sigma = 0.954499736103642;
constexpr double k_three_sigma = 0.99730020393674;

TEST(CoverageFactor, TableG2OfTheGum) {
    // JCGM 100:2008, table G.2; the columns 68.27, 95.45 and 99.73 % are the exact normal probabilities.
    const std::array<double, 6> probability{k_one_sigma, 0.90, 0.95, k_two_sigma, 0.99, k_three_sigma};
    struct Row {
        double nu;
        std::array<const char*, 6> k;
    };
    const std::vector<Row> table{
        {1, {"1.84", "6.31", "12.71", "13.97", "63.66", "235.80"}},
        {2, {"1.32", "2.92", "4.30", "4.53", "9.92", "19.21"}},
        {3, {"1.20", "2.35", "3.18", "3.31", "5.84", "9.22"}},
        {4, {"1.14", "2.13", "2.78", "2.87", "4.60", "6.62"}},
        {5, {"1.11", "2.02", "2.57", "2.65", "4.03", "5.51"}},
        {6, {"1.09", "1.94", "2.45", "2.52", "3.71", "4.90"}},
        {7, {"1.08", "1.89", "2.36", "2.43", "3.50", "4.53"}},
        {8, {"1.07", "1.86", "2.31", "2.37", "3.36", "4.28"}},
        {9, {"1.06", "1.83", "2.26", "2.32", "3.25", "4.09"}},
        {10, {"1.05", "1.81", "2.23", "2.28", "3.17", "3.96"}},
        {20, {"1.03", "1.72", "2.09", "2.13", "2.85", "3.42"}},
        {50, {"1.01", "1.68", "2.01", "2.05", "2.68", "3.16"}},
        {k_infinity, {"1.000", "1.645", "1.960", "2.000", "2.576", "3.000"}},
    };
    for (const Row& row : table) {
        for (std::size_t column = 0; column < probability.size(); ++column) {
            EXPECT_TRUE(prints_as(coverage_factor(probability[column], row.nu), row.k[column]))
                << "p = " << probability[column] << ", nu = " << row.nu;
        }
    }
}

TEST(CoverageFactor, TableE1OfEa402) {
    // EA-4/02 M, table E.1, coverage probability 95.45 %.
    const std::vector<std::pair<double, const char*>> table{
        {1, "13.97"}, {2, "4.53"}, {3, "3.31"},  {4, "2.87"},  {5, "2.65"},  {6, "2.52"},
        {7, "2.43"},  {8, "2.37"}, {10, "2.28"}, {20, "2.13"}, {50, "2.05"}, {k_infinity, "2.00"}};
    for (const auto& [nu, k] : table) {
        EXPECT_TRUE(prints_as(coverage_factor(k_two_sigma, nu), k)) << "nu = " << nu;
        EXPECT_TRUE(prints_as(coverage_factor(0.9545, nu), k)) << "with p as printed, nu = " << nu;
    }
}

TEST(CoverageFactor, IndependentValues9545) {
    // Independent computation (incomplete beta function), coverage probability 95.45 %.
    const std::vector<std::pair<double, const char*>> table{{1, "13.97"}, {2, "4.53"},  {3, "3.31"},  {4, "2.87"},
                                                            {5, "2.65"},  {6, "2.52"},  {7, "2.43"},  {8, "2.37"},
                                                            {9, "2.32"},  {10, "2.28"}, {12, "2.23"}, {15, "2.18"},
                                                            {20, "2.13"}, {30, "2.09"}, {50, "2.05"}, {100, "2.025"}};
    for (const auto& [nu, k] : table) {
        EXPECT_TRUE(prints_as(coverage_factor(0.9545, nu), k)) << "nu = " << nu;
    }
}

TEST(CoverageFactor, IndependentValues95) {
    const std::vector<std::pair<double, const char*>> table{{1, "12.71"}, {2, "4.30"},  {3, "3.18"},
                                                            {4, "2.78"},  {5, "2.57"},  {10, "2.23"},
                                                            {20, "2.09"}, {50, "2.01"}, {100, "1.98"}};
    for (const auto& [nu, k] : table) {
        EXPECT_TRUE(prints_as(coverage_factor(0.95, nu), k)) << "nu = " << nu;
    }
    // From the closed form of the distribution for even nu, bisected with 40-digit decimals. (The widespread Cephes
    // quantile is off by up to 4e-9 here: 2.44691184879 for nu = 6, 2.02107538300 for nu = 40.)
    const std::vector<std::pair<double, double>> digits{{6, 2.446911851144969971},  {12, 2.178812829667228866},
                                                        {14, 2.144786687917803829}, {16, 2.119905299221254674},
                                                        {18, 2.100922040241038488}, {30, 2.042272456301238310},
                                                        {40, 2.021075390306273421}, {100, 1.983971518523552287}};
    for (const auto& [nu, k] : digits) {
        EXPECT_TRUE(agrees(coverage_factor(0.95, nu), k, 1e-12)) << "nu = " << nu;
    }
}

/// P(|t| ≤ k) by Simpson's rule on the density of Student's t: a second opinion that shares nothing with the product.
double probability_within(double k, double nu) {
    const double scale =
        std::exp(std::lgamma((nu + 1.0) / 2.0) - std::lgamma(nu / 2.0)) / std::sqrt(nu * std::numbers::pi);
    const auto density = [&](double t) { return scale * std::pow(1.0 + t * t / nu, -(nu + 1.0) / 2.0); };
    const int steps = 20000;
    const double h = k / steps;
    double sum = density(0.0) + density(k);
    for (int i = 1; i < steps; ++i) {
        sum += density(i * h) * (i % 2 == 1 ? 4.0 : 2.0);
    }
    return 2.0 * sum * h / 3.0;
}

TEST(CoverageFactor, HoldsItsProbabilityForDegreesOfFreedomThatAreNotWhole) {
    for (const double nu : {0.7, 1.3, 2.5, 4.99, 7.3, 16.7518557376272, 25.6, 123.4, 5000.5}) {
        for (const double p : {0.6827, 0.95, 0.9545, 0.99}) {
            const double k = coverage_factor(p, nu);
            if (k < 100.0) {  // beyond, Simpson's rule with fixed steps is the weaker of the two
                EXPECT_NEAR(probability_within(k, nu), p, 1e-10) << "p = " << p << ", nu = " << nu;
            }
        }
    }
}

TEST(CoverageFactor, FallsWithDegreesOfFreedomToTheNormalValue) {
    double previous = coverage_factor(0.9545, 0.5);
    for (double nu = 0.6; nu < 1e12; nu *= 1.3) {
        const double k = coverage_factor(0.9545, nu);
        EXPECT_LE(k, previous * (1.0 + 1e-12)) << "nu = " << nu;
        previous = k;
    }
    EXPECT_TRUE(agrees(coverage_factor(0.9545, 1e300), coverage_factor(0.9545, k_infinity), 1e-12));
    EXPECT_TRUE(agrees(coverage_factor(0.95, k_infinity), 1.959963984540054, 1e-14));
}

/// mpmath with 40 digits: the regularised incomplete beta function, solved for t; the inverse error function.
TEST(CoverageFactor, KeepsItsDigitsForSmallProbabilities) {
    EXPECT_TRUE(agrees(coverage_factor(1e-10, 5), 1.3171527620701362e-10, 1e-14));
    EXPECT_TRUE(agrees(coverage_factor(1e-300, 5), 1.3171527620701362e-300, 1e-14));
    EXPECT_TRUE(agrees(coverage_factor(1e-4, 0.5), 0.00018540747091691423, 1e-13));
    EXPECT_TRUE(agrees(coverage_factor(1e-10, 1), 1.5707963267948967e-10, 1e-14));
    EXPECT_TRUE(agrees(coverage_factor(0.0009, 3), 0.0012243149786764623, 1e-13));
    EXPECT_TRUE(agrees(coverage_factor(1e-10, k_infinity), 1.2533141373155003e-10, 1e-14));
}

TEST(CoverageFactor, IsAboveZeroAndRisesWithTheProbability) {
    for (const double nu : {1e-3, 0.5, 1.0, 2.7, 30.0, 1e6, k_infinity}) {
        double previous = 0.0;
        for (double p = 1e-300; p < 0.1; p *= 1.7) {
            double k = std::numeric_limits<double>::infinity();
            try {
                k = coverage_factor(p, nu);
            } catch (const NoResultError&) {
                break;  // too large for a double, and so for every larger p
            }
            EXPECT_GT(k, previous) << "p = " << p << ", nu = " << nu;
            previous = k;
        }
    }
}

TEST(CoverageFactor, RefusesWhatIsNoProbability) {
    for (const double p : {0.0, 1.0, -0.1, 1.1, 95.45, std::nan(""), k_infinity}) {
        EXPECT_EQ(code_of<InputError>([&] { (void)coverage_factor(p, 10.0); }), "GC-GUM-0004") << p;
    }
    EXPECT_EQ(message_of<InputError>([] { (void)coverage_factor(95.45, 10.0); }),
              "coverage probability — 95.45 — must lie between 0 and 1, both excluded — "
              "State it as a fraction, e.g. 0.9545 for 95.45 %.");
}

TEST(CoverageFactor, RefusesDegreesOfFreedomThatAreNotPositive) {
    for (const double nu : {0.0, -1.0, -k_infinity, std::nan("")}) {
        EXPECT_EQ(code_of<InputError>([&] { (void)coverage_factor(0.95, nu); }), "GC-GUM-0005") << nu;
    }
}

TEST(CoverageFactor, SaysSoWhenThereIsNoFiniteValue) {
    EXPECT_EQ(code_of<NoResultError>([] { (void)coverage_factor(0.95, 1e-4); }), "GC-GUM-0010");
    EXPECT_EQ(code_of<NoResultError>([] { (void)coverage_factor(0.95, 5e-324); }), "GC-GUM-0010");
    // Whatever p and ν are: a finite factor or a refusal.
    for (double p : {1e-12, 1e-4, 9e-4, 1.1e-3, 0.1, 0.5, 0.9545, 0.999999}) {
        for (double nu = 5e-324; nu < 1.0; nu = nu < 1e-300 ? nu * 1e10 : nu * 1.3) {
            try {
                const double k = coverage_factor(p, nu);
                EXPECT_TRUE(std::isfinite(k) && k > 0.0) << p << " " << nu << " " << k;
            } catch (const NoResultError& error) {
                EXPECT_EQ(error.diagnostics().front().code, "GC-GUM-0010");
            }
        }
    }
}

TEST(ExpandedUncertainty, MassExampleOfTheGum) {
    // JCGM 100:2008, 7.2.4: u = 0.35 mg, nu = 9, k = 2.26, U = 0.79 mg.
    const double k = coverage_factor(0.95, 9);
    EXPECT_TRUE(prints_as(k, "2.26"));
    EXPECT_TRUE(prints_as(k * 0.35, "0.79"));
}

TEST(EffectiveDegreesOfFreedom, ProductExampleOfTheGum) {
    // JCGM 100:2008, G.4.1, EXAMPLE: relative contributions 0.25, 0.57 and 0.82 % with 9, 4 and 14 degrees of freedom.
    const std::vector<UncertaintyContribution> contributions{{0.0025, 9}, {0.0057, 4}, {0.0082, 14}};
    const double nu = effective_degrees_of_freedom(contributions);
    EXPECT_TRUE(prints_as(nu, "19.0"));
    EXPECT_TRUE(agrees(nu, 18.998742314268, 1e-12));
    EXPECT_TRUE(prints_as(coverage_factor(0.95, nu), "2.09"));
}

TEST(EffectiveDegreesOfFreedom, EndGaugeExampleOfTheGum) {
    // JCGM 100:2008, H.1, with the contributions as printed, in nm; documentation of WelchSatter in the R package
    // propagate. The published 16 is the value cut to the next lower integer.
    const std::vector<UncertaintyContribution> contributions{{25, 18}, {9.7, 25.6}, {2.9, 50}, {16.6, 2}};
    const double nu = effective_degrees_of_freedom(contributions);
    EXPECT_TRUE(agrees(nu, 16.7645539809172, 1e-12));
    EXPECT_EQ(std::floor(nu), 16.0);
    EXPECT_TRUE(agrees(coverage_factor(0.95, nu), 2.11207500180473, 1e-12));
    // u(d) = 9.7 nm has itself 25.6 degrees of freedom, from its three components; with them as printed it is 25.45,
    // and 25.6 needs the printed (rounded) 9.7 in the numerator.
    const std::vector<UncertaintyContribution> comparator{{5.8, 24}, {3.9, 5}, {6.7, 8}};
    const double nu_d = effective_degrees_of_freedom(comparator);
    const double u_d = std::sqrt(5.8 * 5.8 + 3.9 * 3.9 + 6.7 * 6.7);
    EXPECT_TRUE(prints_as(nu_d * std::pow(9.7 / u_d, 4), "25.6"));
}

TEST(EffectiveDegreesOfFreedom, OneInfiniteContribution) {
    // Sandia course example: u = 0.57 (nu 9) and 0.25 (infinite) give 12.8.
    const std::vector<UncertaintyContribution> contributions{{0.57, 9}, {0.25, k_infinity}};
    EXPECT_TRUE(prints_as(effective_degrees_of_freedom(contributions), "12.8"));
}

TEST(EffectiveDegreesOfFreedom, InfiniteWithoutFiniteContribution) {
    EXPECT_EQ(effective_degrees_of_freedom({}), k_infinity);
    const std::vector<UncertaintyContribution> only_infinite{{1.0, k_infinity}, {2.0, k_infinity}};
    EXPECT_EQ(effective_degrees_of_freedom(only_infinite), k_infinity);
    const std::vector<UncertaintyContribution> finite_is_zero{{1.0, k_infinity}, {0.0, 3}};
    EXPECT_EQ(effective_degrees_of_freedom(finite_is_zero), k_infinity);
    const std::vector<UncertaintyContribution> all_zero{{0.0, 5}, {0.0, 3}};
    EXPECT_EQ(effective_degrees_of_freedom(all_zero), k_infinity);
}

TEST(EffectiveDegreesOfFreedom, DoesNotDependOnTheUnit) {
    // 1e-100 in the unit of the input: a fourth power of it is below the smallest double.
    for (const double unit : {1e-100, 1e-9, 1e6, 1e100}) {
        const std::vector<UncertaintyContribution> contributions{
            {0.0025 * unit, 9}, {0.0057 * unit, 4}, {0.0082 * unit, 14}};
        EXPECT_TRUE(agrees(effective_degrees_of_freedom(contributions), 18.998742314268, 1e-12)) << unit;
    }
}

TEST(EffectiveDegreesOfFreedom, LiesBetweenTheSmallestAndTheSum) {
    const std::vector<UncertaintyContribution> contributions{{1.0, 3}, {0.5, 7}, {2.0, 11}};
    const double nu = effective_degrees_of_freedom(contributions);
    EXPECT_GE(nu, 3.0);
    EXPECT_LE(nu, 21.0);
    const std::vector<UncertaintyContribution> alone{{0.123, 4}};
    EXPECT_TRUE(agrees(effective_degrees_of_freedom(alone), 4.0, 1e-15));
}

TEST(EffectiveDegreesOfFreedom, RefusesBadContributions) {
    const auto of = [](UncertaintyContribution contribution) {
        return [contribution] { (void)effective_degrees_of_freedom(std::vector{contribution}); };
    };
    EXPECT_EQ(code_of<InputError>(of({-1e-6, 5})), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>(of({std::nan(""), 5})), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>(of({1e-6, 0})), "GC-GUM-0005");
    EXPECT_EQ(message_of<InputError>(of({-1e-6, 5})),
              "uncertainty contribution — -1e-06 — must not be negative — Correct the sign or the value.");
}

TEST(ChiSquare, PublishedTails) {
    // Key comparison of the golden vectors: chi-square 19.1142 with 5 degrees of freedom, p = 0.00183, critical value
    // 11.0705 for 5 %; without laboratory 5: 1.6480 with 4, p = 0.8001.
    EXPECT_TRUE(prints_as(chi_square_upper_tail(19.1142, 5), "0.00183"));
    EXPECT_TRUE(agrees(chi_square_upper_tail(11.0705, 5), 0.05, 1e-4));
    EXPECT_TRUE(prints_as(chi_square_upper_tail(1.6480, 4), "0.8001"));
}

TEST(ChiSquare, ClosedForms) {
    // With 2 degrees of freedom the upper tail is exp(-x/2); it keeps its digits far out.
    for (const double x : {0.0, 1e-10, 0.5, 5.0, 100.0, 1000.0}) {
        EXPECT_TRUE(agrees(chi_square_upper_tail(x, 2), std::exp(-x / 2.0), 1e-12)) << x;
        EXPECT_TRUE(agrees(chi_square_lower_tail(x, 2), -std::expm1(-x / 2.0), 1e-12)) << x;
    }
    for (const double nu : {1.0, 4.5, 36.0, 1000.0}) {
        for (const double x : {0.1 * nu, nu, 2.0 * nu}) {
            EXPECT_NEAR(chi_square_lower_tail(x, nu) + chi_square_upper_tail(x, nu), 1.0, 1e-14);
        }
    }
}

TEST(ChiSquare, RefusesArgumentsOutOfRange) {
    EXPECT_EQ(code_of<InputError>([] { (void)chi_square_upper_tail(-1.0, 5); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)chi_square_upper_tail(1.0, 0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)chi_square_lower_tail(1.0, k_infinity); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { (void)chi_square_lower_tail(std::nan(""), 5); }), "GC-GUM-0001");
}

TEST(StandardNormal, QuantilesAndCriticalValues) {
    EXPECT_EQ(standard_normal_quantile(0.5), 0.0);
    EXPECT_TRUE(agrees(standard_normal_quantile(0.975), 1.959963984540054, 1e-14));
    EXPECT_TRUE(agrees(standard_normal_quantile(0.025), -1.959963984540054, 1e-14));
    EXPECT_TRUE(agrees(two_sided_normal_critical_value(0.05), 1.959963984540054, 1e-14));
    for (const double alpha : {1e-12, 1e-4, 0.001, 0.05, 0.5}) {
        const double c = two_sided_normal_critical_value(alpha);
        EXPECT_TRUE(agrees(std::erfc(c / std::numbers::sqrt2), alpha, 1e-12)) << alpha;
    }
    EXPECT_EQ(code_of<InputError>([] { (void)standard_normal_quantile(1.0); }), "GC-GUM-0004");
    EXPECT_EQ(code_of<InputError>([] { (void)two_sided_normal_critical_value(0.0); }), "GC-GUM-0004");
}

TEST(EllipsoidCoverageFactor, KnownCovariance) {
    // JCGM 102:2011, 6.5.2: factors for p = 0.95.
    const std::vector<std::pair<std::size_t, const char*>> cases{{1, "1.96"}, {2, "2.45"},  {3, "2.80"}, {4, "3.08"},
                                                                 {5, "3.33"}, {10, "4.28"}, {20, "5.60"}};
    for (const auto& [outputs, k] : cases) {
        EXPECT_TRUE(prints_as(ellipsoid_coverage_factor(0.95, outputs, k_infinity), k)) << outputs;
    }
}

TEST(EllipsoidCoverageFactor, FiniteDegreesOfFreedom) {
    // One output: Student's t. Two: F(2, ν − 1) has a closed form, P(F > f) = (1 + 2 f/(ν − 1))^(−(ν − 1)/2).
    EXPECT_TRUE(agrees(ellipsoid_coverage_factor(0.95, 1, 9.0), coverage_factor(0.95, 9.0), 1e-12));
    const double nu = 6.5;
    const double f = (std::pow(0.05, -2.0 / (nu - 1.0)) - 1.0) * (nu - 1.0) / 2.0;
    EXPECT_TRUE(agrees(ellipsoid_coverage_factor(0.95, 2, nu), std::sqrt(2.0 * nu / (nu - 1.0) * f), 1e-12));
    EXPECT_TRUE(agrees(ellipsoid_coverage_factor(0.95, 2, 1e9), ellipsoid_coverage_factor(0.95, 2, k_infinity), 1e-8));
    EXPECT_EQ(code_of<NoResultError>([] { (void)ellipsoid_coverage_factor(0.95, 3, 2.0); }), "GC-GUM-0011");
    EXPECT_EQ(code_of<InputError>([] { (void)ellipsoid_coverage_factor(1.0, 2, 5.0); }), "GC-GUM-0004");
}

// F(2, ν) has a closed form, P(F > f) = (1 + 2 f/ν)^(−ν/2): k_p = √(ν (α^(−2/ν) − 1)), for every ν.
TEST(EllipsoidCoverageFactor, OfOneScale) {
    for (const double nu : {0.5, 1.0, 2.0, 6.0, 8.5, 100.0}) {
        EXPECT_TRUE(agrees(ellipsoid_coverage_factor(0.95, 2, nu, EstimatedSpread::scale),
                           std::sqrt(nu * (std::pow(0.05, -2.0 / nu) - 1.0)), 1e-10))
            << nu;
        EXPECT_TRUE(
            agrees(ellipsoid_coverage_factor(0.95, 1, nu, EstimatedSpread::scale), coverage_factor(0.95, nu), 1e-10))
            << nu;
    }
}

TEST(EllipsoidFactor, RefusesWhatHasNoFactor) {
    EXPECT_EQ(code_of<InputError>([] { (void)ellipsoid_coverage_factor(0.95, 0, 2.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)ellipsoid_coverage_factor(0.95, 0, k_infinity); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<NoResultError>([] { (void)ellipsoid_coverage_factor(0.95, 3, 2.0000001); }), "GC-GUM-0010");
}

// Student's t with 1 and 2 degrees of freedom has closed forms: 1 − (2/π) atan t, and 1 − t/√(2 + t²).
TEST(TwoSidedTailOfT, ClosedForms) {
    for (const double t : {0.0, 0.3, 1.0, 4.303, 12.706}) {
        EXPECT_NEAR(two_sided_tail_of_t(t, 1.0), 1.0 - 2.0 / std::numbers::pi * std::atan(t), 1e-15) << t;
        EXPECT_NEAR(two_sided_tail_of_t(t, 2.0), 1.0 - t / std::sqrt(2.0 + t * t), 1e-15) << t;
        EXPECT_TRUE(agrees(two_sided_tail_of_t(t, k_infinity), std::erfc(t / std::numbers::sqrt2), 1e-14)) << t;
    }
    for (const double nu : {1.0, 3.5, 40.0, k_infinity}) {
        EXPECT_TRUE(agrees(two_sided_tail_of_t(coverage_factor(0.95, nu), nu), 0.05, 1e-12)) << nu;
    }
    EXPECT_EQ(code_of<InputError>([] { (void)two_sided_tail_of_t(-1.0, 3.0); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)two_sided_tail_of_t(1.0, 0.0); }), "GC-GUM-0005");
}

}  // namespace
}  // namespace gumcert::gum
