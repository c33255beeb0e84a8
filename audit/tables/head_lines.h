#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "audit/tables/sheet_view.h"
#include "audit/tables/table_heads.h"
#include "workbook/workbook.h"

namespace gumcert::audit {

/// Cells of a line that are not blank.
[[nodiscard]] std::vector<const workbook::Cell*> cells_with_words(const SheetView& sheet, const SheetView::Row& row);
/// Whether a line has two texts or more, and no number.
[[nodiscard]] bool is_words_alone(const SheetView& sheet, const SheetView::Row& row);

/// The heads of a line, alone or together with those of the next one.
struct HeadsOfLines {
    std::optional<Heads> heads = {};
    bool are_two_lines = false;
};
/// \param joined  gets the cells of heads that stand in two lines; `heads` looks at them
[[nodiscard]] HeadsOfLines heads_at(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t line,
                                    std::deque<workbook::Cell>& joined);

/// Whether a line below heads has their symbols: "x_i | u(x_i) | c_i" (EA-4/02).
[[nodiscard]] bool repeats_heads(const SheetView& sheet, const Heads& heads, const SheetView::Row& row);
/// A line of units alone below heads: each column of numbers that has one there has it for all its rows.
[[nodiscard]] bool take_units(const SheetView& sheet, const SheetView::Row& row, Heads& heads);

/// The lines below one, up to an empty one, or to a line that has words alone.
[[nodiscard]] std::vector<SheetView::Row> lines_below(const SheetView& sheet, const SheetView::Rows& rows,
                                                      std::uint32_t line);

/// Gives columns the meaning that the numbers below their heads show, where it is not the first one that the heads name: "Value" of
/// what is divided, and "u_i" of contributions.
/// \param line  of the heads
void settle_meanings(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t line, Heads& heads);

}  // namespace gumcert::audit
