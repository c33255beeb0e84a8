#include "gum/conformity/global_risk.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::printed;
using test::prints_as;

const ToleranceLimits k_risk_tolerance{.lower = -1.0, .upper = 1.0};

GlobalRisk unguarded(double deviation, double u) {
    return global_risk(k_risk_tolerance, k_risk_tolerance, 0.0, deviation, u);
}

/// Percentages as the table prints them, within 1e-3 relative or half a unit of the last digit.
bool as_in_the_table(double risk, const char* percent) {
    return prints_as(100.0 * risk, percent) || agrees(100.0 * risk, printed(percent).value, 1e-3);
}

TEST(GlobalRisk, CentredPopulation) {
    // T = 1, s0 = 0.5, u = 0.125; the digits by Gauss–Legendre of 60 points in 400 panels with SciPy.
    const GlobalRisk risk = unguarded(0.5, 0.125);
    EXPECT_TRUE(prints_as(100.0 * risk.false_accept, "0.8006"));
    EXPECT_TRUE(prints_as(100.0 * risk.false_reject, "1.4851"));
    EXPECT_TRUE(agrees(risk.false_accept, 0.00800608483445009, 1e-12));
    EXPECT_TRUE(agrees(risk.false_reject, 0.0148508842112549, 1e-12));
    // The manual of the Sandia uncertainty calculator prints 0.78 % and 1.47 % for the same case, from a coarse
    // numerical integration: 2.6 % of the risk is the tolerance that its resolution asks for.
    EXPECT_TRUE(agrees(100.0 * risk.false_accept, 0.78, 0.03));
    EXPECT_TRUE(agrees(100.0 * risk.false_reject, 1.47, 0.015));
}

TEST(GlobalRisk, AgainstReliabilityAndRatio) {
    struct Case {
        double ratio, reliability;
        const char *false_accept, *false_reject;  // percent
    };
    for (const Case& c : std::vector<Case>{
             {4.0, 0.89, "1.456", "2.162"}, {2.0, 0.95, "1.337", "4.178"}, {1.0, 0.89, "3.509", "13.693"}}) {
        const GlobalRisk risk = unguarded(population_deviation(1.0, c.reliability), 0.5 / c.ratio);
        EXPECT_TRUE(prints_as(100.0 * risk.false_accept, c.false_accept)) << c.ratio;
        EXPECT_TRUE(prints_as(100.0 * risk.false_reject, c.false_reject)) << c.ratio;
    }
    EXPECT_TRUE(prints_as(100.0 * unguarded(population_deviation(1.0, 0.95), 0.125).false_accept, "0.86"));
}

TEST(GlobalRisk, AnyLimitsAndCentres) {
    // By Gauss–Legendre of 60 points in 400 panels with SciPy.
    struct Case {
        ToleranceLimits tolerance, acceptance;
        double centre, deviation, u;
        double false_accept, false_reject, conditional;
    };
    const ToleranceLimits upper{.upper = 1.0};
    const ToleranceLimits lower{.lower = -1.0};
    for (const Case& c : std::vector<Case>{
             {k_risk_tolerance,
              {-0.9, 0.95},
              0.3,
              0.5,
              0.2,
              0.0131419906046985,
              0.0543652125932148,
              0.0150476397983962},
             {upper, {.upper = 0.9}, 0.2, 0.4, 0.1, 0.000906110617891028, 0.0229335158765331, 0.000948585961056085},
             {lower, {.lower = -0.9}, -0.2, 0.4, 0.1, 0.000906110617891028, 0.0229335158765331, 0.000948585961056085},
             {k_risk_tolerance, k_risk_tolerance, 0.0, 0.5, 4.0, 0.00859675905903134, 0.767177152634634,
              0.0438790726229649},
             {k_risk_tolerance, k_risk_tolerance, 0.0, 0.5, 1e-3, 8.59414977533865e-05, 8.63734259174217e-05,
              9.00383031998385e-05},
             {k_risk_tolerance,
              {-1.25, 1.25},
              0.0,
              0.5,
              0.125,
              0.0304798052408626,
              0.000272912374703095,
              0.0309531837647427}}) {
        const GlobalRisk risk = global_risk(c.tolerance, c.acceptance, c.centre, c.deviation, c.u);
        EXPECT_TRUE(agrees(risk.false_accept, c.false_accept, 1e-11)) << c.u;
        EXPECT_TRUE(agrees(risk.false_reject, c.false_reject, 1e-11)) << c.u;
        EXPECT_TRUE(agrees(risk.conditional_false_accept, c.conditional, 1e-11)) << c.u;
    }
}

TEST(GlobalRisk, AddsUpToTheProbabilities) {
    // P(accepted and bad) + P(accepted and good) = P(accepted), with P(accepted and good) = P(good) − PFR.
    for (const double deviation : {1e-3, 0.1, 0.7, 3.0, 1e4}) {
        for (const double u : {1e-6, 0.01, 0.3, 2.0, 1e3}) {
            const ToleranceLimits acceptance{.lower = -0.8, .upper = 0.9};
            const GlobalRisk risk = global_risk(k_risk_tolerance, acceptance, 0.2, deviation, u);
            const auto inside = [](double a, double b) {
                return 0.5 * (std::erf(b / std::sqrt(2.0)) - std::erf(a / std::sqrt(2.0)));
            };
            const double good = inside(-1.2 / deviation, 0.8 / deviation);
            const double spread = std::hypot(deviation, u);
            EXPECT_NEAR(risk.false_accept + good - risk.false_reject, inside(-1.0 / spread, 0.7 / spread), 3e-14)
                << deviation << ' ' << u;
        }
    }
}

TEST(GlobalRisk, DoesNotDependOnTheUnit) {
    const GlobalRisk one = global_risk({9.0, 10.0}, {9.1, 9.9}, 9.6, 0.2, 0.05);
    for (const double scale : {1e-9, 0.0254, 1e9}) {
        const GlobalRisk other = global_risk({9.0 * scale, 10.0 * scale}, {9.1 * scale, 9.9 * scale}, 9.6 * scale,
                                             0.2 * scale, 0.05 * scale);
        EXPECT_TRUE(agrees(other.false_accept, one.false_accept, 1e-11)) << scale;
        EXPECT_TRUE(agrees(other.false_reject, one.false_reject, 1e-11)) << scale;
    }
}

/// What lies below the limits by many standard deviations is as rare as what lies above: no digit is lost on either side.
TEST(GlobalRisk, KeepsItsDigitsFarFromTheLimits) {
    for (int i = 2; i <= 12; ++i) {
        const double centre = 1.0 * i;
        const GlobalRisk above = global_risk({-1.0, 1.0}, {-0.8, 0.9}, centre, 0.9, 0.2);
        const GlobalRisk below = global_risk({-1.0, 1.0}, {-0.9, 0.8}, -centre, 0.9, 0.2);
        EXPECT_GT(above.conditional_false_accept, 0.0) << centre;
        EXPECT_TRUE(agrees(below.conditional_false_accept, above.conditional_false_accept, 1e-9)) << centre;
        EXPECT_TRUE(agrees(below.false_accept, above.false_accept, 1e-9)) << centre;
    }
}

TEST(GlobalRisk, NothingAccepted) {
    const GlobalRisk risk = global_risk(k_risk_tolerance, {0.1, -0.1}, 0.0, 0.5, 0.1);
    EXPECT_EQ(risk.false_accept, 0.0);
    EXPECT_EQ(risk.conditional_false_accept, 0.0);
    EXPECT_TRUE(agrees(risk.false_reject, 0.954499736103642, 1e-13));  // every good item
}

TEST(GlobalRisk, RefusesWhatIsOutOfRange) {
    EXPECT_EQ(code_of<InputError>([] { (void)global_risk({}, {}, 0.0, 1.0, 1.0); }), "GC-GUM-0080");
    EXPECT_EQ(code_of<InputError>([] { (void)global_risk({1.0, 1.0}, {}, 0.0, 1.0, 1.0); }), "GC-GUM-0080");
    EXPECT_EQ(code_of<InputError>([] { (void)unguarded(0.0, 1.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)unguarded(1.0, -1.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)unguarded(std::numeric_limits<double>::quiet_NaN(), 1.0); }),
              "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { (void)largest_false_accept({.upper = 1.0}, {.upper = 1.0}, 1.0); }),
              "GC-GUM-0080");
}

TEST(LargestFalseAccept, TableOfHandbookMethods) {
    // Worst case over the reliability of the population, T = 1, k = 2 (certificate notes, 3.3), in percent.
    struct Row {
        double ratio;
        const char *unguarded, *multiple, *a6, *method6, *a_rds, *rds, *a5, *method5;
    };
    for (const Row& row : std::vector<Row>{{1.0, "7.37", "0.4573", "0.5427", "1.92", "0", "0", "0", "0"},
                                           {1.5, "5.33", "0.3602", "0.7599", "1.91", "0.7454", "1.78", "0.333", "0.12"},
                                           {2.0, "4.18", "0.2816", "0.8592", "1.92", "0.8660", "2.00", "0.500", "0.09"},
                                           {3.0, "2.91", "0.1553", "0.9482", "1.94", "0.9428", "1.85", "0.667", "0.06"},
                                           {4.0, "2.24", "0.0531", "0.9867", "1.96", "0.9682", "1.61", "0.750", "0.05"},
                                           {4.6, "1.96", "0", "1.0000", "1.96", "0.9761", "1.48", "0.783", "0.04"},
                                           {6.0, "1.53", "0", "1.0000", "1.53", "0.9860", "1.23", "0.833", "0.03"}}) {
        const double U = 1.0 / row.ratio;
        const auto largest = [&](double a) {
            return largest_false_accept(k_risk_tolerance, guarded_limits(k_risk_tolerance, 1.0 - a), 0.5 * U);
        };
        const double multiple = std::max(0.0, 1.04 - std::exp(0.38 * std::log(row.ratio) - 0.54));
        EXPECT_NEAR(multiple, printed(row.multiple).value, 5.1e-5);
        EXPECT_TRUE(prints_as(1.0 - multiple * U, row.a6));
        EXPECT_TRUE(as_in_the_table(largest(1.0), row.unguarded)) << row.ratio;
        EXPECT_TRUE(as_in_the_table(largest(1.0 - multiple * U), row.method6)) << row.ratio;
        EXPECT_NEAR(largest(std::sqrt(1.0 - U * U)), printed(row.rds).value / 100.0, 5e-5) << row.ratio;
        EXPECT_NEAR(largest(1.0 - U), printed(row.method5).value / 100.0, 5e-5) << row.ratio;
    }
    // All digits at a ratio of 4, by bounded minimisation with SciPy.
    EXPECT_TRUE(agrees(largest_false_accept(k_risk_tolerance, k_risk_tolerance, 0.125), 0.022382048613, 1e-10));
    EXPECT_TRUE(agrees(largest_false_accept(k_risk_tolerance, k_risk_tolerance, 0.5), 0.073726784181, 1e-10));
}

TEST(LargestFalseAccept, IsNeverExceeded) {
    for (const double u : {0.01, 0.125, 0.5, 2.0, 20.0}) {
        const double largest = largest_false_accept(k_risk_tolerance, k_risk_tolerance, u);
        for (double deviation = 0.01; deviation < 1000.0; deviation *= 1.17) {
            EXPECT_LE(unguarded(deviation, u).false_accept, largest * (1.0 + 1e-12)) << deviation << ' ' << u;
        }
    }
}

TEST(PopulationDeviation, FromReliability) {
    EXPECT_TRUE(agrees(population_deviation(2.0, 0.9544997361036416), 1.0, 1e-12));
    EXPECT_TRUE(agrees(*population_deviation(k_risk_tolerance, 0.0, 0.9), population_deviation(1.0, 0.9), 1e-14));
    EXPECT_TRUE(agrees(*population_deviation(k_risk_tolerance, 0.3, 0.9), 0.529252944525274, 1e-12));
    EXPECT_TRUE(agrees(*population_deviation({.upper = 1.0}, 0.0, 0.977249868051821), 0.5, 1e-12));
    EXPECT_TRUE(agrees(*population_deviation({.lower = -1.0}, 0.0, 0.977249868051821), 0.5, 1e-12));
    EXPECT_FALSE(population_deviation({.upper = 1.0}, 0.0, 0.5));
    EXPECT_FALSE(population_deviation(k_risk_tolerance, 1.0, 0.9));
    EXPECT_FALSE(population_deviation(k_risk_tolerance, -1.2, 0.9));
    EXPECT_EQ(code_of<InputError>([] { (void)population_deviation(1.0, 1.0); }), "GC-GUM-0004");
}

TEST(PopulationDeviation, FromObservedDeviation) {
    EXPECT_TRUE(agrees(*population_deviation_from_observed(0.5, 0.3), 0.4, 1e-15));
    EXPECT_FALSE(population_deviation_from_observed(0.3, 0.3));
    EXPECT_FALSE(population_deviation_from_observed(0.2, 0.3));
}

TEST(GuardBandForGlobalRisk, SolvesForTheRisk) {
    // EOPR 0.9, TUR 2, 1 %: by Brent's method with SciPy.
    const double s0 = population_deviation(1.0, 0.9);
    EXPECT_TRUE(agrees(*guard_band_for_global_risk(k_risk_tolerance, 0.0, s0, 0.25, 0.01, FalseAccept::unconditional),
                       0.154418217216571, 1e-11));
    EXPECT_TRUE(agrees(*guard_band_for_global_risk(k_risk_tolerance, 0.0, s0, 0.25, 0.01, FalseAccept::conditional),
                       0.193420634667528, 1e-11));
    // Unguarded, the risk is 2.26 %: no guard band is needed for 3 %.
    EXPECT_EQ(guard_band_for_global_risk(k_risk_tolerance, 0.0, s0, 0.25, 0.03, FalseAccept::unconditional), 0.0);
}

TEST(GuardBandForGlobalRisk, KeepsTheLimitOnEitherSide) {
    for (const ToleranceLimits& limits : {ToleranceLimits{.upper = 1.0}, ToleranceLimits{.lower = -1.0}}) {
        const auto w = guard_band_for_global_risk(limits, 0.0, 0.6, 0.3, 0.005, FalseAccept::unconditional);
        ASSERT_TRUE(w);
        const double risk = global_risk(limits, guarded_limits(limits, *w), 0.0, 0.6, 0.3).false_accept;
        EXPECT_LE(risk, 0.005 * (1.0 + 1e-14));
        EXPECT_TRUE(agrees(risk, 0.005, 1e-11));
    }
}

TEST(GuardBandForGlobalRisk, ThereMayBeNone) {
    // A wide population measured badly: the best reading still says little.
    EXPECT_FALSE(guard_band_for_global_risk(k_risk_tolerance, 0.0, 3.0, 2.0, 0.02, FalseAccept::conditional));
    EXPECT_TRUE(guard_band_for_global_risk(k_risk_tolerance, 0.0, 3.0, 2.0, 0.02, FalseAccept::unconditional));
}

}  // namespace
}  // namespace gumcert::gum
