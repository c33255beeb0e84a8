#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/budget_outcome.h"
#include "audit/finding.h"
#include "audit/subject.h"

namespace gumcert::audit {

/// What the rows of a budget give; nothing where they give no result.
[[nodiscard]] std::optional<BudgetOutcome> outcome_or_none(const AuditedBudget& budget);
/// U, u_c and value as they are claimed, else as the rows give them.
[[nodiscard]] std::optional<double> stated_U(const AuditedBudget& budget);
[[nodiscard]] std::optional<double> stated_u_c(const AuditedBudget& budget);
[[nodiscard]] std::optional<double> stated_value(const AuditedBudget& budget);

/// Positions of the budgets with rows for which something holds.
[[nodiscard]] std::vector<std::size_t> budgets_where(const AuditSubject& subject,
                                                     const std::function<bool(const AuditedBudget&)>& holds);
/// One finding of several budgets, at the first of them. Nothing where there are none.
[[nodiscard]] std::optional<AuditFinding> finding_of_all(const AuditSubject& subject, std::vector<std::size_t> budgets,
                                                         Sentence what);

/// Whether a verdict says that something conforms; nothing where it says neither: "pass", "i.O.", "not conforming".
[[nodiscard]] std::optional<bool> says_conforming(std::string_view verdict);

/// Quantity, comment and source of a row as one text.
[[nodiscard]] std::string words_of_row(const AuditedRow& row);

}  // namespace gumcert::audit
