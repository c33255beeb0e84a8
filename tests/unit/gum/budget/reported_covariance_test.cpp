#include "gum/budget/reported_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
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
    EXPECT_NEAR(V(0, 1) / std::sqrt(V(0, 0) * V(1, 1)), 0.999975, 5e-5);
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

BudgetOutput asked(const std::string& name, std::optional<CoverageChoice> coverage = {}) {
    return {.name = name, .unit = {}, .coverage_probability = {}, .coverage = coverage, .where = {}};
}

double least_eigenvalue(const Eigen::MatrixXd& covariance) {
    const Eigen::MatrixXd R = correlation_matrix(covariance);
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(R, Eigen::EigenvaluesOnly).eigenvalues()(0);
}

// n = a with u = 1 and ν readings, m = a + e: 1/√2 by JCGM 102:2011, 6.2, also where the trials of a scatter by √3, or
// have no variance at all, and whatever else is reported.
TEST(ReportedCovariance, OfTheLawDoesNotChangeWithAResultOfMonteCarlo) {
    for (const double nu : {2.0, 3.0}) {
        const std::vector<BudgetInput> inputs{input("a", state_uncertainty(1, 1, nu)),
                                              input("e", state_uncertainty(3, 1)), input("z", state_uncertainty(0, 1))};
        const Eigen::MatrixXd without = reported(test::budget({"n = a*1", "m = a + e"}, inputs));
        const Budget of = test::budget({"n = a*1", "m = a + e", "q = z^2"}, inputs);
        BudgetResult result = evaluate_budget(of, 1);
        ASSERT_TRUE(result.points[0].outputs[2].by_monte_carlo);
        ASSERT_FALSE(result.points[0].outputs[1].by_monte_carlo);
        const Eigen::MatrixXd with = reported_covariance(of, result);
        EXPECT_EQ(with.topLeftCorner(2, 2), without) << nu;
        EXPECT_NEAR(with(0, 1) / std::sqrt(with(0, 0) * with(1, 1)), std::sqrt(0.5), 1e-15) << nu;
        EXPECT_EQ(with(0, 2), 0.0) << nu;
        EXPECT_EQ(with(1, 2), 0.0) << nu;
        result.notes.clear();
        note_covariance(of, with, result);
        EXPECT_TRUE(result.notes.empty()) << nu;
    }
}

// e of 3 ± 1: cov(e, e²) = 6, and a + e has that of e with e².
TEST(ReportedCovariance, BetweenLawAndTrialsGoesByWhatTheyShare) {
    const Eigen::MatrixXd V = reported(test::budget(
        {"m = a + e", "q = e^2"}, {input("a", state_uncertainty(1, 1, 3)), input("e", state_uncertainty(3, 1))}));
    EXPECT_NEAR(V(0, 1), 6.0, 0.03);
    EXPECT_NEAR(V(1, 1), 38.0, 0.2);
}

TEST(ReportedCovariance, OfPointsWithNothingInCommonIsExactlyZero) {
    Budget of = test::budget({"y = x + s*z^2"}, {input("x", state_uncertainty(0, 1)), input("s", state_constant(0)),
                                                 input("z", state_uncertainty(0, 1))});
    of.points = {test::point(of, "1", {{"x", state_uncertainty(1, 1)}}),
                 test::point(of, "2", {{"x", state_uncertainty(2, 1)}}),
                 test::point(of, "3", {{"x", state_uncertainty(3, 1)}, {"s", state_constant(2)}})};
    const BudgetResult result = evaluate_budget(of, 1);
    ASSERT_TRUE(result.points[2].outputs[0].by_monte_carlo);
    const Eigen::MatrixXd V = reported_covariance(of, result);
    EXPECT_EQ(V(0, 1), 0.0);
    EXPECT_EQ(V(0, 2), 0.0);
    EXPECT_EQ(V(1, 2), 0.0);
}

// The law of the covariance of mixed results, over generated budgets: positive semi-definite; the u that is reported on
// the diagonal; of two results of the law what they have without the others, to the last bit; of linear models that of
// the law although trials are reported; exactly 0 without a common input.
TEST(ReportedCovariance, OfGeneratedMixes) {
    unsigned state = 7;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 16U) / 65536.0 * 4.0 - 2.0;
    };
    for (int round = 0; round < 6; ++round) {
        std::vector<BudgetInput> inputs{input("a", state_uncertainty(1, 1, 3)), input("b", state_uncertainty(2, 0.5)),
                                        input("c", test::rectangular(1, 1)),    input("d", state_uncertainty(0, 1)),
                                        input("f", state_uncertainty(1, 0.2)),  input("g", state_uncertainty(1, 0.2))};
        const auto term = [&](const std::string& name) { return test::digits(next()) + "*" + name; };
        std::vector<std::string> by_law{"l1 = " + term("a") + " + " + term("b"),
                                        "l2 = " + term("a") + " + " + term("c") + " + " + term("d"), "l3 = f + g"};
        std::vector<std::string> all = by_law;
        // Nearly a alone, whose trials scatter by √3: the coefficients of the trials, put beside those of the law, have
        // no positive semi-definite matrix.
        all.push_back("t1 = a + 1e-3*d^2");
        all.push_back("t2 = " + term("b") + "*b + " + term("c") + "*d");
        all.push_back("t3 = " + term("d") + " + " + term("c"));
        all.push_back("t4 = 2*f - g");
        Budget of = test::budget(by_law, inputs);
        of.outputs = {asked("l1"), asked("l2"), asked("l3")};
        for (BudgetOutput& output : of.outputs) {
            output.coverage = CoverageChoice::law_of_propagation;
        }
        const Eigen::MatrixXd alone = reported(of);
        const std::vector<BudgetOutput> outputs = of.outputs;
        of = test::budget(all, inputs);
        of.outputs = outputs;
        for (const char* name : {"t1", "t2", "t3", "t4"}) {
            of.outputs.push_back(asked(name, CoverageChoice::monte_carlo));
        }
        of.monte_carlo.emplace().trials = 20000;
        const BudgetResult result = evaluate_budget(of, 1);
        const Eigen::MatrixXd V = reported_covariance(of, result);
        ASSERT_EQ(V.rows(), 7) << round;
        EXPECT_EQ(V.topLeftCorner(3, 3), alone) << round;
        EXPECT_EQ(V, V.transpose()) << round;
        EXPECT_GT(least_eigenvalue(V), -1e-12) << round;
        for (Eigen::Index i = 3; i < 7; ++i) {
            const double u = result.points[0].outputs[static_cast<std::size_t>(i)].monte_carlo->standard_uncertainty;
            EXPECT_NEAR(V(i, i), u * u, 1e-12 * u * u) << round;
        }
        const auto r = [&](Eigen::Index i, Eigen::Index j) { return V(i, j) / std::sqrt(V(i, i) * V(j, j)); };
        // 2 f − g and f + g: (2 − 1)/√(5 · 2).
        EXPECT_NEAR(r(2, 6), 1.0 / std::sqrt(10.0), 1e-9) << round;
        for (const Eigen::Index i : {0, 1, 3, 4, 5}) {
            EXPECT_EQ(V(i, 2), 0.0) << round << ' ' << i;
            EXPECT_EQ(V(i, 6), 0.0) << round << ' ' << i;
        }
        // t1 is a as the law has it: with l1 the coefficient of a and l1.
        const Eigen::VectorXd c = result.points[0].propagation.jacobian.row(0);
        EXPECT_NEAR(r(0, 3), c(0) / std::hypot(c(0), 0.5 * c(1)), 0.01) << round;
    }
}

}  // namespace
}  // namespace gumcert::gum
