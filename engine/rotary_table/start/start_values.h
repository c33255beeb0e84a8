#pragma once

#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

struct CommonFit;        // common_set_up.h
class ObservedStations;  // observed_stations.h

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

/// The same where the places of the stations are known.
/// \param found  of all distances that are used, the places that are open settled
[[nodiscard]] StartValues start_values_of(const ObservedStations& observed, const CommonFit& found);

}  // namespace gumcert::engine
