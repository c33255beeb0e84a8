#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "certificate/text_words.h"
#include "gum/comparison/agreement.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/comparison/scores.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"

#include "text/numbers.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_validity{.text = "ISO/IEC 17025:2017, 7.7.1 and 7.7.3", .verified = true};
constexpr Clause k_outliers_acted_on{.text = "ISO/IEC 17025:2017, 7.7.3 and 7.10", .verified = true};
constexpr Clause k_scores{.text = "ISO 13528:2022, 9", .verified = false};
constexpr Clause k_assigned_value{.text = "ISO 13528:2022, 7; ISO/IEC 17043", .verified = false};
constexpr Clause k_key_comparison{.text = "M. G. Cox, The evaluation of key comparison data, 2002", .verified = false};

// Thresholds of N01 and its neighbours; each finding states its own.
constexpr double k_low_tail = 0.025;  // P(χ² ≤ Σζ²): uncertainties too large for the differences
constexpr double k_wide_against_spread = 1.5;
constexpr double k_wide_against_capability = 2.0;
constexpr double k_assigned_value_share = 0.3;     // of σ_pt
constexpr double k_inconsistent = 0.05;            // of scores whose covariance nobody states
constexpr double k_inconsistent_together = 0.025;  // with their covariance, as the verdict of a comparison has it
constexpr std::size_t k_least_laboratories = 5;    // for a robust standard deviation

std::span<const AuditedScore> scores_of(const AuditSubject& subject) {
    return subject.comparison ? std::span<const AuditedScore>(subject.comparison->scores)
                              : std::span<const AuditedScore>();
}
AuditFinding finding_of_score(const AuditedScore& score, Sentence what) {
    AuditFinding finding;
    finding.where = score.name.empty() ? "comparison" : score.name;
    finding.what = std::move(what);
    // Scores with one fault are one finding: the words before the first number tell which.
    const std::string& said = finding.what.english();
    finding.kind = "score/" + said.substr(0, said.find_first_of("0123456789"));
    return finding;
}
AuditFinding finding_of_comparison(Sentence what) {
    AuditFinding finding;
    finding.where = "comparison";
    finding.what = std::move(what);
    return finding;
}
std::string short_number(double number) {
    return text::significant(number, 3);
}

/// "p_high = 0.003". What is too small for a number has no digits, and is not 0.
Sentence probability(const char* symbol, double p) {
    return p > 0.0 ? equals(symbol, short_number(p)) : say("{symbol} is below {least:number}", symbol, "1e-300");
}

/// A score above 1 that does not print as 1.
std::string above_one(double score) {
    std::string shown = short_number(score);
    for (int digits = 4; shown == "1" && digits < 17; ++digits) {
        shown = text::significant(score, digits);
    }
    return shown;
}

/// E_n that follows from both expanded uncertainties of a score, where another one is stated; N02 tells it.
std::optional<double> refuted_en(const AuditedScore& score) {
    const double squares = score.U * score.U + score.reference_U * score.reference_U;
    if (!score.en || score.is_evaluated || score.correlation_known || !(squares > 0.0)) {
        return std::nullopt;
    }
    constexpr double k_printed = 0.02;  // of a score with two decimals, and 2 % of it
    const double right = (score.value - score.reference_value) / std::sqrt(squares);
    const bool is_other = std::abs(std::abs(*score.en) - std::abs(right)) > k_printed * (1.0 + std::abs(right));
    return is_other ? std::optional(right) : std::nullopt;
}

/// What the claimed E_n of a table is held against.
struct FollowingScore {
    double U = 0.0, U_ref = 0.0, difference = 0.0;
    double right = 0.0;   ///< E_n that follows from them
    double digits = 0.0;  ///< what the printed digits leave open of it
};
/// Where another E_n is claimed than value, U and reference give as they are printed; N02 tells it.
std::optional<FollowingScore> refuted_en(const AuditedBudget& budget) {
    const std::optional<double> U = stated_U(budget);
    if (budget.evaluated_here || !budget.claims.en || !budget.reference || !budget.claims.value || !U) {
        return std::nullopt;
    }
    FollowingScore score{.U = *U,
                         .U_ref = budget.reference->expanded_uncertainty,
                         .difference = budget.claims.value->value - budget.reference->value};
    const double U_difference = gum::uncertainty_of_difference(*U, score.U_ref, budget.reference->correlation);
    if (!(U_difference > 0.0)) {
        return std::nullopt;
    }
    score.right = score.difference / U_difference;
    // The score may have been computed of unrounded numbers: what the printed digits of value, score and U leave open
    // together, each by its derivative.
    score.digits = budget.claims.value->half_step / U_difference + budget.claims.en->half_step +
                   std::abs(score.right) * (budget.claims.U ? printed_half_step(*budget.claims.U) / *U : 0.0);
    const bool follows = std::abs(std::abs(budget.claims.en->value) - std::abs(score.right)) <=
                         score.digits + 0.01 * std::abs(score.right);
    return follows ? std::nullopt : std::optional(score);
}

/// The E_n that decides: the stated one, or the one that follows where N02 refutes it.
std::optional<double> en_of(const AuditedScore& score) {
    if (const std::optional<double> right = refuted_en(score)) {
        return right;
    }
    // With one uncertainty alone there is no E_n: the difference over it is another number.
    if (score.en || score.is_evaluated || !(score.U > 0.0 && score.reference_U > 0.0)) {
        return score.en;
    }
    return (score.value - score.reference_value) / std::hypot(score.U, score.reference_U);
}
std::optional<double> en_of(const AuditedBudget& budget) {
    if (const std::optional<FollowingScore> score = refuted_en(budget)) {
        return score->right;
    }
    if (budget.claims.en) {
        return budget.claims.en->value;
    }
    const std::optional<BudgetOutcome> outcome = outcome_or_none(budget);
    return outcome ? outcome->en : std::nullopt;
}

/// Σ ζ² over all scores, with the ζ that is stated or follows from both u; nothing where one has neither, or where the
/// evaluation knows what its scores have in common.
std::optional<double> sum_of_squared_zeta(std::span<const AuditedScore> scores) {
    double sum = 0.0;
    for (const AuditedScore& score : scores) {
        if (score.is_evaluated) {
            return std::nullopt;
        }
        if (!score.zeta && !(score.u > 0.0 && score.reference_u > 0.0)) {
            return std::nullopt;
        }
        const double zeta =
            score.zeta ? *score.zeta : (score.value - score.reference_value) / std::hypot(score.u, score.reference_u);
        sum += zeta * zeta;
    }
    return scores.empty() ? std::nullopt : std::optional(sum);
}

/// s* of the values of laboratories that were compared with one reference value; nothing for points of different ones.
std::optional<double> robust_deviation(std::span<const AuditedScore> scores) {
    std::vector<double> values;
    for (const AuditedScore& score : scores) {
        // s* of values that were compared with different reference values would be the spread of the points and not of
        // the laboratories.
        if (score.reference_value != scores.front().reference_value) {
            return std::nullopt;
        }
        values.push_back(score.value);
    }
    if (values.size() < k_least_laboratories) {
        return std::nullopt;
    }
    try {
        return gum::algorithm_a(values).scale;
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

/// N01, what is seen of the numbers as they are stated.
void inflated_uncertainty(const AuditSubject& subject, FindingCollector& findings) {
    const std::span<const AuditedScore> scores = scores_of(subject);
    const std::optional<double> chi_square = sum_of_squared_zeta(scores);
    std::optional<double> p_low = subject.comparison ? subject.comparison->p_low : std::nullopt;
    if (!p_low && chi_square && scores.size() > 1) {
        p_low = gum::chi_square_lower_tail(*chi_square, static_cast<double>(scores.size()));
    }
    // Σ ζ² far below its expected value: not luck, but uncertainties that are too large, or results that were not
    // independent of the reference.
    const auto too_small = [&findings](const std::string& where, const std::optional<double>& p, double threshold) {
        if (p && *p < threshold) {
            AuditFinding finding = finding_of_comparison(
                say("the differences are too small for the stated uncertainties: {p_low}, threshold {threshold:number}",
                    probability("p_low", *p), short_number(threshold)));
            finding.where = where.empty() ? finding.where : where;
            finding.evidence = {probability("p_low", *p)};
            findings.add(std::move(finding));
        }
    };
    if (p_low || !subject.comparison) {
        too_small("", p_low, k_low_tail);
    } else {
        // Of many items some differ by little by chance (ADR 0082).
        const std::vector<AuditedItem>& items = subject.comparison->items;
        const auto tests =
            std::count_if(items.begin(), items.end(), [](const AuditedItem& item) { return item.p_low.has_value(); });
        for (const AuditedItem& item : items) {
            too_small(item.name, item.p_low, gum::chance_in_family(k_low_tail, static_cast<std::size_t>(tests)));
        }
    }
    const std::optional<double> spread = robust_deviation(scores);
    for (const AuditedScore& score : scores) {
        if (spread && *spread > 0.0 && score.u > k_wide_against_spread * *spread) {
            AuditFinding finding = finding_of_score(
                score, say("u = {u:number} is larger than 1.5 s* = {limit:number} of all laboratories (threshold 1.5)",
                           in_words(score.u), in_words(k_wide_against_spread * *spread)));
            findings.add(std::move(finding));
        }
    }
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<double> U = stated_U(budget);
        if (budget.reference && budget.capability && U && *U > k_wide_against_capability * *budget.capability) {
            AuditFinding finding =
                finding_of(subject, i,
                           say("U = {U:number} in a comparison is more than twice the capability {capability:number} "
                               "(threshold 2), and no reason is stated",
                               in_words(*U, budget.unit), in_words(*budget.capability, budget.unit)));
            findings.add(std::move(finding));
        }
    }
}

/// Whether U of both sides cover the same, as factors of a normal distribution.
bool covers_the_same(double probability, double other) {
    const double infinite = std::numeric_limits<double>::infinity();
    return is_about(gum::coverage_factor(probability, infinite), gum::coverage_factor(other, infinite),
                    gum::k_same_coverage_factor);
}

/// N01, what follows from the other findings: |E_n| ≤ 1 as stated, and above 1 with all of them corrected.
void passes_by_inflation_only(const AuditSubject& subject, std::span<const AuditFinding> others,
                              FindingCollector& findings) {
    std::vector<bool> said(subject.budgets.size(), false);
    for (const AuditFinding& other : others) {
        const std::optional<Effect>& effect = other.effect_on_score ? other.effect_on_score : other.effect;
        if (!effect || !effect->claimed.en || !effect->audited.en) {
            continue;
        }
        const double claimed = *effect->claimed.en, audited = *effect->audited.en;
        const std::size_t budget = effect->budget;
        if (std::abs(claimed) > 1.0 || std::abs(audited) <= 1.0 || said[budget]) {
            continue;
        }
        said[budget] = true;
        AuditFinding finding = finding_of(subject, budget,
                                          say("|E_n| = {claimed:number} passes only because U is inflated: with all "
                                              "findings corrected it is {audited:number} (threshold 1)",
                                              short_number(std::abs(claimed)), short_number(std::abs(audited))));
        finding.expected = equals("|E_n|", short_number(std::abs(audited)));
        finding.actual = equals("|E_n|", short_number(std::abs(claimed)));
        findings.add(std::move(finding), FindingSeverity::critical);
    }
}

/// N02 of a table: the claimed E_n against value, U and reference as they are printed.
void score_does_not_follow(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<FollowingScore> score = refuted_en(budget);
        if (!score) {
            continue;
        }
        const double stated = budget.claims.en->value;
        const auto is_stated = [&](double other) {
            return std::abs(std::abs(stated) - std::abs(other)) <= score->digits;
        };
        const Sentence both =
            say("E_n is stated as {stated:number}, and follows as {right:number} from both expanded uncertainties.",
                short_number(stated), short_number(score->right));
        const Sentence what =
            score->U_ref > 0.0 && is_stated(score->difference / score->U_ref)
                ? say("{stated} That is the difference over U_ref alone.", both)
            : is_stated(score->difference / score->U) ? say("{stated} That is the difference over U alone.", both)
            : is_stated(2.0 * score->right)           ? say("{stated} That is the score of u in place of U.", both)
                                                      : both;
        AuditFinding finding = finding_of(subject, i, what);
        finding.evidence = {equals(say("difference"), in_words(score->difference, budget.unit)),
                            equals("U", in_words(score->U, budget.unit)),
                            equals("U_ref", in_words(score->U_ref, budget.unit))};
        finding.expected = say_number(short_number(score->right));
        finding.actual = say_number(short_number(stated));
        findings.add(std::move(finding));
    }
}

/// N02
void factors_mixed(const AuditSubject& subject, FindingCollector& findings) {
    score_does_not_follow(subject, findings);
    for (const AuditedScore& score : scores_of(subject)) {
        if (const std::optional<double> right = refuted_en(score)) {
            AuditFinding finding = finding_of_score(
                score,
                say("E_n is stated as {en:number}, and follows as {right:number} from the expanded uncertainties",
                    short_number(*score.en), short_number(*right)));
            finding.expected = say_number(short_number(*right));
            finding.actual = say_number(short_number(*score.en));
            findings.add(std::move(finding));
        }
        if (score.probability && score.reference_probability &&
            !covers_the_same(*score.probability, *score.reference_probability)) {
            constexpr double k_percent = 100.0;
            findings.add(finding_of_score(score, say("U for {p:number} % and U for {other:number} % meet in one E_n",
                                                     text::significant(k_percent * *score.probability, 4),
                                                     text::significant(k_percent * *score.reference_probability, 4))),
                         FindingSeverity::major);
        }
        if (!score.is_evaluated && score.k && score.reference_k &&
            !is_about(*score.k, *score.reference_k, gum::k_same_coverage_factor)) {
            findings.add(
                finding_of_score(
                    score, say("k = {k:number} and k = {other:number} meet in one E_n (they differ by more than 2.5 %)",
                               short_number(*score.k), short_number(*score.reference_k))),
                FindingSeverity::major);
        }
        for (const auto& [U, u, k, of_laboratory] :
             {std::tuple(score.U, score.u, score.k, true),
              std::tuple(score.reference_U, score.reference_u, score.reference_k, false)}) {
            if (!score.is_evaluated && k && U > 0.0 && u > 0.0 && !is_about(U, *k * u, 0.05)) {
                findings.add(finding_of_score(
                    score, of_laboratory ? say("U = {U:number} of the laboratory is not k·u = {k_u:number}",
                                               in_words(U), in_words(*k * u))
                                         : say("U = {U:number} of the reference is not k·u = {k_u:number}", in_words(U),
                                               in_words(*k * u))));
            }
        }
    }
}

/// N03
void correlation_ignored(const AuditSubject& subject, FindingCollector& findings) {
    if (subject.comparison) {
        const AuditedComparison& comparison = *subject.comparison;
        const bool open = std::any_of(comparison.scores.begin(), comparison.scores.end(),
                                      [](const AuditedScore& score) { return !score.correlation_known; });
        if (open && !comparison.shared_sources.empty()) {
            findings.add(
                finding_of_comparison(say("both sides name the same source, and no correlation is stated: {sources}",
                                          listed(sentences_of(comparison.shared_sources), 4))));
        }
        if (open && comparison.assigned_value_contains_participant) {
            findings.add(finding_of_comparison(
                say("the laboratory's own result is part of the assigned value, and no correlation is stated")));
        }
    }
    for_each_row(subject, [&findings](const RowAt& at) {
        if (!at.of.reference || at.of.reference->correlation != 0.0) {
            return;
        }
        const std::u32string name = certificate::letters_of(at.of.reference->name);
        constexpr std::size_t k_least = 4;  // letters: shorter names stand in other words
        if (name.size() >= k_least && certificate::letters_of(words_of_row(at.is)).find(name) != std::u32string::npos) {
            findings.add(finding_at(
                at, "",
                say("the row rests on {reference}, with which the result is compared, and the correlation is 0",
                    at.of.reference->name)));
        }
    });
}

/// N04
void z_with_uncertain_assigned_value(const AuditSubject& subject, FindingCollector& findings) {
    for (const AuditedScore& score : scores_of(subject)) {
        if (!score.z || !score.sigma_pt || score.reference_u <= k_assigned_value_share * *score.sigma_pt) {
            continue;
        }
        AuditFinding finding = finding_of_score(
            score, say("z is used, and u(X) = {u:number} is more than 0.3 σ_pt = {limit:number}",
                       in_words(score.reference_u), in_words(k_assigned_value_share * *score.sigma_pt)));
        finding.expected = say("z′ = (x − X)/√(σ_pt² + u²(X))");
        findings.add(std::move(finding));
    }
}

/// N05
void reference_not_better(const AuditSubject& subject, FindingCollector& findings) {
    for (const AuditedScore& score : scores_of(subject)) {
        if (score.U > 0.0 && score.reference_U >= score.U) {
            findings.add(finding_of_score(
                score,
                say("U of the reference, {reference:number}, is not smaller than that of the laboratory, {U:number}",
                    in_words(score.reference_U), in_words(score.U))));
        }
    }
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<double> U = stated_U(budget);
        if (!budget.reference || !U) {
            continue;
        }
        const bool is_reference = budget.reference->budget_is_reference;
        const double other_U = budget.reference->expanded_uncertainty;
        const double U_of_reference = is_reference ? *U : other_U;
        const double U_of_result = is_reference ? other_U : *U;
        // Where both sides have a budget, that of the result tells it.
        const bool is_told =
            is_reference && std::any_of(subject.budgets.begin(), subject.budgets.end(), [](const AuditedBudget& other) {
                return other.reference && !other.reference->budget_is_reference;
            });
        if (!is_told && U_of_reference >= U_of_result) {
            findings.add(
                finding_of(subject, i,
                           say("U of the reference, {reference:number}, is not smaller than that of the result, "
                               "{U:number}",
                               in_words(U_of_reference, budget.unit), in_words(U_of_result, budget.unit))));
        }
    }
}

/// N06
void no_action_on_record(const AuditSubject& subject, FindingCollector& findings) {
    if (subject.comparison && !subject.comparison->action_record.empty()) {
        return;
    }
    const bool others_act = subject.comparison && subject.comparison->between_laboratories;
    // Scores of which the same is said are one finding, and the first is the one that shows: the largest goes first.
    std::vector<std::pair<double, const AuditedScore*>> above;
    for (const AuditedScore& score : scores_of(subject)) {
        const std::optional<double> en = en_of(score);
        if (en && std::abs(*en) > 1.0 && score.is_signal) {
            above.emplace_back(std::abs(*en), &score);
        }
    }
    std::stable_sort(above.begin(), above.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (const auto& [en, score] : above) {
        const std::string shown = above_one(en);
        const auto add = [&, of = score](const char* kind, Sentence what, FindingSeverity severity) {
            AuditFinding finding = finding_of_score(*of, std::move(what));
            finding.kind = kind;
            findings.add(std::move(finding), severity);
        };
        if (score->is_without_objection) {
            add("score/by_chance",
                say("|E_n| = {en:number} is above 1, and so many of the scores are by chance alone", shown),
                FindingSeverity::information);
        } else if (others_act) {
            // An organiser has the signal of a laboratory to report; what that laboratory does is on record there.
            add("score/signal",
                say("|E_n| = {en:number} is above 1: a signal for this laboratory, which acts on it", shown),
                FindingSeverity::information);
        } else {
            add("score/no_action", say("|E_n| = {en:number} is above 1, and no action is on record", shown),
                FindingSeverity::critical);
        }
    }
    if (!scores_of(subject).empty()) {
        return;  // the budgets are those of points that have their scores
    }
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const std::optional<double> en = en_of(subject.budgets[i]);
        if (en && std::abs(*en) > 1.0) {
            findings.add(finding_of(
                subject, i,
                say("|E_n| = {en:number} is above 1, and no action is on record", above_one(std::abs(*en)))));
        }
    }
}

/// N07
void instability_not_in_reference(const AuditSubject& subject, FindingCollector& findings) {
    if (!subject.comparison || subject.comparison->scores.empty()) {
        return;
    }
    std::vector<AuditedItem> items = subject.comparison->items;
    if (items.empty()) {
        items.emplace_back().has_stability = subject.comparison->instability_in_reference;
    }
    for (const AuditedItem& item : items) {
        if (!item.has_stability) {
            AuditFinding finding = finding_of_comparison(
                say("the uncertainty of the reference value has no contribution of the stability of the artefact"));
            finding.where = item.name.empty() ? finding.where : item.name;
            finding.kind = "stability";
            findings.add(std::move(finding));
        }
    }
}

/// N08
void reference_without_uncertainty(const AuditSubject& subject, FindingCollector& findings) {
    for (const AuditedScore& score : scores_of(subject)) {
        if (!(score.reference_U > 0.0) && !(score.reference_u > 0.0)) {
            findings.add(finding_of_score(
                score, say("the reference value {value:number} has no uncertainty", in_words(score.reference_value))));
        }
    }
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const std::optional<ComparedReference>& reference = subject.budgets[i].reference;
        if (reference && !(reference->expanded_uncertainty > 0.0)) {
            findings.add(finding_of(subject, i,
                                    say("the reference value {value:number} has no uncertainty",
                                        in_words(reference->value, subject.budgets[i].unit))));
        }
    }
}

/// N09
void inconsistent_set(const AuditSubject& subject, FindingCollector& findings) {
    const auto contradict = [&findings](const std::string& where, const Sentence& p, double threshold) {
        AuditFinding finding = finding_of_comparison(
            say("the results contradict each other more than their uncertainties allow: {p}, threshold "
                "{threshold:number}",
                p, short_number(threshold)));
        finding.where = where.empty() ? finding.where : where;
        finding.evidence = {p};
        findings.add(std::move(finding));
    };
    if (subject.comparison && !subject.comparison->items.empty()) {
        for (const AuditedItem& item : subject.comparison->items) {
            if (item.by_chance) {
                continue;
            }
            if (item.p_consistent && *item.p_consistent < item.threshold) {
                contradict(item.name, probability("p", *item.p_consistent), item.threshold);
            } else if (!item.inconsistent.empty()) {
                AuditFinding finding = finding_of_comparison(
                    say("the results contradict each other more than their uncertainties allow: outside of the "
                        "largest consistent subset are {laboratories}",
                        listed(sentences_of(item.inconsistent), 4)));
                finding.where = item.name.empty() ? finding.where : item.name;
                findings.add(std::move(finding));
            }
        }
        return;
    }
    const std::span<const AuditedScore> scores = scores_of(subject);
    const std::optional<double> chi_square = sum_of_squared_zeta(scores);
    if (subject.comparison && subject.comparison->p_high) {
        if (*subject.comparison->p_high < k_inconsistent_together) {
            contradict("", probability("p_high", *subject.comparison->p_high), k_inconsistent_together);
        }
    } else if (chi_square && scores.size() > 1) {
        const double p_high = gum::chi_square_upper_tail(*chi_square, static_cast<double>(scores.size()));
        if (p_high < k_inconsistent) {
            contradict("", probability("p_high", p_high), k_inconsistent);
        }
    }
}

/// N10
void counted_one_by_one(const AuditSubject& subject, FindingCollector& findings) {
    if (!subject.comparison) {
        return;
    }
    const AuditedComparison& comparison = *subject.comparison;
    const std::vector<AuditedScore>& scores = comparison.scores;
    constexpr std::size_t k_least = 3;
    const bool all_pass = std::all_of(scores.begin(), scores.end(), [](const AuditedScore& score) {
        const std::optional<double> en = en_of(score);
        return en && std::abs(*en) <= 1.0;
    });
    // A common error makes all scores good or all of them bad: ten of them are then one success, not ten.
    if (scores.size() < k_least || !all_pass || comparison.shared_sources.empty() || comparison.p_low ||
        comparison.p_high) {
        return;
    }
    findings.add(finding_of_comparison(
        say("{count:number} scores share a source, and are presented one by one without their covariance",
            std::to_string(scores.size()))));
}

}  // namespace

std::vector<Rule> comparison_rules() {
    return {
        {.id = "N01",
         .title = "E_n passes only because U is inflated",
         .clause = k_validity,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection =
             "|E_n| > 1 with all findings corrected (critical); p_low < 0.025 over the set, or in the test of one item "
             "for consistency, of several as one family; u > 1.5 s* of five or "
             "more laboratories; U more than twice the capability",
         .correction = "Correct the uncertainty, and score again.",
         .question = "Why is the uncertainty so much larger than the differences, or than the capability?",
         .examine = inflated_uncertainty,
         .conclude = passes_by_inflation_only},
        {.id = "N02",
         .title = "u and U, or different k, mixed in E_n",
         .clause = k_scores,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::comparison},
         .detection =
             "E_n recomputed from the expanded uncertainties (0.02 and 2 %), where no correlation is stated; k of "
             "both sides (2.5 %, major); U against k·u (5 %); where this program evaluated E_n, the coverage "
             "probabilities of the U that it took (major)",
         .correction = "Use expanded uncertainties of the same coverage probability on both sides.",
         .question = "Which k belongs to the two uncertainties?",
         .examine = factors_mixed},
        {.id = "N03",
         .title = "Correlation between result and reference ignored",
         .clause = k_key_comparison,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection = "sources that both sides name, the laboratory inside the assigned value, or a row that names the "
                      "reference, and no correlation",
         .correction = "State the correlation; r of the shared part, or 0 with the reason.",
         .question = "Which standards do both sides have in common?",
         .examine = correlation_ignored},
        {.id = "N04",
         .title = "z used although the assigned value is uncertain",
         .clause = k_scores,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection = "u(X) above 0.3 σ_pt",
         .correction = "Use z′ or Eₙ.",
         .question = "How was the uncertainty of the assigned value taken into account?",
         .examine = z_with_uncertain_assigned_value},
        {.id = "N05",
         .title = "Reference not better than the laboratory",
         .clause = k_scores,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection = "U of the reference at least as large as that of the result",
         .correction = "Compare with a better reference; this comparison validates nothing.",
         .question = "What does a comparison with a reference of this uncertainty show?",
         .examine = reference_not_better},
        {.id = "N06",
         .title = "|E_n| above 1 without action on record",
         .clause = k_outliers_acted_on,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::comparison},
         .detection =
             "|E_n| above 1, by the E_n that follows where N02 refutes the stated one, and no record of what was "
             "done; an information between laboratories, because each acts on its own signal, and where nothing speaks "
             "against the scores of one direction together and the score is no larger than chance makes it; none "
             "where the evaluation gives no signal",
         .correction = "Find the cause, act, and put it on record.",
         .question = "What was done about this result?",
         .examine = no_action_on_record},
        {.id = "N07",
         .title = "Instability of the artefact not in the reference",
         .clause = k_assigned_value,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection =
             "an item, or a comparison without items, that names no contribution of the stability of the artefact "
             "and has no test that shows it stable",
         .correction = "Add the contribution, or show by measurements at start and end that there is none.",
         .question = "What is known of the artefact's stability during the comparison?",
         .examine = instability_not_in_reference},
        {.id = "N08",
         .title = "Reference value without uncertainty",
         .clause = k_assigned_value,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection = "a reference whose u and U are 0 or not stated",
         .correction = "State the uncertainty of the reference value and where it is traceable to.",
         .question = "Where does the reference value come from?",
         .examine = reference_without_uncertainty},
        {.id = "N09",
         .title = "Inconsistent set of results",
         .clause = k_key_comparison,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::comparison},
         .detection =
             "between laboratories, the test of an item for consistency as it was evaluated, or results outside "
             "of the largest consistent subset, but for what chance makes of several items; else p_high of Σζ² below "
             "0.025, given the covariance, or below "
             "0.05 where none is stated; none where nothing was evaluated",
         .correction = "Look for the result that contradicts the others, or for what the uncertainties leave out.",
         .question = "How was the inconsistency dealt with?",
         .examine = inconsistent_set},
        {.id = "N10",
         .title = "Correlated scores presented as independent successes",
         .clause = k_scores,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::comparison},
         .detection = "three scores or more that share a source, all with |E_n| ≤ 1, and no joint statement",
         .correction = "State the covariance and one score of all points together.",
         .question = "Which effects do these points have in common?",
         .examine = counted_one_by_one},
    };
}

}  // namespace gumcert::audit
