#include "audit/nested_budgets.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::row;

/// A result with a row of its own and one that is the combined uncertainty of two nested budgets, which are evaluated
/// again: u = |(u_1 f_1, u_2 f_2)|.
struct Nested {
    AuditSubject subject;
    std::set<RowFactors> asked;

    explicit Nested(std::size_t rows) {
        std::vector<AuditedRow> all;
        for (std::size_t i = 0; i < rows; ++i) {
            all.push_back(row("n" + std::to_string(i), 0.2 + 0.1 * static_cast<double>(i)));
        }
        subject = test::subject_of(
            std::vector<AuditedBudget>{budget_of({row("own", 0.1), row("fixture", 0.0)}), budget_of(all)});
        subject.budgets[0] = result_with(RowFactors{std::vector<double>(rows, 1.0)});
        subject.nested = NestedBudgets{.first = 1, .count = 1, .dependent = {0}, .evaluate_again = {}};
        subject.nested->evaluate_again = [this](const RowFactors& factors) {
            asked.insert(factors);
            return std::vector<AuditedBudget>{result_with(factors)};
        };
    }
    [[nodiscard]] AuditedBudget result_with(const RowFactors& factors) const {
        double variance = 0.0;
        for (std::size_t i = 0; i < factors[0].size(); ++i) {
            variance += std::pow(factors[0][i] * subject.budgets[1].rows[i].used_u, 2);
        }
        AuditedBudget result = budget_of({row("own", 0.1), row("fixture", std::sqrt(variance))});
        result.value = 1.0;
        result.reference = ComparedReference{.value = 0.0, .expanded_uncertainty = 0.5, .name = "reference"};
        return result;
    }
};

AuditFinding finding_on(std::size_t budget, Correction correct) {
    AuditFinding finding;
    finding.budgets = {budget};
    finding.correct = std::move(correct);
    return finding;
}

Correction halved(std::size_t row) {
    return [row](AuditedBudget& budget) { budget.rows[row].used_u *= 0.5; };
}

TEST(RowFactors, SayWhatAFactorCanSay) {
    const std::vector<AuditedBudget> claimed{budget_of({row("a", 0.2), row("b", 0.0)})};
    std::vector<AuditedBudget> corrected = claimed;
    EXPECT_EQ(row_factors(claimed, corrected), (RowFactors{{1.0, 1.0}}));
    corrected[0].rows[0].used_u = 0.1;
    EXPECT_EQ(row_factors(claimed, corrected), (RowFactors{{0.5, 1.0}}));
    corrected[0].rows[0].in_sum = false;
    EXPECT_EQ(row_factors(claimed, corrected), (RowFactors{{0.0, 1.0}}));
    corrected[0].rows[1].used_u = 0.1;
    EXPECT_FALSE(row_factors(claimed, corrected)) << "nothing times anything";
    corrected = claimed;
    corrected[0].rows.push_back(row("c", 0.1));
    EXPECT_FALSE(row_factors(claimed, corrected)) << "another row";
}

TEST(NestedCorrections, AreEvaluatedAgainTogetherWithThoseOfTheResult) {
    Nested nested(2);
    const std::vector<AuditFinding> findings{finding_on(1, halved(0)), finding_on(0, halved(0)),
                                             finding_on(1, [](AuditedBudget&) {})};
    const NestedCorrections corrections(nested.subject, findings);
    EXPECT_TRUE(corrections.is_nested(1) && !corrections.is_nested(0));
    EXPECT_TRUE(corrections.is_dependent(0) && !corrections.is_dependent(1));
    EXPECT_EQ(corrections.findings(), (std::vector<std::size_t>{0})) << "the last one changes nothing";
    const std::vector<Effect> effects = corrections.effects_on(0, {0, 1});
    ASSERT_EQ(effects.size(), 2U);
    EXPECT_NEAR(effects[0].claimed.u_c, std::hypot(0.1, 0.2, 0.3), 1e-12);
    EXPECT_NEAR(effects[0].alone.u_c, std::hypot(0.1, 0.1, 0.3), 1e-12);
    EXPECT_NEAR(effects[1].alone.u_c, std::hypot(0.05, 0.2, 0.3), 1e-12);
    EXPECT_NEAR(effects[0].audited.u_c, std::hypot(0.05, 0.1, 0.3), 1e-12);
    EXPECT_NEAR(effects[0].share + effects[1].share, effects[0].audited.U / effects[0].claimed.U - 1.0, 1e-12);
    EXPECT_EQ(nested.asked, (std::set<RowFactors>{{{0.5, 1.0}}})) << "one evaluation for one nested correction";
}

TEST(NestedCorrections, AreFewEvaluationsAlsoOfManyFindings) {
    for (const std::size_t n : {1U, 3U, 4U, 5U, 9U, 20U}) {
        Nested nested(n);
        std::vector<AuditFinding> findings;
        std::vector<std::size_t> all;
        for (std::size_t i = 0; i < n; ++i) {
            findings.push_back(finding_on(1, halved(i)));
            all.push_back(i);
        }
        const NestedCorrections corrections(nested.subject, findings);
        const std::vector<Effect> effects = corrections.effects_on(0, all);
        ASSERT_EQ(effects.size(), n);
        EXPECT_EQ(corrections.division(0, all).is_exact, n <= 4);
        EXPECT_LE(nested.asked.size(), n <= 4 ? 15U : 34U + 2U * n) << n;
        double shares = 0.0;
        for (const Effect& effect : effects) {
            shares += effect.share;
        }
        EXPECT_NEAR(shares, effects[0].audited.U / effects[0].claimed.U - 1.0, 1e-12) << n;
    }
}

TEST(NestedCorrections, StayWithTheirBudgetWhereNothingCanBeEvaluatedAgain) {
    Nested nested(2);
    nested.subject.nested->evaluate_again = [](const RowFactors&) -> std::vector<AuditedBudget> {
        throw gum::NoResultError(
            gum::Diagnostic{.code = "GC-AUDIT-0001", .where = "", .what = "nothing", .rule = "", .action = ""});
    };
    const std::vector<AuditFinding> findings{finding_on(1, halved(0))};
    EXPECT_TRUE(NestedCorrections(nested.subject, findings).findings().empty());
    nested.subject.nested.reset();
    EXPECT_TRUE(NestedCorrections(nested.subject, findings).findings().empty());
    EXPECT_FALSE(NestedCorrections(nested.subject, findings).is_nested(1));
}

/// The audit as a whole: the effect stands on the result, and E_n beside it where the result is another one.
TEST(NestedCorrections, ShowTheirEffectOnResultsAndOnTheScore) {
    Nested nested(2);
    static const std::vector<Rule> k_rules{
        {.id = "U10", .title = "halved", .examine = [](const AuditSubject&, FindingCollector& findings) {
             findings.add(finding_on(1, halved(0)));
         }}};
    AuditReport report = audit(nested.subject, k_rules);
    ASSERT_EQ(report.findings.size(), 1U);
    ASSERT_TRUE(report.findings[0].effect);
    EXPECT_EQ(report.findings[0].effect->budget, 0U);
    EXPECT_TRUE(report.findings[0].effect->alone.en);
    EXPECT_FALSE(report.findings[0].effect_on_score) << "it is the same result";
    EXPECT_TRUE(report.results[1].is_nested && !report.results[0].is_nested);

    // A second result without a reference, which the correction changes more.
    AuditSubject two = nested.subject;
    two.nested->dependent = {0, 2};
    two.budgets.push_back(budget_of({row("fixture", 0.2)}));
    two.nested->evaluate_again = [&nested](const RowFactors& factors) {
        return std::vector<AuditedBudget>{nested.result_with(factors),
                                          budget_of({row("fixture", 0.2 * factors[0][0])})};
    };
    report = audit(two, k_rules);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].effect->budget, 2U);
    ASSERT_TRUE(report.findings[0].effect_on_score);
    EXPECT_EQ(report.findings[0].effect_on_score->budget, 0U);
    EXPECT_NEAR(report.findings[0].effect_on_score->alone.u_c, std::hypot(0.1, 0.1, 0.3), 1e-12);
}

}  // namespace
}  // namespace gumcert::audit
