#include "audit/claims.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/budget_outcome.h"
#include "audit/row_meaning.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {
namespace {

/// What arithmetic and copies between programs may leave.
constexpr double k_arithmetic = 1e-6;

Interval hull(const Interval& a, const Interval& b) {
    return {std::min(a.low, b.low), std::max(a.high, b.high)};
}

/// Widened by what arithmetic may leave.
Interval wide(const Interval& interval) {
    return {interval.low * (1.0 - k_arithmetic), interval.high * (1.0 + k_arithmetic)};
}

/// The number that stands for an uncertainty may have been rounded up (JCGM 100:2008, 7.2.6).
Interval before_rounding_up(const StatedNumber& number) {
    const Interval printed = printed_interval(number);
    // Rounded up, a number may have been up to a whole unit of its last digit smaller.
    return {printed.low - 0.5 * (printed.high - printed.low), printed.high};
}

/// t_p(ν_eff) with the probabilities that the claims leave open, ν_eff as it is or cut.
std::vector<CoverageRule> student_rules(const AuditedBudget& budget) {
    const double p = budget.claims.coverage_probability.value_or(budget.coverage.probability);
    std::vector<double> probabilities = {p};
    if (p > 0.94 && p < 0.96) {  // "95 %" is said of both
        probabilities = {p, 0.9545, 0.95};
    }
    std::vector<CoverageRule> rules;
    for (const CorrelatedRows correlated : {CorrelatedRows::one_contribution, CorrelatedRows::independent}) {
        for (const double probability : probabilities) {
            for (const bool truncate : {false, true}) {
                rules.push_back({.kind = CoverageRule::Kind::student_t,
                                 .k = budget.coverage.k,
                                 .probability = probability,
                                 .truncate = truncate,
                                 .correlated = correlated});
            }
        }
        if (budget.correlations.empty()) {
            break;  // rows are independent whatever a rule takes them for
        }
    }
    return rules;
}
/// Rules of coverage that take a k whatever ν_eff, that of the budget first.
std::vector<CoverageRule> fixed_rules(const AuditedBudget& budget) {
    std::vector<CoverageRule> rules = {budget.coverage};
    if (budget.claims.k) {
        rules.push_back(budget.coverage);
        rules.back().kind = CoverageRule::Kind::fixed;
        rules.back().k = budget.claims.k->value;
    }
    return rules;
}

/// Half a unit of the last digit of a claimed k. One known to all digits, as of a sheet with formulas, may have been typed or
/// rounded there: where it has two decimals or three, these are its digits. 0: nothing is left open.
double half_step_of_k(const Claims& claims) {
    const StatedNumber& k = *claims.k;
    const auto ends_at = [&k](double step) {
        const double steps = k.value / step;
        return std::abs(steps - std::round(steps)) <= 1e-9 * std::abs(steps);
    };
    if (k.half_step > 0.0 || (ends_at(1.0) && !claims.k_follows_nu)) {
        return k.half_step;  // of "2.1" the 0 of 2.10 may be hidden, of "2" it is none
    }
    return ends_at(0.01) ? 0.005 : ends_at(0.001) ? 0.0005 : 0.0;
}
Interval interval_of_k(const Claims& claims) {
    const double half = half_step_of_k(claims);
    return {claims.k->value - half, claims.k->value + half};
}

/// Whether k is claimed with two decimals or all digits of a computed number: "2" is what laboratories take whatever ν_eff.
bool has_decimals(const std::optional<StatedNumber>& k) {
    constexpr double k_two_decimals = 0.0051;
    if (!k || k->half_step > 0.0) {
        return k && k->half_step < k_two_decimals;
    }
    return std::abs(k->value - std::round(k->value)) > 1e-9 * std::abs(k->value);
}
/// Whether a claimed k may have been taken from ν_eff by a rule: its cell computes with it; or it has decimals, and is none of the numbers that stand for
/// all budgets, or ν_eff or the very probability of the rule stand beside it.
bool may_be_of_rule(const Claims& claims, const CoverageRule& rule) {
    if (claims.k && claims.k_follows_nu) {
        return true;
    }
    if (!has_decimals(claims.k)) {
        return false;
    }
    constexpr double k_for_all[] = {1.645, 1.65, 1.96, 2.0, 2.576, 2.58, 3.0};
    const bool usual = std::any_of(std::begin(k_for_all), std::end(k_for_all), [&claims](double k) {
        return std::abs(claims.k->value - k) <= 0.1 * half_step_of_k(claims) + k_arithmetic;
    });
    return !usual || claims.nu_eff || claims.coverage_probability == rule.probability;
}

/// \param nu_eff  what the rows allow of it
Interval allowed_k(const AuditedBudget& budget, const CoverageRule& rule, const Interval& nu_eff) {
    if (rule.kind == CoverageRule::Kind::student_t) {
        return student_factors(rule, nu_eff);
    }
    if (rule.kind == CoverageRule::Kind::fixed) {
        const bool claimed = budget.claims.k && budget.claims.k->value == rule.k;
        return claimed ? hull(budget.claims.k->interval(), {rule.k, rule.k}) : Interval{rule.k, rule.k};
    }
    return outcome_intervals(budget, rule).k;
}

/// What a printed ν_eff may have been: rounded, or cut to a whole number.
Interval before_cutting(const StatedNumber& nu_eff) {
    const Interval rounded = printed_interval(nu_eff);
    return {rounded.low, nu_eff.half_step == 0.0 ? std::max(rounded.high, nu_eff.value + 1.0) : rounded.high};
}

/// t_p of a printed ν_eff.
Interval factors_of(const CoverageRule& rule, const StatedNumber& nu_eff) {
    const Interval nu = printed_interval(nu_eff);
    return {gum::coverage_factor(rule.probability, std::max(1.0, nu.high)),
            gum::coverage_factor(rule.probability, std::max(1.0, rule.truncate ? std::floor(nu.low) : nu.low))};
}

Interval allowed_U(const AuditedBudget& budget, const Interval& k, const Interval& u_c) {
    Interval U{k.low * u_c.low, k.high * u_c.high};
    if (budget.floor_applied && budget.capability) {
        U = {std::max(U.low, *budget.capability), std::max(U.high, *budget.capability)};
    }
    return wide(U);
}

/// Whether a printed U is what remains of a larger one when the digits behind its last are cut.
bool is_cut(const StatedNumber& U, const Interval& uncut) {
    const double step = 2.0 * printed_half_step(U);
    return step > 0.0 && uncut.low > U.value && uncut.low < U.value + step;
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
    const double half = printed_half_step(number) + k_arithmetic * std::abs(number.value);
    return {number.value - half, number.value + half};
}

std::string text_of_claim(const StatedNumber& number) {
    std::string text = number.text;
    const std::size_t comma = text.rfind(','), point = text.rfind('.');
    if (comma == std::string::npos) {
        return text;
    }
    // The last of two signs is the decimal one; a comma alone is, where digits are open behind it.
    const bool is_decimal = point == std::string::npos ? number.half_step > 0.0 : comma > point;
    std::erase(text, is_decimal ? '.' : ',');
    std::replace(text.begin(), text.end(), ',', '.');
    return text;
}

bool is_normal_or_student(std::string_view name) {
    return name == "normal" || name == "gauss" || name == "gaussian" || name == "t" || name.starts_with("student");
}

ClaimCheck check_u_c(const AuditedBudget& budget) {
    ClaimCheck check;
    check.coverage = budget.coverage;
    try {
        static_cast<void>(evaluate(budget));
        check.allowed = outcome_intervals(budget);
    } catch (const gum::DiagnosedError&) {
        return check;
    }
    check.u_c = wide(check.allowed->u_c);
    check.nu_eff = check.allowed->nu_eff;
    if (budget.claims.u_c) {
        const Interval claimed = before_rounding_up(*budget.claims.u_c);
        check.u_c_outside = !claimed.meets(check.u_c);
        // Contributions that were added up instead of their squares are a known slip; told only where the claim is
        // explained by it.
        check.linear_sum = check.u_c_outside && budget.rows.size() > 1 && claimed.meets(linear_sum_of(budget));
    }
    return check;
}

namespace {

/// The claims by the rule of coverage that explains them; of k and ν_eff apart nothing is said.
ClaimCheck explained_claims(const AuditedBudget& budget) {
    const Claims& claims = budget.claims;
    ClaimCheck check = check_u_c(budget);
    if (!check.allowed) {
        return check;
    }
    const OutcomeIntervals allowed = *check.allowed;
    Interval u_c = check.u_c;
    if (claims.u_c) {
        const Interval claimed = before_rounding_up(*claims.u_c);
        // Where both hold, u_c is what both allow; U may have been computed from the printed one as well.
        u_c = check.u_c_outside ? claimed
                                : hull({std::max(claimed.low, check.u_c.low), std::min(claimed.high, check.u_c.high)},
                                       {claims.u_c->value, claims.u_c->value});
    }
    check.U = allowed_U(budget, allowed.k, u_c);
    const auto gives_U = [&](const Interval& k) {
        return !claims.U || before_rounding_up(*claims.U).meets(allowed_U(budget, k, u_c));
    };
    const auto gives_k = [&](const Interval& k) { return !claims.k || wide(k).meets(interval_of_k(claims)); };
    // U may have been computed with the k that is printed, or before that k was rounded, whatever else ν_eff leaves open.
    const auto with_claimed_k = [&](const Interval& k) {
        if (!claims.k) {
            return k;
        }
        const Interval printed = interval_of_k(claims), of_rule = wide(k);
        const Interval both{std::max(printed.low, of_rule.low), std::min(printed.high, of_rule.high)};
        return hull(both.low <= both.high ? both : k, {claims.k->value, claims.k->value});
    };
    const auto take = [&](const CoverageRule& rule, const Interval& k) {
        check.coverage = rule;
        check.U = allowed_U(budget, k, u_c);
    };
    const std::vector<CoverageRule> student = student_rules(budget);
    // The k of a ν_eff that the rows do not give: the claimed one.
    const bool nu_apart = claims.nu_eff && std::isfinite(claims.nu_eff->value) && claims.nu_eff->value >= 1.0 &&
                          !before_cutting(*claims.nu_eff).meets(wide(allowed.nu_eff));
    for (const CoverageRule& rule : student) {
        if (nu_apart && may_be_of_rule(claims, rule) && gives_k(factors_of(rule, *claims.nu_eff)) &&
            !gives_k(allowed_k(budget, rule, allowed.nu_eff)) && gives_U(claims.k->interval())) {
            take(rule, claims.k->interval());
            check.nu_eff_outside = true;
            return check;
        }
    }
    // A sheet that computes k with ν_eff otherwise than t_p(ν_eff) is taken at its own formula.
    if (budget.coverage.kind == CoverageRule::Kind::fixed && budget.coverage.k_of_nu) {
        const Interval k = allowed_k(budget, budget.coverage, allowed.nu_eff);
        if (gives_k(k) && gives_U(k)) {
            take(budget.coverage, k);
            return check;
        }
    }
    std::optional<CoverageRule> nearest;  // of those that give k and U, the one that gives k best
    double distance = 0.0;
    for (const CoverageRule& rule : student) {
        const Interval k = allowed_k(budget, rule, allowed.nu_eff);
        if (!may_be_of_rule(claims, rule) || !gives_k(k) || !gives_U(with_claimed_k(k))) {
            continue;
        }
        AuditedBudget by_rule = budget;
        by_rule.coverage = rule;
        by_rule.k_over_rows = 1.0;
        // Within the digits of the claimed k all rules give it alike, and the first of them is taken.
        const double half_step = half_step_of_k(claims);
        const double off = std::max(0.0, std::abs(evaluate(by_rule).k - claims.k->value) - half_step);
        if (!nearest || off < distance - half_step * k_arithmetic) {
            nearest = rule;
            distance = off;
        }
    }
    if (nearest) {
        take(*nearest, with_claimed_k(allowed_k(budget, *nearest, allowed.nu_eff)));
        return check;
    }
    // A rule that gives the claimed k and U is the one that was used; else one that gives U.
    std::vector<CoverageRule> rules = fixed_rules(budget);
    rules.insert(rules.end(), student.begin(), student.end());
    // From the rule that explains most of the claims to the one that explains least: a laboratory is accused of a
    // number only if no usual way to it is left.
    for (const bool with_k : {true, false}) {
        if (!with_k && claims.U && has_decimals(claims.k) &&
            is_cut(*claims.U, allowed_U(budget, claims.k->interval(), u_c))) {
            break;  // no other k is needed to explain it
        }
        for (const CoverageRule& rule : rules) {
            const Interval k = allowed_k(budget, rule, allowed.nu_eff);
            if (with_k ? gives_k(k) && gives_U(with_claimed_k(k)) : gives_U(k)) {
                take(rule, with_k ? with_claimed_k(k) : k);
                return check;
            }
        }
    }
    check.U_outside = true;
    return check;
}

}  // namespace

namespace {

/// Whether the ν_eff that is claimed beside a fixed k is rather that of correlated rows as one contribution, and below that of
/// independent rows: the table says itself how few degrees of freedom there are.
bool claims_few_of_one_contribution(const AuditedBudget& budget, const CoverageRule& coverage) {
    const std::optional<StatedNumber>& claimed = budget.claims.nu_eff;
    if (coverage.kind != CoverageRule::Kind::fixed || budget.correlations.empty() || !claimed ||
        !std::isfinite(claimed->value) || !(claimed->value > 0.0)) {
        return false;
    }
    const auto nu_eff = [&](CorrelatedRows correlated) {
        CoverageRule rule = coverage;
        rule.correlated = correlated;
        return evaluate(budget, rule).nu_eff;
    };
    const double as_one = nu_eff(CorrelatedRows::one_contribution), independent = nu_eff(CorrelatedRows::independent);
    return as_one < independent && claimed->value / as_one < independent / claimed->value;
}

}  // namespace

ClaimCheck check_claims(const AuditedBudget& budget) {
    ClaimCheck check = explained_claims(budget);
    if (!check.allowed) {
        return check;
    }
    const Claims& claims = budget.claims;
    if (claims_few_of_one_contribution(budget, check.coverage)) {
        check.coverage.correlated = CorrelatedRows::one_contribution;
    }
    check.nu_eff_apart = check.nu_eff_outside || (claims.nu_eff && std::isfinite(claims.nu_eff->value) &&
                                                  !before_cutting(*claims.nu_eff).meets(wide(check.allowed->nu_eff)));
    check.k_outside =
        check.nu_eff_outside ||
        (claims.k && !wide(allowed_k(budget, check.coverage, check.allowed->nu_eff)).meets(interval_of_k(claims)));
    return check;
}

namespace {

/// Half a unit of the last digit of a number without text; nothing of one that has so many that nobody rounded it.
std::optional<double> half_step_of_own_digits(const StatedNumber& number) {
    if (number.half_step != 0.0 || !number.text.empty() || !std::isfinite(number.value) || number.value == 0.0) {
        return std::nullopt;
    }
    constexpr int k_least_digits = 2, k_most_digits = 6;
    constexpr double k_arithmetic_of_sheets = 1e-9;
    const double first = std::floor(std::log10(std::abs(number.value)));
    for (int digits = k_least_digits; digits <= k_most_digits; ++digits) {
        const double step = std::pow(10.0, first - digits + 1);
        const double steps = number.value / step;
        if (std::abs(steps - std::round(steps)) <= k_arithmetic_of_sheets * std::abs(steps)) {
            return 0.5 * step;
        }
    }
    return std::nullopt;
}

}  // namespace

void settle_rounded_claims(AuditedBudget& budget) {
    const ClaimCheck exact = check_claims(budget);
    AuditedBudget rounded = budget;
    const auto round = [](std::optional<StatedNumber>& claim, bool is_outside) {
        const std::optional<double> half_step = claim && is_outside ? half_step_of_own_digits(*claim) : std::nullopt;
        if (half_step) {
            claim->half_step = *half_step;
        }
        return half_step.has_value();
    };
    if (round(rounded.claims.u_c, exact.u_c_outside)) {
        if (check_u_c(rounded).u_c_outside) {
            rounded.claims.u_c = budget.claims.u_c;
        } else {
            budget.claims.u_c = rounded.claims.u_c;
        }
    }
    // U of a u_c that was rounded is looked at again with it. It is the rounding of the claimed k times u_c, and of no other k.
    if (round(rounded.claims.U, exact.U_outside || check_claims(budget).U_outside)) {
        const ClaimCheck check = check_claims(rounded);
        if (!check.U_outside && !check.k_outside) {
            budget.claims.U = rounded.claims.U;
        }
    }
}

namespace {

/// Where the claimed u_c follows from what the rows divide over their divisors, and not from the u that some of them
/// print, the sum was made of the former: those u are errors of the page, which the result does not have.
void use_quotients_that_were_summed(AuditedBudget& budget) {
    if (budget.evaluated_here || !budget.claims.u_c ||
        std::none_of(budget.rows.begin(), budget.rows.end(), u_is_not_the_quotient) || !check_u_c(budget).u_c_outside) {
        return;
    }
    AuditedBudget divided = budget;
    for (AuditedRow& row : divided.rows) {
        if (u_is_not_the_quotient(row)) {
            use_quotient_of_columns(row);
        }
    }
    const ClaimCheck check = check_u_c(divided);
    if (check.allowed && !check.u_c_outside) {
        budget = std::move(divided);
    }
}

}  // namespace

void note_unexplained(AuditedBudget& budget) {
    use_quotients_that_were_summed(budget);
    note_claims_beyond_rows(budget);
}

void note_claims_beyond_rows(AuditedBudget& budget) {
    budget.u_c_over_rows = budget.k_over_rows = budget.U_over_k_u_c = 1.0;
    settle_rounded_claims(budget);
    const ClaimCheck check = check_claims(budget);
    budget.coverage = check.coverage;
    if (check.u_c_outside) {
        // A ratio and no difference of variances: with a smaller row a difference could become negative (ADR 0048,
        // decision 6).
        budget.u_c_over_rows = budget.claims.u_c->value / evaluate(budget).u_c;
    }
    if (check.nu_eff_outside) {
        budget.k_over_rows = budget.claims.k->value / evaluate(budget).k;
    }
    if (check.U_outside) {
        const BudgetOutcome outcome = evaluate(budget);
        budget.U_over_k_u_c = budget.claims.U->value / (outcome.k * outcome.u_c);
    }
}

AuditedBudget with_computed_claims(const AuditedBudget& budget) {
    AuditedBudget computed = budget;
    if (const std::optional<ComputedClaims>& given = budget.computed_claims) {
        computed.claims = given->claims;
        computed.coverage = given->coverage;
        computed.u_c_over_rows = given->u_c_over_rows;
        computed.k_over_rows = given->k_over_rows;
        computed.U_over_k_u_c = given->U_over_k_u_c;
        computed.computed_claims.reset();
    }
    return computed;
}

}  // namespace gumcert::audit
