#include "audit/budget_outcome.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <utility>
#include <vector>

#include "gum/comparison/scores.h"
#include "gum/conformity/conformity.h"
#include "gum/coverage.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {
namespace {

/// Σ (c u)² + 2 Σ c_i c_j u_i u_j r_ij.
double combined_variance(const AuditedBudget& budget) {
    double variance = 0.0;
    for (const AuditedRow& row : budget.rows) {
        const double part = contribution_of(row);
        variance += part * part;
    }
    for (const RowCorrelation& pair : budget.correlations) {
        const AuditedRow &a = budget.rows[pair.first], &b = budget.rows[pair.second];
        if (a.in_sum && b.in_sum) {
            variance += 2.0 * pair.r * a.used_sensitivity * a.used_u * b.used_sensitivity * b.used_u;
        }
    }
    return variance;
}

bool has_degrees_of_freedom(const AuditedRow& row) {
    return std::isfinite(row.used_nu) && row.used_nu > 0.0;
}

/// Σ (c u)⁴/ν of the rows as if they were independent, in units of u_c⁴: the fourth power of a contribution in metres may leave
/// the range of numbers.
double fourth_powers_of_rows(const AuditedBudget& budget, double u_c) {
    double sum = 0.0;
    for (const AuditedRow& row : budget.rows) {
        const double part = contribution_of(row) / u_c;
        sum += has_degrees_of_freedom(row) ? part * part * part * part / row.used_nu : 0.0;
    }
    return sum;
}

/// The same where rows that correlate are one contribution with the fewest degrees of freedom of one of them, as the evaluation
/// takes correlated inputs: the formula is one of independent contributions (JCGM 100:2008, G.4.1).
double fourth_powers_of_groups(const AuditedBudget& budget, double u_c) {
    std::vector<std::size_t> group(budget.rows.size());
    std::iota(group.begin(), group.end(), std::size_t{0});
    const auto is_correlated = [&budget](const RowCorrelation& pair) {
        return pair.r != 0.0 && budget.rows[pair.first].in_sum && budget.rows[pair.second].in_sum;
    };
    for (const RowCorrelation& pair : budget.correlations) {
        if (is_correlated(pair)) {
            const std::size_t joined = group[pair.first], other = group[pair.second];
            std::replace(group.begin(), group.end(), other, joined);
        }
    }
    std::vector<double> variance(group.size(), 0.0), nu(group.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < group.size(); ++i) {
        const double part = contribution_of(budget.rows[i]) / u_c;
        variance[group[i]] += part * part;
        if (has_degrees_of_freedom(budget.rows[i]) && part > 0.0) {
            nu[group[i]] = std::min(nu[group[i]], budget.rows[i].used_nu);
        }
    }
    for (const RowCorrelation& pair : budget.correlations) {
        if (is_correlated(pair)) {
            const AuditedRow &a = budget.rows[pair.first], &b = budget.rows[pair.second];
            variance[group[pair.first]] +=
                2.0 * pair.r * (a.used_sensitivity * a.used_u / u_c) * (b.used_sensitivity * b.used_u / u_c);
        }
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < group.size(); ++i) {
        sum += variance[i] * variance[i] / nu[i];
    }
    return sum;
}

double effective_degrees_of_freedom(const AuditedBudget& budget, CorrelatedRows correlated, double u_c) {
    const double beyond = budget.fourth_powers_beyond_rows / (u_c * u_c) / (u_c * u_c);
    double of_rows = fourth_powers_of_rows(budget, u_c);
    if (!budget.correlations.empty() && correlated != CorrelatedRows::independent) {
        const double of_groups = fourth_powers_of_groups(budget, u_c);
        of_rows = correlated == CorrelatedRows::one_contribution ? of_groups : std::min(of_rows, of_groups);
    }
    const double denominator = beyond + of_rows;
    return denominator > 0.0 ? budget.nu_eff_over_rows / denominator : std::numeric_limits<double>::infinity();
}

double truncated(double nu) {
    // 6.9999999999999 comes of the arithmetic and is 7.
    return std::isfinite(nu) ? std::max(1.0, std::floor(nu * (1.0 + 1e-12))) : nu;
}

/// What a slow function gives for a key. Many rules evaluate the budget that others evaluated before them: each thread
/// remembers the last values of the function, which depend on the key alone, so that nothing else changes by it.
template <typename Key, typename Function>
double remembered(std::map<Key, double>& known, Key key, const Function& function) {
    constexpr std::size_t k_most = 4096;
    if (const auto found = known.find(key); found != known.end()) {
        return found->second;
    }
    const double value = function();
    if (known.size() == k_most) {
        known.clear();
    }
    known.emplace(std::move(key), value);
    return value;
}

double student_factor(const CoverageRule& rule, double nu) {
    static thread_local std::map<std::pair<double, double>, double> known;
    const double used = rule.truncate ? truncated(nu) : nu;
    return remembered(known, std::pair(rule.probability, used),
                      [&] { return gum::coverage_factor(rule.probability, used); });
}

/// The distribution that a row has in the sum of all, about 0.
gum::Distribution distribution_of(const AuditedRow& row) {
    gum::Distribution distribution;
    distribution.scale = row.used_u;
    distribution.kind = gum::DistributionKind::normal;
    switch (row.shape) {
        case Shape::rectangular:
            distribution.kind = gum::DistributionKind::uniform;
            // Half-width a of u = a/√3; below √6 of the triangular and √2 of the arcsine distribution (JCGM 100:2008,
            // 4.3.7; JCGM 101:2008, 6.4).
            distribution.scale = row.used_u * std::sqrt(3.0);
            break;
        case Shape::triangular:
            distribution.kind = gum::DistributionKind::triangular;
            distribution.scale = row.used_u * std::sqrt(6.0);
            break;
        case Shape::arcsine:
            distribution.kind = gum::DistributionKind::arcsine;
            distribution.scale = row.used_u * std::sqrt(2.0);
            break;
        default:
            if (std::isfinite(row.used_nu)) {
                distribution = gum::Distribution::student_t(0.0, row.used_u, row.used_nu);
            }
    }
    return distribution;
}

/// All that a convolution of terms depends on, which are such as distribution_of() makes.
std::vector<double> key_of(const std::vector<gum::ConvolutionTerm>& terms) {
    std::vector<double> key;
    for (const gum::ConvolutionTerm& term : terms) {
        const gum::Distribution& d = term.distribution;
        key.insert(key.end(), {term.sensitivity, static_cast<double>(d.kind), d.scale, d.shape});
    }
    return key;
}

/// Half-width of the coverage interval by convolution, [unit of y], which takes a thousand times as long as the rest.
double remembered_half_width(const std::vector<gum::ConvolutionTerm>& terms, double probability) {
    static thread_local std::map<std::vector<double>, double> known;
    std::vector<double> key = key_of(terms);
    key.push_back(probability);
    return remembered(known, std::move(key), [&] { return gum::convolution_half_width(terms, probability); });
}

/// The distribution itself. A table of one may take a megabyte: only the last ones are kept.
gum::ConvolutionDistribution remembered_distribution(const std::vector<gum::ConvolutionTerm>& terms) {
    constexpr std::size_t k_most = 8;
    static thread_local std::map<std::vector<double>, gum::ConvolutionDistribution> known;
    std::vector<double> key = key_of(terms);
    if (const auto found = known.find(key); found != known.end()) {
        return found->second;
    }
    if (known.size() == k_most) {
        known.clear();
    }
    return known.emplace(std::move(key), gum::ConvolutionDistribution(terms)).first->second;
}

std::vector<gum::ConvolutionTerm> terms_of(const AuditedBudget& budget) {
    std::vector<gum::ConvolutionTerm> terms;
    for (const AuditedRow& row : budget.rows) {
        if (contribution_of(row) > 0.0) {
            terms.push_back({.sensitivity = row.used_sensitivity, .distribution = distribution_of(row)});
        }
    }
    return terms;
}

/// k as gum/budget takes it: that of the convolution of the rows where it is noticed beside t_p(ν_eff).
/// \param u_c  of the rows
double chosen_factor(const AuditedBudget& budget, const CoverageRule& coverage, double u_c, double nu) {
    const std::vector<gum::ConvolutionTerm> terms = terms_of(budget);
    std::vector<double> contributions;
    for (const AuditedRow& row : budget.rows) {
        if (contribution_of(row) > 0.0) {
            contributions.push_back(contribution_of(row));
        }
    }
    if (!gum::convolution_changes_little(terms, contributions, coverage.probability)) {
        CoverageRule uncut = coverage;
        uncut.truncate = false;  // it is cut after the choice
        const double convolved = remembered_half_width(terms, coverage.probability) / u_c;
        if (gum::is_noticed_change(convolved, student_factor(uncut, nu))) {
            return convolved;
        }
    }
    return student_factor(coverage, nu);
}

/// A convolution is the distribution of a sum of independent quantities.
bool is_convolution(const AuditedBudget& budget, const CoverageRule& coverage, double u_c, double nu) {
    if (!budget.correlations.empty() || coverage.kind == CoverageRule::Kind::fixed) {
        return false;
    }
    return coverage.chosen_anew ? chosen_factor(budget, coverage, u_c, nu) != student_factor(coverage, nu)
                                : coverage.kind == CoverageRule::Kind::convolution;
}

double coverage_factor_of(const AuditedBudget& budget, const CoverageRule& coverage, double u_c, double nu) {
    if (coverage.kind == CoverageRule::Kind::fixed) {
        return coverage.k_of_nu ? (*coverage.k_of_nu)(nu).value_or(coverage.k) : coverage.k;
    }
    // With correlations t_p(ν_eff) is taken.
    if (budget.correlations.empty() && coverage.chosen_anew) {
        return chosen_factor(budget, coverage, u_c, nu);
    }
    if (is_convolution(budget, coverage, u_c, nu)) {
        return remembered_half_width(terms_of(budget), coverage.probability) / u_c;
    }
    return student_factor(coverage, nu);
}

bool has_limits(const gum::ToleranceLimits& limits) {
    return limits.lower.has_value() || limits.upper.has_value();
}

/// Whether the distribution of the result is the convolution of the rows as distribution_of() has them: they are independent,
/// none has a shape of another kind, and they are as wide as the result. Correlations and terms of second order, of a record of
/// ours a number alone, belong to another distribution, which nobody knows here.
bool is_convolution_of_rows(const AuditedBudget& budget, double u_of_rows) {
    constexpr double k_rounding = 1e-9;
    double variance = 0.0;
    for (const AuditedRow& row : budget.rows) {
        const double part = contribution_of(row) / u_of_rows;
        variance += part * part;
        if (part > 0.0 && (row.shape == Shape::trapezoidal || row.shape == Shape::other)) {
            return false;
        }
    }
    return budget.correlations.empty() && std::abs(variance - 1.0) <= k_rounding;
}

/// \param u_of_rows  what their contributions combine to
void decide(const AuditedBudget& budget, const CoverageRule& coverage, double u_of_rows, BudgetOutcome& outcome) {
    if (!budget.rule || !has_limits(budget.limits) || !outcome.value || !(outcome.U > 0.0)) {
        return;
    }
    const bool by_probability = gum::decides_by_probability(*budget.rule, budget.rule_parameters);
    if (by_probability && !budget.has_known_distribution) {
        return;
    }
    // A raised U has its k: u is what both say.
    const double u = outcome.at_capability ? outcome.U / outcome.k : outcome.u_c;
    gum::MeasuredValue y{.value = *outcome.value,
                         .standard_uncertainty = u,
                         .expanded_uncertainty = outcome.U,
                         .degrees_of_freedom = outcome.nu_eff};
    // Also where k is that of t_p(ν_eff): one that agrees at 95 % says nothing of the tails.
    const std::vector<gum::ConvolutionTerm> terms = terms_of(budget);
    if (by_probability && !terms.empty() && !gum::is_normal_or_student(terms)) {
        if (!is_convolution_of_rows(budget, u_of_rows)) {
            return;
        }
        // As wide as what is stated: k and p hold for that U as they do for that of the rows.
        const double stretch = is_convolution(budget, coverage, u_of_rows, outcome.nu_eff)
                                   ? remembered_half_width(terms, coverage.probability) / outcome.U
                                   : u_of_rows / u;
        const gum::ConvolutionDistribution sum = remembered_distribution(terms);
        y.least_probability = sum.least_probability();
        y.distribution = [sum, value = y.value, stretch](double x) { return sum((x - value) * stretch); };
    }
    try {
        outcome.verdict =
            gum::verdict_name(gum::decide_conformity(*budget.rule, budget.rule_parameters, budget.limits, y).verdict);
    } catch (const gum::DiagnosedError& error) {
        outcome.verdict = k_no_decision;
        outcome.undecided = error.diagnostics();
    }
}

/// E_n of a value that the reference is compared with.
double score_of(const ComparedReference& reference, double value, double U_difference) {
    if (reference.largest_difference) {
        return gum::settled_score(*reference.largest_difference, 0.0, U_difference);
    }
    return reference.budget_is_reference ? gum::settled_score(reference.value, value, U_difference)
                                         : gum::settled_score(value, reference.value, U_difference);
}

void compare(const AuditedBudget& budget, BudgetOutcome& outcome) {
    if (!outcome.value || !budget.reference) {
        return;
    }
    try {
        const double U_difference = gum::uncertainty_of_difference(outcome.U, budget.reference->expanded_uncertainty,
                                                                   budget.reference->correlation);
        if (U_difference > 0.0) {
            outcome.en = score_of(*budget.reference, *outcome.value, U_difference);
        }
    } catch (const gum::DiagnosedError& error) {
        outcome.undecided.insert(outcome.undecided.end(), error.diagnostics().begin(), error.diagnostics().end());
    }
}

/// One unit of the last of some significant digits.
double step_of_digits(double number, int digits) {
    return std::pow(10.0, std::floor(std::log10(number)) - digits + 1);
}

/// Whether U is rounded like the one that is stated, which the laboratory made of another number than the rows give: from
/// U = 2 × 15.3 = 30.6 it states 31, and the rows give 30.496. Between both nothing else is printed, and on the side of the rows
/// nothing up to half a unit.
bool is_rounded_as_stated(const AuditedBudget& budget, const UncorrectedU& before, double U) {
    const double step = step_of_digits(before.stated, budget.digits);
    const auto rounded = [&budget](double number) {
        return gum::round_to_uncertainty(0.0, number, budget.digits, budget.rounding).U;
    };
    if (before.step > step * (1.0 + 1e-9) || rounded(before.stated) == rounded(before.evaluated)) {
        return false;
    }
    return before.evaluated < before.stated ? before.evaluated - 0.5 * step <= U && U <= before.stated
                                            : before.stated <= U && U <= before.evaluated + 0.5 * step;
}

/// Whether U is no other number than what is stated: 0.02 is stated where the rows give 0.0234, and 0.022, which lies between, is no
/// change of either. Beyond both a U of one digit is held against as many digits as the budget has: 1.35 is not the 1 that is stated.
bool is_within_statement(const AuditedBudget& budget, const UncorrectedU& before, double U) {
    constexpr double k_half = 0.5 * (1.0 + 1e-9);
    const double step = std::min(before.step, step_of_digits(before.stated, budget.digits));
    const bool is_between =
        std::min(before.stated, before.evaluated) <= U && U <= std::max(before.stated, before.evaluated);
    return is_between || std::abs(U - before.stated) <= k_half * step;
}

/// Significant digits of a corrected U: those of the budget, or to the last place of the U that is stated, which would else be
/// told of another number than it is: 2.05 and not 2.0.
int printed_digits(const AuditedBudget& budget, const UncorrectedU* before, double U) {
    constexpr int k_most_digits = 6;
    if (before == nullptr || before->text.empty() || !(before->step > 0.0) || !(U > 0.0)) {
        return budget.digits;
    }
    const double digits = std::floor(std::log10(U)) - std::round(std::log10(before->step)) + 1.0;
    return digits > budget.digits && digits <= k_most_digits ? static_cast<int>(digits) : budget.digits;
}

void print(const AuditedBudget& budget, BudgetOutcome& outcome) {
    constexpr double k_unchanged = 5e-4;  // what prints as 0.0 %
    const UncorrectedU* before = budget.uncorrected_U ? &*budget.uncorrected_U : nullptr;
    const bool has_text = before != nullptr && !before->text.empty();
    const bool is_rounded = before != nullptr && is_rounded_as_stated(budget, *before, outcome.U);
    const bool is_stated = has_text && (std::abs(outcome.U / before->evaluated - 1.0) < k_unchanged || is_rounded ||
                                        is_within_statement(budget, *before, outcome.U));
    const bool is_as_stated =
        is_rounded || (is_stated && before->step > step_of_digits(before->stated, budget.digits) * (1.0 + 1e-9));
    const double value = outcome.value.value_or(0.0), U = is_as_stated ? before->stated : outcome.U;
    const gum::RoundedPair printed = gum::round_to_uncertainty(value, U, budget.digits, budget.rounding);
    outcome.printed_value = outcome.value ? printed.value : "";
    outcome.printed_U = outcome.rounded_U = printed.U;
    outcome.is_held_against_statement = has_text;
    if (is_stated) {
        outcome.printed_U = before->text;
    } else if (!is_as_stated) {
        outcome.printed_U = gum::round_to_uncertainty(value, U, printed_digits(budget, before, U), budget.rounding).U;
    }
}

}  // namespace

bool verdict_turns(std::string_view before, std::string_view after) {
    const auto is_one = [](std::string_view verdict) { return !verdict.empty() && verdict != k_no_decision; };
    return before != after && is_one(before) && is_one(after);
}

double contribution_of(const AuditedRow& row) {
    return row.in_sum ? std::abs(row.used_sensitivity) * row.used_u : 0.0;
}

BudgetOutcome evaluate(const AuditedBudget& budget) {
    return evaluate(budget, budget.coverage);
}

BudgetOutcome evaluate(const AuditedBudget& budget, const CoverageRule& coverage) {
    BudgetOutcome outcome;
    outcome.value = budget.value;
    const double of_tangent = combined_variance(budget) + budget.correlation_variance;
    const double variance = of_tangent + budget.variance_beyond_tangent;
    if (!(variance > 0.0) || !std::isfinite(variance)) {
        throw gum::NoResultError({.code = "GC-AUDIT-0001",
                                  .where = budget.name.empty() ? budget.place : budget.name,
                                  .what = "the rows of the budget give no combined standard uncertainty above 0",
                                  .rule = "a budget is audited where its rows add up to u_c > 0",
                                  .action = "state u and sensitivity of the rows; check the correlations"});
    }
    const double u_of_rows = std::sqrt(variance);
    outcome.u_c = u_of_rows * budget.u_c_over_rows * budget.within_digits;
    // From the rows: what a claimed u_c has beyond them has no degrees of freedom that anybody stated.
    outcome.nu_eff =
        effective_degrees_of_freedom(budget, coverage.correlated, of_tangent > 0.0 ? std::sqrt(of_tangent) : u_of_rows);
    outcome.k = coverage_factor_of(budget, coverage, u_of_rows, outcome.nu_eff) * budget.k_over_rows;
    outcome.U = outcome.k * outcome.u_c * budget.U_over_k_u_c * budget.U_within_digits;
    if (budget.floor_applied && budget.capability && *budget.capability > outcome.U) {
        outcome.U = *budget.capability;
        outcome.at_capability = true;
    }
    print(budget, outcome);
    decide(budget, coverage, u_of_rows, outcome);
    compare(budget, outcome);
    return outcome;
}

double difference_of_score(double en, double U, const ComparedReference& reference) {
    return en * gum::uncertainty_of_difference(U, reference.expanded_uncertainty, reference.correlation);
}

Interval student_factors(const CoverageRule& rule, const Interval& nu_eff) {
    const double fewest = std::max(0.5, nu_eff.low);
    return {student_factor(rule, std::max(fewest, nu_eff.high)), student_factor(rule, fewest)};
}

namespace {

/// The least and the largest x² + y² + 2 r x y of two contributions, with r as far as one decimal leaves it open.
Interval variance_of_pair(const Interval& x, const Interval& y, double r) {
    constexpr double k_one_decimal = 0.05;
    const double lowest = std::clamp(r - k_one_decimal, -1.0, 1.0), highest = std::clamp(r + k_one_decimal, -1.0, 1.0);
    const auto sum = [](double a, double b, double correlation) { return a * a + b * b + 2.0 * correlation * a * b; };
    // The form is convex: the largest is that of a corner, the least that of an edge, where it has its own minimum.
    Interval variance{sum(x.low, y.low, lowest), sum(x.low, y.low, highest)};
    for (const double a : {x.low, x.high}) {
        for (const double b : {y.low, y.high}) {
            variance.high = std::max(variance.high, sum(a, b, highest));
            variance.low = std::min({variance.low, sum(a, std::clamp(-lowest * a, y.low, y.high), lowest),
                                     sum(std::clamp(-lowest * b, x.low, x.high), b, lowest)});
        }
    }
    return variance;
}

}  // namespace

OutcomeIntervals outcome_intervals(const AuditedBudget& budget) {
    return outcome_intervals(budget, budget.coverage);
}

OutcomeIntervals outcome_intervals(const AuditedBudget& budget, const CoverageRule& coverage) {
    // What a part of the sum may be at least and at most.
    const auto part = [](const AuditedRow& row) {
        if (!row.in_sum) {
            return Interval{0.0, 0.0};
        }
        const double c = std::abs(row.used_sensitivity);
        Interval range{std::max(0.0, c - row.sensitivity_half_step) * std::max(0.0, row.used_u - row.u_half_step),
                       (c + row.sensitivity_half_step) * (row.used_u + row.u_half_step)};
        // The column of contributions may be what was added up, which was rounded by itself. It is what |c| u gives however few digits
        // a conversion of 0.001 ns/ps has; else |c| u was taken as it is printed.
        if (row.contribution) {
            const Interval printed{std::max(0.0, std::abs(row.contribution->value) - row.contribution->half_step),
                                   std::abs(row.contribution->value) + row.contribution->half_step};
            const double product = c * row.used_u;
            const bool agree = range.meets(printed);
            range = agree ? Interval{std::min(product, printed.low), std::max(product, printed.high)}
                          : Interval{std::min(range.low, printed.low), std::max(range.high, printed.high)};
        }
        return range;
    };
    double low = budget.correlation_variance, high = budget.correlation_variance;
    for (const AuditedRow& row : budget.rows) {
        const Interval range = part(row);
        low += range.low * range.low;
        high += range.high * range.high;
    }
    for (const RowCorrelation& pair : budget.correlations) {
        const AuditedRow &a = budget.rows[pair.first], &b = budget.rows[pair.second];
        const Interval x = part(a), y = part(b);
        const double sign = a.used_sensitivity * b.used_sensitivity < 0.0 ? -2.0 : 2.0;
        const double one = sign * pair.r * x.low * y.low, other = sign * pair.r * x.high * y.high;
        // The product of both intervals lies between its ends; added with the sign that makes the bound safe.
        low += std::min(one, other);
        high += std::max(one, other);
    }
    // Of two rows that correlate with each other alone, what both may be together is known: of a difference the bound above
    // would be from 0 to more than both as independent ones, where u has one digit.
    Interval variance{low, high}, together{budget.correlation_variance, budget.correlation_variance};
    std::vector<std::size_t> pairs_of_row(budget.rows.size(), 0);
    for (const RowCorrelation& pair : budget.correlations) {
        ++pairs_of_row[pair.first];
        ++pairs_of_row[pair.second];
    }
    const auto is_lone = [&](const RowCorrelation& pair) {
        return pair.first != pair.second && pairs_of_row[pair.first] == 1 && pairs_of_row[pair.second] == 1;
    };
    if (!budget.correlations.empty() && std::all_of(budget.correlations.begin(), budget.correlations.end(), is_lone)) {
        for (std::size_t i = 0; i < budget.rows.size(); ++i) {
            const Interval range = pairs_of_row[i] == 0 ? part(budget.rows[i]) : Interval{0.0, 0.0};
            together = {together.low + range.low * range.low, together.high + range.high * range.high};
        }
        for (const RowCorrelation& pair : budget.correlations) {
            const AuditedRow &a = budget.rows[pair.first], &b = budget.rows[pair.second];
            const bool is_difference = a.used_sensitivity * b.used_sensitivity < 0.0;
            const Interval both = variance_of_pair(part(a), part(b), is_difference ? -pair.r : pair.r);
            together = {together.low + both.low, together.high + both.high};
        }
        variance = {std::max(low, together.low), std::min(high, together.high)};
    }
    OutcomeIntervals intervals;
    const double beyond = budget.variance_beyond_tangent;
    intervals.u_c = {std::sqrt(std::max(0.0, variance.low + beyond)), std::sqrt(std::max(0.0, variance.high + beyond))};

    double least = 0.0, most = 0.0;
    for (const AuditedRow& row : budget.rows) {
        if (std::isfinite(row.used_nu) && row.used_nu > 0.0) {
            const Interval range = part(row);
            least += std::pow(range.low, 4) / row.used_nu;
            most += std::pow(range.high, 4) / row.used_nu;
        }
    }
    const double infinite = std::numeric_limits<double>::infinity();
    // The smallest u_c over the largest terms, and the other way round: an outer bound, for both do not occur together.
    low = std::max(0.0, low);
    high = std::max(0.0, high);
    const double of_evaluation = budget.nu_eff_over_rows;
    intervals.nu_eff = {most > 0.0 ? of_evaluation * low * low / most : infinite,
                        least > 0.0 ? of_evaluation * high * high / least : infinite};
    const double of_tangent = combined_variance(budget) + budget.correlation_variance;
    if (!budget.correlations.empty() && of_tangent > 0.0) {
        // Rows that correlate are one contribution, or were taken for independent ones: as wide by their digits.
        const auto nu_eff = [&](CorrelatedRows correlated) {
            return effective_degrees_of_freedom(budget, correlated, std::sqrt(of_tangent));
        };
        const double independent = nu_eff(CorrelatedRows::independent),
                     as_one = nu_eff(CorrelatedRows::one_contribution);
        // Of rows that cancel nothing remains that has degrees of freedom: infinitely many are allowed then.
        const double ratio = std::isfinite(independent) ? as_one / independent : 1.0;
        intervals.nu_eff = {std::min(1.0, ratio) * intervals.nu_eff.low, std::max(1.0, ratio) * intervals.nu_eff.high};
    }
    if (coverage.kind == CoverageRule::Kind::fixed) {
        intervals.k = {coverage.k, coverage.k};
    } else if (coverage.kind == CoverageRule::Kind::convolution || coverage.chosen_anew) {
        const BudgetOutcome outcome = evaluate(budget, coverage);
        intervals.k = {outcome.k, outcome.k};
    } else {
        intervals.k = student_factors(coverage, intervals.nu_eff);
    }
    intervals.U = {intervals.k.low * intervals.u_c.low, intervals.k.high * intervals.u_c.high};
    if (budget.floor_applied && budget.capability) {
        intervals.U = {std::max(intervals.U.low, *budget.capability), std::max(intervals.U.high, *budget.capability)};
    }
    return intervals;
}

}  // namespace gumcert::audit
