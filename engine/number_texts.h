#pragma once

#include <string>

namespace gumcert::engine {

// Numbers in messages; a result is rounded by gum/rounding.h.

/// The fewest digits that read back as the same double.
[[nodiscard]] std::string shortest_text(double value);
/// So many significant digits at most, with an exponent for very large and very small numbers.
[[nodiscard]] std::string significant_text(double value, int digits);
/// So many decimals, without exponent.
[[nodiscard]] std::string fixed_text(double value, int decimals);
/// An angle in degrees as the file of a job has it: "22.5°".
[[nodiscard]] std::string degrees_text(double degrees);

}  // namespace gumcert::engine
