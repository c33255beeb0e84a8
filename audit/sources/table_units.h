#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
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

/// The units of the numbers of one row, as their cells, heads and unit columns state them; "" where nothing does.
struct RowUnits {
    std::string estimate, stated, u, sensitivity, contribution;
};

/// Brings the rows of a table to what AuditedRow asks for: estimate, what is divided and u to the unit of the row,
/// contributions to that of the result, and sensitivity coefficients to the one per the other.
///
/// A contribution without a unit of its own is in the unit of the result, unless most rows that are added up with c = 1 are in
/// another one. A coefficient without a unit is a number of the unit of the contribution per the unit of the row; where the
/// contribution follows from both units being honoured, as 12 nm from 1 times 0.012 µm, it is a number without dimension.
/// \param rows   numbers as they stand there; changed
/// \param units  one for each row
/// \param not_read  gets what could not be brought to another unit, and is not used
/// \return false where a row has no uncertainty left that could be used, so that the others do not make up u_c
[[nodiscard]] bool settle_units(std::vector<AuditedRow>& rows, const std::vector<RowUnits>& units,
                                const std::string& result_unit, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
