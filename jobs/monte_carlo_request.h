#pragma once

#include <cstdint>
#include <optional>

#include "gum/monte_carlo/monte_carlo_request.h"
#include "jobs/input_text.h"
#include "jobs/job_fields.h"

namespace gumcert::jobs {

class JsonObject;
class ProblemList;

inline constexpr double k_largest_seed = 9007199254740992.0;  ///< 2^53: up to it every integer has a double
inline constexpr NumberRange k_trials{
    .low = 1.0, .high = 1e10, .hint = "a job has at most 10000000000 trials; 1000000 is usual"};

inline constexpr double k_least_adaptive_trials = 1e4;  ///< one block of the adaptive procedure

/// What `monte_carlo` says of adaptive trials.
struct AdaptiveStatement {
    std::optional<int> digits;
    std::optional<std::uint64_t> most_trials;
};

/// `monte_carlo` of a job of any kind.
struct MonteCarloStatement {
    gum::MonteCarloRequest request;
    AdaptiveStatement adaptive;
};

template <class Archive>
void describe(Archive& a, AdaptiveStatement& r) {
    a("digits", r.digits, Whole{between(1.0, 2.0, "")}, "As digits of monte_carlo; stated in one place.");
    a("max_trials", r.most_trials, Whole{k_trials, k_least_adaptive_trials},
      "The procedure ends here at the latest; 1000000000 when left out.");
}

template <class Archive>
void describe(Archive& a, MonteCarloStatement& r) {
    a("trials", r.request.trials, Whole{k_trials}, "A fixed number of trials, in place of adaptive ones.");
    a.part("adaptive", r.adaptive, "Trials until the results are stable (JCGM 101:2008, 7.9).");
    a("seed", r.request.seed, Whole{between(0.0, k_largest_seed, "")}, "Of the random numbers; 1 when left out.");
    a("validate", r.request.validate, Truth{},
      "Whether the law of propagation is validated (JCGM 101:2008, clause 8); false when left out.");
    a("digits", r.request.digits, Whole{between(1.0, 2.0, "")}, "Significant digits of u that are to be stable.");
}

/// The key `monte_carlo` of a job.
/// \param coverage_probability  the largest one that the job asks for: coverage intervals need more trials for it
/// \param digits                of u that count where the job does not say
/// \return nothing when the job does not ask for Monte Carlo
[[nodiscard]] std::optional<gum::MonteCarloRequest> read_monte_carlo(const JsonObject& root,
                                                                     double coverage_probability, int digits,
                                                                     ProblemList& problems);

}  // namespace gumcert::jobs
