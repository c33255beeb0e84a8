#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/unit.h"
#include "jobs/budget/budget_job.h"

namespace gumcert::jobs {

/// Names and units of the results of a budget, without evaluating it.
[[nodiscard]] std::vector<std::pair<std::string, gum::Unit>> budget_results(const gum::Budget& budget);

/// Unit in which a result of a point is stated: that of a table that wants another one, else that of the result.
/// \param output  position in the outputs of the point
[[nodiscard]] const gum::Unit& result_unit(const BudgetJob& job, const gum::BudgetPointResult& point,
                                           std::size_t output);

}  // namespace gumcert::jobs
