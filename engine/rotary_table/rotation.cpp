#include "engine/rotary_table/rotation.h"

#include <Eigen/Geometry>

#include <cmath>

namespace gumcert::engine {

Eigen::Matrix3d axis_rotation(int axis, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const int second = (axis + 1) % 3;
    const int third = (axis + 2) % 3;
    Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
    rotation(second, second) = c;
    rotation(second, third) = -s;
    rotation(third, second) = s;
    rotation(third, third) = c;
    return rotation;
}

namespace {

Eigen::Matrix3d axis_rotation_derivative(int axis, double angle) {
    const double c = std::cos(angle);
    const double s = std::sin(angle);
    const int second = (axis + 1) % 3;
    const int third = (axis + 2) % 3;
    Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
    derivative(second, second) = -s;
    derivative(second, third) = -c;
    derivative(third, second) = c;
    derivative(third, third) = -s;
    return derivative;
}

}  // namespace

Eigen::Matrix3d rotation_zyx(const Eigen::Vector3d& angles) {
    return axis_rotation(2, angles[2]) * axis_rotation(1, angles[1]) * axis_rotation(0, angles[0]);
}

std::array<Eigen::Matrix3d, 3> rotation_zyx_derivatives(const Eigen::Vector3d& angles) {
    const Eigen::Matrix3d x = axis_rotation(0, angles[0]);
    const Eigen::Matrix3d y = axis_rotation(1, angles[1]);
    const Eigen::Matrix3d z = axis_rotation(2, angles[2]);
    return {z * y * axis_rotation_derivative(0, angles[0]), z * axis_rotation_derivative(1, angles[1]) * x,
            axis_rotation_derivative(2, angles[2]) * y * x};
}

Eigen::Vector3d angles_zyx(const Eigen::Matrix3d& rotation) {
    // Arc tangents of both components: an arc sine of an element that rounding has made larger than 1 would have no
    // value.
    return {std::atan2(rotation(2, 1), rotation(2, 2)),
            std::atan2(-rotation(2, 0), std::hypot(rotation(2, 1), rotation(2, 2))),
            std::atan2(rotation(1, 0), rotation(0, 0))};
}

Eigen::Matrix3d smallest_rotation(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
    const Eigen::Vector3d a = from.normalized();
    const Eigen::Vector3d b = to.normalized();
    const double cosine = b.dot(a);
    // Eigen's own FromTwoVectors() finds the axis of opposite directions by a singular value decomposition, which takes
    // the compiler ten seconds.
    constexpr double k_opposite = 1e-12;
    if (cosine < k_opposite - 1.0) {
        const Eigen::Vector3d across = a.unitOrthogonal();
        return 2.0 * across * across.transpose() - Eigen::Matrix3d::Identity();
    }
    // Twice the cosine of half the angle. Of nearly opposite directions 1 + cosine has few digits left.
    const double w = cosine < -0.5 ? (a + b).norm() : std::sqrt(2.0 * (1.0 + cosine));
    Eigen::Quaterniond turn;
    turn.vec() = a.cross(b) * (1.0 / w);
    turn.w() = 0.5 * w;
    return turn.toRotationMatrix();
}

RigidMotion rigid_motion(const Eigen::Matrix<double, 6, 1>& parameters) {
    return {rotation_zyx(parameters.tail<3>()), parameters.head<3>()};
}

Eigen::Matrix<double, 6, 1> motion_parameters(const RigidMotion& motion) {
    Eigen::Matrix<double, 6, 1> parameters;
    parameters << motion.translation, angles_zyx(motion.rotation);
    return parameters;
}

Eigen::Matrix<double, 3, 6> point_displacement(const Eigen::Vector3d& point) {
    // Small turns: e × P. Eq. (8) of the source paper.
    Eigen::Matrix<double, 3, 6> rows;
    rows << Eigen::Matrix3d::Identity(), Eigen::Matrix3d::Zero();
    rows(0, 4) = point[2];
    rows(0, 5) = -point[1];
    rows(1, 3) = -point[2];
    rows(1, 5) = point[0];
    rows(2, 3) = point[1];
    rows(2, 4) = -point[0];
    return rows;
}

}  // namespace gumcert::engine
