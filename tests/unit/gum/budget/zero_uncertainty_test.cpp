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

}  // namespace
}  // namespace gumcert::gum
