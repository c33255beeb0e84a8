#pragma once

#include <optional>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/studies/line_of_sight.h"
#include "gum/rotary_table/studies/plan_request.h"

namespace gumcert::gum::plan {

/// Lines of sight as a job states them, with directions in the order of the reflectors; nothing where it says nothing of them.
/// \throws InputError  GC-PLAN-0003 for a reflector inside an obstacle
[[nodiscard]] std::optional<engine::LineOfSight> sight_of(const SightStatement& stated,
                                                          const engine::RotaryTableMeasurement& layout);

/// The layout without the distances that no beam reaches.
/// \param whole  with the positions of its stations
/// \throws InputError  GC-PLAN-0004 for every station that sees nothing
[[nodiscard]] engine::RotaryTableMeasurement seen_layout(const engine::RotaryTableMeasurement& whole,
                                                         const engine::LineOfSight& sight);

}  // namespace gumcert::gum::plan
