#pragma once

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// A station whose angles are those of the others but for an offset: no angle has distances of it and of them.
/// \throws gum::NoResultError  GC-ADJUST-0013 with the offset; nothing is thrown where there is none
void refuse_shifted_angles(const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
