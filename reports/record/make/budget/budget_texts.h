#pragma once

#include <optional>
#include <string>

#include "reports/record/shown.h"

namespace gumcert::reports {

// Numbers of a budget as its record prints them beside the unrounded ones.

/// A number with a few significant digits.
[[nodiscard]] std::string rounded(double value, int digits);
/// A value beside a standard uncertainty: digits down to those of u; all of them where u is 0.
[[nodiscard]] std::string printed_estimate(double value, double u);
/// A number that a person wrote, after it went to SI and back: 15 digits at most, without the traces of conversion.
[[nodiscard]] std::string as_stated(double value);
/// Probability of a test; "< 0.0001" below that.
[[nodiscard]] std::string printed_p_value(double p);
/// Degrees of freedom, none where they are infinite, as a certificate prints them; "–" for NaN, where none can be stated.
[[nodiscard]] Shown<std::optional<double>> shown_degrees_of_freedom(double nu);

}  // namespace gumcert::reports
