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

SizesLeft sizes_left(const ErrorModel& model, const JointAdjustment& without) {
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
    return at ? std::optional(sizes_left(model, *at).sizes) : std::nullopt;
}

}  // namespace

std::optional<SettledErrors> settle_errors(const ErrorModel& model, const JointAdjustment& adjustment,
                                           const StochasticModel& stochastic, const SolverOptions& solver) {
    constexpr int k_most_corrections = 10;
    constexpr double k_settled = 1e-3;  // of a size: it is told with three digits
    constexpr double k_settled_of_u = 1e-2;
    const std::optional<Eigen::VectorXd> first = sizes_at_fixed_temperatures(model, adjustment, stochastic, solver);
    if (!first) {
        return std::nullopt;
    }
    SettledErrors result{*first, *first, nullptr, nullptr};
    Eigen::VectorXd part;            // of each size: of those that are counted in different units none decides
    Eigen::VectorXd change, before;  // the last change, and what was left before it, in parts
    Eigen::MatrixXd inverse =
        Eigen::MatrixXd::Identity(model.count, model.count);  // of what a size takes from what is left
    for (int k = 0; k < k_most_corrections; ++k) {
        auto corrected = std::make_unique<RotaryTableMeasurement>(adjustment.measurement());
        model.take_off(*corrected, result.sizes);
        result.taken_off = result.sizes;
        result.without = adjusted_without(*corrected, adjustment, stochastic, solver);
        result.measurement = std::move(corrected);
        if (!result.without) {
            return std::nullopt;
        }
        const SizesLeft found = sizes_left(model, *result.without);
        if (k == 0) {
            part = found.u.unaryExpr([](double u) { return u > 0.0 ? u : 1.0; });
        }
        const Eigen::VectorXd left = found.sizes.cwiseQuotient(part);
        if (k > 0) {
            const Eigen::VectorXd taken = inverse * (before - left);
            if (const double of_change = change.dot(taken); of_change != 0.0) {
                inverse += (change - taken) * (change.transpose() * inverse) / of_change;
            }
        }
        change = inverse * left;
        before = left;
        const Eigen::VectorXd sizes = change.cwiseProduct(part);
        result.sizes += sizes;
        if (!result.sizes.allFinite()) {
            return std::nullopt;
        }
        const Eigen::ArrayXd tolerance = (k_settled * result.sizes.array().abs()).max(k_settled_of_u * found.u.array());
        if ((sizes.array().abs() <= tolerance).all()) {
            return result;
        }
    }
    return std::nullopt;
}

}  // namespace gumcert::engine
