#pragma once

#include <Eigen/Core>

#include <cstddef>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// The distances of one station, free of names: the k-th entries belong to its k-th distance.
struct StationDistances {
    std::vector<std::size_t> observation;  ///< index into RotaryTableMeasurement::lengths
    std::vector<std::size_t> angle;
    std::vector<std::size_t> path;                   ///< numbered within the station
    std::vector<Eigen::Vector3d> point;              ///< in the fixture frame, at the temperature of the station, [m]
    Eigen::VectorXd length;                          ///< [m]
    std::vector<std::size_t> path_name;              ///< index of each path into the dead paths of the measurement
    std::vector<std::vector<Eigen::Index>> members;  ///< distances of each path
};

/// \param active  one flag a length: false = left out; empty: all are used
/// \return one a station of the measurement, without distances where it has none
[[nodiscard]] std::vector<StationDistances> distances_by_station(const RotaryTableMeasurement& measurement,
                                                                 const std::vector<bool>& active);

/// |P - q| - l of the distances of a station, less its median of every dead path, and these medians: the dead paths.
struct Deviations {
    Eigen::VectorXd each;        ///< one a distance, [m]
    Eigen::VectorXd dead_paths;  ///< one a path of the station, [m]
};
/// \param points  P, one a distance, [m]
/// \param place   q, in the frame of the points, [m]
[[nodiscard]] Deviations deviations_from(const StationDistances& data, const std::vector<Eigen::Vector3d>& points,
                                         const Eigen::Vector3d& place);

/// Appends the absolute deviations of the dead paths that have more than one length. The deviation from the median of one
/// length is 0 whatever the position: it would make a wrong one look good.
void collect_sizes(const StationDistances& data, const Eigen::VectorXd& deviation, std::vector<double>& sizes);

/// Root mean square of the smaller deviations, [m]; 0 where no path has two distances. Gross errors in a few lengths, which
/// it leaves out, say nothing against a position.
[[nodiscard]] double misfit_of(const StationDistances& data, const Eigen::VectorXd& deviation);

/// Median of the absolute deviations, [m].
/// \param deviation  n ≥ 1
[[nodiscard]] double median_size(const Eigen::VectorXd& deviation);

/// Whether a station has distances enough beyond its place, its set-up and its dead paths to tell one cause from another:
/// fewer agree with any.
[[nodiscard]] bool tells_causes(const StationDistances& data);

}  // namespace gumcert::engine
