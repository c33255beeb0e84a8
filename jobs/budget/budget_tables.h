#pragma once

#include <vector>

#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_job.h"
#include "jobs/budget/budget_points.h"
#include "jobs/json_object.h"

namespace gumcert::jobs {

/// Reads the key `tables` of a job, or of each of its sections, and resolves the names in it, the certificate of the job
/// being read already. Without the key a job whose points have columns of their own, or whose quantities have roles, gets one table with all of its points.
///
/// Checks that tables leave out no point and no U, and that every point has the limits that a specification states for
/// it; fills in tables, units of results by points, and the columns of the inputs that tables and limits name.
/// \param parts   the sections of the job, or the job itself
/// \param inputs  those of the job
/// \param points  of all sections, read
void read_tables(const std::vector<JsonObject>& parts, const JsonDocument& document, const BudgetInputs& inputs,
                 const BudgetPoints& points, BudgetJob& job, ProblemList& problems);

}  // namespace gumcert::jobs
