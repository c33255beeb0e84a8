// Analyses of variance against certified and printed tables.
#include "gum/analysis_of_variance.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/reference_case.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using gumcert::test::expected_number;
using gumcert::test::reference_case;
using nlohmann::json;
using test::agrees;
using test::code_of;
using test::message_of;
using test::prints_as;

using Groups = std::vector<std::vector<double>>;

/// Correct digits, not more than the 15 that are certified.
double correct_digits(double value, double certified) {
    const double error = std::abs(value - certified) / std::abs(certified);
    return error == 0.0 ? 15.0 : std::min(15.0, -std::log10(error));
}

/// Fewest correct digits of what a NIST StRD file certifies.
double certified_digits(const OneWayAnalysis& analysis, const json& expected) {
    double least = 15.0;
    for (const json& one : expected) {
        const std::string kind = one["kind"];
        const bool between = one["quantity"] == "between";
        const VarianceLine& line = between ? analysis.between : analysis.within;
        const double value = expected_number(one);
        if (kind == "sum_of_squares") {
            least = std::min(least, correct_digits(line.sum_of_squares, value));
        } else if (kind == "mean_square") {
            least = std::min(least, correct_digits(line.mean_square, value));
        } else if (kind == "F") {
            least = std::min(least, correct_digits(analysis.ratio.f, value));
        } else if (kind == "r_squared") {
            least = std::min(least, correct_digits(analysis.r_squared, value));
        } else if (kind == "residual_std") {
            least = std::min(least, correct_digits(analysis.within_standard_deviation, value));
        } else if (kind == "dof") {
            EXPECT_EQ(one["quantity"] == "dof_between" ? analysis.between.degrees_of_freedom
                                                       : analysis.within.degrees_of_freedom,
                      value);
        } else {
            ADD_FAILURE() << "not looked at: " << kind;
        }
    }
    return least;
}

TEST(AnalysisOfVariance, CertifiedSets) {
    // What is left is the rounding of the decimals to double: SmLs04 has 7 digits in common, as doubles about 9 are
    // left.
    const std::vector<std::pair<std::string, double>> sets{
        {"strd-anova-sirstv", 12.5}, {"strd-anova-smls01", 14.0}, {"strd-anova-smls04", 9.0}};
    for (const auto& [id, digits] : sets) {
        const json set = reference_case(id);
        const auto groups = set["data"]["groups"].get<Groups>();
        const OneWayAnalysis analysis = one_way_analysis(groups);
        const double found = certified_digits(analysis, set["expected"]);
        RecordProperty(id, std::to_string(found));
        EXPECT_GE(found, digits) << id;
    }
}

/// Nine groups in the manner of the SmLs sets of NIST StRD: tenths about a common value.
Groups simon_lesage(double common, int pairs) {
    Groups groups;
    for (const int tenths : {4, 3, 5, 2, 4, 3, 5, 2, 4}) {
        std::vector<double> group{common + tenths / 10.0};
        for (int k = 0; k < pairs; ++k) {
            group.push_back(common + (tenths - 1) / 10.0);
            group.push_back(common + (tenths + 1) / 10.0);
        }
        groups.push_back(group);
    }
    return groups;
}

// Thirteen digits in common (as SmLs07 to 09): what is left of the observations as doubles is analysed without loss.
TEST(AnalysisOfVariance, ManyCommonDigits) {
    for (const double common : {1e6, 1e12}) {
        const Groups groups = simon_lesage(common, 10);
        Groups less = groups;
        for (std::vector<double>& group : less) {
            for (double& value : group) {
                value -= common;  // exact: both are multiples of the spacing at the common value
            }
        }
        const OneWayAnalysis with = one_way_analysis(groups);
        const OneWayAnalysis without = one_way_analysis(less);
        EXPECT_TRUE(agrees(with.between.sum_of_squares, without.between.sum_of_squares, 1e-14));
        EXPECT_TRUE(agrees(with.within.sum_of_squares, without.within.sum_of_squares, 1e-14));
        EXPECT_TRUE(agrees(with.ratio.f, without.ratio.f, 1e-14));
    }
}

TEST(AnalysisOfVariance, FourGroupsOfTen) {
    const json set = reference_case("anova-ncsli-4x10");
    const OneWayAnalysis analysis = one_way_analysis(set["data"]["groups"].get<Groups>(), 0.05);
    // The source had more digits of the observations than it prints: F and its p-value differ in their last digit.
    EXPECT_NEAR(analysis.ratio.f, 0.0850416, 1e-7);
    EXPECT_NEAR(analysis.ratio.p_value, 0.96777478, 1e-7);
    EXPECT_TRUE(prints_as(analysis.ratio.critical_value, "2.866266"));
    EXPECT_TRUE(prints_as(analysis.standard_deviation_of_group_means, "57.6E-6"));
    EXPECT_TRUE(prints_as(analysis.within_standard_deviation, "624.4E-6"));
    EXPECT_TRUE(prints_as(analysis.groups[0].mean, "1.000100682"));
    EXPECT_TRUE(prints_as(analysis.groups[0].standard_deviation, "0.000646229"));
    EXPECT_TRUE(prints_as(analysis.groups[3].mean, "1.000091265"));
    EXPECT_TRUE(prints_as(analysis.groups[3].standard_deviation, "0.000719539"));
    EXPECT_FALSE(analysis.ratio.significant);
    EXPECT_TRUE(analysis.between_variance_clipped);
    EXPECT_EQ(analysis.between_standard_deviation, 0.0);
}

// JCGM 100:2008, H.5, table H.9: ten days of five observations of a Zener voltage standard.
TEST(AnalysisOfVariance, ZenerOfTheGum) {
    const json set = reference_case("gum-h5-anova");
    std::vector<ObservationGroup> days;
    for (std::size_t j = 0; j < 10; ++j) {
        days.push_back({.observations = 5,
                        .mean = set["data"]["group_means_V"][j].get<double>(),
                        .standard_deviation = 1e-6 * set["data"]["group_std_uV"][j].get<double>()});
    }
    const OneWayAnalysis analysis = one_way_analysis(days, 0.05);
    EXPECT_TRUE(prints_as(analysis.mean, "10.000097"));
    EXPECT_EQ(analysis.mean, analysis.mean_of_group_means);
    EXPECT_TRUE(prints_as(analysis.standard_deviation_of_group_means, "57e-6"));
    EXPECT_TRUE(prints_as(analysis.within_standard_deviation, "85e-6"));
    EXPECT_TRUE(prints_as(analysis.between_estimate, "128e-6"));
    EXPECT_EQ(analysis.between.degrees_of_freedom, 9.0);
    EXPECT_EQ(analysis.within.degrees_of_freedom, 40.0);
    // Printed 2.25 from deviations that the GUM rounded on the way; from the figures of the table it is 2.26.
    EXPECT_NEAR(analysis.ratio.f, 2.25, 0.015);
    EXPECT_TRUE(agrees(analysis.ratio.f, 2.26151926999457, 1e-9));
    EXPECT_TRUE(prints_as(analysis.ratio.critical_value, "2.12"));
    EXPECT_TRUE(prints_as(f_critical_value(0.975, 9, 40), "2.45"));
    EXPECT_TRUE(prints_as(analysis.u_with_between_effect, "18e-6"));
    EXPECT_TRUE(prints_as(analysis.between_standard_deviation, "43e-6"));
    EXPECT_TRUE(agrees(analysis.between_standard_deviation, 42.6386105677164e-6, 1e-9));
    EXPECT_TRUE(agrees(analysis.between_estimate, 127.656004777397e-6, 1e-9));
    EXPECT_TRUE(prints_as(analysis.u_without_between_effect, "13e-6"));
    EXPECT_EQ(analysis.u_with_between_effect_degrees_of_freedom, 9.0);
    EXPECT_EQ(analysis.u_without_between_effect_degrees_of_freedom, 49.0);
    EXPECT_TRUE(analysis.ratio.significant);
    EXPECT_FALSE(one_way_analysis(days, 0.025).ratio.significant);
}

TEST(AnalysisOfVariance, TenGroupsOfFive) {
    const json set = reference_case("gum5-ex12-anova");
    const OneWayAnalysis analysis = one_way_analysis(set["data"]["groups"].get<Groups>());
    EXPECT_TRUE(prints_as(analysis.between.sum_of_squares, "2.92e-6"));
    EXPECT_TRUE(prints_as(analysis.within.sum_of_squares, "1.96e-5"));
    EXPECT_TRUE(prints_as(analysis.between.mean_square, "3.25e-7"));
    EXPECT_TRUE(prints_as(analysis.within.mean_square, "4.90e-7"));
    EXPECT_TRUE(agrees(analysis.ratio.f, 0.662447832157195, 1e-10));
    EXPECT_TRUE(agrees(analysis.mean, 0.42514392, 1e-14));
    EXPECT_TRUE(agrees(analysis.ratio.p_value, 0.73713000748117, 1e-9));
    EXPECT_TRUE(agrees(analysis.u_without_between_effect, 9.59140807691759e-05, 1e-10));
    EXPECT_EQ(analysis.between_standard_deviation, 0.0);
    EXPECT_TRUE(analysis.between_variance_clipped);
}

// Glantz: three groups of different size, from their means and standard deviations.
TEST(AnalysisOfVariance, FromPrintedSummaries) {
    const std::vector<ObservationGroup> groups{{16, 9.2, 2.9}, {22, 10.7, 2.8}, {18, 13.5, 4.7}};
    const OneWayAnalysis analysis = one_way_analysis(groups);
    // The source rounds on the way: its own figures agree with each other to about 1 %.
    EXPECT_NEAR(analysis.between.sum_of_squares, 164.7, 0.1);
    EXPECT_NEAR(analysis.between.mean_square, 82.3, 0.1);
    EXPECT_NEAR(analysis.within.mean_square, 12.5, 0.12);
    EXPECT_NEAR(analysis.ratio.f, 6.612, 0.1);
    EXPECT_TRUE(prints_as(analysis.ratio.p_value, "0.003"));
    EXPECT_TRUE(agrees(analysis.ratio.f, 6.54920844553454, 1e-12));
    EXPECT_TRUE(agrees(analysis.within.sum_of_squares, 666.32, 1e-12));
    EXPECT_FALSE(analysis.balanced);
    EXPECT_EQ(analysis.groups[1].observations, 22U);
    EXPECT_EQ(analysis.groups[2].standard_deviation, 4.7);
}

// The two ways in give the same analysis, and sums of squares add up.
TEST(AnalysisOfVariance, ObservationsAndSummariesAgree) {
    const Groups groups{{5.1, 4.9, 5.6}, {6.0, 6.3}, {4.4, 4.8, 4.6, 5.0}, {5.5}};
    const OneWayAnalysis from_observations = one_way_analysis(groups);
    const OneWayAnalysis from_summaries = one_way_analysis(from_observations.groups);
    EXPECT_TRUE(agrees(from_summaries.ratio.f, from_observations.ratio.f, 1e-12));
    EXPECT_TRUE(agrees(from_summaries.between_standard_deviation, from_observations.between_standard_deviation, 1e-12));
    EXPECT_TRUE(agrees(from_summaries.u_without_between_effect, from_observations.u_without_between_effect, 1e-12));
    double sum = 0.0;
    double squares = 0.0;
    for (const std::vector<double>& group : groups) {
        for (const double value : group) {
            sum += value;
            squares += value * value;
        }
    }
    EXPECT_TRUE(agrees(from_observations.total.sum_of_squares, squares - sum * sum / 10.0, 1e-11));
    EXPECT_TRUE(agrees(from_observations.mean, sum / 10.0, 1e-14));
    EXPECT_EQ(from_observations.total.degrees_of_freedom, 9.0);
    EXPECT_EQ(from_observations.groups[3].standard_deviation, 0.0);
    // n₀ = (N − Σ n²/N)/(J − 1) = (10 − 30/10)/3.
    EXPECT_TRUE(agrees(std::pow(from_observations.between_standard_deviation, 2),
                       (from_observations.between.mean_square - from_observations.within.mean_square) / (7.0 / 3.0),
                       1e-12));
}

TEST(AnalysisOfVariance, NestedDesign) {
    // Two groups of two subgroups of two readings: means 2, 4 | 7, 9; all by hand.
    const std::vector<Groups> readings{{{1, 3}, {3, 5}}, {{6, 8}, {8, 10}}};
    const NestedAnalysis analysis = nested_analysis(readings);
    EXPECT_EQ(analysis.mean, 5.5);
    EXPECT_DOUBLE_EQ(analysis.between_groups.sum_of_squares, 50.0);
    EXPECT_EQ(analysis.between_groups.degrees_of_freedom, 1.0);
    EXPECT_DOUBLE_EQ(analysis.between_subgroups.sum_of_squares, 8.0);
    EXPECT_EQ(analysis.between_subgroups.degrees_of_freedom, 2.0);
    EXPECT_DOUBLE_EQ(analysis.within_subgroups.sum_of_squares, 8.0);
    EXPECT_EQ(analysis.within_subgroups.degrees_of_freedom, 4.0);
    EXPECT_DOUBLE_EQ(analysis.group_ratio.f, 12.5);
    EXPECT_DOUBLE_EQ(analysis.subgroup_ratio.f, 2.0);
    EXPECT_DOUBLE_EQ(analysis.within_standard_deviation, std::sqrt(2.0));
    EXPECT_DOUBLE_EQ(analysis.between_subgroup_standard_deviation, 1.0);
    EXPECT_DOUBLE_EQ(analysis.between_group_standard_deviation, std::sqrt(11.5));
    EXPECT_DOUBLE_EQ(analysis.u_of_mean, 2.5);
    // Without readings' part it is the one-way analysis of the subgroup means.
    const OneWayAnalysis means = one_way_analysis(Groups{{2, 4}, {7, 9}});
    EXPECT_DOUBLE_EQ(means.ratio.f, analysis.group_ratio.f);
    EXPECT_DOUBLE_EQ(means.u_with_between_effect, analysis.u_of_mean);
    const NestedAnalysis flat = nested_analysis(std::vector<Groups>{{{1, 3}, {3, 1}}, {{1, 3}, {1, 3}}});
    EXPECT_TRUE(flat.between_subgroup_variance_clipped);
    EXPECT_EQ(flat.between_subgroup_standard_deviation, 0.0);
    EXPECT_EQ(flat.group_ratio.f, 0.0);
}

TEST(AnalysisOfVariance, SnedecorsF) {
    // F with 1 and ν degrees of freedom is t²: t_0.975(10) = 2.228.
    EXPECT_TRUE(prints_as(std::sqrt(f_critical_value(0.95, 1, 10)), "2.228"));
    EXPECT_TRUE(agrees(f_upper_tail(f_critical_value(0.99, 3, 7), 3, 7), 0.01, 1e-11));
    // With 2 and 2: P(F ≥ f) = 1/(1 + f).
    EXPECT_TRUE(agrees(f_upper_tail(1e12, 2, 2), 1e-12, 1e-11));
    EXPECT_EQ(f_upper_tail(0.0, 3, 4), 1.0);
    EXPECT_EQ(f_upper_tail(std::numeric_limits<double>::infinity(), 3, 4), 0.0);
    // A known variance: chi-square over its degrees of freedom, towards which many degrees lead.
    constexpr double k_known = std::numeric_limits<double>::infinity();
    EXPECT_EQ(f_upper_tail(2.5, 4, k_known), chi_square_upper_tail(10.0, 4));
    EXPECT_TRUE(agrees(f_upper_tail(2.5, 4, 1e9), f_upper_tail(2.5, 4, k_known), 1e-7));
    EXPECT_EQ(f_upper_tail(k_known, 4, k_known), 0.0);
    EXPECT_EQ(code_of<InputError>([] { (void)f_upper_tail(-1.0, 3, k_known); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)f_upper_tail(-1.0, 3, 4); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)f_upper_tail(1.0, 0, 4); }), "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([] { (void)f_critical_value(1.0, 3, 4); }), "GC-GUM-0004");
    EXPECT_EQ(code_of<InputError>([] { (void)f_critical_value(0.95, 3, std::nan("")); }), "GC-GUM-0001");
}

TEST(AnalysisOfVariance, GroupsThatDoNotVaryWithin) {
    const OneWayAnalysis analysis = one_way_analysis(Groups{{1, 1}, {2, 2}});
    EXPECT_EQ(analysis.ratio.f, std::numeric_limits<double>::infinity());
    EXPECT_EQ(analysis.ratio.p_value, 0.0);
    EXPECT_TRUE(analysis.ratio.significant);
    EXPECT_EQ(analysis.r_squared, 1.0);
}

TEST(AnalysisOfVariance, RefusesBadInput) {
    const auto code = [](const Groups& groups) { return code_of<InputError>([&] { (void)one_way_analysis(groups); }); };
    EXPECT_EQ(code({{1, 2, 3}}), "GC-GUM-0070");
    EXPECT_EQ(code({}), "GC-GUM-0070");
    EXPECT_EQ(code({{1, 2, 3}, {}}), "GC-GUM-0071");
    EXPECT_EQ(code({{1}, {2}, {3}}), "GC-GUM-0072");
    EXPECT_EQ(message_of<InputError>([] {
                  (void)one_way_analysis(Groups{{1, 2}, {3, std::nan("")}});
              }),
              "group 2, observation 2 — NaN — must be a finite number — Correct the value.");
    EXPECT_EQ(code_of<InputError>([] { (void)one_way_analysis(Groups{{1, 2}, {3, 4}}, 1.0); }), "GC-GUM-0004");
    EXPECT_EQ(code_of<NoResultError>([] { (void)one_way_analysis(Groups{{2, 2}, {2, 2}}); }), "GC-GUM-0073");
    EXPECT_EQ(code_of<NoResultError>([] { (void)one_way_analysis(Groups{{1e308, 2}, {-1e308, 2}}); }), "GC-GUM-0073");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)one_way_analysis(std::vector<ObservationGroup>{{3, 1.0, 0.1}, {3, 2.0, -0.1}});
              }),
              "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)one_way_analysis(std::vector<ObservationGroup>{{3, 1.0, 0.1}, {0, 2.0, 0.1}});
              }),
              "GC-GUM-0071");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)nested_analysis(std::vector<Groups>{{{1, 2}, {3}}, {{1, 2}, {3, 4}}});
              }),
              "GC-GUM-0074");
    EXPECT_EQ(code_of<InputError>([] { (void)nested_analysis({}); }), "GC-GUM-0074");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)nested_analysis(std::vector<Groups>{{{1}, {3}}, {{1}, {4}}});
              }),
              "GC-GUM-0074");
}

TEST(AnalysisOfVariance, NestedDesignsThatCannotBeAnalysed) {
    const auto message = [](const std::vector<Groups>& readings) {
        return message_of<InputError>([&] { (void)nested_analysis(readings); });
    };
    const std::string rule =
        " — needs at least 2 groups of at least 2 subgroups of at least 2 readings, the same number in each — Complete "
        "the design, or take the means of subgroups and analyse these one-way.";
    EXPECT_EQ(message({{{1, 2}, {3, 4}}}), "nested analysis of variance — 1 group of 2 subgroups of 2 readings" + rule);
    EXPECT_EQ(message({{{1, 2}}, {{3, 4}}}),
              "nested analysis of variance — 2 groups of 1 subgroups of 2 readings" + rule);
    EXPECT_EQ(message({{{1, 2}, {3, 4}}, {{1, 2}, {3, 4}, {5, 6}}}),
              "nested analysis of variance — groups or subgroups of different sizes" + rule);
    EXPECT_EQ(message({{{1, 2}, {3, 4}}, {{1, 2}, {3, 4, 5}}}),
              "nested analysis of variance — groups or subgroups of different sizes" + rule);
    EXPECT_EQ(message({{}, {}}), "nested analysis of variance — 2 groups of 0 subgroups of 0 readings" + rule);
    for (const double one : {2.0, 0.0}) {
        const Groups alike{{one, one}, {one, one}};
        EXPECT_EQ(code_of<NoResultError>([&] {
                      (void)nested_analysis(std::vector<Groups>{alike, alike});
                  }),
                  "GC-GUM-0073");
    }
    const Groups huge{{1e308, -1e308}, {1e308, -1e308}};
    EXPECT_EQ(code_of<NoResultError>([&] { (void)nested_analysis(std::vector<Groups>{huge, huge}); }), "GC-GUM-0073");
}

// F(2, ν): P(F > f) = (1 + 2 f/ν)^(−ν/2), so that the critical value is ν/2 (α^(−2/ν) − 1), which 1e-16 and a tenth of a
// degree of freedom bring to 10^318.
TEST(AnalysisOfVariance, CriticalValuesOfFewDegreesOfFreedom) {
    EXPECT_TRUE(agrees(f_critical_value(0.75, 2, 0.5), 0.25 * (256.0 - 1.0), 1e-10));
    const std::string message = message_of<NoResultError>([] { (void)f_critical_value(1.0 - 0x1p-53, 2, 0.09); });
    EXPECT_EQ(
        message,
        "critical value of F — no finite value for probability 0.9999999999999999, 2 and 0.09 degrees of freedom — a "
        "test needs a finite critical value — Choose a probability that is farther from 1.");
}

}  // namespace
}  // namespace gumcert::gum
