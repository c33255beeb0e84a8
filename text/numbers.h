#pragma once

#include <span>
#include <string>

namespace gumcert::text {

/// Numbers as text for messages, files and drawings: never by the locale, never "-0". What is measured or computed and
/// stands in a document is rounded by gum/rounding.

/// The fewest digits from which the same number is read back (std::to_chars): "0.1", "1e+05", "inf", "NaN".
/// Accuracy: reads back as the same double (docs/accuracy.md#rounding-and-printing).
/// Example: examples/api/records.cpp
[[nodiscard]] std::string shortest(double value);
/// The same without an exponent where people read it, from `least` up to 1e15: "100000".
[[nodiscard]] std::string shortest_plain(double value, double least = 1e-4);
/// At most `digits` significant digits, with an exponent where that is shorter: "1.23", "1.2e-07".
[[nodiscard]] std::string significant(double value, int digits);
/// `decimals` digits behind the point: "1.50".
[[nodiscard]] std::string fixed(double value, int decimals);

/// The most decimals with which one of some numbers is written: "1.50" has 2, "7" has 0. A power of ten moves the point,
/// "1.50e-3" has 5, "2e3" none, and a number with more digits than a person writes has those of 15 digits. At most 340.
[[nodiscard]] int most_decimals(std::span<const std::string> numbers);

/// "1.50" as "1.5", "2.0" as "2"; a text without a point, or with an exponent, as it is.
[[nodiscard]] std::string without_trailing_zeros(std::string number);

}  // namespace gumcert::text
