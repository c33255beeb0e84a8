#include "audit/tables/named_line.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "audit/tables/stated_results.h"
#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;
using workbook::CellValue;

/// The first cell of a row that stands below a head of the table, or right of one: readings to the left of a table are not its
/// numbers, nor are those that count its rows.
std::size_t first_below(const Heads& heads, const SheetView::Row& row) {
    std::uint32_t first = heads.columns.at(Column::quantity);
    for (const auto& [column, position] : heads.columns) {
        first = std::min(first, position);
    }
    const auto at =
        std::find_if(row.begin(), row.end(), [first](const Cell* cell) { return cell->address.column >= first; });
    return static_cast<std::size_t>(at - row.begin());
}

/// Whether "U / mm" may be the U of a table: its heads are in units of that dimension. Above a table, and in another unit, it is
/// the circumference of a part, or revolutions, as likely.
bool may_be_U_of(const Heads* heads, const std::string& unit) {
    const std::optional<gum::Unit> own = known_unit(unit);
    return heads != nullptr && own && std::any_of(heads->units.begin(), heads->units.end(), [&own](const auto& of) {
               const std::optional<gum::Unit> other = known_unit(of.second);
               return other && other->dimension() == own->dimension();
           });
}

/// Whether the numbers behind a cell are the one that its text ends with: "U = k·u(m_X) = 2·29.3 mg = 59 mg | 59 mg".
bool repeats_number(const SheetView& sheet, const SheetView::Row& row, std::size_t cell, const std::string& text) {
    const std::optional<NumberWithUnit> held = sheet.number_in_text(text, *row[cell]);
    return held && std::all_of(row.begin() + static_cast<std::ptrdiff_t>(cell) + 1, row.end(), [&](const Cell* other) {
               const std::optional<NumberWithUnit> number = sheet.number_with_unit(*other);
               return !number || number->number.value == held->number.value;
           });
}

}  // namespace

std::optional<ValueWithU> value_with_U(const SheetView& sheet, const Cell& cell, std::string_view text) {
    std::size_t sign = std::string_view::npos, behind = 0;
    for (const std::string_view both : {"±", "+/-"}) {
        if (sign == std::string_view::npos && (sign = text.find(both)) != std::string_view::npos) {
            behind = sign + both.size();
        }
    }
    if (sign == std::string_view::npos) {
        return std::nullopt;
    }
    const std::string_view all = text.substr(behind);
    std::string_view of_value = text.substr(0, sign),
                     of_U = all.substr(std::min(all.find_first_not_of(' '), all.size()));
    std::string of_both;
    if (of_value.starts_with('(')) {
        const std::size_t close = of_U.find(')');
        if (close == std::string_view::npos) {
            return std::nullopt;
        }
        of_value.remove_prefix(1);
        of_both = unit_in_rest(std::string(of_U.substr(close + 1)));
        of_U = of_U.substr(0, close);
    }
    std::optional<NumberWithUnit> value = sheet.number_in_text(of_value, cell), U = sheet.number_in_text(of_U, cell);
    if (!value || !U || value->is_open || U->is_open) {
        return std::nullopt;
    }
    for (const std::string& unit : {of_both, U->unit}) {
        value->unit = value->unit.empty() && !is_unit_of_part(unit) ? unit : value->unit;
    }
    U->unit = U->unit.empty() ? value->unit : U->unit;
    return ValueWithU{.value = std::move(*value), .U = std::move(*U), .behind = all};
}

std::optional<NamedLine> name_of_line(const SheetView& sheet, const SheetView::Row& row, const Heads* heads) {
    // A name stands before what it names; before it may stand the symbol of what it names.
    for (std::size_t i = 0; i < row.size() && i < 2; ++i) {
        const CellValue held = sheet.value(*row[i]);
        if (held.kind != CellKind::text) {
            break;
        }
        std::optional<NamedStatement> named = named_statement(held.text);
        if (named && !named->unit_of_U.empty() && !may_be_U_of(heads, named->unit_of_U)) {
            named.reset();
        }
        if (named && !named->assigned.empty()) {
            const bool is_both = named->statement == Statement::value && !named->may_be_quantity &&
                                 value_with_U(sheet, *row[i], named->assigned);
            const bool has_number =
                is_both || (!is_in_words(named->statement) && sheet.number_in_text(named->assigned, *row[i]));
            const bool is_alone =
                std::none_of(row.begin() + static_cast<std::ptrdiff_t>(i) + 1, row.end(),
                             [&sheet](const Cell* cell) { return sheet.number_with_unit(*cell).has_value(); });
            if (has_number && !is_alone && repeats_number(sheet, row, i, named->assigned)) {
                named->assigned.clear();
            } else if (named->statement != Statement::equation && (!has_number || !is_alone)) {
                named.reset();
            }
        }
        if (named) {
            const bool is_headed = heads != nullptr && row[i]->address.column == heads->columns.at(Column::quantity);
            return NamedLine{
                .named = std::move(*named), .cell = i, .from = is_headed ? first_below(*heads, row) : i + 1};
        }
    }
    const auto names = heads == nullptr ? row.end() : std::find_if(row.begin(), row.end(), [heads](const Cell* cell) {
        return cell->address.column == heads->columns.at(Column::quantity);
    });
    if (names == row.end() || sheet.value(**names).kind != CellKind::text) {
        return std::nullopt;
    }
    std::optional<NamedStatement> named = named_statement(sheet.words(**names));
    if (!named || named->may_be_quantity || !named->assigned.empty()) {
        return std::nullopt;
    }
    return NamedLine{.named = std::move(*named),
                     .cell = static_cast<std::size_t>(names - row.begin()),
                     .from = first_below(*heads, row)};
}

NumbersUnderHeads numbers_under(const SheetView& sheet, const Heads& heads, const SheetView::Row& row) {
    NumbersUnderHeads numbers;
    for (const Column column : {Column::estimate, Column::stated, Column::divisor, Column::u, Column::sensitivity,
                                Column::contribution, Column::nu}) {
        const auto position = heads.columns.find(column);
        const Cell* cell = position == heads.columns.end() ? nullptr : cell_in(row, position->second);
        if (cell != nullptr && sheet.number_with_unit(*cell)) {
            numbers.emplace(column, cell);
        }
    }
    return numbers;
}

bool is_number_with_one(const SheetView& sheet, const SheetView::Row& row, const NamedLine& line) {
    if (!is_of_result(line.named.statement)) {
        return false;
    }
    std::vector<const Cell*> held;
    for (std::size_t i = line.from; i < row.size(); ++i) {
        if (i != line.cell && !sheet.words(*row[i]).empty()) {
            held.push_back(row[i]);
        }
    }
    if (held.size() != 2 || held[1]->address.column != held[0]->address.column + 1) {
        return false;
    }
    const bool before = sheet.words(*held[0]) == "1" && sheet.number(*held[1]);
    const bool behind = sheet.words(*held[1]) == "1" && sheet.number(*held[0]);
    return before || (behind && !line.named.may_be_quantity);
}

}  // namespace gumcert::audit
