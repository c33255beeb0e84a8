#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// How the mirror image of a table, across the axis, fits the stated positions of its stations.
enum class MirrorImage {
    fits_worse,
    fits_as_well,  ///< or better, and not by much; or nothing is stated
    fits_better    ///< clearly
};

/// All stations together: a typing error of one and interchanged names of two leave what the others say.
/// \param found  where the distances put each station, in T, [m]
[[nodiscard]] MirrorImage fit_of_mirror_image(const RotaryTableMeasurement& measurement,
                                              const std::vector<Eigen::Vector3d>& found);

/// What is to be said of the stated positions of the stations beside those that the distances give.
///
/// Stations that are found elsewhere are the warning GC-GEOMETRY-0009: start values are not in the result, and what stands in the
/// stations file may belong to another station, as may the temperatures of that name. That the result does not rest on them is said
/// only where they fit the mirror image of the table less: their side of the origin is that of the fixture file. Where no stated
/// position tells the sign along the axis, the note GC-GEOMETRY-0010 says that the fixture file alone does: the mirror image of a
/// table has the same distances (GC-ADJUST-0018).
///
/// \param found  where the distances put each station, in T, [m]
[[nodiscard]] std::vector<gum::Diagnostic> stated_position_notes(const RotaryTableMeasurement& measurement,
                                                                 const std::vector<Eigen::Vector3d>& found);

}  // namespace gumcert::engine
