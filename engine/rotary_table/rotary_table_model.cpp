#include "engine/rotary_table/rotary_table_model.h"

#include <algorithm>
#include <cmath>

#include "engine/rotary_table/anglewise_map.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::engine {

// The estimate by an adjustment, seen as a function of its inputs: y(l, …) = datum(x̂(l, …)). Everything that the
// adjustment weighs is an input: a length, and the stated value of each prior as well.
// ∂x̂/∂l = N⁻¹ Jᵀ V⁻¹ with N = Jᵀ V⁻¹ J, at weights that are held: that the weights come from the same residuals shows
// in the degrees of freedom, not in the coefficients.
// Two sets of normal equations: those with free dead paths first, from which the covariance of the dead paths comes;
// then the dead paths are held, and all coefficients are those of the estimator that knows them (rotary_table_model.h
// says why).

namespace {

/// Let Monte Carlo draw uncorrelated quantities between limits; their standard uncertainties stay as they are.
void make_uniform(gum::InputGroup& group) {
    if (group.covariance.cols() != 1) {
        if (!group.covariance.isDiagonal(0.0)) {
            return;  // no uniform quantities with a stated correlation
        }
        group.covariance = Eigen::MatrixXd(group.covariance.diagonal());
    }
    group.distribution = "uniform";
    group.marginals.clear();
    for (Eigen::Index i = 0; i < group.size(); ++i) {
        // u = a/√3 (JCGM 100:2008, 4.3.7), the other way round: the stated u stays what it is.
        const double half_width = std::sqrt(3.0 * group.covariance(i, 0));
        group.marginals.push_back(half_width > 0.0 ? gum::Distribution::uniform(group.value[i], half_width)
                                                   : gum::Distribution::constant(group.value[i]));
    }
}

}  // namespace

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
    // Across the axis only: an offset along it and a turn about it are taken up by the origin and the zero of the axis
    // (design note rotary-table.md, 4a).
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

Eigen::VectorXd reported_order(const RotaryTableMeasurement& measurement, const Eigen::MatrixXd& errors,
                               const Eigen::Matrix<double, 6, 1>& set_up, const Eigen::Matrix<double, 6, 1>* reversal) {
    const auto across = across_axis(measurement.axis);
    const Eigen::Index size = errors.size();
    Eigen::VectorXd values(size + 4 + (reversal != nullptr ? 6 : 0));
    values.head(size) = errors.reshaped();
    for (int c = 0; c < 2; ++c) {
        values[size + c] = set_up[across[static_cast<std::size_t>(c)]];
        values[size + 2 + c] = set_up[3 + across[static_cast<std::size_t>(c)]];
    }
    if (reversal != nullptr) {
        values.tail<6>() = *reversal;
    }
    return values;
}

Eigen::VectorXd reported_values(const JointAdjustment& adjustment, const DatumSolution& datum) {
    if (!adjustment.has_reversal()) {
        return reported_order(adjustment.measurement(), datum.errors, datum.set_up, nullptr);
    }
    const Eigen::Matrix<double, 6, 1> reversal = adjustment.mean_reversal();
    return reported_order(adjustment.measurement(), datum.errors, datum.set_up, &reversal);
}

double sensitivity_coefficient_count(const RotaryTableMeasurement& measurement) {
    std::vector<std::array<bool, 2>> senses(measurement.stations.size(), {false, false});
    for (const LengthObservation& length : measurement.lengths) {
        senses[length.station][length.approach == Approach::positive ? 0 : 1] = true;
    }
    const bool has_reversal = std::all_of(senses.begin(), senses.end(), [](const auto& s) { return s[0] && s[1]; });
    const auto lengths = static_cast<double>(measurement.lengths.size());
    const auto visits =
        static_cast<double>(visits_of(measurement, std::vector<bool>(measurement.lengths.size(), true)).size());
    const auto stations = static_cast<double>(measurement.stations.size());
    const LengthUncertainty& u = measurement.length_uncertainty;
    // Counted from the measurement alone: a job that is too large is refused before anything is solved.
    const double inputs = (u.resolution > 0.0 ? 2.0 : 1.0) * lengths + 6.0 * visits +
                          (u.scale_model == ScaleModel::prior ? stations : 0.0) +
                          static_cast<double>(measurement.dead_paths.size()) +
                          3.0 * static_cast<double>(measurement.fixture.rows()) +
                          static_cast<double>((measurement.u_temperature.array() > 0.0).count()) +
                          (measurement.u_expansion > 0.0 ? 1.0 : 0.0);
    const double outputs = 6.0 * static_cast<double>(measurement.angles.size()) + 4.0 + (has_reversal ? 6.0 : 0.0);
    return outputs * inputs;
}

void require_evaluable_size(const RotaryTableMeasurement& measurement) {
    const double count = sensitivity_coefficient_count(measurement);
    if (count <= k_most_sensitivity_coefficients) {
        return;
    }
    const auto angles = static_cast<double>(measurement.angles.size());
    const auto millions = [](double number) { return std::to_string(std::llround(number / 1e6)) + " million"; };
    // Both sizes of the matrix are proportional to the angles.
    const auto possible = static_cast<long long>(angles * std::sqrt(k_most_sensitivity_coefficients / count));
    throw gum::NoResultError(gum::Diagnostic{
        "GC-ADJUST-0008", "law of propagation",
        std::to_string(measurement.angles.size()) + " angles with " + std::to_string(measurement.lengths.size()) +
            " distances have " + millions(count) + " sensitivity coefficients",
        "an evaluation holds at most " + millions(k_most_sensitivity_coefficients) +
            " of them; they grow with the square of the angles",
        "evaluate fewer angles a job, about " + std::to_string(possible) + " with these stations and reflectors",
        gum::Severity::error});
}

RotaryTableModel::RotaryTableModel(RotaryTableMeasurement measurement, const JointAdjustment& solved,
                                   const StochasticModel& stochastic, const SourceDegreesOfFreedom& degrees_of_freedom)
    : measurement_(std::move(measurement)),
      stochastic_(stochastic),
      set_up_(solved.set_up()),
      nominal_(measurement_, solved.active(), solved.set_up(), solved.present_values(), stochastic),
      quantities_(reported_quantities(measurement_, solved.has_reversal())) {
    // A model of its own, with a copy of the adjustment: what is held here must not change the solution of the caller.
    nominal_.copy_parameters_from(solved);
    nominal_.set_weights(stochastic);
    nominal_.adjustment().set_workers(solved.adjustment().workers());
    const NormalEquations joint = nominal_.adjustment().linearise();
    const BorderedCovariance covariance = joint.bordered_covariance();
    const auto paths = static_cast<Eigen::Index>(measurement_.dead_paths.size());

    const std::vector<Visit>& visits = nominal_.visits();
    const auto visit_count = static_cast<Eigen::Index>(visits.size());
    Eigen::Index length_count = 0;
    for (std::size_t v = 0; v < visits.size(); ++v) {
        visit_pose_.push_back(nominal_.repeatability_jacobian(v));
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
    const auto input_count = [this] {
        Eigen::Index count = 0;
        for (const gum::InputGroup& group : inputs_) {
            count += group.size();
        }
        return count;
    };

    for (std::size_t j = 0; j < measurement_.stations.size(); ++j) {
        if (nominal_.scale_prior(j) != JointAdjustment::k_none) {
            scale_stations_.push_back(j);
        }
        if (nominal_.temperature_prior(j) != JointAdjustment::k_none) {
            temperature_stations_.push_back(j);
        }
    }
    layout_.scale = input_count();
    if (!scale_stations_.empty()) {
        const auto n = static_cast<Eigen::Index>(scale_stations_.size());
        const double u = measurement_.length_uncertainty.u_scale;
        add_scalar_group("scale of the stations", "scale", "1", Eigen::VectorXd::Zero(n),
                         Eigen::MatrixXd::Constant(n, 1, u * u), std::numeric_limits<double>::infinity(), false);
    }

    // Dead paths are inputs with the covariance that the adjustment finds, beside an estimator that regards them as
    // known. The two parts add up exactly to the covariance of the joint adjustment. As unknowns without prior
    // knowledge they would have a row of zero in the budget, and their cost would be hidden (ADR 0007).
    Eigen::VectorXd path_value(paths);
    std::vector<Eigen::Index> path_columns;
    for (Eigen::Index d = 0; d < paths; ++d) {
        const auto block = nominal_.dead_path_block(static_cast<std::size_t>(d));
        path_value[d] = nominal_.adjustment().parameters(block)[0];
        path_columns.push_back(joint.column(block, 0));
    }
    // Welch-Satterthwaite for the estimated dead paths themselves; the least of them stands for the group.
    // Squares of the derivatives times the variances, component by component: the sources are independent of each
    // other.
    Eigen::MatrixXd path_variance = Eigen::MatrixXd::Zero(paths, 5);  // by length noise, table linear, axial, tilt, CMM
    const auto pose_order = repeatability_order(measurement_.axis);
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const LinearisedGroup& group = joint.groups()[v];
        // Rows of the dead paths in N⁻¹ Jᵀ V⁻¹ = N⁻¹ J̃ᵀ L⁻¹ with J̃ = L⁻¹ J, V = L Lᵀ: how each length of the visit
        // moves them.
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
    const LinearisedGroup& prior = joint.groups()[nominal_.fixture_prior()];
    // The prior is whitened by its own covariance: the sum of squares is the variance.
    path_variance.col(4) =
        (covariance(path_columns, prior.columns) * prior.jacobian.transpose()).rowwise().squaredNorm();
    const std::array<double, 5> component_nu{degrees_of_freedom.length_noise, degrees_of_freedom.table_linear,
                                             degrees_of_freedom.table_axial, degrees_of_freedom.table_tilt,
                                             degrees_of_freedom.fixture};
    double path_nu = std::numeric_limits<double>::infinity();
    for (Eigen::Index d = 0; d < paths; ++d) {
        const double total =
            covariance(path_columns[static_cast<std::size_t>(d)], path_columns[static_cast<std::size_t>(d)]);
        double sum = 0.0;
        for (Eigen::Index k = 0; k < path_variance.cols(); ++k) {
            // ν_eff = u⁴ / Σ u_k⁴/ν_k over the components that were estimated.
            sum += path_variance(d, k) * path_variance(d, k) / component_nu[static_cast<std::size_t>(k)];
        }
        // A single number of degrees of freedom for a correlated group: the least one promises nothing too much.
        path_nu = std::min(path_nu, sum > 0.0 ? total * total / sum : std::numeric_limits<double>::infinity());
    }
    layout_.dead_paths = input_count();
    add_scalar_group("dead paths", "dead path", "m", path_value, covariance(path_columns, path_columns), path_nu, true);

    Eigen::VectorXd coordinates(3 * measurement_.fixture.rows());
    for (Eigen::Index m = 0; m < measurement_.fixture.rows(); ++m) {
        // The coordinates as the CMM measured them, not those of the solution: an input is what was observed.
        coordinates.segment<3>(3 * m) = measurement_.fixture.row(m).transpose();
    }
    layout_.fixture = input_count();
    add_scalar_group("CMM coordinates of the fixture", "fixture CMM", "m", coordinates,
                     stochastic.fixture_factor * measurement_.fixture_covariance, degrees_of_freedom.fixture,
                     std::isfinite(degrees_of_freedom.fixture));
    if (measurement_.fixture_shape == InputShape::uniform) {
        make_uniform(inputs_.back());
    }

    layout_.temperature = input_count();
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
        if (measurement_.temperature_shape == InputShape::uniform) {
            make_uniform(inputs_.back());
        }
    }
    layout_.expansion = input_count();
    expansion_is_input_ = nominal_.expansion_prior() != JointAdjustment::k_none;
    if (expansion_is_input_) {
        add_scalar_group("expansion coefficient of the fixture", "fixture thermal", "1/K",
                         Eigen::VectorXd::Constant(1, measurement_.expansion),
                         Eigen::MatrixXd::Constant(1, 1, std::pow(measurement_.u_expansion, 2)),
                         std::numeric_limits<double>::infinity(), false);
        if (measurement_.expansion_shape == InputShape::uniform) {
            make_uniform(inputs_.back());
        }
    }
    layout_.linear = input_count();
    layout_.axial = layout_.linear + 3 * visit_count;
    layout_.tilt = layout_.axial + visit_count;
    // Deviations with the estimate 0: they are inputs because they have an uncertainty, not because they change the
    // value.
    const auto add_table = [&](const char* name, const char* unit, Eigen::Index per_visit, double variance, double nu) {
        add_scalar_group(name, "table repeatability", unit, Eigen::VectorXd::Zero(per_visit * visit_count),
                         Eigen::MatrixXd::Constant(per_visit * visit_count, 1, variance), nu, std::isfinite(nu));
    };
    add_table("table repeatability, linear", "m", 3, stochastic.variance_linear, degrees_of_freedom.table_linear);
    add_table("table repeatability, axial", "rad", 1, stochastic.variance_axial, degrees_of_freedom.table_axial);
    add_table("table repeatability, tilt", "rad", 2, stochastic.variance_tilt, degrees_of_freedom.table_tilt);
    layout_.resolution = input_count();
    // Beside the noise and not in it: its variance is known, has no degrees of freedom, and is not estimated.
    if (const double step = measurement_.length_uncertainty.resolution; step > 0.0) {
        add_scalar_group("resolution of the lengths", "length noise", "m", Eigen::VectorXd::Zero(length_count),
                         Eigen::MatrixXd::Constant(length_count, 1, step * step / 12.0),
                         std::numeric_limits<double>::infinity(), false);
        make_uniform(inputs_.back());
    }
    layout_.size = input_count();
    for (std::size_t d = 0; d < measurement_.dead_paths.size(); ++d) {
        // As inputs they are held in the equations and varied from outside (ADR 0007).
        nominal_.adjustment().hold(nominal_.dead_path_block(d), 0);
    }
    equations_ = nominal_.adjustment().linearise();
    parameter_covariance_ = equations_.bordered_covariance();
}

JointAdjustment RotaryTableModel::solve_at(const Eigen::VectorXd& x) const {
    JointAdjustment adjustment = nominal_;
    Adjustment& least_squares = adjustment.adjustment();
    const std::vector<Visit>& visits = adjustment.visits();
    Eigen::Index next = layout_.scale;
    for (const std::size_t station : scale_stations_) {
        least_squares.set_observed(adjustment.scale_prior(station), x.segment(next++, 1));
    }
    for (std::size_t d = 0; d < measurement_.dead_paths.size(); ++d) {
        least_squares.set_parameters(adjustment.dead_path_block(d), x.segment(next++, 1));
    }
    least_squares.set_observed(adjustment.fixture_prior(), x.segment(next, 3 * measurement_.fixture.rows()));
    next = layout_.temperature;
    for (const std::size_t station : temperature_stations_) {
        least_squares.set_observed(adjustment.temperature_prior(station), x.segment(next++, 1));
    }
    if (expansion_is_input_) {
        least_squares.set_observed(adjustment.expansion_prior(), x.segment(layout_.expansion, 1));
    }
    const bool has_resolution = layout_.resolution < layout_.size;
    const auto order = repeatability_order(measurement_.axis);
    Eigen::Index first = 0;  // length
    for (std::size_t v = 0; v < visits.size(); ++v) {
        const auto at = static_cast<Eigen::Index>(v);
        Eigen::Matrix<double, 6, 1> deviation;
        for (int c = 0; c < 3; ++c) {
            deviation[order[static_cast<std::size_t>(c)]] = x[layout_.linear + 3 * at + c];
        }
        deviation[order[3]] = x[layout_.axial + at];
        for (int c = 0; c < 2; ++c) {
            deviation[order[static_cast<std::size_t>(4 + c)]] = x[layout_.tilt + 2 * at + c];
        }
        const Eigen::Index n = visit_pose_[v].rows();
        // A table that deviates by δ shows lengths that are longer by A δ: taken off, they are those of the pose that
        // is asked for.
        Eigen::VectorXd observed = x.segment(first, n) - visit_pose_[v] * deviation;
        if (has_resolution) {
            observed += x.segment(layout_.resolution + first, n);
        }
        least_squares.set_observed(v, std::move(observed));
        first += n;
    }
    // From the solution on, without a trust region: the inputs move by their uncertainties, and the minimum with them.
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
    const DatumSolution datum = transform_to_datum(measurement_, adjustment.poses(), set_up_, measurement_.datum);
    const AnglewiseMap map = reported_map(adjustment, normal, datum);
    const Eigen::MatrixXd all = Eigen::MatrixXd::Identity(map.rows(), map.rows());
    return input_sensitivity(adjustment, normal, map.combined(all, adjustment, normal), Eigen::MatrixXd(map.rows(), 0));
}

Eigen::MatrixXd RotaryTableModel::input_sensitivity(const JointAdjustment& adjustment, const NormalEquations& normal,
                                                    const Eigen::Ref<const Eigen::MatrixXd>& by_parameter,
                                                    const Eigen::Ref<const Eigen::MatrixXd>& by_residual) const {
    const std::vector<Visit>& visits = adjustment.visits();
    const bool has_residual = by_residual.cols() > 0;

    // y = a·x̂ + b·(l - f(x̂)): dy/dl = (a - b J) ∂x̂/∂l + b.
    Eigen::MatrixXd gain;  // (a - b J)(Jᵀ V⁻¹ J)⁻¹, k×p
    if (has_residual) {
        Eigen::MatrixXd combined = by_parameter;
        Eigen::Index first = 0;
        for (std::size_t v = 0; v < visits.size(); ++v) {
            const LinearisedGroup& group = normal.groups()[v];
            const Eigen::Index n = group.cholesky.rows();
            const Eigen::MatrixXd predicted =
                by_residual.middleCols(first, n) * (group.cholesky.triangularView<Eigen::Lower>() * group.jacobian);
            for (std::size_t c = 0; c < group.columns.size(); ++c) {
                combined.col(group.columns[c]) -= predicted.col(static_cast<Eigen::Index>(c));
            }
            first += n;
        }
        gain = normal.bordered_covariance().times_left(combined);
    } else {
        // The rows of the outputs go through the normal equations, not the columns of the inputs, which are more.
        gain = normal.bordered_covariance().times_left(by_parameter);
    }

    // ∂y/∂l of one group through x̂: gain J̃ᵀ L⁻¹ over the columns of the group.
    const auto sensitivity = [&](std::size_t group_index) -> Eigen::MatrixXd {
        const LinearisedGroup& group = normal.groups()[group_index];
        const Eigen::MatrixXd whitened = gain(Eigen::all, group.columns) * group.jacobian.transpose();
        return group.cholesky.triangularView<Eigen::Lower>().transpose().solve(whitened.transpose()).transpose();
    };

    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(gain.rows(), layout_.size);
    const auto order = repeatability_order(measurement_.axis);
    Eigen::Index first = 0;  // length
    for (std::size_t v = 0; v < visits.size(); ++v) {
        Eigen::MatrixXd to_lengths = sensitivity(v);
        const auto at = static_cast<Eigen::Index>(v);
        if (has_residual) {
            to_lengths += by_residual.middleCols(first, to_lengths.cols());
        }
        result.middleCols(first, to_lengths.cols()) = to_lengths;
        for (std::size_t k = 0; k < visits[v].observations.size(); ++k) {
            // l + l0 = s |P - q|: a longer dead path acts as a longer length.
            const auto path = static_cast<Eigen::Index>(measurement_.lengths[visits[v].observations[k]].dead_path);
            result.col(layout_.dead_paths + path) += to_lengths.col(static_cast<Eigen::Index>(k));
        }
        first += to_lengths.cols();
        // The lengths are corrected by −A δ: so δ acts through them with the opposite sign.
        const Eigen::MatrixXd to_pose = -to_lengths * visit_pose_[v];
        for (int c = 0; c < 3; ++c) {
            result.col(layout_.linear + 3 * at + c) = to_pose.col(order[static_cast<std::size_t>(c)]);
        }
        result.col(layout_.axial + at) = to_pose.col(order[3]);
        for (int c = 0; c < 2; ++c) {
            result.col(layout_.tilt + 2 * at + c) = to_pose.col(order[static_cast<std::size_t>(4 + c)]);
        }
    }
    if (layout_.resolution < layout_.size) {
        // A part of a step is added to a length: the same coefficients.
        result.middleCols(layout_.resolution, first) = result.leftCols(first);
    }
    Eigen::Index next = layout_.scale;
    for (const std::size_t station : scale_stations_) {
        result.col(next++) = sensitivity(adjustment.scale_prior(station));
    }
    result.middleCols(layout_.fixture, 3 * measurement_.fixture.rows()) = sensitivity(adjustment.fixture_prior());
    next = layout_.temperature;
    for (const std::size_t station : temperature_stations_) {
        result.col(next++) = sensitivity(adjustment.temperature_prior(station));
    }
    if (expansion_is_input_) {
        result.col(layout_.expansion) = sensitivity(adjustment.expansion_prior());
    }
    return result;
}

}  // namespace gumcert::engine
