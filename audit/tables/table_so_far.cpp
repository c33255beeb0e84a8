#include "audit/tables/table_so_far.h"

#include <algorithm>

#include "audit/claims.h"
#include "text/visible_text.h"

namespace gumcert::audit {

using workbook::Cell;
using workbook::CellKind;

bool TableSoFar::follows_from_rows() const {
    const ClaimCheck check = check_claims(budget);
    const bool is_stated = budget.claims.u_c || budget.claims.U;
    return is_stated && check.allowed && !check.u_c_outside && (budget.claims.u_c || !check.U_outside);
}

void note_unread(const SheetView& sheet, const SheetView::Row& row, TableSoFar& table,
                 std::vector<Sentence>& not_read) {
    const bool has_number = std::any_of(
        row.begin() + 1, row.end(), [&sheet](const Cell* cell) { return sheet.number_with_unit(*cell).has_value(); });
    const std::uint32_t line = row.front()->address.row;
    if (!has_number || sheet.value(*row.front()).kind != CellKind::text) {
        return;
    }
    if (!table.last_unread || line > *table.last_unread + 1) {
        not_read.push_back(
            say("{cell}: {text} has a number, and is no row and no statement that is known; it is not used",
                sheet.place(row.front()->address), text::in_quotes(sheet.words(*row.front()))));
    }
    table.last_unread = line;
}

}  // namespace gumcert::audit
