#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "gum/quantity/measurement_model.h"
#include "gum/quantity/unit.h"

namespace gumcert::gum {

/// Which trials: those that run_monte_carlo drew for one output.
struct TrialsOfOutput {
    std::shared_ptr<const MeasurementModel> model;
    Eigen::Index output = 0;
    Unit unit;  ///< of the result
    std::uint64_t seed = 1;
    std::vector<std::uint64_t> streams;  ///< as MonteCarloOptions::streams
    std::uint64_t trials = 0;
    unsigned threads = 1;
};

/// Distribution of an output as its trials give it.
struct TrialDistribution {
    std::function<double(double)> function;  ///< share of the trials with y ≤ x, x in the unit of the result
    std::function<double(double)> below;     ///< with y < x; trials that differ from x by roundings alone are at x
    std::uint64_t counted = 0;               ///< trials
};

constexpr std::uint64_t k_most_counted_trials = std::uint64_t{1} << 24;  // 128 MiB

/// Draws the trials once more, to the last bit the same ones, and counts: no cells of a histogram come between the
/// trials and a conformance probability. Of more than k_most_counted_trials the first ones are taken.
[[nodiscard]] TrialDistribution count_trials(const TrialsOfOutput& of);

/// Exponent α of the tails P(|Y − median| > a) ~ a^−α, with its standard error; infinite where there is no tail to be seen.
struct TailIndex {
    double exponent = 0.0, standard_error = 0.0;

    /// Above, or below a value by more than two standard errors; neither where the trials leave it open.
    [[nodiscard]] bool is_above(double value) const { return exponent - 2.0 * standard_error > value; }
    [[nodiscard]] bool is_below(double value) const { return exponent + 2.0 * standard_error < value; }
};

/// From the largest deviations of the trials, a thousandth of them but 50 to 4000 (Hill 1975, Ann. Statist. 3, 1163-1174);
/// from fewer and larger ones where these thin out faster: a clipped distribution has a step there, and no tail.
[[nodiscard]] TailIndex tail_index(const TrialsOfOutput& of);

}  // namespace gumcert::gum
