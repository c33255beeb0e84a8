#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/rules/gate_findings.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

constexpr Clause k_not_below{.text = "ILAC-P14:09/2020, 5.5", .verified = true};
constexpr Clause k_includes_item{.text = "ILAC-P14:09/2020, 5.4", .verified = true};
constexpr Clause k_capability_stated{.text = "ILAC-P14:09/2020, section 4", .verified = false};
constexpr Clause k_symbol{.text = "ILAC-P8, and the rules of the accreditation body", .verified = false};

constexpr double k_noise = 1e-9;  // of a conversion of units

/// k u_c of the rows, without the floor.
std::optional<double> computed_U(const AuditedBudget& budget) {
    AuditedBudget of_rows = budget;
    of_rows.floor_applied = false;
    of_rows.u_c_over_rows = of_rows.k_over_rows = of_rows.U_over_k_u_c = 1.0;
    const std::optional<BudgetOutcome> outcome = outcome_or_none(of_rows);
    return outcome ? std::optional(outcome->U) : std::nullopt;
}

/// X01
void below_capability(const AuditSubject& subject, FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<double> U = stated_U(budget);
        if (!budget.capability || !U || *U >= *budget.capability * (1.0 - k_noise)) {
            continue;
        }
        AuditFinding finding = finding_of(subject, i,
                                          say("U = {U:number} is below the capability {capability:number}",
                                              in_words(*U, budget.unit), in_words(*budget.capability, budget.unit)));
        finding.evidence = {equals("U", in_words(*U, budget.unit)),
                            equals("CMC", in_words(*budget.capability, budget.unit))};
        finding.expected = say("at least {least:number}", in_words(*budget.capability, budget.unit));
        finding.actual = say_number(in_words(*U, budget.unit));
        if (!budget.floor_applied) {
            finding.correct = [](AuditedBudget& corrected) { corrected.floor_applied = true; };
        }
        findings.add(std::move(finding));
    }
}

/// X03: U is the capability everywhere, though rows give something else.
void always_the_capability(const AuditSubject& subject, FindingCollector& findings) {
    std::vector<std::size_t> equal;
    bool all = true, explained = true;
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<double> U = stated_U(budget);
        if (!budget.capability || !U) {
            continue;
        }
        all = all && is_about(*U, *budget.capability, k_noise);
        const std::optional<double> computed = computed_U(budget);
        // Where the rows stay below the capability at each point, it is rightly stated in the place of U at all of
        // them.
        explained = explained && computed && *computed <= *budget.capability;
        equal.push_back(i);
    }
    if (all && !explained && equal.size() > 1) {
        findings.add(*finding_of_all(
            subject, equal,
            say("the stated U equals the capability at all {count:number} points, and the rows do not give that",
                std::to_string(equal.size()))));
    }
}

/// X07: k u_c is nowhere above the capability, so that no budget is ever seen.
void floor_hides_budget(const AuditSubject& subject, FindingCollector& findings) {
    std::vector<std::size_t> points;
    std::vector<Sentence> ratios;
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const AuditedBudget& budget = subject.budgets[i];
        const std::optional<double> computed = computed_U(budget);
        if (!budget.capability || !computed) {
            continue;
        }
        // A stated U below the capability is not hidden by it (X01).
        const std::optional<double> stated = stated_U(budget);
        if (*computed >= *budget.capability || !stated || *stated < (1.0 - k_noise) * *budget.capability) {
            return;
        }
        points.push_back(i);
        ratios.push_back(say("k·u_c/CMC = {ratio:number} ({result})",
                             text::significant(*computed / *budget.capability, 3), budget.name));
    }
    std::optional<AuditFinding> finding =
        finding_of_all(subject, points,
                       say("the capability is larger than k·u_c of the budget at every point: what is stated is the "
                           "capability, and the budget is never seen"));
    if (finding) {
        finding->evidence = std::move(ratios);
        findings.add(std::move(*finding));
    }
}

/// X08
void capability_without_reference(const AuditSubject& subject, FindingCollector& findings) {
    const bool scope = subject.certificate && subject.certificate->data.accreditation &&
                       !subject.certificate->data.accreditation->scope.empty();
    std::vector<std::size_t> bare;
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        if (subject.budgets[i].capability && !scope) {
            bare.push_back(i);
        }
    }
    if (std::optional<AuditFinding> finding = finding_of_all(
            subject, bare, say("the capability is a number without the line of the scope that it comes from"))) {
        const AuditedBudget& budget = subject.budgets[bare.front()];
        finding->evidence = {equals("CMC", in_words(*budget.capability, budget.unit))};
        findings.add(std::move(*finding));
    }
}

}  // namespace

std::vector<Rule> scope_rules() {
    return {
        {.id = "X01",
         .title = "U below the capability",
         .clause = k_not_below,
         .severity = FindingSeverity::critical,
         .needs = {Need::capability},
         .detection = "the stated U, as printed, against the capability at each point; finding X01 of the gates",
         .correction = "State the capability in place of a smaller U, or the result as not accredited.",
         .question = "Where does the sheet hold U against the capability, and does that work for this point?",
         .examine = below_capability},
        {.id = "X02",
         .title = "Outside of the scope with the symbol",
         .clause = k_symbol,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection =
             "findings X02, X08 and X12 of the gates: measurand, range, method and place on the days of the work",
         .correction = "Issue without the accreditation, or correct scope, method or place.",
         .question = "Which line of the scope covers this result?",
         .examine = take_gate_findings},
        {.id = "X03",
         .title = "U equals the capability at all points",
         .clause = k_includes_item,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::information,
         .needs = {Need::capability},
         .detection =
             "equality at every point, where the rows do not fall below the capability; finding X03 of the gates",
         .correction = "See whether the contributions of the item are in the budget.",
         .question = "Is U computed, or is the capability copied?",
         .examine = always_the_capability},
        {.id = "X04",
         .title = "Scope expired or suspended",
         .clause = k_symbol,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "findings X04 and X09 of the gates: validity of the scope on the days of performance and issue",
         .correction = "Issue without the accreditation, or state the days of the certificate of accreditation.",
         .question = "Was the accreditation valid on these days?",
         .examine = take_gate_findings},
        {.id = "X05",
         .title = "Capability ambiguous",
         .clause = k_capability_stated,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::major,
         .needs = {Need::certificate},
         .detection = "findings X05, X11 and X13 of the gates: open intervals, no rule between points, no range, no "
                      "measurand",
         .correction = "State the capability as the scope does.",
         .question = "How does the scope word this capability?",
         .examine = take_gate_findings},
        {.id = "X06",
         .title = "Accredited and other results mixed",
         .clause = k_symbol,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "findings X06, X07 and X15 of the gates, by the profile of the accreditation body",
         .correction = "Mark what is not accredited, or give it in a document of its own.",
         .question = "Which results of this document are accredited?",
         .examine = take_gate_findings},
        {.id = "X07",
         .title = "The capability hides the budget",
         .clause = k_includes_item,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::information,
         .needs = {Need::rows, Need::capability},
         .detection = "k·u_c below the capability at every point; the ratios are listed",
         .correction = "Nothing; where the budget is right, the capability could be stated smaller.",
         .question = "Why is the capability larger than the budget at every point?",
         .examine = floor_hides_budget},
        {.id = "X08",
         .title = "Capability without reference to the scope, or below its own standards",
         .clause = k_capability_stated,
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::minor,
         .needs = {Need::capability},
         .detection = "a capability as a bare number, and no scope beside it; finding X14 of the gates",
         .correction = "Name the line of the scope, and take the number from it.",
         .question = "Which line of the scope is this number, and does its band hold the point?",
         .examine = capability_without_reference},
    };
}

}  // namespace gumcert::audit
