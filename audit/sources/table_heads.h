#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "audit/sources/budget_words.h"
#include "audit/sources/sheet_view.h"

namespace gumcert::audit {

/// Which column of the sheet has which meaning, and where the units of its numbers stand.
struct Heads {
    std::map<Column, std::uint32_t> columns;
    std::map<Column, std::string> units;             ///< that heads state: "u [µm]"
    std::map<Column, std::uint32_t> unit_columns;    ///< of columns that have one of their own, to their right
    std::map<std::uint32_t, std::string> all_units;  ///< that heads state, by column of the sheet
    std::optional<std::uint32_t> description;    ///< column of words beside a column of symbols, or the other way round
    std::vector<const workbook::Cell*> second;   ///< heads of columns of numbers whose meaning another one has
    std::vector<const workbook::Cell*> unknown;  ///< heads within the table or beside it whose meaning nobody knows
};

/// Whether the numbers of a column have units.
[[nodiscard]] bool has_numbers_with_units(Column column);

/// The heads of a table, where a row has them; nothing of other rows.
[[nodiscard]] std::optional<Heads> heads_of(const SheetView& sheet, const SheetView::Row& row);

/// The rows of a sheet in parts that are read one after the other: all of them, unless tables stand beside each other. Then
/// each table has its own columns, from the statements above it to those below.
[[nodiscard]] std::vector<SheetView::Rows> parts_of(const SheetView& sheet);

}  // namespace gumcert::audit
