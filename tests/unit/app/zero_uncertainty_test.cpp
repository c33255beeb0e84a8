#include "app/zero_uncertainty.h"

#include <gtest/gtest.h>

#include <string>

#include "app/evaluate_budget.h"
#include "tests/unit/engine/job/budget_campaign.h"

namespace gumcert::app {
namespace {

/// Codes of -0028 and -0029 that a job gives, and what is reported: "GC-BUDGET-0029 none".
std::string said(const std::string& keys) {
    const BudgetResult result = evaluate_budget(engine::test::read_budget(keys), 1);
    std::string text;
    for (const gum::Diagnostic& note : result.notes) {
        if (note.code == "GC-BUDGET-0028" || note.code == "GC-BUDGET-0029") {
            text += note.code + " ";
        }
    }
    const BudgetOutputResult& output = result.points[0].outputs[0];
    return text + (output.by_monte_carlo ? "trials" : output.expanded_uncertainty ? "U" : "none");
}

TEST(ZeroUncertainty, MonteCarloThatDoesNotVaryStatesNoUncertainty) {
    const std::string trials = R"(, "coverage": "monte_carlo", "monte_carlo": {"trials": 10000})";
    const std::string x = R"("inputs": {"x": {"value": 5, "u": 0.1}})";
    EXPECT_EQ(said(R"("model": ["y = x - x"], )" + x + trials), "GC-BUDGET-0029 none");
    EXPECT_EQ(said(R"("model": ["y = x + 1 - x"], )" + x + trials), "GC-BUDGET-0029 none");
    EXPECT_EQ(said(R"j("model": ["y = min(x, 0)"], )j" + x + trials), "GC-BUDGET-0029 none");
    EXPECT_EQ(
        said(R"("model": ["y = c"], "inputs": {"c": {"value": 5, "constant": true}, "x": {"value": 5, "u": 0.1}})" +
             trials),
        "GC-BUDGET-0028 U");
    EXPECT_EQ(said(R"("model": ["y = (x - 5)^2"], )" + x + trials), "trials");
}

TEST(ZeroUncertainty, WhatTheResultDoesNotDependOnIsNoMatter) {
    EXPECT_EQ(said(R"("model": ["y = a"], "inputs": {"a": {"value": 1, "constant": true},
        "b": {"value": 2, "u": 0.1}, "c": {"value": 2, "u": 0.1}}, "correlations": [["b", "c", 0.5]])"),
              "GC-BUDGET-0028 U");
    const std::string fit = R"(, "fits": {"f": {"equation": "V = p + q*x", "parameters": {"p": {}, "q": {}},
        "data": {"x": [0, 1, 2], "V": [0, 1, 2], "u_V": 0.1}}})";
    EXPECT_EQ(said(R"("model": ["y = a"], "inputs": {"a": {"value": 1, "constant": true}})" + fit), "GC-BUDGET-0028 U");
    EXPECT_EQ(said(R"("model": ["y = b - b"], "inputs": {"a": {"value": 1, "constant": true},
        "b": {"value": 2, "u": 0.1}, "c": {"value": 2, "u": 0.1}}, "correlations": [["b", "c", 0.5]])"),
              "GC-BUDGET-0029 none");
    EXPECT_EQ(said(R"("model": ["y = a + 0*p"], "inputs": {"a": {"value": 1, "constant": true}})" + fit),
              "GC-BUDGET-0029 none");
}

}  // namespace
}  // namespace gumcert::app
