#pragma once

#include <cstddef>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// Passes of a station that each have a place of their own, of a station that fits no place with all of them.
/// \param misfit  with all of them, [m]
/// \throws gum::NoResultError  GC-ADJUST-0013; nothing is thrown where one place with dead paths of each pass explains the
///         distances, or where a pass fits no place
void refuse_two_places(const RotaryTableMeasurement& measurement, std::size_t station, double misfit);

}  // namespace gumcert::engine
