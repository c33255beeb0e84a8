#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "gum/monte_carlo_request.h"

namespace gumcert::engine {

class JsonObject;
class ProblemList;

/// The keys of `monte_carlo` of a job of any kind.
inline constexpr std::array<std::string_view, 5> k_monte_carlo_keys{"trials", "adaptive", "seed", "validate", "digits"};
inline constexpr std::array<std::string_view, 2> k_adaptive_keys{"digits", "max_trials"};

inline constexpr double k_largest_seed = 9007199254740992.0;  ///< 2^53: up to it every integer has a double

/// The key `monte_carlo` of a job.
/// \param coverage_probability  the largest one that the job asks for: coverage intervals need more trials for it
/// \param digits                of u that count where the job does not say
/// \return nothing when the job does not ask for Monte Carlo
[[nodiscard]] std::optional<gum::MonteCarloRequest> read_monte_carlo(const JsonObject& root,
                                                                     double coverage_probability, int digits,
                                                                     ProblemList& problems);

}  // namespace gumcert::engine
