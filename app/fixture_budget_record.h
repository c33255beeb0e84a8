#pragma once

#include "engine/job/rotary_table_job.h"
#include "gum/rotary_table/fixture_budget.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// What a record holds of where the uncertainty of the fixture coordinates comes from; also without a budget.
[[nodiscard]] reports::FixtureBudget fixture_budget_record(const engine::RotaryTableJob& job,
                                                           const gum::FixtureUncertainty& fixture);

}  // namespace gumcert::app
