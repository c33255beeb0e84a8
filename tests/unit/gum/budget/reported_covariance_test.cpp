#include "gum/budget/reported_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gum/budget/budget_covariance.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::input;

Eigen::MatrixXd reported(const Budget& of) {
    return reported_covariance(of, evaluate_budget(of, 1));
}

TEST(ReportedCovariance, IsThatOfTheLawWhereItHolds) {
    const Budget of = test::budget({"y = a + b", "z = a"},
                                   {input("a", state_uncertainty(0, 1)), input("b", state_uncertainty(0, 1))});
    const BudgetResult result = evaluate_budget(of, 1);
    EXPECT_FALSE(has_result_of_trials(result));
    EXPECT_EQ(reported_covariance(of, result), budget_covariance(result));
}

// y1 = x² and y2 = x² + 0.01 z: u = √2, r = 0.99998; of the derivatives at 0 they have nothing in common.
TEST(ReportedCovariance, IsThatOfTheTrialsWhereTheLawIsRefuted) {
    const Eigen::MatrixXd V = reported(test::budget(
        {"y1 = x^2", "y2 = x^2 + 0.01*z"}, {input("x", state_uncertainty(0, 1)), input("z", state_uncertainty(0, 1))}));
    ASSERT_EQ(V.rows(), 2);
    EXPECT_NEAR(V(0, 0), 2.0, 0.05);
    EXPECT_NEAR(V(0, 1) / std::sqrt(V(0, 0) * V(1, 1)), 0.999975, 1e-5);
}

// (x₁ + c)² and (x₂ + c)² at 0: a correlation of r² for x + c with r = 1/(1 + u²), u = 0.5.
TEST(ReportedCovariance, DrawsPointsTogether) {
    Budget of =
        test::budget({"y = (x+c)^2"}, {input("x", state_uncertainty(0, 0.5)), input("c", state_uncertainty(0, 1))});
    of.points = {test::point(of, "1", {{"x", state_uncertainty(0, 0.5)}}),
                 test::point(of, "2", {{"x", state_uncertainty(0, 0.5)}})};
    const Eigen::MatrixXd V = reported(of);
    ASSERT_EQ(V.rows(), 2);
    EXPECT_NEAR(V(0, 1) / std::sqrt(V(0, 0) * V(1, 1)), 0.64, 0.02);
    EXPECT_NEAR(std::sqrt(V(0, 0)), std::sqrt(2.0) * 1.25, 0.03);
}

TEST(ReportedCovariance, IsNoneWithoutAVariance) {
    Budget of = test::budget({"y = a", "z = b^2", "w = a + b"},
                             {input("a", state_uncertainty(0, 1, 1)), input("b", state_uncertainty(0, 1))});
    for (const char* name : {"y", "z", "w"}) {
        of.outputs.push_back({.name = name, .unit = {}, .coverage_probability = {}, .coverage = {}, .where = {}});
    }
    of.coverage = CoverageChoice::monte_carlo;
    of.monte_carlo.emplace().trials = 20000;
    BudgetResult result = evaluate_budget(of, 1);
    const Eigen::MatrixXd V = reported_covariance(of, result);
    ASSERT_EQ(V.rows(), 3);
    EXPECT_TRUE(std::isnan(V(0, 0)));
    EXPECT_TRUE(std::isnan(V(2, 2)));
    EXPECT_NEAR(V(1, 1), 2.0, 0.1);
    result.notes.clear();
    note_covariance(of, V, result);
    ASSERT_EQ(result.notes.size(), 1U);
    EXPECT_EQ(result.notes.front().code, "GC-BUDGET-0042");
}

}  // namespace
}  // namespace gumcert::gum
