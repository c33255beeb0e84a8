#pragma once

#include "engine/job/rotary_table_job.h"
#include "gum/propagation.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Comparison of the error motions with the readings of the reference method of a job (ISO 13528: E_n numbers).
/// \param displacement  of the contact point, angle by angle, x, y, z, [m]
[[nodiscard]] reports::Comparison reference_comparison(const engine::RotaryTableJob& job,
                                                       const gum::Propagation& displacement);

}  // namespace gumcert::app
