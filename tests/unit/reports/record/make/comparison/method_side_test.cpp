#include "reports/record/make/comparison/method_side.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/make/comparison/evaluate_comparison.h"
#include "tests/support/budget_campaign.h"

namespace gumcert::reports {
namespace {

using jobs::BudgetJob;
using jobs::test::read_budget;

/// y = a + b, with u = 3 µm and 4 µm; `keys` come in addition.
BudgetJob sum_of_two(const std::string& keys = "") {
    return read_budget(R"("model": ["y = a + b"], "outputs": {"y": {"unit": "um"}}, "inputs": {
        "a": {"value": 10, "unit": "um", "u": 3, "source": "laser"},
        "b": {"value": 0, "unit": "um", "u": 4}})" +
                       keys);
}

MethodSide side(const BudgetJob& job, const std::string& unit = "um", double coverage_probability = 0.9545) {
    return side_of_budget({job, "budget.json", "Method", {0}, {""}}, gum::Unit::parse(unit), coverage_probability);
}

template <class Work>
gum::Diagnostic refusal(const Work& work) {
    try {
        work();
    } catch (const gum::DiagnosedError& failure) {
        return failure.diagnostics().front();
    }
    ADD_FAILURE() << "was evaluated";
    return {};
}

TEST(SideOfBudget, IsInTheUnitOfTheComparison) {
    const MethodSide found = side(sum_of_two(), "nm");
    EXPECT_NEAR(found.value.front(), 10000.0, 1e-9);
    EXPECT_NEAR(found.uncertainty.front().u, 5000.0, 1e-9);
    EXPECT_NEAR(found.covariance(0, 0), 25e6, 1e-6);
    ASSERT_EQ(found.budget.size(), 2U);
    EXPECT_NEAR(found.budget[0].contribution.number, 3000.0, 1e-9);
    ASSERT_EQ(found.sources.all.front().size(), 1U);
    EXPECT_EQ(found.sources.all.front().front().source, "laser");
    EXPECT_EQ(found.origin, "Values and uncertainties of Method come from the budget budget.json.");
}

TEST(SideOfBudget, KeepsTheUOfTheBudgetAndScoresForTheComparison) {
    const BudgetJob of_99 = sum_of_two(R"(, "coverage_probability": 0.99)");
    const gum::ResultUncertainty found = side(of_99, "um", 0.95).uncertainty.front();
    EXPECT_EQ(found.coverage_probability, 0.99);
    EXPECT_NEAR(found.U, 5.0 * gum::coverage_factor(0.99, INFINITY), 1e-9);
    ASSERT_TRUE(found.of_scores);
    EXPECT_TRUE(found.of_scores->converted);
    EXPECT_NEAR(found.of_scores->U, 5.0 * gum::coverage_factor(0.95, INFINITY), 1e-9);
}

TEST(SideOfBudget, RefusesAValueWithoutUncertainty) {
    const BudgetJob certain = read_budget(R"("inputs": {"a": {"value": 1, "unit": "um", "constant": true}})");
    const gum::Diagnostic refused = refusal([&] { (void)side(certain); });
    EXPECT_EQ(refused.code, "GC-COMPARE-0205");
    EXPECT_EQ(refused.where, "budget.json");
}

/// Two laboratories, the first one with a budget.
jobs::ComparisonJob laboratories(const BudgetJob& budget) {
    jobs::ComparisonJob job;
    job.rounds = {""};
    job.items.emplace_back().unit = gum::Unit::parse("um");
    for (const char* id : {"A", "B"}) {
        jobs::ComparisonResult result;
        result.participant = job.participants.size();
        result.value = 11.0;
        result.uncertainty = gum::ResultUncertainty{.u = 5.0, .U = 10.0, .k = 2.0};
        job.participants.push_back({.id = id, .name = id, .group = "", .cmc_U = std::nullopt});
        job.results.push_back(result);
    }
    job.results.front().budget = std::make_shared<const BudgetJob>(budget);
    job.results.front().budget_file = "a.json";
    job.results.front().where = "participants/0";
    return job;
}

TEST(EvaluateLaboratories, TakesAResultFromItsBudget) {
    const reports::Comparison comparison = evaluate_laboratories(laboratories(sum_of_two()), {});
    ASSERT_EQ(comparison.points.size(), 2U);
    EXPECT_NEAR(comparison.points.front().value.number, 10.0, 1e-12);
    EXPECT_NEAR(*comparison.points.front().u, 5.0, 1e-12);
    EXPECT_NEAR(comparison.items.front().value.number, 10.5, 1e-12);
}

}  // namespace
}  // namespace gumcert::reports
