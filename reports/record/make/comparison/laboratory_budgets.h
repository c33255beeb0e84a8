#pragma once

#include <string>
#include <vector>

#include "gum/quantity/progress.h"
#include "jobs/comparison/comparison_job.h"

namespace gumcert::reports {

/// The results of a job as they are compared; where a budget stands for a result, the budget is evaluated for its value,
/// its uncertainty and the sources of it.
/// \param refused  receives the items with a budget that gives no result, and those where results share a source that
///                 first-order terms do not tell of (GC-COMPARE-0210)
/// \param remarks  receives what the evaluation of each budget says of its result
/// \throws InputError, NoResultError  those of side_of_budget(), where the job has no other item
[[nodiscard]] std::vector<gum::ParticipantResult> results_with_budgets(const jobs::ComparisonJob& job,
                                                                       const gum::Progress& progress,
                                                                       jobs::RefusedItems& refused,
                                                                       std::vector<std::string>& remarks);

}  // namespace gumcert::reports
