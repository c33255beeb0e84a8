#pragma once

namespace gumcert::text {

/// The digits that every number of double precision holds: 0.3 of 0.1 + 0.2, and of what two conversions leave behind a decimal number.
inline constexpr int k_digits_held = 15;

/// The number that significant() prints: the nearest one of so many significant digits.
/// \param digits  1 to 17
[[nodiscard]] double rounded_number(double value, int digits);

}  // namespace gumcert::text
