#pragma once

#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "audit/tables/stated_results.h"

namespace gumcert::audit {

/// Whether a u_c or U in percent, ppm or µm/m can be held against rows in a unit: as a part of a value that is stated, and not 0.
/// A Celsius temperature has no parts.
/// \param value  in `unit`
[[nodiscard]] bool has_parts(const std::optional<StatedNumber>& value, const std::string& unit);

/// Takes a u_c and U that are stated as parts of the value only, or of a budget of parts in the unit of the value only, where the rows
/// give them: as numbers in the unit of the budget. One
/// that is called relative and is of the size of what the rows give is taken, too, so that its error is found; any other may be
/// a part of something else, as of a full scale, and is asked about. One that stands beside a number in the unit is held against
/// that.
/// \param budget  with its rows settled
void take_parts_of_value(AuditedBudget& budget, const Statements& statements, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
