#pragma once

#include <Eigen/Core>

#include <algorithm>
#include <array>
#include <optional>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/rotation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"

namespace gumcert::engine {

/// A solution carried to a datum, with the linear maps that carry its covariance.
///
/// Distances alone do not separate E(θ) from a motion of the world (six constants) and from the set-up of the fixture
/// (an eccentricity and a tilt that turn with θ): ten conventions are needed. `home`: E is zero at the home angle, and
/// the set-up minimises the residual positions of the reflectors. `axis_average_line`: the means of all six error
/// motions are zero, and what turns with θ in the two translations and tilts across the axis belongs to the set-up
/// (ISO 230-7: the axis average line).
///
/// The S-transformation has ten dimensions, ∂errors/∂poses = I + D K: it is held as D and K, whose size is proportional
/// to the angles. At the home angle of the datum `home` the error motions are zero by definition, and so is their map.
///
/// A fixture whose frame is inclined to the axis by more than k_small_inclination has no small tilts: its set-up is
/// changed by composing motions, and `set_up_rates` and `along_rates` carry the map of the change on to the numbers by
/// which the set-up is stated. Below it they are 1 and 0.
struct DatumSolution {
    Eigen::MatrixXd errors;              ///< 6×angles, [m] and [rad]
    Eigen::Matrix<double, 6, 1> set_up;  ///< O and S of T_s, zero along the axis, [m] and [rad]
    RigidMotion world;                   ///< new table frame from the solver's table frame
    Eigen::MatrixXd motion_map;  ///< D, 6N×10: ∂errors/∂(parameters of `world`, O, O, S, S), angle by angle
    Eigen::MatrixXd set_up_map;  ///< 4×6N, ∂(O, O, S, S)/∂poses, the two across the axis of each
    Eigen::MatrixXd world_map;   ///< 6×6N, ∂(parameters of `world`)/∂poses; K is this above `set_up_map`
    std::optional<Eigen::Index> zero_angle = std::nullopt;       ///< angle whose error motions are zero by definition
    Eigen::Matrix4d set_up_rates = Eigen::Matrix4d::Identity();  ///< ∂(O, O, S, S)/∂(motion of the fixture in T)
    Eigen::Matrix<double, 2, 4> along_rates =
        Eigen::Matrix<double, 2, 4>::Zero();  ///< ∂(shift and turn of T along the axis)/∂(motion of the fixture in T)
    bool inclined = false;

    /// K, 10×6N.
    [[nodiscard]] Eigen::MatrixXd change_map() const;
    /// ∂(O, O, S, S as stated)/∂poses, 4×6N.
    [[nodiscard]] Eigen::MatrixXd stated_set_up_map() const;
    /// ∂(parameters of `world`, with the turn about the axis that keeps S along it at zero)/∂poses, 6×6N.
    [[nodiscard]] Eigen::MatrixXd frame_map(RotaryAxis axis) const;
    /// (∂errors/∂poses) X for any X with a row for each component of the poses, 6N×k.
    [[nodiscard]] Eigen::MatrixXd carried(const Eigen::Ref<const Eigen::MatrixXd>& by_pose) const;
    /// Y (∂errors/∂poses) for any Y with a column for each component of the errors, k×6N.
    [[nodiscard]] Eigen::MatrixXd pulled_back(const Eigen::Ref<const Eigen::MatrixXd>& by_error) const;
};

/// Angle between the axis and the coordinate axis of the fixture that has its letter, up to which tilts of the fixture
/// are small, [rad].
constexpr double k_small_inclination = 10.0 * gum::k_degree;
/// The same, up to which a measurement is evaluated: beyond it another coordinate axis may be the nearer one, and a tilt
/// of 90° about one coordinate leaves the other one open.
constexpr double k_largest_inclination = 45.0 * gum::k_degree;

/// The angle between the axis and the coordinate axis of the fixture that has its letter, [rad], 0 … π.
[[nodiscard]] double inclination(RotaryAxis axis, const RigidMotion& set_up);

/// The axis of letter `axis` in a frame that is inclined to it.
/// \return warning GC-GEOMETRY-0006 above k_small_inclination
[[nodiscard]] std::optional<gum::Diagnostic> inclination_note(RotaryAxis axis, const RigidMotion& set_up);
/// \throws gum::NoResultError  GC-GEOMETRY-0007 above k_largest_inclination
void refuse_inclined_fixture(RotaryAxis axis, const RigidMotion& set_up);

/// \param poses   6×angles, error motions with respect to `set_up`, with zero at home
/// \param set_up  T_s with which the poses were found
/// \throws gum::NoResultError  GC-GEOMETRY-0007 for a frame inclined by more than k_largest_inclination; GC-GEOMETRY-0008
///         where the ten conditions do not hold at the end
[[nodiscard]] DatumSolution transform_to_datum(const RotaryTableMeasurement& measurement, const Eigen::MatrixXd& poses,
                                               const RigidMotion& set_up, Datum datum);

/// Coordinates across the axis in right-handed order: (y, z) for A, (z, x) for B, (x, y) for C.
[[nodiscard]] constexpr std::array<int, 2> across_axis(RotaryAxis axis) {
    return {(axial_coordinate(axis) + 1) % 3, (axial_coordinate(axis) + 2) % 3};
}

/// The same in alphabetic order, that of the names of quantities across the axis.
[[nodiscard]] constexpr std::array<int, 2> cross_coordinates(RotaryAxis axis) {
    const std::array<int, 2> across = across_axis(axis);
    return {std::min(across[0], across[1]), std::max(across[0], across[1])};
}

/// What a right-handed tilt of the axis about a coordinate across it does to the direction of the axis, to first order:
/// tilt = sign · direction[component].
struct AxisTilt {
    int component;
    double sign;
};
/// \param cross  one of cross_coordinates()
[[nodiscard]] constexpr AxisTilt axis_tilt(RotaryAxis axis, int cross) {
    const int axial = axial_coordinate(axis);
    return cross == (axial + 1) % 3 ? AxisTilt{(axial + 2) % 3, -1.0} : AxisTilt{(axial + 1) % 3, 1.0};
}

}  // namespace gumcert::engine
