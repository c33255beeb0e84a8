#pragma once

#include <optional>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "jobs/rotary_table/rotary_table_reading.h"

namespace gumcert::jobs {

/// The step that displayed lengths were rounded to: the largest of which the lengths of each dead path differ by multiples, [m].
/// A constant of a dead path, as of a preset, does not hide it. Nothing where digits go beyond the nanometre, or where
/// so few lengths of a dead path differ that they agree by chance.
[[nodiscard]] std::optional<double> step_of_lengths(const std::vector<engine::LengthObservation>& lengths);

/// Tells lengths whose step says more than their stated uncertainty has in it: step/√12 (JCGM 100:2008, F.2.2.1). What is
/// beyond three times that uncertainty is refused. Where it is stated, and several passes come back to the same readings, it
/// warns that rounding comes back with them: their mean is no better than one of them.
void check_rounding(const RotaryTableReading& reading);

}  // namespace gumcert::jobs
