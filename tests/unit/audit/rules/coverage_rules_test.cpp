// For each rule of combination and coverage: a budget that fires, and one that must not.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "audit/claims.h"
#include "gum/coverage.h"
#include "tests/support/audit_rules.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::findings_of;
using test::printed;
using test::row;
using test::subject_of;

/// u_c = 0.5 µm, k = 2, U = 1.0 µm.
AuditedBudget fixed_budget() {
    AuditedBudget budget = budget_of({row("a", 0.3), row("b", 0.4)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.claims.u_c = printed("0.50");
    budget.claims.k = printed("2");
    budget.claims.U = printed("1.0");
    return budget;
}

TEST(CoverageRules, K01NeverAccusesRounding) {
    AuditedBudget budget = fixed_budget();
    EXPECT_TRUE(findings_of("K01", subject_of(budget)).empty());
    budget.claims.u_c = printed("0.62");
    budget.claims.U = printed("1.24");
    note_unexplained(budget);
    std::vector<AuditFinding> findings = findings_of("K01", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->claimed.U, 1.24, 1e-12);
    EXPECT_NEAR(findings[0].effect->alone.U, 1.0, 1e-12);
    EXPECT_EQ(findings[0].severity, FindingSeverity::major);  // overstated
    // Both wrong: two findings, each with its own part.
    budget.claims.u_c = printed("0.41");
    budget.claims.U = printed("0.74");
    note_unexplained(budget);
    findings = findings_of("K01", subject_of(budget));
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].severity, FindingSeverity::critical);
    EXPECT_NEAR(findings[0].effect->audited.U, 1.0, 1e-12);
}

TEST(CoverageRules, K02WantsTheTFactor) {
    AuditedBudget budget = budget_of({row("a", 0.3, 1.0, 5.0), row("b", 0.1)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    const std::vector<AuditFinding> findings = findings_of("K02", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    const double nu = findings[0].effect->claimed.nu_eff;
    EXPECT_NEAR(findings[0].effect->alone.k, gum::coverage_factor(0.9545, nu), 1e-12);
    budget.rows[0].used_nu = 30.0;
    EXPECT_TRUE(findings_of("K02", subject_of(budget)).empty());
    budget.rows[0].used_nu = 5.0;
    budget.coverage.kind = CoverageRule::Kind::student_t;
    EXPECT_TRUE(findings_of("K02", subject_of(budget)).empty());
}

TEST(CoverageRules, K03ReadsTheSentence) {
    AuditedBudget budget = fixed_budget();
    budget.claims.coverage_sentence = "k = 2, p = 95 %";
    EXPECT_TRUE(findings_of("K03", subject_of(budget)).empty());
    budget.claims.coverage_sentence = "k=2 (95,45 %)";
    EXPECT_TRUE(findings_of("K03", subject_of(budget)).empty());
    budget.claims.coverage_sentence = "k = 2, p = 99 %";
    EXPECT_EQ(findings_of("K03", subject_of(budget)).size(), 1U);
    budget.claims.coverage_sentence = "coverage factor k = 2";
    budget.claims.k = printed("1.96");
    budget.claims.U = printed("0.98");
    budget.coverage.k = 1.96;
    EXPECT_EQ(findings_of("K03", subject_of(budget)).size(), 1U);
}

/// k = 1.645 is 95 % of one end of an interval, whatever the language that says so.
TEST(CoverageRules, K03LeavesOneEndOfAnIntervalAlone) {
    AuditedBudget budget = fixed_budget();
    budget.claims.k = printed("1.645");
    budget.coverage.k = 1.645;
    budget.claims.U = exact_number(1.645 * 0.5, "");
    const auto found = [&](const std::string& words) {
        budget.claims.coverage_sentence = words;
        return findings_of("K03", subject_of(budget)).size();
    };
    EXPECT_EQ(found("k = 1.645, p = 95 %"), 1U);
    for (const char* const words :
         {"one-sided, k = 1.645, p = 95 %", "k = 1.645, p = 95 % (one-tailed)", "einseitig, k = 1,645, p = 95 %",
          "intervalo unilateral, k = 1,645, p = 95 %", "單側，k = 1.645，p = 95 %"}) {
        EXPECT_EQ(found(words), 0U) << words;
    }
}

TEST(CoverageRules, K03DoesNotAccuseTheRoundingOfRows) {
    // Rows of one digit give ν_eff = 12.5; from all digits the laboratory has 8.
    AuditedBudget budget = budget_of({row("a", 0.3, 1.0, 6.0), row("b", 0.2)});
    for (AuditedRow& one : budget.rows) {
        one.u_half_step = 0.05;
    }
    const double k = gum::coverage_factor(0.9545, 8.0);
    budget.claims.k = exact_number(k, "");
    budget.claims.U = exact_number(k * std::hypot(0.3, 0.2), "");
    EXPECT_TRUE(findings_of("K03", subject_of(budget)).empty());
    budget.claims.k = exact_number(5.0, "");
    EXPECT_EQ(findings_of("K03", subject_of(budget)).size(), 1U);
}

TEST(CoverageRules, K03DoesNotAccuseAMismatchThatStatesNoDistribution) {
    // EA-4/02, S7, in a table without distributions: the U-shaped mismatch makes k of 95.45 % smaller than rectangular ones do.
    AuditedBudget budget = budget_of({row("mismatch", 0.020), row("standard", 0.009), row("drift", 0.004)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.coverage.k = 1.77;
    budget.coverage.probability = 0.9545;
    budget.claims.k = printed("1.77");
    budget.claims.coverage_probability = 0.9545;
    budget.claims.U = exact_number(1.77 * std::sqrt(0.020 * 0.020 + 0.009 * 0.009 + 0.004 * 0.004), "");
    EXPECT_TRUE(findings_of("K03", subject_of(budget)).empty());
    for (AuditedRow& one : budget.rows) {
        one.shape = Shape::normal;
    }
    EXPECT_EQ(findings_of("K03", subject_of(budget)).size(), 1U);
    budget.rows[0].shape = Shape::trapezoidal;  // what is stated is not U-shaped
    EXPECT_EQ(findings_of("K03", subject_of(budget)).size(), 1U);
}

TEST(CoverageRules, K04ConvolvesARectangularRow) {
    AuditedBudget budget = budget_of({row("limit", 1.0), row("rest", 0.2)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.rows[0].shape = Shape::rectangular;
    std::vector<AuditFinding> findings = findings_of("K04", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.k, 1.700, 0.0005);  // published for a ratio of 0.2
    budget.rows[1].used_u = 0.0;
    EXPECT_NEAR(findings_of("K04", subject_of(budget))[0].effect->alone.k, 1.653, 0.0005);
    budget.rows[1].used_u = 0.4;
    EXPECT_TRUE(findings_of("K04", subject_of(budget)).empty());
    budget.rows[1].used_u = 0.2;
    budget.rows[0].shape = Shape::normal;
    EXPECT_TRUE(findings_of("K04", subject_of(budget)).empty());
}

TEST(CoverageRules, K05KnowsTheSumOfAllLimits) {
    AuditedBudget budget = budget_of({row("limit", 1.0)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.rows[0].shape = Shape::rectangular;
    ASSERT_EQ(findings_of("K05", subject_of(budget)).size(), 1U);  // 2 against √3
    budget.rows.push_back(row("normal", 0.01));
    EXPECT_TRUE(findings_of("K05", subject_of(budget)).empty());
    budget.rows.pop_back();
    budget.coverage.k = 1.65;
    EXPECT_TRUE(findings_of("K05", subject_of(budget)).empty());
}

TEST(CoverageRules, K06PointsToTheOneRow) {
    ASSERT_EQ(findings_of("K06", subject_of(budget_of({row("a", 1.0), row("b", 0.1)}))).size(), 1U);
    EXPECT_EQ(findings_of("K06", subject_of(budget_of({row("a", 1.0), row("b", 0.1)})))[0].severity,
              FindingSeverity::information);
    EXPECT_TRUE(findings_of("K06", subject_of(budget_of({row("a", 1.0), row("b", 0.3)}))).empty());
    // A claim that is too small makes no row larger than the whole.
    AuditedBudget claimed = budget_of({row("a", 1.0), row("b", 0.3)});
    claimed.u_c_over_rows = 0.9;
    EXPECT_TRUE(findings_of("K06", subject_of(claimed)).empty());
    // No row has a share where correlations that are not listed, or trials, make up the variance.
    for (const double beyond : {-0.8, -0.2, 0.3}) {
        AuditedBudget evaluated = budget_of({row("a", 1.0), row("b", 1.0)});
        evaluated.evaluated_here = true;
        evaluated.correlation_variance = beyond;
        evaluated.inputs_with_correlation = {{"a", "b"}};
        EXPECT_TRUE(findings_of("K06", subject_of(evaluated)).empty()) << beyond;
        evaluated.rows[1].used_u = 0.1;
        EXPECT_TRUE(findings_of("K06", subject_of(evaluated)).empty()) << beyond;
        evaluated.inputs_with_correlation = {{"b"}};
        std::swap(evaluated.correlation_variance, evaluated.variance_beyond_tangent);
        EXPECT_TRUE(findings_of("K06", subject_of(evaluated)).empty()) << beyond;
        evaluated.variance_beyond_tangent = -0.01;  // the scatter of trials
        EXPECT_EQ(findings_of("K06", subject_of(evaluated)).size(), 1U);
    }
}

TEST(CoverageRules, K07SeesUnequalTails) {
    AuditedBudget budget = fixed_budget();
    budget.value = 10.0;
    budget.monte_carlo = StatedMonteCarlo{};
    budget.monte_carlo->low = 9.0;
    budget.monte_carlo->high = 11.1;
    EXPECT_TRUE(findings_of("K07", subject_of(budget)).empty());
    budget.monte_carlo->high = 11.6;
    EXPECT_EQ(findings_of("K07", subject_of(budget)).size(), 1U);
}

TEST(CoverageRules, K08KnowsFormErrors) {
    AuditedBudget budget = fixed_budget();
    budget.value = 0.6;
    EXPECT_TRUE(findings_of("K08", subject_of(budget)).empty());
    budget.name = "Flatness of anvil";
    EXPECT_EQ(findings_of("K08", subject_of(budget)).size(), 1U);
    budget.value = 1.2;
    EXPECT_TRUE(findings_of("K08", subject_of(budget)).empty());
}

TEST(CoverageRules, K09KnowsALinearSum) {
    AuditedBudget budget = fixed_budget();
    EXPECT_TRUE(findings_of("K09", subject_of(budget)).empty());
    budget.claims.u_c = printed("0.70");
    budget.claims.U = printed("1.40");
    note_unexplained(budget);
    const std::vector<AuditFinding> findings = findings_of("K09", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.U, 1.0, 1e-12);
    EXPECT_TRUE(findings_of("K01", subject_of(budget)).empty());
}

TEST(CoverageRules, K11PutsNothingRightThatTheGumAllows) {
    AuditedBudget budget = budget_of({row("a", 0.3, 1.0, 5.9)});
    AuditSubject subject = subject_of(budget);
    for (const auto kind : {AuditSubject::Kind::table, AuditSubject::Kind::workbook, AuditSubject::Kind::record}) {
        subject.kind = kind;
        ASSERT_EQ(findings_of("K11", subject).size(), 1U);
        EXPECT_EQ(findings_of("K11", subject)[0].severity, FindingSeverity::information);
        EXPECT_FALSE(findings_of("K11", subject)[0].effect);
    }
    // One file that does both.
    AuditedBudget cut = budget;
    cut.coverage.truncate = true;
    subject.kind = AuditSubject::Kind::table;
    subject.budgets.push_back(cut);
    ASSERT_EQ(findings_of("K11", subject).size(), 1U);
    EXPECT_NEAR(findings_of("K11", subject)[0].effect->alone.k, gum::coverage_factor(0.9545, 5.0), 1e-12);
    budget.rows[0].used_nu = 5.0;
    EXPECT_TRUE(findings_of("K11", subject_of(budget)).empty());
    budget.rows[0].used_nu = 500.3;
    EXPECT_TRUE(findings_of("K11", subject_of(budget)).empty());
}

TEST(CoverageRules, K12ComparesWithTheTolerance) {
    AuditedBudget budget = fixed_budget();
    budget.limits = {.lower = -0.8, .upper = 0.8};
    EXPECT_EQ(findings_of("K12", subject_of(budget)).size(), 1U);
    budget.limits = {.lower = -3.0, .upper = 3.0};
    EXPECT_TRUE(findings_of("K12", subject_of(budget)).empty());
}

TEST(CoverageRules, K13SeesWhatAFormatHides) {
    AuditedBudget budget = budget_of({row("a", 0.3, 1.0, 6.5279)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.claims.coverage_probability = 0.95;
    budget.claims.k = printed("2");
    budget.claims.U = exact_number(0.3 * gum::coverage_factor(0.95, 6.5279), "");
    note_unexplained(budget);
    const std::vector<AuditFinding> findings = findings_of("K13", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].expected, "k = 2.40");
    EXPECT_TRUE(findings_of("K01", subject_of(budget)).empty());
    EXPECT_TRUE(findings_of("K03", subject_of(budget)).empty());
    budget.claims.k = printed("2.40");
    note_unexplained(budget);
    EXPECT_TRUE(findings_of("K13", subject_of(budget)).empty());
}

TEST(CoverageRules, K01HoldsContributionsAndNuAgainstTheRows) {
    AuditedRow squared = row("height", 0.2, 3.0);
    squared.contribution = printed("1.80");
    squared.used_sensitivity = 9.0;  // as the sum was made
    AuditedBudget of_contributions = budget_of({squared, row("another", 0.01)});
    of_contributions.claims.u_c = printed("1.80");
    std::vector<AuditFinding> findings = findings_of("K01", subject_of(of_contributions));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.6, 0.01), 1e-12);
    EXPECT_NE(findings[0].evidence.back().english().find("twice"), std::string::npos);

    AuditedBudget budget = budget_of({row("a", 0.300, 1.0, 4.0), row("b", 0.100)});
    const double u_c = evaluate(budget).u_c, nu = evaluate(budget).nu_eff;
    budget.claims.u_c = exact_number(u_c, "");
    budget.claims.nu_eff = printed("14.0");
    budget.claims.k = printed("2.20");
    budget.claims.U = exact_number(2.1953 * u_c, "");
    budget.claims.coverage_probability = 0.9545;
    note_unexplained(budget);
    findings = findings_of("K01", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.U, gum::coverage_factor(0.9545, nu) * u_c, 1e-9);
}

}  // namespace
}  // namespace gumcert::audit
