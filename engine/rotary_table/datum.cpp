#include "engine/rotary_table/datum.h"

#include <Eigen/LU>

#include <cmath>

#include "engine/rotary_table/joint_adjustment.h"

namespace gumcert::engine {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Effect of the set-up (two offsets and two tilts across the axis) on a pose: R(θ) on both pairs, 6×4.
Eigen::Matrix<double, 6, 4> turned_set_up(const Eigen::Matrix3d& rotation, const std::array<int, 2>& across) {
    Eigen::Matrix<double, 6, 4> effect = Eigen::Matrix<double, 6, 4>::Zero();
    for (int c = 0; c < 2; ++c) {
        effect.block<3, 1>(0, c) = rotation.col(across[static_cast<std::size_t>(c)]);
        effect.block<3, 1>(3, 2 + c) = rotation.col(across[static_cast<std::size_t>(c)]);
    }
    return effect;
}

}  // namespace

Eigen::MatrixXd DatumSolution::change_map() const {
    Eigen::MatrixXd map(10, world_map.cols());
    map << world_map, set_up_map;
    return map;
}

Eigen::MatrixXd DatumSolution::carried(const Eigen::Ref<const Eigen::MatrixXd>& by_pose) const {
    const Eigen::MatrixXd change = change_map() * by_pose;
    Eigen::MatrixXd result = by_pose;
    result.noalias() += motion_map * change;
    // The map for home itself is zero by definition, not by a difference of equal numbers.
    if (zero_angle) {
        result.middleRows<6>(6 * *zero_angle).setZero();
    }
    return result;
}

Eigen::MatrixXd DatumSolution::pulled_back(const Eigen::Ref<const Eigen::MatrixXd>& by_error) const {
    Eigen::MatrixXd result = by_error;
    if (zero_angle) {
        result.middleCols<6>(6 * *zero_angle).setZero();
    }
    const Eigen::MatrixXd by_change = result * motion_map;
    result.noalias() += by_change * change_map();
    return result;
}

DatumSolution transform_to_datum(const RotaryTableMeasurement& measurement, const Eigen::MatrixXd& poses,
                                 const RigidMotion& set_up, Datum datum) {
    const auto angles = static_cast<Eigen::Index>(measurement.angles.size());
    const auto across = across_axis(measurement.axis);
    const Eigen::Index size = 6 * angles;

    // e = e' + D c with c = (w, z): a motion of the world and a change of the set-up; H e = 0 is the datum.
    Eigen::MatrixXd motion(size, 10);
    Eigen::MatrixXd condition(10, size);
    condition.setZero();
    for (Eigen::Index i = 0; i < angles; ++i) {
        const Eigen::Matrix3d rotation = nominal_rotation(measurement, static_cast<std::size_t>(i));
        const Eigen::Matrix<double, 6, 4> turned = turned_set_up(rotation, across);
        motion.block<6, 6>(6 * i, 0).setIdentity();
        // Minus, because moving the fixture by z shows the table moved the other way.
        motion.block<6, 4>(6 * i, 6) = -turned;
        // Standard uncertainties of the same data differ by 25 to 43 % between the two conventions (ADR 0006): a result
        // without its datum means nothing.
        if (datum == Datum::axis_average_line) {
            // Least squares over the angles: means and turning parts of the result vanish.
            condition.block<6, 6>(0, 6 * i).setIdentity();
            condition.block<4, 6>(6, 6 * i) = turned.transpose();
        } else {
            // The set-up minimises the squares of the remaining reflector positions (the paper's eqs. (5), (6)).
            const Eigen::Matrix<double, 6, 4> effect = turned - turned_set_up(Eigen::Matrix3d::Identity(), across);
            Eigen::Matrix<double, 6, 6> metric = Eigen::Matrix<double, 6, 6>::Zero();
            for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
                const auto rows = point_displacement(rotation * measurement.fixture.row(m).transpose());
                metric += rows.transpose() * rows;
            }
            condition.block<4, 6>(6, 6 * i) = effect.transpose() * metric;
        }
    }
    if (datum == Datum::home) {
        condition.block<6, 6>(0, 6 * static_cast<Eigen::Index>(measurement.home)).setIdentity();
    }
    // Columns and rows differ by powers of ten (metres against radians): scale before the solve.
    Eigen::MatrixXd square = condition * motion;
    const Eigen::VectorXd row_scale = square.cwiseAbs().rowwise().maxCoeff().cwiseInverse();
    const Eigen::MatrixXd change_map =
        -(row_scale.asDiagonal() * square).fullPivLu().solve(row_scale.asDiagonal() * condition);  // c = map e'

    DatumSolution solution;
    solution.motion_map = motion;
    solution.world_map = change_map.topRows(6);
    solution.set_up_map = change_map.bottomRows(4);

    // The values exactly: compose the motions, and repeat the linear step until the conditions hold.
    const Vector6 start = motion_parameters(set_up);
    Vector6 world = Vector6::Zero();
    solution.set_up = start;
    for (int iteration = 0; iteration < 20; ++iteration) {
        solution.world = rigid_motion(world);
        // From the poses as given in every iteration: errors that were moved again and again would gather the rounding
        // of all steps.
        const RigidMotion change = rigid_motion(solution.set_up) * set_up.inverse();
        solution.errors.resize(6, angles);
        for (Eigen::Index i = 0; i < angles; ++i) {
            const RigidMotion turn{nominal_rotation(measurement, static_cast<std::size_t>(i)), Eigen::Vector3d::Zero()};
            solution.errors.col(i) = motion_parameters(solution.world * rigid_motion(poses.col(i)) * turn *
                                                       change.inverse() * turn.inverse());
        }
        const Eigen::VectorXd step = change_map * solution.errors.reshaped();
        if (step.cwiseAbs().maxCoeff() < 1e-16) {
            break;
        }
        world += step.head<6>();
        for (int c = 0; c < 2; ++c) {
            solution.set_up[across[static_cast<std::size_t>(c)]] += step[6 + c];
            solution.set_up[3 + across[static_cast<std::size_t>(c)]] += step[8 + c];
        }
    }
    if (datum == Datum::home) {
        // Zero by definition, not by rounding: neither a value nor an uncertainty is stated at home.
        const auto home = static_cast<Eigen::Index>(measurement.home);
        solution.errors.col(home).setZero();
        solution.motion_map.middleRows<6>(6 * home).setZero();
        solution.zero_angle = home;
    }
    return solution;
}

}  // namespace gumcert::engine
