#include "audit/sources/foreign_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "audit/checklists.h"
#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/sources/budget_words.h"
#include "audit/sources/table_units.h"
#include "text/numbers.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellAddress;
using workbook::CellKind;
using workbook::CellValue;

constexpr std::size_t k_most_tables = 10'000, k_most_rows = 2'000;

struct NumberWithUnit {
    StatedNumber number;
    std::string unit;      ///< "" where none stands there
    bool is_open = false;  ///< nobody can know its decimal sign
};

/// A number without dimension: of a divisor, k, or E_n.
StatedNumber without_dimension(NumberWithUnit read) {
    if (read.unit == "%") {
        convert(read.number, 0.01);
    }
    return std::move(read.number);
}

/// The decimal sign of a file, where its numbers show one: "1.200" alone may be 1.2 or 1200, and beside "0,5" it is 1200.
///
/// The numbers of cells decide, and where they show none, those in its words. In a workbook numbers are no texts, and show
/// nothing. Between columns that commas separate, a number without quotes has no comma: it has a point, if any sign.
DecimalSign decimal_sign_of(const workbook::Workbook& workbook) {
    std::size_t points = 0, commas = 0;
    bool open = false;
    const auto count = [&](DecimalSign shown) {
        points += shown == DecimalSign::point ? 1U : 0U;
        commas += shown == DecimalSign::comma ? 1U : 0U;
        open = open || shown == DecimalSign::open;
    };
    const auto each_cell = [&workbook](const auto& look) {
        for (const workbook::Sheet& sheet : workbook.sheets) {
            for (const Cell& cell : sheet.cells) {
                const bool is_text = cell.value.kind == CellKind::text ||
                                     (cell.value.kind == CellKind::number && workbook.csv_separator != '\0');
                if (is_text && sheet.state == workbook::SheetState::visible) {
                    look(cell.value.text);
                }
            }
        }
    };
    each_cell([&count](const std::string& text) {
        const std::optional<LeadingNumber> number = read_leading_number(text, "", Percent::unit);
        const bool is_number = number && (number->rest.empty() || known_unit(unit_in_rest(number->rest)));
        count(is_number ? number->shows : DecimalSign::each);
    });
    if (points + commas == 0) {
        each_cell([&count](const std::string& text) { count(decimal_sign_in(text)); });
    }
    // A slip of the keyboard or two do not make the sign of a table open.
    constexpr std::size_t k_few = 8;
    if (!open && points > k_few * commas) {
        return DecimalSign::point;
    }
    if (!open && commas > k_few * points) {
        return DecimalSign::comma;
    }
    return points + commas == 0 && !open && workbook.csv_separator == ',' ? DecimalSign::point : DecimalSign::open;
}

/// Without the signs that set thousands apart: on a page in another language "2.440" would be another number.
std::string without_groups(const StatedNumber& number) {
    const std::size_t decimal = number.half_step > 0.0 ? number.text.find_last_of(".,") : std::string::npos;
    std::string plain;
    for (std::size_t i = 0; i < number.text.size(); ++i) {
        const char c = number.text[i];
        if ((c != '.' && c != ',' && c != '\'') || i == decimal) {
            plain += c;
        }
    }
    return plain;
}

/// The cells of a sheet row by row, with the values that formulas give.
class SheetView {
public:
    /// \param sign  of the file
    SheetView(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation, std::size_t sheet,
              DecimalSign sign)
        : workbook_(workbook),
          evaluation_(evaluation),
          sheet_(sheet),
          sign_(sign),
          name_(workbook::quoted_sheet(workbook.sheets[sheet].name)) {
        for (const Cell& cell : workbook.sheets[sheet].cells) {
            rows_[cell.address.row].push_back(&cell);
        }
    }

    [[nodiscard]] const std::map<std::uint32_t, std::vector<const Cell*>>& rows() const { return rows_; }
    [[nodiscard]] std::string place(const CellAddress& address) const {
        return name_ + "!" + workbook::a1_text(address);
    }
    /// What the cell shows: of a formula the value that we computed, where we did.
    [[nodiscard]] CellValue value(const Cell& cell) const {
        if (cell.formula_kind != workbook::FormulaKind::none) {
            const workbook::EvaluatedCell* evaluated =
                workbook::find_evaluated(evaluation_, workbook_, sheet_, cell.address);
            if (evaluated != nullptr && evaluated->state != workbook::EvaluationState::not_evaluated) {
                return evaluated->value;
            }
        }
        return cell.value;
    }
    /// A number of a cell. One that a formula gave is exact; one that was typed has the digits that were typed, of
    /// which a spreadsheet computes as if they were exact.
    [[nodiscard]] std::optional<StatedNumber> number(const Cell& cell) const {
        std::optional<NumberWithUnit> read = number_with_unit(cell);
        return read && !read->is_open && (read->unit.empty() || read->unit == "%")
                   ? std::optional(std::move(read->number))
                   : std::nullopt;
    }
    /// The number that a cell begins with, and the unit behind it: "0.36 µm" and "5 %".
    [[nodiscard]] std::optional<NumberWithUnit> number_with_unit(const Cell& cell) const {
        const CellValue held = value(cell);
        const bool is_csv = workbook_.csv_separator != '\0';
        if (held.kind == CellKind::text || (held.kind == CellKind::number && is_csv)) {
            std::optional<LeadingNumber> leading =
                read_leading_number(held.text, place(cell.address), Percent::unit, sign_);
            if (leading) {
                leading->number.text = without_groups(leading->number);
            }
            return leading ? std::optional(NumberWithUnit{.number = std::move(leading->number),
                                                          .unit = unit_in_rest(leading->rest),
                                                          .is_open = leading->is_open})
                           : std::nullopt;
        }
        if (held.kind != CellKind::number) {
            return std::nullopt;
        }
        NumberWithUnit read{.number = exact_number(held.number, place(cell.address)), .unit = ""};
        if (cell.formula_kind == workbook::FormulaKind::none && !has_formulas()) {
            if (std::optional<StatedNumber> printed = read_number(held.text, place(cell.address))) {
                printed->value = held.number;
                // A workbook stores a point, whatever sign it shows.
                if (sign_ == DecimalSign::comma) {
                    std::replace(printed->text.begin(), printed->text.end(), '.', ',');
                }
                read.number = std::move(*printed);
            }
        }
        return read;
    }
    /// A number that its cell shows in percent, as it is shown: 0.0014 is 0.14 %.
    [[nodiscard]] NumberWithUnit as_shown(NumberWithUnit read, const Cell& cell) const {
        const std::vector<std::string>& formats = workbook_.number_formats;
        const bool in_percent = value(cell).kind == CellKind::number && cell.number_format < formats.size() &&
                                formats[cell.number_format].ends_with('%');
        return in_percent
                   ? NumberWithUnit{.number = exact_number(100.0 * read.number.value, read.number.place), .unit = "%"}
                   : std::move(read);
    }
    [[nodiscard]] DecimalSign decimal_sign() const { return sign_; }
    [[nodiscard]] std::string words(const Cell& cell) const {
        const CellValue held = value(cell);
        if (held.kind == CellKind::text) {
            return held.text;
        }
        return held.kind == CellKind::number ? (held.text.empty() ? text::shortest(held.number) : held.text) : "";
    }
    /// A table of values alone was computed elsewhere and rounded.
    [[nodiscard]] bool has_formulas() const { return !evaluation_.cells.empty(); }

private:
    const workbook::Workbook& workbook_;
    const workbook::Evaluation& evaluation_;
    std::size_t sheet_;
    DecimalSign sign_;
    std::string name_;  ///< of the sheet, as formulas write it
    std::map<std::uint32_t, std::vector<const Cell*>> rows_;
};

/// Which column of the sheet has which meaning, and where the units of its numbers stand.
struct Heads {
    std::map<Column, std::uint32_t> columns;
    std::map<Column, std::string> units;             ///< that heads state: "u [µm]"
    std::map<Column, std::uint32_t> unit_columns;    ///< of columns that have one of their own, to their right
    std::map<std::uint32_t, std::string> all_units;  ///< that heads state, by column of the sheet
    std::vector<const Cell*> second;                 ///< heads of columns of numbers whose meaning another one has
};

bool has_numbers_with_units(Column column) {
    return column == Column::estimate || column == Column::stated || column == Column::u ||
           column == Column::sensitivity || column == Column::contribution;
}

std::optional<Heads> heads_of(const SheetView& sheet, const std::vector<const Cell*>& row) {
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
            continue;
        }
        if (*column == Column::unit) {
            owned.emplace_back(before, cell->address.column);
        }
        if (heads.columns.emplace(*column, cell->address.column).second) {
            heads.units[*column] = unit_in_head(held.text);
            heads.all_units[cell->address.column] = heads.units[*column];
        } else if (has_numbers_with_units(*column) || *column == Column::divisor || *column == Column::nu) {
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
    return has(Column::quantity) && uncertainty && heads.columns.size() >= 3 ? std::optional(heads) : std::nullopt;
}

using Rows = std::map<std::uint32_t, std::vector<const Cell*>>;

/// Where the tables beside each other begin in a row of heads, which is where its quantities are headed again: the columns of
/// all but the first. Empty where there is one table, or none.
std::vector<std::uint32_t> further_tables(const SheetView& sheet, const std::vector<const Cell*>& row) {
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

/// The rows of a sheet in parts that are read one after the other: all of them, unless tables stand beside each other. Then
/// each table has its own columns, from the statements above it to those below.
std::vector<Rows> parts_of(const SheetView& sheet) {
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

const Cell* cell_in(const std::vector<const Cell*>& row, std::uint32_t column) {
    const auto found =
        std::find_if(row.begin(), row.end(), [column](const Cell* cell) { return cell->address.column == column; });
    return found == row.end() ? nullptr : *found;
}

Sentence open_sign(const std::string& place, const std::string& held) {
    return say(
        "{cell}: {text} may be set apart in thousands or have three decimals, and no other number of the file shows "
        "which; the number is not used; what is meant?",
        place, text::in_quotes(held));
}

/// One row of a table being read.
class RowReader {
public:
    RowReader(const SheetView& sheet, const Heads& heads, const std::vector<const Cell*>& row,
              std::vector<Sentence>& not_read)
        : sheet_(sheet), heads_(heads), row_(row), not_read_(not_read) {}

    [[nodiscard]] AuditedRow read(RowUnits& units) {
        AuditedRow read;
        read.decimal_sign = sheet_.decimal_sign();
        read.quantity = words(Column::quantity);
        read.source = words(Column::source);
        read.comment = words(Column::comment);
        if (const Cell* cell = at(Column::quantity)) {
            read.place = sheet_.place(cell->address);
        }
        read.estimate = number(Column::estimate, units.estimate);
        read.stated = number(Column::stated, units.stated);
        std::string none;
        read.divisor = number(Column::divisor, none);
        read.u = number(Column::u, units.u);
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
        for (std::optional<StatedNumber>* rounded : {&read.u, &read.contribution}) {
            if (*rounded) {
                (*rounded)->half_step = printed_half_step(**rounded);  // "12" of an uncertainty was rounded as well
            }
        }
        return read;
    }
    /// Whether the row has a number of which nobody can know the decimal sign.
    [[nodiscard]] bool has_open_number() const { return has_open_; }

private:
    [[nodiscard]] const Cell* at(Column column) const {
        const auto position = heads_.columns.find(column);
        return position == heads_.columns.end() ? nullptr : cell_in(row_, position->second);
    }
    [[nodiscard]] std::string words(Column column) const {
        const Cell* cell = at(column);
        return cell == nullptr ? "" : sheet_.words(*cell);
    }
    /// \param unit  that the cell, its head, or a column of units of its own states; else as it was
    [[nodiscard]] std::optional<StatedNumber> number(Column column, std::string& unit) {
        const Cell* cell = at(column);
        if (cell == nullptr) {
            return std::nullopt;
        }
        std::optional<NumberWithUnit> read = sheet_.number_with_unit(*cell);
        const std::string held = sheet_.words(*cell);
        const bool says_nothing = held.empty() || held == "-" || held == "–" || held == "—";
        if (!read) {
            if (!says_nothing) {
                not_read_.push_back(say("{cell}: {text} is no number; what is meant?", sheet_.place(cell->address),
                                        text::in_quotes(held)));
            }
            return std::nullopt;
        }
        if (read->is_open) {
            has_open_ = true;
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
        // Words behind a number that are no unit that we know count where no other place states one.
        const bool cell_first = !read->unit.empty() && (beside.empty() || known_unit(read->unit));
        unit = cell_first ? read->unit : beside;
        return std::move(read->number);
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
    bool has_open_ = false;
};

/// A number that a statement gives.
struct StatedResult {
    StatedNumber number;
    std::string unit;          ///< "" where none stands beside it
    std::uint32_t column = 0;  ///< where the number stands
};

/// Statements on a result, from the rows above and below its table.
struct Statements {
    std::map<Statement, StatedResult> numbers;
    std::map<Statement, std::string> words;
};

/// Whether a statement is a number with the dimension of the result.
bool is_of_result(Statement statement) {
    switch (statement) {
        case Statement::value:
        case Statement::u_c:
        case Statement::U:
        case Statement::reported_U:
        case Statement::capability:
        case Statement::lower_limit:
        case Statement::upper_limit:
        case Statement::tolerance:
        case Statement::nominal:
        case Statement::reference_value:
        case Statement::reference_U:
            return true;
        default:
            return false;
    }
}

/// Whether a statement is made in words: "100 mm gauge block" is a name, and no number.
bool is_in_words(Statement statement) {
    return statement == Statement::verdict || statement == Statement::decision_rule || statement == Statement::method ||
           statement == Statement::measurand || statement == Statement::equation;
}

std::optional<Statement> take_statement(const SheetView& sheet, const std::vector<const Cell*>& row,
                                        Statements& statements, std::vector<Sentence>& not_read) {
    std::optional<Statement> statement;
    std::size_t named = 0;
    std::string name;
    for (std::size_t i = 0; i < row.size() && !statement; ++i) {
        const CellValue held = sheet.value(*row[i]);
        if (held.kind != CellKind::text) {
            return std::nullopt;  // a name stands before what it names
        }
        statement = statement_of(held.text);
        named = i;
        name = held.text;
        if (!statement && i > 0) {
            return std::nullopt;
        }
    }
    if (!statement) {
        return std::nullopt;
    }
    const bool has_unit = is_of_result(*statement);
    const auto follows_number = [&](std::size_t i) {
        return i + 1 < row.size() && sheet.number(*row[i + 1]).has_value();
    };
    std::string of_quantity, of_cell, words;
    std::optional<StatedResult> result;
    for (std::size_t i = named + 1; i < row.size(); ++i) {
        const std::string held = sheet.words(*row[i]);
        if (held == "1" && follows_number(i)) {
            of_quantity = "1";  // of a quantity without dimension
            continue;
        }
        std::optional<NumberWithUnit> number;
        if (!result && !is_in_words(*statement)) {
            number = sheet.number_with_unit(*row[i]);
        }
        if (number && number->is_open) {
            not_read.push_back(open_sign(sheet.place(row[i]->address), held));
            continue;
        }
        if (number && has_unit) {
            number = sheet.as_shown(std::move(*number), *row[i]);
        } else if (number && *statement != Statement::coverage_probability) {
            number = NumberWithUnit{.number = without_dimension(std::move(*number)), .unit = ""};
        }
        if (number) {
            of_cell = number->unit;
            result = StatedResult{.number = std::move(number->number), .unit = "", .column = row[i]->address.column};
            continue;
        }
        if (held.empty() || (sheet.number(*row[i]) && !is_in_words(*statement))) {
            continue;
        }
        // The unit is the first word that is one, or the first word.
        if (words.empty() || (has_unit && !known_unit(words) && known_unit(held))) {
            words = held;
        }
    }
    if (result) {
        for (const std::string& unit : {of_cell, has_unit ? words : std::string(), of_quantity, unit_in_head(name)}) {
            result->unit = result->unit.empty() ? unit : result->unit;
        }
        statements.numbers.emplace(*statement, std::move(*result));
    }
    if (!words.empty()) {
        statements.words.emplace(*statement, std::move(words));
    }
    return statement;
}

std::string verdict_in_our_words(const std::string& verdict) {
    const std::string lower = text::in_small_letters(verdict);
    const auto is_one_of = [&lower](std::initializer_list<std::string_view> words) {
        return std::find(words.begin(), words.end(), lower) != words.end();
    };
    if (is_one_of({"pass", "passed", "conform", "conforms", "in tolerance", "ok", "erfüllt", "bestanden", "konform"})) {
        return "pass";
    }
    if (is_one_of({"fail", "failed", "does not conform", "out of tolerance", "nicht erfüllt", "nicht konform"})) {
        return "fail";
    }
    return verdict;
}

/// How the table comes from u_c to U: by the k that it claims. Whether that is t_p of its ν_eff, note_unexplained() sees.
void state_coverage(AuditedBudget& budget) {
    const Claims& claims = budget.claims;
    if (claims.coverage_probability) {
        budget.coverage.probability = *claims.coverage_probability;
    }
    std::optional<double> k;
    if (claims.k) {
        k = claims.k->value;
    } else if (claims.U && claims.u_c && claims.u_c->value > 0.0) {
        k = claims.U->value / claims.u_c->value;
    }
    if (!k || !(*k > 0.0)) {
        return;
    }
    budget.coverage.k = *k;
    budget.coverage.kind = CoverageRule::Kind::fixed;
}

std::string words_of(const Statements& statements, Statement statement) {
    const auto found = statements.words.find(statement);
    return found == statements.words.end() ? "" : found->second;
}

/// The numbers of statements, in the unit of the result.
class ResultNumbers {
public:
    /// \param of_contributions  the unit that contributions state
    ResultNumbers(const Statements& statements, const std::string& of_contributions, std::vector<Sentence>& not_read)
        : statements_(statements), not_read_(not_read) {
        const std::string of_value = own(Statement::value);
        for (const std::string& unit :
             {own(Statement::reported_U), own(Statement::U), own(Statement::u_c), of_contributions, of_value,
              own(Statement::capability), own(Statement::lower_limit), own(Statement::upper_limit),
              own(Statement::tolerance), own(Statement::reference_value)}) {
            unit_ = unit_.empty() ? unit : unit_;
        }
        unit_ = shared_unit(unit_, of_value);
        const std::optional<double> factor = factor_between(of_value, unit_);
        has_two_units_ = !of_value.empty() && factor != 1.0;
    }

    [[nodiscard]] const std::string& unit() const { return unit_; }
    /// Nothing where the statement is not there, or its unit cannot be turned into that of the result; then it is said.
    [[nodiscard]] std::optional<StatedNumber> number(Statement statement) {
        const auto found = statements_.numbers.find(statement);
        if (found == statements_.numbers.end()) {
            return std::nullopt;
        }
        StatedNumber number = found->second.number;
        if (!is_of_result(statement)) {
            return number;
        }
        const std::string& from = found->second.unit;
        const bool is_uncertainty = statement == Statement::U || statement == Statement::reported_U ||
                                    statement == Statement::u_c || statement == Statement::value;
        if (from.empty() && has_two_units_ && !is_uncertainty && number.value != 0.0) {
            not_read_.push_back(
                say("{cell}: no unit is stated, and value and U are in {value} and {unit}; the number is not "
                    "used; in which unit is it?",
                    number.place, text::in_quotes(own(Statement::value)), text::in_quotes(unit_)));
            return std::nullopt;
        }
        const std::optional<double> factor = factor_between(from, unit_);
        if (!factor) {
            not_read_.push_back(
                say("{cell}: a number in {from} beside a result in {to}; it is not used, as one unit cannot "
                    "be turned into the other",
                    number.place, text::in_quotes(from), text::in_quotes(unit_)));
            return std::nullopt;
        }
        if (*factor != 1.0 && statement != Statement::value) {
            number.half_step = printed_half_step(number);
        }
        convert(number, *factor);
        return number;
    }
    [[nodiscard]] std::optional<double> value(Statement statement) {
        const std::optional<StatedNumber> stated = number(statement);
        return stated ? std::optional(stated->value) : std::nullopt;
    }

private:
    [[nodiscard]] std::string own(Statement statement) const {
        const auto found = statements_.numbers.find(statement);
        return found == statements_.numbers.end() ? "" : found->second.unit;
    }

    const Statements& statements_;
    std::vector<Sentence>& not_read_;
    std::string unit_;
    bool has_two_units_ = false;  ///< the value is in another unit than its uncertainty
};

void state_limits(AuditedBudget& budget, const Statements& statements, ResultNumbers& numbers) {
    budget.limits.lower = numbers.value(Statement::lower_limit);
    budget.limits.upper = numbers.value(Statement::upper_limit);
    const std::optional<double> tolerance = numbers.value(Statement::tolerance);
    const std::optional<double> nominal = numbers.value(Statement::nominal);
    // A nominal value that could not be read is not 0.
    const bool has_nominal = nominal || !statements.numbers.contains(Statement::nominal);
    if (tolerance && has_nominal && !budget.limits.lower && !budget.limits.upper) {
        budget.limits.lower = nominal.value_or(0.0) - std::abs(*tolerance);
        budget.limits.upper = nominal.value_or(0.0) + std::abs(*tolerance);
    }
    const std::string rule = words_of(statements, Statement::decision_rule);
    budget.rule = gum::decision_rule_from_id(rule.substr(0, 5));
}

void state_claims(AuditedBudget& budget, const Statements& statements, ResultNumbers& numbers) {
    Claims& claims = budget.claims;
    claims.value = numbers.number(Statement::value);
    claims.u_c = numbers.number(Statement::u_c);
    claims.nu_eff = numbers.number(Statement::nu_eff);
    claims.k = numbers.number(Statement::k);
    claims.U = numbers.number(Statement::reported_U);
    if (!claims.U) {
        claims.U = numbers.number(Statement::U);
    }
    claims.coverage_probability = numbers.value(Statement::coverage_probability);
    if (claims.coverage_probability && *claims.coverage_probability > 1.0) {
        *claims.coverage_probability /= 100.0;  // "95" and "95 %"
    }
    claims.verdict = verdict_in_our_words(words_of(statements, Statement::verdict));
    claims.en = numbers.number(Statement::en);
    budget.value = claims.value ? std::optional(claims.value->value) : std::nullopt;
    budget.unit = numbers.unit();
    budget.equation = words_of(statements, Statement::equation);
    budget.method = words_of(statements, Statement::method);
    budget.capability = numbers.value(Statement::capability);
    if (budget.capability && claims.U) {
        budget.floor_applied = claims.U->value + claims.U->half_step >= *budget.capability;
    }
    const std::optional<double> reference = numbers.value(Statement::reference_value);
    const std::optional<double> reference_U = numbers.value(Statement::reference_U);
    if (reference && reference_U) {
        budget.reference =
            ComparedReference{.value = *reference, .expanded_uncertainty = *reference_U, .name = "reference value"};
    }
    state_limits(budget, statements, numbers);
    if (const std::string measurand = words_of(statements, Statement::measurand); !measurand.empty()) {
        budget.name = measurand;
    }
}

/// Reads one sheet, or a part of it, from top to bottom.
class TableReader {
public:
    TableReader(const SheetView& sheet, std::string name, ForeignTables& tables)
        : sheet_(sheet), name_(std::move(name)), tables_(tables) {}

    void read(const Rows& rows) {
        std::uint32_t last = 0;
        for (const auto& [number, row] : rows) {
            if (number > last + 2) {
                in_rows_ = false;
            }
            last = number;
            if (tables_.budgets.size() >= k_most_tables) {
                tables_.not_read.push_back(
                    say("{cell}: what follows is not looked at; an audit takes up to {most:number} tables",
                        sheet_.place({.row = number, .column = row.front()->address.column}),
                        std::to_string(k_most_tables)));
                break;
            }
            take(number, row);
        }
        finish();
    }

private:
    void take(std::uint32_t number, const std::vector<const Cell*>& row) {
        if (std::optional<Heads> heads = heads_of(sheet_, row)) {
            Statements above = heads_ ? Statements{} : std::move(statements_);
            finish();
            statements_ = std::move(above);
            heads_ = std::move(heads);
            for (const Cell* cell : heads_->second) {
                tables_.not_read.push_back(
                    say("{cell}: the column {head} is not read, as another one of the table has its "
                        "meaning",
                        sheet_.place(cell->address), text::in_quotes(sheet_.words(*cell))));
            }
            in_rows_ = true;
            budget_.place = sheet_.place({.row = number, .column = row.front()->address.column});
            return;
        }
        if (!is_row_of_numbers(row) && take_statement(sheet_, row, statements_, tables_.not_read)) {
            in_rows_ = false;
            return;
        }
        if (!in_rows_ || !heads_ || is_too_long_) {
            return;
        }
        if (budget_.rows.size() == k_most_rows) {
            is_too_long_ = true;
            return;
        }
        RowUnits units;
        RowReader reader(sheet_, *heads_, row, tables_.not_read);
        AuditedRow read = reader.read(units);
        is_unusable_ = is_unusable_ || reader.has_open_number();
        if (read.u || read.stated || read.contribution || has_formula_of_uncertainty(row)) {
            budget_.rows.push_back(std::move(read));
            units_.push_back(std::move(units));
        }
    }

    /// Whether a line below heads has numbers in several of their columns: a quantity may be named "p" or "k", and what
    /// states a result has one number.
    [[nodiscard]] bool is_row_of_numbers(const std::vector<const Cell*>& row) const {
        if (!in_rows_ || !heads_) {
            return false;
        }
        std::size_t numbers = 0;
        for (const Column column : {Column::estimate, Column::stated, Column::divisor, Column::u, Column::sensitivity,
                                    Column::contribution, Column::nu}) {
            const auto position = heads_->columns.find(column);
            const Cell* cell = position == heads_->columns.end() ? nullptr : cell_in(row, position->second);
            numbers += cell != nullptr && sheet_.number_with_unit(*cell) ? 1U : 0U;
        }
        return numbers > 1;
    }

    /// A row whose numbers could not be evaluated is still a row: its divisor and formulas are looked at.
    [[nodiscard]] bool has_formula_of_uncertainty(const std::vector<const Cell*>& row) const {
        for (const Column column : {Column::u, Column::stated, Column::contribution}) {
            const auto position = heads_->columns.find(column);
            const Cell* cell = position == heads_->columns.end() ? nullptr : cell_in(row, position->second);
            if (cell != nullptr && cell->formula_kind != workbook::FormulaKind::none) {
                return true;
            }
        }
        return false;
    }

    void finish() {
        if (is_too_long_) {  // a part of its rows would give another u_c
            tables_.not_read.push_back(
                say("{table}: the table is not looked at; it has more than the {most:number} rows that an audit takes",
                    budget_.place, std::to_string(k_most_rows)));
        } else if (heads_ && (!budget_.rows.empty() || is_unusable_)) {
            budget_.name = name_;
            settle_statements();
            if (is_unusable_) {
                tables_.not_read.push_back(
                    say("{table}: the table is not looked at; a row has numbers that could not be read, and the others "
                        "do not "
                        "make up its result",
                        budget_.place));
                tables_.has_unusable = true;
                clear();
                return;
            }
            const std::optional<double> p = budget_.claims.coverage_probability;
            if (p && !(*p > 0.0 && *p < 1.0)) {
                tables_.not_read.push_back(
                    say("{table}: a coverage probability of {p:number} cannot be; what is meant?", budget_.place,
                        text::shortest(*p)));
                budget_.claims.coverage_probability.reset();
            }
            state_coverage(budget_);
            if (checklist_of(budget_.method) == nullptr) {
                budget_.method = method_in_title(budget_.method + " " + budget_.name);
            }
            settle_contributions(budget_);
            note_unexplained(budget_);
            tables_.budgets.push_back(std::move(budget_));
        }
        clear();
    }
    void clear() {
        budget_ = {};
        units_ = {};
        statements_ = {};
        heads_.reset();
        in_rows_ = false;
        is_too_long_ = is_unusable_ = false;
    }

    /// Brings statements and rows to the units that an audit takes, and reads what the words of rows say in them.
    void settle_statements() {
        std::string of_contributions = heads_->units[Column::contribution];
        for (const RowUnits& units : units_) {
            of_contributions = of_contributions.empty() ? units.contribution : of_contributions;
        }
        for (auto& [statement, result] : statements_.numbers) {
            const auto of_head = heads_->all_units.find(result.column);
            if (result.unit.empty() && is_of_result(statement) && of_head != heads_->all_units.end()) {
                result.unit = of_head->second;
            }
        }
        ResultNumbers numbers(statements_, of_contributions, tables_.not_read);
        state_claims(budget_, statements_, numbers);
        is_unusable_ = !settle_units(budget_.rows, units_, budget_.unit, tables_.not_read) || is_unusable_;
        for (AuditedRow& row : budget_.rows) {
            row.contributor = contributor_of(row.quantity, row.comment, row.source);
            read_comment(row);
            complete_row(row);
            note_row_facts(row);
        }
    }

    const SheetView& sheet_;
    std::string name_;
    ForeignTables& tables_;
    std::optional<Heads> heads_;
    bool in_rows_ = false;
    bool is_too_long_ = false;
    bool is_unusable_ = false;  ///< a row has an uncertainty that could not be read
    AuditedBudget budget_;
    std::vector<RowUnits> units_;  ///< of its rows
    Statements statements_;
};

}  // namespace

ForeignTables budgets_in(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation,
                         const std::string& file) {
    ForeignTables tables;
    const DecimalSign sign = decimal_sign_of(workbook);
    for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
        if (workbook.sheets[i].state != workbook::SheetState::visible) {
            continue;
        }
        const SheetView sheet(workbook, evaluation, i, sign);
        const std::string name = workbook.sheets.size() == 1 ? file : file + ", " + workbook.sheets[i].name;
        for (const Rows& rows : parts_of(sheet)) {
            TableReader(sheet, name, tables).read(rows);
        }
    }
    if (tables.budgets.empty() && !tables.has_unusable) {
        tables.not_read.push_back(say(
            "{file}: no uncertainty budget was found — a table begins with a row of heads, of which one names the "
            "quantities and one u, what is divided, or the contributions — name the columns so, in English or German",
            file));
    }
    return tables;
}

}  // namespace gumcert::audit
