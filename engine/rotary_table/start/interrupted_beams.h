#pragma once

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// Beams that were interrupted by a tenth of a millimetre or more: with the distances of a station from some visit on
/// on a dead path of their own, next to nothing of its misfit is left. For measurements that have no result without:
/// every visit of every station is tried.
///
/// \throws gum::NoResultError  GC-ADJUST-0014 with place and size of each; nothing is thrown where there is none
void refuse_interrupted_beams(const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
