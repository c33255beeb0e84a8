#pragma once

#include <string>
#include <vector>

#include "audit/tables/foreign_table.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"

namespace gumcert::audit {

/// Reads the tables of one part of a sheet from top to bottom.
/// \param titles  gets the line of words above each budget that is found, or ""
void read_tables(const SheetView& sheet, const TablePart& part, const std::string& name, ForeignTables& tables,
                 std::vector<std::string>& titles);

}  // namespace gumcert::audit
