#include "jobs/monte_carlo_request.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "jobs/job_reader.h"
#include "jobs/json_object.h"
#include "jobs/problem_list.h"
#include "text/numbers.h"

namespace gumcert::jobs {

namespace {

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
    const auto object = root.optional_object("monte_carlo", keys_of<MonteCarloStatement>());
    if (!object) {
        return std::nullopt;
    }
    const double p = coverage_probability;
    MonteCarloStatement stated;
    gum::MonteCarloRequest& request = stated.request;
    request.where = object->where();
    request.digits = usual_digits;
    JobReader reader(*object);
    reader.read(stated, {"digits"});
    reader.read(stated, {"seed", "validate"});
    if (object->has("trials") && object->has("adaptive")) {
        object->refuse(k_trials_and_adaptive, "adaptive", "\"trials\" and \"adaptive\" are given together",
                       "the number of trials is fixed or adaptive", "keep one of them");
    }
    reader.read(stated, {"trials"});
    if (request.trials) {
        check_trials(*object, static_cast<double>(*request.trials), p, problems);
    }
    if (const auto adaptive = object->optional_object("adaptive", keys_of<AdaptiveStatement>())) {
        JobReader of_adaptive(*adaptive);
        of_adaptive.read(stated.adaptive, {"digits"});
        const std::optional<int> own = stated.adaptive.digits;
        if (own && reader.accepted("digits") && *own != request.digits) {
            adaptive->refuse(
                k_trials_and_adaptive, "digits",
                "digits is " + std::to_string(*own) + " here and " + std::to_string(request.digits) + " in monte_carlo",
                "one number of significant digits holds for both", "keep one of them");
        }
        request.digits = own.value_or(request.digits);
        of_adaptive.read(stated.adaptive, {"max_trials"});
        if (const std::optional<std::uint64_t> most = stated.adaptive.most_trials) {
            request.most_trials = *most;
            const double least = std::max(k_least_adaptive_trials, 100.0 / (1.0 - p));
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

}  // namespace gumcert::jobs
