#include "engine/rotary_table/datum.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <cmath>
#include <limits>
#include <string>

#include "engine/rotary_table/joint_adjustment.h"
#include "gum/quantity/dense_factors.h"
#include "text/numbers.h"

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

Eigen::Vector3d turn_vector(const Eigen::Matrix3d& rotation) {
    return {rotation(2, 1) - rotation(1, 2), rotation(0, 2) - rotation(2, 0), rotation(1, 0) - rotation(0, 1)};
}

/// Direction about which the table turned from home to the other angles, in the table frame of `poses`: what the
/// rotations leave where it is, by least squares, in the sense of positive angles.
Eigen::Vector3d direction_of_turning(const RotaryTableMeasurement& measurement, const Eigen::MatrixXd& poses) {
    const auto pose = [&](std::size_t i) -> Eigen::Matrix3d {
        return rotation_zyx(poses.col(static_cast<Eigen::Index>(i)).tail<3>()) * nominal_rotation(measurement, i);
    };
    const Eigen::Matrix3d from_home = pose(measurement.home).transpose();
    Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();  // Σ (M − I)ᵀ(M − I) = Σ (2 I − M − Mᵀ)
    Eigen::Vector3d sense = Eigen::Vector3d::Zero();    // Σ sin θ · 2 sin θ u
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        const Eigen::Matrix3d turn = pose(i) * from_home;
        squares += 2.0 * Eigen::Matrix3d::Identity() - turn - turn.transpose();
        sense += std::sin(measurement.angles[i] - measurement.angles[measurement.home]) * turn_vector(turn);
    }
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(squares);
    // Angles that are all home, modulo a turn, have no direction.
    constexpr double k_no_turn = 1e-6;
    if (!(solver.eigenvalues()[1] > k_no_turn)) {
        return Eigen::Vector3d::Unit(axial_coordinate(measurement.axis));
    }
    const Eigen::Vector3d direction = solver.eigenvectors().col(0);
    // Half turns only have no sense: then the one along the axis.
    constexpr double k_no_sense = 1e-3;
    const double along = sense.dot(direction);
    const double sign = std::abs(along) > k_no_sense ? along : direction[axial_coordinate(measurement.axis)];
    return sign < 0.0 ? -direction : direction;
}

/// The motion along the axis after which a set-up has neither a shift nor, by its angles, a turn along it. It commutes
/// with every R(θ), so that it is a matter of the table frame alone.
RigidMotion without_axial_part(const RigidMotion& set_up, int axial) {
    const Eigen::Matrix3d& r = set_up.rotation;
    // Of Rz(c) Ry(b) Rx(a) the element that vanishes with a, b or c where the other two are across the axis.
    const std::array<double, 3> turn = {std::atan2(-r(2, 1), r(1, 1)), std::atan2(r(2, 0), r(0, 0)),
                                        std::atan2(-r(1, 0), r(0, 0))};
    Eigen::Vector3d shift = Eigen::Vector3d::Zero();
    shift[axial] = -set_up.translation[axial];
    return {axis_rotation(axial, turn[static_cast<std::size_t>(axial)]), shift};
}

/// Rates of the stated set-up at T_s: its four numbers, and what the table frame moves along the axis for them, by a
/// small motion of the fixture across the axis (two shifts, two turns in T).
void set_rates(const RigidMotion& set_up, int axial, const std::array<int, 2>& across, DatumSolution& solution) {
    const Vector6 parameters = motion_parameters(set_up);
    const std::array<Eigen::Matrix3d, 3> derivatives = rotation_zyx_derivatives(parameters.tail<3>());
    Eigen::Matrix<double, 3, 2> velocity;  // of the turn in T by the two angles
    for (int c = 0; c < 2; ++c) {
        const auto coordinate = static_cast<std::size_t>(across[static_cast<std::size_t>(c)]);
        velocity.col(c) = 0.5 * turn_vector(derivatives[coordinate] * set_up.rotation.transpose());
    }
    Eigen::Matrix2d square;
    square << velocity.row(across[0]), velocity.row(across[1]);
    const Eigen::Matrix2d angles = square.inverse();
    const Eigen::RowVector2d turn = velocity.row(axial) * angles;  // of T about the axis
    solution.set_up_rates.setIdentity();
    solution.set_up_rates.bottomRightCorner<2, 2>() = angles;
    solution.along_rates.setZero();
    const Eigen::Vector3d along = Eigen::Vector3d::Unit(axial);
    const Eigen::Vector3d turned = along.cross(set_up.translation);
    for (int c = 0; c < 2; ++c) {
        const Eigen::Vector3d tilt = Eigen::Vector3d::Unit(across[static_cast<std::size_t>(c)]);
        solution.set_up_rates(0, 2 + c) = turned[across[0]] * turn[c];
        solution.set_up_rates(1, 2 + c) = turned[across[1]] * turn[c];
        solution.along_rates(0, 2 + c) = -tilt.cross(set_up.translation)[axial];
        solution.along_rates(1, 2 + c) = turn[c];
    }
}

std::string in_degrees_of(double angle) {
    return text::fixed(angle / gum::k_degree, 1) + "°";
}

std::string named_axis(RotaryAxis axis) {
    return std::string(1, "xyz"[axial_coordinate(axis)]);
}

}  // namespace

double inclination(RotaryAxis axis, const RigidMotion& set_up) {
    // Of the axis as the fixture sees it, T_sᵀ e, the part along its coordinate axis and that across it.
    const Eigen::Vector3d seen = set_up.rotation.row(axial_coordinate(axis)).transpose();
    const auto across = across_axis(axis);
    return std::atan2(std::hypot(seen[across[0]], seen[across[1]]), seen[axial_coordinate(axis)]);
}

std::optional<gum::Diagnostic> inclination_note(RotaryAxis axis, const RigidMotion& set_up) {
    const double angle = inclination(axis, set_up);
    if (!(angle > k_small_inclination)) {
        return std::nullopt;
    }
    return gum::Diagnostic{
        "GC-GEOMETRY-0006",
        "fixture",
        "the axis stands at " + in_degrees_of(angle) + " to " + named_axis(axis) + " of the fixture coordinates",
        "error motions across the axis are named after the coordinate axes of the fixture at home, which should be "
        "near "
        "those of the table: up to 10°",
        "check the frame of the coordinates, their order, and the letter of the axis; or state the coordinates in a "
        "frame with " +
            named_axis(axis) + " along the axis",
        gum::Severity::warning};
}

void refuse_inclined_fixture(RotaryAxis axis, const RigidMotion& set_up) {
    const double angle = inclination(axis, set_up);
    if (angle <= k_largest_inclination) {
        return;
    }
    const Eigen::Vector3d seen = set_up.rotation.row(axial_coordinate(axis)).transpose();
    Eigen::Index nearest = 0;
    seen.cwiseAbs().maxCoeff(&nearest);
    throw gum::NoResultError(gum::Diagnostic{
        "GC-GEOMETRY-0007", "fixture",
        "the axis of the table stands at " + in_degrees_of(angle) + " to " + named_axis(axis) +
            " of the fixture coordinates, and is nearest to their " + (seen[nearest] < 0.0 ? "−" : "") + "xyz"[nearest],
        "the axis lies along the coordinate of the fixture that has its letter, within 45°: error motions are named "
        "after these coordinates",
        "state the coordinates in a frame with " + named_axis(axis) +
            " along the axis, or correct the letter of the axis",
        gum::Severity::error});
}

Eigen::MatrixXd DatumSolution::stated_set_up_map() const {
    return inclined ? Eigen::MatrixXd(set_up_rates * set_up_map) : set_up_map;
}

Eigen::MatrixXd DatumSolution::frame_map(RotaryAxis axis) const {
    Eigen::MatrixXd map = world_map;
    if (inclined) {
        const int axial = axial_coordinate(axis);
        map.row(axial) += along_rates.row(0) * set_up_map;
        map.row(3 + axial) += along_rates.row(1) * set_up_map;
    }
    return map;
}

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
    const int axial = axial_coordinate(measurement.axis);
    const Eigen::Index size = 6 * angles;

    // Where the result will be, as far as rotations go: the axis along its coordinate.
    const Eigen::Matrix3d upright =
        smallest_rotation(direction_of_turning(measurement, poses), Eigen::Vector3d::Unit(axial));
    const RigidMotion swing{upright, Eigen::Vector3d::Zero()};
    const bool inclined = inclination(measurement.axis, swing * set_up) > k_small_inclination ||
                          inclination(measurement.axis, set_up) > k_small_inclination;
    if (inclined) {
        refuse_inclined_fixture(measurement.axis, swing * set_up);
    }
    RigidMotion table_from_fixture = swing * set_up;  // of an inclined fixture

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
                const auto rows = point_displacement(
                    rotation * (inclined ? Eigen::Vector3d(table_from_fixture * measurement.fixture.row(m).transpose())
                                         : Eigen::Vector3d(measurement.fixture.row(m).transpose())));
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

    const auto errors_with = [&](const RigidMotion& world, const RigidMotion& new_set_up) {
        const RigidMotion change = new_set_up * set_up.inverse();
        Eigen::MatrixXd errors(6, angles);
        for (Eigen::Index i = 0; i < angles; ++i) {
            const RigidMotion turn{nominal_rotation(measurement, static_cast<std::size_t>(i)), Eigen::Vector3d::Zero()};
            errors.col(i) =
                motion_parameters(world * rigid_motion(poses.col(i)) * turn * change.inverse() * turn.inverse());
        }
        return errors;
    };
    // The values exactly: compose the motions, and repeat the linear step until the conditions hold.
    constexpr double k_negligible = 1e-16;  // [m] and [rad]
    double forbidden = std::numeric_limits<double>::infinity();
    if (inclined) {
        RigidMotion world = swing;
        for (int iteration = 0; iteration < 30 && forbidden >= k_negligible; ++iteration) {
            solution.errors = errors_with(world, table_from_fixture);
            const Eigen::VectorXd step = change_map * solution.errors.reshaped();
            forbidden = step.cwiseAbs().maxCoeff();
            if (forbidden < k_negligible) {
                break;
            }
            Vector6 tilt = Vector6::Zero();
            for (int c = 0; c < 2; ++c) {
                tilt[across[static_cast<std::size_t>(c)]] = step[6 + c];
                tilt[3 + across[static_cast<std::size_t>(c)]] = step[8 + c];
            }
            table_from_fixture = rigid_motion(tilt) * table_from_fixture;
            const RigidMotion along = without_axial_part(table_from_fixture, axial);
            table_from_fixture = along * table_from_fixture;
            world = along * rigid_motion(step.head<6>()) * world;
        }
        solution.world = world;
        solution.set_up = motion_parameters(table_from_fixture);
        solution.set_up[axial] = 0.0;
        solution.set_up[3 + axial] = 0.0;
        set_rates(table_from_fixture, axial, across, solution);
        solution.inclined = true;
    } else {
        Vector6 world = Vector6::Zero();
        solution.set_up = motion_parameters(set_up);
        for (int iteration = 0; iteration < 20; ++iteration) {
            solution.world = rigid_motion(world);
            // From the poses as given in every iteration: errors that were moved again and again would gather the
            // rounding of all steps.
            solution.errors = errors_with(solution.world, rigid_motion(solution.set_up));
            const Eigen::VectorXd step = change_map * solution.errors.reshaped();
            forbidden = step.cwiseAbs().maxCoeff();
            if (forbidden < k_negligible) {
                break;
            }
            world += step.head<6>();
            for (int c = 0; c < 2; ++c) {
                solution.set_up[across[static_cast<std::size_t>(c)]] += step[6 + c];
                solution.set_up[3 + across[static_cast<std::size_t>(c)]] += step[8 + c];
            }
        }
    }
    // A thousandth of what any error motion is known to; NaN compares as false.
    constexpr double k_holds = 1e-12;  // [m] and [rad]
    if (!(forbidden < k_holds)) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-GEOMETRY-0008", "datum",
            "the error motions keep " + text::significant(forbidden, 2) + " (m or rad) of what the datum takes away",
            "mean and first harmonic that the datum sets to zero vanish within 1e-12",
            "check the frame of the fixture coordinates, the letter of the axis and the sense of the angles",
            gum::Severity::error});
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
