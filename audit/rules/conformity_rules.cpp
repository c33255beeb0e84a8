#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/row_edits.h"
#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "certificate/stated_text.h"

#include "text/numbers.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_rule_documented{.text = "ISO/IEC 17025:2017, 7.8.6.2 c", .verified = true};
constexpr Clause k_rule_agreed{.text = "ISO/IEC 17025:2017, 7.1.3", .verified = true};
constexpr Clause k_specification_named{.text = "ISO/IEC 17025:2017, 7.8.6.2 b", .verified = true};
constexpr Clause k_verdict_follows{.text = "ISO/IEC 17025:2017, 7.8.6.1", .verified = true};
constexpr Clause k_ratio{.text = "ILAC-G8:09/2019", .verified = false};
constexpr Clause k_as_found{.text = "ISO/IEC 17025:2017, 7.8.4.1 d", .verified = true};
constexpr Clause k_parts_assessed{.text = "ISO/IEC 17025:2017, 7.8.6.2 a and b", .verified = true};
constexpr Clause k_sound_uncertainty{.text = "ISO/IEC 17025:2017, 7.6 and 7.8.6", .verified = true};

bool has_limits_stated(const AuditedBudget& budget) {
    return budget.limits.lower || budget.limits.upper;
}

/// D01
void verdict_without_rule(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        if (!budget.claims.verdict.empty() && !budget.rule && budget.rule_not_known.empty()) {
            findings.add(finding_of(
                subject, i, say("the verdict \"{verdict}\" is stated without a decision rule", budget.claims.verdict)));
        }
    }
}

/// D03
void verdict_without_limits(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        if (!budget.claims.verdict.empty() && !has_limits_stated(budget)) {
            findings.add(finding_of(subject, i,
                                    say("the verdict \"{verdict}\" is stated without limits", budget.claims.verdict)));
        }
    }
}

/// The decision by the numbers as they are printed: value and U of the claims.
std::optional<BudgetOutcome> outcome_of_claims(const AuditedBudget& budget) {
    AuditedBudget printed = budget;
    const std::optional<BudgetOutcome> outcome = outcome_or_none(budget);
    if (!outcome) {
        return std::nullopt;
    }
    if (budget.claims.value) {
        printed.value = budget.claims.value->value;
    }
    if (budget.claims.U) {
        printed.floor_applied = false;
        const std::optional<BudgetOutcome> bare = outcome_or_none(printed);
        // The floor of the capability is in the claimed U already; applied once more it would move the limit of
        // acceptance.
        printed.U_over_k_u_c *= budget.claims.U->value / (bare ? bare->U : outcome->U);
    }
    return outcome_or_none(printed);
}

/// A verdict that a rule gives; one that is stated stays as it stands there.
Sentence decided_in_words(const std::string& verdict) {
    return verdict == "pass"               ? say("pass")
           : verdict == "fail"             ? say("fail")
           : verdict == "conditional_pass" ? say("conditional_pass")
           : verdict == "conditional_fail" ? say("conditional_fail")
                                           : Sentence(verdict);
}

/// D04
void verdict_does_not_follow(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        if (budget.evaluated_here && !budget.claims.U) {
            continue;  // an interval is stated: no U decides
        }
        const std::optional<BudgetOutcome> printed = outcome_of_claims(budget), unrounded = outcome_or_none(budget);
        if (!printed || !unrounded || printed->verdict.empty() || printed->verdict == k_no_decision) {
            continue;
        }
        const std::optional<bool> claimed = says_conforming(budget.claims.verdict),
                                  decided = says_conforming(printed->verdict);
        if (claimed && claimed != decided) {
            AuditFinding finding = finding_of(subject, i,
                                              say("the verdict \"{verdict}\" does not follow from the rule, which "
                                                  "gives \"{decided}\" for the stated value and U",
                                                  budget.claims.verdict, decided_in_words(printed->verdict)));
            finding.expected = decided_in_words(printed->verdict);
            finding.actual = budget.claims.verdict;
            finding.kind = "claimed";
            findings.add(std::move(finding));
        } else if (printed->verdict != unrounded->verdict && !unrounded->verdict.empty()) {
            AuditFinding finding = finding_of(
                subject, i,
                say("the verdict is \"{unrounded}\" with the unrounded numbers and \"{printed}\" with the printed ones",
                    decided_in_words(unrounded->verdict), decided_in_words(printed->verdict)));
            finding.expected = decided_in_words(unrounded->verdict);
            finding.actual = decided_in_words(printed->verdict);
            finding.kind = "printed";
            findings.add(std::move(finding));
        }
    }
}

/// D05
void ratio_too_small(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<double> least = budget.rule_parameters.test_uncertainty_ratio, U = stated_U(budget);
        if (!least || !U || !(*U > 0.0) || !budget.limits.two_sided() || budget.rule_parameters.alternative) {
            continue;
        }
        const double ratio = (*budget.limits.upper - *budget.limits.lower) / (2.0 * *U);
        constexpr double k_rounding = 1e-9;
        if (ratio >= *least * (1.0 - k_rounding)) {
            continue;
        }
        AuditFinding finding = finding_of(subject, i,
                                          say("the test uncertainty ratio is {ratio:number}, below the {least:number} "
                                              "of the rule, and no alternative is agreed on",
                                              text::significant(ratio, 3), text::significant(*least, 3)));
        finding.expected = say("at least {least:number}", text::significant(*least, 3));
        finding.actual = say_number(text::significant(ratio, 3));
        findings.add(std::move(finding));
    }
}

/// D06
void state_as_found_not_shown(const AuditSubject& subject, FindingCollector& findings) {
    const certificate::Certificate& certificate = *subject.certificate;
    const bool adjusted = certificate.data.adjustment && certificate.data.adjustment->adjusted;
    const bool decided = std::any_of(certificate.tables.begin(), certificate.tables.end(), [](const auto& table) {
        return std::any_of(table.columns.begin(), table.columns.end(), [](const auto& column) {
            return std::any_of(column.values.begin(), column.values.end(),
                               [](const auto& value) { return value.verdict.has_value(); });
        });
    });
    if (!adjusted || !decided || certificate::is_stated(certificate.data.adjustment->as_found)) {
        return;
    }
    AuditFinding finding;
    finding.where = "/adjustment/as_found";
    finding.what = say("the item was adjusted, conformity is stated, and nothing is said of the results before");
    findings.add(std::move(finding));
}

/// D08
void verdict_on_open_findings(const AuditSubject& subject, std::span<const AuditFinding> others,
                              FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        if (budget.claims.verdict.empty() && !(budget.rule && has_limits_stated(budget))) {
            continue;
        }
        std::vector<std::string> open, critical;
        for (const AuditFinding& other : others) {
            const bool touches = std::find(other.budgets.begin(), other.budgets.end(), i) != other.budgets.end();
            // Findings on documents and persons leave the uncertainty, and with it the verdict, as they are.
            const bool of_uncertainty = other.correct || other.contribution_missing;
            const bool is_open = waiver_of(other, subject.waivers) == nullptr;
            if (touches && of_uncertainty && is_open && other.severity >= FindingSeverity::major &&
                std::find(open.begin(), open.end(), other.rule) == open.end() &&
                std::find(critical.begin(), critical.end(), other.rule) == critical.end()) {
                (other.severity == FindingSeverity::critical ? critical : open).push_back(other.rule);
            }
        }
        if (open.empty() && critical.empty()) {
            continue;
        }
        const Sentence grave = all_of(sentences_of(critical)), other = all_of(sentences_of(open));
        AuditFinding finding = finding_of(
            subject, i,
            open.empty()
                ? say("conformity is decided with an uncertainty on which critical findings are open: {critical}",
                      grave)
            : critical.empty()
                ? say("conformity is decided with an uncertainty on which major findings are open: {open}", other)
                : say("conformity is decided with an uncertainty on which critical findings are open: {critical}, and "
                      "major "
                      "ones: {open}",
                      grave, other));
        open.insert(open.begin(), critical.begin(), critical.end());
        finding.evidence = sentences_of(open);
        findings.add(std::move(finding));
    }
}

}  // namespace

std::vector<Rule> conformity_rules() {
    return {
        {.id = "D01",
         .title = "Verdict without decision rule",
         .clause = k_rule_documented,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::results},
         .detection = "a verdict beside a budget without a rule; findings D01 and D10 of the gates",
         .correction = "State the rule that was agreed on.",
         .question = "By which rule was conformity decided?",
         .examine = verdict_without_rule},
        {.id = "D02",
         .title = "Rule agreed on after the measurement",
         .clause = k_rule_agreed,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "finding D02 of the gates",
         .correction = "Agree on specification and rule before the work; state day and partner.",
         .question = "When and with whom was the rule agreed on?",
         .examine = take_gate_findings},
        {.id = "D03",
         .title = "Specification without edition or limits",
         .clause = k_specification_named,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::results},
         .detection = "a verdict beside a budget without limits; finding D03 of the gates",
         .correction = "State document, edition and limits.",
         .question = "Which limits does the verdict rest on?",
         .examine = verdict_without_limits},
        {.id = "D04",
         .title = "Verdict does not follow from the rule",
         .clause = k_verdict_follows,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::limits},
         .detection = "the rule applied to the stated value and U, and to the unrounded ones; finding D04 of the gates",
         .correction = "State the verdict that the rule gives; agree how a value at the limit is decided.",
         .question = "How was the verdict decided?",
         .examine = verdict_does_not_follow},
        {.id = "D05",
         .title = "Uncertainty too large for the rule",
         .clause = k_ratio,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::limits},
         .detection =
             "(TU − TL)/(2U) below the least ratio of the rule, and no alternative; findings D05, D08 and D11 of the "
             "gates",
         .correction = "Agree on a rule with a guard band, or measure with a smaller uncertainty.",
         .question = "What was agreed on for a ratio that is not reached?",
         .examine = ratio_too_small},
        {.id = "D06",
         .title = "Results before adjustment not shown",
         .clause = k_as_found,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::gates},
         .detection = "an adjusted item with a verdict, and nothing said of the results before",
         .correction = "Report the results before adjustment, or why there are none.",
         .question = "Did the item conform as it was received?",
         .examine = state_as_found_not_shown},
        {.id = "D07",
         .title = "Conformity claimed for more than was assessed",
         .clause = k_parts_assessed,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "findings D07 and D09 of the gates",
         .correction = "Say which clauses were assessed.",
         .question = "Which parts of the specification were assessed?",
         .examine = take_gate_findings},
        {.id = "D08",
         .title = "Verdict on an uncertainty with open findings",
         .clause = k_sound_uncertainty,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::rows, Need::limits},
         .detection = "a verdict, or limits with a rule, and major or critical findings of this audit on the same "
                      "budget that nobody "
                      "accepts",
         .correction = "Correct the uncertainty, and decide again.",
         .question = "Does the verdict stand with the corrected uncertainty?",
         .conclude = verdict_on_open_findings},
    };
}

}  // namespace gumcert::audit
