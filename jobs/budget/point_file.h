#pragma once

#include <string>
#include <vector>

#include "gum/budget/budget.h"
#include "jobs/budget/budget_inputs.h"
#include "jobs/budget/budget_points.h"
#include "jobs/job_files.h"
#include "jobs/json_object.h"
#include "jobs/laboratory/laboratory_use.h"

namespace gumcert::jobs {

/// Reads a file of points, one a row, and adds them. A column is `NAME` or `NAME.key` of an input, `NAME.1`, `NAME.2` … of
/// its readings, `NAME.standard`, `NAME.at` … of a standard of the laboratory, `point`, or a column for people.
/// \param name  of the file, as the job states it
/// \param fits  of the job: their parameters are no inputs
void read_point_file(const std::string& name, JobFiles& files, LaboratoryUse& laboratory, const JsonDocument& document,
                     const BudgetInputs& inputs, const std::vector<gum::BudgetFit>& fits, BudgetPoints& points);

}  // namespace gumcert::jobs
