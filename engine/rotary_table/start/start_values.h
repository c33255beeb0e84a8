#pragma once

#include <cstddef>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// Start values of stations and dead paths without an operator.
///
/// A closed solution of each station, linear in (q, l0, |q|² - l0²), is refined by a robust Gauss-Newton descent with
/// the four set-up errors of the fixture (offsets and tilts across the axis) as further unknowns, first station by
/// station, then for all stations with one set-up. The error motions are left out, so the deviations that remain are of
/// their size. Where the closed solution is singular (a dead path of each reflector on a full turn leaves the
/// coordinate along the axis open) or explains the distances badly, the line that is open and then a fixed grid of
/// directions and distances are searched. Positions are those of the fixture frame at the home angle, which is the
/// table frame of JointAdjustment with T_s = 1. Same input, same bytes.
///
/// A stated position of a station is a further candidate: the one that explains the distances best is used, and of two
/// that explain them alike the one that is nearer to the stated position.
///
/// \param active  one flag a length: false = left out; empty: all are used
/// \throws gum::NoResultError (GC-RANK-0001) if the distances of a station without a stated position leave it open:
///         all reflectors seen on a cone, or all in one plane across the axis (mirror image)
[[nodiscard]] StartValues find_start_values(const RotaryTableMeasurement& measurement,
                                            const std::vector<bool>& active = {});

/// The lengths that cannot be of this measurement: off by centimetres and far more than all others of their station.
///
/// A linearised adjustment does not survive such an error, so these are found before it, from the deviations of the
/// robust start values (median and median absolute deviation). Largest first; no more than one in twenty and one.
/// Nothing is found in a dead path with fewer than three lengths: there is no telling which one is wrong.
///
/// Distances of a station that no position explains are asked for wrong labels first (wrong_labels.h): of those no gross
/// error is returned.
///
/// \throws gum::NoResultError  as find_start_values(); as refuse_labels_of_suspicious(); and GC-ADJUST-0015 in place of
///         GC-RANK-0001 where the distances of a station fit no place to a millimetre: what is open then is no property of
///         the layout
[[nodiscard]] std::vector<std::size_t> find_gross_errors(const RotaryTableMeasurement& measurement);

}  // namespace gumcert::engine
