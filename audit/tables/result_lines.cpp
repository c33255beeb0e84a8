#include "audit/tables/result_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "audit/claims.h"
#include "audit/row_meaning.h"
#include "audit/tables/parts_of_value.h"
#include "audit/words/column_heads.h"
#include "audit/words/coverage_words.h"
#include "audit/words/named_statement.h"
#include "audit/words/stated_rule.h"
#include "audit/words/unit_words.h"
#include "gum/quantity/unit.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;
using workbook::CellValue;

/// Whether a statement is made in words: "100 mm gauge block" is a name, and no number.
bool is_in_words(Statement statement) {
    return statement == Statement::verdict || statement == Statement::decision_rule || statement == Statement::method ||
           statement == Statement::measurand || statement == Statement::equation;
}

/// Whether a statement is one of value, uncertainty and coverage, which a line of the table may state under its heads.
bool is_of_coverage(Statement statement) {
    return statement == Statement::value || statement == Statement::u_c || statement == Statement::nu_eff ||
           statement == Statement::k || statement == Statement::U || statement == Statement::reported_U;
}

/// Whether a word beside a number may be a unit that this program does not know, as "HRC": no distribution, nothing that is said
/// of coverage, no sentence.
bool may_be_unit(const std::string& text) {
    constexpr std::size_t k_longest = 16;
    const Shape shape = shape_of(text);
    const bool begins_like_a_number =
        !text.empty() &&
        (std::string_view("<>=+.").find(text[0]) != std::string_view::npos || (text[0] >= '0' && text[0] <= '9') ||
         text.starts_with("≥") || text.starts_with("≤") || text.starts_with("±"));
    return text.size() <= k_longest && !begins_like_a_number && (shape == Shape::not_stated || shape == Shape::other) &&
           text.find('=') == std::string::npos && !coverage_in(text).says_any();
}

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

/// What stands beside the number of a statement.
class Beside {
public:
    Beside(const SheetView& sheet, const SheetView::Row& row, const Heads* heads, const NamedLine& line)
        : sheet_(sheet), row_(row), heads_(heads), named_(line.cell), from_(line.from) {}

    /// \param number  the cell that has it; nullptr where the name has it
    /// \param by_head whether its column said so
    [[nodiscard]] std::string unit(const Cell* number, bool by_head) const {
        std::string known, word, dash;
        for (std::size_t i = from_; i < row_.size(); ++i) {
            const std::string held = sheet_.words(*row_[i]);
            const std::uint32_t column = row_[i]->address.column;
            const bool is_directly_beside =
                number != nullptr && (column + 1 == number->address.column || number->address.column + 1 == column);
            if (held == "-" || held == "–") {  // of a quantity without dimension
                const bool is_unit = is_under(Column::unit, *row_[i]) || (is_directly_beside && !by_head);
                dash = is_unit && dash.empty() ? held : dash;
            }
            if (i == named_ || row_[i] == number || says_nothing(held)) {
                continue;
            }
            const bool is_number = sheet_.number_with_unit(*row_[i]).has_value();
            if (is_under(Column::unit, *row_[i]) && (is_number ? held == "1" : may_be_unit(held))) {
                return held;
            }
            if (is_number) {
                continue;
            }
            const bool is_beside = is_next(number, i);
            if (is_under_words(*row_[i]) && !(is_directly_beside && !by_head && known_unit(held))) {
                continue;
            }
            if (known.empty() && known_unit(held)) {
                known = held;
            }
            // "u_c | 0.187 | U | 0.37": what names the next number is no unit of the one before it.
            const bool is_name = i + 1 < row_.size() && row_[i + 1] != number &&
                                 sheet_.number_with_unit(*row_[i + 1]) && named_statement(held);
            if (word.empty() && is_beside && !is_name && may_be_unit(held)) {
                word = held;
            }
        }
        known = known.empty() ? word : known;
        return known.empty() ? dash : known;
    }
    /// "1" beside a number: of a quantity without dimension. Under a head of numbers it may be a divisor or a coefficient.
    [[nodiscard]] std::string one(const Cell* number, bool by_head) const {
        for (std::size_t i = from_; i < row_.size() && !by_head; ++i) {
            if (sheet_.words(*row_[i]) != "1" || row_[i] == number) {
                continue;
            }
            const bool before = i + 1 < row_.size() && row_[i + 1] == number;
            const bool behind = i > 0 && row_[i - 1] == number && i + 1 == row_.size();
            if (before || behind) {
                return "1";
            }
        }
        return "";
    }
    [[nodiscard]] bool is_under(Column column, const Cell& cell) const {
        if (heads_ == nullptr) {
            return false;
        }
        const auto position = heads_->columns.find(column);
        return position != heads_->columns.end() && position->second == cell.address.column;
    }

private:
    [[nodiscard]] bool is_under_words(const Cell& cell) const {
        return is_under(Column::distribution, cell) || is_under(Column::type, cell) || is_under(Column::source, cell) ||
               is_under(Column::comment, cell);
    }
    /// Whether a cell is the next one to the number that holds anything.
    [[nodiscard]] bool is_next(const Cell* number, std::size_t i) const {
        const auto holds = [this](std::size_t at) { return !sheet_.words(*row_[at]).empty(); };
        std::size_t right = i + 1;
        while (right < row_.size() && !holds(right)) {
            ++right;
        }
        std::size_t left = i;
        while (left > from_ && !holds(left - 1)) {
            --left;
        }
        return (right < row_.size() && row_[right] == number) || (left > 0 && row_[left - 1] == number);
    }

    const SheetView& sheet_;
    const SheetView::Row& row_;
    const Heads* heads_;
    std::size_t named_, from_;
};

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

std::string words_of(const Statements& statements, Statement statement) {
    const auto found = statements.words.find(statement);
    return found == statements.words.end() ? "" : found->second;
}

/// Takes k and p out of the words beside U, where no line of their own states them.
void state_coverage_words(Claims& claims, const Statements& statements, std::vector<Sentence>& not_read) {
    claims.coverage_sentence = statements.coverage;
    const CoverageText words = coverage_in(statements.coverage);
    if (!words.k.empty()) {
        std::optional<LeadingNumber> k = read_leading_number(words.k, statements.coverage_place, Percent::unit);
        if (k && claims.k && !claims.k->interval().meets(k->number.interval())) {
            not_read.push_back(say("{cell}: {text} beside U, and k = {k:number} in {other}; which one holds?",
                                   statements.coverage_place, text::in_quotes(statements.coverage),
                                   text_of_claim(*claims.k), claims.k->place));
        }
        if (k && !claims.k) {
            claims.k = std::move(k->number);
        }
    }
    if (words.p && !claims.coverage_probability) {
        claims.coverage_probability = words.p;
    }
}

/// Whether an uncertainty is stated: of these a unit may be a part of the value.
bool may_be_part(Statement statement) {
    return statement == Statement::u_c || statement == Statement::U || statement == Statement::reported_U ||
           statement == Statement::capability;
}

/// The numbers of statements, in the unit of the result.
class ResultNumbers {
public:
    /// \param of_contributions  the unit that contributions state
    /// \param of_rows           that of all rows that are added as they are
    ResultNumbers(const Statements& statements, const std::string& of_contributions, const std::string& of_rows,
                  std::vector<Sentence>& not_read)
        : statements_(statements), not_read_(not_read) {
        const std::string of_value = own(Statement::value);
        // U in percent below rows and u_c in volts is a part of the value: the budget is in volts.
        // So is u_c in percent.
        const std::string& of_added = of_contributions.empty() ? of_rows : of_contributions;
        const std::string of_u_c = is_part_beside(own(Statement::u_c), of_added) ? "" : own(Statement::u_c);
        for (const std::string& unit : {of_u_c, of_contributions, of_rows}) {
            of_sum_ = of_sum_.empty() ? unit : of_sum_;
        }
        if (!statements.unit_of_parts.empty()) {  // and U in volts below rows in percent is their U times the value
            of_sum_.clear();
            for (const Statement statement : {Statement::reported_U, Statement::U, Statement::u_c}) {
                const std::string unit = own(statement);
                unit_ = unit_.empty() && is_unit_of_part(unit) ? unit : unit_;
            }
            unit_ = of_sum_ = unit_.empty() ? statements.unit_of_parts : unit_;
            return;
        }
        for (const std::string& unit :
             {own(Statement::reported_U), own(Statement::U), own(Statement::u_c), of_contributions, of_value,
              own(Statement::capability), own(Statement::lower_limit), own(Statement::upper_limit),
              own(Statement::tolerance), own(Statement::reference_value), of_rows}) {
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
        const bool is_of_whole = !statements_.unit_of_parts.empty() && is_part_beside(unit_, from);
        const bool may_be_held = may_be_part(statement) && statement != Statement::capability && has_parts_of_value();
        if (!factor && ((is_of_whole && statement == Statement::value) ||
                        (may_be_held && (is_of_whole || is_part_beside(from, unit_))))) {
            return std::nullopt;  // take_parts_of_value() looks at it
        }
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
    [[nodiscard]] const std::string& value_unit() const {
        static const std::string none;
        const auto value = statements_.numbers.find(Statement::value);
        return value == statements_.numbers.end() ? none : value->second.unit;
    }
    [[nodiscard]] bool has_parts_of_value() const {
        const auto value = statements_.numbers.find(Statement::value);
        const std::string& of = statements_.unit_of_parts.empty() ? unit_ : value_unit();
        return value != statements_.numbers.end() && factor_between(value->second.unit, of) &&
               has_parts(value->second.number, of);
    }
    /// The unit of a statement; "" where it has none, or is a part of a result whose rows are added in a unit.
    [[nodiscard]] std::string own(Statement statement) const {
        const auto found = statements_.numbers.find(statement);
        const std::string unit = found == statements_.numbers.end() ? "" : found->second.unit;
        return may_be_part(statement) && is_part_beside(unit, of_sum_) ? "" : unit;
    }

    std::string of_sum_;  ///< unit in which rows are added
    const Statements& statements_;
    std::vector<Sentence>& not_read_;
    std::string unit_;
    bool has_two_units_ = false;  ///< the value is in another unit than its uncertainty
};

void state_limits(AuditedBudget& budget, const Statements& statements, ResultNumbers& numbers,
                  std::vector<Sentence>& not_read) {
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
    if (const std::optional<StatedRule> stated = stated_rule(rule)) {
        budget.rule = stated->rule;
        budget.rule_parameters = stated->parameters;
    } else if (!rule.empty()) {
        budget.rule_not_known = rule;
        not_read.push_back(
            say("the decision rule {text} is not known; nothing is decided by it; which one of DR-01 to "
                "DR-13 is it?",
                text::in_quotes(rule)));
    }
}

}  // namespace

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

namespace {

/// "10.002 bar ± 4.9 mbar (k = 2)", "(10.0020 ± 0.0047) bar; k = 2": a value and its U (JCGM 100:2008, 7.2.4).
struct ValueWithU {
    NumberWithUnit value, U;
    std::string_view behind;  ///< U, with what is said of coverage
};
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

}  // namespace

namespace {

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

namespace {

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

}  // namespace

namespace {

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
    const Beside beside(sheet, row, heads, *line);
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

}  // namespace

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

namespace {

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

void state_claims(AuditedBudget& budget, const Statements& statements, const std::string& of_contributions,
                  const std::string& of_rows, std::vector<Sentence>& not_read) {
    ResultNumbers numbers(statements, of_contributions, of_rows, not_read);
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
    state_coverage_words(claims, statements, not_read);
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
    state_limits(budget, statements, numbers, not_read);
    if (const std::string measurand = words_of(statements, Statement::measurand); !measurand.empty()) {
        budget.name = measurand;
    }
}

}  // namespace gumcert::audit
