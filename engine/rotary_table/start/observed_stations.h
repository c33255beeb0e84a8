#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/rotation.h"
#include "engine/rotary_table/start/station_distances.h"

namespace gumcert::engine {

/// Where the points that a station saw stood, in T, with a set-up of the fixture, and their derivatives by it.
struct PointPositions {
    std::vector<Eigen::Vector3d> point;  ///< one a distance, [m]
    std::vector<Eigen::Matrix<double, 3, 4>>
        by_set_up;  ///< order (O, O, S, S), [1] and [m/rad]; empty if not asked for
};

/// What a search for start values knows of a measurement: the distances of each station, and where the nominal angles
/// carry the fixture. Error motions are left out.
///
/// A set-up is (O, O, S, S): the two offsets and the two tilts of the fixture across the axis, in right-handed order
/// (`across_axis`), [m] and [rad]. The measurement must outlive this.
class ObservedStations {
public:
    /// \param active  one flag a length: false = left out; empty: all are used
    ObservedStations(const RotaryTableMeasurement& measurement, const std::vector<bool>& active);

    [[nodiscard]] const RotaryTableMeasurement& measurement() const { return measurement_; }
    [[nodiscard]] const std::array<int, 2>& across() const { return across_; }
    [[nodiscard]] const std::vector<StationDistances>& stations() const { return stations_; }

    /// T_s.
    [[nodiscard]] RigidMotion set_up_motion(const Eigen::Vector4d& set_up) const;
    [[nodiscard]] PointPositions positions(std::size_t station, const Eigen::Vector4d& set_up, bool derivatives) const;
    /// The points of `positions` alone.
    void locate(std::size_t station, const Eigen::Vector4d& set_up, PointPositions& positions) const;
    /// The derivatives of `positions` alone.
    void derive(std::size_t station, const Eigen::Vector4d& set_up, PointPositions& positions) const;
    /// \param place  of the station, in T, [m]
    [[nodiscard]] Deviations deviations(std::size_t station, const Eigen::Vector4d& set_up,
                                        const Eigen::Vector3d& place) const;

private:
    const RotaryTableMeasurement& measurement_;
    std::array<int, 2> across_;
    std::vector<Eigen::Matrix3d> turn_;  // one an angle
    std::vector<StationDistances> stations_;
};

}  // namespace gumcert::engine
