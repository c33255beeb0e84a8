#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "audit/claims.h"
#include "audit/row_edits.h"
#include "audit/row_facts.h"
#include "audit/rules/registry.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"
#include "text/small_letters.h"

namespace gumcert::audit {
namespace {

// That of k = 2 and a normal distribution.
constexpr double k_usual_probability = 0.9545;

/// Walks over budgets with an outcome.
template <typename Look>
void for_each_outcome(const AuditSubject& subject, const Look& look) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        try {
            look(b, subject.budgets[b], evaluate(subject.budgets[b]));
        } catch (const gum::DiagnosedError&) {
            continue;  // said where results are listed
        }
    }
}

/// The same over budgets that somebody else evaluated: our own k and U need no second look.
template <typename Look>
void for_each_foreign_outcome(const AuditSubject& subject, const Look& look) {
    for_each_outcome(subject, [&look](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        if (!budget.evaluated_here) {
            look(b, budget, outcome);
        }
    });
}

Sentence range_in_words(const Interval& interval, const std::string& unit) {
    return say("{low:number} to {high:number}", in_words(interval.low), in_words(interval.high, unit));
}

std::string claimed_in_words(const StatedNumber& number, const std::string& unit) {
    return number.text.empty() ? in_words(number.value, unit)
                               : text_of_claim(number) + (unit.empty() ? "" : " " + printed_unit(unit));
}

const Correction k_trust_rows = [](AuditedBudget& budget) {
    budget.u_c_over_rows = budget.k_over_rows = budget.U_over_k_u_c = 1.0;
};

/// K01 of a row: |c| u beside a column of contributions that says otherwise, and that the sum was taken of.
void contribution_not_reproducible(const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&findings](const RowAt& at) {
        const AuditedRow& row = at.is;
        if (at.of.evaluated_here || !row.sensitivity || !row.contribution ||
            is_about(row.used_sensitivity, row.sensitivity->value, 1e-12)) {
            return;
        }
        const double c = row.sensitivity->value;
        AuditFinding finding = finding_at(
            at, "contribution",
            say("the contribution {contribution:number} is not |c| u = {c_u:number}",
                claimed_in_words(*row.contribution, at.of.unit), in_words(std::abs(c) * row.used_u, at.of.unit)));
        finding.evidence = {equals("c", in_words(c)), equals("u", in_words(row.used_u, row.unit))};
        // In converted units c² is a number of nobody: 100 A/V is 0.1 mA/µV.
        if (row.sensitivity->scale == 1.0 && is_about(std::abs(row.contribution->value), c * c * row.used_u, 0.01)) {
            finding.evidence.push_back(say("it is c² u: the coefficient was multiplied twice"));
        }
        finding.expected = say_number(in_words(std::abs(c) * row.used_u, at.of.unit));
        finding.actual = say_number(claimed_in_words(*row.contribution, at.of.unit));
        // Without a column of u it is made of what is divided: a contribution that the words of the row give, or a column that is
        // not read (how many readings there are), is asked about, as it is beside a column of u.
        const std::optional<double> by_words = row.u ? std::nullopt : u_by_words(row);
        const bool is_explained =
            by_words && is_about(std::abs(row.contribution->value), std::abs(c) * *by_words, 0.01);
        if (is_explained || (!row.u && !at.of.unread_columns.empty())) {
            findings.add(std::move(finding), FindingSeverity::minor);
            return;
        }
        finding.correct = set_sensitivity(at.row, c);
        findings.add(std::move(finding));
    });
}

/// Whether the claimed u_c, or U, follows where some rows correlate.
bool follows_with(const AuditedBudget& budget, const std::vector<RowCorrelation>& correlations) {
    AuditedBudget with = budget;
    with.u_c_over_rows = with.U_over_k_u_c = 1.0;
    with.correlations.insert(with.correlations.end(), correlations.begin(), correlations.end());
    const ClaimCheck check = check_claims(with);
    return check.allowed && !check.u_c_outside && (budget.claims.u_c || !check.U_outside);
}

/// A correlation that is stated without its rows, of rows of which it explains the claimed u_c, or the claimed U: of two, or
/// of each pair of several below each other, as of three masses that were calibrated together. Empty where there are none.
std::vector<RowCorrelation> explaining_correlation(const AuditedBudget& budget) {
    constexpr std::size_t k_most_rows = 40, k_most_correlations = 8, k_most_together = 8;
    // Each once, for each is tried with all pairs of rows: a thousand notes would take half a minute.
    std::vector<double> tried;
    for (const std::vector<double>* const list : {&budget.unread_correlations, &budget.noted_correlations}) {
        for (const double r : *list) {
            if (tried.size() < k_most_correlations && std::find(tried.begin(), tried.end(), r) == tried.end()) {
                tried.push_back(r);
            }
        }
    }
    const std::size_t rows = std::min(budget.rows.size(), k_most_rows);
    for (const double r : tried) {
        for (std::size_t i = 0; i < rows; ++i) {
            for (std::size_t j = i + 1; j < rows; ++j) {
                if (std::vector<RowCorrelation> pair{{.first = i, .second = j, .r = r}}; follows_with(budget, pair)) {
                    return pair;
                }
            }
        }
        for (std::size_t first = 0; first + 2 < rows; ++first) {
            std::vector<RowCorrelation> together{{.first = first, .second = first + 1, .r = r}};
            for (std::size_t last = first + 2; last < std::min(rows, first + k_most_together); ++last) {
                for (std::size_t i = first; i < last; ++i) {
                    together.push_back({.first = i, .second = last, .r = r});
                }
                // Below −1/(n − 1) n quantities cannot all have it with each other.
                if (r * static_cast<double>(last - first) >= -1.0 && follows_with(budget, together)) {
                    return together;
                }
            }
        }
    }
    return {};
}

/// \param explaining  not empty
void add_as_question(const AuditedBudget& budget, const std::vector<RowCorrelation>& explaining, AuditFinding finding,
                     FindingCollector& findings) {
    const std::string r = in_words(explaining.front().r);
    const Sentence first = name_of_row(budget, explaining.front().first),
                   last = name_of_row(budget, explaining.back().second);
    finding.evidence.push_back(
        explaining.size() == 1
            ? say("with r = {r:number} of {first} and {second} it follows", r, first, last)
            : say("with r = {r:number} of each pair of rows from {first} to {last} it follows", r, first, last));
    finding.question = "Which rows does the stated correlation belong to?";
    findings.add(std::move(finding), FindingSeverity::minor);
}

/// K01
void not_reproducible(const AuditSubject& subject, FindingCollector& findings) {
    contribution_not_reproducible(subject, findings);
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget budget = with_computed_claims(subject.budgets[b]);  // W17 has what the file shows instead
        if (budget.evaluated_here) {
            continue;
        }
        const ClaimCheck check = check_claims(budget);
        if (check.u_c_outside && !check.linear_sum) {  // K09
            AuditFinding finding =
                finding_of(subject, b,
                           say("the claimed u_c = {u_c:number} does not follow from the rows, whatever their rounding",
                               claimed_in_words(*budget.claims.u_c, budget.unit)));
            finding.evidence = {say("the rows allow {u_c}", range_in_words(check.u_c, budget.unit))};
            finding.expected = range_in_words(check.u_c, budget.unit);
            finding.actual = say_number(claimed_in_words(*budget.claims.u_c, budget.unit));
            finding.kind = "u_c";
            if (const std::vector<RowCorrelation> explaining = explaining_correlation(budget); !explaining.empty()) {
                add_as_question(budget, explaining, std::move(finding), findings);
            } else {
                // ν_eff of the sum that is claimed goes with it.
                finding.correct = [](AuditedBudget& corrected) {
                    corrected.u_c_over_rows = corrected.k_over_rows = 1.0;
                };
                findings.add(std::move(finding));
            }
        }
        if (check.nu_eff_outside && !check.u_c_outside) {
            AuditFinding finding =
                finding_of(subject, b,
                           say("k = {k:number} is that of ν_eff = {nu_eff:number}, which the rows do not give, "
                               "whatever their rounding",
                               claimed_in_words(*budget.claims.k, ""), claimed_in_words(*budget.claims.nu_eff, "")));
            finding.evidence = {say("the rows allow ν_eff = {nu_eff}", range_in_words(check.nu_eff, ""))};
            finding.expected = range_in_words(check.nu_eff, "");
            finding.actual = say_number(claimed_in_words(*budget.claims.nu_eff, ""));
            finding.kind = "nu_eff";
            finding.correct = [](AuditedBudget& corrected) { corrected.k_over_rows = 1.0; };
            findings.add(std::move(finding));
        }
        if (check.U_outside) {
            AuditFinding finding =
                finding_of(subject, b,
                           say("the claimed U = {U:number} is not k u_c, whatever the rounding of its rows",
                               claimed_in_words(*budget.claims.U, budget.unit)));
            finding.evidence = {say("k u_c allows {U}", range_in_words(check.U, budget.unit))};
            if (budget.claims.k) {
                finding.evidence.push_back(say("claimed k = {k:number}", claimed_in_words(*budget.claims.k, "")));
            }
            if (budget.claims.u_c) {
                finding.evidence.push_back(
                    say("claimed u_c = {u_c:number}", claimed_in_words(*budget.claims.u_c, budget.unit)));
            }
            finding.expected = range_in_words(check.U, budget.unit);
            finding.actual = say_number(claimed_in_words(*budget.claims.U, budget.unit));
            finding.kind = "U";
            const std::vector<RowCorrelation> explaining =
                budget.claims.u_c ? std::vector<RowCorrelation>() : explaining_correlation(budget);
            if (!explaining.empty()) {
                add_as_question(budget, explaining, std::move(finding), findings);
            } else {
                finding.correct = [](AuditedBudget& corrected) { corrected.U_over_k_u_c = 1.0; };
                findings.add(std::move(finding));
            }
        }
    }
}

/// K09
void linear_sum(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        const ClaimCheck check = budget.evaluated_here ? ClaimCheck{} : check_u_c(budget);
        if (!check.linear_sum) {
            continue;
        }
        AuditFinding finding = finding_of(
            subject, b,
            say("u_c = {u_c:number} is the plain sum of the contributions, not the root of the sum of squares",
                claimed_in_words(*budget.claims.u_c, budget.unit)));
        finding.evidence = {say("the root of the sum of squares is {u_c}", range_in_words(check.u_c, budget.unit))};
        finding.expected = range_in_words(check.u_c, budget.unit);
        finding.actual = say_number(claimed_in_words(*budget.claims.u_c, budget.unit));
        // Of rows that are correlated with r = 1 the plain sum is right (JCGM 100:2008, 5.2.2).
        if (const std::vector<RowCorrelation> explaining = explaining_correlation(budget); !explaining.empty()) {
            add_as_question(budget, explaining, std::move(finding), findings);
            continue;
        }
        finding.correct = k_trust_rows;
        findings.add(std::move(finding));
    }
}

/// The probability that belongs to a fixed k: as claimed, or that of the normal distribution for 1.96, 2, 2.58 and 3.
double probability_of(const AuditedBudget& budget) {
    if (budget.claims.coverage_probability) {
        return *budget.claims.coverage_probability;
    }
    const double k = budget.coverage.k;
    if (is_about(k, 1.96, 0.003)) {
        return 0.95;
    }
    if (is_about(k, 2.576, 0.005)) {
        return 0.99;
    }
    return is_about(k, 3.0, 0.003) ? 0.9973 : k_usual_probability;
}

/// Whether a fixed k is taken although ν_eff is small: K02.
bool has_fixed_k_of_few(const AuditedBudget& budget, const BudgetOutcome& outcome) {
    constexpr double k_enough = 20.0, k_least = 0.5;
    return budget.coverage.kind == CoverageRule::Kind::fixed && outcome.nu_eff < k_enough &&
           outcome.nu_eff >= k_least && gum::coverage_factor(probability_of(budget), outcome.nu_eff) > 1.01 * outcome.k;
}

/// K02
void fixed_k_of_few(const AuditSubject& subject, FindingCollector& findings) {
    for_each_foreign_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        if (!has_fixed_k_of_few(budget, outcome)) {
            return;
        }
        const double p = probability_of(budget), k = gum::coverage_factor(p, outcome.nu_eff);
        AuditFinding finding = finding_of(subject, b,
                                          say("k = {k:number} is fixed although ν_eff is only {nu_eff:number}",
                                              in_words(outcome.k), in_words(outcome.nu_eff)));
        finding.evidence = {say("p = {p:number} %", text::significant(100.0 * p, 4)), equals("t_p(ν_eff)", in_words(k)),
                            equals("u_c", in_words(outcome.u_c, budget.unit))};
        finding.expected = equals("k", in_words(k));
        finding.actual = equals("k", in_words(outcome.k));
        finding.correct = [p](AuditedBudget& corrected) {
            corrected.coverage.kind = CoverageRule::Kind::student_t;
            corrected.coverage.probability = p;
        };
        findings.add(std::move(finding));
    });
}

/// K11: the GUM allows both ways, so that nothing is put right; a laboratory uses one, and where one file has both, that is.
void truncation(const AuditSubject& subject, FindingCollector& findings) {
    const bool some_truncate =
        std::any_of(subject.budgets.begin(), subject.budgets.end(), [](const AuditedBudget& budget) {
            return budget.coverage.kind == CoverageRule::Kind::student_t && budget.coverage.truncate;
        });
    for_each_foreign_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        const bool few = has_fixed_k_of_few(budget, outcome);
        const bool student = budget.coverage.kind == CoverageRule::Kind::student_t;
        if (!(student || few) || budget.coverage.truncate || !std::isfinite(outcome.nu_eff) || outcome.nu_eff < 1.0) {
            return;
        }
        CoverageRule as_it_is = budget.coverage;
        as_it_is.kind = CoverageRule::Kind::student_t;
        as_it_is.probability = few ? probability_of(budget) : budget.coverage.probability;
        CoverageRule cut = as_it_is;
        cut.truncate = true;
        const BudgetOutcome whole = evaluate(budget, as_it_is), lower = evaluate(budget, cut);
        // Told only where a reader would see it, or where one file does both.
        if (whole.rounded_U == lower.rounded_U && !some_truncate) {
            return;
        }
        if (is_about(whole.k, lower.k, 1e-9)) {
            return;
        }
        AuditFinding finding = finding_of(
            subject, b,
            some_truncate
                ? say("ν_eff = {nu_eff:number} is used as it is; other budgets cut it to the next lower whole number",
                      in_words(outcome.nu_eff))
                : say("ν_eff = {nu_eff:number} is used as it is; cut to the next lower whole number, U would be "
                      "printed otherwise",
                      in_words(outcome.nu_eff)));
        finding.evidence = {say("k = {k:number}, cut {cut:number}", in_words(whole.k), in_words(lower.k)),
                            say("U = {U:number}, cut {cut:number}", whole.rounded_U, lower.rounded_U)};
        if (some_truncate) {
            finding.correct = [](AuditedBudget& corrected) {
                if (corrected.coverage.kind == CoverageRule::Kind::student_t) {
                    corrected.coverage.truncate = true;
                }
            };
        }
        findings.add(std::move(finding));
    });
}

/// A number behind "k =" in a sentence, and a percentage.
struct CoverageWords {
    std::optional<StatedNumber> k;
    std::optional<double> p;
};
CoverageWords coverage_words(const AuditedBudget& budget) {
    CoverageWords words;
    const std::string sentence = text::in_small_letters(budget.claims.coverage_sentence);
    for (std::size_t at = sentence.find('k'); at != std::string::npos && !words.k; at = sentence.find('k', at + 1)) {
        const std::size_t equals = sentence.find_first_not_of(' ', at + 1);
        const bool alone = at == 0 || sentence[at - 1] == ' ' || sentence[at - 1] == '(' || sentence[at - 1] == ',';
        if (alone && equals != std::string::npos && sentence[equals] == '=') {
            if (const std::optional<LeadingNumber> number = read_leading_number(sentence.substr(equals + 1), "")) {
                words.k = number->number;
            }
        }
    }
    const std::size_t percent = sentence.find('%');
    if (percent != std::string::npos) {
        const std::size_t end = sentence.find_last_of("0123456789", percent);
        if (end != std::string::npos) {
            const std::size_t before = sentence.find_last_not_of("0123456789.,", end);
            const std::size_t from = before == std::string::npos ? 0 : before + 1;
            if (const std::optional<StatedNumber> p = read_number(sentence.substr(from, end + 1 - from), "")) {
                words.p = p->value / 100.0;
            }
        }
    }
    if (!words.k) {
        words.k = budget.claims.k;
    }
    if (!words.p) {
        words.p = budget.claims.coverage_probability;
    }
    return words;
}

/// The outcome with the rule of coverage that the claimed U shows, and what the digits of the rows leave open of it.
struct ShownCoverage {
    BudgetOutcome outcome;
    OutcomeIntervals allowed;
    bool is_of_other_nu = false;  ///< k is that of a ν_eff that the rows do not give: K01 tells it
};
ShownCoverage shown_coverage(const AuditedBudget& budget) {
    const ClaimCheck check = check_claims(budget);
    return {.outcome = evaluate(budget, check.coverage),
            .allowed = outcome_intervals(budget, check.coverage),
            .is_of_other_nu = check.nu_eff_outside};
}

/// Whether the stated k is the used one, rounded to a whole number by more than 5 %: "2" for 2.40. K13.
bool loses_digits(const StatedNumber& stated, double k) {
    constexpr double k_seen = 0.05;
    return stated.value == std::round(k) && !is_about(stated.value, k, k_seen);
}

/// What is said of k with the sentence of the document that says it.
Sentence with_sentence(Sentence said, const std::string& sentence) {
    return sentence.empty() ? said : say("{said}: \"{sentence}\"", std::move(said), sentence);
}

/// The smallest k that p can have by the distribution that is stated of a result without rows. A sum that a bounded
/// contribution dominates has a k below that of the normal distribution: √3 p where it is rectangular, 1.65 at 95 %. Which
/// sum it was, nobody knows where no distribution is stated, or one that has no k of its own.
double least_k_without_rows(const std::string& distribution, double p) {
    const std::string name = text::in_small_letters(distribution);
    if (is_normal_or_student(name)) {
        return gum::standard_normal_quantile(0.5 + 0.5 * p);
    }
    const bool is_rectangular = name.empty() || name == "uniform" || name == "rectangular";
    // Of the distributions in use that of the arcsine is the narrowest: k = √2 sin(π p/2).
    return is_rectangular ? std::numbers::sqrt3 * p : std::numbers::sqrt2 * std::sin(0.5 * std::numbers::pi * p);
}

const Correction k_by_convolution = [](AuditedBudget& budget) {
    if (budget.coverage.kind == CoverageRule::Kind::fixed) {
        budget.coverage.probability = probability_of(budget);
    }
    budget.coverage.kind = CoverageRule::Kind::convolution;
};

/// What all rows together are beside a rectangular one, where they are at most 0.3 of it; nothing where none dominates.
std::optional<double> rest_of_rectangular(const AuditedBudget& budget) {
    constexpr double k_rest = 0.3;
    const auto dominant = std::max_element(
        budget.rows.begin(), budget.rows.end(),
        [](const AuditedRow& a, const AuditedRow& c) { return contribution_of(a) < contribution_of(c); });
    if (dominant == budget.rows.end() || dominant->shape != Shape::rectangular || !budget.correlations.empty()) {
        return std::nullopt;
    }
    const double largest = contribution_of(*dominant);
    double variance = budget.correlation_variance;
    for (const AuditedRow& row : budget.rows) {
        variance += &row == &*dominant ? 0.0 : contribution_of(row) * contribution_of(row);
    }
    const double rest = std::sqrt(std::max(0.0, variance));
    return largest > 0.0 && rest <= k_rest * largest ? std::optional(rest / largest) : std::nullopt;
}

/// The smallest k that p can have by the rows: that of the distribution of their sum, where a row that states no distribution
/// is taken as a rectangular one, and the largest of those that state none as an arcsine one. Nothing where the rows are correlated, so that nobody knows it.
std::optional<double> least_k_of_rows(const AuditedBudget& budget, double p) {
    if (!budget.correlations.empty() || budget.correlation_variance != 0.0) {
        return std::nullopt;
    }
    AuditedBudget narrow = budget;
    AuditedRow* largest = nullptr;
    const auto size_of = [](const AuditedRow& row) { return std::abs(row.used_sensitivity) * row.used_u; };
    for (AuditedRow& row : narrow.rows) {
        const bool is_open = row.shape == Shape::not_stated && !row.type_a.value_or(false);
        if ((is_open && !std::isfinite(row.used_nu)) || row.shape == Shape::trapezoidal || row.shape == Shape::other) {
            row.shape = Shape::rectangular;
            const bool is_larger = largest == nullptr || size_of(row) > size_of(*largest);
            largest = is_open && is_larger ? &row : largest;  // one that is stated has its shape
        }
        row.used_nu = std::numeric_limits<double>::infinity();  // fewer degrees of freedom make k larger
    }
    narrow.k_over_rows = 1.0;
    const bool is_dominated = rest_of_rectangular(narrow).has_value();
    if (largest != nullptr) {
        largest->shape = Shape::arcsine;  // as a mismatch (EA-4/02, S7)
    }
    try {
        const double k = evaluate(narrow, {.kind = CoverageRule::Kind::convolution, .probability = p}).k;
        // 1.65 is taken where one rectangular row dominates (EA-4/02, S9)
        return is_dominated ? std::min(k, std::numbers::sqrt3 * p) : k;
    } catch (const gum::DiagnosedError&) {
        return is_dominated ? std::optional(std::numbers::sqrt3 * p) : std::nullopt;
    }
}

/// K03
void k_and_sentence(const AuditSubject& subject, FindingCollector& findings) {
    for_each_foreign_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome&) {
        const CoverageWords words = coverage_words(budget);
        const ShownCoverage shown = shown_coverage(budget);
        const BudgetOutcome& outcome = shown.outcome;
        const double k = outcome.k;
        const Interval stated = words.k ? words.k->interval() : Interval{k, k};
        const std::string& sentence = budget.claims.coverage_sentence;
        if (words.k && !shown.is_of_other_nu && !loses_digits(*words.k, k) && !outcome.at_capability &&
            !stated.meets({0.99 * shown.allowed.k.low, 1.01 * shown.allowed.k.high})) {
            AuditFinding finding =
                finding_of(subject, b,
                           with_sentence(say("k = {stated:number} is stated, and k = {used:number} was used",
                                             in_words(words.k->value), in_words(k)),
                                         sentence));
            finding.evidence = {equals("U", in_words(outcome.U, budget.unit)),
                                equals("u_c", in_words(outcome.u_c, budget.unit))};
            finding.kind = "k";
            finding.expected = equals("k", in_words(k));
            finding.actual = equals("k", in_words(words.k->value));
            findings.add(std::move(finding));
        }
        if (!words.p || !(*words.p > 0.5) || !(*words.p < 1.0)) {
            return;
        }
        // "About 95 %" is said of k = 2; an interval may be a little wider than p asks for.
        const double least = gum::standard_normal_quantile(0.5 + 0.5 * *words.p);
        // Without rows only the document knows ν_eff; where it does not say, it may be as small as 1.
        const bool is_normal = budget.claims.distribution == "normal";
        // A convolution, or trials, have a k of their own: degrees of freedom beside it do not bound it.
        const bool has_own_k = !budget.claims.distribution.empty() && !is_normal_or_student(budget.claims.distribution);
        const double stated_nu = has_own_k              ? 1.0
                                 : budget.claims.nu_eff ? budget.claims.nu_eff->interval().low
                                 : is_normal            ? std::numeric_limits<double>::infinity()
                                                        : 1.0;
        const double fewest = std::floor(budget.rows.empty() ? stated_nu : shown.allowed.nu_eff.low);
        // k of p grows when ν_eff falls: from that of the normal distribution to that of the fewest degrees of freedom
        // that the rows, or the document, leave open.
        const double most =
            fewest >= 1.0 ? std::max(least, gum::coverage_factor(*words.p, fewest)) : std::max(least, k);
        // A sum that a rectangular contribution dominates has a k below that of the normal distribution, 1.65 at 95 %; the rows
        // say whether one does. "1.83" is printed for 1.84. One end alone of an interval has another k.
        constexpr double k_printed = 0.99;
        const bool is_one_sided = mentions(text::in_small_letters(sentence),
                                           {"one-sided", "one sided", "one-tailed", "one tailed", "einseitig",
                                            "unilateral", "un seul c", "單側", "单侧", "單邊", "单边", "片側"});
        const bool has_rows = !budget.rows.empty();
        const double least_of_all = !has_rows               ? least_k_without_rows(budget.claims.distribution, *words.p)
                                    : k < k_printed * least ? least_k_of_rows(budget, *words.p).value_or(0.0)
                                                            : 0.0;
        const bool is_small = !is_one_sided && k < k_printed * least_of_all;
        if (is_small || k > 1.06 * most) {
            AuditFinding finding =
                finding_of(subject, b,
                           with_sentence(say("k = {k:number} and p = {p:number} % do not belong together", in_words(k),
                                             text::significant(100.0 * *words.p, 4)),
                                         sentence));
            finding.evidence = {say("normal distribution: k = {least:number}", in_words(least)),
                                equals("ν_eff", in_words(outcome.nu_eff))};
            finding.kind = "p";
            finding.expected = most > least
                                   ? say("k = {least:number} to {most:number}", in_words(least), in_words(most))
                                   : equals("k", in_words(least));
            finding.actual = equals("k", in_words(k));
            // p is the promise, and a k below it makes U too small; of 1.96, 2, 2.58 or 3, which laboratories take for another p, and
            // of a k that is too large, nobody knows whether p or k was meant.
            constexpr double k_for_all[] = {1.96, 2.0, 2.576, 3.0};
            const bool is_of_other_p = std::any_of(std::begin(k_for_all), std::end(k_for_all),
                                                   [k](double usual) { return is_about(k, usual, 0.005); });
            if (is_small && has_rows && !is_of_other_p) {
                finding.correct = [p = *words.p](AuditedBudget& corrected) {
                    const bool is_dominated = rest_of_rectangular(corrected).has_value();
                    corrected.coverage = {
                        .kind = is_dominated ? CoverageRule::Kind::convolution : CoverageRule::Kind::student_t,
                        .probability = p};
                    corrected.k_over_rows = 1.0;
                };
            }
            findings.add(std::move(finding));
        }
    });
}

/// K13
void k_loses_digits(const AuditSubject& subject, FindingCollector& findings) {
    for_each_foreign_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome&) {
        const CoverageWords words = coverage_words(budget);
        const BudgetOutcome outcome = shown_coverage(budget).outcome;
        const double k = outcome.k;
        if (!words.k || outcome.at_capability || !loses_digits(*words.k, k)) {
            return;
        }
        AuditFinding finding =
            finding_of(subject, b,
                       say("k = {k:number} is printed as {printed:number}: who divides U by it gets another u_c",
                           in_words(k), in_words(words.k->value)));
        finding.evidence = {equals("U", in_words(outcome.U, budget.unit)),
                            equals("u_c", in_words(outcome.u_c, budget.unit))};
        finding.expected = equals("k", text::fixed(k, 2));
        finding.actual = equals("k", in_words(words.k->value));
        findings.add(std::move(finding));
    });
}

/// The half-width of a bounded row; nothing for one that has no bounds.
std::optional<double> semi_range(const AuditedRow& row) {
    switch (row.shape) {
        case Shape::rectangular:
            return row.used_u * std::numbers::sqrt3;
        case Shape::triangular:
            return row.used_u * std::sqrt(6.0);
        case Shape::arcsine:
            return row.used_u * std::numbers::sqrt2;
        default:
            return std::nullopt;
    }
}

/// K04
void rectangular_dominance(const AuditSubject& subject, FindingCollector& findings) {
    constexpr double k_moved = 0.02;
    for_each_foreign_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        const std::optional<double> rest = rest_of_rectangular(budget);
        if (!rest || budget.coverage.kind == CoverageRule::Kind::convolution || budget.u_c_over_rows != 1.0) {
            return;
        }
        AuditedBudget exact = budget;
        k_by_convolution(exact);
        const double k = evaluate(exact).k;
        // The criterion of domination alone accuses nobody: only a k that the convolution does not give does.
        if (!(k < (1.0 - k_moved) * outcome.k)) {
            return;
        }
        AuditFinding finding = finding_of(
            subject, b,
            say("a rectangular contribution is nearly all of u_c, and k = {k:number} is that of a normal distribution",
                in_words(outcome.k)));
        finding.evidence = {say("rest / dominant = {ratio:number}", in_words(*rest)),
                            say("exact k = {k:number}", in_words(k)),
                            say("p = {p:number} %", text::significant(100.0 * exact.coverage.probability, 4))};
        finding.expected = equals("k", in_words(k));
        finding.actual = equals("k", in_words(outcome.k));
        // Where the row was too large by an error of its own, nothing dominates once that is corrected.
        finding.correct = [](AuditedBudget& corrected) {
            if (rest_of_rectangular(corrected)) {
                k_by_convolution(corrected);
            }
        };
        findings.add(std::move(finding));
    });
}

/// K05
void wider_than_possible(const AuditSubject& subject, FindingCollector& findings) {
    for_each_foreign_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        double sum = 0.0;
        for (const AuditedRow& row : budget.rows) {
            if (!row.in_sum || row.used_u == 0.0) {
                continue;
            }
            // One row without bounds, and no sum of half-widths bounds the result.
            const std::optional<double> half = semi_range(row);
            if (!half) {
                return;
            }
            sum += std::abs(row.used_sensitivity) * *half;
        }
        constexpr double k_digits = 0.01;
        if (outcome.at_capability || !budget.correlations.empty() || !(sum > 0.0) ||
            outcome.U <= (1.0 + k_digits) * sum) {
            return;
        }
        AuditFinding finding =
            finding_of(subject, b,
                       say("U = {U:number} is more than all limits of the rows together, {sum:number}",
                           in_words(outcome.U, budget.unit), in_words(sum, budget.unit)));
        finding.evidence = {equals("k", in_words(outcome.k)),
                            say("sum of the half-widths = {sum:number}", in_words(sum, budget.unit))};
        finding.expected = say("U ≤ {sum:number}", in_words(sum, budget.unit));
        finding.actual = say_number(in_words(outcome.U, budget.unit));
        finding.correct = k_by_convolution;
        findings.add(std::move(finding));
    });
}

/// K06
void one_term(const AuditSubject& subject, FindingCollector& findings) {
    constexpr double k_share = 0.95, k_beyond = 0.05;
    for_each_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        // With correlated rows the variance is no sum over rows, and no row has a share of its own; nor has it where the
        // model leaves its tangent, and the variance is that of trials.
        const bool are_correlated =
            !budget.correlations.empty() ||
            std::any_of(budget.inputs_with_correlation.begin(), budget.inputs_with_correlation.end(),
                        [](const std::set<std::string>& inputs) { return inputs.size() > 1; });
        if (are_correlated || std::abs(budget.variance_beyond_tangent) > k_beyond * outcome.u_c * outcome.u_c) {
            return;
        }
        for (std::size_t r = 0; r < budget.rows.size() && budget.rows.size() > 1; ++r) {
            const AuditedRow& row = budget.rows[r];
            // Of what the rows add up to: a claim beyond them has no shares.
            const double part = row.in_sum ? row.used_sensitivity * row.used_u * budget.u_c_over_rows *
                                                 budget.within_digits / outcome.u_c
                                           : 0.0;
            // More than the whole is a row whose correlations nobody states.
            if (part * part <= k_share || part * part > 1.0 + k_beyond) {
                continue;
            }
            AuditFinding finding = finding_at({.budget = b, .row = r, .of = budget, .is = row}, "",
                                              say("this row is {share:number} % of the variance",
                                                  text::significant(std::min(100.0, 100.0 * part * part), 3)));
            finding.evidence = {equals("|c| u", in_words(std::abs(row.used_sensitivity) * row.used_u, budget.unit)),
                                equals("u_c", in_words(outcome.u_c, budget.unit))};
            findings.add(std::move(finding));
        }
    });
}

/// K07
void asymmetric_interval(const AuditSubject& subject, FindingCollector& findings) {
    constexpr double k_unequal = 0.1;
    for_each_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        if (!budget.monte_carlo || !budget.monte_carlo->low || !budget.monte_carlo->high || !budget.value) {
            return;
        }
        const double below = *budget.value - *budget.monte_carlo->low,
                     above = *budget.monte_carlo->high - *budget.value;
        if (std::abs(above - below) <= k_unequal * std::abs(above + below)) {
            return;
        }
        AuditFinding finding = finding_of(
            subject, b, say("the coverage interval is not symmetric about the value, and U is printed as ±"));
        finding.evidence = {say("below the value {below:number}", in_words(below, budget.unit)),
                            say("above it {above:number}", in_words(above, budget.unit)),
                            say("threshold: 10 % of the width")};
        finding.expected = say("the ends {low:number} and {high:number}", in_words(*budget.monte_carlo->low),
                               in_words(*budget.monte_carlo->high, budget.unit));
        finding.actual = say("± {U:number}", in_words(outcome.U, budget.unit));
        findings.add(std::move(finding));
    });
}

/// K08
void below_physical_limit(const AuditSubject& subject, FindingCollector& findings) {
    for_each_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        std::optional<double> least = budget.physical_minimum;
        const std::string name = text::in_small_letters(budget.name);
        // A form error is the distance of two enclosing surfaces, and a roughness or a concentration no less bounded:
        // none of them can be negative.
        for (const char* form :
             {"flatness", "roundness", "straightness", "cylindricity", "form error", "roughness", "concentration",
              "ebenheit", "rundheit", "geradheit", "formabweichung", "rauheit", "konzentration"}) {
            if (!least && name.find(form) != std::string::npos) {
                least = 0.0;
            }
        }
        if (!least || !budget.value || *budget.value - outcome.U >= *least) {
            return;
        }
        AuditFinding finding =
            finding_of(subject, b,
                       say("the interval reaches below {least:number}, where the quantity has no values",
                           in_words(*least, budget.unit)));
        finding.evidence = {equals(say("value"), in_words(*budget.value, budget.unit)),
                            equals("U", in_words(outcome.U, budget.unit))};
        findings.add(std::move(finding));
    });
}

/// K12
void larger_than_tolerance(const AuditSubject& subject, FindingCollector& findings) {
    for_each_outcome(subject, [&](std::size_t b, const AuditedBudget& budget, const BudgetOutcome& outcome) {
        if (!budget.limits.two_sided()) {
            return;
        }
        const double half = 0.5 * (*budget.limits.upper - *budget.limits.lower);
        if (!(half > 0.0) || outcome.U <= half) {
            return;
        }
        AuditFinding finding =
            finding_of(subject, b,
                       say("U = {U:number} is larger than the tolerance that it serves, ± {half:number}",
                           in_words(outcome.U, budget.unit), in_words(half, budget.unit)));
        finding.evidence = {say("U / tolerance = {ratio:number}", in_words(outcome.U / half))};
        findings.add(std::move(finding));
    });
}

}  // namespace

std::vector<Rule> coverage_rules() {
    using enum SeverityPolicy;
    using enum FindingSeverity;
    return {
        {.id = "K01",
         .title = "u_c or U does not follow from the rows",
         .clause = {.text = "ISO/IEC 17025:2017, 7.11.6", .verified = false},
         .severity = critical,
         .needs = {Need::rows, Need::claims},
         .detection =
             "the claimed u_c or U lies outside of what the printed digits of all rows allow; U may be rounded up, "
             "and k may be any that the claims leave open. The same of a ν_eff that k was taken from, and of a "
             "contribution that is not |c| u",
         .correction = "Compute u_c and U again from the rows, or complete the rows.",
         .question =
             "The rows give another number than the sheet claims. Which row is missing, or which number is old?",
         .examine = not_reproducible},
        {.id = "K02",
         .title = "Fixed coverage factor with few degrees of freedom",
         .clause = {.text = "JCGM 100:2008, G.4.1", .verified = true},
         .severity = major,
         .needs = {Need::rows},
         .detection = "k as for infinite ν, ν_eff below 20, and t_p(ν_eff) more than 1 % larger",
         .correction = "Take k = t_p(ν_eff).",
         .question =
             "The interval covers less than it says. May the scatter be pooled over more readings, or is k taken "
             "from ν_eff?",
         .examine = fixed_k_of_few,
         .looks_again = true},
        {.id = "K03",
         .title = "Coverage factor, probability and sentence do not agree",
         .clause = {.text = "ILAC-P14:09/2020, 5.2", .verified = false},
         .severity = major,
         .needs = {Need::claims},
         .detection = "the stated k is not the one that was used, by more than 1 %; or k and p do not belong together: "
                      "k below that of the distribution of the sum of the rows by more than 1 %; without rows by the "
                      "distribution that is stated, and without one, k from √3 p on is open",
         .correction = "State the k that was used, and the probability that belongs to it.",
         .question = "Which coverage factor was used, and which probability is meant?",
         .examine = k_and_sentence},
        {.id = "K04",
         .title = "Normal coverage factor where a rectangular contribution dominates",
         .clause = {.text = "EA-4/02 M:2022, annex on rectangular contributions", .verified = false},
         .severity = minor,
         .needs = {Need::rows},
         .detection =
             "all other contributions together are at most 0.3 of a rectangular one, and k is more than 2 % above "
             "that of the convolution",
         .correction = "Take k from the distribution of the sum: 1.65 where the rectangular contribution is all.",
         .question = "The interval is wider than p asks for. Is k = 2 stated by a rule of the accreditation body?",
         .examine = rectangular_dominance},
        {.id = "K05",
         .title = "Interval wider than the limits allow",
         .clause = {.text = "JCGM 100:2008, 6.3 and G.5", .verified = false},
         .severity = major,
         .needs = {Need::rows},
         .detection = "every row is bounded, and U is more than 1 % above the sum of all half-widths",
         .correction = "Take k from the distribution of the sum.",
         .question = "The value cannot lie as far away as U says. Is a contribution without limits missing?",
         .examine = wider_than_possible},
        {.id = "K06",
         .title = "One contribution is nearly everything",
         .clause = {.text = "ISO/IEC 17025:2017, 7.6.1", .verified = false},
         .policy = fixed,
         .severity = information,
         .needs = {Need::rows},
         .detection = "a row with more than 95 % of u_c²",
         .correction = "Spend the effort on this row.",
         .question = "How well is this one number known?",
         .examine = one_term},
        {.id = "K07",
         .title = "Asymmetric interval printed as ±U",
         .clause = {.text = "ILAC-P14:09/2020, 5.2", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::results},
         .detection =
             "the ends of a Monte Carlo interval differ in their distance from the value by more than 10 % of its "
             "width",
         .correction = "State both ends of the interval.",
         .question = "Would the user of the certificate be misled by a symmetric interval?",
         .examine = asymmetric_interval},
        {.id = "K08",
         .title = "Interval beyond a physical limit",
         .clause = {.text = "JCGM 101:2008", .verified = false},
         .policy = fixed,
         .severity = minor,
         .needs = {Need::results},
         .detection =
             "value − U below 0 of a form error, a roughness or a concentration, or below a stated least value",
         .correction = "State an interval that ends at the limit.",
         .question = "What should the reader make of the part of the interval where the quantity cannot be?",
         .examine = below_physical_limit},
        {.id = "K09",
         .title = "Contributions added linearly",
         .clause = {.text = "JCGM 100:2008, 5.1.2", .verified = true},
         .severity = minor,
         .needs = {Need::rows, Need::claims},
         .detection = "the claimed u_c is the plain sum of the contributions, beyond their rounding",
         .correction = "Take the root of the sum of squares, or state the correlations.",
         .question = "Are all contributions fully correlated, or is the sum meant as a bound?",
         .examine = linear_sum},
        {.id = "K11",
         .title = "Effective degrees of freedom cut or not",
         .clause = {.text = "JCGM 100:2008, G.4.1", .verified = true},
         .policy = fixed,
         .severity = information,
         .needs = {Need::rows},
         .detection =
             "k from ν_eff as it is, where the next lower whole number prints another U, or where other budgets of "
             "the same file cut it",
         .correction = "Treat ν_eff in one way; the GUM allows both.",
         .question = "Does the laboratory interpolate the t-factor or cut ν_eff, and where is that written?",
         .examine = truncation},
        {.id = "K12",
         .title = "U larger than the tolerance it serves",
         .clause = {.text = "ISO/IEC 17025:2017, 7.8.6", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::rows, Need::limits},
         .detection = "U above half the distance of two limits",
         .correction = "Use a better method, or make no statement of conformity.",
         .question = "No value can be shown to lie within these limits. What is the statement for?",
         .examine = larger_than_tolerance},
        {.id = "K13",
         .title = "Printed coverage factor loses digits",
         .clause = {.text = "JCGM 100:2008, 7.2.3", .verified = false},
         .policy = fixed,
         .severity = major,
         .needs = {Need::claims},
         .detection = "k is printed as a whole number that differs from the used one by more than 5 %",
         .correction = "Print k with two decimals.",
         .question =
             "A user who divides U by the printed k gets a wrong standard uncertainty. Is the format of the cell to "
             "blame?",
         .examine = k_loses_digits},
    };
}

}  // namespace gumcert::audit
