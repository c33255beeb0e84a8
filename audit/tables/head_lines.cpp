#include "audit/tables/head_lines.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>

#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/tables/table_so_far.h"
#include "audit/words/column_heads.h"
#include "audit/words/unit_words.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;

/// Whether what stands below some heads are their symbols, "a_i | u(x_i) | c_i | u_i in µm" below "Influence | Limit | …": what would name
/// the rows of a table of its own stands below the head of something else.
bool is_second_line(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t number,
                    const std::optional<Heads>& heads) {
    const auto next = rows.find(number + 1);
    const std::optional<Heads> below =
        heads && next != rows.end() ? heads_of(sheet, next->second) : std::optional<Heads>();
    if (!below) {
        return false;
    }
    const std::uint32_t names = below->columns.at(Column::quantity);
    const bool is_headed = std::any_of(heads->columns.begin(), heads->columns.end(), [names](const auto& head) {
        return head.second == names && head.first != Column::quantity;
    });
    return is_headed && std::count_if(below->columns.begin(), below->columns.end(), [&heads](const auto& head) {
                            const auto above = heads->columns.find(head.first);
                            return above != heads->columns.end() && above->second == head.second;
                        }) > 1;
}

/// The head that two lines have together, where the upper one is a part of a word, or means nothing by itself, or where the lower one is
/// its unit.
std::optional<std::string> head_of_both(std::string upper, const std::string& lower) {
    if (upper.empty() || lower.empty()) {
        return std::nullopt;
    }
    bool is_cut = false;
    for (const std::string_view hyphen : {"-", "\u2010", "\u00AD"}) {
        if (upper.ends_with(hyphen)) {
            upper.resize(upper.size() - hyphen.size());
            is_cut = true;
        }
    }
    const bool is_unit = (lower.front() == '(' || lower.front() == '[') && column_of(upper) && !column_of(lower);
    if (!is_cut && !is_unit && column_of(upper)) {
        return std::nullopt;
    }
    std::string both = upper + (is_cut ? "" : " ") + lower;
    return column_of(both) ? std::optional(std::move(both)) : std::nullopt;
}

/// Heads of a line together with those of the next one, as of merged cells: in each column the one that is known, the lower
/// before the upper one, or both as one: "Standard-" above "unsicherheit", "Standard" above "uncertainty".
std::optional<Heads> heads_in_two_lines(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t number,
                                        const SheetView::Row& row, std::deque<Cell>& joined_cells) {
    const auto next = rows.find(number + 1);
    if (next == rows.end() || !is_words_alone(sheet, row) || !is_words_alone(sheet, next->second) ||
        (heads_of(sheet, next->second) && !is_second_line(sheet, rows, number, heads_of(sheet, row)))) {
        return std::nullopt;
    }
    std::map<std::uint32_t, const Cell*> columns;
    for (const SheetView::Row* line : {&row, &next->second}) {
        for (const Cell* cell : *line) {
            const Cell*& kept = columns[cell->address.column];
            const std::string lower = sheet.words(*cell);
            const std::optional<std::string> both =
                kept == nullptr ? std::nullopt : head_of_both(sheet.words(*kept), lower);
            const bool is_better =
                kept == nullptr || column_of(lower) || (!column_of(sheet.words(*kept)) && !lower.empty());
            if (both) {
                joined_cells.push_back(*cell);
                joined_cells.back().value = {.kind = CellKind::text, .text = *both};
                joined_cells.back().formula_kind = workbook::FormulaKind::none;
                kept = &joined_cells.back();
            } else {
                kept = is_better ? cell : kept;
            }
        }
    }
    SheetView::Row joined;
    for (const auto& [column, cell] : columns) {
        joined.push_back(cell);
    }
    return heads_of(sheet, joined);
}

/// Whether the line below heads has a name under that of the quantities: it is a row then, whatever its other cells may be read as.
bool names_row_below(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t number, const Heads& heads) {
    const auto next = rows.find(number + 1);
    const Cell* name = next == rows.end() ? nullptr : cell_in(next->second, heads.columns.at(Column::quantity));
    return name != nullptr && !says_nothing(sheet.words(*name));
}

class MeaningsOfColumns {
public:
    MeaningsOfColumns(const SheetView& sheet, const SheetView::Rows& rows, Heads& heads)
        : sheet_(sheet), rows_(rows), heads_(heads) {}

    /// "Value" beside a column of divisors is what is divided, where u of most rows is the quotient: the layout of UKAS M3003,
    /// without its ±.
    void take_value_for_stated(std::uint32_t line) {
        const auto has = [this](Column column) { return heads_.columns.contains(column); };
        if (!has(Column::estimate) || !has(Column::divisor)) {
            return;
        }
        std::size_t quotients = 0, others = 0, stated = 0;
        each_row_below(line, [&](const SheetView::Row& row) {
            stated += has(Column::stated) && number_below(row, Column::stated) ? 1U : 0U;
            const std::optional<StatedNumber> value = number_below(row, Column::estimate),
                                              divisor = number_below(row, Column::divisor),
                                              c = number_below(row, Column::sensitivity);
            std::optional<StatedNumber> u = number_below(row, Column::u);
            u = u ? u : number_below(row, Column::contribution);
            if (!value || !divisor || !u || !(divisor->value > 0.0) || !(std::abs(u->value) > 0.0)) {
                return;
            }
            const double part = std::abs(value->value) / divisor->value;
            const double weighted = c ? part * std::abs(c->value) : part;
            ++(is_printed_as(*u, part) || is_printed_as(*u, weighted) ? quotients : others);
        });
        // A column "±" of nothing but blanks heads none.
        if (stated == 0 && quotients > 1 && quotients > 2 * others) {
            heads_.columns.erase(Column::stated);
            heads_.units.erase(Column::stated);
            heads_.unit_columns.erase(Column::stated);
            rename_column(Column::estimate, Column::stated);
        }
    }
    /// A column headed "u_i" or "Standard uncertainty", without one of contributions beside it, holds u(x_i) or |c_i| u(x_i): what
    /// its rows divide, and their coefficients, tell which.
    void take_u_for_contribution(std::uint32_t line) {
        const auto has = [this](Column column) { return heads_.columns.contains(column); };
        if (!has(Column::u) || has(Column::contribution) || !has(Column::sensitivity) || !has(Column::stated)) {
            return;
        }
        std::size_t with_coefficient = 0, without = 0;
        each_row_below(line, [&](const SheetView::Row& row) {
            const std::optional<StatedNumber> u = number_below(row, Column::u),
                                              stated = number_below(row, Column::stated),
                                              c = number_below(row, Column::sensitivity),
                                              divided_by = number_below(row, Column::divisor);
            const auto distribution = heads_.columns.find(Column::distribution);
            const Cell* shape = distribution == heads_.columns.end() ? nullptr : cell_in(row, distribution->second);
            const double divisor = divided_by         ? divided_by->value
                                   : shape != nullptr ? divisor_of_shape(shape_of(sheet_.words(*shape))).value_or(0.0)
                                                      : 0.0;
            if (!u || !stated || !c || !(divisor > 0.0)) {
                return;
            }
            if (std::abs(std::abs(c->value) - divisor) <= k_digits_of_factors * divisor) {
                return;  // what was multiplied by c may be what was never divided
            }
            const double part = std::abs(stated->value) / divisor, weighted = std::abs(c->value) * part;
            const bool is_weighted = is_printed_as(*u, weighted), is_part = is_printed_as(*u, part);
            with_coefficient += is_weighted && !is_part ? 1U : 0U;
            without += is_part && !is_weighted ? 1U : 0U;
        });
        if (with_coefficient > without) {
            rename_column(Column::u, Column::contribution);
        }
    }

private:
    /// The number of a row below some heads in a column.
    [[nodiscard]] std::optional<StatedNumber> number_below(const SheetView::Row& row, Column column) const {
        const auto head = heads_.columns.find(column);
        const Cell* cell = head == heads_.columns.end() ? nullptr : cell_in(row, head->second);
        std::optional<NumberWithUnit> read = cell == nullptr ? std::nullopt : sheet_.number_with_unit(*cell);
        return read && !read->is_open ? std::optional(std::move(read->number)) : std::nullopt;
    }
    /// Looks at the rows between a line of heads and the next one.
    template <typename Look>
    void each_row_below(std::uint32_t line, const Look& look) const {
        for (auto at = rows_.upper_bound(line); at != rows_.end() && at->first <= line + k_most_rows_of_table; ++at) {
            if (heads_of(sheet_, at->second)) {
                return;
            }
            look(at->second);
        }
    }
    /// A column has another meaning than its head names first.
    void rename_column(Column from, Column to) {
        const auto move = [from, to](auto& map) {
            if (const auto found = map.find(from); found != map.end()) {
                map[to] = found->second;
                map.erase(from);
            }
        };
        move(heads_.columns);
        move(heads_.units);
        move(heads_.unit_columns);
    }
    static constexpr double k_digits_of_factors = 0.01;  // relative, of a divisor and a coefficient
    /// Whether a printed number is that of a size that follows from factors, which are rounded as well.
    [[nodiscard]] static bool is_printed_as(const StatedNumber& number, double size) {
        const double printed = std::abs(number.value);
        return std::abs(printed - size) <= printed_half_step(number) + k_digits_of_factors * printed;
    }

    const SheetView& sheet_;
    const SheetView::Rows& rows_;
    Heads& heads_;
};

}  // namespace

std::vector<const Cell*> cells_with_words(const SheetView& sheet, const SheetView::Row& row) {
    std::vector<const Cell*> held;
    std::copy_if(row.begin(), row.end(), std::back_inserter(held),
                 [&sheet](const Cell* cell) { return !sheet.words(*cell).empty(); });
    return held;
}

bool is_words_alone(const SheetView& sheet, const SheetView::Row& row) {
    const std::vector<const Cell*> held = cells_with_words(sheet, row);
    return held.size() > 1 && std::all_of(held.begin(), held.end(), [&sheet](const Cell* cell) {
               return sheet.value(*cell).kind == CellKind::text && !sheet.number_with_unit(*cell);
           });
}

HeadsOfLines heads_at(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t line,
                      std::deque<Cell>& joined) {
    const SheetView::Row& row = rows.at(line);
    std::optional<Heads> heads = heads_of(sheet, row);
    std::optional<Heads> of_two = heads_in_two_lines(sheet, rows, line, row, joined);
    const bool are_two =
        of_two && (!heads || is_second_line(sheet, rows, line, heads) ||
                   (of_two->columns.size() > heads->columns.size() && !names_row_below(sheet, rows, line, *heads)));
    return {.heads = are_two ? std::move(of_two) : std::move(heads), .are_two_lines = are_two};
}

bool repeats_heads(const SheetView& sheet, const Heads& heads, const SheetView::Row& row) {
    if (!is_words_alone(sheet, row)) {
        return false;
    }
    std::size_t same = 0;
    for (const auto& [column, position] : heads.columns) {
        const Cell* cell = has_numbers_with_units(column) ? cell_in(row, position) : nullptr;
        const std::string held = cell == nullptr ? "" : sheet.words(*cell);
        same += !held.empty() && column_of(held) == column ? 1U : 0U;
    }
    return same > 1;
}

bool take_units(const SheetView& sheet, const SheetView::Row& row, Heads& heads) {
    std::map<Column, std::string> units;
    for (const Cell* cell : row) {
        const std::string held = sheet.words(*cell);
        const auto head = std::find_if(heads.columns.begin(), heads.columns.end(),
                                       [cell](const auto& column) { return column.second == cell->address.column; });
        if (says_nothing(held) || held == "1" || head == heads.columns.end()) {
            continue;
        }
        if (!has_numbers_with_units(head->first)) {
            if (column_of(held) == Column::unit) {
                continue;  // "unit" below "quantity"
            }
            return false;
        }
        if (sheet.number_with_unit(*cell) || !known_unit(held)) {
            return false;
        }
        units.emplace(head->first, unit_in_rest(held));
    }
    for (const auto& [column, unit] : units) {
        std::string& of_head = heads.units[column];
        of_head = of_head.empty() ? unit : of_head;
        heads.all_units[heads.columns.at(column)] = of_head;
    }
    return !units.empty();
}

std::vector<SheetView::Row> lines_below(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t line) {
    constexpr std::size_t k_most = 20;
    std::vector<SheetView::Row> below;
    for (auto at = rows.find(line + 1); at != rows.end() && below.size() < k_most; ++at) {
        const bool has_number = std::any_of(at->second.begin(), at->second.end(), [&sheet](const Cell* cell) {
            return sheet.number_with_unit(*cell).has_value();
        });
        if (at->first != line + 1 + below.size() || !has_number) {
            break;
        }
        below.push_back(at->second);
    }
    return below;
}

void settle_meanings(const SheetView& sheet, const SheetView::Rows& rows, std::uint32_t line, Heads& heads) {
    MeaningsOfColumns meanings(sheet, rows, heads);
    meanings.take_value_for_stated(line);
    meanings.take_u_for_contribution(line);
}

}  // namespace gumcert::audit
