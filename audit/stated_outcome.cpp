#include "audit/stated_outcome.h"

#include <utility>

#include "audit/row_edits.h"
#include "audit/word_line.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {

std::optional<BudgetOutcome> outcome_or_none(const AuditedBudget& budget) {
    try {
        return evaluate(budget);
    } catch (const gum::DiagnosedError&) {
        return std::nullopt;
    }
}

std::optional<double> stated_U(const AuditedBudget& budget) {
    if (budget.claims.U) {
        return budget.claims.U->value;
    }
    const std::optional<BudgetOutcome> outcome = outcome_or_none(budget);
    return outcome ? std::optional(outcome->U) : std::nullopt;
}

std::optional<double> stated_u_c(const AuditedBudget& budget) {
    if (budget.claims.u_c) {
        return budget.claims.u_c->value;
    }
    const std::optional<BudgetOutcome> outcome = outcome_or_none(budget);
    return outcome ? std::optional(outcome->u_c) : std::nullopt;
}

std::optional<double> stated_value(const AuditedBudget& budget) {
    return budget.claims.value ? std::optional(budget.claims.value->value) : budget.value;
}

std::vector<std::size_t> budgets_where(const AuditSubject& subject,
                                       const std::function<bool(const AuditedBudget&)>& holds) {
    std::vector<std::size_t> positions;
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        if (!subject.budgets[i].rows.empty() && holds(subject.budgets[i])) {
            positions.push_back(i);
        }
    }
    return positions;
}

std::optional<AuditFinding> finding_of_all(const AuditSubject& subject, std::vector<std::size_t> budgets,
                                           Sentence what) {
    if (budgets.empty()) {
        return std::nullopt;
    }
    AuditFinding finding = finding_of(subject, budgets.front(), std::move(what));
    if (budgets.size() > 1) {
        finding.where += " and " + std::to_string(budgets.size() - 1) + " more";
    }
    finding.budgets = std::move(budgets);
    finding.kind = finding.what.english();  // budgets that lack something else are another finding
    return finding;
}

std::optional<bool> says_conforming(std::string_view verdict) {
    const WordLine words(verdict);
    if (words.has_any(
            {"not ", "nicht", "fail", "reject", "out of", "non ", "nonconform", "n i o", "nio ", "conditional fail"})) {
        return false;
    }
    if (words.has_any({"pass", "ok ", "conform", "compl", "bestanden", "accept", "in tol", "within", "i o ", "io ",
                       "conditional pass", "konform", "gut "})) {
        return true;
    }
    return std::nullopt;
}

std::string words_of_row(const AuditedRow& row) {
    return row.quantity + "; " + row.comment + "; " + row.source;
}

}  // namespace gumcert::audit
