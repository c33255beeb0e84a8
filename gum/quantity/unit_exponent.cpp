#include "gum/quantity/unit_exponent.h"

#include <cmath>

namespace gumcert::gum {

std::optional<UnitExponent> unit_exponent(double value) {
    constexpr double k_rounding = 1e-9;
    for (int denominator = 1; denominator <= k_largest_denominator; ++denominator) {
        const double numerator = std::round(value * denominator);
        if (std::abs(value * denominator - numerator) < k_rounding * denominator &&
            std::abs(numerator) <= static_cast<double>(k_largest_exponent * denominator)) {
            return UnitExponent{static_cast<int>(numerator), denominator};
        }
    }
    return std::nullopt;
}

std::string exponent_text(const UnitExponent& exponent) {
    const std::string numerator = std::to_string(exponent.numerator);
    return exponent.denominator == 1 ? numerator : "(" + numerator + "/" + std::to_string(exponent.denominator) + ")";
}

bool is_of_a_unit(const Dimension& dimension) {
    for (std::size_t i = 0; i < Dimension::k_base_units; ++i) {
        if (!unit_exponent(dimension.exponent(i))) {
            return false;
        }
    }
    return true;
}

}  // namespace gumcert::gum
