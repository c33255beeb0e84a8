#pragma once

#include <Eigen/Core>

#include <array>

#include "engine/rotary_table/trials/trial_batch.h"
#include "engine/rotary_table/trials/trial_network.h"

namespace gumcert::engine {

/// When the solution of one trial counts as found.
struct TrialOptions {
    /// A trial has converged when the last step changed no error motion and no reversal by more than this fraction of
    /// its standard uncertainty. Steps shrink by a factor of hundreds and more, so that what is left is far below it.
    /// What is not reported (dead paths, scales, temperatures …) is not asked.
    double step_tolerance = 1e-4;
    int most_steps = 20;  ///< a trial that needs more is solved alone, with new normal equations at every step
};

/// How a trial was solved.
struct TrialEnd {
    int steps = 0;
    bool converged = false;
    bool alone = false;
};

/// Solves 16 trials, of which `count` are wanted, from what is drawn in `batch`.
[[nodiscard]] std::array<TrialEnd, k_lanes> solve(const TrialNetwork& network, const TrialOptions& options,
                                                  Eigen::Index count, TrialBatch& batch);

}  // namespace gumcert::engine
