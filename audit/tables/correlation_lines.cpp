#include "audit/tables/correlation_lines.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "audit/words/column_heads.h"
#include "audit/words/correlation_words.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;

class LinesOfCorrelations {
public:
    LinesOfCorrelations(const SheetView& sheet, TableSoFar& table) : sheet_(sheet), table_(table) {}

    [[nodiscard]] bool note_correlation(const SheetView::Row& row) {
        if (sheet_.value(*row.front()).kind != CellKind::text) {
            return false;
        }
        const std::string name = sheet_.words(*row.front());
        const std::optional<CorrelationWords> words = correlation_words(name);
        const NumbersUnderHeads numbers = numbers_under(sheet_, *table_.heads, row);
        if (!words && numbers.empty() && name.find(' ') != std::string::npos) {
            // A note. "r = 0.9" in it is no correlation of the sum, and asked where it would explain it, unless it is of a regression.
            const NotedCorrelation of = noted_correlation(name);
            if (const std::optional<double> r = stated_correlation(name);
                r && *r != 0.0 && of != NotedCorrelation::of_fit) {
                (of == NotedCorrelation::of_rows ? table_.budget.unread_correlations : table_.budget.noted_correlations)
                    .push_back(*r);
            }
            return false;
        }
        const auto shape = table_.heads->columns.find(Column::distribution);
        const Cell* shape_cell = shape == table_.heads->columns.end() ? nullptr : cell_in(row, shape->second);
        if ((!words && name != "r") || numbers.contains(Column::sensitivity) || numbers.contains(Column::divisor) ||
            (shape_cell != nullptr && !says_nothing(sheet_.words(*shape_cell)))) {
            return false;
        }
        const bool has_amount =
            numbers.contains(Column::u) || numbers.contains(Column::contribution) || numbers.contains(Column::stated);
        std::optional<double> r = words && words->r ? words->r : correlation_in(row);
        // An uncertainty is not negative: without estimate, u and coefficient it is a term of the sum, with the sign of r.
        const auto term = numbers.find(Column::contribution);
        const bool is_term = words && !words->is_coefficient && term != numbers.end() && !r &&
                             sheet_.number_with_unit(*term->second).value_or(NumberWithUnit{}).number.value < 0.0 &&
                             !numbers.contains(Column::estimate) && !numbers.contains(Column::u) &&
                             !numbers.contains(Column::stated);
        if (!words) {  // "r" alone may be a radius or a resistance
            const bool is_constant = has_amount || numbers.contains(Column::estimate);
            r = is_constant ? std::nullopt : r;
        }
        if (words && (words->is_covariance || is_term)) {
            const bool has_number = std::any_of(row.begin() + 1, row.end(), [this](const Cell* cell) {
                return sheet_.number_with_unit(*cell).has_value();
            });
            table_.covariance_line = has_number && table_.covariance_line == nullptr ? &row : table_.covariance_line;
            return has_number;
        }
        if (!r || (has_amount && !words->is_coefficient && !rows_of(words->pairs))) {
            return false;
        }
        table_.correlation_lines.push_back({.row = &row, .r = *r, .pairs = words ? words->pairs : Pairs{}});
        return true;
    }
    void settle_correlations(std::vector<Sentence>& not_read) {
        table_.last_unread.reset();
        for (const CorrelationLine& line : table_.correlation_lines) {
            if (const auto rows = rows_of(line.pairs)) {
                table_.budget.correlations.push_back({.first = rows->first, .second = rows->second, .r = line.r});
            } else {
                table_.budget.unread_correlations.push_back(line.r);
                note_unread(sheet_, *line.row, table_, not_read);
            }
        }
        if (table_.covariance_line != nullptr && !table_.correlation_lines.empty()) {
            note_unread(sheet_, *table_.covariance_line, table_, not_read);
        } else if (table_.covariance_line != nullptr) {
            table_.is_told = true;
            not_read.push_back(
                say("{cell}: {text} is a term of the sum that no row has; the table is not looked at; which rows are "
                    "correlated, and what is r?",
                    sheet_.place(table_.covariance_line->front()->address),
                    text::in_quotes(sheet_.words(*table_.covariance_line->front()))));
        }
    }

private:
    /// A number from -1 to 1 without a unit, behind the name.
    [[nodiscard]] std::optional<double> correlation_in(const SheetView::Row& row) const {
        const auto unit = table_.heads->columns.find(Column::unit);
        for (auto cell = row.begin() + 1; cell != row.end(); ++cell) {
            if (const std::optional<double> r = stated_correlation(sheet_.words(**cell))) {
                return r;
            }
            const std::optional<NumberWithUnit> r = sheet_.number_with_unit(**cell);
            if (!r || (unit != table_.heads->columns.end() && unit->second == (*cell)->address.column)) {
                continue;
            }
            const Cell* of_row = unit == table_.heads->columns.end() ? nullptr : cell_in(row, unit->second);
            const std::string in = !r->unit.empty() || of_row == nullptr ? r->unit : sheet_.words(*of_row);
            const bool has_none = says_nothing(in) || in == "1";
            return has_none && !r->is_open && std::abs(r->number.value) <= 1.0 ? std::optional(r->number.value)
                                                                               : std::nullopt;
        }
        return std::nullopt;
    }
    using Pairs = std::vector<std::pair<std::string, std::string>>;
    /// The two rows that the first of some pairs of symbols are words of.
    [[nodiscard]] std::optional<std::pair<std::size_t, std::size_t>> rows_of(const Pairs& pairs) const {
        for (const auto& [one, other] : pairs) {
            const std::optional<std::size_t> first = row_with(one), second = row_with(other);
            if (first && second && *first != *second) {
                return std::pair(*first, *second);
            }
        }
        return std::nullopt;
    }
    /// The one row whose words have a symbol; nothing where none has, or several.
    [[nodiscard]] std::optional<std::size_t> row_with(std::string_view symbol) const {
        const auto has = [symbol](std::string_view words) {
            const auto is_of_word = [&words](std::size_t i) {
                const auto c = static_cast<unsigned char>(words[i]);
                return c >= 0x80U || std::isalnum(c) != 0 || c == '_';
            };
            for (std::size_t at = words.find(symbol); at != words.npos; at = words.find(symbol, at + 1)) {
                const std::size_t end = at + symbol.size();
                if ((at == 0 || !is_of_word(at - 1)) && (end == words.size() || !is_of_word(end))) {
                    return true;
                }
            }
            return false;
        };
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < table_.budget.rows.size() && !symbol.empty(); ++i) {
            if (has(table_.budget.rows[i].quantity) || has(table_.budget.rows[i].description)) {
                if (found) {
                    return std::nullopt;
                }
                found = i;
            }
        }
        return found;
    }

    const SheetView& sheet_;
    TableSoFar& table_;
};

}  // namespace

bool note_correlation(const SheetView& sheet, const SheetView::Row& row, TableSoFar& table) {
    return LinesOfCorrelations(sheet, table).note_correlation(row);
}

void settle_correlations(const SheetView& sheet, TableSoFar& table, std::vector<Sentence>& not_read) {
    LinesOfCorrelations(sheet, table).settle_correlations(not_read);
}

}  // namespace gumcert::audit
