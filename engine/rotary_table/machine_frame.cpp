#include "engine/rotary_table/machine_frame.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/rotary_table/datum.h"
#include "gum/quantity/dense_factors.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

constexpr Eigen::Index k_home = 10;
constexpr Eigen::Index k_motion = 6;
constexpr Eigen::Index k_errors = 4;
// Second singular value of the points, relative to the first: below it they lie on a line.
constexpr double k_least_width = 1e-4;

Eigen::Matrix3d cross_matrix(const Eigen::Vector3d& v) {
    Eigen::Matrix3d result;
    result << 0.0, -v[2], v[1], v[2], 0.0, -v[0], -v[1], v[0], 0.0;
    return result;
}

/// exp of a rotation vector.
Eigen::Matrix3d turn(const Eigen::Vector3d& vector) {
    const double angle = vector.norm();
    return angle > 0.0 ? Eigen::AngleAxisd(angle, vector / angle).toRotationMatrix() : Eigen::Matrix3d::Identity();
}

void require_width(const Eigen::MatrixXd& centred, MachineFramePoints by) {
    const Eigen::VectorXd widths = Eigen::JacobiSVD<Eigen::MatrixXd>(centred).singularValues();
    if (centred.rows() < 3 || !(widths[1] > k_least_width * widths[0])) {
        throw gum::InputError(gum::Diagnostic{
            "GC-FRAME-0001", "machine frame",
            std::to_string(centred.rows()) + (by == MachineFramePoints::stations ? " stations" : " reflectors") +
                " that lie on one line or are fewer than three",
            "three points that are not on a line determine the frame of the machine",
            "Measure the coordinates of more of them in the frame of the machine", gum::Severity::error});
    }
}

/// The rotation that carries `from` to `to`, both about their centres, with equal weights (Kabsch).
/// Only a start: with equal weights. Without it the linearised steps would have to find their way from any orientation.
Eigen::Matrix3d start_rotation(const Eigen::MatrixXd& from, const Eigen::MatrixXd& to) {
    const Eigen::Matrix3d product = from.transpose() * to;
    const Eigen::JacobiSVD<Eigen::Matrix3d> svd(product, Eigen::ComputeFullU | Eigen::ComputeFullV);
    // Without the sign the best orthogonal matrix may be a reflection, as for points in a plane.
    const double sign = (svd.matrixV() * svd.matrixU().transpose()).determinant() < 0.0 ? -1.0 : 1.0;
    return svd.matrixV() * Eigen::Vector3d(1.0, 1.0, sign).asDiagonal() * svd.matrixU().transpose();
}

/// S with S Sᵀ = covariance, symmetric; also of a singular one.
template <int n>
Eigen::Matrix<double, n, n> root_of(const Eigen::Matrix<double, n, n>& covariance) {
    // To a unit diagonal first: metres and radians differ by powers of ten.
    const Eigen::Matrix<double, n, 1> u = covariance.diagonal().cwiseSqrt();
    const Eigen::Matrix<double, n, 1> inverse_u = (u.array() > 0.0).select(u.cwiseInverse(), 0.0);
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, n, n>> eigen(
        Eigen::Matrix<double, n, n>(inverse_u.asDiagonal() * covariance * inverse_u.asDiagonal()));
    return u.asDiagonal() * eigen.operatorSqrt();
}

gum::InputGroup standard_group(const char* name, const char* source, Eigen::Index size) {
    gum::InputGroup group;
    group.name = name;
    group.source = source;
    group.unit = "1";
    group.value = Eigen::VectorXd::Zero(size);
    group.covariance = Eigen::MatrixXd::Ones(size, 1);
    return group;
}

}  // namespace

MachineFrameFit fit_machine_frame(const Eigen::MatrixXd& points, const Eigen::MatrixXd& covariance,
                                  const MachineFrame& frame) {
    const Eigen::Index n = points.rows();
    const Eigen::RowVector3d centre_from = points.colwise().mean();
    const Eigen::RowVector3d centre_to = frame.coordinates.colwise().mean();
    const Eigen::MatrixXd centred = points.rowwise() - centre_from;
    require_width(centred, frame.by);
    Eigen::Matrix3d rotation = start_rotation(centred, frame.coordinates.rowwise() - centre_to);
    Eigen::Vector3d centre = centre_to.transpose();

    MachineFrameFit fit;
    fit.residuals.resize(n, 3);
    Eigen::MatrixXd design(3 * n, k_motion);
    constexpr int k_steps = 20;
    constexpr double k_small = 1e-10;  // of the uncertainty of the motion
    for (int step = 0; step < k_steps; ++step) {
        Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3 * n, 3 * n);
        Eigen::VectorXd residual(3 * n);
        for (Eigen::Index i = 0; i < n; ++i) {
            const Eigen::Vector3d carried = rotation * centred.row(i).transpose();
            residual.segment<3>(3 * i) = frame.coordinates.row(i).transpose() - (centre + carried);
            design.block<3, 3>(3 * i, 0).setIdentity();
            design.block<3, 3>(3 * i, 3) = -cross_matrix(carried);
            for (Eigen::Index j = 0; j < n; ++j) {
                // Covariances of the points are turned into the machine frame: the weights follow the rotation in each
                // step.
                sum.block<3, 3>(3 * i, 3 * j) = rotation * covariance.block<3, 3>(3 * i, 3 * j) * rotation.transpose();
            }
            sum.block<3, 3>(3 * i, 3 * i).diagonal().array() += frame.u[i] * frame.u[i];
        }
        const Eigen::LLT<Eigen::MatrixXd> weight(sum);
        const Eigen::MatrixXd whitened = weight.matrixL().solve(design);
        const Eigen::VectorXd whitened_residual = weight.matrixL().solve(residual);
        const Eigen::LLT<Eigen::MatrixXd> normal(Eigen::MatrixXd(whitened.transpose() * whitened));
        const Vector6 change = normal.solve(whitened.transpose() * whitened_residual);
        fit.covariance = normal.solve(Matrix6::Identity());
        fit.chi_square = whitened_residual.squaredNorm();
        fit.residuals = residual.reshaped<Eigen::RowMajor>(n, 3);
        // The step in terms of the uncertainty of the motion, so that metres and radians count alike.
        if ((whitened * change).norm() < k_small) {
            break;
        }
        centre += change.head<3>();
        // Composed, not added: the design has the derivatives by a small turn of the points as they stand.
        rotation = turn(change.tail<3>()) * rotation;
    }
    fit.covariance = (0.5 * (fit.covariance + fit.covariance.transpose())).eval();
    fit.degrees_of_freedom = static_cast<double>(3 * n - k_motion);
    fit.centre = centre;
    fit.motion = {rotation, centre - rotation * centre_from.transpose()};
    return fit;
}

LocationErrorModel::LocationErrorModel(RotaryAxis axis, const MachineFrame& frame, const MachineFrameFit& fit)
    : axis_(axis), nominal_point_(frame.nominal_point), fit_(fit), motion_root_(root_of(fit.covariance)) {
    add_frame();
}

LocationErrorModel::LocationErrorModel(RotaryAxis axis, const MachineFrame& frame, const MachineFrameFit& fit,
                                       const Vector10& home, const Eigen::Matrix<double, 10, 10>& home_covariance,
                                       double degrees_of_freedom)
    : axis_(axis),
      nominal_point_(frame.nominal_point),
      fit_(fit),
      home_(home),
      home_root_(root_of(home_covariance)),
      motion_root_(root_of(fit.covariance)) {
    inputs_.push_back(standard_group("pose of the fixture at home", "measurement of the axis", k_home));
    inputs_.back().degrees_of_freedom = degrees_of_freedom;
    add_frame();
}

void LocationErrorModel::add_frame() {
    inputs_.push_back(standard_group("machine frame", "machine frame", k_motion));
    const auto names = location_error_names(axis_);
    for (std::size_t i = 0; i < names.size(); ++i) {
        outputs_.push_back({names[i], i < 2 ? "m" : "rad"});
    }
}

LocationErrorModel::Line LocationErrorModel::line_in_machine(const Eigen::Ref<const Eigen::VectorXd>& x) const {
    const int axial = axial_coordinate(axis_);
    Line line{Eigen::Vector3d::Zero(), Eigen::Vector3d::Unit(axial)};
    if (inputs_.size() > 1) {  // in the frame of the fixture, as it stands at the home angle
        const Vector10 home = home_ + home_root_ * x.head<k_home>();
        Vector6 set_up = Vector6::Zero();
        const auto across = across_axis(axis_);
        for (int c = 0; c < 2; ++c) {
            set_up[across[static_cast<std::size_t>(c)]] = home[6 + c];
            set_up[3 + across[static_cast<std::size_t>(c)]] = home[8 + c];
        }
        // P = E(home) T_s p, the other way round: where the axis of the table is in the fixture, as it was probed.
        const RigidMotion fixture_from_table = (rigid_motion(home.head<6>()) * rigid_motion(set_up)).inverse();
        line = {fixture_from_table.translation, fixture_from_table.rotation.col(axial)};
    }
    // About the centre of the points, where shift and turn hardly depend on each other.
    const Eigen::Matrix<double, k_motion, 1> motion = motion_root_ * x.tail<k_motion>();
    const Eigen::Matrix3d turned = turn(motion.tail<3>());
    const Eigen::Vector3d arm = fit_.motion * line.point - fit_.centre;
    return {fit_.centre + motion.head<3>() + turned * arm, turned * (fit_.motion.rotation * line.direction)};
}

Eigen::VectorXd LocationErrorModel::evaluate(const Eigen::VectorXd& x) const {
    const int axial = axial_coordinate(axis_);
    const Line line = line_in_machine(x);
    const double along = (nominal_point_[axial] - line.point[axial]) / line.direction[axial];
    const Eigen::Vector3d pierced = line.point + along * line.direction;
    const auto cross = cross_coordinates(axis_);
    Eigen::VectorXd result(k_errors);
    for (int c = 0; c < 2; ++c) {
        const int coordinate = cross[static_cast<std::size_t>(c)];
        result[c] = pierced[coordinate] - nominal_point_[coordinate];
        const auto [component, sign] = axis_tilt(axis_, coordinate);
        // The axis of a table has no sense: it is taken along the coordinate axis of the machine.
        result[2 + c] = std::atan(sign * line.direction[component] / line.direction[axial]);
    }
    return result;
}

Eigen::MatrixXd LocationErrorModel::jacobian(const Eigen::VectorXd& x) const {
    // Central differences: the curvature cancels, and over ± one standard uncertainty rounding does not matter.
    constexpr double k_step = 1.0;  // one standard uncertainty
    Eigen::MatrixXd result(k_errors, x.size());
    for (Eigen::Index i = 0; i < x.size(); ++i) {
        Eigen::VectorXd above = x;
        Eigen::VectorXd below = x;
        above[i] += k_step;
        below[i] -= k_step;
        result.col(i) = (evaluate(above) - evaluate(below)) / (above[i] - below[i]);
    }
    return result;
}

double LocationErrorModel::angle_to_machine_axis() const {
    const Line line = line_in_machine(gum::input_estimates(*this));
    const double along = std::abs(line.direction[axial_coordinate(axis_)]);
    return std::acos(std::min(1.0, along));
}

std::array<std::string, 4> location_error_names(RotaryAxis axis) {
    const auto cross = cross_coordinates(axis);
    const std::string letter(1, "ABC"[axial_coordinate(axis)]);
    return {std::string("E") + "XYZ"[cross[0]] + "0" + letter, std::string("E") + "XYZ"[cross[1]] + "0" + letter,
            std::string("E") + "ABC"[cross[0]] + "0" + letter, std::string("E") + "ABC"[cross[1]] + "0" + letter};
}

}  // namespace gumcert::engine
