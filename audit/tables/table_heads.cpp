#include "audit/tables/table_heads.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "audit/tables/limits_of_rows.h"
#include "audit/words/column_heads.h"
#include "audit/words/named_statement.h"
#include "audit/words/unit_words.h"

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
        const bool is_quantity = sheet.head(**at).column == Column::quantity;
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

/// The unit of the first number below a head, in its cell or in the column of units; "" where it has none.
std::string unit_below(const SheetView& sheet, const SheetView::Row& row, const Heads& heads, const Cell& head) {
    constexpr std::size_t k_most = 3;  // lines without a number
    auto at = sheet.rows().upper_bound(row.back()->address.row);
    for (std::size_t looked = 0; at != sheet.rows().end() && looked < k_most; ++at, ++looked) {
        const Cell* cell = cell_in(at->second, head.address.column);
        const std::optional<NumberWithUnit> number = cell == nullptr ? std::nullopt : sheet.number_with_unit(*cell);
        if (number) {
            const auto units = heads.columns.find(Column::unit);
            const Cell* of_row = units == heads.columns.end() ? nullptr : cell_in(at->second, units->second);
            const std::string shown = sheet.as_shown(*number, *cell).unit;  // "%" of a format is one
            return shown.empty() && of_row != nullptr ? sheet.words(*of_row) : shown;
        }
    }
    return "";
}

/// Whether the cells below a head have words, and no numbers.
bool has_words_below(const SheetView& sheet, const SheetView::Row& row, const Cell& head) {
    constexpr std::size_t k_most = 5;  // lines
    std::uint32_t last = 0;
    for (const Cell* cell : row) {
        last = std::max(last, cell->address.row);
    }
    std::size_t words = 0, numbers = 0, looked = 0;
    for (auto at = sheet.rows().upper_bound(last); at != sheet.rows().end() && looked < k_most; ++at, ++looked) {
        if (const Cell* cell = cell_in(at->second, head.address.column)) {
            const bool is_number = sheet.number_with_unit(*cell).has_value();
            numbers += is_number ? 1U : 0U;
            words += !is_number && !sheet.words(*cell).empty() ? 1U : 0U;
        }
    }
    return words > numbers;
}

/// "Uncertainty contribution | … | Contribution / nm": the first one heads the names of contributions, where words stand below it.
void take_first_contribution_for_quantity(const SheetView& sheet, const SheetView::Row& row, Heads& heads) {
    const auto contribution = heads.columns.find(Column::contribution);
    if (heads.columns.contains(Column::quantity) || contribution == heads.columns.end()) {
        return;
    }
    const auto head = std::find_if(row.begin(), row.end(), [&contribution](const Cell* cell) {
        return cell->address.column == contribution->second;
    });
    // "u_c | 0.5 | mg" is a statement, and its symbol that of contributions.
    const bool has_number = std::any_of(
        row.begin(), row.end(), [&sheet](const Cell* cell) { return sheet.number_with_unit(*cell).has_value(); });
    const bool is_first =
        !has_number && heads.columns.size() > 1 && std::all_of(row.begin(), head, [&sheet](const Cell* cell) {
            return is_unused_column(sheet.words(*cell)) || sheet.words(*cell).empty();
        });
    if (head == row.end() || !is_first || !has_words_below(sheet, row, **head)) {
        return;
    }
    heads.columns.erase(contribution);
    heads.units.erase(Column::contribution);
    heads.columns.emplace(Column::quantity, (*head)->address.column);
    heads.units[Column::quantity] = "";
    const auto second = std::find_if(heads.second.begin(), heads.second.end(), [&sheet](const Cell* cell) {
        return column_of(sheet.words(*cell)) == Column::contribution;
    });
    if (second != heads.second.end()) {
        const std::uint32_t column = (*second)->address.column;
        heads.columns.emplace(Column::contribution, column);
        heads.units[Column::contribution] = unit_in_head(sheet.words(**second));
        heads.all_units[column] = heads.units[Column::contribution];
        heads.second.erase(second);
    }
}

/// Whether the words below a head are those of groups of rows, which a column beside it names one by one: "Reference | Certificate",
/// "Reference | Drift". They stand again, or are left out, and the others are more different words.
bool heads_groups(const SheetView& sheet, const SheetView::Row& row, const Cell& head, std::uint32_t beside) {
    constexpr std::size_t k_most = 200, k_least_repeated = 2;
    std::set<std::string> groups, names;
    std::size_t repeated = 0, looked = 0;
    std::uint32_t last = row.back()->address.row;
    for (auto at = sheet.rows().upper_bound(last); at != sheet.rows().end() && looked < k_most; ++at, ++looked) {
        if (at->first > last + 2) {
            break;  // two empty lines
        }
        last = at->first;
        const Cell *group = cell_in(at->second, head.address.column), *name = cell_in(at->second, beside);
        const std::string of_group = group == nullptr ? "" : sheet.words(*group),
                          of_name = name == nullptr ? "" : sheet.words(*name);
        const bool is_new = !of_group.empty() && groups.insert(of_group).second;
        if (!of_name.empty()) {
            names.insert(of_name);
            repeated += is_new ? 0U : 1U;
        }
    }
    return repeated >= k_least_repeated && names.size() > groups.size();
}

/// What is taken for a head where no other one is: relative uncertainties in place of u, and the first column of the table as
/// its quantities, where u or contributions and what they come from are headed beside it.
void take_relative_and_first(const SheetView& sheet, const SheetView::Row& row, Heads& heads) {
    const auto has = [&heads](Column column) { return heads.columns.contains(column); };
    const auto take = [&heads](Column column, const Cell* cell, const std::string& unit) {
        heads.columns.emplace(column, cell->address.column);
        heads.units[column] = unit;
        heads.all_units[cell->address.column] = unit;
        std::erase(heads.unknown, cell);
    };
    // A relative u beside contributions in percent; weights stand beside those in the unit of the result.
    const bool may_be_relative = !has(Column::contribution) || is_unit_of_part(heads.units.at(Column::contribution));
    const bool has_contribution = has(Column::contribution);
    const Cell* of_contributions = has_contribution ? cell_in(row, heads.columns.at(Column::contribution)) : nullptr;
    const bool has_contributions_of_parts =
        may_be_relative ||
        (of_contributions != nullptr && is_unit_of_part(unit_below(sheet, row, heads, *of_contributions)));
    const std::vector<const Cell*> unknown =
        has(Column::u) ? std::vector<const Cell*>() : std::vector<const Cell*>(heads.unknown);
    for (const Cell* cell : unknown) {
        const std::string held = sheet.words(*cell);
        const bool is_symbol = is_relative_symbol(held);
        const std::string below = is_symbol ? "" : unit_below(sheet, row, heads, *cell);
        const std::optional<Column> column = relative_column_of(held, is_unit_of_part(below) ? below : "");
        if (column && (*column == Column::u || *column == Column::contribution) && !has(*column) &&
            (is_symbol ? may_be_relative : !has_contribution || (*column == Column::u && has_contributions_of_parts))) {
            take(*column, cell, unit_in_head(held));
        } else if (is_symbol && !has(Column::u) && !has_contribution &&
                   is_unit_of_part(unit_below(sheet, row, heads, *cell))) {
            take(Column::u, cell, "");
        }
    }
    take_first_contribution_for_quantity(sheet, row, heads);
    const bool is_budget = (has(Column::u) || has(Column::contribution)) &&
                           (has(Column::divisor) || has(Column::distribution) || has(Column::sensitivity));
    // "Source | Standard uncertainty / mm": where it comes from is what it is. Beside values, or U, it is a list of results.
    const bool has_source_of_u = has(Column::source) && !has(Column::estimate) && !has(Column::stated) &&
                                 (has(Column::u) || has(Column::contribution));
    if (has(Column::quantity) || (!is_budget && !has_source_of_u)) {
        return;
    }
    for (const Cell* cell : row) {
        const CellValue held = sheet.value(*cell);
        if (held.kind != CellKind::text) {
            return;
        }
        const auto source = heads.columns.find(Column::source);
        if (source != heads.columns.end() && source->second == cell->address.column) {
            heads.columns.erase(source);
            take(Column::quantity, cell, "");
            return;
        }
        if (is_budget && std::find(heads.unknown.begin(), heads.unknown.end(), cell) != heads.unknown.end()) {
            if (source != heads.columns.end() && heads_groups(sheet, row, *cell, source->second)) {
                std::erase(heads.unknown, cell);
                continue;
            }
            take(Column::quantity, cell, "");
            return;
        }
        if (!is_unused_column(held.text)) {
            return;  // "No." may stand before the quantities, a column of numbers may not
        }
    }
}

/// A column of k directly behind U, with u of the rows beside them, divides the one to give the other. Without u, "U | k" heads a table of results.
void take_k_for_divisor(const SheetView& sheet, Heads& heads) {
    const auto has = [&heads](Column column) { return heads.columns.contains(column); };
    if (has(Column::divisor) || !has(Column::stated) || (!has(Column::u) && !has(Column::contribution))) {
        return;
    }
    const std::uint32_t behind = heads.columns.at(Column::stated) + 1;
    const auto k = std::find_if(heads.unknown.begin(), heads.unknown.end(), [&sheet, behind](const Cell* cell) {
        return cell->address.column == behind && statement_of(sheet.words(*cell)) == Statement::k;
    });
    if (k != heads.unknown.end()) {
        heads.columns.emplace(Column::divisor, (*k)->address.column);
        heads.units[Column::divisor] = "";
        heads.unknown.erase(k);
    }
}

/// "x", "✓", "yes" in a column of a type.
bool is_mark(const std::string& text) {
    constexpr std::ptrdiff_t k_longest = 3;
    const auto letters = std::count_if(text.begin(), text.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    return !says_nothing(text) && letters <= k_longest && text.find_first_of("0123456789") == std::string::npos;
}

/// Whether columns of both types have marks in the rows below their heads, and no numbers.
bool have_marks(const SheetView& sheet, const SheetView::Row& heads, std::uint32_t a, std::uint32_t b) {
    constexpr std::size_t k_most = 2'000;  // rows of a table
    std::uint32_t last = 0;
    for (const Cell* head : heads) {
        last = std::max(last, head->address.row);
    }
    std::size_t marks = 0, numbers = 0, looked = 0;
    for (auto at = sheet.rows().upper_bound(last); at != sheet.rows().end() && looked < k_most; ++at, ++looked) {
        if (at->first > last + 2) {
            break;  // two empty lines
        }
        last = at->first;
        for (const std::uint32_t column : {a, b}) {
            const Cell* cell = cell_in(at->second, column);
            const std::string held = cell == nullptr ? "" : sheet.words(*cell);
            if (typed_head(held)) {
                return marks > numbers;  // those of the next table
            }
            numbers += cell != nullptr && sheet.number_with_unit(*cell) ? 1U : 0U;
            marks += is_mark(held) ? 1U : 0U;
        }
    }
    return marks > numbers;
}

/// Columns of one kind for both types, "u (Type A)" beside "u (Type B)": each row has its number in one of them, or a mark.
void take_types_beside(const SheetView& sheet, const SheetView::Row& row, Heads& heads) {
    std::map<Column, std::vector<std::pair<TypedHead, const Cell*>>> typed;
    for (const Cell* cell : row) {
        const CellValue held = sheet.value(*cell);
        if (std::optional<TypedHead> head =
                held.kind == CellKind::text ? typed_head(held.text) : std::optional<TypedHead>()) {
            typed[head->column].emplace_back(std::move(*head), cell);
        }
    }
    for (const auto& [column, cells] : typed) {
        if (cells.size() != 2 || cells[0].first.is_a == cells[1].first.is_a) {
            continue;
        }
        const auto is_one_of_them = [&cells = cells](std::uint32_t position) {
            return position == cells[0].second->address.column || position == cells[1].second->address.column;
        };
        const auto headed = heads.columns.find(column);
        if (headed != heads.columns.end() && !is_one_of_them(headed->second)) {
            continue;
        }
        if (const auto type = heads.columns.find(Column::type);
            type != heads.columns.end() && is_one_of_them(type->second)) {
            heads.columns.erase(type);
        }
        if (have_marks(sheet, row, cells[0].second->address.column, cells[1].second->address.column)) {
            if (headed != heads.columns.end()) {
                heads.columns.erase(headed);
            }
            for (const auto& [head, cell] : cells) {
                (head.is_a ? heads.marks_a : heads.marks_b) = cell->address.column;
                std::erase(heads.second, cell);
                std::erase(heads.unknown, cell);
            }
            continue;
        }
        for (const auto& [head, cell] : cells) {
            (head.is_a ? heads.columns : heads.type_b)[column] = cell->address.column;
            heads.all_units[cell->address.column] = head.unit;
            std::erase(heads.second, cell);
            std::erase(heads.unknown, cell);
        }
        heads.units[column] = heads.all_units[heads.columns.at(column)];
    }
}

/// Of a row of heads: the columns of each of several points, in the order of the points; empty where it has one point, or nobody can
/// tell which.
struct PointColumns {
    std::vector<std::string> points;
    std::vector<std::set<std::uint32_t>> columns;
};
PointColumns points_beside(const SheetView& sheet, const SheetView::Row& row) {
    std::map<Column, std::vector<const Cell*>> heads;
    for (const Cell* cell : row) {
        const std::optional<Column> column = sheet.head(*cell).column;
        if (column && (*column == Column::u || *column == Column::contribution || *column == Column::stated)) {
            heads[*column].push_back(cell);
        }
    }
    PointColumns beside;
    for (const Column column : {Column::u, Column::contribution, Column::stated}) {
        const std::vector<const Cell*>& cells = heads[column];
        if (cells.size() < 2) {
            continue;
        }
        std::vector<std::string> points;
        for (const Cell* cell : cells) {
            points.push_back(point_in_head(sheet.words(*cell)));
        }
        const std::set<std::string> different(points.begin(), points.end());
        if (different.size() != points.size() || different.contains("") ||
            (!beside.points.empty() && beside.points != points) ||
            (beside.points.empty() && column == Column::stated)) {
            return {};
        }
        beside.points = points;
        beside.columns.resize(points.size());
        for (std::size_t i = 0; i < cells.size(); ++i) {
            beside.columns[i].insert(cells[i]->address.column);
        }
    }
    return beside;
}

/// Rows of a table as one of several points has them.
Rows rows_of_point(const Rows& rows, const PointColumns& beside, std::size_t point) {
    Rows kept;
    for (const auto& [number, row] : rows) {
        for (const Cell* cell : row) {
            bool is_of_other = false;
            for (std::size_t i = 0; i < beside.columns.size(); ++i) {
                is_of_other = is_of_other || (i != point && beside.columns[i].contains(cell->address.column));
            }
            if (!is_of_other) {
                kept[number].push_back(cell);
            }
        }
    }
    return kept;
}

}  // namespace

bool has_numbers_with_units(Column column) {
    return column == Column::estimate || column == Column::stated || column == Column::u ||
           column == Column::sensitivity || column == Column::contribution;
}

std::optional<Heads> heads_of(const SheetView& sheet, const SheetView::Row& row) {
    Heads heads;
    std::vector<std::pair<std::optional<Column>, std::uint32_t>> owned;  // unit columns, and the column before each
    const auto names = [&sheet, &row](Column column) {
        return std::any_of(row.begin(), row.end(),
                           [&](const Cell* cell) { return sheet.head(*cell).column == column; });
    };
    // Without one of these no line is one of heads, whatever else it has; most lines are none.
    if (!names(Column::quantity) && !names(Column::divisor) && !names(Column::distribution) &&
        !names(Column::sensitivity) && !names(Column::contribution) && !(names(Column::source) && names(Column::u))) {
        return std::nullopt;
    }
    std::optional<Column> before;
    for (const Cell* cell : row) {
        const auto& [is_text, headed] = sheet.head(*cell);
        if (!is_text) {
            continue;
        }
        const std::string held = sheet.words(*cell);
        heads.in_other_language = heads.in_other_language || is_of_other_language(held);
        // "u(x_i) | c_i | u_i": behind u and a coefficient u_i is that of the result.
        const auto is_of_result = [](const std::string& head) {
            return head.starts_with("u_i") || head.starts_with("ui");
        };
        const bool is_contribution = headed == Column::u && heads.columns.contains(Column::u) && is_of_result(held) &&
                                     heads.columns.contains(Column::sensitivity) && !names(Column::contribution) &&
                                     !is_of_result(sheet.words(*cell_in(row, heads.columns.at(Column::u))));
        const std::optional<Column> column = is_contribution ? Column::contribution : headed;
        if (!column) {
            before.reset();
            if (!is_unused_column(held)) {
                heads.unknown.push_back(cell);
            }
            continue;
        }
        if (*column == Column::unit) {
            owned.emplace_back(before, cell->address.column);
        }
        // "U_i | k_i | u_i": of two symbols in one row of heads the large one is of what is divided. Behind a coefficient the small
        // one is of the contribution: "Uncertainty u(x_i) | c_i | u(x_i) c_i".
        const Cell* of_u = *column == Column::u && held.starts_with('u') && heads.columns.contains(Column::u) &&
                                   !heads.columns.contains(Column::stated) &&
                                   !heads.columns.contains(Column::sensitivity)
                               ? cell_in(row, heads.columns.at(Column::u))
                               : nullptr;
        if (of_u != nullptr && sheet.words(*of_u).starts_with('U')) {
            heads.columns[Column::stated] = of_u->address.column;
            heads.units[Column::stated] = heads.units[Column::u];
            heads.columns.erase(Column::u);
        }
        if (heads.columns.emplace(*column, cell->address.column).second) {
            heads.units[*column] = unit_in_head(held);
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
    take_types_beside(sheet, row, heads);
    take_relative_and_first(sheet, row, heads);
    take_k_for_divisor(sheet, heads);
    take_limits(sheet, row, heads);
    const auto has = [&heads](Column column) { return heads.columns.contains(column); };
    const bool uncertainty = has(Column::u) || has(Column::stated) || has(Column::contribution);
    // "name | limit" heads many tables, and "name | value | unit | U" those of results: what is divided needs another column, as that
    // of the divisors.
    const bool is_explained =
        std::any_of(heads.columns.begin(), heads.columns.end(), [](const std::pair<const Column, std::uint32_t>& head) {
            return head.first != Column::quantity && head.first != Column::estimate && head.first != Column::unit &&
                   head.first != Column::stated;
        });
    const bool is_alone = !is_explained && !has(Column::u) && !has(Column::contribution);
    if (!has(Column::quantity) || !uncertainty || is_alone) {
        return std::nullopt;
    }
    keep_unknown_of_table(heads, row);
    return heads;
}

bool heads_results(const SheetView& sheet, const SheetView::Row& row) {
    std::set<Column> columns;
    for (const Cell* cell : row) {
        if (sheet.head(*cell).is_text) {
            if (const std::optional<Column> column = sheet.head(*cell).column) {
                columns.insert(*column);
            }
        } else if (sheet.value(*cell).kind == CellKind::number) {
            return false;
        }
    }
    return columns.contains(Column::stated) && columns.contains(Column::estimate) && !heads_of(sheet, row);
}

std::vector<TablePart> parts_of(const SheetView& sheet) {
    const Rows& rows = sheet.rows();
    std::vector<std::uint32_t> heads;  // rows
    std::map<std::uint32_t, std::vector<std::uint32_t>> beside;
    std::map<std::uint32_t, PointColumns> points;
    for (const auto& [number, row] : rows) {
        if (heads_of(sheet, row)) {
            heads.push_back(number);
            if (std::vector<std::uint32_t> columns = further_tables(sheet, row); !columns.empty()) {
                beside.emplace(number, std::move(columns));
            } else if (PointColumns of_points = points_beside(sheet, row); !of_points.points.empty()) {
                points.emplace(number, std::move(of_points));
            }
        }
    }
    std::vector<TablePart> parts;
    if (beside.empty() && points.empty()) {
        parts.push_back({.rows = rows});
        return parts;
    }
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
        if (const auto of_points = points.find(heads[i]); of_points != points.end()) {
            for (std::size_t point = 0; point < of_points->second.points.size(); ++point) {
                parts.push_back({.rows = rows_of_point(tables.front(), of_points->second, point),
                                 .point = of_points->second.points[point]});
            }
            continue;
        }
        for (Rows& table : tables) {
            parts.push_back({.rows = std::move(table)});
        }
    }
    return parts;
}

namespace {

/// Cells with anything to the right of a column.
std::size_t filled_behind(const SheetView& sheet, const SheetView::Row& row, std::uint32_t column) {
    return static_cast<std::size_t>(std::count_if(row.begin(), row.end(), [&](const Cell* cell) {
        return cell->address.column > column && !sheet.words(*cell).empty();
    }));
}

/// Whether a line is a head of a turned table: it has something for most of its quantities, or is one that may be blank.
bool is_turned_head(const std::string& text, Column column, std::size_t filled, std::size_t quantities) {
    const std::optional<Statement> statement = statement_of(text);
    const bool is_statement = statement == Statement::nu_eff || statement == Statement::k ||
                              (statement == Statement::u_c && column != Column::u);
    const bool may_be_blank = column == Column::comment || column == Column::source || column == Column::nu;
    return !is_statement && (5 * filled >= 3 * quantities || (may_be_blank && filled > 0));
}

/// Whether a sheet names a combined standard uncertainty.
bool states_combined(const SheetView& sheet) {
    return std::any_of(sheet.rows().begin(), sheet.rows().end(), [&sheet](const auto& line) {
        return std::any_of(line.second.begin(), line.second.end(), [&sheet](const Cell* cell) {
            const CellValue held = sheet.value(*cell);
            return held.kind == CellKind::text && statement_of(held.text) == Statement::u_c &&
                   column_of(held.text) != Column::u;
        });
    });
}

}  // namespace

std::optional<TurnedBlock> turned_block(const SheetView& sheet) {
    constexpr std::uint32_t k_most_columns_before = 10;
    constexpr std::size_t k_least_quantities = 2, k_least_heads = 3;
    const Rows& rows = sheet.rows();
    for (std::uint32_t column = 1; column <= k_most_columns_before; ++column) {
        for (auto names = rows.begin(); names != rows.end(); ++names) {
            const Cell* corner = cell_in(names->second, column);
            const std::string held = corner == nullptr ? "" : sheet.words(*corner);
            const std::size_t quantities = filled_behind(sheet, names->second, column);
            if ((!held.empty() && column_of(held) != Column::quantity) || quantities < k_least_quantities) {
                continue;
            }
            std::set<Column> heads = {Column::quantity};
            std::uint32_t last = names->first, width = names->second.back()->address.column;
            for (auto line = std::next(names); line != rows.end() && line->first == last + 1; ++line) {
                const Cell* cell = cell_in(line->second, column);
                const std::string text = cell == nullptr ? "" : sheet.words(*cell);
                const std::optional<Column> of = column_of(text);
                if (!of || !is_turned_head(text, *of, filled_behind(sheet, line->second, column), quantities) ||
                    !heads.insert(*of).second) {
                    break;
                }
                last = line->first;
                width = std::max(width, line->second.back()->address.column);
            }
            const bool has_u = heads.contains(Column::u) || heads.contains(Column::contribution);
            const bool is_divided = heads.contains(Column::stated) && heads.contains(Column::divisor);
            // Value, unit and u alone may be those of results.
            const bool is_of_budget = heads.contains(Column::divisor) || heads.contains(Column::distribution) ||
                                      heads.contains(Column::sensitivity) || heads.contains(Column::contribution) ||
                                      heads.contains(Column::type) || states_combined(sheet);
            if (heads.size() >= k_least_heads && (has_u || is_divided) && is_of_budget) {
                return TurnedBlock{.first = {.row = names->first, .column = column},
                                   .last = {.row = last, .column = width}};
            }
        }
    }
    return std::nullopt;
}

std::optional<NearestHeads> nearest_heads(const SheetView& sheet) {
    constexpr std::size_t k_least = 2;
    std::optional<NearestHeads> nearest;
    for (const auto& [number, row] : sheet.rows()) {
        NearestHeads heads{.row = number, .column = row.front()->address.column, .known = {}, .unknown = {}};
        for (const Cell* cell : row) {
            const CellValue held = sheet.value(*cell);
            if (held.kind != CellKind::text || held.text.empty()) {
                continue;
            }
            const std::optional<Column> column = column_of(held.text);
            (column ? heads.known : heads.unknown).push_back(held.text);
            heads.has_quantity = heads.has_quantity || column == Column::quantity;
        }
        if (heads.known.size() >= k_least && (!nearest || heads.known.size() > nearest->known.size())) {
            nearest = std::move(heads);
        }
    }
    return nearest;
}

}  // namespace gumcert::audit
