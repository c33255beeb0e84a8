#pragma once

#include <vector>

#include "gum/rotary_table/fixture_budget.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The record of the budget of the fixture by itself, its points in the order of the coordinates.
/// \param fixture  of a job with such a budget
/// \param files    that the record holds
[[nodiscard]] reports::EvaluationRecord record_of_fixture_budget(const jobs::RotaryTableJob& job,
                                                                 const gum::FixtureUncertainty& fixture,
                                                                 const std::vector<reports::InputFile>& files);

/// What a record holds of where the uncertainty of the fixture coordinates comes from; also without a budget.
[[nodiscard]] reports::FixtureBudget fixture_budget_record(const jobs::RotaryTableJob& job,
                                                           const gum::FixtureUncertainty& fixture);

}  // namespace gumcert::reports
