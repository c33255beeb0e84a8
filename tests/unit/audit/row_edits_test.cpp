#include "audit/row_edits.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::row;

TEST(RowEdits, CorrectOneRow) {
    AuditedBudget budget = budget_of({row("a", 1.0), row("b", 2.0)});
    budget.rows[1].u_half_step = 0.5;
    budget.rows[1].contribution = exact_number(2.0, "");
    scale_u(1, 0.5)(budget);
    EXPECT_EQ(budget.rows[1].used_u, 1.0);
    EXPECT_EQ(budget.rows[1].u_half_step, 0.25);
    EXPECT_FALSE(budget.rows[1].contribution);
    both(set_u(0, 3.0), set_sensitivity(0, -2.0))(budget);
    EXPECT_EQ(budget.rows[0].used_u, 3.0);
    EXPECT_EQ(budget.rows[0].used_sensitivity, -2.0);
    set_degrees_of_freedom(0, 4.0)(budget);
    EXPECT_EQ(budget.rows[0].used_nu, 4.0);
    leave_out(0)(budget);
    EXPECT_FALSE(budget.rows[0].in_sum);
    put_in(0)(budget);
    EXPECT_TRUE(budget.rows[0].in_sum);
    add_contribution(0.7, "more")(budget);
    ASSERT_EQ(budget.rows.size(), 3U);
    EXPECT_EQ(budget.rows[2].used_u, 0.7);
}

/// One error of a u that several rules see, in whatever order they put it right.
TEST(RowEdits, CorrectOneErrorOnce) {
    std::mt19937 random(4);
    std::uniform_real_distribution<double> exponent(-3.0, 3.0), off(-0.004, 0.004);
    for (int i = 0; i < 200; ++i) {
        const double u = std::pow(10.0, exponent(random)), factor = std::pow(10.0, exponent(random));
        const double rounded = factor * (1.0 + off(random));
        const std::vector<Correction> same = {scale_u(0, factor), set_u(0, u * factor), scale_u(0, rounded),
                                              set_u(0, u * rounded)};
        for (const Correction& first : same) {
            for (const Correction& second : same) {
                AuditedBudget budget = budget_of({row("a", u)});
                both(first, second)(budget);
                EXPECT_NEAR(budget.rows[0].used_u / (u * factor), 1.0, 0.005);
                // Another error multiplies, before and after; a number that is set stands.
                if (std::abs(std::log(factor)) > 0.02 && std::abs(std::log(factor / 7.0)) > 0.02) {
                    AuditedBudget after = budget_of({row("a", u)});
                    both(both(first, scale_u(0, 7.0)), scale_u(0, factor))(after);
                    EXPECT_NEAR(after.rows[0].used_u / (7.0 * u * factor), 1.0, 0.005);
                }
            }
        }
    }
}

/// A u of two digits is not the quotient that it was rounded from: a correction that sets it, one that multiplies it, and one
/// that takes the rounding away, in whatever order.
TEST(RowEdits, CorrectOneErrorOfARoundedUOnce) {
    const double printed = 0.0028, right = 0.0085 / std::sqrt(3.0), quotient = 0.0085 / 3.0;
    AuditedBudget table = budget_of({row("a", printed)});
    table.rows[0].u_half_step = 0.5e-4;
    const Correction change = change_u({.budget = 0, .row = 0, .of = table, .is = table.rows[0]}, right);
    const std::vector<Correction> same = {set_u(0, right), scale_u(0, std::sqrt(3.0)), change};
    for (const Correction& first : same) {
        for (const Correction& second : same) {
            for (const int rounding : {0, 1, 2, 3}) {
                AuditedBudget budget = table;
                const Correction exact = unround_u(0, quotient);
                for (int i = 0; i < 3; ++i) {
                    if (i == rounding) {
                        exact(budget);
                    }
                    if (i < 2) {
                        (i == 0 ? first : second)(budget);
                    }
                }
                EXPECT_NEAR(budget.rows[0].used_u / right, 1.0, 0.018);
            }
        }
    }
    for (const bool before : {false, true}) {
        AuditedBudget budget = table;
        const Correction exact = unround_u(0, quotient);
        (before ? exact : change)(budget);
        (before ? change : exact)(budget);
        EXPECT_NEAR(budget.rows[0].used_u, right, 1e-15);
        scale_u(0, 0.5)(budget);  // of what was divided
        EXPECT_NEAR(budget.rows[0].used_u, 0.5 * right, 1e-15);
    }
}

TEST(RowEdits, SayWhereAndWhat) {
    const AuditSubject subject = test::subject_of(budget_of({row("a", 1.0)}));
    std::size_t rows = 0;
    for_each_row(subject, [&rows](const RowAt& at) {
        ++rows;
        const AuditFinding finding = finding_at(at, "u", "wrong");
        EXPECT_EQ(finding.where, "row of a (a), u");
        EXPECT_EQ(finding.budgets, (std::vector<std::size_t>{0}));
    });
    EXPECT_EQ(rows, 1U);
    EXPECT_EQ(finding_of(subject, 0, "wrong").where, "table 1");
    EXPECT_EQ(name_of_row(subject.budgets[0], 0), "row of a (a)");
    EXPECT_EQ(in_words(0.23094, "um"), "0.2309 µm");
    EXPECT_EQ(in_words(5.0, "1"), "5");
    EXPECT_EQ(printed_unit("um"), "µm");
    EXPECT_EQ(printed_unit("1"), "1");
    EXPECT_EQ(in_words(test::k_infinite), "infinite");
}

TEST(RowEdits, CompareNumbersAndWords) {
    AuditedRow one = row("Drift", 0.30);
    one.comment = "Verified";
    EXPECT_TRUE(mentions(one, {"verif"}));
    EXPECT_TRUE(mentions(one, {"nothing", "drift"}));
    EXPECT_FALSE(mentions(one, {"certificate"}));
    one.u_half_step = 0.005;
    EXPECT_FALSE(u_differs(one, 0.307));
    EXPECT_TRUE(u_differs(one, 0.315));
    EXPECT_FALSE(u_differs(one, 0.315, 0.01, 0.01));
    EXPECT_TRUE(is_about(1.0, 1.0099));
    EXPECT_FALSE(is_about(1.0, 1.02));
}

}  // namespace
}  // namespace gumcert::audit
