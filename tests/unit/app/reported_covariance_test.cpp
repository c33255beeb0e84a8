#include "app/reported_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "app/budget_covariance.h"
#include "tests/unit/engine/job/budget_campaign.h"

namespace gumcert::app {
namespace {

Eigen::MatrixXd reported(const std::string& keys) {
    const engine::BudgetJob job = engine::test::read_budget(keys);
    return reported_covariance(job, evaluate_budget(job, 1));
}

TEST(ReportedCovariance, IsThatOfTheLawWhereItHolds) {
    const engine::BudgetJob job = engine::test::read_budget(
        R"("model": ["y = a + b", "z = a"], "inputs": {"a": {"value": 0, "u": 1}, "b": {"value": 0, "u": 1}})");
    const BudgetResult result = evaluate_budget(job, 1);
    EXPECT_FALSE(has_result_of_trials(result));
    EXPECT_EQ(reported_covariance(job, result), budget_covariance(result));
}

// y1 = x² and y2 = x² + 0.01 z: u = √2, r = 0.99998; of the derivatives at 0 they have nothing in common.
TEST(ReportedCovariance, IsThatOfTheTrialsWhereTheLawIsRefuted) {
    const Eigen::MatrixXd V = reported(
        R"("model": ["y1 = x^2", "y2 = x^2 + 0.01*z"], "inputs": {"x": {"value": 0, "u": 1}, "z": {"value": 0, "u": 1}},
           "outputs": {"y1": {}, "y2": {}})");
    ASSERT_EQ(V.rows(), 2);
    EXPECT_NEAR(V(0, 0), 2.0, 0.05);
    EXPECT_NEAR(V(0, 1) / std::sqrt(V(0, 0) * V(1, 1)), 0.999975, 1e-5);
}

// (x₁ + c)² and (x₂ + c)² at 0: a correlation of r² for x + c with r = 1/(1 + u²), u = 0.5.
TEST(ReportedCovariance, DrawsPointsTogether) {
    const Eigen::MatrixXd V = reported(
        R"("model": ["y = (x+c)^2"], "inputs": {"x": {"value": 0, "u": 0.5}, "c": {"value": 0, "u": 1}},
           "outputs": {"y": {}}, "points": [{"x": 0}, {"x": 0}])");
    ASSERT_EQ(V.rows(), 2);
    EXPECT_NEAR(V(0, 1) / std::sqrt(V(0, 0) * V(1, 1)), 0.64, 0.02);
    EXPECT_NEAR(std::sqrt(V(0, 0)), std::sqrt(2.0) * 1.25, 0.03);
}

TEST(ReportedCovariance, IsNoneWithoutAVariance) {
    const engine::BudgetJob job = engine::test::read_budget(
        R"("model": ["y = a", "z = b^2", "w = a + b"], "inputs": {"a": {"value": 0, "u": 1, "nu": 1}, "b": {"value": 0, "u": 1}},
           "outputs": {"y": {}, "z": {}, "w": {}}, "coverage": "monte_carlo", "monte_carlo": {"trials": 20000})");
    BudgetResult result = evaluate_budget(job, 1);
    const Eigen::MatrixXd V = reported_covariance(job, result);
    ASSERT_EQ(V.rows(), 3);
    EXPECT_TRUE(std::isnan(V(0, 0)));
    EXPECT_TRUE(std::isnan(V(2, 2)));
    EXPECT_NEAR(V(1, 1), 2.0, 0.1);
    result.notes.clear();
    note_covariance(job, V, result);
    ASSERT_EQ(result.notes.size(), 1U);
    EXPECT_EQ(result.notes.front().code, "GC-BUDGET-0042");
}

}  // namespace
}  // namespace gumcert::app
