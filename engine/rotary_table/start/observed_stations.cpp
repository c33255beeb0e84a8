#include "engine/rotary_table/start/observed_stations.h"

#include "engine/rotary_table/datum.h"
#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

ObservedStations::ObservedStations(const RotaryTableMeasurement& measurement, const std::vector<bool>& active)
    : measurement_(measurement),
      across_(across_axis(measurement.axis)),
      stations_(distances_by_station(measurement, active)) {
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        turn_.push_back(nominal_rotation(measurement, i));
    }
}

RigidMotion ObservedStations::set_up_motion(const Eigen::Vector4d& set_up) const {
    Eigen::Matrix<double, 6, 1> parameters = Eigen::Matrix<double, 6, 1>::Zero();
    for (std::size_t c = 0; c < 2; ++c) {
        parameters[across_[c]] = set_up[static_cast<Eigen::Index>(c)];
        parameters[3 + across_[c]] = set_up[static_cast<Eigen::Index>(2 + c)];
    }
    return rigid_motion(parameters);
}

PointPositions ObservedStations::positions(std::size_t station, const Eigen::Vector4d& set_up, bool derivatives) const {
    PointPositions result;
    locate(station, set_up, result);
    if (derivatives) {
        derive(station, set_up, result);
    }
    return result;
}

void ObservedStations::locate(std::size_t station, const Eigen::Vector4d& set_up, PointPositions& positions) const {
    const RigidMotion motion = set_up_motion(set_up);
    const StationDistances& data = stations_[station];
    positions.point.resize(data.point.size());
    for (std::size_t i = 0; i < data.point.size(); ++i) {
        positions.point[i] = turn_[data.angle[i]] * (motion * data.point[i]);
    }
}

void ObservedStations::derive(std::size_t station, const Eigen::Vector4d& set_up, PointPositions& positions) const {
    Eigen::Vector3d tilt = Eigen::Vector3d::Zero();
    tilt[across_[0]] = set_up[2];
    tilt[across_[1]] = set_up[3];
    const std::array<Eigen::Matrix3d, 3> by_tilt = rotation_zyx_derivatives(tilt);
    const StationDistances& data = stations_[station];
    positions.by_set_up.resize(data.point.size());
    for (std::size_t i = 0; i < data.point.size(); ++i) {
        const Eigen::Matrix3d& turn = turn_[data.angle[i]];
        positions.by_set_up[i] << turn.col(across_[0]), turn.col(across_[1]),
            turn * (by_tilt[static_cast<std::size_t>(across_[0])] * data.point[i]),
            turn * (by_tilt[static_cast<std::size_t>(across_[1])] * data.point[i]);
    }
}

Deviations ObservedStations::deviations(std::size_t station, const Eigen::Vector4d& set_up,
                                        const Eigen::Vector3d& place) const {
    return deviations_from(stations_[station], positions(station, set_up, false).point, place);
}

}  // namespace gumcert::engine
