#include "audit/budget_outcome.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::k_infinite;
using test::row;

/// JCGM 100:2008, H.1, table H.1: end gauge, in nm.
AuditedBudget end_gauge() {
    AuditedBudget budget = budget_of({row("l_s", 25.0, 1.0, 18.0), row("d", 9.7, 1.0, 25.6),
                                      row("delta alpha", 2.9, 1.0, 50.0), row("delta theta", 16.6, 1.0, 2.0)});
    budget.unit = "nm";
    budget.coverage = {.kind = CoverageRule::Kind::student_t, .k = 2.0, .probability = 0.99, .truncate = true};
    return budget;
}

TEST(BudgetOutcome, IsThatOfTheEndGauge) {
    const BudgetOutcome outcome = evaluate(end_gauge());
    EXPECT_NEAR(outcome.u_c, 32.0, 0.5);     // printed 32 nm
    EXPECT_NEAR(outcome.nu_eff, 16.7, 0.1);  // 16.7 from unrounded contributions; the printed ones give 16.76
    EXPECT_NEAR(outcome.k, 2.92, 0.005);     // t_99(16)
    EXPECT_NEAR(outcome.U, 93.0, 0.5);
    EXPECT_EQ(outcome.printed_U, "93");
}

/// EA-4/02, example S2: weight of 10 kg, in mg.
AuditedBudget weight() {
    return budget_of({row("m_S", 45.0 / 2.0), row("drift", 15.0 / std::numbers::sqrt3),
                      row("difference", 25.0 / std::numbers::sqrt3), row("eccentricity", 10.0 / std::numbers::sqrt3),
                      row("buoyancy", 10.0 / std::numbers::sqrt3)});
}

TEST(BudgetOutcome, IsThatOfTheWeight) {
    AuditedBudget budget = weight();
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.value = 25.0;
    const BudgetOutcome outcome = evaluate(budget);
    EXPECT_NEAR(outcome.u_c, 29.3, 0.05);
    EXPECT_EQ(outcome.printed_U, "59");
    EXPECT_EQ(outcome.printed_value, "25");
    EXPECT_TRUE(std::isinf(outcome.nu_eff));
}

TEST(BudgetOutcome, AddsCorrelationsAndLeavesRowsOut) {
    AuditedBudget budget = budget_of({row("a", 3.0), row("b", 4.0, -1.0), row("c", 100.0)});
    budget.rows[2].in_sum = false;
    EXPECT_DOUBLE_EQ(evaluate(budget).u_c, 5.0);
    budget.correlations = {{.first = 0, .second = 1, .r = 1.0}};
    EXPECT_DOUBLE_EQ(evaluate(budget).u_c, 1.0);
    budget.correlations = {{.first = 0, .second = 1, .r = -1.0}};
    EXPECT_DOUBLE_EQ(evaluate(budget).u_c, 7.0);
}

/// Two rows that correlate and their difference: what remains of them is one contribution with the degrees of freedom of both.
TEST(BudgetOutcome, TakesCorrelatedRowsForOneContribution) {
    AuditedBudget budget =
        budget_of({row("a", 0.02, 1.0, 50.0), row("b", 0.02, -1.0, 50.0), row("c", 0.01, 1.0, 9.0), row("d", 0.003)});
    budget.correlations = {{.first = 0, .second = 1, .r = 0.9}};
    const double difference = 8e-5, u2 = difference + 1e-4 + 9e-6;
    const double expected = u2 * u2 / (difference * difference / 50.0 + 1e-8 / 9.0);
    EXPECT_NEAR(evaluate(budget).nu_eff, expected, 1e-9);
    EXPECT_GE(outcome_intervals(budget).nu_eff.high, expected * (1.0 - 1e-9));
    CoverageRule independent = budget.coverage;
    independent.correlated = CorrelatedRows::independent;
    EXPECT_NEAR(evaluate(budget, independent).nu_eff, u2 * u2 / (2.0 * 1.6e-7 / 50.0 + 1e-8 / 9.0), 1e-9);
    // The order of pairs and rows has no part in it.
    budget.correlations = {{.first = 2, .second = 0, .r = 0.1}, {.first = 1, .second = 0, .r = 0.9}};
    const double first = evaluate(budget).nu_eff;
    std::swap(budget.correlations[0], budget.correlations[1]);
    EXPECT_NEAR(evaluate(budget).nu_eff, first, 1e-9);
    std::swap(budget.rows[0], budget.rows[2]);
    for (RowCorrelation& pair : budget.correlations) {
        for (std::size_t* const at : {&pair.first, &pair.second}) {
            *at = *at == 0 ? 2 : *at == 2 ? 0 : *at;
        }
    }
    EXPECT_NEAR(evaluate(budget).nu_eff, first, 1e-9);
    // One source in two rows that add: four degrees of freedom, and not the 18 of independent rows.
    AuditedBudget sum = budget_of({row("a", 1.0, 1.0, 4.0), row("b", 1.0, 1.0, 4.0)});
    sum.correlations = {{.first = 0, .second = 1, .r = 0.5}};
    CoverageRule one = sum.coverage;
    one.correlated = CorrelatedRows::one_contribution;
    EXPECT_NEAR(evaluate(sum, one).nu_eff, 4.0, 1e-9);
    EXPECT_NEAR(evaluate(sum).nu_eff, 18.0, 1e-9) << "neither is a reason to find fault";
    EXPECT_LE(outcome_intervals(sum).nu_eff.low, 4.0 * (1.0 + 1e-9));
    EXPECT_GE(outcome_intervals(sum).nu_eff.high, 18.0 * (1.0 - 1e-9));
    // Where all that has degrees of freedom cancels, infinitely many are allowed, as they are recomputed.
    AuditedBudget cancelled = budget_of({row("a", 0.5, 1.0, 8.0), row("b", 0.5, -1.0, 8.0), row("c", 0.25)});
    cancelled.correlations = {{.first = 0, .second = 1, .r = 1.0}};
    EXPECT_TRUE(std::isinf(evaluate(cancelled).nu_eff));
    EXPECT_TRUE(std::isinf(outcome_intervals(cancelled).nu_eff.high));
    // A row that hardly correlates does not make the others its own.
    AuditedBudget weak = budget_of({row("a", 1.0), row("b", 0.01, 1.0, 2.0)});
    weak.correlations = {{.first = 0, .second = 1, .r = 0.01}};
    EXPECT_GT(evaluate(weak).nu_eff, 1e6);
}

/// u of a difference of rows with one digit each: what the digits leave open holds all that they may have been, and not everything.
TEST(BudgetOutcome, LeavesOpenOfTwoCorrelatedRowsWhatTheirDigitsDo) {
    AuditedBudget budget = budget_of({row("a", 0.02), row("b", 0.02, -1.0), row("c", 0.01)});
    for (AuditedRow& one : budget.rows) {
        one.u_half_step = 0.005;
    }
    budget.correlations = {{.first = 0, .second = 1, .r = 0.9}};
    const Interval u_c = outcome_intervals(budget).u_c;
    EXPECT_GT(u_c.low, 0.005);
    EXPECT_LT(u_c.high, 0.024) << "0.030 is that of independent rows";
    for (const double sign : {-1.0, 1.0}) {
        for (const double r : {-1.0, -0.4, 0.0, 0.3, 0.9, 1.0}) {
            budget.correlations[0].r = r;
            budget.rows[1].used_sensitivity = sign;
            const Interval allowed = outcome_intervals(budget).u_c;
            AuditedBudget exact = budget;
            for (const double a : {0.015, 0.017, 0.02, 0.025}) {
                for (const double b : {0.015, 0.019, 0.022, 0.025}) {
                    for (const double c : {0.005, 0.015}) {
                        exact.rows[0].used_u = a;
                        exact.rows[1].used_u = b;
                        exact.rows[2].used_u = c;
                        const double u = evaluate(exact).u_c;
                        EXPECT_LE(allowed.low, u * (1.0 + 1e-12)) << r << " " << sign << " " << a << " " << b;
                        EXPECT_GE(allowed.high, u * (1.0 - 1e-12)) << r << " " << sign << " " << a << " " << b;
                    }
                }
            }
        }
    }
}

TEST(BudgetOutcome, NeverStatesLessThanTheCapability) {
    AuditedBudget budget = weight();
    budget.capability = 70.0;
    EXPECT_EQ(evaluate(budget).U, 70.0);
    EXPECT_TRUE(evaluate(budget).at_capability);
    budget.floor_applied = false;
    EXPECT_LT(evaluate(budget).U, 60.0);
}

TEST(BudgetOutcome, DecidesAndScores) {
    AuditedBudget budget = weight();
    budget.coverage.kind = CoverageRule::Kind::fixed;
    budget.value = 25.0;
    budget.limits.upper = 80.0;
    budget.limits.lower = -80.0;
    budget.rule = gum::DecisionRule::guard_band_u;
    EXPECT_EQ(evaluate(budget).verdict, "fail");  // 80 - 58.5 is less than 25
    budget.value = 20.0;
    EXPECT_EQ(evaluate(budget).verdict, "pass");
    budget.reference =
        ComparedReference{.value = 90.0, .expanded_uncertainty = 40.0, .correlation = 0.0, .name = "lab"};
    EXPECT_NEAR(*evaluate(budget).en, -70.0 / std::hypot(evaluate(budget).U, 40.0), 1e-12);
}

TEST(ContributionOf, IsNothingOfARowOutsideOfTheSum) {
    AuditedRow one = test::row("a", 0.3);
    one.used_sensitivity = -2.0;
    EXPECT_DOUBLE_EQ(contribution_of(one), 0.6);
    one.in_sum = false;
    EXPECT_EQ(contribution_of(one), 0.0);
}

TEST(BudgetOutcome, ScoresALaboratoryAgainstTheReferenceWhoseBudgetItIs) {
    AuditedBudget budget = test::budget_of({test::row("a", 0.3)});
    budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = 2.0};
    budget.value = 1.0;
    budget.reference =
        ComparedReference{.value = 0.5, .expanded_uncertainty = 0.8, .name = "laboratory", .budget_is_reference = true};
    EXPECT_NEAR(evaluate(budget).en.value_or(0.0), -0.5, 1e-12);
}

TEST(BudgetOutcome, ScoresThePointThatIsWorse) {
    AuditedBudget budget = test::budget_of({test::row("a", 0.3)});
    budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = 2.0};
    budget.value = 1.0;
    budget.reference = ComparedReference{.value = 0.5, .expanded_uncertainty = 0.8, .name = ""};
    EXPECT_NEAR(evaluate(budget).en.value_or(0.0), 0.5, 1e-12);
    budget.reference->largest_difference = difference_of_score(-0.7, 0.6, *budget.reference);
    EXPECT_NEAR(evaluate(budget).en.value_or(0.0), -0.7, 1e-12);
}

TEST(BudgetOutcome, LeavesOutOnlyWhatCannotBeDecided) {
    // Every rule without its parameters, impossible limits, an impossible correlation: u_c, k and U stay what they are.
    AuditedBudget plain = budget_of({row("a", 0.3, 1.0, 12.0), row("b", 0.4)});
    plain.value = 9.9;
    const BudgetOutcome known = evaluate(plain);
    std::size_t undecided = 0;
    for (const std::string_view id : gum::decision_rule_ids()) {
        for (const double lower : {0.0, 20.0}) {
            AuditedBudget budget = plain;
            budget.rule = gum::decision_rule_from_id(std::string(id));
            budget.limits = {.lower = lower, .upper = 10.0};
            budget.reference =
                ComparedReference{.value = 9.0, .expanded_uncertainty = 1.0, .correlation = 2.0 * lower, .name = ""};
            const BudgetOutcome outcome = evaluate(budget);
            EXPECT_EQ(outcome.u_c, known.u_c);
            EXPECT_EQ(outcome.k, known.k);
            EXPECT_EQ(outcome.printed_U, known.printed_U);
            EXPECT_FALSE(outcome.verdict.empty());
            EXPECT_EQ(outcome.en.has_value(), lower == 0.0);
            EXPECT_EQ(outcome.undecided.empty(), outcome.verdict != k_no_decision && outcome.en);
            undecided += outcome.verdict == k_no_decision ? 1U : 0U;
        }
    }
    EXPECT_GT(undecided, gum::decision_rule_ids().size()) << "impossible limits, and rules that need more than limits";
    EXPECT_FALSE(verdict_turns("pass", k_no_decision));
    EXPECT_FALSE(verdict_turns(k_no_decision, "fail"));
    EXPECT_TRUE(verdict_turns("pass", "fail"));
}

TEST(BudgetOutcome, TakesKFromTheConvolution) {
    AuditedBudget budget = budget_of({row("limit", 1.0)});
    budget.rows[0].shape = Shape::rectangular;
    budget.coverage.kind = CoverageRule::Kind::convolution;
    EXPECT_NEAR(evaluate(budget).k, 0.9545 * std::numbers::sqrt3, 1e-6);
}

TEST(BudgetOutcome, NeedsSomethingToAdd) {
    EXPECT_THROW(static_cast<void>(evaluate(budget_of({row("a", 0.0)}))), gum::NoResultError);
    AuditedBudget impossible = budget_of({row("a", 1.0), row("b", 1.0)});
    impossible.correlations = {{.first = 0, .second = 1, .r = -1.0}};
    EXPECT_THROW(static_cast<void>(evaluate(impossible)), gum::NoResultError);
}

TEST(OutcomeIntervals, HoldWhatAnyRoundingAllows) {
    // Rows 0.3 and 0.4 with one digit: the true numbers are anywhere within half a digit.
    AuditedBudget budget = budget_of({row("a", 0.3, 1.0, 4.0), row("b", 0.4)});
    for (AuditedRow& one : budget.rows) {
        one.u_half_step = 0.05;
    }
    const OutcomeIntervals allowed = outcome_intervals(budget);
    EXPECT_NEAR(allowed.u_c.low, std::hypot(0.25, 0.35), 1e-12);
    EXPECT_NEAR(allowed.u_c.high, std::hypot(0.35, 0.45), 1e-12);
    for (const double a : {0.2501, 0.31, 0.3499}) {
        for (const double b : {0.3501, 0.42, 0.4499}) {
            const BudgetOutcome exact = evaluate(budget_of({row("a", a, 1.0, 4.0), row("b", b)}));
            EXPECT_TRUE(allowed.u_c.contains(exact.u_c));
            EXPECT_TRUE(allowed.nu_eff.contains(exact.nu_eff));
            EXPECT_TRUE(allowed.k.contains(exact.k));
            EXPECT_TRUE(allowed.U.contains(exact.U));
        }
    }
    EXPECT_EQ(outcome_intervals(budget_of({row("a", 1.0)})).nu_eff.high, k_infinite);
}

TEST(OutcomeIntervals, BelieveThePrintedContribution) {
    AuditedBudget budget = budget_of({row("a", 0.3)});
    budget.rows[0].contribution = test::printed("0.4");
    EXPECT_DOUBLE_EQ(outcome_intervals(budget).u_c.low, 0.3);
    EXPECT_DOUBLE_EQ(outcome_intervals(budget).u_c.high, 0.45);
}

TEST(BudgetOutcome, PrintsWhatIsNotCorrectedAsItIsStated) {
    struct Case {
        double stated, evaluated, U;
        const char *printed, *rounded;
    };
    const Case cases[] = {
        {31.0, 30.496, 30.496, "31 µm", "31"},  // 2 × 15.3
        {31.0, 30.496, 30.512, "31 µm", "31"},
        {31.0, 30.496, 30.44, "31 µm", "31"},
        {31.0, 30.496, 29.9, "30", "30"},
        {31.0, 30.496, 31.4, "31 µm", "31"},
        {31.0, 30.496, 31.6, "32", "32"},
        {30.0, 30.51, 30.9, "31 µm", "30"},
        {30.0, 30.51, 31.1, "31", "31"},
        {31.0, 30.6, 30.2, "30", "30"},  // rounded as anybody does
        // One digit is stated: nobody who reads "1 → 1" would correct what is 34 % too small.
        {1.0, 1.006, 1.348, "1.3", "1.3"},
        {1.0, 1.006, 0.8, "0.80", "0.80"},
        {1.0, 1.006, 1.04, "31 µm", "1.0"},
        {1.0, 1.3, 1.2, "31 µm", "1.0"},
        {1.0, 1.3, 1.4, "1.4", "1.4"},
        {1.0, 0.8, 0.9, "31 µm", "1.0"},
    };
    for (const Case& one : cases) {
        AuditedBudget budget = test::budget_of({test::row("a", 0.5 * one.U)});
        budget.coverage.kind = CoverageRule::Kind::fixed;
        budget.uncorrected_U =
            UncorrectedU{.stated = one.stated, .evaluated = one.evaluated, .step = 1.0, .text = "31 µm"};
        const BudgetOutcome outcome = evaluate(budget);
        EXPECT_EQ(outcome.printed_U, one.printed) << one.U;
        EXPECT_EQ(outcome.rounded_U, one.rounded) << one.U;
    }
}

}  // namespace
}  // namespace gumcert::audit
