#include "gum/circle_closure/evaluate_circle_closure.h"

#include <cmath>
#include <utility>

#include "gum/budget/budget_coverage.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/monte_carlo/extreme_uncertainty.h"
#include "gum/monte_carlo/validation_in_unit.h"
#include "gum/quantity/progress.h"

namespace gumcert::gum {

namespace {

using engine::CircleClosureModel;

/// The ranges of T and P, which stand behind the deviations of both circles.
void widen_ranges(Propagation& propagation, double coverage_probability) {
    const Eigen::Index steps = (propagation.value.size() - 2) / 2;
    for (Eigen::Index circle = 0; circle < 2; ++circle) {
        const Eigen::Index range = 2 * steps + circle;
        const Eigen::Index first = circle * steps;
        const ExtremeValues deviations =
            range_of(propagation.value.segment(first, steps), propagation.covariance.block(first, first, steps, steps));
        state_extreme(
            propagation, range,
            extreme_uncertainty(deviations, coverage_probability, propagation.effective_degrees_of_freedom(range)));
        propagation.covariance(range, range) = std::pow(propagation.standard_uncertainty(range), 2);
    }
}

ClosureCoverage coverage_of(const CircleClosureModel& model, const Propagation& propagation, Eigen::Index output) {
    const double nu = propagation.effective_degrees_of_freedom(output);
    ClosureCoverage all{.k = propagation.coverage_factor(output),
                        .U = propagation.expanded_uncertainty(output),
                        .coverage = std::isinf(nu) ? "normal" : "student_t",
                        .note = {}};
    if (share_of_extremes(propagation, output) > 0.0) {
        // The convolution would be that of the contributions of the law.
        all.note =
            "other values may be the largest or the smallest within the uncertainty of measurement, and u allows for "
            "every one that may be";
        return all;
    }
    if (convolution_changes_little(model, propagation, output)) {
        return all;
    }
    const auto convolved = expand_by_convolution(model, propagation, output);
    if (convolved && is_noticed_change(convolved->coverage_factor, all.k)) {
        all.coverage = "convolution";
        all.note = convolution_note(nu, all.k);
        all.k = convolved->coverage_factor;
        all.U = convolved->expanded_uncertainty;
    }
    return all;
}

CircleClosureMonteCarlo monte_carlo_of(const CircleClosureRequest& request, const CircleClosureResult& result,
                                       unsigned threads, const Progress& progress) {
    const CircleClosureModel trials(request.measurement, result.solution, CircleClosureModel::Inputs::deviations);
    MonteCarloOptions options = monte_carlo_options(*request.monte_carlo, threads, progress);
    options.coverage_probability = request.coverage_probability;
    options.regions = false;
    options.histogram = false;
    CircleClosureMonteCarlo monte_carlo{.result = run_monte_carlo(trials, options), .validations = {}};
    const ToUnit to_unit{.value = [&](double value) { return request.unit.from_si(value); },
                         .difference = [&](double value) { return request.unit.difference_from_si(value); }};
    for (std::size_t i = 0; i < monte_carlo.result.outputs.size(); ++i) {
        const auto output = static_cast<Eigen::Index>(i);
        if (result.is_range(output)) {
            monte_carlo.validations.emplace_back();
            continue;
        }
        monte_carlo.validations.push_back(validation_in_unit(
            result.propagation.value(output), result.propagation.standard_uncertainty(output), result.coverage[i].U,
            monte_carlo.result.outputs[i], to_unit, request.monte_carlo->digits));
    }
    return monte_carlo;
}

}  // namespace

CircleClosureResult evaluate_circle_closure(const CircleClosureRequest& request, unsigned threads,
                                            const Progress& progress) {
    CircleClosureResult result;
    result.solution =
        std::make_shared<const engine::CircleClosureSolution>(engine::solve_circle_closure(request.measurement));
    result.model = std::make_shared<const CircleClosureModel>(request.measurement, result.solution,
                                                              CircleClosureModel::Inputs::readings);
    result.propagation = propagate(*result.model, request.coverage_probability);
    widen_ranges(result.propagation, request.coverage_probability);
    for (Eigen::Index i = 0; i < result.propagation.value.size(); ++i) {
        result.coverage.push_back(coverage_of(*result.model, result.propagation, i));
    }
    if (request.monte_carlo) {
        result.monte_carlo = monte_carlo_of(request, result, threads, progress);
        for (const std::optional<Validation>& validation : result.monte_carlo->validations) {
            const bool failed = validation && !(validation->validated && validation->precise_enough);
            result.validation_failed = result.validation_failed || (request.monte_carlo->validate && failed);
        }
    }
    return result;
}

}  // namespace gumcert::gum
