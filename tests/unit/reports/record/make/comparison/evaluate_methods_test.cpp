#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/record/make/comparison/evaluate_comparison.h"
#include "tests/support/budget_campaign.h"

namespace gumcert::reports {
namespace {

using Eigen::MatrixXd;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

const gum::Unit k_um_of_methods = gum::Unit::parse("um");

jobs::BudgetJob budget(const std::string& keys) {
    return jobs::test::read_budget(keys);
}

/// Three points, u = 1 of the method and 0.2 of the reference, k = 2.
jobs::ComparisonJob stated_job(jobs::MethodCorrelation correlation) {
    jobs::ComparisonJob job;
    job.methods.emplace();
    jobs::MethodComparisonRequest& methods = *job.methods;
    methods.unit = k_um_of_methods;
    methods.correlation = correlation;
    methods.laboratory.name = "Laser method";
    methods.reference.name = "Indicator";
    const std::vector<double> D{0.9, -0.8, 0.5};
    for (std::size_t i = 0; i < D.size(); ++i) {
        const double reference = 10.0 * static_cast<double>(i);
        methods.points.push_back({.name = std::to_string(i + 1), .direction = "", .position = std::nullopt});
        methods.laboratory.value.push_back(reference + D[i]);
        methods.reference.value.push_back(reference);
        methods.laboratory.uncertainty.push_back({.u = 1.0, .U = 2.0, .k = 2.0});
        methods.reference.uncertainty.push_back({.u = 0.2, .U = 0.4, .k = 2.0});
    }
    methods.laboratory.covariance = MatrixXd::Identity(3, 3);
    methods.reference.covariance = 0.04 * MatrixXd::Identity(3, 3);
    return job;
}

std::string all_remarks(const reports::Comparison& record) {
    std::string text;
    for (const std::string& remark : record.remarks) {
        text += remark + "\n";
    }
    return text;
}

TEST(EvaluateMethods, OfStatedValues) {
    jobs::ComparisonJob job = stated_job(jobs::MethodCorrelation::none);
    job.organiser = "Example Institute";
    job.methods->position_name = "angle";
    job.methods->position_unit = gum::Unit::parse("deg");
    job.methods->tolerance = 5.0;
    job.methods->laboratory.cmc_U = 0.8;
    job.methods->laboratory.audit_finding = "limit taken as standard uncertainty";
    job.methods->laboratory.audited_factor = 0.577;
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_EQ(record.form, "methods");
    EXPECT_EQ(record.method_name, "Laser method");
    EXPECT_EQ(record.reference_name, "Indicator");
    EXPECT_EQ(record.unit, "um");
    EXPECT_EQ(record.position_unit, "deg");
    EXPECT_EQ(record.organiser, "Example Institute");
    EXPECT_EQ(record.correlation, "none");
    EXPECT_EQ(record.tolerance.text, "5");
    EXPECT_EQ(record.audit_finding, "Laser method: limit taken as standard uncertainty");
    ASSERT_EQ(record.points.size(), 3U);
    EXPECT_EQ(record.points[0].D.text, "0.9");
    EXPECT_NEAR(*record.points[0].U_over_CMC, 2.5, 1e-12);
    EXPECT_TRUE(record.points[0].En_audited.number);
    EXPECT_THAT(all_remarks(record), HasSubstr("up to 2.5 times its stated capability"));
    EXPECT_THAT(record.method_budget, IsEmpty());
}

TEST(EvaluateMethods, GivenCorrelationHoldsAtEqualPoints) {
    jobs::ComparisonJob job = stated_job(jobs::MethodCorrelation::given);
    job.methods->r = 0.5;
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_EQ(record.correlation, "given");
    EXPECT_EQ(*record.correlation_given, 0.5);
    EXPECT_NEAR(*record.points[0].correlation, 0.5, 1e-15);
    EXPECT_NEAR(*record.summary.front().effective_points.number, 3.0, 1e-12);
    EXPECT_THAT(all_remarks(record), HasSubstr("The stated correlation 0.5 of both methods is taken to hold at equal"));
}

TEST(EvaluateMethods, GivenCorrelationOfPointsThatShareEverything) {
    jobs::ComparisonJob job = stated_job(jobs::MethodCorrelation::given);
    job.methods->r = 0.5;
    job.methods->laboratory.covariance.setConstant(1.0);
    job.methods->reference.covariance.setConstant(0.04);
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_EQ(*record.summary.front().rank, 1);
    EXPECT_THAT(all_remarks(record), HasSubstr("an effect that all points share"));
}

TEST(EvaluateMethods, GivenCorrelationThatCannotBe) {
    jobs::ComparisonJob job = stated_job(jobs::MethodCorrelation::given);
    job.methods->r = 0.9;
    job.methods->laboratory.covariance.setConstant(1.0);  // and the reference independent from point to point
    try {
        (void)evaluate_methods(job);
        ADD_FAILURE();
    } catch (const gum::InputError& refused) {
        EXPECT_EQ(refused.diagnostics().front().code, "GC-COMPARE-0204");
        EXPECT_THAT(refused.diagnostics().front().what, HasSubstr("the value is 0.9"));
    }
}

TEST(EvaluateMethods, UnknownCorrelation) {
    const reports::Comparison record = evaluate_methods(stated_job(jobs::MethodCorrelation::unknown));
    EXPECT_EQ(record.correlation, "unknown");
    EXPECT_TRUE(record.points[0].En_worst.number);
}

/// Method y = l + t with a laser that all points share and a thermometer that each point reads anew; reference z = g.
jobs::ComparisonJob job_with_budgets(const std::string& reference_inputs, const std::string& reference_model,
                                     const std::string& unit = "um") {
    jobs::ComparisonJob job;
    job.methods.emplace();
    jobs::MethodComparisonRequest& methods = *job.methods;
    methods.unit = gum::Unit::parse(unit);
    methods.correlation = jobs::MethodCorrelation::shared_sources;
    methods.laboratory.name = "Method";
    methods.laboratory.budget_file = "method.json";
    methods.laboratory.budget = std::make_shared<jobs::BudgetJob>(budget(R"("model": ["y = l + t"], "inputs": {
        "l": {"value": 10, "unit": "um", "u": 0.4, "source": "laser"},
        "t": {"value": 0, "unit": "um", "u": 0.3, "source": "thermometer"}},
        "points": [{"point": "A", "t": {"value": 0.1, "u": 0.3, "source": "thermometer"}},
                   {"point": "B", "t": {"value": 0.2, "u": 0.5, "source": "thermometer"}}])"));
    methods.reference.name = "Reference";
    methods.reference.budget_file = "reference.json";
    methods.reference.budget = std::make_shared<jobs::BudgetJob>(budget(
        "\"model\": [\"" + reference_model + "\"], \"inputs\": {" + reference_inputs +
        R"(}, "points": [{"point": "B", "o": {"value": 0.3, "u": 0.1}}, {"point": "A", "o": {"value": 0.1, "u": 0.1}}])"));
    for (const char* name : {"A", "B"}) {
        methods.points.push_back({.name = name, .direction = "", .position = std::nullopt});
    }
    methods.laboratory.budget_points = {0, 1};
    methods.reference.budget_points = {1, 0};  // in another order
    return job;
}

const std::string k_offset = R"("o": {"value": 0, "unit": "um", "u": 0.1})";

TEST(EvaluateMethods, ComputesTheCovarianceFromSharedSources) {
    const jobs::ComparisonJob job =
        job_with_budgets(R"("g": {"value": 10, "unit": "um", "u": 0.1, "source": "laser"}, )" + k_offset, "z = g + o");
    const reports::Comparison record = evaluate_methods(job);
    ASSERT_EQ(record.points.size(), 2U);
    EXPECT_EQ(record.correlation, "shared_sources");
    EXPECT_NEAR(record.points[0].value.number, 10.1, 1e-12);
    EXPECT_NEAR(record.points[0].reference_value.number, 10.1, 1e-12);
    EXPECT_NEAR(record.points[1].reference_value.number, 10.3, 1e-12);
    // Point A: u = 0.5 and √0.02, covariance 0.4 · 0.1.
    EXPECT_NEAR(*record.points[0].correlation, 0.04 / (0.5 * std::sqrt(0.02)), 1e-12);
    EXPECT_NEAR(*record.points[0].u_D, std::sqrt(0.25 + 0.02 - 0.08), 1e-12);
    EXPECT_NEAR(*record.points[1].u_D, std::sqrt(0.41 + 0.02 - 0.08), 1e-12);
    // cov(D_A, D_B) = 0.16 + 0.01 − 2 · 0.04.
    const double r = 0.09 / (*record.points[0].u_D * *record.points[1].u_D);
    EXPECT_NEAR(*record.summary.front().effective_points.number, 4.0 / (2.0 + 2.0 * r * r), 1e-12);
    ASSERT_EQ(record.shared_sources.size(), 1U);
    EXPECT_EQ(record.shared_sources[0].source, "laser");
    EXPECT_EQ(record.shared_sources[0].first, "Method");
    EXPECT_EQ(record.shared_sources[0].second, "Reference");
    EXPECT_NEAR(record.shared_sources[0].covariance, 0.04, 1e-12);
    EXPECT_EQ(record.shared_sources[0].correlation.text, "0.57");
    EXPECT_THAT(all_remarks(record), HasSubstr("Both budgets name laser."));
    // Tables of the points with the largest uncertainty: B of the method.
    ASSERT_EQ(record.method_budget.size(), 2U);
    EXPECT_EQ(record.method_budget[1].u.text, "0.50");
    EXPECT_EQ(record.reference_budget.size(), 2U);
}

TEST(EvaluateMethods, ASourceCommonToThePointsOfOneBudgetOnlyCannotBeShared) {
    // The thermometer is read anew at each point of the method, and once for all points of the reference.
    jobs::ComparisonJob job = job_with_budgets(
        R"("g": {"value": 10, "unit": "um", "u": 0.5, "source": "thermometer"}, )" + k_offset, "z = g + o");
    try {
        (void)evaluate_methods(job);
        ADD_FAILURE();
    } catch (const gum::InputError& refused) {
        EXPECT_EQ(refused.diagnostics().front().code, "GC-COMPARE-0207");
        EXPECT_THAT(refused.diagnostics().front().what, HasSubstr("both budgets name thermometer"));
    }
    job.independent_sources = {"thermometer"};
    EXPECT_EQ(evaluate_methods(job).points.size(), 2U);
}

TEST(EvaluateMethods, KeepsTheSignOfASharedSource) {
    const jobs::ComparisonJob job = job_with_budgets(
        R"("g": {"value": -10, "unit": "um", "u": 0.1, "source": "laser"}, )" + k_offset, "z = -g + o");
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_LT(*record.points[0].correlation, 0.0);
    EXPECT_NEAR(*record.points[0].u_D, std::sqrt(0.25 + 0.02 + 0.08), 1e-12);
}

TEST(EvaluateMethods, TheJobKnowsThatASourceIsIndependent) {
    jobs::ComparisonJob job =
        job_with_budgets(R"("g": {"value": 10, "unit": "um", "u": 0.1, "source": "laser"}, )" + k_offset, "z = g + o");
    job.independent_sources = {"laser"};
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_EQ(*record.points[0].correlation, 0.0);
    EXPECT_THAT(record.shared_sources, IsEmpty());
    EXPECT_THAT(all_remarks(record), HasSubstr("Both budgets name laser; the job states that they are independent"));
}

TEST(EvaluateMethods, BudgetsWithoutACommonSource) {
    const jobs::ComparisonJob job =
        job_with_budgets(R"("g": {"value": 10, "unit": "um", "u": 0.1, "source": "gauge"}, )" + k_offset, "z = g + o");
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_EQ(*record.points[0].correlation, 0.0);
    EXPECT_THAT(all_remarks(record), HasSubstr("name no source in common that is shared"));
}

TEST(EvaluateMethods, TellsOfASharedSourceThatTheJobDoesNotUse) {
    jobs::ComparisonJob job =
        job_with_budgets(R"("g": {"value": 10, "unit": "um", "u": 0.1, "source": "laser"}, )" + k_offset, "z = g + o");
    job.methods->correlation = jobs::MethodCorrelation::none;
    EXPECT_THAT(all_remarks(evaluate_methods(job)), HasSubstr("Both budgets name laser; the covariance that follows"));
}

TEST(EvaluateMethods, TablesOfBudgetsAreInTheUnitOfTheComparison) {
    // The budget is in µm, the comparison in nm: contributions, values and U must not be off by a thousand.
    const jobs::ComparisonJob job = job_with_budgets(
        R"("g": {"value": 10, "unit": "um", "u": 0.1, "source": "gauge"}, )" + k_offset, "z = g + o", "nm");
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_NEAR(record.points[0].value.number, 10100.0, 1e-8);
    EXPECT_NEAR(*record.points[0].u, 500.0, 1e-9);
    EXPECT_NEAR(record.method_budget[0].contribution.number, 400.0, 1e-9);
    EXPECT_NEAR(record.method_budget[0].sensitivity.number.value(), 1000.0, 1e-9);
    EXPECT_NEAR(*record.summary.front().D_fail.number, *record.points[0].U_D.number, 1e-9);
}

TEST(EvaluateMethods, ABudgetAgainstStatedValues) {
    jobs::ComparisonJob job = stated_job(jobs::MethodCorrelation::unknown);
    const jobs::ComparisonJob with_budgets = job_with_budgets(k_offset, "z = o");
    job.methods->laboratory = with_budgets.methods->laboratory;
    job.methods->points = with_budgets.methods->points;
    job.methods->reference.value = {10.0, 10.0};
    job.methods->reference.uncertainty.resize(2);
    job.methods->reference.covariance = 0.04 * MatrixXd::Identity(2, 2);
    const reports::Comparison record = evaluate_methods(job);
    EXPECT_NEAR(record.points[1].D.number, 0.2, 1e-12);
    EXPECT_NEAR(*record.points[1].u_D, std::sqrt(0.41 + 0.04), 1e-12);
    EXPECT_EQ(record.method_budget.size(), 2U);
    EXPECT_THAT(record.reference_budget, IsEmpty());
    EXPECT_THAT(all_remarks(record), Not(HasSubstr("Both budgets")));
}

TEST(EvaluateMethods, RefusesAReferenceWithoutUncertainty) {
    const jobs::ComparisonJob job = job_with_budgets(
        R"("g": {"value": 10, "unit": "um", "constant": true}, "o": {"value": 0, "unit": "um", "u": 0.1})",
        "z = g + 0*o");
    try {
        (void)evaluate_methods(job);
        ADD_FAILURE();
    } catch (const gum::NoResultError& failed) {
        EXPECT_THAT(failed.diagnostics().front().code, HasSubstr("GC-COMPARE-020"));
        EXPECT_THAT(failed.diagnostics().front().where, HasSubstr("reference.json, point A"));
    }
}

}  // namespace
}  // namespace gumcert::reports
