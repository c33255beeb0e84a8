#include "gum/conformity/tolerance_limits.h"

#include <cmath>

#include "gum/argument_check.h"
#include "text/numbers.h"

namespace gumcert::gum {

std::string limits_problem(const ToleranceLimits& limits) {
    if (!limits.lower && !limits.upper) {
        return "no tolerance limit";
    }
    if ((limits.lower && !std::isfinite(*limits.lower)) || (limits.upper && !std::isfinite(*limits.upper))) {
        return "a tolerance limit that is not a finite number";
    }
    if (limits.two_sided() && !(*limits.lower < *limits.upper)) {
        return "the lower limit " + text::shortest(*limits.lower) + " is not below the upper limit " +
               text::shortest(*limits.upper);
    }
    return "";
}

void require_limits(const ToleranceLimits& limits) {
    if (const std::string problem = limits_problem(limits); !problem.empty()) {
        refuse("GC-GUM-0080", "tolerance limits", problem, "one finite limit or two, the lower one below the upper one",
               "Correct the limits of the specification.");
    }
}

}  // namespace gumcert::gum
