#pragma once

#include <string>
#include <utility>
#include <vector>

#include "engine/job/budget_job.h"
#include "gum/quantity/unit.h"

namespace gumcert::engine {

/// Names and units of the results of a budget, without evaluating it.
[[nodiscard]] std::vector<std::pair<std::string, gum::Unit>> budget_results(const BudgetJob& budget);

}  // namespace gumcert::engine
