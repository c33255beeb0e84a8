#include "audit/claims.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <string>

#include "audit/budget_outcome.h"
#include "gum/coverage.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::printed;
using test::row;

/// u_c = 0.5 µm from rows with three digits.
AuditedBudget claimed_budget() {
    AuditedBudget budget = budget_of({row("a", 0.300), row("b", 0.400)});
    for (AuditedRow& one : budget.rows) {
        one.u_half_step = 0.0005;
    }
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.claims.u_c = printed("0.50");
    budget.claims.k = printed("2");
    budget.claims.U = printed("1.0");
    return budget;
}

TEST(PrintedInterval, TakesWholeNumbersForRounded) {
    EXPECT_NEAR(printed_interval(printed("0.29")).low, 0.285, 1e-6);
    EXPECT_NEAR(printed_interval(printed("12")).high, 12.5, 1e-4);
    EXPECT_NEAR(printed_interval(printed("120")).high, 125.0, 1e-3);
    EXPECT_NEAR(printed_interval(printed("100")).high, 105.0, 1e-3);
    EXPECT_NEAR(printed_interval(exact_number(12.0, "")).high, 12.0, 1e-4);
}

TEST(Claims, AreLeftAloneWhereRoundingExplainsThem) {
    AuditedBudget budget = claimed_budget();
    note_unexplained(budget);
    EXPECT_EQ(budget.u_c_over_rows, 1.0);
    EXPECT_EQ(budget.U_over_k_u_c, 1.0);
    budget.claims.U = printed("1.1");  // rounded up from 1.0000…? no: 1.1 stands for more than 1.0
    EXPECT_FALSE(check_claims(budget).U_outside);
    budget.claims.U = printed("1.2");
    EXPECT_TRUE(check_claims(budget).U_outside);
}

TEST(Claims, BeyondTheRowsAreEvaluatedAsClaimed) {
    AuditedBudget budget = claimed_budget();
    budget.claims.u_c = printed("0.62");
    budget.claims.U = printed("1.24");
    note_unexplained(budget);
    EXPECT_NEAR(evaluate(budget).u_c, 0.62, 1e-12);
    EXPECT_NEAR(evaluate(budget).U, 1.24, 1e-12);
    EXPECT_EQ(budget.U_over_k_u_c, 1.0);
    EXPECT_TRUE(check_claims(budget).u_c_outside);

    budget.claims.U = printed("1.50");
    note_unexplained(budget);
    EXPECT_NEAR(evaluate(budget).U, 1.50, 1e-12);
    EXPECT_NEAR(budget.U_over_k_u_c, 1.50 / 1.24, 1e-12);

    // Less than the rows give.
    budget.claims.u_c = printed("0.31");
    budget.claims.U = printed("0.62");
    note_unexplained(budget);
    EXPECT_NEAR(evaluate(budget).U, 0.62, 1e-12);
}

TEST(Claims, ShowWhichCoverageWasUsed) {
    AuditedBudget budget = budget_of({row("a", 0.300, 1.0, 4.0), row("b", 0.100)});
    budget.coverage = {.kind = CoverageRule::Kind::student_t, .k = 2.0, .probability = 0.9545, .truncate = false};
    const double u_c = evaluate(budget).u_c, nu = evaluate(budget).nu_eff;
    budget.claims.k = printed("2");
    budget.claims.U = exact_number(2.0 * u_c, "");
    note_unexplained(budget);
    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::fixed);
    EXPECT_EQ(budget.U_over_k_u_c, 1.0);

    budget.claims.k.reset();
    budget.claims.U = exact_number(gum::coverage_factor(0.95, std::floor(nu)) * u_c, "");
    note_unexplained(budget);
    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::student_t);
    EXPECT_TRUE(budget.coverage.truncate);
    EXPECT_EQ(budget.coverage.probability, 0.95);
    EXPECT_NEAR(evaluate(budget).U, budget.claims.U->value, 1e-12);
}

TEST(Claims, KnowALinearSum) {
    AuditedBudget budget = claimed_budget();
    budget.claims.u_c = printed("0.70");
    budget.claims.U = printed("1.40");
    EXPECT_TRUE(check_claims(budget).linear_sum);
    budget.claims.u_c = printed("0.75");
    EXPECT_FALSE(check_claims(budget).linear_sum);
}

TEST(Claims, AtTheCapabilityAreNotU) {
    AuditedBudget budget = claimed_budget();
    budget.capability = 1.5;
    budget.claims.U = printed("1.5");
    EXPECT_FALSE(check_claims(budget).U_outside);
}

TEST(Claims, AreNotHeldAgainstRowsWithoutAnOutcome) {
    AuditedBudget budget = budget_of({row("a", 0.0)});
    budget.claims.u_c = printed("0.5");
    note_unexplained(budget);
    EXPECT_FALSE(check_claims(budget).u_c_outside);
    EXPECT_EQ(budget.u_c_over_rows, 1.0);
}

/// ν_eff = 4.94 with every digit, k = t_95.45(4.94) = 2.66.
AuditedBudget budget_of_few() {
    AuditedBudget budget = budget_of({row("a", 0.300, 1.0, 4.0), row("b", 0.100)});
    budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = 2.66, .probability = 0.9545, .truncate = false};
    const BudgetOutcome outcome = evaluate(budget);
    const double k = gum::coverage_factor(0.9545, outcome.nu_eff);
    budget.claims.u_c = exact_number(outcome.u_c, "");
    budget.claims.nu_eff = printed("4.9");
    budget.claims.k = printed("2.66");
    budget.claims.U = exact_number(k * outcome.u_c, "");
    budget.claims.coverage_probability = 0.9545;
    return budget;
}

TEST(Claims, TakeAFactorWithDecimalsFromNuWhereItIsThat) {
    AuditedBudget budget = budget_of_few();
    note_unexplained(budget);
    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::student_t);
    EXPECT_FALSE(budget.coverage.truncate) << "within the digits of k the first rule is taken";
    EXPECT_EQ(budget.k_over_rows, 1.0);
    // A factor that no ν_eff gives is the one that is stated.
    budget.claims.k = printed("2.30");
    budget.claims.U = exact_number(2.30 * evaluate(budget).u_c, "");
    budget.claims.nu_eff.reset();
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.coverage.k = 2.30;
    note_unexplained(budget);
    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::fixed);
}

TEST(Claims, KnowAFactorOfAnotherNu) {
    AuditedBudget budget = budget_of_few();
    const double u_c = evaluate(budget).u_c;
    budget.claims.nu_eff = printed("14.0");
    budget.claims.k = printed("2.20");
    budget.claims.U = exact_number(2.1953 * u_c, "");
    note_unexplained(budget);
    EXPECT_TRUE(check_claims(budget).nu_eff_outside);
    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::student_t);
    EXPECT_NEAR(evaluate(budget).k, 2.20, 1e-12) << "as claimed, until it is corrected";
}

TEST(Claims, DoNotExplainACutUByAnotherFactor) {
    AuditedBudget budget = claimed_budget();
    budget.claims.u_c = printed("0.500");
    budget.claims.k = printed("2.05");
    budget.claims.U = printed("1.03");
    EXPECT_FALSE(check_claims(budget).U_outside);  // rounded: 1.025
    budget.claims.u_c = printed("0.5000");
    budget.claims.U = printed("1.0");  // of 1.025 the digits behind the last are cut, and that is 1.0 rounded as well
    EXPECT_FALSE(check_claims(budget).U_outside);
    budget.claims.k = printed("2.16");
    budget.claims.U = printed("1.0");  // 1.08 cut
    EXPECT_TRUE(check_claims(budget).U_outside);
}

/// What is printed beside a number leaves less open than where it comes from: a k with two decimals than ν_eff of the rows, a contribution
/// than a coefficient of one digit.
TEST(Claims, FollowWhatIsPrintedBesideThem) {
    AuditedBudget budget = budget_of({row("a", 0.302), row("b", 0.430, 1.0, 5.0)});
    budget.rows[1].u_half_step = 0.02;
    ASSERT_NEAR(evaluate(budget).nu_eff, 11.2, 0.1);
    budget.claims.u_c = printed("0.525");
    budget.claims.k = printed("2.25");
    budget.claims.U = printed("1.2");
    EXPECT_FALSE(check_claims(budget).U_outside);
    budget.claims.U = printed("1.1");
    EXPECT_TRUE(check_claims(budget).U_outside) << "1.18 cut: the k of 16 degrees of freedom is not the printed one";

    AuditedBudget converted = budget_of({row("trigger level", 2.89), row("delay", 57.7)});
    const double c[] = {0.02, 0.001};
    for (std::size_t i = 0; i < 2; ++i) {
        AuditedRow& one = converted.rows[i];
        one.used_sensitivity = c[i];
        one.sensitivity_half_step = 0.5 * (i == 0 ? 0.01 : 0.001);
        one.u_half_step = i == 0 ? 0.005 : 0.05;
    }
    converted.claims.u_c = printed("0.0582");  // one of two contributions of 0.0577 is left out
    EXPECT_FALSE(check_u_c(converted).u_c_outside) << "c of one digit leaves that open";
    for (AuditedRow& one : converted.rows) {
        one.contribution = printed("0.0577");
    }
    EXPECT_TRUE(check_u_c(converted).u_c_outside);
    converted.claims.u_c = printed("0.0817");
    EXPECT_FALSE(check_u_c(converted).u_c_outside);
}

TEST(Claims, BelieveANuThatWasCut) {
    AuditedBudget budget = budget_of_few();
    const double u_c = evaluate(budget).u_c;  // ν_eff = 4.94
    budget.claims.nu_eff = printed("4");
    budget.claims.k = printed("2.87");
    budget.claims.U = exact_number(gum::coverage_factor(0.9545, 4.0) * u_c, "");
    EXPECT_FALSE(check_claims(budget).nu_eff_outside);
    EXPECT_TRUE(check_claims(budget).coverage.truncate);
}

TEST(Claims, RoundedByASheetAreNoOtherNumber) {
    // The law: whatever k u_c is, its rounding to two to five digits, nearest or up, is it; two units beside it is not.
    for (const double u : {0.010284, 0.34567, 3.1416, 47.11, 1234.5}) {
        for (int digits = 2; digits <= 5; ++digits) {
            const double U = 2.0 * u;
            const double step = std::pow(10.0, std::floor(std::log10(U)) - digits + 1);
            // A last digit of 0 is none of a number of a sheet.
            const double up = std::ceil(U / step), other = up + (std::fmod(up + 2.0, 10.0) == 0.0 ? 3.0 : 2.0);
            for (const double steps : {std::round(U / step), up, other}) {
                AuditedBudget budget = budget_of({row("a", u)});
                budget.coverage.kind = CoverageRule::Kind::fixed;
                budget.claims.u_c = exact_number(u, "");
                budget.claims.k = exact_number(2.0, "");
                budget.claims.U = exact_number(steps * step, "");
                note_unexplained(budget);
                const bool is_other = steps > up + 1.0;
                EXPECT_EQ(check_claims(budget).U_outside, is_other) << U << " as " << steps * step;
                EXPECT_EQ(budget.U_over_k_u_c == 1.0, !is_other) << U << " as " << steps * step;
            }
        }
    }
    AuditedBudget budget = budget_of({row("a", 0.010284)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.claims.k = exact_number(2.0, "");
    for (const double u_c : {0.0103, 0.010, 0.011}) {  // ROUND to four and three decimals, ROUNDUP to three
        budget.claims.u_c = exact_number(u_c, "");
        budget.claims.U = exact_number(2.0 * u_c, "");
        note_unexplained(budget);
        EXPECT_FALSE(check_claims(budget).u_c_outside) << u_c;
        EXPECT_FALSE(check_claims(budget).U_outside) << u_c;
        EXPECT_EQ(budget.u_c_over_rows, 1.0) << u_c;
    }
    budget.claims.u_c = exact_number(0.009, "");
    note_unexplained(budget);
    EXPECT_TRUE(check_claims(budget).u_c_outside);
    // No rounding of k u_c, but of another k that the probability would allow.
    budget.claims.u_c = exact_number(0.010284, "");
    budget.claims.U = exact_number(0.020, "");
    budget.claims.coverage_probability = 0.9545;
    note_unexplained(budget);
    EXPECT_TRUE(check_claims(budget).U_outside);
    budget.claims.u_c = printed("0.011");
    EXPECT_FALSE(check_claims(budget).u_c_outside) << "JCGM 100:2008, 7.2.6: 10.47 may be rounded up to 11";
}

TEST(TextOfClaim, KeepsTheDigitsAndHasTheFormOfDocuments) {
    const auto text = [](const std::string& printed, double half_step) {
        return text_of_claim({.value = 0.0, .half_step = half_step, .text = printed, .place = ""});
    };
    EXPECT_EQ(text("0,066", 0.0005), "0.066");
    EXPECT_EQ(text("0.060", 0.0005), "0.060");
    EXPECT_EQ(text("1,20E-3", 5e-6), "1.20E-3");
    EXPECT_EQ(text("10.000,00", 0.005), "10000.00");
    EXPECT_EQ(text("10,000.00", 0.005), "10000.00");
    EXPECT_EQ(text("10,000", 0.0), "10000");
    EXPECT_EQ(text("12", 0.0), "12");
    EXPECT_EQ(text("", 0.0), "");
}

}  // namespace
}  // namespace gumcert::audit
