#include "app/evaluate_circle_closure.h"

#include <cmath>
#include <utility>

#include "app/record_parts.h"
#include "gum/budget/budget_coverage.h"
#include "gum/convolution.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

namespace {

using engine::CircleClosureJob;
using engine::CircleClosureModel;
ClosureCoverage coverage_of(const CircleClosureModel& model, const gum::Propagation& propagation, Eigen::Index output) {
    const double nu = propagation.effective_degrees_of_freedom(output);
    ClosureCoverage all{.k = propagation.coverage_factor(output),
                        .U = propagation.expanded_uncertainty(output),
                        .coverage = std::isinf(nu) ? "normal" : "student_t",
                        .note = {}};
    if (gum::convolution_changes_little(model, propagation, output)) {
        return all;
    }
    const auto convolved = gum::expand_by_convolution(model, propagation, output);
    if (convolved && gum::is_noticed_change(convolved->coverage_factor, all.k)) {
        all.coverage = "convolution";
        all.note = gum::convolution_note(nu, all.k);
        all.k = convolved->coverage_factor;
        all.U = convolved->expanded_uncertainty;
    }
    return all;
}

CircleClosureMonteCarlo run_monte_carlo(const CircleClosureJob& job, const CircleClosureResult& result,
                                        unsigned threads, const gum::Progress& progress) {
    const CircleClosureModel trials(job.measurement, result.solution, CircleClosureModel::Inputs::deviations);
    gum::MonteCarloOptions options = gum::monte_carlo_options(*job.monte_carlo, threads, progress);
    options.coverage_probability = job.coverage_probability;
    options.regions = false;
    options.histogram = false;
    CircleClosureMonteCarlo monte_carlo{.result = gum::run_monte_carlo(trials, options), .validations = {}};
    const gum::ToUnit to_unit{.value = [&](double value) { return job.unit.from_si(value); },
                              .difference = [&](double value) { return job.unit.difference_from_si(value); }};
    for (std::size_t i = 0; i < monte_carlo.result.outputs.size(); ++i) {
        const auto output = static_cast<Eigen::Index>(i);
        monte_carlo.validations.push_back(gum::validation_in_unit(
            result.propagation.value(output), result.propagation.standard_uncertainty(output), result.coverage[i].U,
            monte_carlo.result.outputs[i], to_unit, job.monte_carlo->digits));
    }
    return monte_carlo;
}

}  // namespace

CircleClosureResult evaluate_circle_closure(const CircleClosureJob& job, unsigned threads,
                                            const gum::Progress& progress) {
    CircleClosureResult result;
    result.solution =
        std::make_shared<const engine::CircleClosureSolution>(engine::solve_circle_closure(job.measurement));
    result.model = std::make_shared<const CircleClosureModel>(job.measurement, result.solution,
                                                              CircleClosureModel::Inputs::readings);
    result.propagation = gum::propagate(*result.model, job.coverage_probability);
    for (Eigen::Index i = 0; i < result.propagation.value.size(); ++i) {
        result.coverage.push_back(coverage_of(*result.model, result.propagation, i));
    }
    if (job.monte_carlo) {
        result.monte_carlo = run_monte_carlo(job, result, threads, progress);
        for (const gum::Validation& validation : result.monte_carlo->validations) {
            const bool failed = !(validation.validated && validation.precise_enough);
            result.validation_failed = result.validation_failed || (job.monte_carlo->validate && failed);
        }
    }
    return result;
}

}  // namespace gumcert::app
