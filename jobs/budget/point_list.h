#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "gum/budget/budget.h"
#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_points.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"

namespace gumcert::jobs {

/// Reads points that stand in the job, an array of objects, and adds them.
/// \param pointer  where the array stands in the document
/// \param fits     of the job: their parameters are no inputs
void read_point_list(const nlohmann::json& list, const std::string& pointer, const JsonDocument& document,
                     const BudgetInputs& inputs, const std::vector<gum::BudgetFit>& fits, BudgetPoints& points,
                     ProblemList& problems);

}  // namespace gumcert::jobs
