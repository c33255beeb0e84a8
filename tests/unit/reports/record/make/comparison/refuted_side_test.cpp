#include "reports/record/make/comparison/refuted_side.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "reports/record/make/comparison/evaluate_comparison.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/comparison_campaign.h"

namespace gumcert::reports {
namespace {

using certificate::FindingSeverity;
using testing::HasSubstr;

TEST(RefutedSide, EveryVerdictOfAgreementIsTakenBack) {
    for (const char* verdict : {"validated", "agreement_reference_limited", "agreement_few_points",
                                "uncertainty_not_confirmed", "uncertainty_too_large", "reference_not_better",
                                "correlation_unknown", "points_above_1", "disagreement", ""}) {
        for (const FindingSeverity severity : {FindingSeverity::information, FindingSeverity::minor,
                                               FindingSeverity::major, FindingSeverity::critical}) {
            Comparison comparison;
            comparison.summary.resize(2);
            comparison.summary.back().verdict = verdict;
            certificate::Finding finding;
            finding.id = "G01";
            finding.severity = severity;
            finding.where = "adjustment";
            finding.what = "the residuals refute the stated uncertainties";
            withhold_agreement(refuted_by({finding}, "tracer", "tracer/job.json"), comparison);
            const bool refutes = severity == FindingSeverity::major || severity == FindingSeverity::critical;
            const std::string kept = verdict;
            EXPECT_EQ(comparison.summary.back().verdict,
                      refutes && !kept.empty() && kept != "disagreement" ? "side_refuted" : kept);
            EXPECT_EQ(comparison.summary.front().verdict, "");
            ASSERT_EQ(comparison.refuted.size(), refutes ? 1U : 0U);
            ASSERT_EQ(comparison.remarks.size(), refutes ? 1U : 0U);
            if (refutes) {
                EXPECT_EQ(comparison.refuted.front().side, "tracer");
                EXPECT_THAT(comparison.remarks.front(),
                            HasSubstr("tracer contradicts what it states: adjustment: the"));
                EXPECT_THAT(comparison.remarks.front(), HasSubstr("[G01]"));
            }
        }
    }
}

/// The law is stated although the first derivatives vanish: the budget itself says so.
TEST(RefutedSide, ABudgetThatStatesTheLawAgainstItsEvidence) {
    const auto verdict_of = [](const std::string& coverage) {
        const jobs::ComparisonJob job = jobs::test::read_comparison(
            R"("unit": "mm", "correlation": "none", "lab": {"name": "m", "budget": "a.json"},
               "reference": {"name": "r", "points": [{"point": "1", "value": 99.9998, "u": 0.0001}]})",
            {{"a.json", jobs::test::budget_text(
                            R"j("model": ["h = L * cos(f)"], "inputs": {"L": {"value": 100, "u": 0.0002, "unit": "mm"},
                               "f": {"value": 0, "half_width": 0.5, "unit": "deg"}}, "outputs": {"h": {"unit": "mm"}})j" +
                            coverage)}});
        return evaluate_methods(job);
    };
    const Comparison forced = verdict_of(R"(, "coverage": "law_of_propagation")");
    EXPECT_EQ(forced.summary.front().verdict, "side_refuted");
    ASSERT_EQ(forced.refuted.size(), 1U);
    EXPECT_EQ(forced.refuted.front().message, "GC-BUDGET-0026");
    const Comparison reported = verdict_of("");
    EXPECT_NE(reported.summary.front().verdict, "side_refuted");
    EXPECT_TRUE(reported.refuted.empty());
}

/// The mean of the trials is in doubt: an agreement that rests on it is not stated.
TEST(RefutedSide, ABudgetWhoseTrialsChooseOtherwise) {
    const auto refuted_by = [](const std::string& second) {
        const jobs::ComparisonJob job = jobs::test::read_comparison(
            R"("unit": "mm", "correlation": "none", "lab": {"name": "m", "budget": "a.json"},
               "reference": {"name": "r", "points": [{"point": "1", "value": 100.5, "u": 0.1}]})",
            {{"a.json", jobs::test::budget_text(
                            R"j("model": ["h = max(a, b)"], "monte_carlo": {"trials": 20000}, "inputs": {
                               "a": {"value": 100.2, "u": 1, "unit": "mm"}, "b": {"value": )j" +
                            second + R"j(, "u": 1, "unit": "mm"}}, "outputs": {"h": {"unit": "mm"}})j")}});
        const Comparison comparison = evaluate_methods(job);
        EXPECT_EQ(comparison.summary.front().verdict == "side_refuted", !comparison.refuted.empty());
        return comparison.refuted.empty() ? std::string() : comparison.refuted.front().message;
    };
    EXPECT_EQ(refuted_by("99.8"), "GC-BUDGET-0044");
    EXPECT_EQ(refuted_by("90"), "");
}

}  // namespace
}  // namespace gumcert::reports
