#pragma once

#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/sentence.h"
#include "audit/tables/row_units.h"
#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"
#include "audit/tables/table_so_far.h"

namespace gumcert::audit {

/// Whether a line below heads is a row of the table. A quantity may be named "p" or "k", and a line of a result may have several
/// numbers, each under its head: what is added up has a coefficient, or something that is divided.
/// \param table  with heads
[[nodiscard]] bool is_row(const SheetView& sheet, const SheetView::Row& row, TableSoFar& table);

/// Whether the only number of a line is an estimate: a constant has no uncertainty.
[[nodiscard]] bool is_constant(const SheetView& sheet, const SheetView::Row& row, const Heads& heads);

/// A row whose numbers could not be evaluated is still a row: its divisor and formulas are looked at.
[[nodiscard]] bool has_formula_of_uncertainty(const SheetView::Row& row, const Heads& heads);

/// One row of a table as it stands there.
struct ReadRow {
    AuditedRow row = {};
    RowUnits units = {};
    bool has_open_number = false;          ///< it has a number of which nobody can know the decimal sign
    std::vector<std::string> unread = {};  ///< places and words of cells in which a number of the sum should stand
    /// One of them should have an uncertainty, and holds digits: "≈ 0.10", and not "< 0.01" or "negligible".
    bool lost_amount = false;
};
[[nodiscard]] ReadRow read_row(const SheetView& sheet, const Heads& heads, const SheetView::Row& row,
                               std::vector<Sentence>& not_read);

}  // namespace gumcert::audit
