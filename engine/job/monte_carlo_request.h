#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gumcert::engine {

/// `monte_carlo` of a job of any kind.
struct MonteCarloRequest {
    std::optional<std::uint64_t> trials;  ///< fixed number; else adaptive
    int digits = 2;                       ///< significant digits of u, for `adaptive` and `validate`
    std::uint64_t most_trials = 1'000'000'000;
    std::uint64_t seed = 1;
    bool validate = false;
    std::string where;
};

}  // namespace gumcert::engine
