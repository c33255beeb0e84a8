#pragma once

#include <optional>
#include <string>

#include "gum/quantity/unit.h"

namespace gumcert::gum {

inline constexpr int k_largest_exponent = 99;
inline constexpr int k_largest_denominator = 9;

/// An exponent of a unit: a fraction in lowest terms, denominator 1 to `k_largest_denominator`, size up to
/// `k_largest_exponent`.
struct UnitExponent {
    int numerator = 1;
    int denominator = 1;

    friend bool operator==(const UnitExponent&, const UnitExponent&) = default;
};

/// The fraction that a number is within rounding of a few operations; nothing where no exponent of a unit is.
[[nodiscard]] std::optional<UnitExponent> unit_exponent(double value);

/// "2", "-1", "(1/2)", "(-3/2)".
[[nodiscard]] std::string exponent_text(const UnitExponent& exponent);

/// Whether all exponents of a dimension are those that a unit can have; others come from x^0.37.
[[nodiscard]] bool is_of_a_unit(const Dimension& dimension);

}  // namespace gumcert::gum
