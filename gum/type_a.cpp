#include "gum/type_a.h"

#include <cmath>

#include "gum/argument_check.h"

namespace gumcert::gum {

double u_of_mean(double standard_deviation, std::size_t observations) {
    require_not_negative(standard_deviation, "standard deviation");
    if (observations == 0) {
        refuse("GC-GUM-0020", "number of observations", "0", "a mean needs at least 1 observation",
               "Give the observations, or state the uncertainty as a Type B evaluation.");
    }
    return standard_deviation / std::sqrt(static_cast<double>(observations));
}

}  // namespace gumcert::gum
