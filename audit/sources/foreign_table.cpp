#include "audit/sources/foreign_table.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include "audit/checklists.h"
#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/sources/budget_words.h"
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

/// The cells of a sheet row by row, with the values that formulas give.
class SheetView {
public:
    SheetView(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation, std::size_t sheet)
        : workbook_(workbook),
          evaluation_(evaluation),
          sheet_(sheet),
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
        const CellValue held = value(cell);
        if (held.kind == CellKind::number) {
            if (cell.formula_kind == workbook::FormulaKind::none && !has_formulas()) {
                if (std::optional<StatedNumber> printed = read_number(held.text, place(cell.address))) {
                    printed->value = held.number;
                    return printed;
                }
            }
            return exact_number(held.number, place(cell.address));
        }
        if (held.kind == CellKind::text) {
            return read_number(held.text, place(cell.address));
        }
        return std::nullopt;
    }
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
    std::string name_;  ///< of the sheet, as formulas write it
    std::map<std::uint32_t, std::vector<const Cell*>> rows_;
};

/// Which column of the sheet has which meaning, and the units that heads state: "u [µm]".
struct Heads {
    std::map<Column, std::uint32_t> columns;
    std::map<Column, std::string> units;
};

std::string unit_of_head(const std::string& head) {
    const std::size_t open = head.find('['), close = head.find(']');
    if (open != std::string::npos && close != std::string::npos && close > open + 1) {
        return head.substr(open + 1, close - open - 1);
    }
    const std::size_t slash = head.rfind(" / ");
    return slash != std::string::npos ? head.substr(slash + 3) : "";
}

std::optional<Heads> heads_of(const SheetView& sheet, const std::vector<const Cell*>& row) {
    Heads heads;
    for (const Cell* cell : row) {
        const CellValue held = sheet.value(*cell);
        if (held.kind != CellKind::text) {
            continue;
        }
        const std::optional<Column> column = column_of(held.text);
        if (column && heads.columns.emplace(*column, cell->address.column).second) {
            heads.units[*column] = unit_of_head(held.text);
        }
    }
    const auto has = [&heads](Column column) { return heads.columns.contains(column); };
    const bool uncertainty = has(Column::u) || has(Column::stated) || has(Column::contribution);
    return has(Column::quantity) && uncertainty && heads.columns.size() >= 3 ? std::optional(heads) : std::nullopt;
}

const Cell* cell_in(const std::vector<const Cell*>& row, std::uint32_t column) {
    const auto found =
        std::find_if(row.begin(), row.end(), [column](const Cell* cell) { return cell->address.column == column; });
    return found == row.end() ? nullptr : *found;
}

/// One row of a table being read.
class RowReader {
public:
    RowReader(const SheetView& sheet, const Heads& heads, const std::vector<const Cell*>& row,
              std::vector<Sentence>& not_read)
        : sheet_(sheet), heads_(heads), row_(row), not_read_(not_read) {}

    [[nodiscard]] AuditedRow read() {
        AuditedRow read;
        read.quantity = words(Column::quantity);
        read.unit = words(Column::unit);
        read.source = words(Column::source);
        read.comment = words(Column::comment);
        if (const Cell* cell = at(Column::quantity)) {
            read.place = sheet_.place(cell->address);
        }
        if (read.unit.empty()) {
            const auto unit = heads_.units.find(Column::u);
            read.unit = unit == heads_.units.end() ? "" : unit->second;
        }
        read.estimate = number(Column::estimate);
        read.stated = number(Column::stated);
        read.divisor = number(Column::divisor);
        read.u = number(Column::u);
        read.sensitivity = number(Column::sensitivity);
        read.contribution = number(Column::contribution);
        read.nu = number(Column::nu);
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
        read.contributor = contributor_of(read.quantity, read.comment, read.source);
        read_comment(read);
        complete_row(read);
        note_row_facts(read);
        return read;
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
    [[nodiscard]] std::optional<StatedNumber> number(Column column) {
        const Cell* cell = at(column);
        if (cell == nullptr) {
            return std::nullopt;
        }
        std::optional<StatedNumber> read = sheet_.number(*cell);
        const std::string held = sheet_.words(*cell);
        const bool says_nothing = held.empty() || held == "-" || held == "–" || held == "—";
        if (!read && !says_nothing) {
            // "0.36 µm" in a cell of numbers: the number counts, and the unit where none is stated.
            if (std::optional<LeadingNumber> leading = read_leading_number(held, sheet_.place(cell->address))) {
                return std::move(leading->number);
            }
            not_read_.push_back(
                say("{cell}: {text} is no number; what is meant?", sheet_.place(cell->address), text::in_quotes(held)));
        }
        return read;
    }

    const SheetView& sheet_;
    const Heads& heads_;
    const std::vector<const Cell*>& row_;
    std::vector<Sentence>& not_read_;
};

/// Statements on a result, from the rows above and below its table.
struct Statements {
    std::map<Statement, StatedNumber> numbers;
    std::map<Statement, std::string> words;
    std::string unit;
};

std::optional<Statement> take_statement(const SheetView& sheet, const std::vector<const Cell*>& row,
                                        Statements& statements) {
    std::optional<Statement> statement;
    std::size_t named = 0;
    for (std::size_t i = 0; i < row.size() && !statement; ++i) {
        const CellValue held = sheet.value(*row[i]);
        if (held.kind != CellKind::text) {
            return std::nullopt;  // a name stands before what it names
        }
        statement = statement_of(held.text);
        named = i;
        if (!statement && i > 0) {
            return std::nullopt;
        }
    }
    if (!statement) {
        return std::nullopt;
    }
    const auto follows_number = [&](std::size_t i) {
        return i + 1 < row.size() && sheet.number(*row[i + 1]).has_value();
    };
    for (std::size_t i = named + 1; i < row.size(); ++i) {
        if (sheet.words(*row[i]) == "1" && follows_number(i)) {
            statements.unit = statements.unit.empty() ? "1" : statements.unit;  // of a quantity without dimension
            continue;
        }
        if (std::optional<StatedNumber> number = sheet.number(*row[i])) {
            statements.numbers.emplace(*statement, std::move(*number));
            continue;
        }
        const std::string held = sheet.words(*row[i]);
        if (held.empty()) {
            continue;
        }
        std::optional<LeadingNumber> leading = read_leading_number(held, sheet.place(row[i]->address));
        if (leading && !statements.numbers.contains(*statement)) {
            statements.numbers.emplace(*statement, std::move(leading->number));
            if (statements.unit.empty()) {
                statements.unit = leading->rest;
            }
        } else {
            statements.words.emplace(*statement, held);
        }
    }
    const bool has_unit = *statement == Statement::U || *statement == Statement::u_c ||
                          *statement == Statement::value || *statement == Statement::reported_U;
    if (has_unit && statements.unit.empty()) {
        const auto words = statements.words.find(*statement);
        statements.unit = words == statements.words.end() ? "" : words->second;
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

std::optional<StatedNumber> number_of(const Statements& statements, Statement statement) {
    const auto found = statements.numbers.find(statement);
    return found == statements.numbers.end() ? std::nullopt : std::optional(found->second);
}
std::optional<double> value_of(const Statements& statements, Statement statement) {
    const std::optional<StatedNumber> number = number_of(statements, statement);
    return number ? std::optional(number->value) : std::nullopt;
}
std::string words_of(const Statements& statements, Statement statement) {
    const auto found = statements.words.find(statement);
    return found == statements.words.end() ? "" : found->second;
}

void state_limits(AuditedBudget& budget, const Statements& statements) {
    budget.limits.lower = value_of(statements, Statement::lower_limit);
    budget.limits.upper = value_of(statements, Statement::upper_limit);
    const std::optional<double> tolerance = value_of(statements, Statement::tolerance);
    if (tolerance && !budget.limits.lower && !budget.limits.upper) {
        const double nominal = value_of(statements, Statement::nominal).value_or(0.0);
        budget.limits.lower = nominal - std::abs(*tolerance);
        budget.limits.upper = nominal + std::abs(*tolerance);
    }
    const std::string rule = words_of(statements, Statement::decision_rule);
    budget.rule = gum::decision_rule_from_id(rule.substr(0, 5));
}

void state_claims(AuditedBudget& budget, const Statements& statements) {
    Claims& claims = budget.claims;
    claims.value = number_of(statements, Statement::value);
    claims.u_c = number_of(statements, Statement::u_c);
    claims.nu_eff = number_of(statements, Statement::nu_eff);
    claims.k = number_of(statements, Statement::k);
    claims.U = number_of(statements, Statement::reported_U);
    if (!claims.U) {
        claims.U = number_of(statements, Statement::U);
    }
    claims.coverage_probability = value_of(statements, Statement::coverage_probability);
    if (claims.coverage_probability && *claims.coverage_probability > 1.0) {
        *claims.coverage_probability /= 100.0;  // "95" without its percent sign
    }
    claims.verdict = verdict_in_our_words(words_of(statements, Statement::verdict));
    claims.en = number_of(statements, Statement::en);
    budget.value = claims.value ? std::optional(claims.value->value) : std::nullopt;
    budget.unit = statements.unit;
    budget.equation = words_of(statements, Statement::equation);
    budget.method = words_of(statements, Statement::method);
    budget.capability = value_of(statements, Statement::capability);
    if (budget.capability && claims.U) {
        budget.floor_applied = claims.U->value + claims.U->half_step >= *budget.capability;
    }
    const std::optional<double> reference = value_of(statements, Statement::reference_value);
    const std::optional<double> reference_U = value_of(statements, Statement::reference_U);
    if (reference && reference_U) {
        budget.reference =
            ComparedReference{.value = *reference, .expanded_uncertainty = *reference_U, .name = "reference value"};
    }
    state_limits(budget, statements);
    if (const std::string measurand = words_of(statements, Statement::measurand); !measurand.empty()) {
        budget.name = measurand;
    }
}

/// Reads one sheet from top to bottom.
class TableReader {
public:
    TableReader(const SheetView& sheet, std::string name, ForeignTables& tables)
        : sheet_(sheet), name_(std::move(name)), tables_(tables) {}

    void read() {
        std::uint32_t last = 0;
        for (const auto& [number, row] : sheet_.rows()) {
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
            in_rows_ = true;
            budget_.place = sheet_.place({.row = number, .column = row.front()->address.column});
            return;
        }
        if (!is_row_of_numbers(row) && take_statement(sheet_, row, statements_)) {
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
        AuditedRow read = RowReader(sheet_, *heads_, row, tables_.not_read).read();
        if (read.u || read.stated || read.contribution || has_formula_of_uncertainty(row)) {
            budget_.rows.push_back(std::move(read));
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
            numbers += cell != nullptr && sheet_.number(*cell) ? 1U : 0U;
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
        } else if (heads_ && !budget_.rows.empty()) {
            budget_.name = name_;
            state_claims(budget_, statements_);
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
        budget_ = {};
        statements_ = {};
        heads_.reset();
        in_rows_ = false;
        is_too_long_ = false;
    }

    const SheetView& sheet_;
    std::string name_;
    ForeignTables& tables_;
    std::optional<Heads> heads_;
    bool in_rows_ = false;
    bool is_too_long_ = false;
    AuditedBudget budget_;
    Statements statements_;
};

}  // namespace

ForeignTables budgets_in(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation,
                         const std::string& file) {
    ForeignTables tables;
    for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
        if (workbook.sheets[i].state != workbook::SheetState::visible) {
            continue;
        }
        const SheetView sheet(workbook, evaluation, i);
        const std::string name = workbook.sheets.size() == 1 ? file : file + ", " + workbook.sheets[i].name;
        TableReader(sheet, name, tables).read();
    }
    if (tables.budgets.empty()) {
        tables.not_read.push_back(say(
            "{file}: no uncertainty budget was found — a table begins with a row of heads, of which one names the "
            "quantities and one u, what is divided, or the contributions — name the columns so, in English or German",
            file));
    }
    return tables;
}

}  // namespace gumcert::audit
