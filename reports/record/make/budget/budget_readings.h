#pragma once

#include "jobs/budget/budget_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Puts the repeated readings of a job into its record, with what they say of themselves: those of the job where they
/// are in force at some point of its table (or where it has none), and those that points state in their place. Nothing
/// that no result rests on.
///
/// Fills `readings` (autocorrelation), `variance_analyses` and `outliers` (Grubbs' test of observations, of the
/// readings in each group, and of the means of groups).
void add_readings(const jobs::BudgetJob& job, reports::EvaluationRecord& record);

}  // namespace gumcert::reports
