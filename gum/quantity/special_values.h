#pragma once

#include <limits>

namespace gumcert::gum {

/// Without an upper bound: degrees of freedom of what is stated, limits that are not there.
inline constexpr double k_infinity = std::numeric_limits<double>::infinity();
/// No number: what has no value.
inline constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
/// Distance from 1 to the next number, 2.2e-16.
inline constexpr double k_epsilon = std::numeric_limits<double>::epsilon();

}  // namespace gumcert::gum
