#include "audit/audit.h"

#include <gtest/gtest.h>

#include <string>

#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::row;
using test::subject_of;

/// Finds the first row of every budget too small by a half.
void first_row_is_half(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        AuditFinding finding;
        finding.where = "row 1";
        finding.what = "half of it";
        finding.budgets = {b};
        finding.correct = [](AuditedBudget& budget) { budget.rows[0].used_u *= 2.0; };
        findings.add(std::move(finding));
    }
}
void one_is_missing(const AuditSubject&, FindingCollector& findings) {
    AuditFinding finding;
    finding.what = "something is missing";
    finding.budgets = {0};
    finding.contribution_missing = true;
    findings.add(std::move(finding));
}

const Rule k_half{
    .id = "Z01", .title = "Half", .clause = {.text = "none"}, .needs = {Need::rows}, .examine = first_row_is_half};
const Rule k_missing{.id = "Z02",
                     .title = "Missing",
                     .clause = {.text = "none"},
                     .policy = SeverityPolicy::fixed,
                     .severity = FindingSeverity::minor,
                     .examine = one_is_missing};

TEST(Audit, EvaluatesFindingsWhereTheyMatterMost) {
    const AuditedBudget small = budget_of({row("a", 0.01), row("b", 1.0)});
    const AuditedBudget large = budget_of({row("a", 1.0), row("b", 0.01)});
    const AuditReport report = audit(subject_of({small, large}), std::vector<Rule>{k_half, k_missing});
    ASSERT_EQ(report.results.size(), 2U);
    ASSERT_EQ(report.findings.size(), 2U);
    // One finding of both budgets, graded where it is the largest.
    const AuditFinding& half = report.findings[0];
    EXPECT_EQ(half.rule, "Z01");
    EXPECT_EQ(half.budgets.size(), 2U);
    ASSERT_TRUE(half.effect);
    EXPECT_EQ(half.effect->budget, 1U);
    EXPECT_EQ(half.severity, FindingSeverity::critical);
    EXPECT_TRUE(report.has_critical());
    EXPECT_NEAR(report.results[1].audited.U, 2.0 * report.results[1].claimed.U, 1e-3);
    EXPECT_EQ(report.findings[1].severity, FindingSeverity::minor);
    ASSERT_TRUE(report.findings[1].missing_term);
    EXPECT_GT(report.findings[1].missing_term->u_for_digit, 0.0);
}

TEST(Audit, TakesClaimsAsTheyAreStated) {
    AuditedBudget budget = budget_of({row("a", 0.5)});
    budget.claims.U = test::printed("1.3");
    budget.claims.k = test::printed("2.6");
    const AuditReport report = audit(subject_of(budget), {});
    EXPECT_EQ(report.results[0].claimed.printed_U, "1.3");
    EXPECT_EQ(report.results[0].claimed.k, 2.6);
    EXPECT_EQ(report.results[0].recomputed.printed_U, "1.0");
}

TEST(Audit, SaysWhatItCouldNotDo) {
    const Rule needs_limits{
        .id = "Z03", .title = "", .clause = {.text = ""}, .needs = {Need::limits}, .examine = one_is_missing};
    const AuditReport report = audit(subject_of(budget_of({row("a", 0.0)})), std::vector<Rule>{needs_limits});
    ASSERT_EQ(report.not_checked.size(), 1U);
    EXPECT_EQ(report.not_checked[0].because, "no limits of a specification are stated");
    EXPECT_TRUE(report.results.empty());
    ASSERT_EQ(report.subject.not_read.size(), 1U);
    EXPECT_NE(report.subject.not_read[0].english().find("u_c"), std::string::npos);
}

TEST(Audit, KnowsWhatSomebodyAccepts) {
    AuditSubject subject = subject_of({budget_of({row("a", 1.0), row("b", 0.01)})});
    subject.waivers = {{.finding = "Z01", .where = "row 1", .by = "A. N.", .date = "2026-03-04", .reason = "known"},
                       {.finding = "Z09", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "gone"}};
    const std::vector<Rule> rules{k_half, k_missing};
    const AuditReport report = audit(subject, rules);
    const AuditFinding& half = report.findings[0];
    ASSERT_EQ(half.severity, FindingSeverity::critical);
    EXPECT_EQ(waiver_of(half, report.subject.waivers), &report.subject.waivers[0]);
    EXPECT_EQ(waiver_of(report.findings[1], report.subject.waivers), nullptr);
    EXPECT_FALSE(is_open_critical(half, report.subject.waivers)) << "critical, and accepted";
    EXPECT_TRUE(is_open_critical(half, {}));
    EXPECT_FALSE(is_open_critical(report.findings[1], {})) << "open, and minor";
    EXPECT_FALSE(report.has_critical());
    ASSERT_EQ(report.subject.not_read.size(), 1U);
    EXPECT_EQ(report.subject.not_read[0], "the waiver of Z09 fits no finding");
    EXPECT_EQ(audit(report.subject, rules).subject.not_read.size(), 1U) << "said once";

    // The same waivers behind the audit: the same report.
    AuditSubject bare = subject;
    bare.waivers.clear();
    AuditReport accepted = audit(bare, rules);
    EXPECT_TRUE(accepted.has_critical());
    accept_findings(accepted, subject.waivers, rules);
    EXPECT_FALSE(accepted.has_critical());
    EXPECT_EQ(accepted.subject.waivers.size(), 1U) << "what fits no finding accepts nothing";
    EXPECT_EQ(accepted.subject.waivers.size(), report.subject.waivers.size());
    EXPECT_EQ(accepted.subject.not_read, report.subject.not_read);

    // What the gates of its certificate found is accepted there: the waiver fits.
    AuditSubject certified = subject;
    certified.certificate.emplace();
    certificate::Finding of_gates;
    of_gates.id = "Z09";
    certified.certificate->findings.push_back(of_gates);
    EXPECT_TRUE(audit(certified, rules).subject.not_read.empty());

    AuditFinding of_gate = half;
    of_gate.of_gate = true;
    EXPECT_EQ(waiver_of(of_gate, report.subject.waivers), nullptr);
    subject.waivers[0].where = "row 2";
    EXPECT_TRUE(audit(subject, rules).has_critical());
}

TEST(Audit, AuditsWhatNoDecisionRestsOn) {
    AuditedBudget budget = budget_of({row("a", 0.3), row("b", 0.4)});
    budget.value = 9.0;
    budget.limits = {.lower = 0.0, .upper = 10.0};
    budget.rule = gum::DecisionRule::simple_acceptance_with_ratio;  // its least ratio is not stated
    budget.claims.verdict = "pass";
    const AuditReport report = audit(subject_of(budget), std::vector<Rule>{k_half, k_missing});
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.results[0].claimed.verdict, "pass");
    EXPECT_EQ(report.results[0].audited.verdict, k_no_decision);
    EXPECT_GT(report.results[0].audited.U, 1.1 * report.results[0].claimed.U);
    EXPECT_TRUE(report.has_critical());
    ASSERT_EQ(report.subject.not_read.size(), 2U);
    EXPECT_NE(report.subject.not_read[0].english().find("cannot be told"), std::string::npos);
    EXPECT_NE(report.subject.not_read[1].english().find("test_uncertainty_ratio"), std::string::npos);
    ASSERT_TRUE(report.findings.back().missing_term);
    EXPECT_FALSE(report.findings.back().missing_term->u_for_verdict);
    EXPECT_FALSE(report.findings.back().missing_term->is_decided);
}

}  // namespace
}  // namespace gumcert::audit
