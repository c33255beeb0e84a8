#include "engine/job/monte_carlo_request.h"

#include <algorithm>
#include <cmath>

#include "engine/job/json_object.h"
#include "engine/job/problem_list.h"
#include "text/numbers.h"

namespace gumcert::engine {

namespace {

constexpr double k_most_trials = 1e10;

void check_trials(const JsonObject& object, double count, double p, ProblemList& problems) {
    const double least = 100.0 / (1.0 - p);
    const double recommended = 1e4 / (1.0 - p);
    // Nobody meant a fraction of a trial: 10⁴/(1 − 0.99) is a million, whatever the rounding of 1 − 0.99.
    constexpr double k_rounding = 1.0 - 1e-9;
    if (count < least * k_rounding) {
        object.refuse(
            k_too_few_trials, "trials", text::shortest_plain(count) + " trials",
            "a coverage interval for p = " + text::shortest_plain(p) +
                " needs at least 100/(1 - p) = " + text::shortest_plain(std::ceil(least * k_rounding)) + " trials",
            "state at least 10000/(1 - p) = " + text::shortest_plain(std::ceil(recommended * k_rounding)) + " trials");
    } else if (count < recommended * k_rounding) {
        problems.warn(k_warn_few_trials, object.where("trials"), text::shortest_plain(count) + " trials",
                      "at p = " + text::shortest_plain(p) + ", at least 10000/(1 - p) = " +
                          text::shortest_plain(std::ceil(recommended * k_rounding)) + " trials are recommended",
                      "state more trials");
    }
}

}  // namespace

std::optional<gum::MonteCarloRequest> read_monte_carlo(const JsonObject& root, double coverage_probability,
                                                       int usual_digits, ProblemList& problems) {
    const auto object = root.optional_object("monte_carlo", k_monte_carlo_keys);
    if (!object) {
        return std::nullopt;
    }
    const double p = coverage_probability;
    gum::MonteCarloRequest request;
    request.where = object->where();
    const NumberRange trials{
        .low = 1.0, .high = k_most_trials, .hint = "a job has at most 10000000000 trials; 1000000 is usual"};
    const auto digits = object->optional_integer("digits", between(1.0, 2.0, ""));
    request.digits = static_cast<int>(digits.value_or(usual_digits));
    request.seed =
        static_cast<std::uint64_t>(object->optional_integer("seed", between(0.0, k_largest_seed, "")).value_or(1));
    request.validate = object->optional_boolean("validate").value_or(false);
    if (object->has("trials") && object->has("adaptive")) {
        object->refuse(k_trials_and_adaptive, "adaptive", "\"trials\" and \"adaptive\" are given together",
                       "the number of trials is fixed or adaptive", "keep one of them");
    }
    if (const auto count = object->optional_integer("trials", trials)) {
        request.trials = static_cast<std::uint64_t>(*count);
        check_trials(*object, static_cast<double>(*count), p, problems);
    }
    if (const auto adaptive = object->optional_object("adaptive", k_adaptive_keys)) {
        const auto own = adaptive->optional_integer("digits", between(1.0, 2.0, ""));
        if (own && digits && *own != *digits) {
            adaptive->refuse(
                k_trials_and_adaptive, "digits",
                "digits is " + std::to_string(*own) + " here and " + std::to_string(*digits) + " in monte_carlo",
                "one number of significant digits holds for both", "keep one of them");
        }
        request.digits = static_cast<int>(own.value_or(request.digits));
        if (const auto most = adaptive->optional_integer("max_trials", trials)) {
            request.most_trials = static_cast<std::uint64_t>(*most);
            // One block of the adaptive procedure is the least that there is.
            const double least = std::max(1e4, 100.0 / (1.0 - p));
            if (static_cast<double>(*most) < least) {
                adaptive->refuse(k_too_few_trials, "max_trials",
                                 text::shortest_plain(static_cast<double>(*most)) + " trials",
                                 "the adaptive procedure takes at least " + text::shortest_plain(std::ceil(least)) +
                                     " trials at p = " + text::shortest_plain(p),
                                 "state a larger number, such as 1000000000");
            }
        }
    }
    return request;
}

}  // namespace gumcert::engine
