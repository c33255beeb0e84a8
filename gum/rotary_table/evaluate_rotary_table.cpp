#include "gum/rotary_table/evaluate_rotary_table.h"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>
#include <memory>
#include <string>
#include <utility>

#include "engine/rotary_table/contact_point_model.h"
#include "engine/rotary_table/evaluation/sequential_evaluation.h"
#include "engine/rotary_table/rotary_table_contributions.h"
#include "engine/rotary_table/trials/rotary_table_trials.h"
#include "gum/analysis_of_variance.h"
#include "gum/coverage.h"
#include "gum/monte_carlo/validation_in_unit.h"
#include "gum/monte_carlo/worker_threads.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/progress.h"
#include "gum/rotary_table/document_units.h"
#include "gum/rotary_table/widened_extremes.h"

namespace gumcert::gum {

// The order of the steps: the budget of the fixture gives the covariance that the adjustment weighs with; the
// adjustment gives values, weights and degrees of freedom; the law of propagation takes them as a measurement model;
// what is derived (parameters of the axis, location errors, contact point) is propagated from the same inputs, so that
// correlations between angles go into it; Monte Carlo draws the same inputs last, and is held against the law.
// The joint method goes angle by angle (ADR 0032), the sequential one by all sensitivity coefficients.

namespace {

constexpr double k_detection_power = 0.8;  // of the minimal detectable bias, as Baarda chose it

/// Value, standard and expanded uncertainty that the law of propagation states for an output of Monte Carlo.
struct Stated {
    double value, u, U;
};

Stated stated(const RotaryTableResult& result, Eigen::Index output) {
    const Eigen::Index reported = result.reported.budget.value.size();
    const UncertaintyBudget& from = output < reported ? result.reported.budget : result.parameters;
    const Eigen::Index index = output < reported ? output : output - reported;
    return {from.value[index], from.standard_uncertainty[index], from.expanded_uncertainty[index]};
}

/// Whether a component whose estimated variance the trials do not draw has a part in an output. Deviations drawn with
/// that estimate as if it were known lack the spread of the estimate itself, which JCGM 101:2008, 6.4.9, draws with it
/// and the law of propagation has in its coverage factor.
bool law_stands_for(const std::vector<InputGroup>& inputs, const RotaryTableResult& result, Eigen::Index output) {
    constexpr double k_felt = 0.01;  // of the variance: with ν = 1 it makes k larger by 1e-4
    const Eigen::Index reported = result.reported.budget.value.size();
    const UncertaintyBudget& from = output < reported ? result.reported.budget : result.parameters;
    const Eigen::Index index = output < reported ? output : output - reported;
    return std::ranges::any_of(inputs, [&](const InputGroup& group) {
        const bool undrawn = group.degrees_of_freedom <= engine::RotaryTableTrials::k_least_degrees_of_freedom;
        return undrawn && std::ranges::any_of(from.budget, [&](const BudgetContribution& contribution) {
                   return contribution.name == group.name && contribution.share[index] > k_felt;
               });
    });
}

RotaryTableMonteCarlo monte_carlo_of(const RotaryTableRequest& request, const RotaryTableResult& result,
                                     unsigned threads, const Progress& progress) {
    const MonteCarloRequest& asked = *request.monte_carlo;
    const auto joint = std::dynamic_pointer_cast<const engine::RotaryTableModel>(result.solution.model);
    const engine::RotaryTableTrials trials(
        *joint, {.fixture = result.fixture.model, .derived = result.parameter_model->parameters()});
    MonteCarloOptions options = monte_carlo_options(asked, threads, progress);
    options.coverage_probability = request.coverage_probability;
    // Hundreds of outputs: regions of all of them say nothing, and counts of cells for each would be held by every
    // thread.
    options.regions = false;
    options.histogram = false;
    const engine::TableParameters& parameters = *result.parameter_model->parameters();
    const std::vector<std::string>& names = parameters.short_names();
    const auto reported = static_cast<std::size_t>(result.reported.budget.value.size());
    const std::size_t positioning = reported + static_cast<std::size_t>(parameters.layout().positioning);
    RotaryTableMonteCarlo monte_carlo;
    monte_carlo.result = run_monte_carlo(trials, options);
    monte_carlo.most_steps = trials.steps().most;
    monte_carlo.mean_steps = trials.steps().mean();
    for (std::size_t i = 0; i < monte_carlo.result.outputs.size(); ++i) {
        const Stated law = stated(result, static_cast<Eigen::Index>(i));
        std::optional<Validation> validation;
        // Of the parameters of the table, those that are stated and that Monte Carlo can check: extremes and standard
        // deviations hold the noise of the distances already, and trials would add it once more (ADR 0015, 0017).
        const bool compared =
            i < reported || (!holds_noise_already(parameters, static_cast<Eigen::Index>(i - reported)) &&
                             (i < positioning || result.positioning.states(names[i - reported])));
        monte_carlo.compared.push_back(compared);
        monte_carlo.law_stands.push_back(compared && law.u > 0.0 &&
                                         law_stands_for(joint->inputs(), result, static_cast<Eigen::Index>(i)));
        if (law.u > 0.0 && compared && !monte_carlo.law_stands.back()) {
            const double unit = unit_of(trials.outputs()[i]).si;
            const auto scaled = [unit](double value) { return value / unit; };
            validation = validation_in_unit(law.value, law.u, law.U, monte_carlo.result.outputs[i], {scaled, scaled},
                                            asked.digits);
        }
        monte_carlo.validations.push_back(validation);
    }
    return monte_carlo;
}

QuantityUncertainty stated_by_law(const MeasurementModel& model, const Eigen::VectorXd& value,
                                  engine::RotaryTableContributions contributions, double coverage_probability) {
    return {uncertainty_budget(model, value, std::move(contributions.variance), coverage_probability),
            std::move(contributions.covariance), std::move(contributions.sensitivity)};
}

/// The same with a sensitivity coefficient for every input and output.
QuantityUncertainty stated_by_all_coefficients(const MeasurementModel& model, double coverage_probability) {
    Propagation propagation = propagate(model, coverage_probability);
    QuantityUncertainty result;
    Eigen::Index first = 0;
    for (const InputGroup& group : model.inputs()) {
        result.sensitivity.emplace_back();
        // A group of several quantities has a coefficient for each of them: only that of a single one stands in a
        // budget.
        if (group.size() == 1) {
            result.sensitivity.back() = propagation.jacobian.col(first);
        }
        first += group.size();
    }
    result.covariance = engine::AnglewiseCovariance(propagation.covariance);
    result.budget = std::move(propagation);
    return result;
}

}  // namespace

engine::EvaluationOptions single_test_options(const engine::RotaryTableMeasurement& measurement) {
    engine::EvaluationOptions options;
    options.critical_value = two_sided_normal_critical_value(measurement.outliers.alpha);
    // δ0 = z_(1−α/2) + z_(1−β): a bias of δ0 σ/√r exceeds the limit with the probability 1 − β, 3.29 + 0.84 = 4.13 for
    // α = 0.001.
    options.non_centrality = options.critical_value + standard_normal_quantile(k_detection_power);
    // Of a residual whose variance is estimated: t of its degrees of freedom in place of the normal distribution.
    options.student_critical_value = [alpha = measurement.outliers.alpha](double degrees_of_freedom) {
        // Two-sided: |residual| is compared, with α/2 on either side.
        return coverage_factor(1.0 - alpha, degrees_of_freedom);
    };
    return options;
}

engine::EvaluationOptions evaluation_options(const engine::RotaryTableMeasurement& measurement) {
    engine::EvaluationOptions options = single_test_options(measurement);
    options.chi_square_upper_tail = chi_square_upper_tail;
    options.fisher_upper_tail = f_upper_tail;
    return options;
}

RotaryTableResult evaluate_rotary_table(RotaryTableRequest& request, unsigned threads, const Progress& progress) {
    const engine::RotaryTableMeasurement& measurement = request.measurement;
    const bool joint = measurement.method == engine::AdjustmentMethod::joint;
    if (request.monte_carlo && !joint) {
        throw InputError(Diagnostic{"GC-INPUT-0238", request.where + "#/monte_carlo",
                                    "Monte Carlo is asked for with the sequential method",
                                    "Monte Carlo repeats the joint adjustment",
                                    "remove \"monte_carlo\", or choose \"method\": \"joint\"", Severity::error});
    }
    // A sensitivity coefficient for each input and output grows with the square of the angles (ADR 0032).
    if (!joint) {
        engine::require_evaluable_size(measurement);
    }
    RotaryTableResult result;
    result.fixture = apply_fixture_budget(request);
    result.options = evaluation_options(measurement);
    result.options.workers = [workers = std::make_shared<WorkerThreads>(threads)](
                                 std::size_t tasks, const std::function<void(std::size_t)>& task) {
        workers->run(tasks, [&](unsigned, std::size_t number) { task(number); });
    };
    result.solution = joint ? engine::evaluate_jointly(measurement, result.options, progress)
                            : engine::evaluate_sequentially(measurement, result.options, progress);
    const auto report = [&](const char* text) {
        if (progress) {
            progress(text);
        }
    };
    report("law of propagation");
    const engine::RotaryTableSolution& solution = result.solution;
    const double probability = request.coverage_probability;
    const auto model = std::dynamic_pointer_cast<const engine::RotaryTableModel>(solution.model);
    // The joint model has the structure that the law angle by angle needs; the sequential one has not.
    if (model) {
        result.reported = stated_by_law(*model, solution.values, engine::contributions_of(*model), probability);
        result.parameter_model = std::make_shared<engine::TableParameterModel>(model, solution.datum);
    } else {
        result.reported = stated_by_all_coefficients(*solution.model, probability);
        result.parameter_model =
            std::make_shared<engine::TableParameterModel>(solution.model, measurement, solution.datum);
    }
    result.parameters = propagate(*result.parameter_model, probability);
    if (result.parameter_model->parameters()->layout().positioning_count > 0) {
        result.positioning = positioning_scope(*result.parameter_model);
    }
    const MotionCovariances covariances = motion_covariances(result.reported.covariance, measurement.angles.size());
    const TableDeviations deviations{.model = *result.parameter_model,
                                     .reported = result.reported.budget.value,
                                     .covariance = covariances,
                                     .positions = result.parameter_model->nominal_positions(),
                                     .u_deviation = result.positioning.u_deviation};
    widen_ranges(result.parameters, deviations);
    widen_positioning(result.parameters, deviations,
                      [&](const std::string& name) { return result.positioning.states(name); });
    if (request.machine_frame) {
        result.location_errors =
            evaluate_location_errors(request, solution, result.reported.budget, result.reported.covariance);
    }
    if (request.reference) {
        const engine::ContactPointModel contact(solution.model, measurement, solution.datum,
                                                request.reference->contact_point);
        result.contact_point = model ? stated_by_law(contact, contact.displacements(solution.values),
                                                     engine::contributions_of(*model, contact), probability)
                                     : stated_by_all_coefficients(contact, probability);
    }
    if (request.monte_carlo) {
        report("Monte Carlo");
        result.monte_carlo = monte_carlo_of(request, result, threads, progress);
        for (const std::optional<Validation>& validation : result.monte_carlo->validations) {
            // Trials that are too few to tell have not validated anything.
            const bool failed = validation && !(validation->validated && validation->precise_enough);
            result.validation_failed = result.validation_failed || (request.monte_carlo->validate && failed);
        }
        // What the trials do not draw they have not confirmed either.
        result.validation_failed =
            result.validation_failed ||
            (request.monte_carlo->validate && std::ranges::count(result.monte_carlo->law_stands, true) > 0);
    }
    return result;
}

}  // namespace gumcert::gum
