#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/rules/budget_model.h"
#include "audit/rules/registry.h"
#include "audit/stated_outcome.h"

namespace gumcert::audit {
namespace {

// Four digits are printed: a bound is made larger, and what is certain smaller, than they may be off.
constexpr double k_of_digits = 6e-4;
std::string at_most_in_words(double bound, const std::string& unit) {
    return in_words(bound * (1.0 + k_of_digits), unit);
}
std::string at_least_in_words(double certain, const std::string& unit) {
    return in_words(certain * (1.0 - k_of_digits), unit);
}

/// The bound of one result, or why there is none.
struct BoundOfResult {
    std::size_t budget = 0;
    std::optional<gum::TangentBound> bound;
    Sentence why_not;
    double k = 0.0, U = 0.0, delta = 0.0;  ///< delta: half a unit of the last digit of U
};

BoundOfResult bound_of(const AuditSubject& subject, std::size_t position) {
    const AuditedBudget& budget = subject.budgets[position];
    BoundOfResult result;
    result.budget = position;
    if (budget.rests_on_trials) {
        result.why_not = say("U is that of Monte Carlo trials of the model, and does not rest on its tangent");
        return result;
    }
    const std::optional<BudgetOutcome> outcome = outcome_or_none(budget);
    if (budget.equation.empty() || !outcome || !(outcome->U > 0.0)) {
        result.why_not = budget.equation.empty() ? say("no equation is stated") : say("the rows give no u_c");
        return result;
    }
    result.k = outcome->k;
    result.U = outcome->U;
    // Half a unit of the last printed digit of U: what is smaller, no reader of the certificate sees.
    result.delta = 0.5 * std::pow(10.0, std::floor(std::log10(outcome->U)) - budget.digits + 1);
    const std::optional<BudgetModel> model = BudgetModel::of(budget);
    if (!model) {
        result.why_not = say("the equation is implicit, cannot be read, or has no quantity that a row stands for");
        return result;
    }
    if (!model->can_be_evaluated()) {
        result.why_not = model->without_row().empty() ? say("an estimate is missing, or the units do not balance")
                                                      : say("no row, or more than one, stands for {quantities}",
                                                            listed(sentences_of(model->without_row()), 4));
        return result;
    }
    gum::OutputBound bound = model->tangent_bound(model->estimates(budget), model->reach(budget, outcome->k));
    result.bound = bound.bound;
    result.why_not = std::move(bound.why_not);
    return result;
}

Sentence region_in_words(const BoundOfResult& result) {
    return say("within the region of all inputs at once (limits of bounded ones, else ±k u with k = {k:number})",
               in_words(result.k));
}

bool is_validated(const AuditedBudget& budget) {
    return budget.evaluated_here || budget.monte_carlo ||
           std::any_of(budget.rows.begin(), budget.rows.end(), [](const AuditedRow& row) {
               return mentions(row, {"second order", "second-order", "2nd order", "zweiter ordnung", "higher order"});
           });
}

void add_bound(const AuditSubject& subject, const BoundOfResult& result, FindingCollector& findings) {
    const AuditedBudget& budget = subject.budgets[result.budget];
    const gum::TangentBound& bound = *result.bound;
    const bool certain = bound.certain > result.delta;
    AuditFinding finding = finding_of(
        subject, result.budget,
        certain ? say("the equation leaves its tangent by {certain:number} at least, {region}: more than half "
                      "a unit of the last digit of U",
                      at_least_in_words(bound.certain, budget.unit), region_in_words(result))
                : say("it is not proved that the law of propagation keeps the last digit of U: {region} "
                      "what the tangent leaves out is bounded by {bound:number}",
                      region_in_words(result), at_most_in_words(bound.largest(), budget.unit)));
    finding.evidence = {
        say("f − tangent from {low:number} to {high:number}", in_words(bound.low), in_words(bound.high, budget.unit)),
        equals("U", in_words(result.U, budget.unit)),
        say("half a unit of the last digit = {delta:number}", in_words(result.delta, budget.unit))};
    finding.kind = certain ? "certain" : "possible";
    findings.add(std::move(finding),
                 // A bound by interval arithmetic may be much larger than the truth: only what certainly is off counts
                 // against anybody.
                 certain && !is_validated(budget) ? FindingSeverity::major : FindingSeverity::information);
}

/// S19
void certified_bound(const AuditSubject& subject, FindingCollector& findings) {
    std::map<Sentence, std::vector<std::string>> reasons;
    std::optional<BoundOfResult> worst;
    std::size_t bounded = 0;
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        BoundOfResult result = bound_of(subject, b);
        if (!result.bound) {
            reasons[result.why_not].push_back(subject.budgets[b].name);
        } else if (result.bound->largest() > result.delta) {
            add_bound(subject, result, findings);
        } else {
            ++bounded;
            const auto share = [](const BoundOfResult& one) { return one.bound->largest() / one.delta; };
            if (!worst || share(result) > share(*worst)) {
                worst = std::move(result);
            }
        }
    }
    if (worst) {
        const AuditedBudget& budget = subject.budgets[worst->budget];
        Sentence note =
            say("{budget}: {region} what the tangent leaves out is bounded by {bound:number}; half a unit of the last "
                "digit of U is {delta:number}",
                budget.name, region_in_words(*worst), at_most_in_words(worst->bound->largest(), budget.unit),
                in_words(worst->delta, budget.unit));
        findings.note(bounded > 1
                          ? say("{note}; the worst of {count:number} results", std::move(note), std::to_string(bounded))
                          : std::move(note));
    }
    for (const auto& [reason, names] : reasons) {
        findings.leave_unchecked(say("{names}: {reason:sentence}", listed(sentences_of(names), 4), reason));
    }
}

}  // namespace

Rule certified_bound_rule() {
    return {
        .id = "S19",
        .title = "Certified bound of the linearisation",
        .clause = {.text = "JCGM 100:2008, 5.1.2 (note)", .verified = true},
        .policy = SeverityPolicy::fixed,
        .severity = FindingSeverity::information,
        .needs = {Need::rows, Need::model},
        .detection =
            "the second derivatives of the equation, enclosed by interval arithmetic over the region of all "
            "inputs at once, bound what the tangent leaves out; a bound above half a unit of the last digit "
            "of U is told. Major where the equation certainly leaves its tangent by more, and nothing says "
            "that the law of propagation was validated. A result whose U is that of Monte Carlo trials does not rest "
            "on "
            "the tangent",
        .correction = "Use Monte Carlo, or add the terms of second order; where they are known to be small, nothing.",
        .question = "How was it seen that the equation is linear enough over its uncertainties?",
        .examine = certified_bound};
}

}  // namespace gumcert::audit
