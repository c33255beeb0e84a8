#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::found_by;
using test::subject_with;
using testing::HasSubstr;

AuditedBudget budget_with_capability(double capability, bool floor_applied) {
    AuditedBudget budget = test::sound_budget();
    budget.capability = capability;
    budget.floor_applied = floor_applied;
    return budget;
}

TEST(ScopeRules, X01_raises_a_U_that_is_below_the_capability) {
    const AuditReport report = audit(subject_with({budget_with_capability(0.40, false)}), scope_rules());
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [](const AuditFinding& finding) { return finding.rule == "X01"; });
    ASSERT_NE(found, report.findings.end());
    EXPECT_EQ(found->what, "U = 0.31 µm is below the capability 0.4 µm");
    ASSERT_TRUE(found->effect);
    EXPECT_EQ(found->effect->alone.U, 0.40);
    EXPECT_EQ(found->severity, FindingSeverity::critical);  // U understated by more than 10 %
    EXPECT_EQ(found_by(scope_rules(), "X01", subject_with({budget_with_capability(0.31, false)})), "");
    EXPECT_EQ(found_by(scope_rules(), "X01", subject_with({budget_with_capability(0.25, false)})), "");
}

TEST(ScopeRules, X01_is_critical_where_the_floor_counts_as_applied) {
    const AuditReport report = audit(subject_with({budget_with_capability(0.32, true)}), scope_rules());
    ASSERT_FALSE(report.findings.empty());
    EXPECT_EQ(report.findings[0].rule, "X01");
    EXPECT_EQ(report.findings[0].severity, FindingSeverity::critical);
}

TEST(ScopeRules, X03_and_X07_tell_a_copied_capability_from_a_floor) {
    // The rows give 0.309: a capability of 0.31 is the floor, and one of 0.30 that is stated everywhere is a copy.
    AuditedBudget copied = budget_with_capability(0.30, true);
    copied.claims.U = read_number("0.30", "");
    EXPECT_THAT(found_by(scope_rules(), "X03", subject_with({copied, copied})), HasSubstr("at all 2 points"));
    EXPECT_EQ(found_by(scope_rules(), "X07", subject_with({copied, copied})), "");
    const AuditedBudget floor = budget_with_capability(0.31, true);
    EXPECT_EQ(found_by(scope_rules(), "X03", subject_with({floor, floor})), "");
    const auto findings = test::findings_of(scope_rules(), "X07", subject_with({floor, floor}));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].severity, FindingSeverity::information);
    EXPECT_THAT(findings[0].evidence[0].english(), HasSubstr("k·u_c/CMC = 0.997"));
    EXPECT_EQ(found_by(scope_rules(), "X03", subject_with({copied})), "");  // one point shows nothing
    // A U that is stated below the capability is not hidden by it: X01 and X07 never stand together.
    for (const char* const U : {"0.25", "0.30", "0.31", "0.32"}) {
        AuditedBudget stated = floor;
        stated.claims.U = read_number(U, "");
        const bool below = !found_by(scope_rules(), "X01", subject_with({stated})).empty();
        EXPECT_NE(below, !found_by(scope_rules(), "X07", subject_with({stated})).empty()) << U;
    }
}

TEST(ScopeRules, X08_asks_where_a_bare_capability_comes_from) {
    AuditSubject subject = test::subject_with_certificate({budget_with_capability(0.2, true)});
    EXPECT_THAT(found_by(scope_rules(), "X08", subject), HasSubstr("without the line of the scope"));
    subject.certificate->data.accreditation.emplace().scope.emplace_back();
    EXPECT_EQ(found_by(scope_rules(), "X08", subject), "");
}

}  // namespace
}  // namespace gumcert::audit
