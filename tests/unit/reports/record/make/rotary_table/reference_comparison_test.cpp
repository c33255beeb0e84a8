#include "reports/record/make/rotary_table/reference_comparison.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/rotary_table/reference_budget.h"
#include "tests/support/campaign.h"

namespace gumcert::reports {
namespace {

using jobs::RotaryTableJob;
using jobs::test::Files;
using jobs::test::read;
using jobs::test::refusals;
using jobs::test::replace;
using testing::HasSubstr;
using testing::Not;

constexpr double k_um = 1e-6;
const double k_factor = gum::coverage_factor(0.9545, INFINITY);  // 2.0000024

// u of the indicator, with a maximum permissible error alone: 0.4 µm.
const std::string k_indicator =
    R"({"contact_point_mm": [100, 4, 0], "resolution_um": 0, "mpe_um": 0.692820323027551, "repeatability_um": 0})";

/// The small campaign with one reading a point, each 0 µm.
/// \param points  "x,0" …
Files campaign(const std::vector<std::string>& points, const std::string& keys = "") {
    Files files = jobs::test::small_campaign();
    files["dial_indicator.json"] = k_indicator;
    files["dial_indicator.csv"] = "direction,angle_deg,run,reading_um\n";
    for (const std::string& point : points) {
        files["dial_indicator.csv"] += point + ",1,0\n";
    }
    if (!keys.empty()) {
        replace(files["job.json"], "\"description\"", keys + ", \"description\"");
    }
    return files;
}

const std::vector<std::string> k_three_of_x{"x,0", "x,45", "x,90"};

/// A displacement with D = 0.5 µm, 0.2 µm, -0.1 µm of x at the first three angles, 0.3 µm and -0.2 µm of y at the first
/// two, each with u = 0.3 µm and independent of all others.
gum::QuantityUncertainty displacement(double u = 0.3) {
    gum::QuantityUncertainty stated;
    gum::UncertaintyBudget& result = stated.budget;
    const Eigen::Index n = 24;
    result.coverage_probability = 0.9545;
    result.value = Eigen::VectorXd::Zero(n);
    result.value(0) = 0.5 * k_um;
    result.value(3) = 0.2 * k_um;
    result.value(6) = -0.1 * k_um;
    result.value(1) = 0.3 * k_um;
    result.value(4) = -0.2 * k_um;
    result.standard_uncertainty = Eigen::VectorXd::Constant(n, u * k_um);
    stated.covariance =
        engine::AnglewiseCovariance(Eigen::MatrixXd(result.standard_uncertainty.cwiseAbs2().asDiagonal()));
    result.effective_degrees_of_freedom = Eigen::VectorXd::Constant(n, INFINITY);
    result.coverage_factor = Eigen::VectorXd::Constant(n, k_factor);
    result.expanded_uncertainty = k_factor * result.standard_uncertainty;
    return stated;
}

const reports::ComparisonSummary& row(const reports::Comparison& comparison, const std::string& direction) {
    for (const reports::ComparisonSummary& summary : comparison.summary) {
        if (summary.direction == direction) {
            return summary;
        }
    }
    throw std::logic_error("no summary of " + direction);
}

std::string joined(const std::vector<std::string>& texts) {
    std::string all;
    for (const std::string& text : texts) {
        all += text + "\n";
    }
    return all;
}

// ---- the reference by what is known of the indicator ----------------------------------------------------------------

TEST(ReferenceComparison, TakesTheMaximumPermissibleErrorAsCommonToADirection) {
    const reports::Comparison comparison = reference_comparison(read(campaign(k_three_of_x)), displacement());
    EXPECT_EQ(comparison.form, "rotary_table");
    EXPECT_EQ(comparison.unit, "um");
    EXPECT_EQ(comparison.position_name, "angle");
    EXPECT_EQ(comparison.position_unit, "deg");
    EXPECT_EQ(comparison.reference_name, "dial indicator");
    EXPECT_EQ(comparison.correlation, "unknown");
    ASSERT_EQ(comparison.points.size(), 3U);
    EXPECT_EQ(comparison.points[1].direction, "x");
    EXPECT_EQ(comparison.points[1].angle_deg, 45.0);
    EXPECT_EQ(comparison.points[1].position, 45.0);
    EXPECT_NEAR(*comparison.points[0].u, 0.3, 1e-12);
    EXPECT_NEAR(*comparison.points[0].reference_u, 0.4, 1e-12);
    EXPECT_NEAR(*comparison.points[0].reference_U.number, 0.4 * k_factor, 1e-12);
    EXPECT_NEAR(comparison.points[0].D.number, 0.5, 1e-12);
    EXPECT_NEAR(*comparison.points[0].u_D, 0.5, 1e-12);
    EXPECT_NEAR(*comparison.points[0].En.number, 1.0 / k_factor, 1e-12);

    // V = 0.09 I + 0.16 1 1ᵀ: r = 0.64, 9/(3 + 6 · 0.64²) points; DᵀV⁻¹D = (0.30 - 0.16/0.57 · 0.36)/0.09 by the
    // formula of Woodbury. p_low by Imhof's integral in numpy/scipy: 0.3401060236.
    const reports::ComparisonSummary& x = row(comparison, "x");
    EXPECT_EQ(x.points, 3);
    EXPECT_NEAR(x.mean_abs_En.number, 0.8 / 3.0 / k_factor * 2.0, 1e-12);
    EXPECT_NEAR(*x.effective_points.number, 9.0 / (3.0 + 6.0 * 0.64 * 0.64), 1e-9);
    EXPECT_NEAR(*x.mahalanobis_square, (0.30 - 0.16 / 0.57 * 0.36) / 0.09, 1e-9);
    EXPECT_NEAR(*x.p_low.number, 0.3401060236, 1e-7);
    EXPECT_NEAR(*x.p_high.number, 1.0 - 0.3401060236, 1e-7);
    EXPECT_THAT(joined(comparison.remarks), HasSubstr("that all points of a direction have in common"));
}

TEST(ReferenceComparison, TakesAnErrorOfEachPointApartWhereTheDescriptionSaysSo) {
    Files files = campaign(k_three_of_x);
    replace(files["dial_indicator.json"], "\"resolution_um\"", "\"mpe_common\": false, \"resolution_um\"");
    const reports::Comparison comparison = reference_comparison(read(files), displacement());
    const reports::ComparisonSummary& x = row(comparison, "x");
    // V = 0.25 I: chi-square with 3 degrees of freedom at 0.30/0.25.
    EXPECT_NEAR(*x.effective_points.number, 3.0, 1e-9);
    EXPECT_NEAR(*x.mahalanobis_square, 1.2, 1e-9);
    EXPECT_NEAR(*x.p_low.number, 0.2469956883, 1e-7);
    EXPECT_NEAR(*comparison.points[0].En.number, 1.0 / k_factor, 1e-12);
    EXPECT_THAT(joined(comparison.remarks), HasSubstr("\"mpe_common\": false"));
}

// The verdict is a disagreement of what is stated; what is stated wrongly of all readings is named.
TEST(ReferenceComparison, NamesWhatAllReadingsHaveWrong) {
    gum::QuantityUncertainty moved = displacement(0.1);
    for (Eigen::Index k = 0; k < 8; ++k) {
        moved.budget.value(3 * k) = 5.0 * std::cos(static_cast<double>(k)) * k_um;
    }
    /// \param beside  what single readings have wrong beside it, by the number of the reading
    const auto remarks_of = [&](double factor, double constant, const std::vector<double>& beside = {}) {
        Files files = campaign({});
        for (std::size_t k = 0; k < 8; ++k) {
            const double reading = 5.0 * std::cos(static_cast<double>(k)) * factor + constant;
            files["dial_indicator.csv"] += "x," + std::to_string(45 * k) + ",1," +
                                           std::to_string(reading + (k < beside.size() ? beside[k] : 0.0)) + "\n";
        }
        return joined(reference_comparison(read(files), moved).remarks);
    };
    EXPECT_THAT(remarks_of(1.0, 0.0), Not(HasSubstr("the readings agree")));
    EXPECT_THAT(remarks_of(-1.0, 0.0), HasSubstr("In direction x the readings agree when they have the other sign"));
    EXPECT_THAT(remarks_of(0.001, 0.0),
                HasSubstr("In direction x the readings agree when they are multiplied by 1000"));
    EXPECT_THAT(remarks_of(1.0, -12.0), HasSubstr("In direction x the readings agree but for one constant, 12 µm"));
    EXPECT_THAT(remarks_of(-0.5, 3.0), Not(HasSubstr("the readings agree")));
    // Readings that disagree by themselves do so with the other sign, or but for a constant.
    const std::vector<double> scatter{0.1, -0.1, 0.0, 0.1, -0.1, 0.1, 0.0, -0.1};
    const std::vector<double> one_off{0.0, 0.0, 1.0};
    const std::vector<double> alternating{0.35, -0.35, 0.35, -0.35, 0.35, -0.35, 0.35, -0.35};
    for (const auto& [factor, constant] : {std::pair(-1.0, 0.0), std::pair(1.0, -12.0)}) {
        EXPECT_THAT(remarks_of(factor, constant, scatter), HasSubstr("the readings agree"));
        EXPECT_THAT(remarks_of(factor, constant, one_off), Not(HasSubstr("the readings agree")));
        EXPECT_THAT(remarks_of(factor, constant, alternating), Not(HasSubstr("the readings agree")));
    }
}

TEST(ReferenceComparison, TakesDirectionsAsIndependentOfEachOther) {
    const reports::Comparison comparison =
        reference_comparison(read(campaign({"y,45", "x,0", "x,45", "y,0", "x,90"})), displacement());
    ASSERT_EQ(comparison.points.size(), 5U);
    EXPECT_EQ(comparison.points[3].direction, "y");
    EXPECT_EQ(comparison.points[3].angle_deg, 0.0);
    EXPECT_NEAR(comparison.points[3].D.number, 0.3, 1e-12);
    EXPECT_NEAR(*row(comparison, "x").effective_points.number, 9.0 / (3.0 + 6.0 * 0.64 * 0.64), 1e-9);
    EXPECT_NEAR(*row(comparison, "y").effective_points.number, 4.0 / (2.0 + 2.0 * 0.64 * 0.64), 1e-9);
    EXPECT_NEAR(*row(comparison, "all").effective_points.number, 25.0 / (5.0 + 8.0 * 0.64 * 0.64), 1e-9);
    EXPECT_NEAR(*row(comparison, "all").mahalanobis_square,
                *row(comparison, "x").mahalanobis_square + *row(comparison, "y").mahalanobis_square, 1e-9);
}

TEST(ReferenceComparison, DividesTheRepeatabilityByTheRunsOfThePoint) {
    Files files = campaign({"x,0", "x,45", "x,90"});
    files["dial_indicator.json"] =
        R"({"contact_point_mm": [100, 4, 0], "resolution_um": 0.12, "mpe_um": 0.3, "repeatability_um": 0.2})";
    files["dial_indicator.csv"] += "x,0,2,0.3\nx,0,3,0.3\nx,0,4,0.6\n";
    const reports::Comparison comparison = reference_comparison(read(files), displacement());
    const double of_indicator = 0.3 * 0.3 / 3.0 + 0.12 * 0.12 / 12.0;
    EXPECT_NEAR(comparison.points[0].reference_value.number, 0.3, 1e-12);
    EXPECT_NEAR(*comparison.points[0].reference_u, std::sqrt(of_indicator + 0.04 / 4.0), 1e-12);
    EXPECT_NEAR(*comparison.points[1].reference_u, std::sqrt(of_indicator + 0.04), 1e-12);
    ASSERT_EQ(comparison.reference_budget.size(), 3U);
    EXPECT_EQ(comparison.reference_budget[2].input, "repeatability, mean of 4 runs");
    EXPECT_NEAR(comparison.reference_budget[0].share.number, 0.03 / (of_indicator + 0.01), 1e-12);
    // Resolution and repeatability are of each point apart.
    const double r01 = 0.03 / std::sqrt((0.09 + of_indicator + 0.01) * (0.09 + of_indicator + 0.04));
    const double r12 = 0.03 / (0.09 + of_indicator + 0.04);
    EXPECT_NEAR(*row(comparison, "x").effective_points.number, 9.0 / (3.0 + 4.0 * r01 * r01 + 2.0 * r12 * r12), 1e-9);
}

TEST(ReferenceComparison, UsesTheCovarianceOfTheDisplacement) {
    gum::QuantityUncertainty table = displacement();
    Eigen::MatrixXd covariance = table.covariance.dense();
    covariance(0, 3) = covariance(3, 0) = 0.5 * covariance(0, 0);
    table.covariance = engine::AnglewiseCovariance(covariance);
    Files files = campaign(k_three_of_x);
    replace(files["dial_indicator.json"], "\"resolution_um\"", "\"mpe_common\": false, \"resolution_um\"");
    const reports::Comparison comparison = reference_comparison(read(files), table);
    const double r = 0.5 * 0.09 / 0.25;
    EXPECT_NEAR(*row(comparison, "x").effective_points.number, 9.0 / (3.0 + 2.0 * r * r), 1e-9);
}

// ---- correlation, published figures, audit --------------------------------------------------------------------------

TEST(ReferenceComparison, PrintsTheWorstPlausibleScoreWhereTheCorrelationIsNotKnown) {
    const reports::Comparison comparison = reference_comparison(read(campaign(k_three_of_x)), displacement());
    // r = U/U_ref = 0.75: U² = 0.36 + 0.64 - 2 · 0.75 · 0.48 = 0.28, in the unit of k = 2.
    ASSERT_TRUE(comparison.points[0].En_worst.number);
    EXPECT_NEAR(*comparison.points[0].En_worst.number, 0.5 / (k_factor * std::sqrt(0.07)), 1e-9);
    const reports::Comparison none =
        reference_comparison(read(campaign(k_three_of_x, R"("correlation": "none")")), displacement());
    EXPECT_EQ(none.correlation, "none");
    EXPECT_FALSE(none.points[0].En_worst.number);
    EXPECT_NEAR(*none.points[0].En.number, *comparison.points[0].En.number, 1e-15);
}

TEST(ReferenceComparison, TakesAStatedCorrelationAsOneEffectOfTheDirection) {
    const reports::Comparison comparison =
        reference_comparison(read(campaign(k_three_of_x, R"("correlation": 0.25)")), displacement());
    EXPECT_EQ(comparison.correlation, "given");
    EXPECT_EQ(comparison.correlation_given, 0.25);
    EXPECT_FALSE(comparison.points[0].En_worst.number);
    EXPECT_NEAR(*comparison.points[0].correlation, 0.25, 1e-12);
    // u² = 0.09 + 0.16 - 2 · 0.25 · 0.3 · 0.4 = 0.19, off the diagonal 0.16 - 0.06 = 0.1.
    EXPECT_NEAR(*comparison.points[0].u_D, std::sqrt(0.19), 1e-12);
    const double r = 0.1 / 0.19;
    EXPECT_NEAR(*row(comparison, "x").effective_points.number, 9.0 / (3.0 + 6.0 * r * r), 1e-9);
    EXPECT_THAT(joined(comparison.remarks), HasSubstr("0.25 of both methods is taken to come from an effect that all"));
}

TEST(ReferenceComparison, TakesAStatedCorrelationPointByPointWhereNothingIsCommon) {
    Files files = campaign(k_three_of_x, R"("correlation": 0.9)");
    replace(files["dial_indicator.json"], "\"resolution_um\"", "\"mpe_common\": false, \"resolution_um\"");
    const reports::Comparison comparison = reference_comparison(read(files), displacement());
    EXPECT_NEAR(*comparison.points[0].u_D, std::sqrt(0.25 - 2.0 * 0.9 * 0.12), 1e-12);
    EXPECT_NEAR(*row(comparison, "x").effective_points.number, 3.0, 1e-9);
    EXPECT_THAT(joined(comparison.remarks), HasSubstr("is taken to hold at equal points"));
}

TEST(ReferenceComparison, RefusesACorrelationThatTheCovariancesDoNotAllow) {
    // Values that are independent of each other, and readings that are all wrong by the same amount: they cannot have
    // the correlation 0.9 at each point.
    const RotaryTableJob job = read(campaign(k_three_of_x, R"("correlation": 0.9)"));
    try {
        (void)reference_comparison(job, displacement());
        FAIL() << "an impossible correlation was accepted";
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-COMPARE-0204");
        EXPECT_THAT(gum::message(error.diagnostics().front()), HasSubstr("the value is 0.9, and neither"));
    }
}

TEST(ReferenceComparison, HandsOnPublishedFiguresAndFindings) {
    const reports::Comparison comparison = reference_comparison(
        read(campaign(k_three_of_x, R"("published": {"source": "a paper", "mean_abs_En": {"x": 0.77}},
            "audited": {"factor": 0.5, "finding": "bound taken as a standard uncertainty"})")),
        displacement());
    EXPECT_EQ(comparison.published_source, "a paper");
    EXPECT_EQ(comparison.audit_finding, "bound taken as a standard uncertainty");
    EXPECT_EQ(row(comparison, "x").published_mean_abs_En.number, 0.77);
    EXPECT_EQ(row(comparison, "x").published_mean_abs_En.text, "0.77");
    ASSERT_TRUE(comparison.points[0].En_audited.number);
    EXPECT_NEAR(*comparison.points[0].En_audited.number, 0.5 / (k_factor * std::sqrt(0.09 + 0.04)), 1e-9);
}

// ---- the reference by its budget ------------------------------------------------------------------------------------

const std::string k_budget = R"({ "schema": "gumcert/job/1", "kind": "budget",
  // a comment with a brace { before the model
  "model": ["X = reading*(1 + d_gain) + d_zero + d_rep"],
  "inputs": {
    "reading": {"value": 0, "unit": "um", "constant": true},
    "d_gain": {"value": 0, "u": 0.1},
    "d_zero": {"value": 0, "unit": "um", "u": 0.3},
    "d_rep": {"value": 0, "unit": "nm", "u": 200, "between_points": "independent"} },
  "outputs": {"X": {"unit": "um", "coverage_probability": 0.99}} }
)";

Files campaign_with_budget(const std::string& budget = k_budget) {
    Files files = campaign({}, "\"budget\": \"budgets/indicator.json\"");
    files["dial_indicator.csv"] += "x,0,1,4\nx,0,2,6\nx,45,1,-2\ny,0,1,1\n";
    files["dial_indicator.json"] = R"({"contact_point_mm": [100, 4, 0]})";
    files["budgets/indicator.json"] = budget;
    return files;
}

TEST(ReferenceComparison, EvaluatesTheBudgetAtEveryPoint) {
    const RotaryTableJob job = read(campaign_with_budget());
    EXPECT_EQ(job.reference_budget_file, "budgets/indicator.json");
    EXPECT_THAT(job.files, testing::Contains("budgets/indicator.json"));
    ASSERT_EQ(job.reference_budget->points.size(), 3U);
    EXPECT_EQ(job.reference_budget->points[1].name, "x 45°");
    const reports::Comparison comparison = reference_comparison(job, displacement());
    ASSERT_EQ(comparison.points.size(), 3U);
    // u² = (0.1 X)² + 0.3² + 0.2², covariance 0.01 X_i X_j + 0.09, in µm; U is that of the budget, for 99 %.
    const double u0 = std::sqrt(0.25 + 0.09 + 0.04);
    const double u1 = std::sqrt(0.04 + 0.09 + 0.04);
    const double u2 = std::sqrt(0.01 + 0.09 + 0.04);
    EXPECT_NEAR(comparison.points[0].reference_value.number, 5.0, 1e-12);
    EXPECT_NEAR(*comparison.points[0].reference_u, u0, 1e-12);
    EXPECT_NEAR(*comparison.points[0].reference_U.number, gum::coverage_factor(0.99, INFINITY) * u0, 1e-12);
    EXPECT_EQ(comparison.points[0].reference_coverage_probability, 0.99);
    // E_n takes the one for the probability of the job.
    ASSERT_TRUE(comparison.points[0].reference_U_of_scores);
    EXPECT_NEAR(*comparison.points[0].reference_U_of_scores, k_factor * u0, 1e-9);
    EXPECT_NEAR(comparison.points[1].reference_value.number, -2.0, 1e-12);
    EXPECT_NEAR(*comparison.points[1].reference_u, u1, 1e-12);
    EXPECT_NEAR(*comparison.points[2].reference_u, u2, 1e-12);
    const auto r = [](double covariance, double a, double b) {
        return covariance / std::sqrt((a * a + 0.09) * (b * b + 0.09));
    };
    const double r01 = r(0.01 * 5.0 * -2.0 + 0.09, u0, u1);
    const double r02 = r(0.01 * 5.0 * 1.0 + 0.09, u0, u2);
    const double r12 = r(0.01 * -2.0 * 1.0 + 0.09, u1, u2);
    EXPECT_NEAR(*row(comparison, "x").effective_points.number, 4.0 / (2.0 + 2.0 * r01 * r01), 1e-9);
    // What a budget has in common, the directions have in common too.
    EXPECT_NEAR(*row(comparison, "all").effective_points.number,
                9.0 / (3.0 + 2.0 * (r01 * r01 + r02 * r02 + r12 * r12)), 1e-9);
    ASSERT_EQ(comparison.reference_budget.size(), 4U);
    EXPECT_EQ(comparison.reference_budget[0].input, "reading");
    EXPECT_NEAR(comparison.reference_budget[1].contribution.number, 0.5, 1e-12);
    EXPECT_THAT(joined(comparison.remarks), HasSubstr("budgets/indicator.json, evaluated at every point"));
    EXPECT_THAT(joined(comparison.remarks), HasSubstr("largest uncertainty, x 0°"));
    EXPECT_THAT(joined(comparison.remarks), testing::Not(HasSubstr("maximum permissible error")));
}

TEST(ReferenceComparison, TakesABudgetInAnyUnitOfLength) {
    std::string budget = k_budget;
    replace(budget, R"("X": {"unit": "um")", R"("X": {"unit": "mm")");
    replace(budget, R"("value": 0, "unit": "um", "constant")", R"("value": 0, "unit": "m", "constant")");
    const reports::Comparison comparison = reference_comparison(read(campaign_with_budget(budget)), displacement());
    EXPECT_NEAR(comparison.points[0].reference_value.number, 5.0, 1e-12);
    EXPECT_NEAR(*comparison.points[0].reference_u, std::sqrt(0.38), 1e-12);
    EXPECT_NEAR(comparison.reference_budget[1].contribution.number, 0.5, 1e-12);
}

TEST(ReferenceComparison, LetsWhatDependsOnTheReadingFollowIt) {
    std::string budget = k_budget;
    replace(budget, "\"unit\": \"nm\", \"u\": 200",
            R"("unit": "um", "specification": {"of": "reading", "percent_of_reading": 10})");
    replace(budget, "\"reading\": {\"value\": 0", "\"reading\": {\"value\": 1");
    const reports::Comparison comparison = reference_comparison(read(campaign_with_budget(budget)), displacement());
    EXPECT_NEAR(*comparison.points[0].reference_u, std::sqrt(0.25 + 0.09 + 0.25 / 3.0), 1e-12);
    EXPECT_NEAR(*comparison.points[1].reference_u, std::sqrt(0.04 + 0.09 + 0.04 / 3.0), 1e-12);
}

TEST(ReferenceComparison, UsesDegreesOfFreedomOfTheBudget) {
    std::string budget = k_budget;
    replace(budget, "\"u\": 200", "\"u\": 200, \"nu\": 4");
    const reports::Comparison comparison = reference_comparison(read(campaign_with_budget(budget)), displacement());
    const double nu = std::pow(0.38, 2) / (0.0016 / 4.0);  // Welch-Satterthwaite
    ASSERT_TRUE(comparison.points[0].reference_k);
    // The convolution of a t-distribution with ν = 4 and the others has wider tails than t with their ν_eff.
    EXPECT_GT(*comparison.points[0].reference_k, 1.01 * gum::coverage_factor(0.99, nu));
    EXPECT_LT(*comparison.points[0].reference_k, 1.1 * gum::coverage_factor(0.99, nu));
}

TEST(ReferenceComparison, RefusesAReferenceValueWithoutUncertainty) {
    std::string budget = k_budget;
    replace(budget, "reading*(1 + d_gain) + d_zero + d_rep", "reading*(1 + d_gain) + 0*(d_zero + d_rep)");
    Files files = campaign_with_budget(budget);
    replace(files["dial_indicator.csv"], "x,45,1,-2", "x,45,1,0");
    const RotaryTableJob job = read(files);
    try {
        (void)reference_comparison(job, displacement());
        FAIL() << "a reference value without uncertainty was accepted";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-COMPARE-0205");
        EXPECT_THAT(gum::message(error.diagnostics().front()), HasSubstr("budgets/indicator.json, point x 45°"));
    }
}

// ---- refused jobs ---------------------------------------------------------------------------------------------------

struct BadReference {
    std::string name;
    std::vector<std::pair<std::string, std::string>> edits;  ///< of the budget where it has the text, else of the job
    std::string code, place, message;
};

class BadReferenceTest : public testing::TestWithParam<BadReference> {};

TEST_P(BadReferenceTest, IsRefusedWithPlaceAndCode) {
    const BadReference& bad = GetParam();
    Files files = campaign_with_budget();
    for (const auto& [from, to] : bad.edits) {
        std::string& budget = files["budgets/indicator.json"];
        replace(budget.find(from) == std::string::npos ? files["job.json"] : budget, from, to);
    }
    const std::vector<gum::Diagnostic> found = refusals(files);
    ASSERT_EQ(found.size(), 1U) << jobs::test::texts(found);
    EXPECT_EQ(found.front().code, bad.code);
    EXPECT_THAT(found.front().where, testing::StartsWith(bad.place));
    EXPECT_THAT(gum::message(found.front()), HasSubstr(bad.message));
    EXPECT_FALSE(found.front().rule.empty());
    EXPECT_FALSE(found.front().action.empty());
}

/// An edit that adds keys to `reference_method`.
std::pair<std::string, std::string> added(const std::string& keys) {
    return {"\"description\"", keys + ", \"description\""};
}

std::vector<BadReference> bad_references() {
    const std::string outputs = R"({"X": {"unit": "um", "coverage_probability": 0.99}})";
    const std::string reading = R"("reading": {"value": 0, "unit": "um", "constant": true})";
    const std::string model = "reading*(1 + d_gain) + d_zero + d_rep";
    const std::string at_reading = "budgets/indicator.json#/inputs/reading (line 5";
    const std::string at_method = "job.json#/reference_method/";
    return {
        {"BudgetOfTwoOutputs",
         {{model + "\"", model + R"(", "Y = 2*d_gain")"}, {outputs, R"({"X": {"unit": "um"}, "Y": {}})"}},
         "GC-REFERENCE-0001",
         "budgets/indicator.json#/outputs",
         "the results are X [um], Y [1]"},
        {"BudgetOfAnotherDimension",
         {{"X = " + model, "X = (" + model + ")^2"}, {outputs, R"({"X": {"unit": "um2"}})"}},
         "GC-REFERENCE-0001",
         "budgets/indicator.json#/outputs",
         "the result is X [um2]"},
        {"BudgetWithoutReading",
         {{reading, R"("readings": {"value": 0, "unit": "um", "constant": true})"}, {"= reading*", "= readings*"}},
         "GC-REFERENCE-0002",
         "budgets/indicator.json#/inputs",
         "no input is named \"reading\""},
        {"ReadingThatIsNoLength",
         {{reading, R"("reading": {"value": 0, "constant": true})"},
          {"= reading*", "= 1e-6*d_zero*reading*"},
          {" + d_zero + d_rep", " + d_rep"}},
         "GC-REFERENCE-0002",
         at_reading,
         "the unit of \"reading\" is \"1\""},
        {"ReadingOfObservations",
         {{reading, R"("reading": {"unit": "um", "observations": [0.1, 0.2, 0.4]})"}},
         "GC-REFERENCE-0002",
         at_reading,
         "\"reading\" is stated by \"observations\""},
        {"ReadingOfComponents",
         {{reading, R"("reading": {"unit": "um", "components": [{"name": "a", "value": 0, "u": 1},
            {"name": "b", "value": 0, "u": 1}]})"}},
         "GC-REFERENCE-0002",
         at_reading,
         "\"reading\" is a sum of components"},
        {"BudgetWithPoints",
         {{"\"outputs\"", R"("points": [{"reading": 1}], "outputs")"}},
         "GC-REFERENCE-0003",
         "budgets/indicator.json#/points",
         "1 point —"},
        {"BudgetThatIsRefusedByItself",
         {{"\"u\": 0.3", "\"u\": -0.3"}},
         "GC-INPUT-0023",
         "budgets/indicator.json#/inputs/d_zero/u (line 7",
         "-0.3"},
        {"UnknownWord",
         {added(R"("correlation": "some")")},
         "GC-REFERENCE-0004",
         at_method + "correlation (line 15",
         "\"some\""},
        {"CorrelationAboveOne", {added(R"("correlation": 1.5)")}, "GC-INPUT-0023", at_method + "correlation", "1.5"},
        {"PublishedOfUnknownDirection",
         {added(R"("published": {"source": "a paper", "mean_abs_En": {"x": 1, "w": 1}})")},
         "GC-INPUT-0022",
         at_method + "published/mean_abs_En/w",
         "\"w\""},
        {"PublishedOfDirectionWithoutReadings",
         {added(R"("published": {"source": "a paper", "mean_abs_En": {"z": 0.32}})")},
         "GC-REFERENCE-0005",
         at_method + "published/mean_abs_En/z",
         "no direction \"z\""},
        {"PublishedWithoutDirection",
         {added(R"("published": {"source": "a paper", "mean_abs_En": {}})")},
         "GC-INPUT-0020",
         at_method + "published/mean_abs_En",
         "no direction is stated"},
        {"AuditedFactorOfZero",
         {added(R"("audited": {"factor": 0, "finding": "f"})")},
         "GC-INPUT-0023",
         at_method + "audited/factor",
         "0"},
        {"AuditedWithoutFinding",
         {added(R"("audited": {"factor": 0.5})")},
         "GC-INPUT-0020",
         at_method + "audited",
         "\"finding\""},
    };
}

INSTANTIATE_TEST_SUITE_P(Rows, BadReferenceTest, testing::ValuesIn(bad_references()),
                         [](const auto& bad) { return bad.param.name; });

TEST(ReferenceMethod, CodesAreUniqueAndAscend) {
    std::string_view last;
    for (const jobs::InputCode& entry : jobs::k_reference_codes) {
        EXPECT_TRUE(entry.code.starts_with("GC-REFERENCE-")) << entry.code;
        EXPECT_LT(last, entry.code);
        last = entry.code;
        const auto bad = bad_references();
        EXPECT_TRUE(std::any_of(bad.begin(), bad.end(), [&](const auto& row) { return row.code == entry.code; }))
            << entry.code << " has no bad input";
    }
}

}  // namespace
}  // namespace gumcert::reports
