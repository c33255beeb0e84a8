#include "gum/quantity/decimal_rounding.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace gumcert::gum {

double decimal_rounding(double value) {
    constexpr int k_digits = 53;
    constexpr std::uint64_t k_short = (std::uint64_t{1} << 12U) - 1;  // the last 12 bits are 0
    if (value == 0.0 || !std::isfinite(value)) {
        return 0.0;
    }
    if (value == std::floor(value) && std::fabs(value) <= 0x1p53) {
        return 0.0;
    }
    int exponent = 0;
    const double mantissa = std::frexp(std::fabs(value), &exponent);
    const auto bits = static_cast<std::uint64_t>(std::ldexp(mantissa, k_digits));
    return (bits & k_short) == 0 ? 0.0 : std::ldexp(0.5, exponent - k_digits);
}

bool is_at_most(double a, double b, double scale) {
    // A limit and a value have each passed a conversion of unit or two, and a limit with a guard band one operation more.
    constexpr double k_roundings = 16.0;
    return a <= b + k_roundings * std::numeric_limits<double>::epsilon() * std::abs(scale);
}

}  // namespace gumcert::gum
