#include "audit/tables/table_reader.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/audited_budget.h"
#include "audit/checklists.h"
#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/tables/claims_of_table.h"
#include "audit/tables/correlation_lines.h"
#include "audit/tables/head_lines.h"
#include "audit/tables/named_line.h"
#include "audit/tables/open_sums.h"
#include "audit/tables/parts_of_value.h"
#include "audit/tables/product_of_table.h"
#include "audit/tables/result_lines.h"
#include "audit/tables/results_of_table.h"
#include "audit/tables/row_lines.h"
#include "audit/tables/stated_results.h"
#include "audit/tables/sum_rows.h"
#include "audit/tables/table_so_far.h"
#include "audit/tables/table_sums.h"
#include "audit/words/column_heads.h"
#include "audit/words/named_statement.h"
#include "audit/words/sum_names.h"
#include "text/numbers.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;

constexpr std::size_t k_most_tables = 10'000;

/// Reads one sheet, or a part of it, from top to bottom.
class TableReader {
public:
    TableReader(const SheetView& sheet, const TablePart& part, const std::string& name, ForeignTables& tables,
                std::vector<std::string>& titles)
        : sheet_(sheet),
          rows_(part.rows),
          point_(part.point),
          name_(name),
          tables_(tables),
          not_read_(tables.not_read),
          titles_(titles) {}

    void read() {
        std::uint32_t last = 0;
        for (const auto& [number, row] : rows_) {
            if (number > last + 2) {
                in_rows_ = is_near_ = is_behind_results_ = false;
            }
            is_next_ = number == last + 1;
            last = number;
            if (tables_.budgets.size() + apart_.size() >= k_most_tables) {
                not_read_.push_back(
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
        if (number <= skip_until_) {
            return;
        }
        HeadsOfLines found = heads_at(sheet_, rows_, number, joined_);
        if (found.heads) {
            skip_until_ = found.are_two_lines ? number + 1 : skip_until_;
            take_heads(number, row, std::move(*found.heads));
            return;
        }
        if (table_.heads && is_near_ && !table_.budget.rows.empty() && is_words_alone(sheet_, row)) {
            const std::vector<SheetView::Row> below = lines_below(sheet_, rows_, number);
            const std::size_t taken = take_results_below(sheet_, row, below, table_.statements, not_read_);
            if (taken > 0) {
                in_rows_ = is_near_ = false;
                is_behind_results_ = true;
                skip_until_ = number + static_cast<std::uint32_t>(taken);
                return;
            }
        }
        if (table_.heads && is_near_ && heads_results(sheet_, row)) {
            in_rows_ = is_near_ = false;
            return;
        }
        if (const std::vector<const Cell*> held = cells_with_words(sheet_, row);
            held.size() == 1 && sheet_.value(*held[0]).kind == CellKind::text) {
            above_ = sheet_.words(*held[0]);
            line_above_ = number;
        }
        take_unit_in_words(number, row);
        if (is_next_ && in_rows_ && table_.budget.rows.empty() &&
            (take_units(sheet_, row, *table_.heads) || repeats_heads(sheet_, *table_.heads, row))) {
            return;
        }
        if ((table_.heads && is_near_ && note_correlation(sheet_, row, table_)) || note_constant(row)) {
            return;
        }
        if (note_sums_of_types(row)) {
            return;
        }
        if (!(in_rows_ && table_.heads && is_row(sheet_, row, table_)) && take_line(row)) {
            in_rows_ = false;
            return;
        }
        if (table_.heads && is_near_ && !in_rows_) {
            note_line_behind(row);
        } else if (table_.heads && is_behind_results_) {
            note_unread(sheet_, row, table_, not_read_);
        }
        if (!in_rows_ || !table_.heads || table_.is_too_long) {
            return;
        }
        if (table_.budget.rows.size() == k_most_rows_of_table) {
            table_.is_too_long = true;
            return;
        }
        if (table_.heads->type_b.empty()) {
            add_row(row, *table_.heads, std::nullopt, "");
            return;
        }
        const Heads of_b = heads_of_type_b();
        const bool has_a = has_number_of_type(row, *table_.heads), has_b = has_number_of_type(row, of_b);
        if (has_a || !has_b) {
            add_row(row, *table_.heads, true, "");
        }
        if (has_b) {
            add_row(row, of_b, false, has_a ? " (B)" : "");
        }
    }
    void take_heads(std::uint32_t number, const SheetView::Row& row, Heads heads) {
        Statements above;
        if (may_go_on(heads)) {
            apart_.push_back(std::exchange(table_, {}));
            leave_lines();
        } else {
            above = table_.heads ? Statements{} : std::move(table_.statements);
            finish();
        }
        table_.statements = std::move(above);
        table_.heads = std::move(heads);
        settle_meanings(sheet_, rows_, number, *table_.heads);
        for (const Cell* cell : table_.heads->second) {
            const std::string held = sheet_.words(*cell);
            const std::optional<Column> column = column_of(held);
            not_read_.push_back(
                column == Column::u || column == Column::contribution
                    ? say("{cell}: the column {head} is NOT audited, as another one of the table has its meaning; "
                          "give it "
                          "a table of its own, or name in each such head the point that it is of: \"u (10 V)\"",
                          sheet_.place(cell->address), text::in_quotes(held))
                    : say("{cell}: the column {head} is not read, as another one of the table has its meaning",
                          sheet_.place(cell->address), text::in_quotes(held)));
        }
        in_rows_ = is_near_ = true;
        constexpr std::uint32_t k_near = 2;  // lines
        table_.title = number <= line_above_ + k_near ? above_ : "";
        table_.unit_in_words = number <= line_of_unit_ + k_near ? unit_above_ : "";
        table_.budget.place = sheet_.place({.row = number, .column = row.front()->address.column});
        table_.budget.in_other_language = table_.budget.in_other_language || table_.heads->in_other_language;
    }
    /// The heads with the columns of type B in the place of those of type A.
    [[nodiscard]] Heads heads_of_type_b() const {
        Heads of_b = *table_.heads;
        for (const auto& [column, position] : table_.heads->type_b) {
            of_b.columns[column] = position;
            of_b.units[column] = table_.heads->all_units.at(position);
        }
        return of_b;
    }
    [[nodiscard]] bool has_number_of_type(const SheetView::Row& row, const Heads& of) const {
        return std::any_of(table_.heads->type_b.begin(), table_.heads->type_b.end(), [&](const auto& column) {
            const Cell* cell = cell_in(row, of.columns.at(column.first));
            return cell != nullptr && sheet_.number_with_unit(*cell).has_value();
        });
    }
    /// A line of results with a number of each type has sums of these, and neither u_c nor U (IAEA TRS-398).
    [[nodiscard]] bool note_sums_of_types(const SheetView::Row& row) {
        if (!table_.heads || !is_near_ || table_.heads->type_b.empty() || !has_number_of_type(row, *table_.heads) ||
            !has_number_of_type(row, heads_of_type_b())) {
            return false;
        }
        const Cell* name = cell_in(row, table_.heads->columns.at(Column::quantity));
        const std::optional<NamedLine> line = name_of_line(sheet_, row, &*table_.heads);
        const bool is_result = line && !line->named.may_be_quantity &&
                               (line->named.statement == Statement::u_c || line->named.statement == Statement::U ||
                                line->named.statement == Statement::reported_U);
        if (name == nullptr || (!is_result && sum_name(sheet_.words(*name)) == SumName::none)) {
            return false;
        }
        not_read_.push_back(taken_for_a_sum(sheet_.place(name->address), sheet_.words(*name)));
        return true;
    }
    /// \param type_a  where its column says so
    /// \param suffix  of the second of two rows that one line has
    void add_row(const SheetView::Row& row, const Heads& heads, std::optional<bool> type_a, const char* suffix) {
        const std::size_t told = not_read_.size();
        auto [read, units, has_open_number, unread, lost_amount] = read_row(sheet_, heads, row, not_read_);
        read.type_a = type_a ? type_a : read.type_a;
        read.quantity += suffix;
        table_.is_unusable = table_.is_unusable || has_open_number;
        if (read.u || read.stated || read.contribution || has_formula_of_uncertainty(row, *table_.heads)) {
            constexpr std::size_t k_most_told = 4;
            for (const std::string& words : unread) {
                if (table_.budget.unread_cells.size() < k_most_told) {
                    table_.budget.unread_cells.push_back(words);
                }
            }
            table_.budget.rows.push_back(std::move(read));
            table_.units.push_back(std::move(units));
            table_.last_constants.clear();
            note_numbers_of_unknown(row);
        } else {
            table_.lost_a_row = table_.lost_a_row || lost_amount;
            if (not_read_.size() == told && !is_constant(sheet_, row, *table_.heads)) {
                note_unread(sheet_, row, table_, not_read_);
            }
        }
    }

    /// A line of words alone may have the unit of all numbers of the table, above it or below.
    void take_unit_in_words(std::uint32_t number, const SheetView::Row& row) {
        constexpr std::size_t k_most = 3;  // texts of a line that is none of the table
        const std::vector<const Cell*> held = cells_with_words(sheet_, row);
        if (held.size() > k_most || (held.size() != 1 && !is_words_alone(sheet_, row))) {
            return;
        }
        for (const Cell* cell : held) {
            const std::string unit =
                sheet_.value(*cell).kind == CellKind::text ? unit_in_words(sheet_.words(*cell)) : std::string();
            if (unit.empty()) {
                continue;
            }
            if (table_.heads && is_near_) {
                table_.unit_in_words = table_.unit_in_words.empty() ? unit : table_.unit_in_words;
            }
            unit_above_ = unit;
            line_of_unit_ = number;
            return;
        }
    }
    /// A constant among the rows, or below the last of them, where it may be what the table is of: that is known when no more row
    /// follows.
    [[nodiscard]] bool note_constant(const SheetView::Row& row) {
        if (!in_rows_ || !table_.heads || is_row(sheet_, row, table_) || !is_constant(sheet_, row, *table_.heads)) {
            return false;
        }
        const std::optional<NamedLine> line = name_of_line(sheet_, row, &*table_.heads);
        if (line && !line->named.may_be_constant) {
            return false;
        }
        const Cell* name = cell_in(row, table_.heads->columns.at(Column::quantity));
        const bool has_other_words = std::any_of(row.begin(), row.end(), [this](const Cell* cell) {
            const auto is_headed = [this, cell](Column column) {
                const auto head = table_.heads->columns.find(column);
                return head != table_.heads->columns.end() && head->second == cell->address.column;
            };
            return (is_headed(Column::u) || is_headed(Column::stated) || is_headed(Column::contribution)) &&
                   !says_nothing(sheet_.words(*cell));
        });
        if (name == nullptr || sheet_.words(*name).empty() || has_other_words ||
            has_formula_of_uncertainty(row, *table_.heads)) {
            return false;
        }
        table_.last_constants.push_back(&row);
        return true;
    }
    void settle_constants() {
        const bool has_value = table_.statements.numbers.contains(Statement::value);
        table_.last_unread.reset();
        for (const SheetView::Row* row : table_.last_constants) {
            const std::optional<NamedLine> line = name_of_line(sheet_, *row, &*table_.heads);
            const bool is_value = line && line->named.statement == Statement::value && !has_value;
            if (!is_value || !take_line(*row)) {
                note_unread(sheet_, *row, table_, not_read_);
            }
        }
        table_.last_constants.clear();
    }

    /// Takes a line that states something. One that states the value may have its uncertainty beside it.
    [[nodiscard]] bool take_line(const SheetView::Row& row) {
        const Heads* heads = table_.heads && is_near_ ? &*table_.heads : nullptr;
        const std::optional<Statement> statement = take_statement(sheet_, row, heads, table_.statements, not_read_);
        if (statement == Statement::value && heads != nullptr && !table_.result_line) {
            const NumbersUnderHeads numbers = numbers_under(sheet_, *heads, row);
            const bool has_amount = numbers.contains(Column::u) || numbers.contains(Column::contribution);
            if (numbers.contains(Column::estimate) && has_amount) {
                table_.result_line = numbers;
            }
        }
        return statement.has_value();
    }

    /// A line below a table that is no row of it and states nothing that is known.
    void note_line_behind(const SheetView::Row& row) {
        const NumbersUnderHeads numbers = numbers_under(sheet_, *table_.heads, row);
        const auto has = [&numbers](Column column) { return numbers.contains(column); };
        const bool has_amount = has(Column::u) || has(Column::contribution) || has(Column::stated);
        if (is_next_ && has_amount && (has(Column::sensitivity) || has(Column::divisor))) {
            table_.is_open = true;
            not_read_.push_back(
                say("{cell}: a line like the rows of the table stands below a result; the table is not looked at; what "
                    "is it "
                    "of?",
                    sheet_.place(row.front()->address)));
            return;
        }
        note_unread(sheet_, row, table_, not_read_);
    }
    void note_numbers_of_unknown(const SheetView::Row& row) {
        for (const Cell* head : table_.heads->unknown) {
            const Cell* cell = cell_in(row, head->address.column);
            if (cell != nullptr && sheet_.number_with_unit(*cell)) {
                table_.with_numbers.insert(head);
            }
        }
    }
    void tell_unknown_columns() {
        for (const Cell* head : table_.heads->unknown) {
            if (table_.with_numbers.contains(head)) {
                const std::string named = sheet_.words(*head);
                table_.budget.unread_columns.push_back(named);
                not_read_.push_back(say("{cell}: the column {head} has numbers and is not read; what does it have?",
                                        sheet_.place(head->address), text::in_quotes(named)));
            }
        }
    }
    /// Whether heads are those of the table above them, which has rows, and has stated no uncertainty so far.
    [[nodiscard]] bool may_go_on(const Heads& heads) const {
        constexpr std::size_t k_most = 20;  // parts
        const auto states = [this](Statement statement) { return table_.statements.numbers.contains(statement); };
        const bool is_plain = !table_.is_too_long && !table_.is_unusable && !table_.is_open && !table_.is_told &&
                              !table_.lost_a_row && !table_.result_line && table_.correlation_lines.empty() &&
                              table_.covariance_line == nullptr && heads.type_b.empty();
        return table_.heads && is_plain && !table_.budget.rows.empty() && apart_.size() < k_most &&
               heads.columns == table_.heads->columns && heads.units == table_.heads->units &&
               !states(Statement::u_c) && !states(Statement::U) && !states(Statement::reported_U) &&
               !states(Statement::value);
    }
    /// Whether what is stated follows from rows as they stand, or from those of them that are no sums of others.
    [[nodiscard]] bool follow_from(std::vector<AuditedRow> rows, std::vector<RowUnits> units,
                                   Statements statements) const {
        const TableSums sums{rows, units, *table_.heads, statements};
        const auto follow = [&sums] {
            const std::optional<StatedResult> of = sums.stated_of_sum();
            const std::optional<Interval> sum = of ? sums.sum_above(*of) : std::nullopt;
            return sum && sums.gives_statements(*sum).value_or(false);
        };
        if (!sums.stated_of_sum() || follow()) {
            return sums.stated_of_sum().has_value();
        }
        std::vector<Sentence> unused;
        return !settle_sums(sums, table_.result_line.has_value(), unused) && follow();
    }
    /// Rows that were set apart belong to the table below them where what that one states follows with them only; else they are a table
    /// of their own.
    void join_or_finish_rows_apart() {
        std::vector<TableSoFar> apart;
        apart.swap(apart_);
        if (apart.empty()) {
            return;
        }
        std::vector<AuditedRow> rows;
        std::vector<RowUnits> units;
        for (const TableSoFar& part : apart) {
            rows.insert(rows.end(), part.budget.rows.begin(), part.budget.rows.end());
            units.insert(units.end(), part.units.begin(), part.units.end());
        }
        const std::size_t before = rows.size();
        rows.insert(rows.end(), table_.budget.rows.begin(), table_.budget.rows.end());
        units.insert(units.end(), table_.units.begin(), table_.units.end());
        Statements merged = table_.statements;
        for (const TableSoFar& part : apart) {
            merged.numbers.insert(part.statements.numbers.begin(), part.statements.numbers.end());
            merged.parts.insert(part.statements.parts.begin(), part.statements.parts.end());
            merged.words.insert(part.statements.words.begin(), part.statements.words.end());
            if (merged.coverage.empty()) {
                merged.coverage = part.statements.coverage;
                merged.coverage_place = part.statements.coverage_place;
            }
        }
        const bool is_one = table_.heads && rows.size() > before && rows.size() <= k_most_rows_of_table &&
                            follow_from(rows, units, merged) && !follow_from(table_.budget.rows, table_.units, merged);
        if (is_one) {
            table_.statements = std::move(merged);
            table_.budget.rows = std::move(rows);
            table_.units = std::move(units);
            table_.budget.place = apart.front().budget.place;
            table_.title = apart.front().title;
            table_.unit_in_words = table_.unit_in_words.empty() ? apart.front().unit_in_words : table_.unit_in_words;
            std::vector<const SheetView::Row*> constants;
            for (const TableSoFar& part : apart) {
                table_.with_numbers.insert(part.with_numbers.begin(), part.with_numbers.end());
                constants.insert(constants.end(), part.last_constants.begin(), part.last_constants.end());
            }
            table_.last_constants.insert(table_.last_constants.begin(), constants.begin(), constants.end());
            return;
        }
        TableSoFar last = std::move(table_);
        for (TableSoFar& part : apart) {
            table_ = std::move(part);
            finish_one();
        }
        table_ = std::move(last);
    }
    void finish() {
        join_or_finish_rows_apart();
        finish_one();
    }
    void finish_one() {
        if (table_.is_too_long) {  // a part of its rows would give another u_c
            not_read_.push_back(
                say("{table}: the table is not looked at; it has more than the {most:number} rows that an audit takes",
                    table_.budget.place, std::to_string(k_most_rows_of_table)));
        } else if (table_.heads && (!table_.budget.rows.empty() || table_.is_unusable)) {
            if (is_settled()) {
                table_.budget.name += point_.empty() ? "" : ", " + point_;
                tables_.budgets.push_back(std::move(table_.budget));
                titles_.push_back(table_.title);
            } else {
                tables_.has_unusable = true;
            }
        }
        table_ = {};
        leave_lines();
    }
    /// Brings the table to what an audit takes; false where nobody can know what it has, and it was said.
    [[nodiscard]] bool is_settled() {
        AuditedBudget& budget = table_.budget;
        budget.name = name_;
        budget.title = table_.title;
        settle_constants();
        tell_unknown_columns();
        table_.is_open = settle_sums(table_.sums(), table_.result_line.has_value(), not_read_) || table_.is_open;
        take_product(table_, not_read_);
        settle_result_line(sheet_, table_, not_read_);
        if (table_.is_open) {
            return false;
        }
        settle_statements(table_, not_read_);
        settle_correlations(sheet_, table_, not_read_);
        settle_product(table_, not_read_);
        if (table_.is_told || (!table_.product && has_open_sum(table_, not_read_))) {
            return false;
        }
        if (table_.is_unusable) {
            not_read_.push_back(
                say("{table}: the table is not looked at; a row has numbers that could not be read, and the others "
                    "do not make up its result",
                    budget.place));
            return false;
        }
        const std::optional<double> p = budget.claims.coverage_probability;
        if (p && !(*p > 0.0 && *p < 1.0)) {
            not_read_.push_back(say("{table}: a coverage probability of {p:number} cannot be; what is meant?",
                                    budget.place, text::shortest(*p)));
            budget.claims.coverage_probability.reset();
        }
        if (checklist_of(budget.method) == nullptr) {
            budget.method = method_in_title(budget.method + " " + budget.name);
        }
        settle_contributions(budget);
        take_parts_of_value(budget, table_.statements, not_read_);
        state_coverage(budget);
        note_unexplained(budget);
        return true;
    }
    void leave_lines() { in_rows_ = is_near_ = is_behind_results_ = false; }

    const SheetView& sheet_;
    const SheetView::Rows& rows_;  ///< that are read
    const std::string& point_;     ///< of a table of several, that they are of
    const std::string& name_;
    ForeignTables& tables_;
    std::vector<Sentence>& not_read_;  ///< of the tables
    std::vector<std::string>& titles_;
    bool in_rows_ = false;
    bool is_near_ = false;            ///< no two empty lines since the heads
    bool is_behind_results_ = false;  ///< no two empty lines since results that stand beside each other
    std::uint32_t skip_until_ = 0;    ///< line up to which all was taken together
    bool is_next_ = false;            ///< no empty line before this one
    TableSoFar table_;
    std::deque<Cell> joined_;        ///< heads that stand in two lines
    std::vector<TableSoFar> apart_;  ///< rows above it, below the same heads
    std::string unit_above_;         ///< that the line `line_of_unit_` has for all
    std::uint32_t line_of_unit_ = 0;
    std::string above_;  ///< last line of words alone
    std::uint32_t line_above_ = 0;
};

}  // namespace

void read_tables(const SheetView& sheet, const TablePart& part, const std::string& name, ForeignTables& tables,
                 std::vector<std::string>& titles) {
    TableReader(sheet, part, name, tables, titles).read();
}

}  // namespace gumcert::audit
