#include "gum/monte_carlo/monte_carlo_request.h"

namespace gumcert::gum {

MonteCarloOptions monte_carlo_options(const MonteCarloRequest& asked, unsigned threads, const Progress& progress) {
    // The numerical error has to be small against the tolerance where the law of propagation is validated
    // (JCGM 101:2008, 8.2).
    constexpr double k_validation_divisor = 5.0;
    MonteCarloOptions options;
    options.seed = asked.seed;
    options.threads = threads;
    if (progress) {
        options.progress = [progress](double done) {
            progress("Monte Carlo, " + std::to_string(static_cast<int>(100.0 * done)) + " %");
        };
    }
    if (asked.trials) {
        options.trials = *asked.trials;
    } else {
        options.adaptive = AdaptiveTrials{.digits = asked.digits,
                                          .most_trials = asked.most_trials,
                                          .tolerance_divisor = asked.validate ? k_validation_divisor : 1.0};
    }
    return options;
}

}  // namespace gumcert::gum
