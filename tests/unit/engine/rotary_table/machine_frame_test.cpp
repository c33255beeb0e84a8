#include "engine/rotary_table/machine_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "engine/rotary_table/datum.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {
namespace {

using Vector10 = LocationErrorModel::Vector10;
using Matrix10 = Eigen::Matrix<double, 10, 10>;

Eigen::MatrixXd reflectors() {
    Eigen::MatrixXd points(5, 3);
    points << 0.03, 0.12, 0.0, 0.15, 0.05, 0.1, 0.06, -0.085, 0.09, 0.18, -0.07, -0.05, 0.04, 0.01, -0.12;
    return points;
}

/// Turned by any angle about the axis, and tilted by a few milliradians.
RigidMotion any_motion(RotaryAxis axis, std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const Eigen::Matrix3d tilt =
        Eigen::AngleAxisd(2e-3, Eigen::Vector3d(uniform(random), uniform(random), uniform(random)).normalized())
            .toRotationMatrix();
    const Eigen::Matrix3d turn =
        Eigen::AngleAxisd(3.0 * uniform(random), Eigen::Vector3d::Unit(axial_coordinate(axis))).toRotationMatrix();
    return {tilt * turn, Eigen::Vector3d(0.5, 0.25, -0.3)};
}

MachineFrame frame_of(const Eigen::MatrixXd& points, const RigidMotion& motion, double u) {
    MachineFrame frame;
    frame.coordinates.resize(points.rows(), 3);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        frame.points.push_back(static_cast<std::size_t>(i));
        frame.coordinates.row(i) = (motion * points.row(i).transpose()).transpose();
    }
    frame.u = Eigen::VectorXd::Constant(points.rows(), u);
    frame.nominal_point = Eigen::Vector3d(0.6, 0.26, -0.31);
    return frame;
}

TEST(MachineFrameFit, FindsTheMotionOfExactPoints) {
    std::mt19937_64 random(1);
    const Eigen::MatrixXd points = reflectors();
    for (int trial = 0; trial < 20; ++trial) {
        const RigidMotion motion = any_motion(RotaryAxis::b, random);
        const MachineFrameFit fit =
            fit_machine_frame(points, Eigen::MatrixXd::Identity(15, 15) * 1e-14, frame_of(points, motion, 1e-6));
        EXPECT_LT((fit.motion.rotation - motion.rotation).cwiseAbs().maxCoeff(), 1e-13);
        EXPECT_LT((fit.motion.translation - motion.translation).cwiseAbs().maxCoeff(), 1e-13);
        EXPECT_LT(fit.chi_square, 1e-12);
        EXPECT_EQ(fit.degrees_of_freedom, 9.0);
    }
}

TEST(MachineFrameFit, CovarianceIsThatOfRepeatedMeasurements) {
    std::mt19937_64 random(2);
    std::normal_distribution<double> normal;
    const Eigen::MatrixXd points = reflectors();
    const RigidMotion motion = any_motion(RotaryAxis::a, random);
    MachineFrame exact = frame_of(points, motion, 1e-6);
    exact.u << 1e-6, 2e-6, 1e-6, 4e-6, 1e-6;
    constexpr double k_own = 0.5e-6;
    constexpr int k_trials = 3000;
    Eigen::Matrix<double, 6, 6> sum = Eigen::Matrix<double, 6, 6>::Zero();
    double chi_square = 0.0;
    MachineFrameFit fit;
    for (int trial = 0; trial < k_trials; ++trial) {
        MachineFrame frame = exact;
        Eigen::MatrixXd own = points;
        for (Eigen::Index i = 0; i < points.rows(); ++i) {
            for (int c = 0; c < 3; ++c) {
                frame.coordinates(i, c) += frame.u[i] * normal(random);
                own(i, c) += k_own * normal(random);
            }
        }
        fit = fit_machine_frame(own, Eigen::MatrixXd::Identity(15, 15) * k_own * k_own, frame);
        const RigidMotion off = fit.motion * motion.inverse();  // from the true machine to the one found
        Eigen::Matrix<double, 6, 1> error;
        error.head<3>() = off * fit.centre - fit.centre;
        const Eigen::AngleAxisd turn(off.rotation);
        error.tail<3>() = turn.angle() * turn.axis();
        sum += error * error.transpose();
        chi_square += fit.chi_square;
    }
    const Eigen::Matrix<double, 6, 1> u = fit.covariance.diagonal().cwiseSqrt();
    const Eigen::Matrix<double, 6, 6> found =
        u.cwiseInverse().asDiagonal() * (sum / k_trials) * u.cwiseInverse().asDiagonal();
    const Eigen::Matrix<double, 6, 6> expected =
        u.cwiseInverse().asDiagonal() * fit.covariance * u.cwiseInverse().asDiagonal();
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 0.1);  // four standard deviations of 3000 trials
    EXPECT_NEAR(chi_square / k_trials, fit.degrees_of_freedom, 0.4);
}

TEST(MachineFrameFit, PointsOnOneLineAreRefused) {
    Eigen::MatrixXd points(4, 3);
    points << 0.0, 0.0, 0.0, 0.1, 0.1, 0.0, 0.2, 0.2, 0.0, 0.3, 0.3, 1e-6;
    for (const Eigen::Index rows : {4, 2}) {
        const Eigen::MatrixXd some = points.topRows(rows);
        try {
            (void)fit_machine_frame(some, Eigen::MatrixXd::Zero(3 * rows, 3 * rows),
                                    frame_of(some, RigidMotion{}, 1e-6));
            ADD_FAILURE() << rows;
        } catch (const gum::InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-FRAME-0001");
        }
    }
}

/// The axis through two points of the table frame, seen in the machine.
Eigen::Vector4d by_two_points(RotaryAxis axis, const RigidMotion& machine_from_table, const Eigen::Vector3d& nominal) {
    const int k = axial_coordinate(axis);
    const Eigen::Vector3d a = machine_from_table * Eigen::Vector3d::Zero();
    const Eigen::Vector3d b = machine_from_table * Eigen::Vector3d(Eigen::Vector3d::Unit(k));
    const Eigen::Vector3d slope = (b - a) / (b[k] - a[k]);
    const Eigen::Vector3d off = a + (nominal[k] - a[k]) * slope - nominal;
    switch (axis) {
        case RotaryAxis::a:
            return {off[1], off[2], -std::atan(slope[2]), std::atan(slope[1])};
        case RotaryAxis::b:
            return {off[0], off[2], std::atan(slope[2]), -std::atan(slope[0])};
        default:
            return {off[0], off[1], -std::atan(slope[1]), std::atan(slope[0])};
    }
}

Vector10 any_home(std::mt19937_64& random) {
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    Vector10 home;
    for (double& value : home) {
        value = uniform(random);
    }
    home.head<3>() *= 20e-6;
    home.segment<3>(3) *= 1e-4;
    home.segment<2>(6) *= 2e-3;
    home.tail<2>() *= 3e-3;
    return home;
}

RigidMotion fixture_at_home(RotaryAxis axis, const Vector10& home) {
    Eigen::Matrix<double, 6, 1> set_up = Eigen::Matrix<double, 6, 1>::Zero();
    const auto across = across_axis(axis);
    for (int c = 0; c < 2; ++c) {
        set_up[across[static_cast<std::size_t>(c)]] = home[6 + c];
        set_up[3 + across[static_cast<std::size_t>(c)]] = home[8 + c];
    }
    return rigid_motion(home.head<6>()) * rigid_motion(set_up);
}

TEST(LocationErrors, AreTheAxisOfTheTableInTheMachine) {
    std::mt19937_64 random(3);
    const std::array<std::array<std::string, 4>, 3> names{
        {{"EY0A", "EZ0A", "EB0A", "EC0A"}, {"EX0B", "EZ0B", "EA0B", "EC0B"}, {"EX0C", "EY0C", "EA0C", "EB0C"}}};
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        EXPECT_EQ(location_error_names(axis), names[static_cast<std::size_t>(axis)]);
        for (int trial = 0; trial < 20; ++trial) {
            const RigidMotion machine_from_table = any_motion(axis, random);
            const Vector10 home = any_home(random);
            const Eigen::MatrixXd points = reflectors();
            const MachineFrame probed = frame_of(points, machine_from_table * fixture_at_home(axis, home), 1e-6);
            const MachineFrameFit fit = fit_machine_frame(points, Eigen::MatrixXd::Zero(15, 15), probed);
            const LocationErrorModel model(axis, probed, fit, home, Matrix10::Identity() * 1e-14, 20.0);
            const Eigen::Vector4d expected = by_two_points(axis, machine_from_table, probed.nominal_point);
            EXPECT_LT((model.evaluate(gum::input_estimates(model)) - expected).cwiseAbs().maxCoeff(), 1e-12);

            const MachineFrame stations = frame_of(points, machine_from_table, 1e-6);
            const MachineFrameFit of_stations = fit_machine_frame(points, Eigen::MatrixXd::Zero(15, 15), stations);
            const LocationErrorModel by_stations(axis, stations, of_stations);
            EXPECT_LT((by_stations.evaluate(gum::input_estimates(by_stations)) - expected).cwiseAbs().maxCoeff(),
                      1e-12);
            EXPECT_LT(by_stations.angle_to_machine_axis(), 2.1e-3);
        }
    }
}

TEST(LocationErrors, UncertaintyIsThatOfDrawnPosesAndFrames) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> normal;
    const RotaryAxis axis = RotaryAxis::c;
    const Eigen::MatrixXd points = reflectors();
    const Vector10 home = any_home(random);
    const RigidMotion machine_from_table = any_motion(axis, random);
    const MachineFrame frame = frame_of(points, machine_from_table * fixture_at_home(axis, home), 2e-6);
    const MachineFrameFit fit = fit_machine_frame(points, Eigen::MatrixXd::Zero(15, 15), frame);
    Matrix10 root = Matrix10::Zero();  // correlated, of micrometres and microradians
    for (double& element : root.reshaped()) {
        element = 1e-6 * normal(random);
    }
    const LocationErrorModel model(axis, frame, fit, home, root * root.transpose(), 12.0);
    const Eigen::VectorXd estimates = gum::input_estimates(model);
    const Eigen::VectorXd value = model.evaluate(estimates);
    const Eigen::VectorXd u = model.jacobian(estimates).rowwise().norm();  // of inputs with u = 1
    EXPECT_EQ(model.inputs()[0].degrees_of_freedom, 12.0);

    constexpr int k_trials = 4000;
    Eigen::Matrix4d sum = Eigen::Matrix4d::Zero();
    const Eigen::Matrix<double, 6, 6> motion_root = fit.covariance.llt().matrixL();
    for (int trial = 0; trial < k_trials; ++trial) {
        Vector10 z;
        std::ranges::generate(z, [&] { return normal(random); });
        Eigen::Matrix<double, 6, 1> w;
        std::ranges::generate(w, [&] { return normal(random); });
        const Eigen::Matrix<double, 6, 1> motion = motion_root * w;
        RigidMotion off;  // about the centre
        off.rotation = Eigen::AngleAxisd(motion.tail<3>().norm(), motion.tail<3>().normalized()).toRotationMatrix();
        off.translation = fit.centre + motion.head<3>() - off.rotation * fit.centre;
        const RigidMotion drawn = off * fit.motion * fixture_at_home(axis, home + root * z).inverse();
        const Eigen::Vector4d error = by_two_points(axis, drawn, frame.nominal_point) - value;
        sum += error * error.transpose();
    }
    for (int i = 0; i < 4; ++i) {
        EXPECT_NEAR(std::sqrt(sum(i, i) / k_trials) / u[i], 1.0, 0.05) << i;
    }
}

}  // namespace
}  // namespace gumcert::engine
