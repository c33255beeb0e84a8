#pragma once

#include <span>
#include <string>
#include <vector>

#include "reports/record/shown.h"

namespace gumcert::reports {

// Numbers of a budget as its record prints them beside the unrounded ones.

/// A number with a few significant digits.
[[nodiscard]] std::string rounded(double value, int digits);
/// A value beside a standard uncertainty: digits down to those of u; all of them where u is 0.
[[nodiscard]] std::string printed_estimate(double value, double u);
/// A number that a person wrote, after it went to SI and back: 15 digits at most, without the traces of conversion.
[[nodiscard]] std::string as_stated(double value);
/// Numbers of one series that a person wrote, as as_stated() but without exponents below 1e15, all with as many decimals as
/// the one that has the most: a reading of 10.10 beside one of 10.12 keeps the resolution of its display. Where that would
/// be more than 18, each has its own.
/// \param least  decimals with which one of them is known to have been written
[[nodiscard]] std::vector<std::string> series_as_stated(std::span<const double> values, int least = 0);
/// Probability of a test, on its side of the levels 5 % and 1 %: 0.0498 and not 0.050; "< 0.0001" below that.
[[nodiscard]] std::string printed_p_value(double p);
/// Degrees of freedom, none where they are infinite, as a certificate prints them; "–" for NaN, where none can be stated.
[[nodiscard]] Shown<std::optional<double>> shown_degrees_of_freedom(double nu);

}  // namespace gumcert::reports
