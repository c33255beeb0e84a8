#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/circle_closure.h"
#include "engine/job/circle_closure_job.h"
#include "gum/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

/// Expanded uncertainty of one output, coherent SI.
struct ClosureCoverage {
    double k = 2.0, U = 0.0;
    std::string coverage = "student_t";  ///< as reports::Result::coverage
    std::string note;                    ///< where k comes from something else than a t- or normal distribution
};

struct CircleClosureMonteCarlo {
    gum::MonteCarloResult result;
    std::vector<gum::Validation> validations;  ///< one an output, in the unit of the job
};

/// Everything computed for a job of kind `circle_closure`. Outputs: T, P, range of T, range of P.
struct CircleClosureResult {
    std::shared_ptr<const engine::CircleClosureSolution> solution;
    std::shared_ptr<const engine::CircleClosureModel> model;
    gum::Propagation propagation;
    std::vector<ClosureCoverage> coverage;
    std::optional<CircleClosureMonteCarlo> monte_carlo;
    bool validation_failed = false;
};

/// Solves the comparison and hands it to the GUM layer: propagation, coverage, Monte Carlo.
/// \param threads  of Monte Carlo; 0: as many as the machine has
/// \throws NoResultError  of solve_circle_closure() and gum::run_monte_carlo()
[[nodiscard]] CircleClosureResult evaluate_circle_closure(const engine::CircleClosureJob& job, unsigned threads,
                                                          const gum::Progress& progress = {});

}  // namespace gumcert::app
