#pragma once

#include <cstddef>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// A station whose angles are those of the others but for an offset: no angle has distances of it and of them.
/// \throws gum::NoResultError  GC-ADJUST-0013 with the offset; nothing is thrown where there is none
void refuse_shifted_angles(const RotaryTableMeasurement& measurement);

/// A pass of a station whose distances agree with another pass of it when all its angles are lower or higher by one offset,
/// as where the file begins one step too late, or when they are stated in the reverse order. Distances of shifted angles fit a
/// place that is turned about the axis by the offset, and hardly any station stands just there.
/// \param misfit  of the station with all its passes, [m]
/// \throws gum::NoResultError  GC-ADJUST-0013 with both passes; nothing is thrown where there is none
void refuse_angles_of_pass(const RotaryTableMeasurement& measurement, std::size_t station, double misfit);

}  // namespace gumcert::engine
