#include "audit/stated_outcome.h"

#include <gtest/gtest.h>

#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

TEST(StatedOutcome, takes_claims_first_and_the_rows_else) {
    AuditedBudget budget = test::sound_budget();
    EXPECT_EQ(stated_U(budget), 0.31);
    EXPECT_EQ(stated_u_c(budget), 0.155);
    EXPECT_EQ(stated_value(budget), 10.0);
    budget.claims = {};
    EXPECT_NEAR(*stated_U(budget), 0.30919, 1e-5);
    EXPECT_NEAR(*stated_u_c(budget), 0.154596, 1e-6);
    EXPECT_EQ(stated_value(budget), 10.0);
    budget.rows.clear();
    EXPECT_FALSE(stated_U(budget));
    EXPECT_FALSE(stated_u_c(budget));
    EXPECT_FALSE(outcome_or_none(budget));
}

TEST(StatedOutcome, reads_verdicts_of_both_languages) {
    for (const char* verdict :
         {"pass", "PASS", "ok", "i.O.", "bestanden", "conforming", "in tolerance", "conditional_pass"}) {
        EXPECT_EQ(says_conforming(verdict), true) << verdict;
    }
    for (const char* verdict :
         {"fail", "n.i.O.", "nicht bestanden", "not conforming", "out of tolerance", "conditional_fail"}) {
        EXPECT_EQ(says_conforming(verdict), false) << verdict;
    }
    EXPECT_FALSE(says_conforming("undetermined"));
    EXPECT_FALSE(says_conforming(""));
}

TEST(StatedOutcome, makes_one_finding_of_several_budgets) {
    AuditedBudget empty;
    const AuditSubject subject = test::subject_with({test::sound_budget(), empty, test::sound_budget()});
    const std::vector<std::size_t> positions = budgets_where(subject, [](const AuditedBudget&) { return true; });
    EXPECT_EQ(positions, (std::vector<std::size_t>{0, 2}));
    EXPECT_EQ(finding_of_all(subject, positions, "x")->where, "length and 1 more");
    EXPECT_FALSE(finding_of_all(subject, {}, "x"));
    AuditedRow row;
    row.quantity = "a";
    row.source = "c";
    EXPECT_EQ(words_of_row(row), "a; ; c");
}

}  // namespace
}  // namespace gumcert::audit
