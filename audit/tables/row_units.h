#pragma once

#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"

namespace gumcert::audit {

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
