#include "audit/sources/table_heads.h"

#include <algorithm>
#include <cstddef>
#include <set>
#include <utility>

#include "audit/sources/table_units.h"

namespace gumcert::audit {
namespace {

using Rows = SheetView::Rows;
using workbook::Cell;
using workbook::CellKind;
using workbook::CellValue;

/// Where the tables beside each other begin in a row of heads, which is where its quantities are headed again: the columns of
/// all but the first. Empty where there is one table, or none.
std::vector<std::uint32_t> further_tables(const SheetView& sheet, const SheetView::Row& row) {
    std::vector<std::uint32_t> columns;
    auto begin = row.begin();
    for (auto at = row.begin(); at != row.end(); ++at) {
        const CellValue held = sheet.value(**at);
        const bool is_quantity = held.kind == CellKind::text && column_of(held.text) == Column::quantity;
        // A symbol beside a description are two columns of one table: what stands on each side has to be heads by itself.
        if (is_quantity && heads_of(sheet, {begin, at}) && heads_of(sheet, {at, row.end()})) {
            columns.push_back((*at)->address.column);
            begin = at;
        }
    }
    return columns;
}

/// Heads that stand apart from the table, behind an empty column, are of something else.
void keep_unknown_of_table(Heads& heads, const SheetView::Row& row) {
    std::set<std::uint32_t> headed;
    for (const Cell* cell : row) {
        headed.insert(cell->address.column);
    }
    std::uint32_t first = heads.columns.begin()->second, last = first;
    for (const auto& [column, position] : heads.columns) {
        first = std::min(first, position);
        last = std::max(last, position);
    }
    while (headed.contains(last + 1)) {
        ++last;
    }
    while (first > 0 && headed.contains(first - 1)) {
        --first;
    }
    std::erase_if(heads.unknown, [first, last](const Cell* cell) {
        return cell->address.column < first || cell->address.column > last;
    });
}

}  // namespace

bool has_numbers_with_units(Column column) {
    return column == Column::estimate || column == Column::stated || column == Column::u ||
           column == Column::sensitivity || column == Column::contribution;
}

std::optional<Heads> heads_of(const SheetView& sheet, const SheetView::Row& row) {
    Heads heads;
    std::vector<std::pair<std::optional<Column>, std::uint32_t>> owned;  // unit columns, and the column before each
    std::optional<Column> before;
    for (const Cell* cell : row) {
        const CellValue held = sheet.value(*cell);
        if (held.kind != CellKind::text) {
            continue;
        }
        const std::optional<Column> column = column_of(held.text);
        if (!column) {
            before.reset();
            if (!is_unused_column(held.text)) {
                heads.unknown.push_back(cell);
            }
            continue;
        }
        if (*column == Column::unit) {
            owned.emplace_back(before, cell->address.column);
        }
        if (heads.columns.emplace(*column, cell->address.column).second) {
            heads.units[*column] = unit_in_head(held.text);
            heads.all_units[cell->address.column] = heads.units[*column];
        } else if (*column == Column::quantity && !heads.description) {
            heads.description = cell->address.column;
        } else if (*column == Column::quantity || has_numbers_with_units(*column) || *column == Column::divisor ||
                   *column == Column::nu) {
            heads.second.push_back(cell);
        }
        before = column;
    }
    // One column of units holds those of the rows; of several, each holds those of the numbers before it.
    for (const auto& [column, position] : owned) {
        if (owned.size() > 1 && column && has_numbers_with_units(*column)) {
            heads.unit_columns.emplace(*column, position);
        }
    }
    const auto has = [&heads](Column column) { return heads.columns.contains(column); };
    const bool uncertainty = has(Column::u) || has(Column::stated) || has(Column::contribution);
    // "name | limit" heads many tables: what is divided needs a third column, as that of the divisors.
    const bool is_alone = heads.columns.size() < 3 && !has(Column::u) && !has(Column::contribution);
    if (!has(Column::quantity) || !uncertainty || is_alone) {
        return std::nullopt;
    }
    keep_unknown_of_table(heads, row);
    return heads;
}

std::vector<SheetView::Rows> parts_of(const SheetView& sheet) {
    const Rows& rows = sheet.rows();
    std::vector<std::uint32_t> heads;  // rows
    std::map<std::uint32_t, std::vector<std::uint32_t>> beside;
    for (const auto& [number, row] : rows) {
        if (heads_of(sheet, row)) {
            heads.push_back(number);
            if (std::vector<std::uint32_t> columns = further_tables(sheet, row); !columns.empty()) {
                beside.emplace(number, std::move(columns));
            }
        }
    }
    if (beside.empty()) {
        return {rows};
    }
    std::vector<Rows> parts;
    for (std::size_t i = 0; i < heads.size(); ++i) {
        const auto first = i == 0 ? rows.begin() : rows.find(heads[i]);
        const auto last = i + 1 == heads.size() ? rows.end() : rows.find(heads[i + 1]);
        const auto columns = beside.find(heads[i]);
        const std::vector<std::uint32_t> starts =
            columns == beside.end() ? std::vector<std::uint32_t>() : columns->second;
        std::vector<Rows> tables(starts.size() + 1);
        for (auto at = first; at != last; ++at) {
            for (const Cell* cell : at->second) {
                const auto start = std::upper_bound(starts.begin(), starts.end(), cell->address.column);
                tables[static_cast<std::size_t>(start - starts.begin())][at->first].push_back(cell);
            }
        }
        for (Rows& table : tables) {
            parts.push_back(std::move(table));
        }
    }
    return parts;
}

}  // namespace gumcert::audit
