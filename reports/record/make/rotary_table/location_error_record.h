#pragma once

#include "gum/rotary_table/location_errors.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What a record holds of the location errors of the axis, and of the points that carry the frame of the machine.
void fill_location_errors(reports::RotaryTable& rotary, const jobs::RotaryTableJob& job,
                          const gum::LocationErrors& errors);

}  // namespace gumcert::reports
