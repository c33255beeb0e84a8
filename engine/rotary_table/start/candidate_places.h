#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/rotary_table/start/closed_solution.h"
#include "engine/rotary_table/start/station_distances.h"

namespace gumcert::engine {

// Places from which a descent looks for a station, in the frame of the points, [m].

/// The mirror image of a place in the plane in which the points nearly lie: distances hardly change.
/// \param points  not empty, [m]
[[nodiscard]] Eigen::Vector3d mirror_image(const std::vector<Eigen::Vector3d>& points, const Eigen::Vector3d& place);

/// On all six sides of the points, a metre off.
[[nodiscard]] std::vector<Eigen::Vector3d> all_sides(const Eigen::Vector3d& centre);

/// Directions all round in near equal parts (golden-angle spiral), at distances that stations have.
[[nodiscard]] std::vector<Eigen::Vector3d> sphere_grid(const Eigen::Vector3d& centre);

/// Along the direction that the closed solution determines least.
[[nodiscard]] std::vector<Eigen::Vector3d> open_line(const ClosedSolution& closed);

/// Places of a grid, best first, that no other one in the list comes close to.
/// \param points  one a distance, [m]
/// \param count   at most
[[nodiscard]] std::vector<Eigen::Vector3d> best_of(const StationDistances& data,
                                                   const std::vector<Eigen::Vector3d>& points,
                                                   const std::vector<Eigen::Vector3d>& grid, std::size_t count);

/// Whether a place is so far off before any refinement that it cannot be brought to explain the distances.
/// \param reached  misfit of the place that it is held against, [m]
[[nodiscard]] bool is_hopeless(const StationDistances& data, const std::vector<Eigen::Vector3d>& points,
                               const Eigen::Vector3d& place, double reached);

}  // namespace gumcert::engine
