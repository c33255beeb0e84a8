#pragma once

#include <cstddef>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/start/robust_descent.h"

namespace gumcert::engine {

/// The reflector without which the distances of all stations that fit no place fit one: its coordinates are wrong.
/// \param stations  those that fit no place, not empty
/// \param misfits   one a station of the measurement, [m]
/// \throws gum::NoResultError  GC-ADJUST-0013; nothing is thrown where there is none
void refuse_wrong_coordinates(const RotaryTableMeasurement& measurement, const std::vector<std::size_t>& stations,
                              const std::vector<double>& misfits);

/// One reflector of many, which most distances agree without: the places of the stations are right, and it strays alone.
/// \param fits           one a station of the measurement, each on its own
/// \param has_no_result  without: where the distances put it nowhere it is left to the tests of groups
/// \throws gum::NoResultError  GC-ADJUST-0013; nothing is thrown where there is none
void refuse_stray_reflector(const RotaryTableMeasurement& measurement, const std::vector<StationFit>& fits,
                            bool has_no_result);

}  // namespace gumcert::engine
