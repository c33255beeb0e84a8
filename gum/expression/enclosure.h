#pragma once

#include <optional>

#include "gum/expression/operation.h"

namespace gumcert::gum {

/// All numbers from `low` to `high`: what a quantity may be, with every rounding on the outside.
///
/// The four rules of arithmetic and the root are those of Boost.Interval, computed in the ordinary rounding mode and
/// widened by one unit in the last place on either side: no rounding mode is changed, so nothing has to be put back and
/// no compiler may move an operation past such a change. Elementary functions are widened by k_library_ulps, more
/// than their error was found to be (ADR 0058: 2 ulp at most for those used here).
struct Enclosure {
    double low = 0.0, high = 0.0;

    [[nodiscard]] bool contains(double value) const { return low <= value && value <= high; }
    [[nodiscard]] bool is_zero() const { return low == 0.0 && high == 0.0; }
    /// Both ends finite: what is not is no enclosure that anything can be said of.
    [[nodiscard]] bool is_finite() const;
    /// Largest and smallest |x| within.
    [[nodiscard]] double largest() const;
    [[nodiscard]] double smallest() const;
};
inline constexpr int k_library_ulps = 4;

[[nodiscard]] inline Enclosure enclosure_of(double value) {
    return {value, value};
}
[[nodiscard]] Enclosure operator-(const Enclosure& a);
[[nodiscard]] Enclosure operator+(const Enclosure& a, const Enclosure& b);
[[nodiscard]] Enclosure operator-(const Enclosure& a, const Enclosure& b);
/// 0 times anything is 0, also where the other is not finite: a derivative is harmless in a direction in which nothing
/// moves.
[[nodiscard]] Enclosure operator*(const Enclosure& a, const Enclosure& b);
/// Not finite where b contains 0.
[[nodiscard]] Enclosure operator/(const Enclosure& a, const Enclosure& b);
/// x² of one number, not the product of two.
[[nodiscard]] Enclosure square(const Enclosure& a);

/// The values of a step of a tape over all of its operands. Nothing where the step has no value, or no derivative,
/// somewhere among them: a quotient by 0, a root, logarithm or power of what may be negative, asin beyond ±1, a pole of
/// tan, the cut of atan2, abs at 0, min and max of what may be equal.
[[nodiscard]] std::optional<Enclosure> enclose(Operation operation, const Enclosure& a, const Enclosure& b);

/// Values of a step with its first and second partial derivatives by its operands.
struct EnclosedStep {
    Enclosure value, da, db, daa, dab, dbb;
};
/// \return nothing where one of them is not finite, or enclose() gives none
[[nodiscard]] std::optional<EnclosedStep> enclose_with_partials(Operation operation, const Enclosure& a,
                                                                const Enclosure& b);

}  // namespace gumcert::gum
