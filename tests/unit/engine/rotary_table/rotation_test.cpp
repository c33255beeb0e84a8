#include "engine/rotary_table/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace gumcert::engine {
namespace {

using MotionParameters = Eigen::Matrix<double, 6, 1>;

const std::vector<Eigen::Vector3d>& rotation_angles() {
    static const std::vector<Eigen::Vector3d> angles{
        {0.0, 0.0, 0.0}, {1e-9, -2e-9, 3e-9}, {0.3, -0.7, 2.5}, {-3.0, 1.2, -0.4}, {2.0, -1.5, 3.1}};
    return angles;
}

// By Eigen's rotations about an axis, which are written in another way.
TEST(Rotation, AboutAnAxisIsRightHanded) {
    for (int axis = 0; axis < 3; ++axis) {
        const Eigen::Matrix3d expected = Eigen::AngleAxisd(0.7, Eigen::Vector3d::Unit(axis)).toRotationMatrix();
        EXPECT_LT((axis_rotation(axis, 0.7) - expected).cwiseAbs().maxCoeff(), 1e-15);
    }
    const Eigen::Vector3d turned = axis_rotation(2, 0.5 * std::numbers::pi) * Eigen::Vector3d::UnitX();
    EXPECT_LT((turned - Eigen::Vector3d::UnitY()).norm(), 1e-15) << "x goes to y about z";
}

TEST(Rotation, TurnsAboutXFirst) {
    for (const Eigen::Vector3d& angles : rotation_angles()) {
        const Eigen::Matrix3d expected = (Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()) *
                                          Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
                                          Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()))
                                             .toRotationMatrix();
        EXPECT_LT((rotation_zyx(angles) - expected).cwiseAbs().maxCoeff(), 1e-15);
    }
}

TEST(Rotation, DerivativesAreCentralDifferences) {
    constexpr double k_step = 1e-5;
    for (const Eigen::Vector3d& angles : rotation_angles()) {
        const std::array<Eigen::Matrix3d, 3> derivatives = rotation_zyx_derivatives(angles);
        for (int c = 0; c < 3; ++c) {
            const Eigen::Vector3d step = k_step * Eigen::Vector3d::Unit(c);
            const Eigen::Matrix3d difference =
                (rotation_zyx(angles + step) - rotation_zyx(angles - step)) / (2.0 * k_step);
            EXPECT_LT((derivatives[static_cast<std::size_t>(c)] - difference).cwiseAbs().maxCoeff(), 1e-10) << c;
        }
    }
}

TEST(Rotation, TurnsOneDirectionIntoAnotherByTheSmallestAngle) {
    const std::vector<Eigen::Vector3d> directions{{1.0, 0.0, 0.0},  {-1.0, 0.0, 0.0},  {0.0, 0.0, 2.0},
                                                  {0.0, 0.0, -1.0}, {1e-5, 0.0, -1.0}, {0.3, -0.4, 1.2},
                                                  {-0.3, 0.4, -1.2}};
    for (const Eigen::Vector3d& from : directions) {
        for (const Eigen::Vector3d& to : directions) {
            const Eigen::Matrix3d turn = smallest_rotation(from, to);
            EXPECT_LT((turn * from.normalized() - to.normalized()).norm(), 1e-10);
            EXPECT_LT((turn.transpose() * turn - Eigen::Matrix3d::Identity()).norm(), 1e-10);
            EXPECT_NEAR(turn.determinant(), 1.0, 1e-10) << "no mirror";
            // The trace of a rotation by φ is 1 + 2 cos φ.
            EXPECT_NEAR(0.5 * (turn.trace() - 1.0), from.normalized().dot(to.normalized()), 1e-10);
        }
    }
}

TEST(Rotation, AnglesComeBack) {
    for (const Eigen::Vector3d& angles : rotation_angles()) {
        EXPECT_LT((angles_zyx(rotation_zyx(angles)) - angles).norm(), 1e-14 * (1.0 + angles.norm()));
    }
    const Eigen::Vector3d small(1e-9, -2e-9, 3e-9);
    EXPECT_LT((angles_zyx(rotation_zyx(small)) - small).norm(), 1e-24) << "arc seconds lose no digits";
}

TEST(RigidMotion, IsAppliedFromTheRightAndTakenBack) {
    MotionParameters first;
    first << 0.1, -0.2, 0.3, 0.4, -0.5, 0.6;
    MotionParameters second;
    second << -0.7, 0.1, 0.2, -1.0, 0.3, 2.0;
    const RigidMotion a = rigid_motion(first);
    const RigidMotion b = rigid_motion(second);
    const Eigen::Vector3d point(0.03, 0.12, -0.05);
    EXPECT_LT(((a * b) * point - a * (b * point)).norm(), 1e-15);
    EXPECT_LT((a.inverse() * (a * point) - point).norm(), 1e-15);
    EXPECT_LT((a * point - (rotation_zyx(first.tail<3>()) * point + first.head<3>())).norm(), 1e-15);
    EXPECT_LT((motion_parameters(a) - first).norm(), 1e-15);
    EXPECT_LT((motion_parameters(b) - second).norm(), 1e-15);
    EXPECT_TRUE((RigidMotion() * point - point).isZero(0.0));
}

TEST(RigidMotion, DisplacementOfAPointIsItsDerivativeAtRest) {
    constexpr double k_step = 1e-5;
    const Eigen::Vector3d point(0.03, 0.12, -0.05);
    const Eigen::Matrix<double, 3, 6> displacement = point_displacement(point);
    for (int c = 0; c < 6; ++c) {
        const MotionParameters step = k_step * MotionParameters::Unit(c);
        const Eigen::Vector3d difference = (rigid_motion(step) * point - rigid_motion(-step) * point) / (2.0 * k_step);
        EXPECT_LT((displacement.col(c) - difference).norm(), 1e-11) << c;
    }
}

}  // namespace
}  // namespace gumcert::engine
