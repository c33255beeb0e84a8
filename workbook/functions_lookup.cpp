#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>

#include "workbook/operand.h"

namespace gumcert::workbook {

namespace {

using LookedUp = std::span<const Operand>;
using TakesForLookup = SheetFunction::Takes;

/// A table whose cells are read only where they are asked for.
class TableView {
public:
    TableView(const Operand& table, CellReader& reader) : table_(table), reader_(reader) {
        if (table.kind == OperandKind::area) {
            const CellRange& range = table.area.range;
            rows_ = range.last.row - range.first.row + 1;
            columns_ = range.last.column - range.first.column + 1;
        } else if (table.kind == OperandKind::array) {
            rows_ = table.array->rows;
            columns_ = table.array->columns;
        }
    }

    [[nodiscard]] std::size_t rows() const { return rows_; }
    [[nodiscard]] std::size_t columns() const { return columns_; }
    /// Rows and columns behind which everything is blank.
    [[nodiscard]] std::size_t used_rows() const {
        if (table_.kind == OperandKind::area) {
            return used(rows_, table_.area.range.first.row, reader_.last_used(table_.area.sheet).row);
        }
        return table_.kind == OperandKind::array ? table_.array->stored_rows : 1;
    }
    [[nodiscard]] std::size_t used_columns() const {
        if (table_.kind == OperandKind::area) {
            return used(columns_, table_.area.range.first.column, reader_.last_used(table_.area.sheet).column);
        }
        return table_.kind == OperandKind::array ? table_.array->stored_columns : 1;
    }

    [[nodiscard]] Operand at(std::size_t row, std::size_t column) const {
        reader_.spend(1);
        if (table_.kind == OperandKind::area) {
            const CellAddress first = table_.area.range.first;
            return reader_.cell(table_.area.sheet, {first.row + static_cast<std::uint32_t>(row),
                                                    first.column + static_cast<std::uint32_t>(column)});
        }
        return table_.kind == OperandKind::array ? table_.array->at(row, column) : table_;
    }

private:
    static std::size_t used(std::size_t size, std::uint32_t first, std::uint32_t last) {
        return last < first ? 0 : std::min<std::size_t>(size, last - first + 1);
    }

    const Operand& table_;
    CellReader& reader_;
    std::size_t rows_ = 1, columns_ = 1;
};

enum class Search : std::uint8_t { exact, ascending, descending };

/// A place in a row or column, or the operand that is the result because there is none.
struct FoundPlace {
    std::size_t place = 0;
    std::optional<Operand> stop;
};

template <typename At>
FoundPlace search(std::size_t size, const At& at, const Operand& key, Search how, CellReader& reader) {
    if (key.stops()) {
        return {.stop = key};
    }
    Operand wanted = key;
    if (key.kind == OperandKind::blank || key.kind == OperandKind::missing) {
        wanted = Operand::of(0.0);
    }
    if (how == Search::exact && wanted.kind == OperandKind::text &&
        wanted.text.find_first_of("*?~") != std::string::npos) {
        return {.stop = reader.not_evaluated("a lookup with wildcards")};
    }
    FoundPlace found{.stop = Operand::of(CellError::not_available)};
    std::optional<Operand> before;
    for (std::size_t i = 0; i < size; ++i) {
        Operand one = at(i);
        if (one.kind == OperandKind::not_evaluated || one.kind == OperandKind::stands_for_all) {
            return {.stop = one};
        }
        if (one.kind != wanted.kind) {
            continue;  // other kinds are passed over
        }
        const int order = compared(one, wanted);
        if (only_rounding_decides(one, wanted)) {
            return {.stop = reader.not_evaluated("a comparison that only rounding decides")};
        }
        if (how == Search::exact) {
            if (order == 0) {
                return {.place = i, .stop = {}};
            }
            continue;
        }
        const int step = before ? compared(*before, one) : 0;
        if (how == Search::ascending ? step > 0 : step < 0) {
            return {.stop = reader.not_evaluated("a lookup in a list that is not sorted")};
        }
        before = one;
        if (how == Search::ascending ? order <= 0 : order >= 0) {
            found = {.place = i, .stop = {}};
        }
    }
    return found;
}

/// VLOOKUP and HLOOKUP.
Operand looked_up(LookedUp arguments, CellReader& reader, bool in_columns) {
    const Operand key = reader.single(arguments[0]);
    const Operand place = as_number(reader.single(arguments[2]), reader);
    const Operand nearest = arguments.size() > 3 ? as_truth(reader.single(arguments[3]), reader) : Operand::of(true);
    for (const Operand* one : {&key, &arguments[1], &place, &nearest}) {
        if (one->stops()) {
            return *one;
        }
    }
    const TableView table(arguments[1], reader);
    const double wanted = std::floor(place.number);
    if (wanted < 1.0) {
        return Operand::of(CellError::value);
    }
    if (wanted > static_cast<double>(in_columns ? table.columns() : table.rows())) {
        return Operand::of(CellError::reference);
    }
    const auto at = [&](std::size_t i) { return in_columns ? table.at(i, 0) : table.at(0, i); };
    const FoundPlace found = search(in_columns ? table.used_rows() : table.used_columns(), at, key,
                                    nearest.number != 0.0 ? Search::ascending : Search::exact, reader);
    if (found.stop) {
        return *found.stop;
    }
    const std::size_t other = static_cast<std::size_t>(wanted) - 1;
    return in_columns ? table.at(found.place, other) : table.at(other, found.place);
}

Operand vertical_lookup(LookedUp arguments, CellReader& reader) {
    return looked_up(arguments, reader, true);
}

Operand horizontal_lookup(LookedUp arguments, CellReader& reader) {
    return looked_up(arguments, reader, false);
}

Operand match(LookedUp arguments, CellReader& reader) {
    const Operand key = reader.single(arguments[0]);
    const Operand type = arguments.size() > 2 ? as_number(reader.single(arguments[2]), reader) : Operand::of(1.0);
    for (const Operand* one : {&key, &arguments[1], &type}) {
        if (one->stops()) {
            return *one;
        }
    }
    const TableView list(arguments[1], reader);
    if (list.rows() != 1 && list.columns() != 1) {
        return Operand::of(CellError::not_available);
    }
    const bool is_column = list.columns() == 1;
    const auto at = [&](std::size_t i) { return is_column ? list.at(i, 0) : list.at(0, i); };
    const FoundPlace found = search(is_column ? list.used_rows() : list.used_columns(), at, key,
                                    type.number > 0.0   ? Search::ascending
                                    : type.number < 0.0 ? Search::descending
                                                        : Search::exact,
                                    reader);
    return found.stop ? *found.stop : Operand::of(static_cast<double>(found.place) + 1.0);
}

/// LOOKUP in a row or column, with another one for the result, or in the longer side of a table.
Operand look_up(LookedUp arguments, CellReader& reader) {
    const Operand key = reader.single(arguments[0]);
    for (const Operand& one : arguments) {
        if (one.stops()) {
            return one;
        }
    }
    const TableView list(arguments[1], reader);
    const bool is_column = list.rows() >= list.columns();
    const auto at = [&](std::size_t i) { return is_column ? list.at(i, 0) : list.at(0, i); };
    const FoundPlace found =
        search(is_column ? list.used_rows() : list.used_columns(), at, key, Search::ascending, reader);
    if (found.stop) {
        return *found.stop;
    }
    if (arguments.size() < 3) {
        return is_column ? list.at(found.place, list.columns() - 1) : list.at(list.rows() - 1, found.place);
    }
    const TableView results(arguments[2], reader);
    const bool results_are_column = results.columns() == 1;
    if (found.place >= (results_are_column ? results.rows() : results.columns())) {
        return Operand::of(CellError::not_available);
    }
    return results_are_column ? results.at(found.place, 0) : results.at(0, found.place);
}

Operand index(LookedUp arguments, CellReader& reader) {
    const Operand& table = arguments[0];
    Operand row = as_number(reader.single(arguments[1]), reader);
    Operand column = arguments.size() > 2 ? as_number(reader.single(arguments[2]), reader) : Operand::of(0.0);
    for (const Operand* one : std::initializer_list<const Operand*>{&table, &row, &column}) {
        if (one->stops()) {
            return *one;
        }
    }
    const TableView view(table, reader);
    if (arguments.size() == 2 && view.rows() == 1) {
        std::swap(row, column);
    }
    const double row_place = std::floor(row.number), column_place = std::floor(column.number);
    if (row_place < 0.0 || column_place < 0.0) {
        return Operand::of(CellError::value);
    }
    if (row_place > static_cast<double>(view.rows()) || column_place > static_cast<double>(view.columns())) {
        return Operand::of(CellError::reference);
    }
    const auto rows = static_cast<std::uint32_t>(row_place), columns = static_cast<std::uint32_t>(column_place);
    if (table.kind == OperandKind::area) {
        Area chosen = table.area;
        if (rows > 0) {
            chosen.range.first.row += rows - 1;
            chosen.range.last.row = chosen.range.first.row;
        }
        if (columns > 0) {
            chosen.range.first.column += columns - 1;
            chosen.range.last.column = chosen.range.first.column;
        }
        return Operand::of(chosen);
    }
    if ((rows == 0 && view.rows() > 1) || (columns == 0 && view.columns() > 1)) {
        return reader.not_evaluated("INDEX of a whole row or column of values");
    }
    return view.at(std::max(rows, 1U) - 1, std::max(columns, 1U) - 1);
}

constexpr SheetFunction k_lookups[] = {
    {"HLOOKUP", TakesForLookup::whole, 3, 4, horizontal_lookup}, {"INDEX", TakesForLookup::whole, 2, 3, index},
    {"LOOKUP", TakesForLookup::arrays, 2, 3, look_up},           {"MATCH", TakesForLookup::whole, 2, 3, match},
    {"VLOOKUP", TakesForLookup::whole, 3, 4, vertical_lookup},
};

// Truth values.

/// AND where `all`, else OR.
Operand joined_truths(LookedUp arguments, CellReader& reader, bool all) {
    std::optional<bool> joined;
    std::optional<Operand> stop;
    const auto add = [&](const Operand& one) {
        if (one.stops()) {
            stop = !stop || stop->kind == OperandKind::error ? one : *stop;
        } else if (one.kind == OperandKind::number || one.kind == OperandKind::boolean) {
            const bool truth = one.number != 0.0;
            joined = all ? joined.value_or(true) && truth : joined.value_or(false) || truth;
        }
        return true;
    };
    for (const Operand& argument : arguments) {
        if (argument.kind == OperandKind::area) {
            reader.each_cell(argument.area, add);
        } else if (argument.kind == OperandKind::array) {
            std::for_each(argument.array->items.begin(), argument.array->items.end(), add);
        } else {
            const Operand truth = as_truth(argument, reader);
            add(truth);
        }
    }
    return stop ? *stop : joined ? Operand::of(*joined) : Operand::of(CellError::value);
}

Operand all_true(LookedUp arguments, CellReader& reader) {
    return joined_truths(arguments, reader, true);
}

Operand any_true(LookedUp arguments, CellReader& reader) {
    return joined_truths(arguments, reader, false);
}

Operand negated(LookedUp arguments, CellReader& reader) {
    const Operand truth = as_truth(arguments[0], reader);
    return truth.stops() ? truth : Operand::of(truth.number == 0.0);
}

template <OperandKind Wanted>
Operand is_of_kind(LookedUp arguments, CellReader&) {
    return Operand::of(arguments[0].kind == Wanted);
}

Operand is_other_error(LookedUp arguments, CellReader&) {
    return Operand::of(arguments[0].kind == OperandKind::error && arguments[0].error != CellError::not_available);
}

Operand is_not_available(LookedUp arguments, CellReader&) {
    return Operand::of(arguments[0].kind == OperandKind::error && arguments[0].error == CellError::not_available);
}

Operand is_no_text(LookedUp arguments, CellReader&) {
    return Operand::of(arguments[0].kind != OperandKind::text);
}

Operand number_or_zero(LookedUp arguments, CellReader&) {
    return Operand::of(arguments[0].kind == OperandKind::text ? 0.0 : arguments[0].number);
}

Operand truth_true(LookedUp, CellReader&) {
    return Operand::of(true);
}

Operand truth_false(LookedUp, CellReader&) {
    return Operand::of(false);
}

Operand not_available(LookedUp, CellReader&) {
    return Operand::of(CellError::not_available);
}

constexpr TakesForLookup k_with_errors = TakesForLookup::values_and_errors;
constexpr SheetFunction k_logical[] = {
    {"AND", TakesForLookup::whole, 1, k_any_number, all_true},
    {"FALSE", TakesForLookup::values, 0, 0, truth_false},
    {"ISBLANK", k_with_errors, 1, 1, is_of_kind<OperandKind::blank>},
    {"ISERR", k_with_errors, 1, 1, is_other_error},
    {"ISERROR", k_with_errors, 1, 1, is_of_kind<OperandKind::error>},
    {"ISLOGICAL", k_with_errors, 1, 1, is_of_kind<OperandKind::boolean>},
    {"ISNA", k_with_errors, 1, 1, is_not_available},
    {"ISNONTEXT", k_with_errors, 1, 1, is_no_text},
    {"ISNUMBER", k_with_errors, 1, 1, is_of_kind<OperandKind::number>},
    {"ISTEXT", k_with_errors, 1, 1, is_of_kind<OperandKind::text>},
    {"N", TakesForLookup::values, 1, 1, number_or_zero},
    {"NA", TakesForLookup::values, 0, 0, not_available},
    {"NOT", TakesForLookup::values, 1, 1, negated},
    {"OR", TakesForLookup::whole, 1, k_any_number, any_true},
    {"TRUE", TakesForLookup::values, 0, 0, truth_true},
};

}  // namespace

std::span<const SheetFunction> lookup_functions() {
    return k_lookups;
}

std::span<const SheetFunction> logical_functions() {
    return k_logical;
}

}  // namespace gumcert::workbook
