#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/rotary_table_measurement.h"

namespace gumcert::engine {

/// A solid that a beam does not pass, in the frame T of the table at the home angle.
struct Obstacle {
    std::string name;
    bool turns = true;  ///< with the table
    /// Cylinder about the rotary axis where above 0; else a box, [m]
    double radius = 0.0;
    /// Opposite corners of the box, lower ones first; of a cylinder only the coordinate along the axis counts, [m]
    Eigen::Vector3d low = Eigen::Vector3d::Zero(), high = Eigen::Vector3d::Zero();
};

/// What is known of the way of the beams. Nothing of it: nothing is looked at.
struct SightRules {
    std::vector<Obstacle> obstacles;
    double reflector_diameter = 0.0;  ///< of the spheres that stand in the way of beams to others, [m]; 0: not known
    std::optional<double> acceptance_angle;  ///< between beam and facing direction at most, [rad]
    std::vector<std::optional<Eigen::Vector3d>>
        facing;  ///< unit vectors in the fixture, of the reflectors; may be empty

    [[nodiscard]] bool any() const { return !obstacles.empty() || reflector_diameter > 0.0 || acceptance_angle; }
};

/// Why a station does not see a reflector.
struct Hindrance {
    enum class Kind { obstacle, reflector, acceptance };
    Kind kind = Kind::obstacle;
    std::size_t which = 0;  ///< obstacle, or reflector that is in the way
};

/// Lines of sight of a layout, for an ideal table: no set-up errors, the fixture at its reference temperature.
class LineOfSight {
public:
    /// \param measurement  copied as far as needed
    LineOfSight(const RotaryTableMeasurement& measurement, SightRules rules);

    /// \param station  its position in T, [m]
    [[nodiscard]] std::optional<Hindrance> hindrance(const Eigen::Vector3d& station, std::size_t angle,
                                                     std::size_t reflector) const;
    [[nodiscard]] const SightRules& rules() const { return rules_; }
    /// A reflector whose centre lies inside an obstacle, and the obstacle: nothing could ever see it.
    struct Inside {
        std::size_t reflector = 0, obstacle = 0, angle = 0;
    };
    [[nodiscard]] std::optional<Inside> inside() const;

private:
    SightRules rules_;
    int axial_;
    std::vector<Eigen::Vector3d> reflectors_;  ///< in the fixture
    std::vector<Eigen::Matrix3d> rotations_;   ///< of the angles
};

/// One flag a length: false where the line of sight is hindered from the position of its station.
/// \param measurement  with the positions of its stations
[[nodiscard]] std::vector<bool> seen_distances(const RotaryTableMeasurement& measurement, const LineOfSight& sight);

}  // namespace gumcert::engine
