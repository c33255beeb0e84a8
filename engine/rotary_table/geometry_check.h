#pragma once

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <vector>

#include "engine/adjustment.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

/// What is wrong with the layout of a measurement whose adjustment leaves parameters undetermined, and the cure.
///
/// \param rank      deficient; the names in it are those of JointAdjustment
/// \param stations  positions as far as they are known, in T, [m]; empty: none. With them the message can tell how a
///                  station stands to the axis and the reflectors.
/// \return code GC-RANK-0001, severity error
[[nodiscard]] gum::Diagnostic undetermined(const RotaryTableMeasurement& measurement, const RankReport& rank,
                                           const std::vector<Eigen::Vector3d>& stations = {});

/// Stations from which no measurement determines the poses: three or more on one line, in T, [m].
/// \return code GC-RANK-0001, severity error; nothing where they stand otherwise
[[nodiscard]] std::optional<gum::Diagnostic> stations_on_one_line(const std::vector<Eigen::Vector3d>& stations);

/// \throws gum::NoResultError always, with `undetermined()`
[[noreturn]] void refuse_undetermined(const RotaryTableMeasurement& measurement, const RankReport& rank,
                                      const std::vector<Eigen::Vector3d>& stations = {});

/// Refuse a measurement with too few angles for what is reported, whatever its distances.
///
/// Modulo a full turn, two angles leave nothing of the four error motions across the axis: any value of them is an
/// eccentricity and a tilt of the fixture (two unknowns for two values in each pair). With respect to the axis average
/// line they would be zero without uncertainty, with respect to home a shadow of the other two motions. Three angles
/// leave one combination of each pair; geometry_notes() warns of that.
///
/// \throws gum::NoResultError with GC-RANK-0002 below three angles that differ by more than 0.01° modulo 360°
void require_enough_angles(const RotaryTableMeasurement& measurement);

/// What makes the layout weak although it has a solution: warnings with value, rule and cure (GC-GEOMETRY-0001 …).
///
/// \param stations  positions, one a station of the measurement, in T, [m]
/// \param harms     whether the results feel that a station is badly known along one line; absent: as if all did
[[nodiscard]] std::vector<gum::Diagnostic> geometry_notes(const RotaryTableMeasurement& measurement,
                                                          const std::vector<Eigen::Vector3d>& stations,
                                                          const std::function<bool(std::size_t station)>& harms = {});

}  // namespace gumcert::engine
