#include "gum/conformity/conformance_probability.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::prints_as;

const ToleranceLimits k_unit_tolerance{.lower = -1.0, .upper = 1.0};

MeasuredValue normal(double y, double u) {
    return {.value = y, .standard_uncertainty = u, .expanded_uncertainty = 2.0 * u};
}
MeasuredValue student(double y, double u, double degrees_of_freedom) {
    return {.value = y,
            .standard_uncertainty = u,
            .expanded_uncertainty = coverage_factor(0.9545, degrees_of_freedom) * u,
            .degrees_of_freedom = degrees_of_freedom};
}
MeasuredValue of(const Distribution& distribution) {
    const double u = standard_deviation(distribution);
    return {.value = expectation(distribution),
            .standard_uncertainty = u,
            .expanded_uncertainty = 2.0 * u,
            .distribution = [distribution](double x) { return lower_tail_probability(distribution, x); }};
}

/// A value, whose distribution is cut at 0: what would be below has no probability, or is 0 itself.
MeasuredValue cut_at_0(double value, bool with_atom, bool above = false) {
    const auto shape = [value, with_atom](double x, bool with) {
        const double below = lower_tail_probability(Distribution::normal(value, 1.0), with_atom ? x : 0.0);
        const double all = 1.0 - below;
        if (with_atom) {
            return x < 0.0 || (x == 0.0 && !with) ? 0.0 : below;
        }
        return x <= 0.0 ? 0.0 : (lower_tail_probability(Distribution::normal(value, 1.0), x) - below) / all;
    };
    MeasuredValue y = normal(above ? -value : value, 1.0);
    y.distribution = [=](double x) { return above ? 1.0 - shape(-x, false) : shape(x, true); };
    y.distribution_below = [=](double x) { return above ? 1.0 - shape(-x, true) : shape(x, false); };
    return y;
}

using BothLimits = std::pair<std::optional<double>, std::optional<double>>;
BothLimits both(const ToleranceLimits& limits) {
    return {limits.lower, limits.upper};
}
BothLimits passable(const MeasuredValue& y, const ToleranceLimits& limits) {
    return both(limits_that_can_be_passed(y, limits));
}

TEST(LimitsThatCanBePassed, AreThoseBeyondWhichTheQuantityCanBe) {
    for (const bool with_atom : {true, false}) {
        const MeasuredValue y = cut_at_0(0.5, with_atom);
        EXPECT_EQ(passable(y, {.lower = 0.0, .upper = 3.0}), both({.upper = 3.0}));
        for (const ToleranceLimits& all : {ToleranceLimits{.lower = 0.4, .upper = 3.0}, ToleranceLimits{.lower = -1.0},
                                           ToleranceLimits{.upper = 0.0}}) {
            EXPECT_EQ(passable(y, all), both(all));
        }
        const MeasuredValue negative = cut_at_0(0.5, with_atom, true);
        EXPECT_EQ(passable(negative, {.lower = -3.0, .upper = 0.0}), both({.lower = -3.0}));
        EXPECT_EQ(passable(negative, {.lower = 0.0}), both({.lower = 0.0}));
    }
    // Far from 0 only the chance of the trials keeps all of them above it, and lets one fall beside it.
    for (const double far : {4.2, 4.5, 5.0}) {
        const ToleranceLimits limits{.lower = 0.0, .upper = 20.0};
        EXPECT_EQ(passable(cut_at_0(far, false), limits), both(limits));
        EXPECT_EQ(passable(cut_at_0(far, true), limits), both(limits));
    }
    EXPECT_EQ(passable(normal(0.0, 1.0), {.lower = 0.0}), both({.lower = 0.0}));
}

TEST(HasProbabilityOfItsOwn, IsThatOfASingleValue) {
    EXPECT_TRUE(has_probability_of_its_own(cut_at_0(0.5, true), 0.0));
    EXPECT_TRUE(has_probability_of_its_own(cut_at_0(0.5, true, true), 0.0));
    EXPECT_FALSE(has_probability_of_its_own(cut_at_0(0.5, true), 0.5));
    EXPECT_FALSE(has_probability_of_its_own(cut_at_0(0.5, false), 0.0));
    EXPECT_FALSE(has_probability_of_its_own(cut_at_0(4.5, true), 0.0));
    EXPECT_FALSE(has_probability_of_its_own(normal(0.0, 1.0), 0.0));
}

TEST(ConformanceProbability, NormalTwoSided) {
    // Golden vector 4, also the example of the manual of the Sandia uncertainty calculator: risk 2.28 %.
    const double p = conformance_probability(normal(9.8, 0.1), {9.0, 10.0});
    EXPECT_TRUE(prints_as(p, "0.977250"));
    EXPECT_TRUE(agrees(p, 0.977249868051820, 1e-13));
    EXPECT_TRUE(prints_as(100.0 * nonconformance_probability(normal(9.8, 0.1), {9.0, 10.0}), "2.28"));
}

TEST(ConformanceProbability, OneSided) {
    EXPECT_TRUE(agrees(conformance_probability(normal(9.8, 0.1), {.upper = 10.0}), 0.977249868051821, 1e-13));
    EXPECT_TRUE(agrees(conformance_probability(normal(9.8, 0.1), {.lower = 9.9}), 0.158655253931457, 1e-13));
    EXPECT_EQ(conformance_probability(normal(9.8, 0.1), {.lower = 9.8}), 0.5);
}

TEST(ConformanceProbability, SmallRatiosUseBothTails) {
    EXPECT_TRUE(prints_as(100.0 * conformance_probability(normal(0.0, 0.5), k_unit_tolerance), "95.45"));
    EXPECT_TRUE(prints_as(100.0 * conformance_probability(normal(0.0, 0.625), k_unit_tolerance), "89.0"));
}

TEST(ConformanceProbability, KeepsItsDigitsInBothTails) {
    EXPECT_TRUE(agrees(nonconformance_probability(normal(0.0, 0.1), k_unit_tolerance), 1.5239706048321052e-23, 1e-13));
    EXPECT_TRUE(agrees(conformance_probability(normal(2.0, 0.1), k_unit_tolerance), 7.61985302416e-24, 1e-11));
    EXPECT_TRUE(agrees(conformance_probability(normal(-2.0, 0.1), k_unit_tolerance), 7.61985302416e-24, 1e-11));
}

TEST(ConformanceProbability, OfStudentAndOfGivenDistributions) {
    EXPECT_TRUE(agrees(conformance_probability(student(10.1, 0.05, 5.0), {9.9, 10.2}), 0.943868552844655, 1e-12));
    const MeasuredValue rectangular = of(Distribution::uniform(10.05, 0.25));
    EXPECT_TRUE(agrees(conformance_probability(rectangular, {.upper = 10.2}), 0.8, 1e-13));
    EXPECT_TRUE(agrees(conformance_probability(rectangular, {9.9, 10.2}), 0.6, 1e-13));
    EXPECT_EQ(conformance_probability(rectangular, {10.4, 11.0}), 0.0);
    EXPECT_EQ(conformance_probability(rectangular, {9.0, 11.0}), 1.0);
    EXPECT_EQ(distribution_function(rectangular, 10.05), 0.5);
}

TEST(ConformanceProbability, GrowsWithTheLimits) {
    for (const MeasuredValue& y : {normal(0.2, 0.3), student(0.2, 0.3, 3.0), of(Distribution::uniform(0.2, 0.5))}) {
        double last = 0.0;
        for (double half = 0.01; half < 20.0; half *= 1.3) {
            const double p = conformance_probability(y, {-half, half});
            EXPECT_GE(p, last);
            EXPECT_LE(p, 1.0);
            EXPECT_NEAR(p + nonconformance_probability(y, {-half, half}), 1.0, 1e-14);
            last = p;
        }
    }
}

TEST(ConformanceProbability, RefusesWhatIsOutOfRange) {
    const auto code = [](const MeasuredValue& y, const ToleranceLimits& limits) {
        return code_of<InputError>([&] { (void)conformance_probability(y, limits); });
    };
    EXPECT_EQ(code(normal(0.0, 1.0), {}), "GC-GUM-0080");
    EXPECT_EQ(code(normal(0.0, 1.0), {1.0, 1.0}), "GC-GUM-0080");
    EXPECT_EQ(code(normal(0.0, 1.0), {.upper = k_infinity}), "GC-GUM-0080");
    EXPECT_EQ(code(normal(0.0, 0.0), k_unit_tolerance), "GC-GUM-0081");
    EXPECT_EQ(code(normal(k_infinity, 1.0), k_unit_tolerance), "GC-GUM-0081");
    EXPECT_EQ(code({.value = 0.0, .standard_uncertainty = 1.0}, k_unit_tolerance), "GC-GUM-0081");
    MeasuredValue none = normal(0.0, 1.0);
    none.degrees_of_freedom = 0.0;
    EXPECT_EQ(code(none, k_unit_tolerance), "GC-GUM-0081");
}

TEST(AcceptanceLimitsForRisk, OneSidedFactorWhereTheToleranceIsWide) {
    const ToleranceLimits accepted = *acceptance_limits_for_risk(normal(3.0, 0.01), k_unit_tolerance, 0.05);
    EXPECT_TRUE(agrees(1.0 - *accepted.upper, 0.0164485362695147, 1e-13));
    EXPECT_TRUE(agrees(*accepted.lower + 1.0, 0.0164485362695147, 1e-13));
    const auto upper = acceptance_limits_for_risk(normal(3.0, 0.5), {.upper = 1.0}, 0.05);
    EXPECT_FALSE(upper->lower);
    EXPECT_TRUE(agrees(1.0 - *upper->upper, 0.822426813475736, 1e-13));
}

TEST(AcceptanceLimitsForRisk, BothTailsWhereItIsNarrow) {
    // By Brent's method with SciPy.
    struct Case {
        double u, degrees_of_freedom, accepted, rejected;
    };
    for (const Case& c : std::vector<Case>{{0.45, k_infinity, 0.247379946360962, 1.74018412965409},
                                           {0.4, 8.0, 0.209510392446798, 1.74348125643053},
                                           {0.2, k_infinity, 0.671029274609705, 1.32897072539029},
                                           {0.2, 8.0, 0.628040211693176, 1.37190655371926}}) {
        const MeasuredValue y = student(5.0, c.u, c.degrees_of_freedom);
        const auto accepted = acceptance_limits_for_risk(y, k_unit_tolerance, 0.05);
        ASSERT_TRUE(accepted);
        EXPECT_TRUE(agrees(*accepted->upper, c.accepted, 1e-11)) << c.u;
        EXPECT_TRUE(agrees(*accepted->lower, -c.accepted, 1e-11)) << c.u;
        const ToleranceLimits rejected = rejection_limits_for_probability(y, k_unit_tolerance, 0.95);
        EXPECT_TRUE(agrees(*rejected.upper, c.rejected, 1e-11)) << c.u;
        EXPECT_TRUE(agrees(*rejected.lower, -c.rejected, 1e-11)) << c.u;
    }
    // Even in the middle, 5.7 % are outside.
    EXPECT_FALSE(acceptance_limits_for_risk(student(0.0, 0.45, 8.0), k_unit_tolerance, 0.05));
    EXPECT_FALSE(acceptance_limits_for_risk(normal(0.0, 5.0), k_unit_tolerance, 0.05));
}

TEST(AcceptanceLimitsForRisk, OfGivenDistributions) {
    // A rectangular value may come as near to a limit as 0.9 of its half-width for 5 %.
    const auto rectangular = acceptance_limits_for_risk(of(Distribution::uniform(7.0, 0.5)), k_unit_tolerance, 0.05);
    EXPECT_TRUE(agrees(*rectangular->upper, 0.55, 1e-12));
    EXPECT_TRUE(agrees(*rectangular->lower, -0.55, 1e-12));
    // Exponential with the scale 0.02: its estimate lies 0.02 above its start, its quantiles −0.02 ln(1 − p) above it.
    const Distribution skewed{.kind = DistributionKind::exponential, .location = 0.0, .scale = 0.02};
    const auto exponential = acceptance_limits_for_risk(of(skewed), k_unit_tolerance, 0.05);
    EXPECT_TRUE(agrees(*exponential->upper, 1.0 + 0.02 * (1.0 + std::log(0.05)), 1e-10));
    EXPECT_TRUE(agrees(*exponential->lower, -1.0 + 0.02 * (1.0 + std::log(0.95)), 1e-10));
    for (const MeasuredValue& y : {of(skewed), of(Distribution::uniform(7.0, 0.5))}) {
        const auto limits = acceptance_limits_for_risk(y, k_unit_tolerance, 0.05);
        EXPECT_TRUE(agrees(nonconformance_probability_at(*limits->upper, y, k_unit_tolerance), 0.05, 1e-9));
        EXPECT_TRUE(agrees(nonconformance_probability_at(*limits->lower, y, k_unit_tolerance), 0.05, 1e-9));
    }
}

TEST(AcceptanceLimitsForRisk, OfASkewedDistributionInANarrowTolerance) {
    // Exponential, scale 0.6, in ±1: with its estimate in the middle (start at −0.6), 7 % are above; with the start on
    // the lower limit, exp(−2/0.6) = 3.6 %.
    const MeasuredValue y = of({.kind = DistributionKind::exponential, .location = 0.0, .scale = 0.6});
    EXPECT_TRUE(agrees(nonconformance_probability_at(0.0, y, k_unit_tolerance), std::exp(-1.6 / 0.6), 1e-12));
    const auto limits = acceptance_limits_for_risk(y, k_unit_tolerance, 0.05);
    ASSERT_TRUE(limits);
    EXPECT_TRUE(agrees(*limits->upper, 1.0 + 0.6 * (1.0 + std::log(0.05)), 1e-10));
    EXPECT_LT(*limits->lower, -0.4);
    EXPECT_TRUE(agrees(nonconformance_probability_at(*limits->lower, y, k_unit_tolerance), 0.05, 1e-9));
    EXPECT_FALSE(acceptance_limits_for_risk(y, k_unit_tolerance, 0.03));
}

TEST(AcceptanceLimitsForRisk, OfAConvolution) {
    const std::vector<ConvolutionTerm> terms{{1.0, Distribution::uniform(0.0, 0.5)},
                                             {1.0, Distribution::normal(0.0, 0.05)}};
    const ConvolutionDistribution about_zero(terms);
    MeasuredValue y{.value = 0.4, .standard_uncertainty = 0.293, .expanded_uncertainty = 0.5};
    y.distribution = [about_zero](double x) { return about_zero(x - 0.4); };
    const auto accepted = acceptance_limits_for_risk(y, {.upper = 1.0}, 0.02275);
    ASSERT_TRUE(accepted);
    // The normal distribution would ask for 2 u = 0.586.
    EXPECT_TRUE(agrees(1.0 - about_zero(1.0 - *accepted->upper), 0.02275, 1e-9));
    EXPECT_NEAR(1.0 - *accepted->upper, convolution_half_width(terms, 0.9545), 1e-6);
}

TEST(AcceptanceLimitsForRisk, RefusesRisksOutOfRange) {
    EXPECT_EQ(code_of<InputError>([] { (void)acceptance_limits_for_risk(normal(0.0, 1.0), k_unit_tolerance, 0.6); }),
              "GC-GUM-0082");
    for (const double outside : {0.4, 0.5, 1.0}) {
        EXPECT_EQ(code_of<InputError>([outside] {
                      (void)rejection_limits_for_probability(normal(0.0, 1.0), k_unit_tolerance, outside);
                  }),
                  "GC-GUM-0082")
            << outside;
    }
}

/// Few values with probabilities, as samples give them; the value is a multiple of a tenth.
MeasuredValue of_points(double value, const std::vector<std::pair<double, double>>& deviations) {
    const auto sum = [value, deviations](double x, bool with) {
        double p = 0.0;
        for (const auto& [d, q] : deviations) {
            const double at = value + d;
            const double same = 1e-12;
            p += at < x - same || (with && at <= x + same) ? q : 0.0;
        }
        return std::min(p, 1.0);
    };
    return {.value = value,
            .standard_uncertainty = 0.2,
            .expanded_uncertainty = 0.4,
            .distribution = [sum](double x) { return sum(x, true); },
            .distribution_below = [sum](double x) { return sum(x, false); }};
}

// At a jump of the risk the limit is the side that is accepted.
TEST(AcceptanceLimitsForRisk, KeepToTheRiskWhereItJumps) {
    int limits_seen = 0;
    for (const double value : {0.7, 1.3, 20.1, 1550.3}) {
        for (const double risk : {0.01, 0.05, 0.15, 0.3}) {
            const MeasuredValue y = of_points(
                value, {{-0.4, 0.02}, {-0.3, 0.08}, {-0.1, 0.2}, {0.0, 0.4}, {0.1, 0.2}, {0.3, 0.07}, {0.4, 0.03}});
            for (const ToleranceLimits& tolerance : {ToleranceLimits{.lower = {}, .upper = value + 0.4},
                                                     ToleranceLimits{.lower = value - 0.4, .upper = {}},
                                                     ToleranceLimits{.lower = value - 0.5, .upper = value + 0.4}}) {
                const auto accepted = acceptance_limits_for_risk(y, tolerance, risk);
                ASSERT_TRUE(accepted);
                for (const auto& limit : {accepted->lower, accepted->upper}) {
                    if (limit) {
                        EXPECT_LE(nonconformance_probability_at(*limit, y, tolerance), risk * (1.0 + 1e-12));
                        ++limits_seen;
                    }
                }
            }
        }
    }
    EXPECT_EQ(limits_seen, 4 * 4 * 4);
}

// All values fill the tolerance just so: y keeps to the risk, and rounding makes AL larger than AU.
TEST(AcceptanceLimitsForRisk, AcceptAValueThatKeepsToTheRisk) {
    for (const double third : {0.1, 0.15, 0.7, 1.0 / 3.0}) {
        const MeasuredValue y = of_points(3.0 * third, {{-third, 0.3}, {0.0, 0.4}, {third, 0.3}});
        const ToleranceLimits tolerance{.lower = 2.0 * third, .upper = 4.0 * third};
        ASSERT_EQ(nonconformance_probability(y, tolerance), 0.0) << third;
        const auto accepted = acceptance_limits_for_risk(y, tolerance, 0.05);
        ASSERT_TRUE(accepted) << third;
        EXPECT_LE(*accepted->lower, y.value);
        EXPECT_GE(*accepted->upper, y.value);
    }
}

}  // namespace
}  // namespace gumcert::gum
