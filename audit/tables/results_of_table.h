#pragma once

#include <vector>

#include "audit/sentence.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/table_so_far.h"

namespace gumcert::audit {

/// What stands beside the value of a result under u or the contributions: u_c, or U where k says so. Nobody may know: that is said, and
/// the table is open.
void settle_result_line(const SheetView& sheet, TableSoFar& table, std::vector<Sentence>& not_read);

/// Brings statements and rows of a table to the units that an audit takes, and reads what the words of rows say in them. A row of which
/// no uncertainty was read is missing, unless the others make up what is stated.
void settle_statements(TableSoFar& table, std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
