#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "gum/monte_carlo/monte_carlo.h"
#include "gum/quantity/progress.h"

namespace gumcert::gum {

/// Monte Carlo as somebody asks for it.
struct MonteCarloRequest {
    std::optional<std::uint64_t> trials;  ///< fixed number; else adaptive
    int digits = 2;                       ///< significant digits of u, for adaptive trials and for `validate`
    std::uint64_t most_trials = 1'000'000'000;
    std::uint64_t seed = 1;
    bool validate = false;  ///< whether the law of propagation has to be validated (JCGM 101:2008, clause 8)
    std::string where;      ///< place to name in messages
};

/// Trials, seed and threads as they are asked for, and the receiver of their progress; nothing else is set.
[[nodiscard]] MonteCarloOptions monte_carlo_options(const MonteCarloRequest& asked, unsigned threads,
                                                    const Progress& progress);

}  // namespace gumcert::gum
