#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/studies/line_of_sight.h"
#include "gum/quantity/units.h"

namespace gumcert::gum {

/// Expanded uncertainties wanted of the parameters of the table, [m] and [rad]; nothing: none is wanted.
struct ParameterTargets {
    std::optional<double> range_linear, range_angular;          ///< of the six error ranges
    std::optional<double> location_linear, location_angular;    ///< of the axis average line
    std::optional<double> systematic, repeatability, accuracy;  ///< E, R and A of ISO 230-2, [rad]
};

/// What is known of the lines of sight, as the job states it.
struct SightStatement {
    struct Facing {
        std::string reflector, where;
        Eigen::Vector3d direction = Eigen::Vector3d::Zero();  ///< unit vector in the fixture
    };
    std::vector<engine::Obstacle> obstacles;
    std::vector<std::string> obstacles_where;  ///< for messages
    double reflector_diameter = 0.0;           ///< [m]; 0: not stated
    std::optional<double> acceptance_angle;    ///< [rad]
    std::vector<Facing> facing;
};

/// A layout that is not measured yet, and what may be changed in it (`gumcert plan`).
struct PlanRequest {
    std::vector<double> angles_deg;  ///< ascending; empty: those of the lengths file
    bool both_senses = false;
    bool dead_path_per_reflector = false;       ///< else one a station
    double target_linear = 1e-6;                ///< expanded uncertainty wanted of the linear error motions, [m]
    double target_angular = 1.0 * k_arcsecond;  ///< and of the angular ones, [rad]
    /// Box in which stations may stand, corners in T, [m]; nothing: stations are not moved.
    std::optional<std::array<Eigen::Vector3d, 2>> station_region;
    double station_step = 0.2;    ///< grid of candidate positions in the box, [m]
    double least_distance = 0.2;  ///< of a station from every reflector at every angle, [m]
    ParameterTargets parameter_targets;
    bool keep_met_targets = false;  ///< no station is moved where that makes a target missed that was met
    SightStatement sight;
};

}  // namespace gumcert::gum
