#pragma once

#include <vector>

#include "audit/sentence.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/table_so_far.h"

namespace gumcert::audit {

/// A line that states a correlation: "Correlation r(T1; T2)" and a number, or "r(T1; T2) = 0.6". What has a coefficient, a
/// divisor or a distribution is a row whatever its name.
/// \param table  with heads; gets what the line states
[[nodiscard]] bool note_correlation(const SheetView& sheet, const SheetView::Row& row, TableSoFar& table);

/// Gives the correlations that were noted to the rows of a table that was read.
void settle_correlations(const SheetView& sheet, TableSoFar& table, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
