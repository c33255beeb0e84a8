#include "audit/claims.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "audit/budget_outcome.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {
namespace {

/// What arithmetic and copies between programs may leave.
constexpr double k_arithmetic = 1e-6;

bool is_whole_text(const std::string& text) {
    return !text.empty() && text.find_first_not_of("0123456789") == std::string::npos;
}

Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Widened by what arithmetic may leave.
Interval wide(const Interval& interval) {
    return {interval.low * (1.0 - k_arithmetic), interval.high * (1.0 + k_arithmetic)};
}

/// The number that stands for U may have been rounded up (JCGM 100:2008, 7.2.6).
Interval before_rounding_up(const StatedNumber& U) {
    const Interval printed = printed_interval(U);
    return {printed.low - 0.5 * (printed.high - printed.low), printed.high};
}

/// Rules of coverage that the claims leave open, that of the budget first.
std::vector<CoverageRule> possible_coverage(const AuditedBudget& budget) {
    std::vector<CoverageRule> rules = {budget.coverage};
    if (budget.claims.k) {
        rules.push_back(budget.coverage);
        rules.back().kind = CoverageRule::Kind::fixed;
        rules.back().k = budget.claims.k->value;
    }
    const double p = budget.claims.coverage_probability.value_or(budget.coverage.probability);
    std::vector<double> probabilities = {p};
    if (p > 0.94 && p < 0.96) {  // "95 %" is said of both
        probabilities = {p, 0.9545, 0.95};
    }
    for (const double probability : probabilities) {
        for (const bool truncate : {false, true}) {
            rules.push_back({.kind = CoverageRule::Kind::student_t,
                             .k = budget.coverage.k,
                             .probability = probability,
                             .truncate = truncate});
        }
    }
    return rules;
}

Interval allowed_k(const AuditedBudget& budget, const CoverageRule& rule) {
    if (rule.kind == CoverageRule::Kind::fixed) {
        const bool claimed = budget.claims.k && budget.claims.k->value == rule.k;
        return claimed ? hull(budget.claims.k->interval(), {rule.k, rule.k}) : Interval{rule.k, rule.k};
    }
    AuditedBudget by_rule = budget;
    by_rule.coverage = rule;
    return outcome_intervals(by_rule).k;
}

Interval allowed_U(const AuditedBudget& budget, const Interval& k, const Interval& u_c) {
    Interval U{k.low * u_c.low, k.high * u_c.high};
    if (budget.floor_applied && budget.capability) {
        U = {std::max(U.low, *budget.capability), std::max(U.high, *budget.capability)};
    }
    return wide(U);
}

/// Σ |c| u of the rows, as wide as their digits allow.
Interval linear_sum_of(const AuditedBudget& budget) {
    Interval sum;
    for (const AuditedRow& row : budget.rows) {
        if (row.in_sum) {
            const double c = std::abs(row.used_sensitivity);
            sum.low += std::max(0.0, c - row.sensitivity_half_step) * std::max(0.0, row.used_u - row.u_half_step);
            sum.high += (c + row.sensitivity_half_step) * (row.used_u + row.u_half_step);
        }
    }
    return wide(sum);
}

}  // namespace

Interval printed_interval(const StatedNumber& number) {
    double half = number.half_step;
    if (half == 0.0 && is_whole_text(number.text) && number.value != 0.0) {
        // Of "100" two digits are taken to be meant: no more than those are printed of an uncertainty.
        const std::size_t last = number.text.find_last_not_of('0');
        const std::size_t zeros =
            std::min(number.text.size() - 1 - last, number.text.size() - std::min<std::size_t>(number.text.size(), 2));
        half = 0.5 * std::pow(10.0, static_cast<double>(zeros));
    }
    half += k_arithmetic * std::abs(number.value);
    return {number.value - half, number.value + half};
}

ClaimCheck check_claims(const AuditedBudget& budget) {
    ClaimCheck check;
    check.coverage = budget.coverage;
    OutcomeIntervals allowed;
    try {
        static_cast<void>(evaluate(budget));
        allowed = outcome_intervals(budget);
    } catch (const gum::DiagnosedError&) {
        return check;
    }
    check.u_c = wide(allowed.u_c);
    Interval u_c = check.u_c;
    if (budget.claims.u_c) {
        const Interval claimed = printed_interval(*budget.claims.u_c);
        check.u_c_outside = !claimed.meets(check.u_c);
        u_c = check.u_c_outside ? claimed : hull(claimed, check.u_c);
        check.linear_sum = check.u_c_outside && budget.rows.size() > 1 && claimed.meets(linear_sum_of(budget));
    }
    check.U = allowed_U(budget, allowed.k, u_c);
    // A rule that gives the claimed k and U is the one that was used; else one that gives U.
    const std::vector<CoverageRule> rules = possible_coverage(budget);
    for (const bool with_k : {true, false}) {
        for (const CoverageRule& rule : rules) {
            const Interval k = allowed_k(budget, rule), U = allowed_U(budget, k, u_c);
            const bool gives_k = !budget.claims.k || wide(k).meets(budget.claims.k->interval());
            const bool gives_U = !budget.claims.U || before_rounding_up(*budget.claims.U).meets(U);
            if (gives_U && (gives_k || !with_k)) {
                check.coverage = rule;
                check.U = U;
                return check;
            }
        }
    }
    check.U_outside = true;
    return check;
}

void note_unexplained(AuditedBudget& budget) {
    budget.u_c_over_rows = budget.U_over_k_u_c = 1.0;
    const ClaimCheck check = check_claims(budget);
    budget.coverage = check.coverage;
    if (!check.u_c_outside && !check.U_outside) {
        return;
    }
    if (check.u_c_outside) {
        const double of_rows = evaluate(budget).u_c, claimed = budget.claims.u_c->value;
        budget.u_c_over_rows = claimed / of_rows;
    }
    if (check.U_outside) {
        const BudgetOutcome outcome = evaluate(budget);
        budget.U_over_k_u_c = budget.claims.U->value / (outcome.k * outcome.u_c);
    }
}

}  // namespace gumcert::audit
