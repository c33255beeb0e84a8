#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/unit_exponent.h"
#include "gum/quantity/unit_table.h"

namespace gumcert::gum {

/// One name in a unit, with the exponent that it has in the whole.
struct UnitFactor {
    std::string_view text;  ///< the name as it was written, with its prefix
    NamedUnit named;
    UnitExponent exponent;
};

/// A number in a unit, such as the 1e-6 of "1e-6/K": mantissa · 10^exp10, to a whole power.
struct UnitNumber {
    std::int64_t mantissa = 1;
    int exp10 = 0;
    int power = 1;  ///< with the powers of the parentheses around it
};

/// A unit read: a product of numbers and names. Views into the text that was read.
struct UnitExpression {
    std::vector<UnitNumber> numbers;
    std::vector<UnitFactor> factors;  ///< in the order of the text
    bool quotient = false;            ///< there is a / in it
    bool plain = true;                ///< no power of parentheses, no parentheses or quotient inside of others
};

/// Why a text is no unit.
struct UnitRefusal {
    enum class Reason { not_known, malformed, exponent, number, quotient } reason = Reason::malformed;
    std::string what, action;
    std::string cure;  ///< the whole text as it is most probably meant, which is a unit; "" where that is not known
};

/// Reads a unit:
///
///     unit     = [number] factors { "/" factor }        a second factor behind "/" needs parentheses: J/(kg K)
///     factors  = factor { sign factor }                 sign: blank, "*", ".", "·"
///     factor   = name [exponent] | "(" unit ")" ["^" exponent]
///     exponent = whole number behind the name, "^" or "**": m2, s-1, m^2 — or m², or a fraction: Hz^(1/2)
///     number   = decimal number, or one to a whole power: 1, 100, 1e-6, 10^-6; at the beginning only
///
/// \return what was read, or the refusal
struct UnitReading {
    UnitExpression expression;
    std::optional<UnitRefusal> refusal;
};
[[nodiscard]] UnitReading read_unit_expression(std::string_view text);

}  // namespace gumcert::gum
