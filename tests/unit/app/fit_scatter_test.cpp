#include "app/fit_scatter.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "app/budget_covariance.h"
#include "app/budget_findings.h"
#include "app/budget_record.h"
#include "app/evaluate_budget.h"
#include "tests/unit/engine/job/budget_campaign.h"

namespace gumcert::app {
namespace {

using testing::HasSubstr;

/// A straight line V = a + b x, and a result of it.
std::string line(const std::string& y, const std::string& data, const std::string& more = "") {
    return R"("model": ["z = a + b*q"], "inputs": {"q": {"value": 2, "u": 0.000001}}, "fits": {"f": {
        "equation": "V = a + b*x", "parameters": {"a": {}, "b": {}}, )" +
           more + R"("data": {"x": [0, 1, 2, 3, 4], "V": )" + y + data + "}}}";
}

const std::string k_perfect = "[1, 3, 5, 7, 9]";
const std::string k_nearly = "[1.0001, 3, 5.0001, 7, 9.0001]";

bool has_note(const BudgetResult& result, const std::string& code) {
    for (const gum::Diagnostic& note : result.notes) {
        if (note.code == code) {
            return true;
        }
    }
    return false;
}

TEST(FitScatter, ResidualsFarTooSmallDoNotLowerTheStatedUncertainties) {
    for (const std::string& y : {k_perfect, k_nearly}) {
        const engine::BudgetJob asked =
            engine::test::read_budget(line(y, R"(, "u_V": 0.1)", R"("scale_by_residuals": true, )"));
        const BudgetResult scaled = evaluate_budget(asked, 1);
        const BudgetResult stated = evaluate_budget(engine::test::read_budget(line(y, R"(, "u_V": 0.1)")), 1);
        EXPECT_EQ(scaled.fits[0].covariance, stated.fits[0].covariance) << y;
        EXPECT_FALSE(scaled.fits[0].covariance_scaled);
        EXPECT_EQ(scaled.points[0].outputs[0].expanded_uncertainty, stated.points[0].outputs[0].expanded_uncertainty);
        EXPECT_GT(*scaled.points[0].outputs[0].expanded_uncertainty, 0.05);
        EXPECT_TRUE(has_note(scaled, "GC-BUDGET-0035"));
        EXPECT_FALSE(has_note(stated, "GC-BUDGET-0035"));
        EXPECT_FALSE(has_note(scaled, "GC-BUDGET-0028")) << "what was fitted is not exact by definition";
        const reports::EvaluationRecord record = budget_record(asked, scaled, {}, budget_covariance(scaled), "");
        EXPECT_EQ(record.fits.at(0).consistency, "overstated");
    }
}

TEST(FitScatter, ResidualsThatChanceExplainsStillScale) {
    const BudgetResult result =
        evaluate_budget(engine::test::read_budget(
                            line("[1, 3.1, 4.9, 7.2, 8.9]", R"(, "u_V": 0.2)", R"("scale_by_residuals": true, )")),
                        1);
    EXPECT_TRUE(result.fits[0].covariance_scaled);
    EXPECT_FALSE(has_note(result, "GC-BUDGET-0035"));
}

/// The cure that the message names is followed.
TEST(FitScatter, ResidualsOfZeroAreNoUncertainty) {
    const auto warns = [](const std::string& keys) {
        return has_note(evaluate_budget(engine::test::read_budget(keys), 1), "GC-BUDGET-0036");
    };
    EXPECT_TRUE(warns(line(k_perfect, "")));
    EXPECT_TRUE(warns(line("[0.1, 0.3, 0.5, 0.7, 0.9]", ""))) << "rounding only";
    EXPECT_FALSE(warns(line(k_perfect, R"(, "u_V": 0.01)")));
    EXPECT_FALSE(warns(line(k_nearly, "")));
    const BudgetResult perfect = evaluate_budget(engine::test::read_budget(line(k_perfect, "")), 1);
    const auto note = std::find_if(perfect.notes.begin(), perfect.notes.end(),
                                   [](const gum::Diagnostic& n) { return n.code == "GC-BUDGET-0036"; });
    ASSERT_NE(note, perfect.notes.end());
    EXPECT_THAT(note->action, HasSubstr("\"u_V\""));
    reports::EvaluationRecord record;
    record.diagnostics = {*note};
    ASSERT_EQ(budget_findings(record).size(), 1U);
    EXPECT_EQ(budget_findings(record).front().id, "F03");
    EXPECT_EQ(budget_findings(record).front().severity, certificate::FindingSeverity::critical);
}

/// The cures of the warning: uncertainties that the data have, or none.
TEST(FitScatter, TheCuresOfKeptUncertaintiesHold) {
    const BudgetResult lower = evaluate_budget(
        engine::test::read_budget(line(k_nearly, R"(, "u_V": 0.0001)", R"("scale_by_residuals": true, )")), 1);
    EXPECT_FALSE(has_note(lower, "GC-BUDGET-0035"));
    const BudgetResult none = evaluate_budget(engine::test::read_budget(line(k_nearly, "")), 1);
    EXPECT_FALSE(has_note(none, "GC-BUDGET-0035"));
    EXPECT_TRUE(none.fits[0].covariance_scaled);
}

}  // namespace
}  // namespace gumcert::app
