#pragma once

#include "gum/rotary_table/fixture_budget.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What a record holds of where the uncertainty of the fixture coordinates comes from; also without a budget.
[[nodiscard]] reports::FixtureBudget fixture_budget_record(const jobs::RotaryTableJob& job,
                                                           const gum::FixtureUncertainty& fixture);

}  // namespace gumcert::reports
