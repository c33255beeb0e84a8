#pragma once

#include <Eigen/Core>

#include <array>

namespace gumcert::engine {

/// Rotation matrix about coordinate axis 0, 1 or 2 (x, y, z) by `angle` [rad], right-handed.
[[nodiscard]] Eigen::Matrix3d axis_rotation(int axis, double angle);

/// Rz(c) Ry(b) Rx(a), angles in the order a, b, c about x, y, z, [rad].
[[nodiscard]] Eigen::Matrix3d rotation_zyx(const Eigen::Vector3d& angles);

/// Partial derivatives of `rotation_zyx` with respect to a, b, c.
[[nodiscard]] std::array<Eigen::Matrix3d, 3> rotation_zyx_derivatives(const Eigen::Vector3d& angles);

/// The angles a, b, c that give `rotation` in `rotation_zyx`; |b| < π/2.
[[nodiscard]] Eigen::Vector3d angles_zyx(const Eigen::Matrix3d& rotation);

/// The rotation by the smallest angle that turns one direction into another; of opposite ones half a turn about some axis across.
/// \param from,to  not zero; their lengths do not matter
[[nodiscard]] Eigen::Matrix3d smallest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to);

/// A rigid motion x ↦ rotation·x + translation; reads as `target_from_source`.
struct RigidMotion {
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    Eigen::Vector3d translation = Eigen::Vector3d::Zero();  ///< [m]

    [[nodiscard]] Eigen::Vector3d operator*(const Eigen::Vector3d& point) const {
        return rotation * point + translation;
    }
    [[nodiscard]] RigidMotion operator*(const RigidMotion& right) const {
        return {rotation * right.rotation, rotation * right.translation + translation};
    }
    [[nodiscard]] RigidMotion inverse() const { return {rotation.transpose(), -(rotation.transpose() * translation)}; }
};

/// Trans(x, y, z) Rz(c) Ry(b) Rx(a) from (x, y, z, a, b, c), [m] and [rad]: error motions and set-up errors alike.
[[nodiscard]] RigidMotion rigid_motion(const Eigen::Matrix<double, 6, 1>& parameters);

/// Inverse of `rigid_motion`.
[[nodiscard]] Eigen::Matrix<double, 6, 1> motion_parameters(const RigidMotion& motion);

/// Displacement of a point at P by a small motion (x, y, z, a, b, c): [I, -P×], 3×6, [1] and [m] (eq. (8) of the source
/// paper).
[[nodiscard]] Eigen::Matrix<double, 3, 6> point_displacement(const Eigen::Vector3d& point);

}  // namespace gumcert::engine
