#pragma once

#include <cstddef>
#include <optional>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/robust_descent.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// What is wrong with the labels of some visits of a station, two or more: the others tell its place.
///
/// The visits whose place most distances agree with are all, one pass, or the first or last half or third of them. What
/// disagrees with it is read with the reflectors interchanged, in pairs or in a ring, and with other units, signs and angles.
///
/// \param whole  fit of all distances of the station
/// \return GC-ADJUST-0013 with the first and the last of these visits; nothing where no cause explains most of their
///         distances
[[nodiscard]] std::optional<gum::Diagnostic> labels_of_visits(const RotaryTableMeasurement& measurement,
                                                              std::size_t station, const StationFit& whole);

}  // namespace gumcert::engine
