#pragma once

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/circle_closure.h"
#include "gum/circle_closure/circle_closure_request.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/progress.h"

namespace gumcert::gum {

/// Expanded uncertainty of one output, coherent SI.
struct ClosureCoverage {
    double k = 2.0, U = 0.0;
    std::string coverage = "student_t";  ///< where k comes from: "normal", "student_t" or "convolution"
    std::string
        note;  ///< where it is the convolution: why; of a range whose extremes are not clear: that u allows for it
};

struct CircleClosureMonteCarlo {
    MonteCarloResult result;
    /// One an output, in the unit of the request; none of a range: the deviations hold their noise already, and trials would
    /// add it once more (ADR 0015).
    std::vector<std::optional<Validation>> validations;
};

/// Everything computed for a comparison of two circles. Outputs: T, P, range of T, range of P.
struct CircleClosureResult {
    std::shared_ptr<const engine::CircleClosureSolution> solution;
    std::shared_ptr<const engine::CircleClosureModel> model;
    Propagation propagation;
    std::vector<ClosureCoverage> coverage;
    std::optional<CircleClosureMonteCarlo> monte_carlo;
    bool validation_failed = false;

    /// The last two outputs.
    [[nodiscard]] bool is_range(Eigen::Index output) const { return output >= propagation.value.size() - 2; }
};

/// Solves the comparison: adjustment, law of propagation, coverage, Monte Carlo.
///
/// Positions and indices in the measurement have to be right, which the reader of a job sees to.
/// \param threads  of Monte Carlo; 0: as many as the machine has
/// \throws NoResultError  of solve_circle_closure() and run_monte_carlo()
/// Example: examples/api/circle_closure.cpp
[[nodiscard]] CircleClosureResult evaluate_circle_closure(const CircleClosureRequest& request, unsigned threads,
                                                          const Progress& progress = {});

}  // namespace gumcert::gum
