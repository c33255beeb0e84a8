#pragma once

#include <vector>

#include "engine/job/comparison_job.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

/// The results of a job as they are compared; where a budget stands for a result, the budget is evaluated for its value,
/// its uncertainty and the sources of it.
/// \param refused  receives the items with a budget that gives no result
/// \throws InputError, NoResultError  those of side_of_budget(), where the job has no other item
[[nodiscard]] std::vector<gum::ParticipantResult> results_with_budgets(const engine::ComparisonJob& job,
                                                                       const gum::Progress& progress,
                                                                       engine::RefusedItems& refused);

}  // namespace gumcert::app
