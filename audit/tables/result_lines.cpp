#include "audit/tables/result_lines.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <set>
#include <string_view>
#include <utility>

#include "audit/row_meaning.h"
#include "audit/tables/beside_number.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/unit_words.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;

/// The number of a line under the head that fits what the line is named.
const Cell* number_by_head(Statement statement, const NumbersUnderHeads& numbers) {
    const auto first_of = [&numbers](std::initializer_list<Column> columns) -> const Cell* {
        for (const Column column : columns) {
            if (const auto found = numbers.find(column); found != numbers.end()) {
                return found->second;
            }
        }
        return nullptr;
    };
    switch (statement) {
        case Statement::U:
        case Statement::reported_U:
            // "1.48 | 2 | 0.742": U over k gives u_c in one line.
            if (numbers.contains(Column::stated) && numbers.contains(Column::divisor)) {
                return first_of({Column::stated});
            }
            [[fallthrough]];
        case Statement::u_c:
            return first_of({Column::contribution, Column::u, Column::stated, Column::estimate});
        case Statement::value:
            return first_of({Column::estimate});
        case Statement::nu_eff:
            return first_of({Column::nu});
        case Statement::k:
            return first_of({Column::divisor});
        default:
            return nullptr;
    }
}

/// What a line of U says of coverage: in its name, and in its words.
void take_coverage(const SheetView& sheet, const SheetView::Row& row, const NamedLine& line, Statements& statements) {
    std::string& coverage = statements.coverage;
    const auto add = [&coverage](std::string_view text) {
        while (!text.empty() && (text.front() == ' ' || text.front() == ',' || text.front() == ';')) {
            text.remove_prefix(1);
        }
        const bool in_brackets = text.starts_with('(') && text.find(')') == text.size() - 1;
        text = in_brackets ? text.substr(1, text.size() - 2) : text;
        if (!text.empty()) {
            coverage += (coverage.empty() ? "" : "; ") + std::string(text);
        }
    };
    if (!coverage.empty()) {
        return;
    }
    add(line.named.coverage);
    statements.other_k = line.named.other_k;
    for (std::size_t i = std::min(line.cell, line.from); i < row.size(); ++i) {
        const std::string held = i == line.cell ? line.named.assigned : sheet.words(*row[i]);
        if ((i == line.cell || sheet.value(*row[i]).kind == CellKind::text) && coverage_in(held).says_any()) {
            add(held);
        }
    }
    if (!coverage.empty()) {
        statements.coverage_place = sheet.place(row[line.cell]->address);
    }
}

/// What a line states in words.
void take_words(const SheetView& sheet, const SheetView::Row& row, const NamedLine& line, Statements& statements) {
    if (!line.named.assigned.empty()) {
        statements.words.emplace(line.named.statement, line.named.assigned);
        return;
    }
    for (std::size_t i = line.cell + 1; i < row.size(); ++i) {
        if (std::string held = sheet.words(*row[i]); !held.empty()) {
            statements.words.emplace(line.named.statement, std::move(held));
            return;
        }
    }
}

/// What the other numbers of a line state under their heads.
void take_others(const SheetView& sheet, Statement statement, const NumbersUnderHeads& numbers, Statements& statements,
                 std::vector<Sentence>& not_read) {
    const auto take = [&](Column column, Statement other) {
        const auto found = numbers.find(column);
        if (found == numbers.end() || statements.numbers.contains(other)) {
            return;
        }
        std::optional<StatedResult> result = result_in(sheet, *found->second, other, not_read);
        // A divisor of 1 divides nothing, and is no coverage factor.
        if (result && !(other == Statement::k && !(result->number.value > 1.0))) {
            statements.numbers.emplace(other, std::move(*result));
        }
    };
    const bool is_expanded = statement == Statement::U || statement == Statement::reported_U;
    if (is_expanded) {
        take(Column::divisor, Statement::k);
    }
    if (is_expanded || statement == Statement::u_c) {
        take(Column::nu, Statement::nu_eff);
    }
    if (statement == Statement::u_c && numbers.contains(Column::estimate)) {
        take(Column::estimate, Statement::value);
    }
}

/// The k that words beside U state; 0 where they state none.
double k_in_words(std::string_view words) {
    const std::string_view k = coverage_in(words).k;
    const std::optional<LeadingNumber> number = k.empty() ? std::nullopt : read_leading_number(k, "", Percent::unit);
    return number ? number->number.value : 0.0;
}

/// "U (k = 1)" is u_c where "U (k = 2)" follows.
void replace_U_of_one(const NamedLine& line, Statement statement, Statements& statements) {
    const auto held = statements.numbers.find(Statement::U);
    if (statement == Statement::U && held != statements.numbers.end() && k_in_words(statements.coverage) == 1.0 &&
        k_in_words(line.named.coverage) > 1.0) {
        statements.numbers.emplace(Statement::u_c, std::move(held->second));
        statements.numbers.erase(Statement::U);
        statements.coverage.clear();
    }
}

/// The unit of a result, or that of the head above it; "" where neither states one.
std::string unit_under(const Heads* heads, const StatedResult& result) {
    if (!result.unit.empty() || heads == nullptr) {
        return result.unit;
    }
    const auto of_head = heads->all_units.find(result.column);
    return of_head == heads->all_units.end() ? "" : of_head->second;
}

/// Names a u_c or U that is stated again with another number.
/// \param heads  of the table whose lines go on to this one; nullptr elsewhere
void tell_second(Statement statement, const StatedResult& second, const std::string& name, const Heads* heads,
                 const Statements& statements, std::vector<Sentence>& not_read) {
    const auto first = statements.numbers.find(statement);
    const bool is_told = statement == Statement::u_c || statement == Statement::U || statement == Statement::reported_U;
    if (!is_told || first == statements.numbers.end()) {
        return;
    }
    const std::string unit = unit_under(heads, second), of_first = unit_under(heads, first->second);
    const std::optional<double> factor = factor_between(unit, of_first);
    if (!factor || is_unit_of_part(unit) != is_unit_of_part(of_first)) {
        return;  // a relative one beside it
    }
    const StatedNumber &one = first->second.number, &other = second.number;
    const double step =
        printed_half_step(one) + std::abs(*factor) * printed_half_step(other) + 1e-9 * std::abs(one.value);
    if (std::abs(one.value - *factor * other.value) > step) {
        not_read.push_back(say("{cell}: {text} has another number than {other}; the latter is used; which one holds?",
                               other.place, text::in_quotes(name), one.place));
    }
}

/// Takes a value that has its U behind it, in the cell of its name or in the next one with anything.
bool take_value_with_U(const SheetView& sheet, const SheetView::Row& row, const NamedLine& line, Statements& statements,
                       std::vector<Sentence>& not_read) {
    if (line.named.statement != Statement::value || line.named.may_be_quantity) {
        return false;
    }
    std::size_t at = line.cell;
    std::string held = line.named.assigned;
    for (std::size_t i = line.cell + 1; i < row.size() && held.empty(); ++i) {
        at = i;
        held = sheet.words(*row[i]);
    }
    std::optional<ValueWithU> both = value_with_U(sheet, *row[at], held);
    if (!both) {
        return false;
    }
    const std::uint32_t column = row[at]->address.column;
    const StatedResult U{.number = std::move(both->U.number), .unit = std::move(both->U.unit), .column = column};
    tell_second(Statement::U, U, held, nullptr, statements, not_read);
    statements.numbers.emplace(
        Statement::value,
        StatedResult{.number = std::move(both->value.number), .unit = std::move(both->value.unit), .column = column});
    statements.numbers.emplace(Statement::U, U);
    for (std::size_t i = at; i < row.size() && statements.coverage.empty(); ++i) {
        const std::string words = i == at ? std::string(both->behind) : sheet.words(*row[i]);
        if (coverage_in(words).says_any()) {
            statements.coverage = words;
            statements.coverage_place = sheet.place(row[i]->address);
        }
    }
    return true;
}

/// Whether anything but coverage and units stands in a line of a relative u_c or U, which may say that it is a part of a full scale.
bool says_of_what(const SheetView& sheet, const SheetView::Row& row, const NamedLine& line) {
    return line.named.says_of_what || !says_coverage_alone(line.named.assigned) ||
           std::any_of(row.begin(), row.end(), [&](const Cell* cell) {
               const bool is_text = cell != row[line.cell] && sheet.value(*cell).kind == CellKind::text;
               return is_text && !says_coverage_alone(sheet.words(*cell));
           });
}

/// What was taken of a line.
struct TakenStatement {
    Statement statement = Statement::value;
    const Cell* number = nullptr;  ///< behind which further ones may stand
};
std::optional<TakenStatement> take_first(const SheetView& sheet, const SheetView::Row& row, const Heads* heads,
                                         Statements& statements, std::vector<Sentence>& not_read);

/// Takes what stands behind the number of a statement in its line: "u_c = | 0.186 | k = | 2 | U = | 0.37".
void take_further(const SheetView& sheet, const SheetView::Row& row, const Cell& number, Statements& statements,
                  std::vector<Sentence>& not_read) {
    constexpr std::size_t k_most_cells = 64;  // of one statement, with its unit and what is said of coverage
    std::uint32_t behind = number.address.column;
    for (std::size_t i = 0; i < row.size(); ++i) {
        if (row[i]->address.column <= behind || sheet.value(*row[i]).kind != CellKind::text) {
            continue;
        }
        const std::string held = sheet.words(*row[i]);
        const std::optional<NamedStatement> named = named_statement(held);
        const bool is_name = named && is_of_coverage(named->statement) && !(known_unit(held) && held != "k");
        const bool has_number =
            is_name && named->assigned.empty() && i + 1 < row.size() && sheet.number_with_unit(*row[i + 1]);
        // "U = 0.755 mV" is one cell; "k = 2" beside U is said of it.
        const bool is_assigned = is_name && named->statement != Statement::k && !named->assigned.empty() &&
                                 sheet.number_in_text(named->assigned, *row[i]);
        if (has_number || is_assigned) {
            const auto begin = row.begin() + static_cast<std::ptrdiff_t>(i);
            const auto cells = static_cast<std::ptrdiff_t>(std::min(row.size() - i, k_most_cells));
            const std::optional<TakenStatement> taken =
                take_first(sheet, {begin, begin + cells}, nullptr, statements, not_read);
            if (!taken || taken->number == nullptr) {
                return;
            }
            behind = taken->number->address.column;
        }
    }
}

/// Takes the first thing that a line states.
std::optional<TakenStatement> take_first(const SheetView& sheet, const SheetView::Row& row, const Heads* heads,
                                         Statements& statements, std::vector<Sentence>& not_read) {
    const std::optional<NamedLine> line = name_of_line(sheet, row, heads);
    if (!line) {
        return std::nullopt;
    }
    const Statement statement = line->named.statement;
    if (is_in_words(statement)) {
        take_words(sheet, row, *line, statements);
        return TakenStatement{.statement = statement};
    }
    if (take_value_with_U(sheet, row, *line, statements, not_read)) {
        return TakenStatement{.statement = statement};
    }
    const NumbersUnderHeads numbers =
        heads != nullptr && is_of_coverage(statement) ? numbers_under(sheet, *heads, row) : NumbersUnderHeads{};
    // "Expanded | 2 | 0.032": what stands under a head that nobody knows may be a k, and is no U beside one under u. No k is larger
    // than 5, or smaller than 1.
    constexpr double k_least = 1.0, k_most = 5.0;
    const bool has_unknown =
        heads != nullptr && std::any_of(heads->unknown.begin(), heads->unknown.end(), [&](const Cell* head) {
            const Cell* cell = cell_in(row, head->address.column);
            const std::optional<NumberWithUnit> number = cell != nullptr ? sheet.number_with_unit(*cell) : std::nullopt;
            return number && number->unit.empty() && number->number.value >= k_least && number->number.value <= k_most;
        });
    const bool has_amount = numbers.contains(Column::u) || numbers.contains(Column::contribution);
    const bool is_of_heads =
        (numbers.size() > 1 || (has_amount && has_unknown)) && !is_number_with_one(sheet, row, *line);
    const Cell* by_head = is_of_heads ? number_by_head(statement, numbers) : nullptr;
    std::optional<StatedResult> result;
    const Cell* at = by_head;
    if (by_head != nullptr) {
        result = result_in(sheet, *by_head, statement, not_read);
    }
    if (!result && !line->named.assigned.empty()) {
        if (std::optional<NumberWithUnit> number = sheet.number_in_text(line->named.assigned, *row[line->cell])) {
            if (number->is_open) {
                not_read.push_back(open_sign(sheet.place(row[line->cell]->address), sheet.words(*row[line->cell])));
            } else {
                const bool has_unit = is_of_result(statement) || statement == Statement::coverage_probability;
                std::string unit = has_unit ? number->unit : "";
                result = StatedResult{.number = has_unit ? std::move(number->number) : without_dimension(*number),
                                      .unit = std::move(unit),
                                      .column = row[line->cell]->address.column};
            }
        }
    }
    std::optional<Sentence> unread;  // words where a number should stand
    bool is_told = false;            // of a number that is not used
    const BesideNumber beside(sheet, row, heads, *line);
    for (std::size_t i = line->from; i < row.size() && !result && by_head == nullptr; ++i) {
        if (i == line->cell) {
            continue;
        }
        const std::string held = sheet.words(*row[i]);
        const bool number_follows = i + 1 < row.size() && sheet.number(*row[i + 1]);
        const bool is_unit = (held == "1" && is_of_result(statement) && number_follows) ||
                             (beside.is_under(Column::unit, *row[i]) && known_unit(held) && number_follows);
        if (is_unit) {
            continue;
        }
        const std::size_t told = not_read.size();
        result = result_in(sheet, *row[i], statement, not_read);
        is_told = is_told || not_read.size() != told;
        at = result ? row[i] : nullptr;
        // "> 500" is no number that could be held against another one.
        if (!result && !unread && !says_nothing(held) && !held.starts_with('>') && !held.starts_with("≥")) {
            unread =
                say("{cell}: {text} is no number; what is meant?", sheet.place(row[i]->address), text::in_quotes(held));
        }
    }
    if (result) {
        const bool has_unit = is_of_result(statement);
        const std::string name = sheet.words(*row[line->cell]);
        for (const std::string& unit :
             {has_unit ? beside.unit(at, by_head != nullptr) : std::string(),
              has_unit ? beside.one(at, by_head != nullptr) : std::string(), unit_in_head(name)}) {
            result->unit = result->unit.empty() ? unit : result->unit;
        }
        // "U reported (CMC)": what is reported is the capability.
        if (statement == Statement::reported_U &&
            (name.find("(CMC)") != std::string::npos || name.find("(BMC)") != std::string::npos)) {
            statements.numbers.emplace(Statement::capability, *result);
        }
        const auto held = statements.numbers.find(statement);
        if (line->named.is_relative && !is_unit_of_part(unit_under(heads, *result))) {
            return std::nullopt;  // a part, in a unit that nobody states
        }
        result->is_relative = line->named.is_relative && !says_of_what(sheet, row, *line);
        if (may_be_part(statement) && held != statements.numbers.end()) {
            const std::string of_held = unit_under(heads, held->second), of_this = unit_under(heads, *result);
            if (is_part_beside(of_held, of_this)) {  // "U | 0.004 | %" before "U | 0.4 | mV"
                held->second.unit = of_held;
                statements.parts.emplace(statement, std::move(held->second));
                statements.numbers.erase(held);
            } else if (is_part_beside(of_this, of_held)) {
                statements.parts.emplace(statement, *result);
            }
        }
        replace_U_of_one(*line, statement, statements);
        tell_second(statement, *result, name, heads, statements, not_read);
        statements.numbers.emplace(statement, std::move(*result));
    }
    const bool is_number = statement == Statement::k || statement == Statement::nu_eff || statement == Statement::U ||
                           statement == Statement::u_c || statement == Statement::reported_U;
    if (!result && is_number && unread && !is_told) {
        not_read.push_back(std::move(*unread));
    }
    if (by_head != nullptr) {
        take_others(sheet, statement, numbers, statements, not_read);
    }
    if (statement == Statement::U || statement == Statement::reported_U) {
        take_coverage(sheet, row, *line, statements);
    }
    if (const std::string held = sheet.words(*row[line->cell]);
        statement == Statement::k && statements.coverage.empty() && coverage_in(held).p) {
        statements.coverage = held;
        statements.coverage_place = sheet.place(row[line->cell]->address);
    }
    return TakenStatement{.statement = statement,
                          .number = by_head == nullptr && is_of_coverage(statement) ? at : nullptr};
}

/// What the head of a column of results states: "U", "U (mV)", "U / mV".
std::optional<NamedStatement> named_head(const std::string& head) {
    std::optional<NamedStatement> named = named_statement(head);
    if (const std::size_t slash = head.find('/');
        !named && slash != std::string::npos && known_unit(unit_in_head(head))) {
        named = named_statement(head.substr(0, slash));
    }
    return named;
}

/// How many lines below heads of results, from the first one, have numbers under two of these heads at least. A line named like a
/// statement, but for the value, is that statement, and none of a point.
std::size_t points_below(const SheetView& sheet, const std::vector<SheetView::Row>& below,
                         const std::map<std::uint32_t, Statement>& columns) {
    const auto is_point = [&](const SheetView::Row& row) {
        const auto numbers = std::count_if(columns.begin(), columns.end(), [&](const auto& column) {
            const Cell* cell = cell_in(row, column.first);
            return cell != nullptr && sheet.number_with_unit(*cell).has_value();
        });
        const std::optional<NamedLine> line = name_of_line(sheet, row, nullptr);
        return numbers > 1 && (!line || line->named.statement == Statement::value);
    };
    return static_cast<std::size_t>(std::find_if_not(below.begin(), below.end(), is_point) - below.begin());
}

}  // namespace

std::optional<StatedResult> result_in(const SheetView& sheet, const Cell& cell, Statement statement,
                                      std::vector<Sentence>& not_read) {
    std::optional<NumberWithUnit> number = sheet.number_with_unit(cell);
    if (!number) {  // "k = 2.08" in a line of k
        const std::string held = sheet.words(cell);
        const std::optional<NamedStatement> named = named_statement(held);
        if (named && named->statement == statement && !named->assigned.empty()) {
            number = sheet.number_in_text(named->assigned, cell);
        }
    }
    if (!number) {
        return std::nullopt;
    }
    if (number->is_open) {
        not_read.push_back(open_sign(sheet.place(cell.address), sheet.words(cell)));
        return std::nullopt;
    }
    if (is_of_result(statement)) {
        number = sheet.as_shown(std::move(*number), cell);
    } else if (statement != Statement::coverage_probability) {
        number = NumberWithUnit{.number = without_dimension(std::move(*number)), .unit = ""};
    }
    return StatedResult{
        .number = std::move(number->number), .unit = std::move(number->unit), .column = cell.address.column};
}

std::optional<Statement> take_statement(const SheetView& sheet, const SheetView::Row& row, const Heads* heads,
                                        Statements& statements, std::vector<Sentence>& not_read) {
    const std::optional<TakenStatement> taken = take_first(sheet, row, heads, statements, not_read);
    if (!taken) {
        return std::nullopt;
    }
    if (taken->number != nullptr) {
        take_further(sheet, row, *taken->number, statements, not_read);
    }
    return taken->statement;
}

std::size_t take_results_below(const SheetView& sheet, const SheetView::Row& heads,
                               const std::vector<SheetView::Row>& below, Statements& statements,
                               std::vector<Sentence>& not_read) {
    std::map<std::uint32_t, Statement> columns;
    std::map<std::uint32_t, std::string> units;
    std::optional<std::uint32_t> of_units;
    std::string coverage;
    std::set<Statement> different;
    for (const Cell* cell : heads) {
        const std::string held = sheet.words(*cell);
        if (held.empty()) {
            continue;
        }
        if (sheet.value(*cell).kind != CellKind::text || sheet.number_with_unit(*cell)) {
            return 0;
        }
        const std::optional<NamedStatement> named = named_head(held);
        if (column_of(held) == Column::unit) {
            of_units = cell->address.column;
        }
        if (!named || !is_of_coverage(named->statement) || !named->assigned.empty()) {
            continue;
        }
        columns.emplace(cell->address.column, named->statement);
        units.emplace(cell->address.column, unit_in_head(held));
        different.insert(named->statement);
        coverage = named->statement == Statement::U ? named->coverage : coverage;
    }
    const bool has_uncertainty = different.contains(Statement::u_c) || different.contains(Statement::U);
    if (different.size() < 2 || different.size() != columns.size() || !has_uncertainty) {
        return 0;
    }
    const std::size_t points = points_below(sheet, below, columns);
    if (points > 1) {
        not_read.push_back(
            say("{cell}: results of several points stand below each other, and none of them is used; which one is "
                "the table above of?",
                sheet.place(heads.front()->address)));
    }
    if (points != 1) {
        return points;
    }
    const SheetView::Row& row = below.front();
    const Cell* unit_cell = of_units ? cell_in(row, *of_units) : nullptr;
    for (const auto& [column, statement] : columns) {
        const Cell* cell = cell_in(row, column);
        std::optional<StatedResult> result =
            cell == nullptr ? std::nullopt : result_in(sheet, *cell, statement, not_read);
        if (!result) {
            continue;
        }
        for (const std::string& unit :
             {units.at(column), unit_cell == nullptr ? std::string() : sheet.words(*unit_cell)}) {
            result->unit = result->unit.empty() && is_of_result(statement) ? unit : result->unit;
        }
        tell_second(statement, *result, sheet.words(*cell), nullptr, statements, not_read);
        statements.numbers.emplace(statement, std::move(*result));
    }
    if (statements.coverage.empty() && !coverage.empty()) {
        statements.coverage = coverage;
        statements.coverage_place = sheet.place(row.front()->address);
    }
    return points;
}

}  // namespace gumcert::audit
