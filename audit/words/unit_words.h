#pragma once

#include <optional>
#include <string>

#include "gum/quantity/unit.h"

namespace gumcert::audit {

/// The unit that a table writes, "µm", "[nm/K]", "%"; nothing where the text is no unit that this program knows.
[[nodiscard]] std::optional<gum::Unit> known_unit(const std::string& text);

/// The unit that a head or the name of a statement has in it: "u [µm]", "u / nm", "result (mm)", "u in mm"; "" where it has
/// none. A number with a unit, "u (10 V)", is the point that the head is of.
[[nodiscard]] std::string unit_in_head(const std::string& head);

/// The unit that follows a number in its cell: "µm" of "µm, k = 2"; "" where what follows is none.
[[nodiscard]] std::string unit_in_rest(const std::string& rest);

/// The unit that a line of words states for all numbers of a table: "all values in mm", "Angaben in mbar"; "" where it states none.
[[nodiscard]] std::string unit_in_words(const std::string& line);

/// Whether a unit is that of a part of a value: "%", "ppm", "µm/m".
[[nodiscard]] bool is_unit_of_part(const std::string& unit);
/// Whether a unit is that of a part beside one that has a dimension.
[[nodiscard]] bool is_part_beside(const std::string& unit, const std::string& other);

/// What a number in one unit is multiplied by to be in another one, as a difference: °C and K are the same. 1 where both are
/// written alike, or one of them is not stated; nothing where one cannot be turned into the other.
[[nodiscard]] std::optional<double> factor_between(const std::string& from, const std::string& to);

/// The unit in which numbers in `of_difference` and a value in `of_value` stand beside each other: that of the difference,
/// but for a Celsius temperature, whose value would be another one in kelvin.
[[nodiscard]] std::string shared_unit(const std::string& of_difference, const std::string& of_value);

}  // namespace gumcert::audit
