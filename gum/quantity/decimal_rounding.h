#pragma once

namespace gumcert::gum {

/// How far the decimal number that a person wrote may be from the double that holds it: half a unit of the last binary
/// place. 0 where the double is the number itself: whole numbers up to 2^53 and short binary fractions (0.5, 12.25;
/// 41 significant bits or fewer, which a decimal fraction that is not one of them has once in 4000).
/// \param value  finite
[[nodiscard]] double decimal_rounding(double value);

/// Whether a ≤ b in decimal numbers: in binary a may lie a few roundings of numbers as large as `scale` beyond. Every
/// comparison of a value with a limit that somebody wrote down is made by this, or two of them contradict each other.
[[nodiscard]] bool is_at_most(double a, double b, double scale);

/// The part of a standard uncertainty that the rounding of numbers may reach unnoticed: U is printed with two digits.
inline constexpr double k_accepted_rounding = 0.05;

}  // namespace gumcert::gum
