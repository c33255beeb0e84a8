#pragma once

#include <cstddef>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/common_set_up.h"
#include "engine/rotary_table/start/observed_stations.h"

namespace gumcert::engine {

/// The lengths that cannot be of this measurement: off by centimetres and far more than all others of their station.
///
/// A linearised adjustment does not survive such an error, so these are found before it, from the deviations of the
/// robust start values (median and median absolute deviation). Largest first; no more than one in twenty and one.
/// Nothing is found in a dead path with fewer than three lengths: there is no telling which one is wrong.
///
/// Distances of a station that no position explains are asked for wrong labels first (wrong_labels.h): of those no gross
/// error is returned.
///
/// \throws gum::NoResultError  as find_start_values(); as WrongLabels::refuse_suspicious(); and GC-ADJUST-0015 in place of
///         GC-RANK-0001 where the distances of a station fit no place to a millimetre: what is open then is no property of
///         the layout
[[nodiscard]] std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement);

/// The same where the places of the stations are known.
/// \param all  of all distances, the places that are open settled
[[nodiscard]] std::vector<std::size_t> gross_errors_of(const ObservedStations& observed, const CommonFit& all);

}  // namespace gumcert::engine
