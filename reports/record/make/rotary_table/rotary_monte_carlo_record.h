#pragma once

#include "gum/rotary_table/evaluate_rotary_table.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What a record holds of the Monte Carlo of the whole measurement: beside every quantity of the law of propagation its
/// mean, standard uncertainty, coverage intervals and validation, and what they say together.
/// \param record  with everything of the law of propagation in it
void fill_monte_carlo(reports::EvaluationRecord& record, const jobs::RotaryTableJob& job,
                      const gum::RotaryTableResult& result);

}  // namespace gumcert::reports
