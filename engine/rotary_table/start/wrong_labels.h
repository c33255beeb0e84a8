#pragma once

#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

struct StationFit;  // robust_descent.h

/// Distances of stations that no position explains are tried with other labels: the table turning the other way or about
/// another coordinate, two reflectors interchanged, lengths of the other sign or counted twice, a fixture in another unit,
/// angles that are gon or steps of another size, a scale of their own, passes from two places; in a part of the visits of a
/// station too, where the others tell its place; and all stations without one reflector, whose coordinates are wrong. What
/// makes the misfit vanish is told.
/// \param fits  one a station of the measurement, each on its own
/// \throws gum::NoResultError  GC-ADJUST-0013, GC-GEOMETRY-0007 for the axis; nothing is thrown where there is none
void refuse_labels_of_suspicious(const RotaryTableMeasurement& measurement, const std::vector<StationFit>& fits);

/// To be asked before a measurement is refused for its layout: lengths of a station in another unit may fit a false place,
/// of which the layout seems to leave a direction open. The same labels are tried for every station, and whether the angles of
/// one are those of the others but for an offset.
/// \throws gum::NoResultError  as refuse_labels_of_suspicious()
void refuse_wrong_labels(const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
