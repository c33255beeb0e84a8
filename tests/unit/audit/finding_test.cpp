#include "audit/finding.h"

#include <gtest/gtest.h>

namespace gumcert::audit {
namespace {

/// Puts a coverage factor into a budget, so that tests can tell corrections from each other.
Correction correction_to(double k) {
    return [k](AuditedBudget& budget) { budget.claims.k = {.value = k, .half_step = 0.0, .text = "", .place = ""}; };
}

double k_after(const Correction& correction) {
    AuditedBudget budget;
    correction(budget);
    return budget.claims.k ? budget.claims.k->value : 0.0;
}

TEST(CorrectionOf, IsTheSameForAllBudgetsThatAFindingTouches) {
    AuditFinding finding;
    finding.budgets = {1, 4};
    finding.correct = correction_to(2.0);
    for (const std::size_t budget : finding.budgets) {
        ASSERT_NE(correction_of(finding, budget), nullptr) << budget;
        EXPECT_EQ(k_after(*correction_of(finding, budget)), 2.0) << budget;
    }
    EXPECT_EQ(correction_of(finding, 0), nullptr);
    EXPECT_EQ(correction_of(finding, 2), nullptr);
}

TEST(CorrectionOf, ABudgetWithACorrectionOfItsOwnHasThat) {
    AuditFinding finding;
    finding.budgets = {1, 4};
    finding.correct = correction_to(2.0);
    finding.correct_others = {{4, correction_to(2.5)}};
    EXPECT_EQ(k_after(*correction_of(finding, 1)), 2.0);
    EXPECT_EQ(k_after(*correction_of(finding, 4)), 2.5);
}

TEST(CorrectionOf, NothingWhereNoCorrectionIsKnown) {
    AuditFinding finding;
    finding.budgets = {1, 4};
    EXPECT_EQ(correction_of(finding, 1), nullptr);
    finding.correct_others = {{4, correction_to(2.5)}};
    EXPECT_EQ(correction_of(finding, 1), nullptr);
    EXPECT_EQ(k_after(*correction_of(finding, 4)), 2.5);
}

}  // namespace
}  // namespace gumcert::audit
