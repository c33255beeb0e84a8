#pragma once

#include <Eigen/Core>

#include <vector>

#include "engine/rotary_table/start/station_distances.h"

namespace gumcert::engine {

/// The place of a station by a linear form of its distances.
struct ClosedSolution {
    Eigen::Vector3d position = Eigen::Vector3d::Zero();  ///< [m]
    Eigen::Vector3d open = Eigen::Vector3d::UnitX();     ///< least determined direction
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();    ///< of the points, [m]
    bool determined = false;                             ///< in all directions
};

/// |P|² - 2 P·q + |q|² = l² + 2 l l0 + l0² is linear in q, l0 and κ = |q|² - l0², one l0 and κ a dead path. Both are
/// eliminated; q is found in the directions that are determined, and stays in the middle of the points in the others.
/// It needs no start and no operator, and comes within a millimetre of usual stations (design note rotary-table.md, 4c).
/// \param points  P, one a distance, [m]; not empty
[[nodiscard]] ClosedSolution closed_solution(const StationDistances& data, const std::vector<Eigen::Vector3d>& points);

}  // namespace gumcert::engine
