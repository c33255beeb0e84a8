#include "gum/type_b.h"

#include <cmath>

#include "gum/argument_check.h"

namespace gumcert::gum {

double u_from_half_width(double half_width) {
    require_not_negative(half_width, "half width");
    return half_width / std::sqrt(3.0);
}

double u_from_resolution(double step) {
    require_not_negative(step, "resolution");
    // Every value that shows the same digit is equally probable: a rectangle of half-width step/2.
    return step / std::sqrt(12.0);
}

}  // namespace gumcert::gum
