#include "audit/correction_effect.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::row;

/// A budget with few degrees of freedom in one row, so that effects do not add up.
AuditedBudget uneven_budget(std::size_t rows) {
    std::vector<AuditedRow> all;
    for (std::size_t i = 0; i < rows; ++i) {
        all.push_back(row("x" + std::to_string(i), 0.3 + 0.1 * static_cast<double>(i), 1.0,
                          i % 2 == 0 ? 2.0 + static_cast<double>(i) : test::k_infinite));
    }
    return budget_of(std::move(all));
}

/// Each correction scales one row; the factors differ.
std::vector<Correction> scaling_corrections(std::size_t n) {
    std::vector<Correction> corrections;
    for (std::size_t i = 0; i < n; ++i) {
        const double factor = i % 3 == 0 ? 1.7 : 0.6;
        corrections.push_back([i, factor](AuditedBudget& budget) { budget.rows[i].used_u *= factor; });
    }
    return corrections;
}

std::vector<const Correction*> pointers_to(const std::vector<Correction>& corrections) {
    std::vector<const Correction*> pointers;
    for (const Correction& correction : corrections) {
        pointers.push_back(&correction);
    }
    return pointers;
}

/// Shapley values of ln U by walking through all n! orders.
std::vector<double> shares_by_all_orders(const AuditedBudget& budget, const std::vector<Correction>& corrections) {
    std::vector<std::size_t> order(corrections.size());
    std::iota(order.begin(), order.end(), 0U);
    std::vector<double> shares(corrections.size(), 0.0);
    double orders = 0.0;
    do {
        AuditedBudget corrected = budget;
        double before = std::log(evaluate(corrected).U);
        for (const std::size_t i : order) {
            corrections[i](corrected);
            const double after = std::log(evaluate(corrected).U);
            shares[i] += after - before;
            before = after;
        }
        orders += 1.0;
    } while (std::next_permutation(order.begin(), order.end()));
    for (double& share : shares) {
        share /= orders;
    }
    return shares;
}

TEST(CorrectionEffect, SharesAreThoseOfAllOrders) {
    for (std::size_t n = 1; n <= 5; ++n) {
        const AuditedBudget budget = uneven_budget(5);
        const std::vector<Correction> corrections = scaling_corrections(n);
        const std::vector<Effect> effects = effects_of(budget, pointers_to(corrections));
        const std::vector<double> expected = shares_by_all_orders(budget, corrections);
        ASSERT_EQ(effects.size(), n);
        const double total = effects[0].audited.U / effects[0].claimed.U - 1.0;
        const double log_total = std::log(effects[0].audited.U / effects[0].claimed.U);
        for (std::size_t i = 0; i < n; ++i) {
            EXPECT_NEAR(effects[i].share, total * expected[i] / log_total, 1e-12) << n << " corrections, " << i;
        }
    }
}

TEST(CorrectionEffect, SharesAddUpToTheWholeChange) {
    for (const std::size_t n : {2U, 7U, 12U, 15U}) {
        const std::vector<Correction> corrections = scaling_corrections(n);
        const std::vector<Effect> effects = effects_of(uneven_budget(15), pointers_to(corrections));
        double sum = 0.0;
        for (const Effect& effect : effects) {
            sum += effect.share;
        }
        EXPECT_NEAR(sum, effects[0].audited.U / effects[0].claimed.U - 1.0, 1e-12) << n;
    }
}

TEST(CorrectionEffect, SampledSharesAreNearExactOnes) {
    // 13 corrections are sampled. One of them changes nothing, so the exact shares are those of the other 12.
    std::vector<Correction> corrections = scaling_corrections(12);
    const AuditedBudget budget = uneven_budget(12);
    const std::vector<Effect> exact = effects_of(budget, pointers_to(corrections));
    corrections.push_back([](AuditedBudget&) {});
    const std::vector<Effect> sampled = effects_of(budget, pointers_to(corrections));
    ASSERT_EQ(exact.size(), k_exact_shares);
    ASSERT_EQ(sampled.size(), k_exact_shares + 1);
    const double total = std::abs(exact[0].audited.U / exact[0].claimed.U - 1.0);
    for (std::size_t i = 0; i < exact.size(); ++i) {
        EXPECT_NEAR(sampled[i].share, exact[i].share, 0.05 * total + 0.05 * std::abs(exact[i].share)) << i;
    }
    EXPECT_NEAR(sampled.back().share, 0.0, 1e-12);
}

/// Results whose corrections change them alike, but for the last bits: none is larger than another.
TEST(CorrectionEffect, EqualChangesAreEqualWhateverTheirLastBitsAre) {
    for (int i = 1; i < 200; ++i) {
        const double U = 0.37 * i;
        EXPECT_EQ(size_of_change(U, 1.25 * U), size_of_change(3.1 * U, 3.1 * (1.25 * U))) << i;
        EXPECT_EQ(size_of_change(U, 1.25 * U), size_of_change(1.25 * U, U)) << i;
    }
    EXPECT_NEAR(size_of_change(2.0, 3.0), std::log(1.5), 1e-9);
    EXPECT_LT(size_of_change(2.0, 3.0), size_of_change(2.0, 3.00000001));
    EXPECT_EQ(size_of_change(2.0, 0.0), 0.0);
    EXPECT_EQ(size_of_change(0.0, 2.0), 0.0);
}

TEST(CorrectionEffect, KnowsAloneAndLast) {
    const std::vector<Correction> corrections = scaling_corrections(2);
    const AuditedBudget budget = uneven_budget(3);
    const std::vector<Effect> effects = effects_of(budget, pointers_to(corrections));
    AuditedBudget first = budget;
    corrections[0](first);
    AuditedBudget both = first;
    corrections[1](both);
    EXPECT_DOUBLE_EQ(effects[0].claimed.U, evaluate(budget).U);
    EXPECT_DOUBLE_EQ(effects[0].alone.U, evaluate(first).U);
    EXPECT_DOUBLE_EQ(effects[1].last.U, evaluate(first).U);
    EXPECT_DOUBLE_EQ(effects[1].audited.U, evaluate(both).U);
    EXPECT_NEAR(effects[0].relative_change_alone(), evaluate(first).U / evaluate(budget).U - 1.0, 1e-15);
}

TEST(CorrectionEffect, IsNothingWithoutAnOutcome) {
    const std::vector<Correction> corrections = scaling_corrections(1);
    EXPECT_TRUE(effects_of(budget_of({row("a", 0.0)}), pointers_to(corrections)).empty());
    EXPECT_TRUE(effects_of(uneven_budget(2), {}).empty());
}

TEST(MissingTerm, IsTheOneThatMovesADigit) {
    AuditedBudget budget = budget_of({row("a", 0.5)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    const std::optional<MissingTerm> term = missing_term(budget);
    ASSERT_TRUE(term);
    // U = 1.0 is printed "1.0" up to 1.05: u_c = 0.525.
    EXPECT_NEAR(term->u_for_digit, std::sqrt(0.525 * 0.525 - 0.25), 1e-5);
    EXPECT_FALSE(term->u_for_verdict);

    budget.value = 0.0;
    budget.limits = {.lower = -2.0, .upper = 2.0};
    budget.rule = gum::DecisionRule::guard_band_u;
    ASSERT_TRUE(missing_term(budget)->u_for_verdict);
    EXPECT_NEAR(*missing_term(budget)->u_for_verdict, std::sqrt(1.0 - 0.25), 1e-4);
    EXPECT_FALSE(missing_term(budget_of({row("a", 0.0)})));
}

}  // namespace
}  // namespace gumcert::audit
