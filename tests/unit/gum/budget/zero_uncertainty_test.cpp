#include "gum/budget/zero_uncertainty.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::input;

/// Codes of -0028 and -0029 that a budget gives, and what is reported: "GC-BUDGET-0029 none".
std::string said(const Budget& of) {
    const BudgetResult result = evaluate_budget(of, 1);
    std::string text;
    for (const Diagnostic& note : result.notes) {
        if (note.code == "GC-BUDGET-0028" || note.code == "GC-BUDGET-0029") {
            text += note.code + " ";
        }
    }
    const BudgetOutputResult& output = result.points[0].outputs[0];
    return text + (output.by_monte_carlo ? "trials" : output.expanded_uncertainty ? "U" : "none");
}

TEST(ZeroUncertainty, MonteCarloThatDoesNotVaryStatesNoUncertainty) {
    const auto by_trials = [](const std::string& model, std::vector<BudgetInput> inputs) {
        Budget of = test::budget({model}, std::move(inputs));
        of.coverage = CoverageChoice::monte_carlo;
        of.monte_carlo.emplace().trials = 10000;
        return said(of);
    };
    const BudgetInput x = input("x", state_uncertainty(5, 0.1));
    EXPECT_EQ(by_trials("y = x - x", {x}), "GC-BUDGET-0029 none");
    EXPECT_EQ(by_trials("y = x + 1 - x", {x}), "GC-BUDGET-0029 none");
    EXPECT_EQ(by_trials("y = min(x, 0)", {x}), "GC-BUDGET-0029 none");
    EXPECT_EQ(by_trials("y = c", {input("c", state_constant(5)), x}), "GC-BUDGET-0028 U");
    EXPECT_EQ(by_trials("y = (x - 5)^2", {x}), "trials");
}

/// A constant, two correlated inputs, and perhaps a fit with the parameters p and q.
Budget beside_others(const std::string& model, bool with_fit) {
    Budget of = test::budget({model}, {input("c", state_constant(1)), input("d", state_uncertainty(2, 0.1)),
                                       input("e", state_uncertainty(2, 0.1))});
    test::correlate(of, "d", "e", 0.5);
    if (with_fit) {
        of.fits = {test::line({0, 1, 2}, 0.1)};
    }
    return of;
}

TEST(ZeroUncertainty, WhatTheResultDoesNotDependOnIsNoMatter) {
    EXPECT_EQ(said(beside_others("y = c", false)), "GC-BUDGET-0028 U");
    EXPECT_EQ(said(beside_others("y = c", true)), "GC-BUDGET-0028 U");
    EXPECT_EQ(said(beside_others("y = d - d", false)), "GC-BUDGET-0029 none");
    EXPECT_EQ(said(beside_others("y = c + 0*a", true)), "GC-BUDGET-0029 none");
}

TEST(ZeroUncertainty, FollowsTheEquationsToWhatIsBehindThem) {
    const Budget through = [] {
        Budget of = test::budget({"y = h - h", "h = x + c"},
                                 {input("x", state_uncertainty(5, 0.1)), input("c", state_constant(1))});
        of.outputs = {{.name = "y", .unit = {}, .coverage_probability = {}, .coverage = {}, .where = {}}};
        return of;
    }();
    const BudgetResult result = evaluate_budget(through, 1);
    EXPECT_FALSE(is_exact_by_definition(through, result.points[0], "y"));
    EXPECT_EQ(said(through), "GC-BUDGET-0029 none");
}

// m a − b with r = ±1 and u(b) = |m| u(a): what rounding leaves of the difference is no uncertainty.
TEST(ZeroUncertainty, RoundingOfCorrelatedInputsThatCancelIsNone) {
    for (const double m : {3.0, 7.0, 1.1, -0.3, 1.0 / 3.0}) {
        for (const double u : {0.1, 0.7, 1e-9, 123.456}) {
            const std::string factor = test::digits(m);
            Budget of =
                test::budget({"y = (" + factor + ")*a - b"},
                             {input("a", state_uncertainty(2, u)), input("b", state_uncertainty(1, std::abs(m) * u))});
            test::correlate(of, "a", "b", m > 0.0 ? 1.0 : -1.0);
            EXPECT_EQ(said(of), "GC-BUDGET-0029 none") << factor << " " << u;
            // What does not cancel is stated, however small it is beside the parts.
            of.inputs[1] = input("b", state_uncertainty(1, std::abs(m) * u * 1.000001));
            EXPECT_EQ(said(of), "U") << factor << " " << u;
        }
    }
}

// r = ±1 as stated is exact: of m a − b the uncertainty |u(b) − |m| u(a)| is known as well as u(a) and u(b) are.
TEST(ZeroUncertainty, OfInputsThatAreOneQuantityIsAsSharpAsTheirOwn) {
    for (const double m : {3.0, -0.3, 1.0}) {
        for (const double u : {0.1, 1e-9, 123.456}) {
            for (const double more : {1e-6, 1e-8, 1e-9, 1e-12}) {
                Budget of = test::budget(
                    {"y = (" + test::digits(m) + ")*a - b + c"},
                    {input("a", state_uncertainty(2, u)),
                     input("b", state_uncertainty(1, std::abs(m) * u * (1.0 + more))), input("c", state_constant(0))});
                test::correlate(of, "a", "b", m > 0.0 ? 1.0 : -1.0);
                const double largest = std::abs(m) * u;
                const BudgetOutputResult by_law = evaluate_budget(of, 1).points[0].outputs[0];
                EXPECT_NEAR(by_law.standard_uncertainty, largest * more, 1e-15 * largest)
                    << m << " " << u << " " << more;
                EXPECT_TRUE(by_law.expanded_uncertainty);
                // Beside an input that both are correlated with to the same extent.
                of.inputs[2] = input("c", state_uncertainty(0, largest * more));
                test::correlate(of, "a", "c", 0.6);
                test::correlate(of, "b", "c", m > 0.0 ? 0.6 : -0.6);
                // m a − b is −more |m| u(a) times the deviate of a, with the sign of m: 1 + 1 − 2 · 0.6 of its square.
                EXPECT_NEAR(evaluate_budget(of, 1).points[0].outputs[0].standard_uncertainty,
                            largest * more * std::sqrt(m > 0.0 ? 0.8 : 3.2), 4e-15 * largest)
                    << m << " " << u << " " << more;
            }
        }
    }
}

// Trials draw what the law propagates, and results in common have the covariance of the same factor.
TEST(ZeroUncertainty, OfInputsThatAreOneQuantityHoldsInTrialsAndCovariances) {
    Budget of = test::budget({"y = a - b", "z = a + b"},
                             {input("a", state_uncertainty(0, 1.0)), input("b", state_uncertainty(0, 1.0 + 1e-9))});
    test::correlate(of, "a", "b", 1.0);
    of.coverage = CoverageChoice::monte_carlo;
    of.monte_carlo.emplace().trials = 20000;
    const BudgetResult result = evaluate_budget(of, 1);
    ASSERT_TRUE(result.points[0].outputs[0].monte_carlo);
    EXPECT_NEAR(result.points[0].outputs[0].monte_carlo->standard_uncertainty, 1e-9, 3e-11);
    EXPECT_NEAR(result.points[0].propagation.covariance(0, 1), -2e-9, 1e-15);
}

// A coefficient beside 1, and one of readings or of a covariance, say how far the difference is known: to the root of ε.
TEST(ZeroUncertainty, OfInputsThatAreNearlyOneQuantityIsNotCalledSharp) {
    Budget of = test::budget({"y = a - b"}, {input("a", state_uncertainty(2, 1)), input("b", state_uncertainty(1, 1))});
    of.correlations = {{.first = 0, .second = 1, .r = 1.0 - 1e-14}};
    EXPECT_EQ(said(of), "U");
    EXPECT_NEAR(evaluate_budget(of, 1).points[0].outputs[0].standard_uncertainty, std::sqrt(2e-14), 2e-9);
    of.inputs[1] = input("b", state_uncertainty(1, 1.0 + 1e-9));
    of.correlations = {{.first = 0, .second = 1, .r = 1.0, .is_computed = true}};
    EXPECT_EQ(said(of), "GC-BUDGET-0029 none");
}

}  // namespace
}  // namespace gumcert::gum
