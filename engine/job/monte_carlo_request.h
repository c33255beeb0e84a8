#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gumcert::engine {

class JsonObject;
class ProblemList;

/// `monte_carlo` of a job of any kind.
struct MonteCarloRequest {
    std::optional<std::uint64_t> trials;  ///< fixed number; else adaptive
    int digits = 2;                       ///< significant digits of u, for `adaptive` and `validate`
    std::uint64_t most_trials = 1'000'000'000;
    std::uint64_t seed = 1;
    bool validate = false;
    std::string where;
};

inline constexpr std::array<std::string_view, 5> k_monte_carlo_keys{"trials", "adaptive", "seed", "validate", "digits"};
inline constexpr std::array<std::string_view, 2> k_adaptive_keys{"digits", "max_trials"};

inline constexpr double k_largest_seed = 9007199254740992.0;  ///< 2^53: up to it every integer has a double

/// The key `monte_carlo` of a job.
/// \param coverage_probability  the largest one that the job asks for: coverage intervals need more trials for it
/// \param digits                of u that count where the job does not say
/// \return nothing when the job does not ask for Monte Carlo
[[nodiscard]] std::optional<MonteCarloRequest> read_monte_carlo(const JsonObject& root, double coverage_probability,
                                                                int digits, ProblemList& problems);

}  // namespace gumcert::engine
