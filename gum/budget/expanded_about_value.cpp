#include "gum/budget/expanded_about_value.h"

#include <algorithm>
#include <cmath>

#include "gum/monte_carlo/trial_distribution.h"

namespace gumcert::gum {

double expanded_about_value(const BudgetPointResult& point, std::size_t output, double p) {
    constexpr int k_halvings = 100;
    const BudgetOutputResult& of = point.outputs[output];
    const MonteCarloOutput& trials = *of.monte_carlo;
    const TrialDistribution distribution = count_trials({.model = point.model,
                                                         .output = static_cast<Eigen::Index>(output),
                                                         .unit = {},
                                                         .seed = point.monte_carlo->seed,
                                                         .streams = point.streams,
                                                         .trials = of.trials});
    const auto holds = [&](double U) {
        return distribution.function(trials.mean + U) - distribution.below(trials.mean - U) >= p;
    };
    double most = std::max(trials.symmetric.high - trials.mean, trials.mean - trials.symmetric.low);
    while (most > 0.0 && std::isfinite(most) && !holds(most)) {
        most *= 2.0;
    }
    double least = 0.0;
    for (int i = 0; i < k_halvings; ++i) {
        const double middle = 0.5 * (least + most);
        (holds(middle) ? most : least) = middle;
    }
    return most;
}

}  // namespace gumcert::gum
