#include "engine/rotary_table/trials/rotary_table_trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "engine/rotary_table/trials/trial_batch.h"
#include "engine/rotary_table/trials/trial_datum.h"
#include "engine/rotary_table/trials/trial_kinematics.h"
#include "engine/rotary_table/trials/trial_lanes.h"
#include "engine/rotary_table/trials/trial_network.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/special_values.h"

namespace gumcert::engine {

// A trial is the whole measurement once more: drawn data, exact kinematics, minimum, datum, derived quantities.
// Data are kept as differences from the solution: residual there plus what was drawn. Deviations are fractions of a
// micrometre, lengths are metres: a difference that is formed after the drawing would have lost nearly half of its
// digits.
// Sixteen trials go through each step together, one a lane of wide registers. Lanes never meet: no sum goes across
// them, and one that has converged is left as it is. So a trial has the same bits wherever it stands.

namespace {

using Index = Eigen::Index;

/// Drawn lengths of one visit against those of the solution: residual there + noise + resolution - A δ.
GUMCERT_WIDE_CLONES
void draw_visit(const TrialNetwork& network, const TrialNetwork::VisitPlan& visit, const Lanes* deviation,
                TrialBatch& batch) {
    multiply_add(&network.to_length[visit.to_length], visit.count, 6, deviation,
                 &batch.residual_start[static_cast<std::size_t>(visit.first)]);
}

/// Rows first … first + count of one input; lanes without a row repeat the last one.
void load(const Eigen::Ref<const Eigen::MatrixXd>& x, Index column, Index first, Index count, Lanes& to) {
    const double* from = x.data() + column * x.outerStride() + first;
    std::copy_n(from, count, to.at.begin());
    // Spare lanes repeat an ordinary trial: nothing special can happen in them, and nothing of them is written.
    std::fill(to.at.begin() + count, to.at.end(), from[count - 1]);
}

Lanes variance_factor(const Eigen::Ref<const Eigen::MatrixXd>& x, Index column, Index first, Index count) {
    Lanes factor;
    fill(factor, 1.0);
    if (column >= 0) {
        load(x, column, first, count, factor);
        for (double& lane : factor.at) {
            // A normal deviation over √(χ²_ν/ν) is t with ν degrees of freedom.
            lane = 1.0 / std::sqrt(lane);
        }
    }
    return factor;
}

/// sum += factor × deviation
GUMCERT_WIDE_CLONES
void add_product(const Lanes& factor, const Lanes& deviation, Lanes& sum) {
#pragma GCC ivdep
    for (int t = 0; t < k_lanes; ++t) {
        sum[t] += factor[t] * deviation[t];
    }
}

JointAdjustment with_free_dead_paths(const RotaryTableModel& model) {
    const JointAdjustment& solved = model.solved();
    JointAdjustment joint(model.measurement(), solved.active(), solved.set_up(), solved.present_values(),
                          model.stochastic());
    joint.copy_parameters_from(solved);
    joint.set_weights(model.stochastic());
    return joint;
}

// The degrees of freedom stand in the groups of the model for the law of propagation: both methods take the same.
SourceDegreesOfFreedom degrees_of_freedom_of(const RotaryTableModel& model) {
    SourceDegreesOfFreedom nu{gum::k_infinity, gum::k_infinity, gum::k_infinity, gum::k_infinity, gum::k_infinity};
    const auto take = [&](const char* name, double& to) {
        for (const gum::InputGroup& group : model.inputs()) {
            if (group.name == name) {
                to = group.degrees_of_freedom;
            }
        }
    };
    take("length noise", nu.length_noise);
    take("table repeatability, linear", nu.table_linear);
    take("table repeatability, axial", nu.table_axial);
    take("table repeatability, tilt", nu.table_tilt);
    take("CMM coordinates of the fixture", nu.fixture);
    return nu;
}

/// A component of the reversal, or of the mean of those of all angles.
Lanes mean_reversal(const TrialNetwork& network, const TrialBatch& batch, Index component) {
    const Index count = network.reversal_by_angle ? network.angles : 1;
    Lanes sum;
    fill(sum, 0.0);
    for (Index i = 0; i < count; ++i) {
        const Index slot = network.reversal_of(i) + component;
        const Lanes& change = batch.delta[static_cast<std::size_t>(slot)];
        for (int t = 0; t < k_lanes; ++t) {
            sum[t] += change[t] + network.nominal_at(slot);
        }
    }
    for (double& lane : sum.at) {
        lane /= static_cast<double>(count);
    }
    return sum;
}

}  // namespace

RotaryTableTrials::RotaryTableTrials(const RotaryTableModel& model, TrialExtras extras)
    : RotaryTableTrials(with_free_dead_paths(model), model.stochastic(), degrees_of_freedom_of(model),
                        std::move(extras)) {}

RotaryTableTrials::RotaryTableTrials(const JointAdjustment& solved, const StochasticModel& stochastic,
                                     const SourceDegreesOfFreedom& degrees_of_freedom, TrialExtras extras)
    : extras_(std::move(extras)), quantities_(reported_quantities(solved.measurement(), solved.has_reversal())) {
    // The weights stay; the parameters go to the very minimum that belongs to them.
    JointAdjustment nominal = solved;
    const SolveSummary summary = nominal.adjustment().refine(SolverOptions{});
    if (!summary.converged) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0006", "rotary table trials", "the adjustment did not converge (" + summary.message + ")",
            "trials begin at the minimum of the weighted squares", "solve the adjustment first", gum::Severity::error});
    }
    outputs_ = quantities_.outputs;
    if (extras_.derived) {
        const std::vector<gum::OutputQuantity>& derived = extras_.derived->outputs();
        outputs_.insert(outputs_.end(), derived.begin(), derived.end());
    }
    add_inputs(nominal, stochastic, degrees_of_freedom);
    network_ = std::make_unique<const TrialNetwork>(nominal, stochastic, extras_.derived != nullptr);
    datum_ = std::make_unique<const TrialDatum>(nominal);
}

RotaryTableTrials::~RotaryTableTrials() = default;

void RotaryTableTrials::add_inputs(const JointAdjustment& solved, const StochasticModel& stochastic,
                                   const SourceDegreesOfFreedom& degrees_of_freedom) {
    const RotaryTableMeasurement& measurement = solved.measurement();
    const auto visits = static_cast<Index>(solved.visits().size());
    Index size = 0;
    const auto add = [&](gum::InputGroup group) {
        const Index first = size;
        size += group.size();
        inputs_.push_back(std::move(group));
        return first;
    };
    const auto group_of = [](const char* name, const char* source, const char* unit, Eigen::VectorXd value,
                             Eigen::MatrixXd covariance, double nu) {
        gum::InputGroup group;
        group.name = name;
        group.source = source;
        group.unit = unit;
        group.evaluation = std::isfinite(nu) ? gum::Evaluation::type_a : gum::Evaluation::type_b;
        group.value = std::move(value);
        group.covariance = std::move(covariance);
        group.degrees_of_freedom = nu;
        return group;
    };
    const auto make_uniform = [](gum::InputGroup& group) {
        group.distribution = "uniform";
        for (Index i = 0; i < group.size(); ++i) {
            const double variance = group.covariance.cols() == 1 ? group.covariance(i, 0) : group.covariance(i, i);
            group.marginals.push_back(gum::Distribution::uniform(group.value[i], std::sqrt(3.0 * variance)));
        }
    };

    Index lengths = 0;
    for (const Visit& visit : solved.visits()) {
        lengths += static_cast<Index>(visit.observations.size());
    }
    Eigen::VectorXd variance(lengths);
    Index row = 0;
    for (std::size_t v = 0; v < solved.visits().size(); ++v) {
        const Eigen::VectorXd stated = solved.stated_variance(v);
        variance.segment(row, stated.size()) = stochastic.length_factor * stated;
        row += stated.size();
    }
    // Deviations are drawn and not lengths: a nanometre that is drawn beside a metre would lose digits, of its own it
    // keeps all.
    columns_.noise = add(group_of("length noise", "length noise", "m", Eigen::VectorXd::Zero(lengths), variance,
                                  degrees_of_freedom.length_noise));
    // Beside the noise: its variance is known and has no estimated factor.
    if (const double step = measurement.length_uncertainty.resolution; step > 0.0) {
        gum::InputGroup group =
            group_of("resolution of the lengths", "length noise", "m", Eigen::VectorXd::Zero(lengths),
                     Eigen::MatrixXd::Constant(lengths, 1, step * step / 12.0), gum::k_infinity);
        make_uniform(group);
        columns_.resolution = add(std::move(group));
    }
    const auto add_table = [&](const char* name, const char* unit, Index per_visit, double of, double nu) {
        return of > 0.0 ? add(group_of(name, "table repeatability", unit, Eigen::VectorXd::Zero(per_visit * visits),
                                       Eigen::MatrixXd::Constant(per_visit * visits, 1, of), nu))
                        : -1;
    };
    columns_.linear =
        add_table("table repeatability, linear", "m", 3, stochastic.variance_linear, degrees_of_freedom.table_linear);
    columns_.axial =
        add_table("table repeatability, axial", "rad", 1, stochastic.variance_axial, degrees_of_freedom.table_axial);
    columns_.tilt =
        add_table("table repeatability, tilt", "rad", 2, stochastic.variance_tilt, degrees_of_freedom.table_tilt);

    // Quantities without an uncertainty are held in the adjustment and are no inputs.
    std::vector<double> temperature;
    std::vector<double> temperature_variance;
    Index scales = 0;
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const auto at = static_cast<Index>(j);
        scales += solved.scale_prior(j) != JointAdjustment::k_none ? 1 : 0;
        if (solved.temperature_prior(j) != JointAdjustment::k_none) {
            temperature.push_back(measurement.temperature_difference[at]);
            temperature_variance.push_back(measurement.u_temperature[at] * measurement.u_temperature[at]);
        }
    }
    if (scales > 0) {
        const double u = measurement.length_uncertainty.u_scale;
        columns_.scale = add(group_of("scale of the stations", "scale", "1", Eigen::VectorXd::Zero(scales),
                                      Eigen::MatrixXd::Constant(scales, 1, u * u), gum::k_infinity));
    }

    fixture_value_ = measurement.fixture.transpose().reshaped();
    columns_.fixture = size;
    if (extras_.fixture) {
        // The model of the fixture has the stated covariance; the factor that was estimated for it goes on the
        // deviations.
        fixture_deviation_ = std::sqrt(stochastic.fixture_factor);
        fixture_value_ = extras_.fixture->evaluate(gum::input_estimates(*extras_.fixture));
        if (fixture_value_.size() != 3 * measurement.fixture.rows()) {
            throw std::logic_error("rotary table trials: the model of the fixture has " +
                                   std::to_string(fixture_value_.size()) + " outputs, not three a reflector");
        }
        for (const gum::InputGroup& group : extras_.fixture->inputs()) {
            fixture_inputs_ += group.size();
            add(group);
        }
    } else {
        gum::InputGroup group =
            group_of("CMM coordinates of the fixture", "fixture CMM", "m", fixture_value_,
                     stochastic.fixture_factor * measurement.fixture_covariance, degrees_of_freedom.fixture);
        if (measurement.fixture_shape == InputShape::uniform) {
            make_uniform(group);
        }
        add(std::move(group));
    }
    if (!temperature.empty()) {
        const auto n = static_cast<Index>(temperature.size());
        gum::InputGroup group = group_of("temperature of the fixture", "fixture thermal", "K",
                                         Eigen::Map<Eigen::VectorXd>(temperature.data(), n),
                                         Eigen::Map<Eigen::VectorXd>(temperature_variance.data(), n), gum::k_infinity);
        if (measurement.temperature_shape == InputShape::uniform) {
            make_uniform(group);
        }
        temperature_ = group.value;
        columns_.temperature = add(std::move(group));
    }
    if (solved.expansion_prior() != JointAdjustment::k_none) {
        gum::InputGroup group = group_of(
            "expansion coefficient of the fixture", "fixture thermal", "1/K",
            Eigen::VectorXd::Constant(1, measurement.expansion),
            Eigen::MatrixXd::Constant(1, 1, measurement.u_expansion * measurement.u_expansion), gum::k_infinity);
        if (measurement.expansion_shape == InputShape::uniform) {
            make_uniform(group);
        }
        expansion_ = measurement.expansion;
        columns_.expansion = add(std::move(group));
    }

    const auto add_variance = [&](Index of, const char* name, const char* source, double nu) -> Index {
        // Infinite ν needs no factor. With few degrees of freedom a χ² near 0 would make deviations that no measurement
        // has.
        if (of < 0 || !std::isfinite(nu) || nu <= k_least_degrees_of_freedom) {
            return -1;
        }
        const std::string full_name = std::string(name) + ", estimated variance";
        gum::InputGroup group = group_of(full_name.c_str(), source, "1", Eigen::VectorXd::Ones(1),
                                         Eigen::MatrixXd::Constant(1, 1, 2.0 / nu), gum::k_infinity);
        // E(χ²_ν/ν) = 1 and Var(χ²_ν/ν) = 2/ν: gamma of shape ν/2 and scale 2/ν.
        group.evaluation = gum::Evaluation::type_a;
        group.distribution = "gamma";
        // The variance itself is known with ν degrees of freedom only: a factor χ²_ν/ν that all quantities of the
        // component share. Drawn for each of thousands of lengths it would average out.
        group.marginals = {gum::Distribution{
            .kind = gum::DistributionKind::gamma, .location = 0.0, .scale = 2.0 / nu, .shape = 0.5 * nu}};
        return add(std::move(group));
    };
    columns_.noise_variance =
        add_variance(columns_.noise, "length noise", "length noise", degrees_of_freedom.length_noise);
    columns_.linear_variance = add_variance(columns_.linear, "table repeatability, linear", "table repeatability",
                                            degrees_of_freedom.table_linear);
    columns_.axial_variance = add_variance(columns_.axial, "table repeatability, axial", "table repeatability",
                                           degrees_of_freedom.table_axial);
    columns_.tilt_variance =
        add_variance(columns_.tilt, "table repeatability, tilt", "table repeatability", degrees_of_freedom.table_tilt);
    columns_.fixture_variance =
        add_variance(columns_.fixture, "CMM coordinates of the fixture", "fixture CMM", degrees_of_freedom.fixture);
}

void RotaryTableTrials::draw_in(const Eigen::Ref<const Eigen::MatrixXd>& x, const Eigen::MatrixXd& coordinates,
                                Index first, Index count, TrialBatch& batch) const {
    const TrialNetwork& network = *network_;
    const Lanes noise_factor = variance_factor(x, columns_.noise_variance, first, count);
    const Lanes linear_factor = variance_factor(x, columns_.linear_variance, first, count);
    const Lanes axial_factor = variance_factor(x, columns_.axial_variance, first, count);
    const Lanes tilt_factor = variance_factor(x, columns_.tilt_variance, first, count);
    const Lanes fixture_factor = variance_factor(x, columns_.fixture_variance, first, count);
    const bool table_deviates = columns_.linear >= 0 || columns_.axial >= 0 || columns_.tilt >= 0;
    Lanes drawn;
    std::array<Lanes, 6> deviation;
    for (std::size_t v = 0; v < network.visits.size(); ++v) {
        const TrialNetwork::VisitPlan& visit = network.visits[v];
        for (Index k = 0; k < visit.count; ++k) {
            Lanes& start = batch.residual_start[static_cast<std::size_t>(visit.first + k)];
            fill(start, network.length_residual[static_cast<std::size_t>(visit.first + k)]);
            load(x, columns_.noise + visit.first_input + k, first, count, drawn);
            add_product(noise_factor, drawn, start);
            if (columns_.resolution >= 0) {
                load(x, columns_.resolution + visit.first_input + k, first, count, drawn);
                for (int t = 0; t < k_lanes; ++t) {
                    start[t] += drawn[t];
                }
            }
        }
        for (Lanes& component : deviation) {
            fill(component, 0.0);
        }
        const auto take = [&](Index group, Index per_visit, std::size_t to, const Lanes& factor) {
            for (Index c = 0; c < per_visit && group >= 0; ++c) {
                load(x, group + per_visit * static_cast<Index>(visit.number) + c, first, count, drawn);
                add_product(factor, drawn, deviation[to + static_cast<std::size_t>(c)]);
            }
        };
        take(columns_.linear, 3, 0, linear_factor);
        take(columns_.axial, 1, 3, axial_factor);
        take(columns_.tilt, 2, 4, tilt_factor);
        // A deviation of the table moves all distances of its visit together: that is their correlation.
        if (table_deviates) {
            draw_visit(network, visit, deviation.data(), batch);
        }
        // Kept, because the position where the table stood has it, while the lengths are corrected for it.
        batch.axial_deviation[v] = deviation[3];
    }

    const auto observe = [&](Index prior, double deviation_from) {
        Lanes& observed = batch.prior_observed[static_cast<std::size_t>(prior)];
        const double start = network.prior_residual[static_cast<std::size_t>(prior)];
        for (int t = 0; t < k_lanes; ++t) {
            // Differences from the solution: what was drawn less the estimate, added to the residual there.
            observed[t] = start + (drawn[t] - deviation_from);
        }
    };
    for (Index c = 0; c < fixture_value_.size(); ++c) {
        if (extras_.fixture) {
            load(coordinates, c, first, count, drawn);
        } else {
            load(x, columns_.fixture + c, first, count, drawn);
        }
        for (int t = 0; t < k_lanes; ++t) {
            // Deviations only, so that an estimated factor acts on them and not on the coordinates.
            drawn[t] = fixture_deviation_ * fixture_factor[t] * (drawn[t] - fixture_value_[c]);
        }
        observe(network.fixture_prior + c, 0.0);
    }
    Index scale = columns_.scale;
    Index temperature = columns_.temperature;
    for (std::size_t j = 0; j < network.scale_priors.size(); ++j) {
        if (network.scale_priors[j] >= 0) {
            load(x, scale++, first, count, drawn);
            observe(network.scale_priors[j], 0.0);
        }
        if (network.thermal.temperature_priors[j] >= 0) {
            load(x, temperature, first, count, drawn);
            observe(network.thermal.temperature_priors[j],
                    temperature_[static_cast<Index>(temperature - columns_.temperature)]);
            ++temperature;
        }
    }
    if (network.thermal.expansion_prior >= 0) {
        load(x, columns_.expansion, first, count, drawn);
        observe(network.thermal.expansion_prior, expansion_);
    }
}

void RotaryTableTrials::write_derived(Index first, Index count, const TrialBatch& batch,
                                      Eigen::Ref<Eigen::MatrixXd> y) const {
    const TrialNetwork& network = *network_;
    const auto reported_count = static_cast<Index>(quantities_.outputs.size());
    const auto axial = static_cast<Index>(3 + datum_->cyclic[0]);
    Eigen::VectorXd reported(reported_count);
    Eigen::VectorXd positions(static_cast<Index>(network.visits.size()));
    Eigen::VectorXd result(static_cast<Index>(outputs_.size()) - reported_count);
    for (Index t = 0; t < count; ++t) {
        const int lane = static_cast<int>(t);
        // A trial that has no solution has no derived quantities either.
        reported = y.row(first + t).head(reported_count).transpose();
        if (!reported.allFinite()) {
            y.row(first + t).tail(result.size()).setConstant(std::numeric_limits<double>::quiet_NaN());
            continue;
        }
        positions.setZero();
        for (std::size_t v = 0; v < network.visits.size(); ++v) {
            const TrialNetwork::VisitPlan& visit = network.visits[v];
            if (!visit.is_determined) {
                continue;
            }
            // Where the table stood at this visit: error motion and its half of the reversal, plus what the residuals
            // of the visit tell of its own deviation, plus the part of the deviation that was drawn and taken off the
            // lengths.
            double position = reported[6 * visit.angle + axial];
            if (quantities_.has_reversal) {
                position += visit.half_sense * (batch.delta[static_cast<std::size_t>(visit.reversal + axial)][lane] +
                                                network.nominal_at(visit.reversal + axial));
            }
            for (Index k = 0; k < visit.count; ++k) {
                position += network.gains[visit.gain + static_cast<std::size_t>(k)] *
                            batch.residual[static_cast<std::size_t>(visit.first + k)][lane];
            }
            positions[static_cast<Index>(visit.number)] = position + batch.axial_deviation[v][lane];
        }
        extras_.derived->values(reported, positions, result);
        y.row(first + t).tail(result.size()) = result.transpose();
    }
}

void RotaryTableTrials::evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x,
                                        Eigen::Ref<Eigen::MatrixXd> y) const {
    const TrialNetwork& network = *network_;
    Eigen::MatrixXd coordinates;
    if (extras_.fixture) {
        coordinates.resize(x.rows(), fixture_value_.size());
        extras_.fixture->evaluate_trials(x.middleCols(columns_.fixture, fixture_inputs_), coordinates);
    }
    // One batch for all: memory is asked for once, not for every sixteen trials.
    TrialBatch batch(network);
    TrialSteps sum;
    for (Index first = 0; first < x.rows(); first += k_lanes) {
        const Index count = std::min<Index>(k_lanes, x.rows() - first);
        draw_in(x, coordinates, first, count, batch);
        const std::array<TrialEnd, k_lanes> ends = solve(network, extras_.options, count, batch);
        transform_to_datum(network, *datum_, batch);
        const auto write = [&](Index column, const Lanes& from) {
            std::copy_n(from.at.begin(), count, y.data() + column * y.outerStride() + first);
        };
        for (std::size_t i = 0; i < batch.errors.size(); ++i) {
            write(static_cast<Index>(i), batch.errors[i]);
        }
        for (std::size_t c = 0; c < 2; ++c) {
            const auto across = static_cast<std::size_t>(datum_->cyclic[1 + c]);
            write(quantities_.set_up + static_cast<Index>(c), batch.set_up[across]);
            write(quantities_.set_up + 2 + static_cast<Index>(c), batch.set_up[3 + across]);
        }
        for (Index c = 0; c < 6 && quantities_.has_reversal; ++c) {
            write(quantities_.reversal + c, mean_reversal(network, batch, c));
        }
        for (Index t = 0; t < count; ++t) {
            const TrialEnd& end = ends[static_cast<std::size_t>(t)];
            // A trial without a solution has no value: Monte Carlo ends and names it, instead of leaving it out in
            // silence.
            if (!end.converged) {
                y.row(first + t).setConstant(std::numeric_limits<double>::quiet_NaN());
            }
            ++sum.trials;
            sum.steps += static_cast<std::uint64_t>(end.steps);
            sum.most = std::max(sum.most, end.steps);
            sum.alone += end.alone ? 1 : 0;
            sum.not_converged += end.converged ? 0 : 1;
        }
        // Residuals at the end of the steps: what the visits say of their own deviations.
        if (extras_.derived) {
            find_residuals(network, batch);
            write_derived(first, count, batch, y);
        }
    }
    // Counts only: they may be added in any order, and no result depends on them.
    trials_.fetch_add(sum.trials, std::memory_order_relaxed);
    steps_.fetch_add(sum.steps, std::memory_order_relaxed);
    alone_.fetch_add(sum.alone, std::memory_order_relaxed);
    not_converged_.fetch_add(sum.not_converged, std::memory_order_relaxed);
    int most = most_steps_.load(std::memory_order_relaxed);
    while (most < sum.most && !most_steps_.compare_exchange_weak(most, sum.most, std::memory_order_relaxed)) {
    }
}

TrialSteps RotaryTableTrials::steps() const {
    return {trials_.load(), steps_.load(), most_steps_.load(), alone_.load(), not_converged_.load()};
}

Eigen::VectorXd RotaryTableTrials::evaluate(const Eigen::VectorXd& x) const {
    const Eigen::MatrixXd row = x.transpose();
    Eigen::MatrixXd y(1, static_cast<Index>(outputs_.size()));
    evaluate_trials(row, y);
    if (!y.allFinite()) {
        throw gum::NoResultError(gum::Diagnostic{
            "GC-ADJUST-0006", "rotary table trials",
            "the adjustment did not converge in " + std::to_string(extras_.options.most_steps) + " steps",
            "a value of the model is the minimum of the weighted squares", "keep the inputs within their uncertainties",
            gum::Severity::error});
    }
    return y.row(0).transpose();
}

Eigen::MatrixXd RotaryTableTrials::jacobian(const Eigen::VectorXd& x) const {
    Eigen::VectorXd u(x.size());
    Index next = 0;
    for (const gum::InputGroup& group : inputs_) {
        for (Index i = 0; i < group.size(); ++i) {
            u[next++] = std::sqrt(group.covariance.cols() == 1 ? group.covariance(i, 0) : group.covariance(i, i));
        }
    }
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(static_cast<Index>(outputs_.size()), x.size());
    constexpr Index k_columns = 64;
    for (Index first = 0; first < x.size(); first += k_columns) {
        const Index count = std::min(k_columns, x.size() - first);
        Eigen::MatrixXd trials = x.transpose().replicate(2 * count, 1);
        for (Index i = 0; i < count; ++i) {
            // A quantity that must stay above 0, as an estimated variance, does so with a step of a tenth.
            const double step = 0.1 * u[first + i];
            trials(2 * i, first + i) += step;
            trials(2 * i + 1, first + i) -= step;
        }
        Eigen::MatrixXd y(trials.rows(), result.rows());
        evaluate_trials(trials, y);
        for (Index i = 0; i < count; ++i) {
            // The difference as it was evaluated: x + h and x − h are rounded.
            const double width = trials(2 * i, first + i) - trials(2 * i + 1, first + i);
            if (width > 0.0) {
                result.col(first + i) = (y.row(2 * i) - y.row(2 * i + 1)).transpose() / width;
            }
        }
    }
    return result;
}

}  // namespace gumcert::engine
