#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// What is to be said of the stated positions of the stations beside those that the distances give.
///
/// A station that is found elsewhere is the warning GC-GEOMETRY-0009: start values are not in the result, and what stands in the
/// stations file may belong to another station, as may the temperatures of that name. Where no stated position tells the sign along the
/// axis, the note GC-GEOMETRY-0010 says that the fixture file alone does: the mirror image of a table has the same distances
/// (GC-ADJUST-0018).
///
/// \param found  where the distances put each station, in T, [m]
[[nodiscard]] std::vector<gum::Diagnostic> stated_position_notes(const RotaryTableMeasurement& measurement,
                                                                 const std::vector<Eigen::Vector3d>& found);

}  // namespace gumcert::engine
