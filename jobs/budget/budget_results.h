#pragma once

#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget.h"
#include "gum/quantity/unit.h"

namespace gumcert::jobs {

/// Names and units of the results of a budget, without evaluating it.
[[nodiscard]] std::vector<std::pair<std::string, gum::Unit>> budget_results(const gum::Budget& budget);

}  // namespace gumcert::jobs
