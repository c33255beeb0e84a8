#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// Distance of a reflector from a station with an ideal table and a fixture without set-up errors at its stated
/// temperature, [m].
/// \param rotation  of the table
[[nodiscard]] double ideal_distance(const RotaryTableMeasurement& measurement, const Eigen::Matrix3d& rotation,
                                    std::size_t station, std::size_t reflector);

/// Plans the distances of a measurement that has stations with start values, reflectors, fixture and angles: every
/// station sees every reflector at every angle, reflector after reflector within one visit of the table.
///
/// Fills `passes` ("P1-1" in the sense +, and "P1-2" in the sense - where both are asked for), `dead_paths` and
/// `lengths`, replacing what was there. A length is what would be displayed with dead paths of zero, an ideal table and
/// a fixture without set-up errors at its stated temperature. `station_start`, `temperature_difference` and
/// `u_temperature` have one entry a station; the last two may be empty and are then filled with zeros.
/// \throws gum::InputError  GC-LAYOUT-0001 when a station has no start value, -0002 without angles, -0003 when a
///                          station stands on a reflector
void lay_out(RotaryTableMeasurement& measurement, bool both_senses, bool dead_path_per_reflector);

/// The same passes, reflectors and dead paths at `count` angles of a full turn, beginning at the home angle.
///
/// Every reflector of a pass is measured at every angle; distances that were missing are there, and a dead path that
/// began in mid-turn is left out: its distances belong to the first dead path of their pass and reflector. A pass of one angle
/// beside runs of its station closes a run, or checks it: it visits the nearest angle alone. Lengths are those of `lay_out`; where a station has no start value they are zero.
/// \param count  at least 1
[[nodiscard]] RotaryTableMeasurement with_full_turn(const RotaryTableMeasurement& measurement, std::size_t count);

}  // namespace gumcert::engine
