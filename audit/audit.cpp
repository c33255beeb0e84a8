#include "audit/audit.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

#include "audit/claims.h"
#include "audit/correction_effect.h"
#include "audit/nested_budgets.h"
#include "audit/severity.h"
#include "gum/quantity/diagnostic.h"
#include "gum/rounding.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

/// Largest change of ln U, for the order of findings and the choice among points.
double size_of(const Effect& effect) {
    return std::max(size_of_change(effect.claimed.U, effect.alone.U), size_of_change(effect.last.U, effect.audited.U));
}

/// One unit of the last digit of a number that is stated; 0 of one without a text.
double stated_step_of(const StatedNumber& number) {
    return 2.0 * (number.half_step > 0.0 ? number.half_step : printed_half_step(number));
}

/// Whether the claims of a table follow from its rows by the rule of coverage that it is evaluated with, so far as the digits of
/// the rows tell.
bool claims_follow(const AuditedBudget& budget, const BudgetOutcome& evaluated) {
    const ClaimCheck check = check_claims(budget);
    constexpr double k_same = 1e-9;
    return check.allowed && !check.u_c_outside && !check.U_outside && !check.nu_eff_outside &&
           std::abs(evaluate(budget, check.coverage).k - evaluated.k) <= k_same * evaluated.k;
}

/// Whether u_c is claimed as the rows give it, so that ν_eff and k are what the digits leave open.
bool has_u_c_of_rows(const AuditedBudget& budget, const BudgetOutcome& evaluated) {
    return budget.coverage.kind != CoverageRule::Kind::fixed && budget.claims.u_c &&
           std::abs(budget.claims.u_c->value - evaluated.u_c) <=
               0.5 * (1.0 + 1e-9) * stated_step_of(*budget.claims.u_c);
}

void note_uncorrected_U(AuditedBudget& budget) {
    budget.uncorrected_U.reset();
    budget.within_digits = budget.U_within_digits = 1.0;
    if (!budget.claims.U || !(budget.claims.U->value > 0.0) || !budget.claims.broken.U.empty()) {
        return;
    }
    const StatedNumber& U = *budget.claims.U;
    try {
        const BudgetOutcome evaluated = evaluate(budget);
        UncorrectedU found{.stated = U.value,
                           .evaluated = evaluated.U,
                           .step = U.text.empty() ? 0.0 : stated_step_of(U),
                           .text = U.text.empty() ? "" : text_of_claim(U)};
        // u_c and k that were rounded on the way move U by two units at most, which is little where U has three digits.
        constexpr double k_little = 0.01;
        const double off = std::abs(found.stated - found.evaluated);
        const bool is_rounding =
            (found.stated - found.step <= found.evaluated && found.evaluated <= found.stated + 0.5 * found.step) ||
            (off <= 2.0 * found.step && off <= k_little * found.stated);
        if (!is_rounding && found.evaluated > 0.0 && !found.text.empty() && !budget.evaluated_here &&
            !budget.computed_claims && !evaluated.at_capability && claims_follow(budget, evaluated)) {
            (has_u_c_of_rows(budget, evaluated) ? budget.U_within_digits : budget.within_digits) =
                found.stated / found.evaluated;
            found.evaluated = evaluate(budget).U;
        }
        // u_c and k that were rounded on the way move U by two units at most.
        const double step = std::max(found.step, std::pow(10.0, std::floor(std::log10(U.value)) - budget.digits + 1));
        if (found.evaluated > 0.0 && std::abs(found.stated - found.evaluated) <= 2.0 * step) {
            budget.uncorrected_U = found;
        }
    } catch (const gum::DiagnosedError&) {
        return;  // told where the budget is evaluated
    }
}

/// Claims as they are stated; where a number is not stated, what the rows give.
BudgetOutcome claimed_outcome(const AuditedBudget& budget, const BudgetOutcome& evaluated) {
    BudgetOutcome outcome = evaluated;
    const Claims& claims = budget.claims;
    const auto take = [](const std::optional<StatedNumber>& claim, double& number) {
        if (claim) {
            number = claim->value;
        }
    };
    take(claims.u_c, outcome.u_c);
    take(claims.nu_eff, outcome.nu_eff);
    take(claims.k, outcome.k);
    take(claims.U, outcome.U);
    if (claims.value) {
        outcome.value = claims.value->value;
        outcome.printed_value = claims.value->text.empty() ? outcome.printed_value : text_of_claim(*claims.value);
    }
    if (claims.U && !claims.U->text.empty()) {
        outcome.printed_U = text_of_claim(*claims.U);
        outcome.stated_step = stated_step_of(*claims.U);
    } else if (claims.U && claims.U->value > 0.0) {
        outcome.printed_U =
            gum::round_to_uncertainty(outcome.value.value_or(0.0), claims.U->value, budget.digits, budget.rounding).U;
    }
    if (!claims.verdict.empty()) {
        outcome.verdict = claims.verdict;
    }
    if (claims.en) {
        outcome.en = claims.en->value;
    }
    return outcome;
}

/// Graver first, then larger.
std::pair<FindingSeverity, double> rank_of(const Effect& effect) {
    return {severity_of(effect), size_of(effect)};
}

/// Positions of the findings whose corrections change a budget.
std::vector<std::size_t> findings_that_change(std::size_t position, const std::vector<AuditFinding>& findings,
                                              const NestedCorrections& nested) {
    std::vector<std::size_t> changing;
    for (std::size_t i = 0; i < findings.size(); ++i) {
        if (correction_of(findings[i], position) != nullptr) {
            changing.push_back(i);
        }
    }
    if (nested.is_dependent(position)) {
        std::vector<std::size_t> all;
        std::set_union(changing.begin(), changing.end(), nested.findings().begin(), nested.findings().end(),
                       std::back_inserter(all));
        return all;
    }
    return changing;
}

/// Effects of the corrections of all findings on one budget, put to the findings where they are the largest so far.
void put_effects(const AuditedBudget& budget, std::size_t position, std::vector<AuditFinding>& findings,
                 const NestedCorrections& nested, AuditedResult& result) {
    const std::vector<std::size_t> of_finding = findings_that_change(position, findings, nested);
    const bool is_dependent = nested.is_dependent(position);
    std::vector<Effect> effects;
    if (is_dependent) {
        effects = nested.effects_on(position, of_finding);
        result.sampled_shares = !nested.division(position, of_finding).is_exact;
    } else {
        std::vector<const Correction*> corrections;
        for (const std::size_t finding : of_finding) {
            corrections.push_back(correction_of(findings[finding], position));
        }
        effects = effects_of(budget, corrections);
        result.sampled_shares = !share_division(corrections.size(), budget.rows.size()).is_exact;
    }
    for (std::size_t i = 0; i < effects.size(); ++i) {
        effects[i].budget = position;
        result.audited = effects[i].audited;
        AuditFinding& finding = findings[of_finding[i]];
        if (is_dependent && effects[i].claimed.en && !finding.effect_on_score) {
            finding.effect_on_score = effects[i];
        }
        // What a nested budget is for are the results that rest on it: an effect on it alone stands where it has none on
        // those, which come first.
        const bool is_known_of_results =
            nested.is_nested(position) &&
            std::binary_search(nested.findings().begin(), nested.findings().end(), of_finding[i]);
        if (!is_known_of_results && (!finding.effect || rank_of(effects[i]) > rank_of(*finding.effect))) {
            finding.effect = std::move(effects[i]);
        }
    }
}

/// What errors hide: rules that found nothing look at the budgets as they are with all corrections.
void look_again(const AuditSubject& subject, std::span<const Rule> rules, std::vector<AuditFinding>& findings,
                std::vector<SeverityPolicy>& policies) {
    AuditSubject corrected = subject;
    bool any = false;
    for (std::size_t i = 0; i < corrected.budgets.size(); ++i) {
        for (const AuditFinding& finding : findings) {
            if (const Correction* correction = correction_of(finding, i)) {
                (*correction)(corrected.budgets[i]);
                any = true;
            }
        }
    }
    if (!any) {
        return;
    }
    for (const Rule& rule : rules) {
        const bool found = std::any_of(findings.begin(), findings.end(),
                                       [&rule](const AuditFinding& finding) { return finding.rule == rule.id; });
        if (!rule.looks_again || found || !why_not_applicable(rule, subject).empty()) {
            continue;
        }
        FindingCollector collector(rule);
        rule.examine(corrected, collector);
        for (AuditFinding& finding : collector.take()) {
            finding.what = say("{finding}; it is seen when the other findings are corrected", std::move(finding.what));
            findings.push_back(std::move(finding));
            policies.push_back(rule.policy);
        }
    }
}

/// Where columns of numbers, or cells of rows, were not understood, what does not follow from the others may follow from these: it is asked, and
/// nobody is accused of a grave error.
void limit_by_what_is_unread(AuditFinding& finding, const AuditSubject& subject) {
    const bool needs_all_columns = finding.rule == "S01" || finding.rule == "K01" || finding.rule == "K09";
    if (!needs_all_columns || finding.budgets.empty()) {
        return;
    }
    const std::vector<std::string>& unread = subject.budgets[finding.budgets.front()].unread_columns;
    for (const std::string& head : unread) {
        finding.evidence.push_back(say("the column {head} has numbers that were not read", text::in_quotes(head)));
    }
    const std::vector<std::string>& cells = subject.budgets[finding.budgets.front()].unread_cells;
    for (const std::string& words : cells) {
        finding.evidence.push_back(say("{words} stands where a number should, and was not read", words));
    }
    if (!unread.empty() || !cells.empty()) {
        finding.severity = std::min(finding.severity, FindingSeverity::major);
    }
}

/// The same as gum::message().
Sentence message_in_words(const gum::Diagnostic& diagnostic) {
    Sentence said = diagnostic.where;
    for (const std::string* part : {&diagnostic.what, &diagnostic.rule, &diagnostic.action}) {
        if (!part->empty()) {
            said = said.empty() ? Sentence(*part) : say("{said} — {part:sentence}", std::move(said), *part);
        }
    }
    return said;
}

/// What follows from the findings of a report, with the effects that they have.
void conclude(AuditReport& report, std::span<const Rule> rules) {
    std::vector<AuditFinding> conclusions;
    for (const Rule& rule : rules) {
        if (rule.conclude == nullptr || !why_not_applicable(rule, report.subject).empty()) {
            continue;
        }
        FindingCollector collector(rule);
        rule.conclude(report.subject, report.findings, collector);
        for (AuditFinding& finding : collector.take()) {
            finding.is_conclusion = true;
            conclusions.push_back(std::move(finding));
        }
    }
    report.findings.insert(report.findings.end(), std::make_move_iterator(conclusions.begin()),
                           std::make_move_iterator(conclusions.end()));
}

/// Graver findings first, then those with the larger effect.
void sort_findings(std::vector<AuditFinding>& findings) {
    std::stable_sort(findings.begin(), findings.end(), [](const AuditFinding& a, const AuditFinding& b) {
        const auto key = [](const AuditFinding& finding) {
            return std::tuple(-static_cast<int>(finding.severity), finding.effect ? -size_of(*finding.effect) : 0.0);
        };
        return key(a) < key(b);
    });
}

}  // namespace

bool AuditReport::has_critical() const {
    return std::any_of(findings.begin(), findings.end(),
                       [this](const AuditFinding& finding) { return is_open_critical(finding, subject.waivers); });
}

bool is_open_critical(const AuditFinding& finding, std::span<const certificate::Waiver> waivers) {
    return finding.severity == FindingSeverity::critical && waiver_of(finding, waivers) == nullptr;
}

std::vector<bool> take_waivers(AuditReport& report, std::span<const certificate::Waiver> waivers,
                               std::span<const Rule> rules) {
    std::vector<bool> taken;
    for (const certificate::Waiver& waiver : waivers) {
        const bool fits = std::any_of(
            report.findings.begin(), report.findings.end(),
            [&waiver](const AuditFinding& finding) { return waiver_of(finding, std::span(&waiver, 1)) != nullptr; });
        // What the gates of a certificate found is accepted there, by the same list.
        const bool fits_gate =
            report.subject.certificate &&
            std::any_of(report.subject.certificate->findings.begin(), report.subject.certificate->findings.end(),
                        [&waiver](const certificate::Finding& finding) { return finding.id == waiver.finding; });
        if (fits || fits_gate) {
            report.subject.waivers.push_back(waiver);
        }
        taken.push_back(fits || fits_gate);
    }
    if (std::find(taken.begin(), taken.end(), true) != taken.end()) {
        std::erase_if(report.findings, [](const AuditFinding& finding) { return finding.is_conclusion; });
        conclude(report, rules);
        sort_findings(report.findings);
    }
    return taken;
}

std::vector<Sentence> unused_waivers(std::span<const certificate::Waiver> waivers, const std::vector<bool>& taken) {
    std::vector<Sentence> all;
    for (std::size_t i = 0; i < waivers.size(); ++i) {
        const certificate::Waiver& waiver = waivers[i];
        const Sentence sentence =
            waiver.where.empty() ? say("the waiver of {rule} fits no finding", waiver.finding)
                                 : say("the waiver of {rule} at {where} fits no finding", waiver.finding, waiver.where);
        if (!taken[i] && std::find(all.begin(), all.end(), sentence) == all.end()) {
            all.push_back(sentence);
        }
    }
    return all;
}

void accept_findings(AuditReport& report, std::span<const certificate::Waiver> waivers, std::span<const Rule> rules) {
    const std::vector<bool> taken = take_waivers(report, waivers, rules);
    std::vector<Sentence>& said = report.subject.not_read;
    for (Sentence& sentence : unused_waivers(waivers, taken)) {
        if (std::find(said.begin(), said.end(), sentence) == said.end()) {
            said.push_back(std::move(sentence));
        }
    }
}

const certificate::Waiver* waiver_of(const AuditFinding& finding, std::span<const certificate::Waiver> waivers) {
    const auto accepts = [&finding](const certificate::Waiver& waiver) {
        return waiver.finding == finding.rule && (waiver.where.empty() || waiver.where == finding.where ||
                                                  std::find(finding.other_places.begin(), finding.other_places.end(),
                                                            waiver.where) != finding.other_places.end());
    };
    const auto found = finding.of_gate ? waivers.end() : std::find_if(waivers.begin(), waivers.end(), accepts);
    return found == waivers.end() ? nullptr : &*found;
}

AuditReport audit(AuditSubject subject, std::span<const Rule> rules) {
    AuditReport report;
    for (AuditedBudget& budget : subject.budgets) {
        note_uncorrected_U(budget);
    }
    std::vector<SeverityPolicy> policies;
    std::vector<const Rule*> of_rest;
    const auto take = [&report, &policies](const Rule& rule, FindingCollector& collector) {
        for (AuditFinding& finding : collector.take()) {
            report.findings.push_back(std::move(finding));
            policies.push_back(rule.policy);
        }
        for (const Sentence& reason : collector.unchecked()) {
            report.not_checked.push_back({.rule = std::string(rule.id), .because = reason});
        }
        for (const Sentence& sentence : collector.notes()) {
            report.notes.push_back({.rule = std::string(rule.id), .what = sentence});
        }
    };
    for (const Rule& rule : rules) {
        FindingCollector collector(rule);
        if (rule.examine_gates != nullptr) {
            rule.examine_gates(subject, collector);
        }
        Sentence because = why_not_applicable(rule, subject);
        if (!because.empty()) {
            report.not_checked.push_back({.rule = std::string(rule.id), .because = std::move(because)});
        } else {
            if (rule.examine != nullptr && rule.examine != rule.examine_gates) {
                rule.examine(subject, collector);
            }
            if (rule.examine_rest != nullptr) {
                of_rest.push_back(&rule);
            }
        }
        take(rule, collector);
    }
    const std::size_t others = report.findings.size();
    for (const Rule* rule : of_rest) {
        FindingCollector collector(*rule);
        rule->examine_rest(subject, report.findings, collector);
        take(*rule, collector);
    }
    // What is wrong with a row is corrected before what follows from the rows.
    const auto first = static_cast<std::ptrdiff_t>(others);
    std::rotate(report.findings.begin(), report.findings.begin() + first, report.findings.end());
    std::rotate(policies.begin(), policies.begin() + first, policies.end());
    look_again(subject, rules, report.findings, policies);
    const NestedCorrections nested(subject, report.findings);
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        AuditedResult result{.name = budget.name, .unit = budget.unit, .budget = i, .is_nested = nested.is_nested(i)};
        try {
            AuditedBudget of_rows = budget;
            // What the rows alone give, beside what is claimed: their ratio is what no row explains, and other
            // corrections keep it.
            of_rows.u_c_over_rows = of_rows.k_over_rows = of_rows.U_over_k_u_c = of_rows.within_digits =
                of_rows.U_within_digits = 1.0;
            result.recomputed = evaluate(of_rows);
            const BudgetOutcome evaluated = evaluate(budget);
            result.claimed = claimed_outcome(budget, evaluated);
            result.unrounded_U = evaluated.U;
            result.audited = evaluated;
            result.allowed = outcome_intervals(budget);
            if (!evaluated.undecided.empty()) {
                subject.not_read.push_back(
                    say("{result}: verdict or E_n cannot be told; U and the rest stand", budget.name));
            }
            for (const gum::Diagnostic& diagnostic : evaluated.undecided) {
                subject.not_read.push_back(message_in_words(diagnostic));
            }
        } catch (const gum::DiagnosedError& error) {
            subject.not_read.push_back(message_in_words(error.diagnostics().front()));
            continue;
        }
        put_effects(budget, i, report.findings, nested, result);
        report.results.push_back(std::move(result));
    }
    std::map<std::size_t, std::optional<MissingTerm>> missing;  // of a budget: the same for all findings of it
    for (std::size_t i = 0; i < report.findings.size(); ++i) {
        AuditFinding& finding = report.findings[i];
        if (policies[i] == SeverityPolicy::by_effect && finding.effect) {
            const FindingSeverity on_score =
                finding.effect_on_score ? severity_of(*finding.effect_on_score) : FindingSeverity::information;
            finding.severity = std::min(std::max(severity_of(*finding.effect), on_score), finding.at_most);
        }
        if (finding.effect && finding.effect_on_score && finding.effect->budget == finding.effect_on_score->budget) {
            finding.effect_on_score.reset();
        }
        limit_by_what_is_unread(finding, subject);
        // A term that is not there has no size that could be corrected: told is how large it would have to be to be
        // seen.
        if (finding.contribution_missing && !finding.budgets.empty()) {
            const std::size_t of = finding.budgets.front();
            const auto known = missing.find(of);
            finding.missing_term = known != missing.end()
                                       ? known->second
                                       : missing.emplace(of, missing_term(subject.budgets[of])).first->second;
        }
    }
    const std::vector<certificate::Waiver> waivers = std::exchange(subject.waivers, {});
    report.subject = std::move(subject);
    conclude(report, rules);
    sort_findings(report.findings);
    accept_findings(report, waivers, rules);
    return report;
}

}  // namespace gumcert::audit
