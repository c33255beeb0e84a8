#include "engine/rotary_table/table_parameters.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/rotary_table/anglewise_map.h"

namespace gumcert::engine {

namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

// A rotation known to a milliradian says nothing about a table that errs by seconds of arc.
constexpr double k_least_known_rotation = 1e-3;  // [rad]

/// Index of the axial error motion of an angle among the reported quantities.
Eigen::Index axial_error(RotaryAxis axis, Eigen::Index angle) {
    return 6 * angle + 3 + axial_coordinate(axis);
}

/// +1/2, -1/2, or 0 where the adjustment has no reversal.
double reversal_share(bool has_reversal, Approach approach) {
    return !has_reversal ? 0.0 : approach == Approach::positive ? 0.5 : -0.5;
}

/// T_s with (O, O, S, S) across the axis.
Vector6 set_up_parameters(RotaryAxis axis, const Eigen::Vector4d& set_up) {
    const auto across = across_axis(axis);
    Vector6 result = Vector6::Zero();
    for (int c = 0; c < 2; ++c) {
        result[across[static_cast<std::size_t>(c)]] = set_up[c];
        result[3 + across[static_cast<std::size_t>(c)]] = set_up[2 + c];
    }
    return result;
}

/// Point where the axis pierces the plane through the origin of the fixture across the axis, its direction there, and
/// the derivatives of both; c counts (O, O, S, S).
struct AxisInFixture {
    Eigen::Vector3d point, direction;
    Eigen::Matrix<double, 3, 4> point_by, direction_by;
};

AxisInFixture axis_in_fixture(RotaryAxis axis, const Eigen::Vector4d& set_up) {
    const int k = axial_coordinate(axis);
    const auto across = across_axis(axis);
    const Vector6 parameters = set_up_parameters(axis, set_up);
    const RigidMotion fixture_from_table = rigid_motion(parameters).inverse();
    const auto by_angle = rotation_zyx_derivatives(parameters.tail<3>());
    const Eigen::Vector3d& origin = fixture_from_table.translation;

    AxisInFixture result;
    result.direction = fixture_from_table.rotation.col(k);
    const Eigen::Vector3d& u = result.direction;
    // Along the axis to the plane through the origin of the fixture: there its position is stated.
    const double along = origin[k] / u[k];
    result.point = origin - along * u;
    for (int c = 0; c < 4; ++c) {
        // The inverse of (R, t) is (Rᵀ, −Rᵀ t). An offset moves its origin by a column of Rᵀ; a tilt changes Rᵀ, and
        // the origin with it.
        const int coordinate = across[static_cast<std::size_t>(c % 2)];
        Eigen::Vector3d origin_by;
        Eigen::Vector3d u_by = Eigen::Vector3d::Zero();
        if (c < 2) {
            origin_by = -fixture_from_table.rotation.col(coordinate);
        } else {
            const Eigen::Matrix3d turned = by_angle[static_cast<std::size_t>(coordinate)].transpose();
            origin_by = -(turned * parameters.head<3>());
            u_by = turned.col(k);
        }
        // The plane stays where it is while the axis moves: the place along the axis where they meet follows.
        const double along_by = (origin_by[k] - along * u_by[k]) / u[k];
        result.direction_by.col(c) = u_by;
        result.point_by.col(c) = origin_by - along_by * u - along * u_by;
    }
    return result;
}

Eigen::Matrix4d axis_line_derivatives(RotaryAxis axis, const Eigen::Vector4d& set_up) {
    const AxisInFixture line = axis_in_fixture(axis, set_up);
    const int k = axial_coordinate(axis);
    const auto cross = cross_coordinates(axis);
    Eigen::Matrix4d result;
    for (int c = 0; c < 2; ++c) {
        const int coordinate = cross[static_cast<std::size_t>(c)];
        result.row(c) = line.point_by.row(coordinate);
        const auto [component, sign] = axis_tilt(axis, coordinate);
        const double u = line.direction[component];
        const double w = line.direction[k];
        // Derivative of the arc tangent of u/w.
        result.row(2 + c) =
            sign * (w * line.direction_by.row(component) - u * line.direction_by.row(k)) / (u * u + w * w);
    }
    return result;
}

constexpr std::array<const char*, k_positioning_parameters> k_descriptions{
    "range of the mean bidirectional deviations",
    "range of the mean deviations of both senses of approach together",
    "range of the mean deviations, positive approach",
    "range of the mean deviations, negative approach",
    "bidirectional repeatability of positioning",
    "repeatability of positioning, positive approach",
    "repeatability of positioning, negative approach",
    "largest magnitude of the reversal, positive minus negative approach",
    "mean of the reversals, positive minus negative approach",
    "bidirectional accuracy of positioning",
    "accuracy of positioning, positive approach",
    "accuracy of positioning, negative approach",
};

}  // namespace

VisitPositionGains visit_position_gains(const JointAdjustment& solved, const StochasticModel& stochastic) {
    StochasticModel without_axial = stochastic;
    // The axial deviation of a visit is part of the position that is looked for: as noise in the weights it would be
    // drawn towards the mean.
    without_axial.variance_axial = 0.0;
    const int column = 3 + axial_coordinate(solved.measurement().axis);
    VisitPositionGains result;
    for (std::size_t v = 0; v < solved.visits().size(); ++v) {
        const Eigen::VectorXd by_rotation = solved.pose_jacobian(v).col(column);
        const Eigen::VectorXd weighted = solved.visit_covariance(v, without_axial).llt().solve(by_rotation);
        const double information = by_rotation.dot(weighted);  // [1/rad²]
        result.gains.emplace_back();
        // A visit whose lengths hardly see the rotation would bring a deviation of milliradians into means and maxima.
        if (information > 1.0 / (k_least_known_rotation * k_least_known_rotation) && std::isfinite(information)) {
            result.gains.back() = weighted / information;
        }
    }
    return result;
}

Eigen::VectorXd visit_positions(const JointAdjustment& solved, const Eigen::Ref<const Eigen::VectorXd>& reported,
                                const VisitPositionGains& gains) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const std::vector<Visit>& visits = solved.visits();
    const int axial = 3 + axial_coordinate(measurement.axis);
    Eigen::VectorXd positions = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(visits.size()));
    for (std::size_t v = 0; v < visits.size(); ++v) {
        if (!gains.determined(v)) {
            continue;
        }
        double& position = positions[static_cast<Eigen::Index>(v)];
        // The value of an angle rests on all its visits. What the table did at this one visit is left in the residuals
        // of its lengths, and comes back from these.
        position = reported[axial_error(measurement.axis, static_cast<Eigen::Index>(visits[v].angle))] +
                   gains.gains[v].dot(solved.adjustment().residual(v));
        if (solved.has_reversal()) {
            position += reversal_share(true, visits[v].approach) * solved.reversal(visits[v].angle)[axial];
        }
    }
    return positions;
}

Eigen::Vector4d axis_line(RotaryAxis axis, const Eigen::Vector4d& set_up) {
    const AxisInFixture line = axis_in_fixture(axis, set_up);
    const auto cross = cross_coordinates(axis);
    Eigen::Vector4d result;
    for (int c = 0; c < 2; ++c) {
        const int coordinate = cross[static_cast<std::size_t>(c)];
        result[c] = line.point[coordinate];
        const auto [component, sign] = axis_tilt(axis, coordinate);
        result[2 + c] = std::atan2(sign * line.direction[component], line.direction[axial_coordinate(axis)]);
    }
    return result;
}

std::array<std::string, 4> axis_line_names(RotaryAxis axis) {
    const auto cross = cross_coordinates(axis);
    return {std::string("axis_") + "xyz"[cross[0]], std::string("axis_") + "xyz"[cross[1]],
            std::string("axis_") + "abc"[cross[0]], std::string("axis_") + "abc"[cross[1]]};
}

TableParameters::TableParameters(const RotaryTableMeasurement& measurement, const DatumSolution& datum,
                                 const Eigen::VectorXd& reported, std::vector<Visit> visits,
                                 const VisitPositionGains& gains)
    : axis_(measurement.axis),
      angles_(static_cast<Eigen::Index>(measurement.angles.size())),
      to_average_line_(Eigen::MatrixXd::Zero(4, reported.size())),
      nominal_reported_(reported) {
    to_average_line_.middleCols<4>(6 * angles_).setIdentity();
    nominal_set_up_ = reported.segment<4>(6 * angles_);
    // The axis is the axis average line in any case: with the datum of home its set-up would be that of one angle.
    if (measurement.datum != Datum::axis_average_line) {
        const DatumSolution average =
            transform_to_datum(measurement, datum.errors, rigid_motion(datum.set_up), Datum::axis_average_line);
        to_average_line_.leftCols(6 * angles_) = average.stated_set_up_map();
        const auto across = across_axis(axis_);
        for (int c = 0; c < 2; ++c) {
            nominal_set_up_[c] = average.set_up[across[static_cast<std::size_t>(c)]];
            nominal_set_up_[2 + c] = average.set_up[3 + across[static_cast<std::size_t>(c)]];
        }
    }

    const auto add = [this](std::string name, std::string short_name, std::string description, bool angular) {
        outputs_.push_back({std::move(name), angular ? "rad" : "m"});
        short_names_.push_back(std::move(short_name));
        descriptions_.push_back(std::move(description));
    };
    const auto names = error_motion_names(axis_);
    for (std::size_t k = 0; k < 6; ++k) {
        add("range of " + names[k], names[k], "range of " + names[k] + " over the angles", k >= 3);
    }
    const auto lines = axis_line_names(axis_);
    const auto cross = cross_coordinates(axis_);
    for (std::size_t k = 0; k < 4; ++k) {
        const std::string coordinate(1, "xyz"[cross[k % 2]]);
        add(lines[k], lines[k],
            k < 2 ? "position of the axis average line along " + coordinate + " in the frame of the fixture"
                  : "tilt of the axis average line about " + coordinate + " in the frame of the fixture",
            k >= 2);
    }
    layout_.positioning = static_cast<Eigen::Index>(outputs_.size());
    if (!visits.empty()) {
        runs_.up.resize(measurement.angles.size());
        runs_.down.resize(measurement.angles.size());
        for (std::size_t v = 0; v < visits.size(); ++v) {
            if (gains.determined(v)) {
                auto& targets = visits[v].approach == Approach::positive ? runs_.up : runs_.down;
                targets[visits[v].angle].push_back(static_cast<Eigen::Index>(v));
            }
        }
        const auto allowed = allowed_parameters(runs_);
        for (std::size_t k = 0; k < k_positioning_parameters; ++k) {
            if (allowed[k]) {
                stated_.push_back(k);
                const std::string name(positioning_parameter_names()[k]);
                add(name, name, k_descriptions[k], true);
            }
        }
    }
    layout_.positioning_count = static_cast<Eigen::Index>(stated_.size());
}

Eigen::Vector4d TableParameters::set_up_on_average_line(const Eigen::Ref<const Eigen::VectorXd>& reported) const {
    // Linear about the nominal solution, where it is exact: noise of micrometres moves it by the product of two noises.
    return nominal_set_up_ + to_average_line_ * (reported - nominal_reported_);
}

void TableParameters::values(const Eigen::Ref<const Eigen::VectorXd>& reported,
                             const Eigen::Ref<const Eigen::VectorXd>& visit_positions,
                             Eigen::Ref<Eigen::VectorXd> result) const {
    for (Eigen::Index k = 0; k < 6; ++k) {
        double lowest = reported[k];
        double highest = reported[k];
        for (Eigen::Index i = 1; i < angles_; ++i) {
            lowest = std::min(lowest, reported[6 * i + k]);
            highest = std::max(highest, reported[6 * i + k]);
        }
        result[layout_.ranges + k] = highest - lowest;
    }
    result.segment<4>(layout_.axis_line) = engine::axis_line(axis_, set_up_on_average_line(reported));
    if (!stated_.empty()) {
        const PositioningAccuracy accuracy = evaluate_positioning(runs_, visit_positions);
        for (std::size_t k = 0; k < stated_.size(); ++k) {
            result[layout_.positioning + static_cast<Eigen::Index>(k)] = *accuracy.parameters[stated_[k]];
        }
    }
}

TableParameters::Derivatives TableParameters::derivatives(
    const Eigen::Ref<const Eigen::VectorXd>& reported, const Eigen::Ref<const Eigen::VectorXd>& visit_positions) const {
    const auto rows = static_cast<Eigen::Index>(outputs_.size());
    Derivatives result{Eigen::MatrixXd::Zero(rows, reported.size()),
                       Eigen::MatrixXd::Zero(rows, visit_positions.size())};
    for (Eigen::Index k = 0; k < 6; ++k) {
        // Strictly less and strictly greater: of two angles that tie the first one stands, in values and derivatives
        // alike.
        Eigen::Index lowest = k;
        Eigen::Index highest = k;
        for (Eigen::Index i = 1; i < angles_; ++i) {
            lowest = reported[6 * i + k] < reported[lowest] ? 6 * i + k : lowest;
            highest = reported[6 * i + k] > reported[highest] ? 6 * i + k : highest;
        }
        result.by_reported(layout_.ranges + k, highest) += 1.0;
        result.by_reported(layout_.ranges + k, lowest) -= 1.0;
    }
    result.by_reported.middleRows<4>(layout_.axis_line) =
        axis_line_derivatives(axis_, set_up_on_average_line(reported)) * to_average_line_;
    if (!stated_.empty()) {
        const Eigen::MatrixXd all = positioning_derivatives(runs_, visit_positions);
        for (std::size_t k = 0; k < stated_.size(); ++k) {
            result.by_position.row(layout_.positioning + static_cast<Eigen::Index>(k)) =
                all.row(static_cast<Eigen::Index>(stated_[k]));
        }
    }
    return result;
}

TableParameterModel::TableParameterModel(std::shared_ptr<const RotaryTableModel> table, const DatumSolution& datum)
    : table_(table), joint_(std::move(table)), gains_(visit_position_gains(joint_->solved(), joint_->stochastic())) {
    const Eigen::VectorXd reported = reported_values(joint_->solved(), datum);
    nominal_positions_ = visit_positions(joint_->solved(), reported, gains_);
    parameters_ =
        std::make_shared<TableParameters>(joint_->measurement(), datum, reported, joint_->solved().visits(), gains_);
}

TableParameterModel::TableParameterModel(std::shared_ptr<const gum::MeasurementModel> table,
                                         const RotaryTableMeasurement& measurement, const DatumSolution& datum)
    : table_(std::move(table)) {
    parameters_ = std::make_shared<TableParameters>(measurement, datum, table_->evaluate(gum::input_estimates(*table_)),
                                                    std::vector<Visit>{}, gains_);
}

Eigen::VectorXd TableParameterModel::evaluate(const Eigen::VectorXd& x) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(outputs().size()));
    if (!joint_) {
        parameters_->values(table_->evaluate(x), nominal_positions_, result);
        return result;
    }
    const JointAdjustment adjustment = joint_->solve_at(x);
    const Eigen::VectorXd reported =
        reported_values(adjustment, transform_to_datum(joint_->measurement(), adjustment.poses(), adjustment.set_up(),
                                                       joint_->measurement().datum));
    // The lengths are corrected for the deviations of the table; the position that it took has its own again.
    Eigen::VectorXd positions = visit_positions(adjustment, reported, gains_);
    for (Eigen::Index v = 0; v < positions.size(); ++v) {
        if (gains_.determined(static_cast<std::size_t>(v))) {
            positions[v] += x[joint_->layout().axial + v];
        }
    }
    parameters_->values(reported, positions, result);
    return result;
}

Eigen::MatrixXd TableParameterModel::jacobian(const Eigen::VectorXd& x) const {
    if (!joint_) {
        const TableParameters::Derivatives by = parameters_->derivatives(table_->evaluate(x), nominal_positions_);
        return by.by_reported * table_->jacobian(x);
    }
    const RotaryTableMeasurement& measurement = joint_->measurement();
    const JointAdjustment adjustment = joint_->solve_at(x);
    const NormalEquations normal = adjustment.adjustment().linearise();
    const DatumSolution datum =
        transform_to_datum(measurement, adjustment.poses(), adjustment.set_up(), measurement.datum);
    const Eigen::VectorXd reported = reported_values(adjustment, datum);
    Eigen::VectorXd positions = visit_positions(adjustment, reported, gains_);
    const Eigen::Index axial = joint_->layout().axial;
    for (Eigen::Index v = 0; v < positions.size(); ++v) {
        if (gains_.determined(static_cast<std::size_t>(v))) {
            positions[v] += x[axial + v];
        }
    }
    return by_inputs(adjustment, normal, datum, parameters_->derivatives(reported, positions));
}

Eigen::MatrixXd TableParameterModel::jacobian_of_table(const Eigen::VectorXd& reported,
                                                       const Eigen::VectorXd& positions) const {
    const JointAdjustment& solved = joint_->solved();
    const DatumSolution datum =
        transform_to_datum(joint_->measurement(), solved.poses(), solved.set_up(), joint_->measurement().datum);
    return by_inputs(solved, joint_->equations(), datum, parameters_->derivatives(reported, positions));
}

Eigen::MatrixXd TableParameterModel::jacobian_of_positions(const Eigen::MatrixXd& by_position) const {
    const JointAdjustment& solved = joint_->solved();
    const DatumSolution datum =
        transform_to_datum(joint_->measurement(), solved.poses(), solved.set_up(), joint_->measurement().datum);
    const Eigen::Index reported = reported_values(solved, datum).size();
    return by_inputs(solved, joint_->equations(), datum,
                     {Eigen::MatrixXd::Zero(by_position.rows(), reported), by_position});
}

Eigen::MatrixXd TableParameterModel::by_inputs(const JointAdjustment& adjustment, const NormalEquations& normal,
                                               const DatumSolution& datum, TableParameters::Derivatives by) const {
    const RotaryTableMeasurement& measurement = joint_->measurement();
    const std::vector<Visit>& visits = adjustment.visits();
    const Eigen::Index axial = joint_->layout().axial;
    const Eigen::Index reversal =
        6 * static_cast<Eigen::Index>(measurement.angles.size()) + 4 + 3 + axial_coordinate(measurement.axis);
    const int own_reversal = 6 + 3 + axial_coordinate(measurement.axis);  // component of a pose
    Eigen::MatrixXd by_residual = Eigen::MatrixXd::Zero(by.by_position.rows(), joint_->layout().scale);
    Eigen::MatrixXd by_reversal = Eigen::MatrixXd::Zero(by.by_position.rows(), normal.parameter_count());
    Eigen::Index first = 0;  // length
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const auto n = static_cast<Eigen::Index>(visits[v].observations.size());
        if (gains_.determined(v)) {
            const auto column = by.by_position.col(static_cast<Eigen::Index>(v));
            by.by_reported.col(axial_error(measurement.axis, static_cast<Eigen::Index>(visits[v].angle))) += column;
            const double share = reversal_share(adjustment.has_reversal(), visits[v].approach);
            if (adjustment.reversal_by_angle()) {
                // With a reversal of each angle it is a parameter of the pose, and no reported quantity.
                by_reversal.col(normal.column(adjustment.pose_block(visits[v].angle), own_reversal)) += share * column;
            } else if (adjustment.has_reversal()) {
                by.by_reported.col(reversal) += share * column;
            }
            // x_v holds the residual of its own visit: y = a·x̂ + b·(l − f(x̂)).
            by_residual.middleCols(first, n).noalias() = column * gains_.gains[v].transpose();
        }
        first += n;
    }
    const Eigen::MatrixXd by_parameter =
        reported_map(adjustment, normal, datum).combined(by.by_reported, adjustment, normal) + by_reversal;
    Eigen::MatrixXd result = joint_->input_sensitivity(adjustment, normal, by_parameter, by_residual);
    // The deviation that was taken off the lengths is in the position where the table really stood.
    result.middleCols(axial, by.by_position.cols()) += by.by_position;
    return result;
}

PositioningAccuracy TableParameterModel::positioning() const {
    return evaluate_positioning(parameters_->runs(), nominal_positions_);
}

double TableParameterModel::rms_position_uncertainty() const {
    if (!joint_) {
        return 0.0;
    }
    // With x̂ = Q J'Σ⁻¹ l, h = ∂(e ± reversal/2)/∂x̂ and w = J'g of the visit, the covariances of the inputs give
    // u²(x_v - δ_v) = h'Qh - w'Qw + 1/(a'M⁻¹a) - 2 σ² (h - w)'Q J'Σ⁻¹a, and what the dead paths add to it.
    const RotaryTableMeasurement& measurement = joint_->measurement();
    const JointAdjustment& solved = joint_->solved();
    const StochasticModel& stochastic = joint_->stochastic();
    const NormalEquations& normal = joint_->equations();
    const BorderedCovariance& covariance = joint_->parameter_covariance();
    const DatumSolution datum = transform_to_datum(measurement, solved.poses(), solved.set_up(), measurement.datum);
    // Of the poses in each sense, where they have parameters of their own.
    const bool by_angle = solved.reversal_by_angle();
    const AnglewiseMap of_errors = reported_map(solved, normal, datum);
    const AnglewiseMap map = by_angle ? map_of_both_senses(of_errors) : of_errors;
    const AnglewiseCovariance reported = covariance_of(map, solved, normal, covariance);
    const AnglewiseSensitivity sensitivity(map, solved, normal, covariance);
    const PoseCovariance poses = pose_covariance(solved, normal, covariance);
    const Eigen::Index border = covariance.border();
    const TallMatrix border_spread = sensitivity.shared().leftCols(border) * covariance.border_covariance();
    const auto angles = static_cast<Eigen::Index>(measurement.angles.size());
    const Eigen::Index axial = 3 + axial_coordinate(measurement.axis);
    const Eigen::Index reversal = 6 * angles + 4 + axial;

    const std::vector<Visit>& visits = solved.visits();
    const auto paths = static_cast<Eigen::Index>(measurement.dead_paths.size());
    Eigen::MatrixXd by_path = Eigen::MatrixXd::Zero(normal.parameter_count(), paths);  // ∂x̂/∂(dead paths)
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const LinearisedGroup& group = normal.groups()[v];
        Eigen::MatrixXd path_of = Eigen::MatrixXd::Zero(group.cholesky.rows(), paths);
        for (std::size_t k = 0; k < visits[v].observations.size(); ++k) {
            // A dead path is added to every length that was measured with it: ∂x̂/∂l0 = Q Jᵀ Σ⁻¹ 1, with 1 at these
            // lengths.
            path_of(static_cast<Eigen::Index>(k),
                    static_cast<Eigen::Index>(measurement.lengths[visits[v].observations[k]].dead_path)) = 1.0;
        }
        const Eigen::MatrixXd right =
            group.jacobian.transpose() * group.cholesky.triangularView<Eigen::Lower>().solve(path_of);
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            by_path.row(group.columns[c]) += right.row(static_cast<Eigen::Index>(c));
        }
    }
    by_path = covariance.times_left(by_path.transpose()).transpose().eval();
    const Eigen::Index size = map.pose_size();
    Eigen::MatrixXd pose_by_path = Eigen::MatrixXd::Zero(size * angles, paths);
    for (Eigen::Index i = 0; i < size * angles; ++i) {
        const auto block = solved.pose_block(static_cast<std::size_t>(i / size));
        if (const Eigen::Index column = normal.column(block, static_cast<int>(i % size)); column >= 0) {
            pose_by_path.row(i) = by_path.row(column);
        }
    }
    const Eigen::MatrixXd change_by_path = map.change * pose_by_path;

    // The dead paths are inputs here: what their uncertainty adds to a position goes through parameters and residual.
    Eigen::MatrixXd path_covariance;
    for (const gum::InputGroup& group : joint_->inputs()) {
        if (group.source == "dead path") {
            path_covariance = group.covariance;
        }
    }

    double sum = 0.0;
    double count = 0.0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        if (!gains_.determined(v)) {
            continue;
        }
        const LinearisedGroup& group = normal.groups()[v];
        const Eigen::VectorXd& g = gains_.gains[v];
        const auto angle = static_cast<Eigen::Index>(visits[v].angle);
        const Eigen::Index row =
            by_angle ? 12 * angle + (visits[v].approach == Approach::positive ? 0 : 6) + axial : 6 * angle + axial;
        // With a reversal of each angle the rows are those of a single sense: half the reversal is in them already.
        const double share = by_angle ? 0.0 : reversal_share(solved.has_reversal(), visits[v].approach);
        // h is the row of the axial rotation and a share of that of the reversal, which depends on the border only.
        const auto with_reversal = [&](const auto& rows) -> Eigen::RowVectorXd {
            return share == 0.0 ? Eigen::RowVectorXd(rows.row(row)) : rows.row(row) + share * rows.row(reversal);
        };
        double h_spread = reported(row, row);  // h'Qh
        if (share != 0.0) {
            h_spread += share * (2.0 * reported(row, reversal) + share * reported(reversal, reversal));
        }
        const Eigen::RowVectorXd by_change = with_reversal(map.by_change);
        // The whole coefficient of the pose of this angle: of its error motion itself, and of the datum that follows
        // it. The poses of other angles vary with this one through the border only, which by_border holds.
        const Eigen::RowVectorXd by_pose = map.local.row(row) + by_change * map.change.middleCols(size * angle, size);
        const Eigen::RowVectorXd by_border = with_reversal(border_spread);
        const Eigen::RowVectorXd to_pose = by_border * poses.by_border.middleRows(size * angle, size).transpose() +
                                           by_pose * poses.own.middleRows(size * angle, size);
        Eigen::RowVectorXd hq(group.columns.size());  // h'Q over the parameters of the visit
        for (std::size_t c = 0; c < group.columns.size(); ++c) {
            const Eigen::Index column = group.columns[c];
            hq[static_cast<Eigen::Index>(c)] =
                column < border ? by_border[column]
                                : to_pose[normal.parameters()[static_cast<std::size_t>(column)].component];
        }
        const Eigen::VectorXd w =
            group.jacobian.transpose() * (group.cholesky.triangularView<Eigen::Lower>().transpose() * g);
        const Eigen::MatrixXd q = covariance(group.columns, group.columns);
        const Eigen::VectorXd a = joint_->visit_pose(v).col(axial);
        const Eigen::VectorXd own =
            group.jacobian.transpose() * group.cholesky.triangularView<Eigen::Lower>().solve(a);  // J'Σ⁻¹a
        // Σ = M + σ² aa' and g'a = 1.
        const Eigen::VectorXd factored = group.cholesky.triangularView<Eigen::Lower>().transpose() * g;
        const double variance_of_gain = factored.squaredNorm() - stochastic.variance_axial;
        const Eigen::RowVectorXd difference = hq - (q * w).transpose();
        double variance =
            h_spread - w.dot(q * w) + variance_of_gain - 2.0 * stochastic.variance_axial * difference.dot(own);
        Eigen::RowVectorXd to_path = map.local.row(row) * pose_by_path.middleRows(size * angle, size);
        to_path += by_change * change_by_path + with_reversal(map.by_border) * by_path.topRows(border);
        to_path -= w.transpose() * by_path(group.columns, Eigen::all);
        for (std::size_t k = 0; k < visits[v].observations.size(); ++k) {
            to_path[static_cast<Eigen::Index>(measurement.lengths[visits[v].observations[k]].dead_path)] +=
                g[static_cast<Eigen::Index>(k)];
        }
        variance += to_path * path_covariance * to_path.transpose();
        // A difference of nearly equal numbers, which rounding may make negative.
        sum += std::max(variance, 0.0);
        count += 1.0;
    }
    return count > 0.0 ? std::sqrt(sum / count) : 0.0;
}

}  // namespace gumcert::engine
