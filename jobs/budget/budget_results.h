#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget.h"
#include "gum/quantity/unit.h"
#include "jobs/budget/budget_job.h"

namespace gumcert::jobs {

/// Names and units of the results of a budget, without evaluating it.
[[nodiscard]] std::vector<std::pair<std::string, gum::Unit>> budget_results(const gum::Budget& budget);

/// Unit in which a result of a point is stated.
/// \param unit  of the result, where no table wants another one
[[nodiscard]] const gum::Unit& result_unit(const BudgetJob& job, std::size_t point, const std::string& result,
                                           const gum::Unit& unit);

}  // namespace gumcert::jobs
