#include "gum/argument_check.h"

#include <cmath>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/numbers.h"

namespace gumcert::gum {

void refuse(std::string code, std::string where, std::string what, std::string rule, std::string action) {
    throw InputError(Diagnostic{.code = std::move(code),
                                .where = std::move(where),
                                .what = std::move(what),
                                .rule = std::move(rule),
                                .action = std::move(action)});
}

void require_finite(double value, const std::string& name) {
    if (!std::isfinite(value)) {
        refuse("GC-GUM-0001", name, text::shortest(value), "must be a finite number", "Correct the value.");
    }
}

void require_not_negative(double value, const std::string& name) {
    require_finite(value, name);
    if (value < 0.0) {
        refuse("GC-GUM-0002", name, text::shortest(value), "must not be negative", "Correct the sign or the value.");
    }
}

void require_positive(double value, const std::string& name) {
    require_finite(value, name);
    if (value <= 0.0) {
        refuse("GC-GUM-0003", name, text::shortest(value), "must be greater than 0", "Correct the value.");
    }
}

void require_probability(double value, const std::string& name) {
    // Both ends excluded, because a quantile may be infinite there; and written so that a NaN is refused.
    if (!(value > 0.0 && value < 1.0)) {
        refuse("GC-GUM-0004", name, text::shortest(value), "must lie between 0 and 1, both excluded",
               "State it as a fraction, e.g. 0.9545 for 95.45 %.");
    }
}

void require_degrees_of_freedom(double value, const std::string& name) {
    if (!(value > 0.0)) {
        // Infinity stands for a variance that is known.
        refuse("GC-GUM-0005", name, text::shortest(value), "degrees of freedom must be greater than 0 or infinite",
               "Correct the value, or leave it out where it is infinite.");
    }
}

}  // namespace gumcert::gum
