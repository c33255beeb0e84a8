#include "audit/tables/row_lines.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>

#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/tables/limits_of_rows.h"
#include "audit/tables/named_line.h"
#include "audit/tables/result_lines.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/table_sums.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/named_statement.h"
#include "gum/quantity/unit.h"
#include "text/visible_text.h"
#include "workbook/workbook.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;

/// Whether the number of a line that looks like a row is u_c, or U, of the rows above it.
bool is_sum(const SheetView& sheet, const NumbersUnderHeads& numbers, Statement statement, TableSoFar& table) {
    // Each look adds up all rows; a table states few results.
    constexpr std::size_t k_most_looks = 20;
    if (table.budget.rows.size() < 2 || ++table.looks > k_most_looks) {
        return false;
    }
    const auto number = [&](Column column) -> std::optional<StatedResult> {
        const auto found = numbers.find(column);
        std::vector<Sentence> unused;
        return found == numbers.end() ? std::nullopt : result_in(sheet, *found->second, statement, unused);
    };
    const std::optional<StatedResult> divisor = number(Column::divisor);
    for (const Column column : {Column::contribution, Column::u, Column::stated}) {
        const std::optional<StatedResult> amount = number(column);
        if (!amount || (statement != Statement::u_c && !divisor)) {
            continue;
        }
        const std::optional<Interval> sum = table.sums().sum_above(*amount);
        const double k = statement == Statement::u_c ? 1.0 : divisor->number.value;
        if (sum && k > 0.0 && as_rounded(amount->number, k).meets(*sum)) {
            return true;
        }
    }
    return false;
}

/// Whether a line with the name of a statement states it, and is not a row that is called so.
bool states_result(const SheetView& sheet, const NamedStatement& named, const NumbersUnderHeads& numbers,
                   TableSoFar& table) {
    const auto has = [&numbers](Column column) { return numbers.contains(column); };
    const auto headed = [&table](Column column) { return table.heads->columns.contains(column); };
    const bool has_amount = has(Column::u) || has(Column::contribution);
    const bool has_amount_column = headed(Column::u) || headed(Column::contribution);
    const bool is_divided = has(Column::stated) && has(Column::divisor) && (has_amount || !has_amount_column);
    const bool adds = has(Column::sensitivity) || is_divided;
    switch (named.statement) {
        case Statement::U:
        case Statement::reported_U:
            if (named.may_be_quantity) {
                return has_amount && !adds && !has(Column::estimate) && !has(Column::stated) &&
                       !(has(Column::u) && has(Column::contribution)) &&
                       (has(Column::divisor) || (has(Column::contribution) && headed(Column::u)));
            }
            return !adds || is_sum(sheet, numbers, named.statement, table);
        case Statement::u_c:
            if (named.may_be_quantity) {
                return has(Column::contribution) && !has(Column::u) && !has(Column::estimate) && !adds &&
                       (headed(Column::u) || headed(Column::stated));
            }
            return !adds || is_sum(sheet, numbers, named.statement, table);
        case Statement::value:
            return !named.may_be_quantity && !adds;
        case Statement::nu_eff:
            return !adds;
        default:
            return false;
    }
}

/// One row of a table being read.
class RowReader {
public:
    RowReader(const SheetView& sheet, const Heads& heads, const std::vector<const Cell*>& row,
              std::vector<Sentence>& not_read)
        : sheet_(sheet), heads_(heads), row_(row), not_read_(not_read) {}

    [[nodiscard]] ReadRow read() {
        AuditedRow& read = read_.row;
        RowUnits& units = read_.units;
        read.decimal_sign = sheet_.decimal_sign();
        read.quantity = words(Column::quantity);
        if (const Cell* cell = heads_.description ? cell_in(row_, *heads_.description) : nullptr) {
            read.description = sheet_.words(*cell);
        }
        read.source = words(Column::source);
        read.comment = words(Column::comment);
        const Cell* named = at(Column::quantity);
        // Where the first column has groups, each of them once, what a row is called stands beside it.
        for (const std::string* const beside : {&read.description, &read.source}) {
            read.quantity = read.quantity.empty() ? *beside : read.quantity;
        }
        read.description = read.quantity == read.description ? "" : read.description;
        if (named != nullptr || !row_.empty()) {
            read.place = sheet_.place((named != nullptr ? named : row_.front())->address);
        }
        read.estimate = number(Column::estimate, units.estimate);
        read.stated = number(Column::stated, units.stated);
        std::string none;
        read.divisor = number(Column::divisor, none);
        read.u = number(Column::u, units.u);
        if (std::optional<NumberWithUnit> half = half_width_of_limits(sheet_, heads_, row_); half && !read.stated) {
            read.stated = std::move(half->number);
            units.stated = half->unit.empty() ? heads_.units.at(Column::stated) : half->unit;
        }
        read.sensitivity = number(Column::sensitivity, units.sensitivity);
        read.contribution = number(Column::contribution, units.contribution);
        read.nu = number(Column::nu, none);
        // What has no unit of its own has that of the row; of a row without one, that of what u was divided from.
        const std::string of_row = words(Column::unit);
        const std::string& of_stated = units.stated.empty() ? of_row : units.stated;
        const std::string& of_u = units.u.empty() ? of_stated : units.u;
        const std::string& of_estimate = units.estimate.empty() ? of_row : units.estimate;
        read.unit = shared_unit(of_u, read.estimate ? of_estimate : of_u);
        units = {.estimate = of_estimate,
                 .stated = of_stated,
                 .u = of_u,
                 .sensitivity = units.sensitivity,
                 .contribution = units.contribution};
        read.shape_text = words(Column::distribution);
        read.shape = shape_of(read.shape_text);
        const std::string type = words(Column::type);
        if (type == "A" || type == "a" || type == "B" || type == "b") {
            read.type_a = type == "A" || type == "a";
        } else if (read.shape == Shape::not_stated && !type.empty()) {
            read.shape_text = type;
            read.shape = shape_of(type);
        }
        if (!read.type_a && (read.shape_text == "A" || read.shape_text == "B")) {
            read.type_a = read.shape_text == "A";
        }
        const bool is_a = is_marked(heads_.marks_a), is_b = is_marked(heads_.marks_b);
        if (!read.type_a && is_a != is_b) {
            read.type_a = is_a;
        }
        const std::optional<double> k = k_of_distribution(read.shape_text);
        if (read.shape == Shape::normal || read.shape == Shape::other) {
            read.distribution_k = k;
        }
        if (k && read.stated && !read.divisor && !read.u && !read.contribution) {
            read.divisor = exact_number(*k, read.place);  // "normal (k = 2)" in a table without divisors
        }
        for (std::optional<StatedNumber>* rounded : {&read.u, &read.contribution}) {
            if (*rounded) {
                (*rounded)->half_step = printed_half_step(**rounded);  // "12" of an uncertainty was rounded as well
            }
        }
        return std::move(read_);
    }

private:
    [[nodiscard]] const Cell* at(Column column) const {
        const auto position = heads_.columns.find(column);
        return position == heads_.columns.end() ? nullptr : cell_in(row_, position->second);
    }
    [[nodiscard]] std::string words(Column column) const {
        const Cell* cell = at(column);
        return cell == nullptr ? "" : sheet_.words(*cell);
    }
    [[nodiscard]] bool is_marked(const std::optional<std::uint32_t>& column) const {
        const Cell* cell = column ? cell_in(row_, *column) : nullptr;
        return cell != nullptr && !says_nothing(sheet_.words(*cell));
    }
    /// \param unit  that the cell, its head, or a column of units of its own states; else as it was
    [[nodiscard]] std::optional<StatedNumber> number(Column column, std::string& unit) {
        const Cell* cell = at(column);
        if (cell == nullptr) {
            return std::nullopt;
        }
        std::optional<NumberWithUnit> read = sheet_.number_with_unit(*cell);
        const std::string held = sheet_.words(*cell);
        if (!read && column == Column::nu) {  // "> 100" are 100 at least
            read = least_in(held, *cell);
        }
        if (!read) {
            if (!says_nothing(held)) {
                not_read_.push_back(say("{cell}: {text} is no number; what is meant?", sheet_.place(cell->address),
                                        text::in_quotes(held)));
                if (column != Column::estimate && column != Column::nu) {
                    read_.unread.push_back(sheet_.place(cell->address) + " (" + text::in_quotes(held) + ")");
                }
                const bool is_amount =
                    column == Column::u || column == Column::stated || column == Column::contribution;
                const std::size_t digit = held.find_first_of("0123456789");
                const bool is_bound = held.starts_with('<') || held.starts_with("≤");
                read_.lost_amount = read_.lost_amount || (is_amount && digit <= k_longest_sign && !is_bound);
            }
            return std::nullopt;
        }
        if (read->is_open) {
            read_.has_open_number = true;
            not_read_.push_back(open_sign(sheet_.place(cell->address), held));
            return std::nullopt;
        }
        if (!has_numbers_with_units(column)) {
            return without_dimension(std::move(*read));
        }
        if (column != Column::sensitivity) {
            read = sheet_.as_shown(std::move(*read), *cell);
        }
        const std::string of_head = heads_.units.at(column), of_column = unit_of_column(column);
        const std::string& beside = of_head.empty() ? of_column : of_head;
        if (read->unit.empty() && of_column.empty() && (column == Column::u || column == Column::stated)) {
            ask_for_unit(*cell, of_head);
        }
        // Words behind a number that are no unit that we know count where no other place states one.
        const bool cell_first = !read->unit.empty() && (beside.empty() || known_unit(read->unit));
        unit = cell_first ? read->unit : beside;
        return std::move(read->number);
    }

    [[nodiscard]] std::optional<NumberWithUnit> least_in(std::string_view held, const Cell& cell) const {
        for (const std::string_view sign : {">=", ">", "≥"}) {
            if (held.starts_with(sign)) {
                return sheet_.number_in_text(held.substr(sign.size()), cell);
            }
        }
        return std::nullopt;
    }

    /// The head of a column of uncertainties and the column of units may state units of different kinds.
    void ask_for_unit(const Cell& cell, const std::string& of_head) {
        const std::string of_row = words(Column::unit);
        const std::optional<gum::Unit> head = known_unit(of_head), row = known_unit(of_row);
        if (head && row && !(head->dimension() == row->dimension())) {
            not_read_.push_back(
                say("{cell}: the head states {head}, and the column of units {unit}; the former is "
                    "used; in which unit is the number?",
                    sheet_.place(cell.address), text::in_quotes(of_head), text::in_quotes(of_row)));
        }
    }
    [[nodiscard]] std::string unit_of_column(Column column) const {
        const auto position = heads_.unit_columns.find(column);
        const Cell* cell = position == heads_.unit_columns.end() ? nullptr : cell_in(row_, position->second);
        return cell == nullptr ? "" : sheet_.words(*cell);
    }

    const SheetView& sheet_;
    const Heads& heads_;
    const std::vector<const Cell*>& row_;
    std::vector<Sentence>& not_read_;
    static constexpr std::size_t k_longest_sign = 6;  // bytes before the digits of what is meant as a number
    ReadRow read_;
};

}  // namespace

bool is_row(const SheetView& sheet, const SheetView::Row& row, TableSoFar& table) {
    const NumbersUnderHeads numbers = numbers_under(sheet, *table.heads, row);
    if (numbers.size() < 2) {
        return false;
    }
    const std::optional<NamedLine> line = name_of_line(sheet, row, &*table.heads);
    return !line || !(states_result(sheet, line->named, numbers, table) || is_number_with_one(sheet, row, *line));
}

bool is_constant(const SheetView& sheet, const SheetView::Row& row, const Heads& heads) {
    const auto numbers = std::count_if(row.begin(), row.end(), [&](const Cell* cell) {
        const bool is_name = cell->address.column == heads.columns.at(Column::quantity);
        return !is_name && sheet.number_with_unit(*cell).has_value() && sheet.words(*cell) != "1";
    });
    return numbers == 1 && numbers_under(sheet, heads, row).contains(Column::estimate);
}

bool has_formula_of_uncertainty(const SheetView::Row& row, const Heads& heads) {
    for (const Column column : {Column::u, Column::stated, Column::contribution}) {
        const auto position = heads.columns.find(column);
        const Cell* cell = position == heads.columns.end() ? nullptr : cell_in(row, position->second);
        if (cell != nullptr && cell->formula_kind != workbook::FormulaKind::none) {
            return true;
        }
    }
    return false;
}

ReadRow read_row(const SheetView& sheet, const Heads& heads, const SheetView::Row& row,
                 std::vector<Sentence>& not_read) {
    return RowReader(sheet, heads, row, not_read).read();
}

}  // namespace gumcert::audit
