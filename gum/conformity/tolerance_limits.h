#pragma once

#include <optional>
#include <string>

namespace gumcert::gum {

/// Limits of a specification, or of the values that are accepted: one or both (JCGM 106:2012, 3.3).
struct ToleranceLimits {
    std::optional<double> lower = {}, upper = {};

    [[nodiscard]] bool two_sided() const { return lower && upper; }
};

/// Why these cannot be tolerance limits, as a phrase ("no limit"); "" when they can: one or both, finite, lower <
/// upper.
[[nodiscard]] std::string limits_problem(const ToleranceLimits& limits);

/// \throws InputError  GC-GUM-0080 if `limits_problem` finds one
void require_limits(const ToleranceLimits& limits);

}  // namespace gumcert::gum
