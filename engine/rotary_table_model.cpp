#include "engine/rotary_table_model.h"

#include <algorithm>
#include <cmath>

#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

std::array<int, 6> repeatability_order(RotaryAxis axis) {
    const int a = axial_coordinate(axis);
    return {0, 1, 2, 3 + a, a == 0 ? 4 : 3, a == 2 ? 4 : 5};
}

ReportedQuantities reported_quantities(const RotaryTableMeasurement& measurement, bool has_reversal) {
    ReportedQuantities quantities;
    const auto names = error_motion_names(measurement.axis);
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        for (std::size_t k = 0; k < 6; ++k) {
            quantities.outputs.push_back({names[k] + " at angle number " + std::to_string(i + 1), k < 3 ? "m" : "rad"});
        }
    }
    quantities.set_up = static_cast<Eigen::Index>(quantities.outputs.size());
    for (const char* kind : {"O_", "S_"}) {
        for (const int c : across_axis(measurement.axis)) {
            quantities.outputs.push_back({std::string(kind) + "xyz"[c], kind[0] == 'O' ? "m" : "rad"});
        }
    }
    quantities.reversal = static_cast<Eigen::Index>(quantities.outputs.size());
    quantities.has_reversal = has_reversal;
    for (std::size_t k = 0; k < 6 && has_reversal; ++k) {
        quantities.outputs.push_back({"reversal of " + names[k], k < 3 ? "m" : "rad"});
    }
    return quantities;
}

Eigen::VectorXd reported_values(const JointAdjustment& adjustment, const DatumSolution& datum) {
    const auto across = across_axis(adjustment.measurement().axis);
    const Eigen::Index errors = datum.errors.size();
    Eigen::VectorXd values(errors + 4 + (adjustment.has_reversal() ? 6 : 0));
    values.head(errors) = datum.errors.reshaped();
    for (int c = 0; c < 2; ++c) {
        values[errors + c] = datum.set_up[across[static_cast<std::size_t>(c)]];
        values[errors + 2 + c] = datum.set_up[3 + across[static_cast<std::size_t>(c)]];
    }
    if (adjustment.has_reversal()) {
        values.tail<6>() = adjustment.adjustment().parameters(adjustment.reversal_block());
    }
    return values;
}

Eigen::MatrixXd reported_map(const JointAdjustment& adjustment, const NormalEquations& normal,
                             const DatumSolution& datum) {
    const auto angles = static_cast<Eigen::Index>(adjustment.measurement().angles.size());
    const Eigen::Index errors = 6 * angles;
    Eigen::MatrixXd map =
        Eigen::MatrixXd::Zero(errors + 4 + (adjustment.has_reversal() ? 6 : 0), normal.parameter_count());
    for (Eigen::Index i = 0; i < angles; ++i) {
        for (int c = 0; c < 6; ++c) {
            const Eigen::Index column = normal.column(adjustment.pose_block(static_cast<std::size_t>(i)), c);
            if (column >= 0) {
                map.col(column).head(errors) = datum.error_map.col(6 * i + c);
                map.col(column).segment<4>(errors) = datum.set_up_map.col(6 * i + c);
            }
        }
    }
    for (int c = 0; c < 6 && adjustment.has_reversal(); ++c) {
        map(errors + 4 + c, normal.column(adjustment.reversal_block(), c)) = 1.0;
    }
    return map;
}

RotaryTableModel::RotaryTableModel(RotaryTableMeasurement measurement, const JointAdjustment& solved,
                                   const StochasticModel& stochastic, const SourceDegreesOfFreedom& degrees_of_freedom)
    : measurement_(std::move(measurement)),
      stochastic_(stochastic),
      set_up_(solved.set_up()),
      nominal_(measurement_, solved.active(), solved.set_up(), solved.present_values(), stochastic),
      quantities_(reported_quantities(measurement_, solved.has_reversal())) {
    nominal_.copy_parameters_from(solved);
    nominal_.set_weights(stochastic);
    const NormalEquations joint = nominal_.adjustment().linearise();
    const Eigen::MatrixXd covariance = joint.covariance();
    const auto paths = static_cast<Eigen::Index>(measurement_.dead_paths.size());

    const std::vector<Visit>& visits = nominal_.visits();
    const auto visit_count = static_cast<Eigen::Index>(visits.size());
    Eigen::Index length_count = 0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        visit_pose_.push_back(nominal_.pose_jacobian(v));
        length_count += visit_pose_.back().rows();
    }
    gum::InputGroup lengths{"length noise", "length noise", "m", gum::Evaluation::type_b, "normal", {}, {}};
    lengths.evaluation =
        std::isfinite(degrees_of_freedom.length_noise) ? gum::Evaluation::type_a : gum::Evaluation::type_b;
    lengths.degrees_of_freedom = degrees_of_freedom.length_noise;
    lengths.value.resize(length_count);
    lengths.covariance.resize(length_count, 1);
    Eigen::Index row = 0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const Eigen::VectorXd variance = stochastic.length_factor * nominal_.stated_variance(v);
        for (std::size_t k = 0; k < visits[v].observations.size(); ++k, ++row) {
            lengths.value[row] = measurement_.lengths[visits[v].observations[k]].length;
            lengths.covariance(row, 0) = variance[static_cast<Eigen::Index>(k)];
        }
    }
    inputs_.push_back(std::move(lengths));

    const auto add_scalar_group = [this](std::string name, std::string source, std::string unit, Eigen::VectorXd value,
                                         Eigen::MatrixXd variance, double nu, bool estimated) {
        gum::InputGroup group;
        group.name = std::move(name);
        group.source = std::move(source);
        group.unit = std::move(unit);
        group.evaluation = estimated ? gum::Evaluation::type_a : gum::Evaluation::type_b;
        group.value = std::move(value);
        group.covariance = std::move(variance);
        group.degrees_of_freedom = nu;
        inputs_.push_back(std::move(group));
    };

    for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
        if (nominal_.scale_prior(j) != JointAdjustment::k_none) {
            scale_stations_.push_back(j);
        }
        if (nominal_.temperature_prior(j) != JointAdjustment::k_none) {
            temperature_stations_.push_back(j);
        }
    }
    if (!scale_stations_.empty()) {
        const auto n = static_cast<Eigen::Index>(scale_stations_.size());
        const double u = measurement_.length_uncertainty.u_scale;
        add_scalar_group("scale of the stations", "scale", "1", Eigen::VectorXd::Zero(n),
                         Eigen::MatrixXd::Constant(n, 1, u * u), std::numeric_limits<double>::infinity(), false);
    }

    Eigen::VectorXd path_value(paths);
    std::vector<Eigen::Index> path_columns;
    for (Eigen::Index d = 0; d < paths; ++d) {
        const auto block = nominal_.dead_path_block(static_cast<std::size_t>(d));
        path_value[d] = nominal_.adjustment().parameters(block)[0];
        path_columns.push_back(joint.column(block, 0));
    }
    // Welch-Satterthwaite for the estimated dead paths themselves; the least of them stands for the group.
    Eigen::MatrixXd path_variance = Eigen::MatrixXd::Zero(paths, 4);  // by length noise, table linear, axial, tilt
    const auto pose_order = repeatability_order(measurement_.axis);
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const LinearisedGroup& group = joint.groups()[v];
        const Eigen::MatrixXd whitened = covariance(path_columns, group.columns) * group.jacobian.transpose();
        const Eigen::MatrixXd gain =
            group.cholesky.triangularView<Eigen::Lower>().transpose().solve(whitened.transpose()).transpose();
        const Eigen::VectorXd variance = stochastic.length_factor * nominal_.stated_variance(v);
        path_variance.col(0) += gain.cwiseAbs2() * variance;
        const Eigen::MatrixXd by_pose = (gain * visit_pose_[v])(Eigen::all, pose_order).cwiseAbs2();
        path_variance.col(1) += stochastic.variance_linear * by_pose.leftCols(3).rowwise().sum();
        path_variance.col(2) += stochastic.variance_axial * by_pose.col(3);
        path_variance.col(3) += stochastic.variance_tilt * by_pose.rightCols(2).rowwise().sum();
    }
    const std::array<double, 4> component_nu{degrees_of_freedom.length_noise, degrees_of_freedom.table_linear,
                                             degrees_of_freedom.table_axial, degrees_of_freedom.table_tilt};
    double path_nu = std::numeric_limits<double>::infinity();
    for (Eigen::Index d = 0; d < paths; ++d) {
        const double total =
            covariance(path_columns[static_cast<std::size_t>(d)], path_columns[static_cast<std::size_t>(d)]);
        double sum = 0.0;
        for (Eigen::Index k = 0; k < 4; ++k) {
            sum += path_variance(d, k) * path_variance(d, k) / component_nu[static_cast<std::size_t>(k)];
        }
        path_nu = std::min(path_nu, sum > 0.0 ? total * total / sum : std::numeric_limits<double>::infinity());
    }
    add_scalar_group("dead paths", "dead path", "m", path_value, covariance(path_columns, path_columns), path_nu, true);

    Eigen::VectorXd coordinates(3 * measurement_.fixture.rows());
    for (Eigen::Index m = 0; m < measurement_.fixture.rows(); ++m) {
        coordinates.segment<3>(3 * m) = measurement_.fixture.row(m).transpose();
    }
    add_scalar_group("CMM coordinates of the fixture", "fixture CMM", "m", coordinates, measurement_.fixture_covariance,
                     std::numeric_limits<double>::infinity(), false);

    if (!temperature_stations_.empty()) {
        Eigen::VectorXd value(temperature_stations_.size());
        Eigen::MatrixXd variance(temperature_stations_.size(), 1);
        for (std::size_t k = 0; k < temperature_stations_.size(); ++k) {
            const auto j = static_cast<Eigen::Index>(temperature_stations_[k]);
            value[static_cast<Eigen::Index>(k)] = measurement_.temperature_difference[j];
            variance(static_cast<Eigen::Index>(k), 0) = std::pow(measurement_.u_temperature[j], 2);
        }
        add_scalar_group("temperature of the fixture", "fixture thermal", "K", value, variance,
                         std::numeric_limits<double>::infinity(), false);
    }
    expansion_is_input_ = nominal_.expansion_prior() != JointAdjustment::k_none;
    if (expansion_is_input_) {
        add_scalar_group("expansion coefficient of the fixture", "fixture thermal", "1/K",
                         Eigen::VectorXd::Constant(1, measurement_.expansion),
                         Eigen::MatrixXd::Constant(1, 1, std::pow(measurement_.u_expansion, 2)),
                         std::numeric_limits<double>::infinity(), false);
    }
    const auto add_table = [&](const char* name, const char* unit, Eigen::Index per_visit, double variance, double nu) {
        add_scalar_group(name, "table repeatability", unit, Eigen::VectorXd::Zero(per_visit * visit_count),
                         Eigen::MatrixXd::Constant(per_visit * visit_count, 1, variance), nu, std::isfinite(nu));
    };
    add_table("table repeatability, linear", "m", 3, stochastic.variance_linear, degrees_of_freedom.table_linear);
    add_table("table repeatability, axial", "rad", 1, stochastic.variance_axial, degrees_of_freedom.table_axial);
    add_table("table repeatability, tilt", "rad", 2, stochastic.variance_tilt, degrees_of_freedom.table_tilt);
    for (std::size_t d = 0; d < measurement_.dead_paths.size(); ++d) {
        nominal_.adjustment().hold(nominal_.dead_path_block(d), 0);
    }
}

JointAdjustment RotaryTableModel::solve_at(const Eigen::VectorXd& x) const {
    JointAdjustment adjustment = nominal_;
    Adjustment& least_squares = adjustment.adjustment();
    const std::vector<Visit>& visits = adjustment.visits();
    Eigen::Index next = 0;
    std::vector<Eigen::VectorXd> observed;
    for (const Visit& visit : visits) {
        const auto n = static_cast<Eigen::Index>(visit.observations.size());
        observed.emplace_back(x.segment(next, n));
        next += n;
    }
    for (const std::size_t station : scale_stations_) {
        least_squares.set_observed(adjustment.scale_prior(station), x.segment(next++, 1));
    }
    for (std::size_t d = 0; d < measurement_.dead_paths.size(); ++d) {
        least_squares.set_parameters(adjustment.dead_path_block(d), x.segment(next++, 1));
    }
    least_squares.set_observed(adjustment.fixture_prior(), x.segment(next, 3 * measurement_.fixture.rows()));
    next += 3 * measurement_.fixture.rows();
    for (const std::size_t station : temperature_stations_) {
        least_squares.set_observed(adjustment.temperature_prior(station), x.segment(next++, 1));
    }
    if (expansion_is_input_) {
        least_squares.set_observed(adjustment.expansion_prior(), x.segment(next++, 1));
    }
    const auto visit_count = static_cast<Eigen::Index>(visits.size());
    const auto order = repeatability_order(measurement_.axis);
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const auto at = static_cast<Eigen::Index>(v);
        Eigen::Matrix<double, 6, 1> deviation;
        for (int c = 0; c < 3; ++c) {
            deviation[order[static_cast<std::size_t>(c)]] = x[next + 3 * at + c];
        }
        deviation[order[3]] = x[next + 3 * visit_count + at];
        for (int c = 0; c < 2; ++c) {
            deviation[order[static_cast<std::size_t>(4 + c)]] = x[next + 4 * visit_count + 2 * at + c];
        }
        least_squares.set_observed(v, observed[v] - visit_pose_[v] * deviation);
    }
    const SolveSummary summary = least_squares.refine(SolverOptions{});
    if (!summary.converged) {
        throw gum::NoResultError(gum::Diagnostic{"GC-ADJUST-0006", "rotary table model",
                                                 "the adjustment did not converge (" + summary.message + ")",
                                                 "a value of the model is the minimum of the weighted squares",
                                                 "keep the inputs within their uncertainties", gum::Severity::error});
    }
    return adjustment;
}

Eigen::VectorXd RotaryTableModel::evaluate(const Eigen::VectorXd& x) const {
    const JointAdjustment adjustment = solve_at(x);
    return reported_values(adjustment,
                           transform_to_datum(measurement_, adjustment.poses(), set_up_, measurement_.datum));
}

Eigen::MatrixXd RotaryTableModel::jacobian(const Eigen::VectorXd& x) const {
    const JointAdjustment adjustment = solve_at(x);
    const NormalEquations normal = adjustment.adjustment().linearise();
    const Eigen::MatrixXd covariance = normal.covariance();
    const DatumSolution datum = transform_to_datum(measurement_, adjustment.poses(), set_up_, measurement_.datum);
    const Eigen::MatrixXd gain = reported_map(adjustment, normal, datum) * covariance;  // m×p

    // ∂y/∂l of one group: gain J̃ᵀ L⁻¹ over the columns of the group.
    const auto sensitivity = [&](std::size_t group_index) -> Eigen::MatrixXd {
        const LinearisedGroup& group = normal.groups()[group_index];
        const Eigen::MatrixXd whitened = gain(Eigen::all, group.columns) * group.jacobian.transpose();
        return group.cholesky.triangularView<Eigen::Lower>().transpose().solve(whitened.transpose()).transpose();
    };

    Eigen::Index size = 0;
    for (const gum::InputGroup& group : inputs_) {
        size += group.size();
    }
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(gain.rows(), size);
    const std::vector<Visit>& visits = adjustment.visits();
    const auto visit_count = static_cast<Eigen::Index>(visits.size());
    const auto order = repeatability_order(measurement_.axis);
    const Eigen::Index table = size - 6 * visit_count;
    const Eigen::Index paths = inputs_[0].size() + static_cast<Eigen::Index>(scale_stations_.size());
    Eigen::Index next = 0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const Eigen::MatrixXd to_lengths = sensitivity(v);
        const auto at = static_cast<Eigen::Index>(v);
        result.middleCols(next, to_lengths.cols()) = to_lengths;
        for (std::size_t k = 0; k < visits[v].observations.size(); ++k) {
            // l + l0 = s |P - q|: a longer dead path acts as a longer length.
            const auto path = static_cast<Eigen::Index>(measurement_.lengths[visits[v].observations[k]].dead_path);
            result.col(paths + path) += to_lengths.col(static_cast<Eigen::Index>(k));
        }
        next += to_lengths.cols();
        const Eigen::MatrixXd to_pose = -to_lengths * visit_pose_[v];
        for (int c = 0; c < 3; ++c) {
            result.col(table + 3 * at + c) = to_pose.col(order[static_cast<std::size_t>(c)]);
        }
        result.col(table + 3 * visit_count + at) = to_pose.col(order[3]);
        for (int c = 0; c < 2; ++c) {
            result.col(table + 4 * visit_count + 2 * at + c) = to_pose.col(order[static_cast<std::size_t>(4 + c)]);
        }
    }
    for (const std::size_t station : scale_stations_) {
        result.col(next++) = sensitivity(adjustment.scale_prior(station));
    }
    next += static_cast<Eigen::Index>(measurement_.dead_paths.size());
    const Eigen::MatrixXd to_fixture = sensitivity(adjustment.fixture_prior());
    result.middleCols(next, to_fixture.cols()) = to_fixture;
    next += to_fixture.cols();
    for (const std::size_t station : temperature_stations_) {
        result.col(next++) = sensitivity(adjustment.temperature_prior(station));
    }
    if (expansion_is_input_) {
        result.col(next++) = sensitivity(adjustment.expansion_prior());
    }
    return result;
}

}  // namespace gumcert::engine
