#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/tables/sheet_view.h"
#include "audit/words/column_heads.h"

namespace gumcert::audit {

/// Which column of the sheet has which meaning, and where the units of its numbers stand.
struct Heads {
    std::map<Column, std::uint32_t> columns;
    std::map<Column, std::string> units;             ///< that heads state: "u [µm]"
    std::map<Column, std::uint32_t> unit_columns;    ///< of columns that have one of their own, to their right
    std::map<Column, std::uint32_t> type_b;          ///< where those of type A have a column of their own beside it
    std::map<std::uint32_t, std::string> all_units;  ///< that heads state, by column of the sheet
    std::optional<std::uint32_t> marks_a, marks_b;   ///< columns of marks, which say of what type a row is
    std::optional<std::pair<std::uint32_t, std::uint32_t>> limits;  ///< lower and upper, of what nothing else divides
    std::optional<std::uint32_t> description;    ///< column of words beside a column of symbols, or the other way round
    bool in_other_language = false;              ///< than those in which words of rows are read
    std::vector<const workbook::Cell*> second;   ///< heads of columns of numbers whose meaning another one has
    std::vector<const workbook::Cell*> unknown;  ///< heads within the table or beside it whose meaning nobody knows
};

/// Whether the numbers of a column have units.
[[nodiscard]] bool has_numbers_with_units(Column column);

/// The heads of a table, where a row has them; nothing of other rows.
[[nodiscard]] std::optional<Heads> heads_of(const SheetView& sheet, const SheetView::Row& row);

/// Whether a row heads a table of results, "quantity | value | U | k": no budget, and no line of the one above it.
[[nodiscard]] bool heads_results(const SheetView& sheet, const SheetView::Row& row);

/// Rows of a sheet that are read together.
struct TablePart {
    SheetView::Rows rows;
    std::string point = {};  ///< "10 V": of a table of several points, what its columns are of
};
/// The rows of a sheet in parts that are read one after the other: all of them, unless tables stand beside each other. Then
/// each table has its own columns, from the statements above it to those below. A table that has u, or the contributions, of
/// several points beside each other, "u (1 V)" and "u (10 V)", is a table of each point: with its columns, and those that the
/// points share.
[[nodiscard]] std::vector<TablePart> parts_of(const SheetView& sheet);

/// A table with its rows in columns: heads below each other, which name the quantities, one of u, the contributions, or what is
/// divided and by what. Nothing where a sheet has none, or heads in rows as well.
[[nodiscard]] std::optional<TurnedBlock> turned_block(const SheetView& sheet);

/// Of a sheet without a table that could be read: the row of it that comes nearest to heads.
struct NearestHeads {
    std::uint32_t row = 0, column = 0;
    std::vector<std::string> known, unknown;  ///< texts of its cells
    bool has_quantity = false;
};
[[nodiscard]] std::optional<NearestHeads> nearest_heads(const SheetView& sheet);

}  // namespace gumcert::audit
