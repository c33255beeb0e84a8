#include "engine/rotary_table/evaluation/settled_errors.h"

#include <cmath>
#include <utility>

namespace gumcert::engine {

namespace {

/// At the solution of a measurement, from what is stated of temperatures and coefficient; none where it does not converge.
std::unique_ptr<JointAdjustment> adjusted_without(const RotaryTableMeasurement& corrected,
                                                  const JointAdjustment& adjustment, const StochasticModel& stochastic,
                                                  const SolverOptions& solver) {
    auto without = std::make_unique<JointAdjustment>(corrected, adjustment.active(), adjustment.set_up(),
                                                     adjustment.present_values(), stochastic);
    without->adjustment().set_workers(adjustment.adjustment().workers());
    if (!without->adjustment().solve(solver).converged) {
        return nullptr;
    }
    without->set_weights(stochastic);
    return without->adjustment().refine(solver).converged ? std::move(without) : nullptr;
}

Eigen::VectorXd sizes_left(const ErrorModel& model, const JointAdjustment& without) {
    const NormalEquations normal = without.adjustment().linearise();
    return model.sizes(without, normal, normal.bordered_covariance());
}

/// Sizes with the temperatures and the coefficient that are stated; none where that adjustment does not converge.
std::optional<Eigen::VectorXd> sizes_at_fixed_temperatures(const ErrorModel& model, const JointAdjustment& adjustment,
                                                           const StochasticModel& stochastic,
                                                           const SolverOptions& solver) {
    RotaryTableMeasurement fixed = adjustment.measurement();
    fixed.u_temperature.setZero();
    fixed.u_expansion = 0.0;
    const std::unique_ptr<JointAdjustment> at = adjusted_without(fixed, adjustment, stochastic, solver);
    return at ? std::optional(sizes_left(model, *at)) : std::nullopt;
}

}  // namespace

std::optional<SettledErrors> settle_errors(const ErrorModel& model, const JointAdjustment& adjustment,
                                           const StochasticModel& stochastic, const SolverOptions& solver) {
    constexpr int k_most_corrections = 10;
    constexpr double k_settled = 1e-3;  // of a size: it is told with three digits
    const std::optional<Eigen::VectorXd> first = sizes_at_fixed_temperatures(model, adjustment, stochastic, solver);
    if (!first) {
        return std::nullopt;
    }
    SettledErrors result{*first, nullptr, nullptr};
    Eigen::VectorXd before, left_before;  // the sizes that were taken off then, and what was left
    for (int k = 0; k < k_most_corrections; ++k) {
        auto corrected = std::make_unique<RotaryTableMeasurement>(adjustment.measurement());
        model.take_off(*corrected, result.sizes);
        result.without = adjusted_without(*corrected, adjustment, stochastic, solver);
        result.measurement = std::move(corrected);
        if (!result.without) {
            return std::nullopt;
        }
        const Eigen::VectorXd left = sizes_left(model, *result.without);
        Eigen::VectorXd change = left;
        for (Eigen::Index j = 0; j < model.count && k > 0; ++j) {
            if (left_before[j] != left[j]) {
                change[j] = left[j] * (result.sizes[j] - before[j]) / (left_before[j] - left[j]);
            }
        }
        before = result.sizes;
        left_before = left;
        result.sizes += change;
        if (!result.sizes.allFinite()) {
            return std::nullopt;
        }
        if ((change.array().abs() <= k_settled * result.sizes.array().abs()).all()) {
            return result;
        }
    }
    return std::nullopt;
}

}  // namespace gumcert::engine
