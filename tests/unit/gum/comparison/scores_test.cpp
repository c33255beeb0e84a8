#include "gum/comparison/scores.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"
#include "gum/type_b.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

ComparedValue with_k_2(double value, double U) {
    return {.value = value, .standard_uncertainty = U / 2.0, .expanded_uncertainty = U};
}

TEST(EnNumber, SignZeroAndBoundary) {
    // Double arithmetic makes 1.00000000000001 of the first one, which is not above 1 all the same.
    EXPECT_EQ(score(with_k_2(10.05, 0.03), with_k_2(10.0, 0.04)).en, 1.0);
    EXPECT_NEAR(score(with_k_2(9.97, 0.03), with_k_2(10.0, 0.04)).en, -0.599999999999987, 1e-12);
    EXPECT_EQ(score(with_k_2(10.0, 0.03), with_k_2(10.0, 0.04)).en, 0.0);
    EXPECT_NEAR(score(with_k_2(10.01, 0.02), with_k_2(10.0, 0.0)).en, 0.499999999999989, 1e-12);
    EXPECT_NEAR(score(with_k_2(50.0000004, 3e-07), with_k_2(50.0, 4e-07)).en, 0.799999995138023, 1e-12);
}

TEST(EnNumber, ExactlyOneIsNotAboveOne) {
    const std::array<ComparisonScore, 1> points{score(with_k_2(5.0, 3.0), with_k_2(0.0, 4.0))};
    EXPECT_EQ(points[0].en, 1.0);
    EXPECT_EQ(summarise(points).count_above_1, 0U);
}

TEST(Scores, ThatAreALimitButForRoundingAreTheLimit) {
    EXPECT_EQ(score(with_k_2(10.3, 0.2), with_k_2(10.1, 0.0)).en, 1.0);
    EXPECT_EQ(score(with_k_2(10.1, 0.2), with_k_2(10.3, 0.0)).en, -1.0);
    EXPECT_EQ(score(with_k_2(10.3, 0.2), with_k_2(10.1, 0.0)).zeta, 2.0);
    EXPECT_EQ(z_score(10.2, 10.0, 0.1), 2.0);
    EXPECT_EQ(z_score(9.7, 10.0, 0.1), -3.0);
    EXPECT_EQ(z_prime_score(10.5, 10.0, 0.3, 0.4), 1.0);
    EXPECT_EQ(percent_of_allowed(10.3, 10.0, 0.3), 100.0);
    EXPECT_EQ(*worst_plausible_en(with_k_2(10.3, 0.5), with_k_2(10.7, 0.3)), -1.0);
    // What can be seen in the numbers is no rounding.
    EXPECT_GT(score(with_k_2(10.3000000000001, 0.2), with_k_2(10.1, 0.0)).en, 1.0);
    EXPECT_LT(z_score(10.1999999999999, 10.0, 0.1), 2.0);
}

/// Two-digit uncertainties and values of many digits on both sides of 0: a difference of n U is a score of n, whatever
/// binary numbers make of it.
TEST(Scores, SettleOnLimitsOnBothSidesOfZero) {
    for (int i = 1; i < 300; ++i) {
        const double U = std::stod(std::to_string(i) + "e-4");
        const double value = std::stod(std::to_string(71 * i) + ".0301");
        for (const int n : {1, 2, 3}) {
            const double reference = std::stod(std::to_string(71 * i) + "." + std::to_string(10301 + n * i).substr(1));
            EXPECT_EQ(settled_score(reference, value, U), n) << i;
            EXPECT_EQ(settled_score(-reference, -value, U), -n) << i;
        }
    }
}

TEST(Scores, OfValuesWithTooFewDigitsAreNotSettled) {
    // 1e9 and the next doubles: the difference is 2.4e-7, and no rounding of them makes 2.4 a limit.
    const double next = std::nextafter(std::nextafter(1e9, 2e9), 2e9);
    EXPECT_DOUBLE_EQ(z_score(next, 1e9, 1e-7), (next - 1e9) / 1e-7);
    EXPECT_EQ(code_of<InputError>([] { (void)settled_score(1.0, 0.0, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)settled_score(1.0, std::nan(""), 1.0); }), "GC-GUM-0001");
}

TEST(EnNumber, Correlated) {
    // D = 1, U_x = 1, U_X = 0.8.
    for (const auto& [r, en] : {std::pair{0.0, "0.781"}, {0.5, "1.091"}, {0.8, "1.667"}, {-0.5, "0.640"}}) {
        EXPECT_TRUE(prints_as(score(with_k_2(1.0, 1.0), with_k_2(0.0, 0.8), r).en, en)) << "r = " << r;
    }
}

TEST(EnNumber, KeyComparisonWithLaboratoriesInsideTheReferenceValue) {
    const std::array<double, 6> x{12.31, 12.18, 12.42, 12.25, 12.95, 12.05};
    const std::array<double, 6> u{0.10, 0.15, 0.20, 0.12, 0.15, 0.30};
    const auto weighted_mean = [&](std::size_t left_out, double& u_mean) {
        double weights = 0.0;
        double sum = 0.0;
        for (std::size_t i = 0; i < x.size(); ++i) {
            if (i != left_out) {
                weights += 1.0 / (u[i] * u[i]);
                sum += x[i] / (u[i] * u[i]);
            }
        }
        u_mean = 1.0 / std::sqrt(weights);
        return sum / weights;
    };
    const auto en_of = [&](std::size_t i, double y, double u_y, bool inside) {
        // A laboratory inside the weighted mean has cov(x, y) = u²(y), so r = u(y)/u(x).
        return score({x[i], u[i], 2.0 * u[i]}, {y, u_y, 2.0 * u_y}, inside ? u_y / u[i] : 0.0).en;
    };

    double u_y = 0.0;
    double y = weighted_mean(x.size(), u_y);
    EXPECT_TRUE(prints_as(y, "12.37236"));
    EXPECT_TRUE(prints_as(u_y, "0.05828"));
    double chi_square = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        chi_square += std::pow((x[i] - y) / u[i], 2);
    }
    EXPECT_TRUE(prints_as(chi_square, "19.1142"));
    EXPECT_TRUE(prints_as(chi_square_upper_tail(chi_square, 5), "0.00183"));
    const std::array<const char*, 6> all{"-0.384", "-0.696", "0.125", "-0.583", "2.090", "-0.548"};
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_TRUE(prints_as(en_of(i, y, u_y, true), all[i])) << "laboratory " << i + 1;
    }
    EXPECT_TRUE(prints_as(en_of(4, y, u_y, false), "1.795")) << "correlation ignored";

    y = weighted_mean(4, u_y);
    EXPECT_TRUE(prints_as(y, "12.26967"));
    EXPECT_TRUE(prints_as(u_y, "0.06325"));
    const std::array<const char*, 6> consistent{"0.260", "-0.330", "0.396", "-0.096", "2.090", "-0.375"};
    for (std::size_t i = 0; i < x.size(); ++i) {
        EXPECT_TRUE(prints_as(en_of(i, y, u_y, i != 4), consistent[i])) << "laboratory " << i + 1;
    }
}

TEST(EnNumber, MaximumPermissibleErrorIsAHalfWidthNotAStandardUncertainty) {
    // D = 18, U_X = 5, MPE = 10 as the only term of the other side: taken as u it hides the failure.
    const ComparisonScore as_u = score({18.0, 10.0, 20.0}, {0.0, 2.5, 5.0});
    EXPECT_TRUE(prints_as(as_u.en, "0.873"));
    EXPECT_TRUE(prints_as(as_u.U_difference, "20.62"));
    const double u = u_from_half_width(10.0);
    EXPECT_TRUE(prints_as(2.0 * u, "11.55"));
    const ComparisonScore as_half_width = score({18.0, u, 2.0 * u}, {0.0, 2.5, 5.0});
    EXPECT_TRUE(prints_as(as_half_width.en, "1.430"));
    EXPECT_TRUE(prints_as(as_half_width.U_difference, "12.58"));
}

TEST(Scores, ZetaIsTwiceEnExactlyWhenBothSidesHaveK2) {
    for (int i = 1; i <= 100; ++i) {
        const double r = i % 3 == 0 ? 0.0 : (i % 7) / 7.0;
        const ComparisonScore point = score(with_k_2(1.0 + 0.013 * i, 0.0031 * i), with_k_2(1.0, 0.27 / i), r);
        EXPECT_EQ(point.zeta, 2.0 * point.en) << i;
    }
}

TEST(Scores, NothingCancelsNearFullCorrelation) {
    // √(2 (1 - r)) u with r = 1 - 2^-40; the textbook form of the sum would leave four digits.
    const double r = 1.0 - std::ldexp(1.0, -40);
    EXPECT_TRUE(agrees(uncertainty_of_difference(0.1, 0.1, r), 0.1 * std::sqrt(2.0 * std::ldexp(1.0, -40)), 1e-14));
    EXPECT_EQ(uncertainty_of_difference(0.1, 0.1, 1.0), 0.0);
    EXPECT_DOUBLE_EQ(uncertainty_of_difference(0.3, 0.1, 1.0), 0.2);
    EXPECT_DOUBLE_EQ(uncertainty_of_difference(0.3, 0.1, -1.0), 0.4);
}

TEST(Scores, RefuseWhatGivesNoScore) {
    const ComparedValue good = with_k_2(1.0, 0.1);
    const auto against_good = [&](ComparedValue value, double r = 0.0) {
        return [value, r, good] { (void)score(value, good, r); };
    };
    EXPECT_EQ(code_of<InputError>(against_good({1.0, -0.1, 0.2})), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>(against_good({1.0, 0.1, -0.2})), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>(against_good({std::nan(""), 0.1, 0.2})), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>(against_good({1.0, k_infinity, 0.2})), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>(against_good({1.0, 0.1, std::nan("")})), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>(against_good(good, 1.01)), "GC-GUM-0030");
    EXPECT_EQ(code_of<InputError>(against_good(good, std::nan(""))), "GC-GUM-0030");
    EXPECT_EQ(code_of<InputError>(against_good(good, 1.0)), "GC-GUM-0031");
    try {
        (void)score(good, good, 1.0);
    } catch (const InputError& refused) {  // both state an uncertainty: the correlation is what must change
        EXPECT_EQ(refused.diagnostics().front().action.find("State a smaller correlation"), 0U);
    }
    EXPECT_EQ(message_of<InputError>([] {
                  (void)score({1.0, 0.0, 0.0}, {1.5, 0.0, 0.0});
              }),
              "u of the difference — 0 from laboratory 0 and reference 0 with correlation 0 — "
              "a score divides by it, so it must be greater than 0 — State the uncertainty of at least one side.");
}

TEST(WorstPlausibleEn, AllOfTheSmallerUncertaintyIsCommon) {
    // D = 1, U_x = 1, U_X = 0.8: r = 0.8 is both the worst of the examples above and the plausible limit.
    const ComparedValue laboratory = with_k_2(1.0, 1.0);
    const ComparedValue reference = with_k_2(0.0, 0.8);
    EXPECT_TRUE(prints_as(*worst_plausible_en(laboratory, reference), "1.667"));
    EXPECT_DOUBLE_EQ(*worst_plausible_en(laboratory, reference), score(laboratory, reference, 0.8).en);
    EXPECT_DOUBLE_EQ(*worst_plausible_en(reference, laboratory), -score(laboratory, reference, 0.8).en);
}

TEST(WorstPlausibleEn, HasNoBoundForEqualUncertainties) {
    EXPECT_FALSE(worst_plausible_en(with_k_2(1.0, 0.5), with_k_2(0.0, 0.5)));
    EXPECT_EQ(*worst_plausible_en(with_k_2(1.0, 0.5), with_k_2(0.0, 0.0)), 2.0);  // nothing can be common
    EXPECT_EQ(code_of<InputError>([] { (void)worst_plausible_en({1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}); }), "GC-GUM-0031");
}

/// ISO 13528:2022, E.4, tables E.6 and E.7: mercury in feed.
struct PublishedScores {
    const char* laboratory;
    double x, U, k;
    const char *percent, *allowed, *z, *z_prime, *zeta, *en;
};
constexpr std::array<PublishedScores, 11> k_mercury{
    {{"L04", 0.013, 0.003, 2, "-70.5", "-156.6", "-4.70", "-3.99", "-7.10", "-3.55"},
     {"L23", 0.0135, 0.00108, 1.732, "-69.3", "-154.0", "-4.62", "-3.93", "-7.35", "-3.69"},
     {"L15", 0.014, 0.0005, 2, "-68.2", "-151.5", "-4.55", "-3.86", "-7.30", "-3.65"},
     {"L09", 0.017, 0.008, 2, "-61.4", "-136.4", "-4.09", "-3.47", "-4.71", "-2.36"},
     {"L12", 0.0239, 0.0036, 2, "-45.7", "-101.5", "-3.05", "-2.59", "-4.49", "-2.24"},
     {"L29", 0.039, 0.007, 2, "-11.4", "-25.3", "-0.76", "-0.64", "-0.93", "-0.46"},
     {"L21", 0.04, 0.03, 2, "-9.1", "-20.2", "-0.61", "-0.51", "-0.26", "-0.13"},
     {"L16", 0.0424, 0.008, 2, "-3.6", "-8.1", "-0.24", "-0.21", "-0.28", "-0.14"},
     {"L10", 0.045, 0.007, 2, "2.3", "5.1", "0.15", "0.13", "0.19", "0.09"},
     {"L18", 0.046, 0.007, 2, "4.5", "10.1", "0.30", "0.26", "0.37", "0.19"},
     {"L01", 0.053, 0.007, 2, "20.5", "45.5", "1.36", "1.16", "1.67", "0.83"}}};

TEST(Scores, OfMercuryInFeed) {
    const ComparedValue assigned{.value = 0.044, .standard_uncertainty = 0.0041, .expanded_uncertainty = 0.0082};
    for (const PublishedScores& of : k_mercury) {
        const ComparedValue laboratory{
            .value = of.x, .standard_uncertainty = of.U / of.k, .expanded_uncertainty = of.U};
        const ComparisonScore scores = score(laboratory, assigned);
        EXPECT_TRUE(prints_as(*percent_difference(of.x, assigned.value), of.percent)) << of.laboratory;
        EXPECT_TRUE(prints_as(percent_of_allowed(of.x, assigned.value, 0.0198), of.allowed)) << of.laboratory;
        EXPECT_TRUE(prints_as(z_score(of.x, assigned.value, 0.0066), of.z)) << of.laboratory;
        EXPECT_TRUE(prints_as(z_prime_score(of.x, assigned.value, 0.0066, 0.0041), of.z_prime)) << of.laboratory;
        EXPECT_TRUE(prints_as(scores.zeta, of.zeta)) << of.laboratory;
        EXPECT_TRUE(prints_as(scores.en, of.en)) << of.laboratory;
        const bool far_off = of.x < 0.03;
        EXPECT_EQ(signal_of_en(scores.en), far_off ? Signal::action : Signal::none) << of.laboratory;
        EXPECT_EQ(signal_of_z(z_score(of.x, assigned.value, 0.0066)), far_off ? Signal::action : Signal::none);
    }
}

TEST(Scores, PercentKeepsTheSignOfTheDifference) {
    EXPECT_DOUBLE_EQ(*percent_difference(-9.0, -10.0), 10.0);
    EXPECT_FALSE(percent_difference(1.0, 0.0));
}

TEST(Scores, ZPrimeAtTheLimitOfTheCriterion) {
    // u(X) = 0.3 sigma_pt: z' = 0.958 z.
    EXPECT_TRUE(prints_as(z_prime_score(1.0, 0.0, 1.0, 0.3) / z_score(1.0, 0.0, 1.0), "0.958"));
}

TEST(Signals, BeginAtTheirLimits) {
    EXPECT_EQ(signal_of_z(1.999), Signal::none);
    EXPECT_EQ(signal_of_z(-2.0), Signal::none);  // ISO 13528: up to 2.0 acceptable, from 3.0 on action
    EXPECT_EQ(signal_of_z(2.001), Signal::warning);
    EXPECT_EQ(signal_of_z(2.999), Signal::warning);
    EXPECT_EQ(signal_of_z(-3.0), Signal::action);
    EXPECT_EQ(signal_of_en(-1.0), Signal::none);
    EXPECT_EQ(signal_of_en(1.0000001), Signal::action);
    EXPECT_EQ(signal_of_z(3.0), Signal::action);
    EXPECT_EQ(code_of<InputError>([] { (void)signal_of_z(std::nan("")); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([] { (void)signal_of_en(std::nan("")); }), "GC-GUM-0001");
}

TEST(Scores, RefuseWhatDividesByNothing) {
    EXPECT_EQ(code_of<InputError>([] { (void)z_score(1.0, 0.0, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)z_prime_score(1.0, 0.0, 1.0, -0.1); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)percent_of_allowed(1.0, 0.0, 0.0); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)percent_difference(std::nan(""), 1.0); }), "GC-GUM-0001");
}

TEST(Summary, CompanionNumbers) {
    std::vector<ComparisonScore> points;
    for (const double difference : {0.3, -0.4, 1.2, -2.0}) {
        points.push_back(score(with_k_2(difference, 1.0), with_k_2(0.0, 0.0)));
    }
    const ComparisonSummary summary = summarise(points);
    EXPECT_EQ(summary.points, 4U);
    EXPECT_EQ(summary.count_above_1, 2U);
    EXPECT_DOUBLE_EQ(summary.mean_absolute_en, (0.3 + 0.4 + 1.2 + 2.0) / 4.0);
    EXPECT_DOUBLE_EQ(summary.largest_absolute_en, 2.0);
    EXPECT_DOUBLE_EQ(summary.rms_en, std::sqrt((0.09 + 0.16 + 1.44 + 4.0) / 4.0));
    EXPECT_DOUBLE_EQ(summary.sum_of_squared_zeta, 4.0 * (0.09 + 0.16 + 1.44 + 4.0));
    EXPECT_TRUE(agrees(summary.p_high, chi_square_upper_tail(22.76, 4), 1e-13));
    EXPECT_NEAR(summary.p_low + summary.p_high, 1.0, 1e-15);
}

std::vector<ComparisonScore> points_of_equal_en(int m, double en) {
    return std::vector<ComparisonScore>(static_cast<std::size_t>(m), score(with_k_2(en, 1.0), with_k_2(0.0, 0.0)));
}

TEST(Summary, SmallScoresSayThatUncertaintiesAreTooLarge) {
    // 10 points with rms E_n 0.15 have p_low 1.1e-4, 20 points 4e-8.
    EXPECT_TRUE(prints_as(summarise(points_of_equal_en(10, 0.15)).p_low, "1.1e-4"));
    EXPECT_TRUE(prints_as(summarise(points_of_equal_en(20, 0.15)).p_low, "4e-8"));
}

TEST(Summary, BandOfRmsEn) {
    // 95 % band of rms E_n of m independent points: its ends, half a unit to either side, enclose the 2.5 % tails.
    // The lower end for m = 10 is 0.28491; tables that round it twice print 0.29.
    struct Row {
        int m;
        double low, high;
    };
    for (const Row row : {Row{5, 0.20, 0.80}, {10, 0.28, 0.72}, {20, 0.35, 0.65}, {30, 0.37, 0.63}, {50, 0.40, 0.60}}) {
        EXPECT_LE(summarise(points_of_equal_en(row.m, row.low - 0.005)).p_low, 0.025) << row.m;
        EXPECT_GE(summarise(points_of_equal_en(row.m, row.low + 0.005)).p_low, 0.025) << row.m;
        EXPECT_GE(summarise(points_of_equal_en(row.m, row.high - 0.005)).p_high, 0.025) << row.m;
        EXPECT_LE(summarise(points_of_equal_en(row.m, row.high + 0.005)).p_high, 0.025) << row.m;
    }
}

TEST(Summary, RefusesNoPoints) {
    EXPECT_EQ(code_of<InputError>([] { (void)summarise({}); }), "GC-GUM-0032");
    ComparisonScore broken;
    broken.en = std::nan("");
    EXPECT_EQ(code_of<InputError>([&] { (void)summarise(std::vector{broken}); }), "GC-GUM-0001");
}

TEST(EnUncertainty, BringsCoverageFactorsToOne) {
    constexpr double infinite = std::numeric_limits<double>::infinity();
    for (const double k : {1.0, 3.0, 200.0}) {
        const EnUncertainty taken = en_uncertainty(0.1, 0.1 * k, k, infinite, 0.9545);
        EXPECT_TRUE(taken.converted);
        EXPECT_NEAR(taken.U, 0.2, 1e-5);
        EXPECT_NEAR(taken.k, 2.0, 1e-4);
    }
    for (const double k : {1.96, 2.0, 2.04}) {
        const EnUncertainty as_stated = en_uncertainty(0.1, 0.1 * k, k, infinite, 0.9545);
        EXPECT_FALSE(as_stated.converted);
        EXPECT_EQ(as_stated.U, 0.1 * k);
    }
    EXPECT_FALSE(en_uncertainty(0.1, 0.2, 2.0, infinite, 0.95).converted);
    EXPECT_FALSE(en_uncertainty(0.1, 0.287, 2.87, 4.0, 0.9545).converted);  // t for 4 degrees of freedom
    EXPECT_NEAR(en_uncertainty(0.1, 0.2, 2.0, 4.0, 0.9545).U, 0.2869, 1e-4);
}

TEST(EnUncertainty, IsForAbout95Percent) {
    EXPECT_EQ(en_coverage_probability(0.95), 0.95);
    EXPECT_EQ(en_coverage_probability(0.9545), 0.9545);
    EXPECT_EQ(en_coverage_probability(0.5), 0.9545);
    EXPECT_EQ(en_coverage_probability(0.99), 0.9545);
    EXPECT_EQ(code_of<InputError>([] { (void)en_coverage_probability(1.0); }), "GC-GUM-0004");
}

// What both sides share counts with one factor: U = 4.5 u against U = 2 u with r = 0.99 gave U_D = 18 u_D.
TEST(Scores, AFactorOfTheDifferenceLiesBetweenThoseOfBothSides) {
    for (const double r : {-0.9, -0.3, 0.3, 0.9, 0.99}) {
        for (const double k : {2.0, 2.02, 2.3, 4.5, 14.0}) {
            for (const double u : {0.05, 0.1, 0.2}) {
                const ComparedValue one{1.0, u, k * u};
                const ComparedValue other{1.1, 0.1, 0.2};
                const ComparisonScore found = score(one, other, r);
                EXPECT_GE(found.U_difference / found.u_difference, 2.0 * (1.0 - 0.03));
                EXPECT_LE(found.U_difference / found.u_difference, k * (1.0 + 0.03) + (k < 2.05 ? 0.3 : 0.0));
                EXPECT_NEAR(found.U_difference, score(other, one, r).U_difference, 1e-13);
                EXPECT_NEAR(score(one, other, 0.0).U_difference, std::hypot(k * u, 0.2), 1e-15);
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
