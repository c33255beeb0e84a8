#include "audit/nested_budgets.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {
namespace {

bool are_all_one(const RowFactors& factors) {
    return std::all_of(factors.begin(), factors.end(), [](const std::vector<double>& of_budget) {
        return std::all_of(of_budget.begin(), of_budget.end(), [](double factor) { return factor == 1.0; });
    });
}

bool contains(const std::vector<std::size_t>& ascending, std::size_t one) {
    return std::binary_search(ascending.begin(), ascending.end(), one);
}

/// Limits, capability and rounding do not come from the evaluation.
void take_over_decision(const AuditedBudget& from, AuditedBudget& to) {
    to.capability = from.capability;
    to.floor_applied = from.floor_applied;
    to.limits = from.limits;
    to.rule = from.rule;
    to.rule_parameters = from.rule_parameters;
    to.digits = from.digits;
    to.rounding = from.rounding;
}

}  // namespace

std::optional<RowFactors> row_factors(std::span<const AuditedBudget> claimed,
                                      std::span<const AuditedBudget> corrected) {
    RowFactors factors;
    for (std::size_t i = 0; i < claimed.size(); ++i) {
        if (corrected[i].rows.size() != claimed[i].rows.size() ||
            corrected[i].correlations.size() != claimed[i].correlations.size()) {
            return std::nullopt;
        }
        std::vector<double>& of_budget = factors.emplace_back();
        for (std::size_t row = 0; row < claimed[i].rows.size(); ++row) {
            const double before = contribution_of(claimed[i].rows[row]);
            const double after = contribution_of(corrected[i].rows[row]);
            // A row of 0 cannot be corrected by a factor, and the job knows its inputs by factors only.
            if (before == 0.0 && after > 0.0) {
                return std::nullopt;
            }
            of_budget.push_back(before == after ? 1.0 : after / before);
        }
    }
    return factors;
}

NestedCorrections::NestedCorrections(const AuditSubject& subject, const std::vector<AuditFinding>& findings)
    : subject_(subject), findings_(findings) {
    if (!subject.nested) {
        return;
    }
    for (std::size_t i = 0; i < subject.nested->count; ++i) {
        claimed_.push_back(without_texts(subject.budgets[subject.nested->first + i]));
    }
    for (std::size_t i = 0; i < findings.size(); ++i) {
        if (changes(i)) {
            changing_.push_back(i);
        }
    }
}

bool NestedCorrections::is_nested(std::size_t budget) const {
    return subject_.nested && budget >= subject_.nested->first &&
           budget < subject_.nested->first + subject_.nested->count;
}

bool NestedCorrections::is_dependent(std::size_t budget) const {
    return subject_.nested && std::find(subject_.nested->dependent.begin(), subject_.nested->dependent.end(), budget) !=
                                  subject_.nested->dependent.end();
}

std::vector<AuditedBudget> NestedCorrections::corrected(const std::vector<std::size_t>& chosen) const {
    std::vector<AuditedBudget> budgets = claimed_;
    for (const std::size_t finding : chosen) {
        for (std::size_t i = 0; i < budgets.size(); ++i) {
            if (const Correction* correction = correction_of(findings_[finding], subject_.nested->first + i)) {
                (*correction)(budgets[i]);
            }
        }
    }
    return budgets;
}

bool NestedCorrections::changes(std::size_t finding) const {
    const std::optional<RowFactors> factors = row_factors(claimed_, corrected({finding}));
    if (!factors || are_all_one(*factors)) {
        return false;
    }
    try {
        // Tried once: a correction that leaves the job without a result must not end the audit later.
        return !subject_.nested->evaluate_again(*factors).empty();
    } catch (const gum::DiagnosedError&) {  // without this row there is no result
        return false;
    }
}

std::optional<AuditedBudget> NestedCorrections::evaluated_again(std::size_t budget,
                                                                const std::vector<std::size_t>& chosen) const {
    const std::optional<RowFactors> factors = row_factors(claimed_, corrected(chosen));
    if (!factors || are_all_one(*factors)) {
        return std::nullopt;
    }
    const std::vector<std::size_t>& dependent = subject_.nested->dependent;
    const auto position = std::find(dependent.begin(), dependent.end(), budget) - dependent.begin();
    AuditedBudget again = subject_.nested->evaluate_again(*factors)[static_cast<std::size_t>(position)];
    take_over_decision(subject_.budgets[budget], again);
    return again;
}

ShareDivision NestedCorrections::division(std::size_t budget, const std::vector<std::size_t>& of) const {
    const auto nested =
        std::count_if(of.begin(), of.end(), [this](std::size_t finding) { return contains(changing_, finding); });
    return share_division(of.size(), subject_.budgets[budget].rows.size(), static_cast<std::size_t>(nested));
}

std::vector<Effect> NestedCorrections::effects_on(std::size_t budget, const std::vector<std::size_t>& of) const {
    const AuditedBudget bare = without_texts(subject_.budgets[budget]);
    const BudgetOutcome itself = evaluate(bare);
    return effects_of(of.size(), division(budget, of), [&](const ChosenCorrections& chosen) {
        std::vector<std::size_t> nested, made;
        for (std::size_t i = 0; i < of.size(); ++i) {
            if (chosen[i]) {
                made.push_back(of[i]);
            }
        }
        std::copy_if(made.begin(), made.end(), std::back_inserter(nested),
                     [this](std::size_t finding) { return contains(changing_, finding); });
        try {
            AuditedBudget budget_now = evaluated_again(budget, nested).value_or(bare);
            for (const std::size_t finding : made) {
                if (const Correction* own = correction_of(findings_[finding], budget)) {
                    (*own)(budget_now);
                }
            }
            return evaluate(budget_now);
        } catch (const gum::DiagnosedError&) {
            return itself;  // corrections that leave nothing to evaluate change nothing
        }
    });
}

}  // namespace gumcert::audit
