#include "audit/sources/foreign_table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <deque>
#include <iterator>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/checklists.h"
#include "audit/claims.h"
#include "audit/row_facts.h"
#include "audit/row_meaning.h"
#include "audit/sources/budget_words.h"
#include "audit/sources/correlation_words.h"
#include "audit/sources/limits_of_rows.h"
#include "audit/sources/parts_of_value.h"
#include "audit/sources/product_of_rows.h"
#include "audit/sources/result_lines.h"
#include "audit/sources/sheet_view.h"
#include "audit/sources/sum_rows.h"
#include "audit/sources/table_heads.h"
#include "audit/sources/table_sums.h"
#include "audit/sources/table_units.h"
#include "gum/quantity/unit.h"
#include "text/numbers.h"
#include "text/small_letters.h"
#include "text/visible_text.h"

namespace gumcert::audit {
namespace {

using workbook::Cell;
using workbook::CellKind;

constexpr std::size_t k_most_tables = 10'000, k_most_rows = 2'000;

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
        return read;
    }
    /// Whether the row has a number of which nobody can know the decimal sign.
    [[nodiscard]] bool has_open_number() const { return has_open_; }
    /// Places and words of cells in which a number of the sum should stand.
    [[nodiscard]] const std::vector<std::string>& unread() const { return unread_; }
    /// Whether one of them should have an uncertainty, and holds digits: "≈ 0.10", and not "< 0.01" or "negligible".
    [[nodiscard]] bool lost_amount() const { return lost_amount_; }

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
                    unread_.push_back(sheet_.place(cell->address) + " (" + text::in_quotes(held) + ")");
                }
                const bool is_amount =
                    column == Column::u || column == Column::stated || column == Column::contribution;
                const std::size_t digit = held.find_first_of("0123456789");
                const bool is_bound = held.starts_with('<') || held.starts_with("≤");
                lost_amount_ = lost_amount_ || (is_amount && digit <= k_longest_sign && !is_bound);
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
    bool has_open_ = false;
    bool lost_amount_ = false;
    std::vector<std::string> unread_;
};

/// Reads one sheet, or a part of it, from top to bottom.
class TableReader {
public:
    /// \param titles  gets the line of words above each budget that is found, or ""
    TableReader(const SheetView& sheet, std::string name, ForeignTables& tables, std::vector<std::string>& titles)
        : sheet_(sheet), name_(std::move(name)), tables_(tables), titles_(titles) {}

    void read(const TablePart& part) {
        const SheetView::Rows& rows = part.rows;
        rows_ = &rows;
        point_ = part.point;
        std::uint32_t last = 0;
        for (const auto& [number, row] : rows) {
            if (number > last + 2) {
                in_rows_ = is_near_ = is_behind_results_ = false;
            }
            is_next_ = number == last + 1;
            last = number;
            if (tables_.budgets.size() + apart_.size() >= k_most_tables) {
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
        if (number <= skip_until_) {
            return;
        }
        std::optional<Heads> heads = heads_of(sheet_, row);
        if (std::optional<Heads> joined = heads_in_two_lines(number, row);
            joined && (!heads || is_second_line(number, *heads) ||
                       (joined->columns.size() > heads->columns.size() && !names_row_below(number, *heads)))) {
            heads = std::move(joined);
            skip_until_ = number + 1;
        }
        if (heads) {
            Statements above;
            if (may_go_on(*heads)) {
                apart_.push_back(table_so_far());
            } else {
                above = heads_ ? Statements{} : std::move(statements_);
                finish();
            }
            statements_ = std::move(above);
            heads_ = std::move(heads);
            take_value_for_stated(number);
            take_u_for_contribution(number);
            for (const Cell* cell : heads_->second) {
                const std::string held = sheet_.words(*cell);
                const std::optional<Column> column = column_of(held);
                tables_.not_read.push_back(
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
            title_ = number <= line_above_ + k_near ? above_ : "";
            unit_in_words_ = number <= line_of_unit_ + k_near ? unit_above_ : "";
            budget_.place = sheet_.place({.row = number, .column = row.front()->address.column});
            budget_.in_other_language = budget_.in_other_language || heads_->in_other_language;
            return;
        }
        if (heads_ && is_near_ && !budget_.rows.empty() && is_words_alone(row)) {
            const std::vector<SheetView::Row> below = lines_below(number);
            const std::size_t taken = take_results_below(sheet_, row, below, statements_, tables_.not_read);
            if (taken > 0) {
                in_rows_ = is_near_ = false;
                is_behind_results_ = true;
                skip_until_ = number + static_cast<std::uint32_t>(taken);
                return;
            }
        }
        if (heads_ && is_near_ && heads_results(sheet_, row)) {
            in_rows_ = is_near_ = false;
            return;
        }
        if (const std::vector<const Cell*> held = cells_with_words(row);
            held.size() == 1 && sheet_.value(*held[0]).kind == CellKind::text) {
            above_ = sheet_.words(*held[0]);
            line_above_ = number;
        }
        take_unit_in_words(number, row);
        if (is_next_ && in_rows_ && budget_.rows.empty() && (take_units(row) || repeats_heads(row))) {
            return;
        }
        if (note_correlation(row) || note_constant(row)) {
            return;
        }
        if (note_sums_of_types(row)) {
            return;
        }
        if (!is_row(row) && take_line(row)) {
            in_rows_ = false;
            return;
        }
        if (heads_ && is_near_ && !in_rows_) {
            note_line_behind(row);
        } else if (heads_ && is_behind_results_) {
            note_unread(row);
        }
        if (!in_rows_ || !heads_ || is_too_long_) {
            return;
        }
        if (budget_.rows.size() == k_most_rows) {
            is_too_long_ = true;
            return;
        }
        if (heads_->type_b.empty()) {
            read_row(row, *heads_, std::nullopt, "");
            return;
        }
        const Heads of_b = heads_of_type_b();
        const bool has_a = has_number_of_type(row, *heads_), has_b = has_number_of_type(row, of_b);
        if (has_a || !has_b) {
            read_row(row, *heads_, true, "");
        }
        if (has_b) {
            read_row(row, of_b, false, has_a ? " (B)" : "");
        }
    }
    /// The heads with the columns of type B in the place of those of type A.
    [[nodiscard]] Heads heads_of_type_b() const {
        Heads of_b = *heads_;
        for (const auto& [column, position] : heads_->type_b) {
            of_b.columns[column] = position;
            of_b.units[column] = heads_->all_units.at(position);
        }
        return of_b;
    }
    [[nodiscard]] bool has_number_of_type(const SheetView::Row& row, const Heads& of) const {
        return std::any_of(heads_->type_b.begin(), heads_->type_b.end(), [&](const auto& column) {
            const Cell* cell = cell_in(row, of.columns.at(column.first));
            return cell != nullptr && sheet_.number_with_unit(*cell).has_value();
        });
    }
    /// A line of results with a number of each type has sums of these, and neither u_c nor U (IAEA TRS-398).
    [[nodiscard]] bool note_sums_of_types(const SheetView::Row& row) {
        if (!heads_ || !is_near_ || heads_->type_b.empty() || !has_number_of_type(row, *heads_) ||
            !has_number_of_type(row, heads_of_type_b())) {
            return false;
        }
        const Cell* name = cell_in(row, heads_->columns.at(Column::quantity));
        const std::optional<NamedLine> line = name_of_line(sheet_, row, &*heads_);
        const bool is_result = line && !line->named.may_be_quantity &&
                               (line->named.statement == Statement::u_c || line->named.statement == Statement::U ||
                                line->named.statement == Statement::reported_U);
        if (name == nullptr || (!is_result && sum_name(sheet_.words(*name)) == SumName::none)) {
            return false;
        }
        tables_.not_read.push_back(taken_for_a_sum(sheet_.place(name->address), sheet_.words(*name)));
        return true;
    }
    /// \param type_a  where its column says so
    /// \param suffix  of the second of two rows that one line has
    void read_row(const SheetView::Row& row, const Heads& heads, std::optional<bool> type_a, const char* suffix) {
        RowUnits units;
        RowReader reader(sheet_, heads, row, tables_.not_read);
        const std::size_t told = tables_.not_read.size();
        AuditedRow read = reader.read(units);
        read.type_a = type_a ? type_a : read.type_a;
        read.quantity += suffix;
        is_unusable_ = is_unusable_ || reader.has_open_number();
        if (read.u || read.stated || read.contribution || has_formula_of_uncertainty(row)) {
            constexpr std::size_t k_most_told = 4;
            for (const std::string& words : reader.unread()) {
                if (budget_.unread_cells.size() < k_most_told) {
                    budget_.unread_cells.push_back(words);
                }
            }
            budget_.rows.push_back(std::move(read));
            units_.push_back(std::move(units));
            last_constants_.clear();
            note_numbers_of_unknown(row);
        } else {
            lost_a_row_ = lost_a_row_ || reader.lost_amount();
            if (tables_.not_read.size() == told && !is_constant(row)) {
                note_unread(row);
            }
        }
    }

    /// A line of words alone may have the unit of all numbers of the table, above it or below.
    void take_unit_in_words(std::uint32_t number, const SheetView::Row& row) {
        constexpr std::size_t k_most = 3;  // texts of a line that is none of the table
        const std::vector<const Cell*> held = cells_with_words(row);
        if (held.size() > k_most || (held.size() != 1 && !is_words_alone(row))) {
            return;
        }
        for (const Cell* cell : held) {
            const std::string unit =
                sheet_.value(*cell).kind == CellKind::text ? unit_in_words(sheet_.words(*cell)) : std::string();
            if (unit.empty()) {
                continue;
            }
            if (heads_ && is_near_) {
                unit_in_words_ = unit_in_words_.empty() ? unit : unit_in_words_;
            }
            unit_above_ = unit;
            line_of_unit_ = number;
            return;
        }
    }
    /// Whether a line has two texts or more, and no number.
    [[nodiscard]] bool is_words_alone(const SheetView::Row& row) const {
        const std::vector<const Cell*> held = cells_with_words(row);
        return held.size() > 1 && std::all_of(held.begin(), held.end(), [this](const Cell* cell) {
                   return sheet_.value(*cell).kind == CellKind::text && !sheet_.number_with_unit(*cell);
               });
    }
    /// Whether what stands below some heads are their symbols, "a_i | u(x_i) | c_i | u_i in µm" below "Influence | Limit | …": what would name
    /// the rows of a table of its own stands below the head of something else.
    [[nodiscard]] bool is_second_line(std::uint32_t number, const std::optional<Heads>& heads) const {
        const auto next = rows_->find(number + 1);
        const std::optional<Heads> below =
            heads && next != rows_->end() ? heads_of(sheet_, next->second) : std::optional<Heads>();
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
    /// Heads of a line together with those of the next one, as of merged cells: in each column the one that is known, the lower
    /// before the upper one, or both as one: "Standard-" above "unsicherheit", "Standard" above "uncertainty".
    [[nodiscard]] std::optional<Heads> heads_in_two_lines(std::uint32_t number, const SheetView::Row& row) {
        const auto next = rows_->find(number + 1);
        if (next == rows_->end() || !is_words_alone(row) || !is_words_alone(next->second) ||
            (heads_of(sheet_, next->second) && !is_second_line(number, heads_of(sheet_, row)))) {
            return std::nullopt;
        }
        std::map<std::uint32_t, const Cell*> columns;
        for (const SheetView::Row* line : {&row, &next->second}) {
            for (const Cell* cell : *line) {
                const Cell*& kept = columns[cell->address.column];
                const std::string lower = sheet_.words(*cell);
                const std::optional<std::string> both =
                    kept == nullptr ? std::nullopt : head_of_both(sheet_.words(*kept), lower);
                const bool is_better =
                    kept == nullptr || column_of(lower) || (!column_of(sheet_.words(*kept)) && !lower.empty());
                if (both) {
                    joined_.push_back(*cell);
                    joined_.back().value = {.kind = CellKind::text, .text = *both};
                    joined_.back().formula_kind = workbook::FormulaKind::none;
                    kept = &joined_.back();
                } else {
                    kept = is_better ? cell : kept;
                }
            }
        }
        SheetView::Row joined;
        for (const auto& [column, cell] : columns) {
            joined.push_back(cell);
        }
        return heads_of(sheet_, joined);
    }
    /// Whether the line below heads has a name under that of the quantities: it is a row then, whatever its other cells may be read as.
    [[nodiscard]] bool names_row_below(std::uint32_t number, const Heads& heads) const {
        const auto next = rows_->find(number + 1);
        const Cell* name = next == rows_->end() ? nullptr : cell_in(next->second, heads.columns.at(Column::quantity));
        return name != nullptr && !says_nothing(sheet_.words(*name));
    }
    /// The head that two lines have together, where the upper one is a part of a word, or means nothing by itself, or where the lower one is
    /// its unit.
    [[nodiscard]] static std::optional<std::string> head_of_both(std::string upper, const std::string& lower) {
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
    /// Whether a line below heads has their symbols: "x_i | u(x_i) | c_i" (EA-4/02).
    [[nodiscard]] bool repeats_heads(const SheetView::Row& row) const {
        if (!is_words_alone(row)) {
            return false;
        }
        std::size_t same = 0;
        for (const auto& [column, position] : heads_->columns) {
            const Cell* cell = has_numbers_with_units(column) ? cell_in(row, position) : nullptr;
            const std::string held = cell == nullptr ? "" : sheet_.words(*cell);
            same += !held.empty() && column_of(held) == column ? 1U : 0U;
        }
        return same > 1;
    }
    /// The lines below one, up to an empty one, or to a line that has words alone.
    [[nodiscard]] std::vector<SheetView::Row> lines_below(std::uint32_t line) const {
        constexpr std::size_t k_most = 20;
        std::vector<SheetView::Row> below;
        for (auto at = rows_->find(line + 1); at != rows_->end() && below.size() < k_most; ++at) {
            const bool has_number = std::any_of(at->second.begin(), at->second.end(), [this](const Cell* cell) {
                return sheet_.number_with_unit(*cell).has_value();
            });
            if (at->first != line + 1 + below.size() || !has_number) {
                break;
            }
            below.push_back(at->second);
        }
        return below;
    }

    /// The number of a row below some heads in a column.
    [[nodiscard]] std::optional<StatedNumber> number_below(const SheetView::Row& row, Column column) const {
        const auto head = heads_->columns.find(column);
        const Cell* cell = head == heads_->columns.end() ? nullptr : cell_in(row, head->second);
        std::optional<NumberWithUnit> read = cell == nullptr ? std::nullopt : sheet_.number_with_unit(*cell);
        return read && !read->is_open ? std::optional(std::move(read->number)) : std::nullopt;
    }
    /// Looks at the rows between a line of heads and the next one.
    template <typename Look>
    void each_row_below(std::uint32_t line, const Look& look) const {
        for (auto at = rows_->upper_bound(line); at != rows_->end() && at->first <= line + k_most_rows; ++at) {
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
        move(heads_->columns);
        move(heads_->units);
        move(heads_->unit_columns);
    }
    static constexpr double k_digits_of_factors = 0.01;  // relative, of a divisor and a coefficient
    /// Whether a printed number is that of a size that follows from factors, which are rounded as well.
    [[nodiscard]] static bool is_printed_as(const StatedNumber& number, double size) {
        const double printed = std::abs(number.value);
        return std::abs(printed - size) <= printed_half_step(number) + k_digits_of_factors * printed;
    }
    /// "Value" beside a column of divisors is what is divided, where u of most rows is the quotient: the layout of UKAS M3003,
    /// without its ±.
    void take_value_for_stated(std::uint32_t line) {
        const auto has = [this](Column column) { return heads_->columns.contains(column); };
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
            heads_->columns.erase(Column::stated);
            heads_->units.erase(Column::stated);
            heads_->unit_columns.erase(Column::stated);
            rename_column(Column::estimate, Column::stated);
        }
    }
    /// A column headed "u_i" or "Standard uncertainty", without one of contributions beside it, holds u(x_i) or |c_i| u(x_i): what
    /// its rows divide, and their coefficients, tell which.
    void take_u_for_contribution(std::uint32_t line) {
        const auto has = [this](Column column) { return heads_->columns.contains(column); };
        if (!has(Column::u) || has(Column::contribution) || !has(Column::sensitivity) || !has(Column::stated)) {
            return;
        }
        std::size_t with_coefficient = 0, without = 0;
        each_row_below(line, [&](const SheetView::Row& row) {
            const std::optional<StatedNumber> u = number_below(row, Column::u),
                                              stated = number_below(row, Column::stated),
                                              c = number_below(row, Column::sensitivity),
                                              divided_by = number_below(row, Column::divisor);
            const auto distribution = heads_->columns.find(Column::distribution);
            const Cell* shape = distribution == heads_->columns.end() ? nullptr : cell_in(row, distribution->second);
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

    [[nodiscard]] std::vector<const Cell*> cells_with_words(const SheetView::Row& row) const {
        std::vector<const Cell*> held;
        std::copy_if(row.begin(), row.end(), std::back_inserter(held),
                     [this](const Cell* cell) { return !sheet_.words(*cell).empty(); });
        return held;
    }
    /// A line of units alone below heads: each column of numbers that has one there has it for all its rows.
    [[nodiscard]] bool take_units(const SheetView::Row& row) {
        std::map<Column, std::string> units;
        for (const Cell* cell : row) {
            const std::string held = sheet_.words(*cell);
            const auto head = std::find_if(heads_->columns.begin(), heads_->columns.end(), [cell](const auto& column) {
                return column.second == cell->address.column;
            });
            if (says_nothing(held) || held == "1" || head == heads_->columns.end()) {
                continue;
            }
            if (!has_numbers_with_units(head->first)) {
                if (column_of(held) == Column::unit) {
                    continue;  // "unit" below "quantity"
                }
                return false;
            }
            if (sheet_.number_with_unit(*cell) || !known_unit(held)) {
                return false;
            }
            units.emplace(head->first, unit_in_rest(held));
        }
        for (const auto& [column, unit] : units) {
            std::string& of_head = heads_->units[column];
            of_head = of_head.empty() ? unit : of_head;
            heads_->all_units[heads_->columns.at(column)] = of_head;
        }
        return !units.empty();
    }

    /// A line that states a correlation: "Correlation r(T1; T2)" and a number, or "r(T1; T2) = 0.6". What has a coefficient, a
    /// divisor or a distribution is a row whatever its name.
    [[nodiscard]] bool note_correlation(const SheetView::Row& row) {
        if (!heads_ || !is_near_ || sheet_.value(*row.front()).kind != CellKind::text) {
            return false;
        }
        const std::string name = sheet_.words(*row.front());
        const std::optional<CorrelationWords> words = correlation_words(name);
        const NumbersUnderHeads numbers = numbers_under(sheet_, *heads_, row);
        if (!words && numbers.empty() && name.find(' ') != std::string::npos) {
            // A note. "r = 0.9" in it is no correlation of the sum, and asked where it would explain it, unless it is of a regression.
            const NotedCorrelation of = noted_correlation(name);
            if (const std::optional<double> r = stated_correlation(name);
                r && *r != 0.0 && of != NotedCorrelation::of_fit) {
                (of == NotedCorrelation::of_rows ? budget_.unread_correlations : budget_.noted_correlations)
                    .push_back(*r);
            }
            return false;
        }
        const auto shape = heads_->columns.find(Column::distribution);
        const Cell* shape_cell = shape == heads_->columns.end() ? nullptr : cell_in(row, shape->second);
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
            covariance_line_ = has_number && covariance_line_ == nullptr ? &row : covariance_line_;
            return has_number;
        }
        if (!r || (has_amount && !words->is_coefficient && !rows_of(words->pairs))) {
            return false;
        }
        correlation_lines_.push_back({.row = &row, .r = *r, .pairs = words ? words->pairs : Pairs{}});
        return true;
    }
    /// A number from -1 to 1 without a unit, behind the name.
    [[nodiscard]] std::optional<double> correlation_in(const SheetView::Row& row) const {
        const auto unit = heads_->columns.find(Column::unit);
        for (auto cell = row.begin() + 1; cell != row.end(); ++cell) {
            if (const std::optional<double> r = stated_correlation(sheet_.words(**cell))) {
                return r;
            }
            const std::optional<NumberWithUnit> r = sheet_.number_with_unit(**cell);
            if (!r || (unit != heads_->columns.end() && unit->second == (*cell)->address.column)) {
                continue;
            }
            const Cell* of_row = unit == heads_->columns.end() ? nullptr : cell_in(row, unit->second);
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
        for (std::size_t i = 0; i < budget_.rows.size() && !symbol.empty(); ++i) {
            if (has(budget_.rows[i].quantity) || has(budget_.rows[i].description)) {
                if (found) {
                    return std::nullopt;
                }
                found = i;
            }
        }
        return found;
    }
    void settle_correlations() {
        last_unread_.reset();
        for (const CorrelationLine& line : correlation_lines_) {
            if (const auto rows = rows_of(line.pairs)) {
                budget_.correlations.push_back({.first = rows->first, .second = rows->second, .r = line.r});
            } else {
                budget_.unread_correlations.push_back(line.r);
                note_unread(*line.row);
            }
        }
        if (covariance_line_ != nullptr && !correlation_lines_.empty()) {
            note_unread(*covariance_line_);
        } else if (covariance_line_ != nullptr) {
            is_told_ = true;
            tables_.not_read.push_back(
                say("{cell}: {text} is a term of the sum that no row has; the table is not looked at; which rows are "
                    "correlated, and what is r?",
                    sheet_.place(covariance_line_->front()->address),
                    text::in_quotes(sheet_.words(*covariance_line_->front()))));
        }
    }

    /// A constant among the rows, or below the last of them, where it may be what the table is of: that is known when no more row
    /// follows.
    [[nodiscard]] bool note_constant(const SheetView::Row& row) {
        if (!in_rows_ || !heads_ || is_row(row) || !is_constant(row)) {
            return false;
        }
        const std::optional<NamedLine> line = name_of_line(sheet_, row, &*heads_);
        if (line && !line->named.may_be_constant) {
            return false;
        }
        const Cell* name = cell_in(row, heads_->columns.at(Column::quantity));
        const bool has_other_words = std::any_of(row.begin(), row.end(), [this](const Cell* cell) {
            const auto is_headed = [this, cell](Column column) {
                const auto head = heads_->columns.find(column);
                return head != heads_->columns.end() && head->second == cell->address.column;
            };
            return (is_headed(Column::u) || is_headed(Column::stated) || is_headed(Column::contribution)) &&
                   !says_nothing(sheet_.words(*cell));
        });
        if (name == nullptr || sheet_.words(*name).empty() || has_other_words || has_formula_of_uncertainty(row)) {
            return false;
        }
        last_constants_.push_back(&row);
        return true;
    }
    void settle_constants() {
        const bool has_value = statements_.numbers.contains(Statement::value);
        last_unread_.reset();
        for (const SheetView::Row* row : last_constants_) {
            const std::optional<NamedLine> line = name_of_line(sheet_, *row, &*heads_);
            const bool is_value = line && line->named.statement == Statement::value && !has_value;
            if (!is_value || !take_line(*row)) {
                note_unread(*row);
            }
        }
        last_constants_.clear();
    }

    /// Whether a line below heads is a row of the table. A quantity may be named "p" or "k", and a line of a result may have several
    /// numbers, each under its head: what is added up has a coefficient, or something that is divided.
    [[nodiscard]] bool is_row(const SheetView::Row& row) {
        if (!in_rows_ || !heads_) {
            return false;
        }
        const NumbersUnderHeads numbers = numbers_under(sheet_, *heads_, row);
        if (numbers.size() < 2) {
            return false;
        }
        const std::optional<NamedLine> line = name_of_line(sheet_, row, &*heads_);
        return !line || !(states_result(line->named, numbers) || is_number_with_one(sheet_, row, *line));
    }
    [[nodiscard]] bool states_result(const NamedStatement& named, const NumbersUnderHeads& numbers) {
        const auto has = [&numbers](Column column) { return numbers.contains(column); };
        const auto headed = [this](Column column) { return heads_->columns.contains(column); };
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
                return !adds || is_sum(numbers, named.statement);
            case Statement::u_c:
                if (named.may_be_quantity) {
                    return has(Column::contribution) && !has(Column::u) && !has(Column::estimate) && !adds &&
                           (headed(Column::u) || headed(Column::stated));
                }
                return !adds || is_sum(numbers, named.statement);
            case Statement::value:
                return !named.may_be_quantity && !adds;
            case Statement::nu_eff:
                return !adds;
            default:
                return false;
        }
    }
    /// Whether the number of a line that looks like a row is u_c, or U, of the rows above it.
    [[nodiscard]] bool is_sum(const NumbersUnderHeads& numbers, Statement statement) {
        // Each look adds up all rows; a table states few results.
        constexpr std::size_t k_most_looks = 20;
        if (budget_.rows.size() < 2 || ++looks_ > k_most_looks) {
            return false;
        }
        const auto number = [&](Column column) -> std::optional<StatedResult> {
            const auto found = numbers.find(column);
            std::vector<Sentence> unused;
            return found == numbers.end() ? std::nullopt : result_in(sheet_, *found->second, statement, unused);
        };
        const std::optional<StatedResult> divisor = number(Column::divisor);
        for (const Column column : {Column::contribution, Column::u, Column::stated}) {
            const std::optional<StatedResult> amount = number(column);
            if (!amount || (statement != Statement::u_c && !divisor)) {
                continue;
            }
            const std::optional<Interval> sum = sums().sum_above(*amount);
            const double k = statement == Statement::u_c ? 1.0 : divisor->number.value;
            if (sum && k > 0.0 && as_rounded(amount->number, k).meets(*sum)) {
                return true;
            }
        }
        return false;
    }
    /// Takes a line that states something. One that states the value may have its uncertainty beside it.
    [[nodiscard]] bool take_line(const SheetView::Row& row) {
        const Heads* heads = heads_ && is_near_ ? &*heads_ : nullptr;
        const std::optional<Statement> statement = take_statement(sheet_, row, heads, statements_, tables_.not_read);
        if (statement == Statement::value && heads != nullptr && !result_line_) {
            const NumbersUnderHeads numbers = numbers_under(sheet_, *heads, row);
            const bool has_amount = numbers.contains(Column::u) || numbers.contains(Column::contribution);
            if (numbers.contains(Column::estimate) && has_amount) {
                result_line_ = numbers;
            }
        }
        return statement.has_value();
    }

    /// A line below a table that is no row of it and states nothing that is known.
    void note_line_behind(const SheetView::Row& row) {
        const NumbersUnderHeads numbers = numbers_under(sheet_, *heads_, row);
        const auto has = [&numbers](Column column) { return numbers.contains(column); };
        const bool has_amount = has(Column::u) || has(Column::contribution) || has(Column::stated);
        if (is_next_ && has_amount && (has(Column::sensitivity) || has(Column::divisor))) {
            is_open_ = true;
            tables_.not_read.push_back(
                say("{cell}: a line like the rows of the table stands below a result; the table is not looked at; what "
                    "is it "
                    "of?",
                    sheet_.place(row.front()->address)));
            return;
        }
        note_unread(row);
    }
    /// Whether the only number of a line is an estimate: a constant has no uncertainty.
    [[nodiscard]] bool is_constant(const SheetView::Row& row) const {
        const auto numbers = std::count_if(row.begin(), row.end(), [this](const Cell* cell) {
            const bool is_name = cell->address.column == heads_->columns.at(Column::quantity);
            return !is_name && sheet_.number_with_unit(*cell).has_value() && sheet_.words(*cell) != "1";
        });
        return numbers == 1 && numbers_under(sheet_, *heads_, row).contains(Column::estimate);
    }
    void note_numbers_of_unknown(const SheetView::Row& row) {
        for (const Cell* head : heads_->unknown) {
            const Cell* cell = cell_in(row, head->address.column);
            if (cell != nullptr && sheet_.number_with_unit(*cell)) {
                with_numbers_.insert(head);
            }
        }
    }
    void tell_unknown_columns() {
        for (const Cell* head : heads_->unknown) {
            if (with_numbers_.contains(head)) {
                const std::string named = sheet_.words(*head);
                budget_.unread_columns.push_back(named);
                tables_.not_read.push_back(
                    say("{cell}: the column {head} has numbers and is not read; what does it have?",
                        sheet_.place(head->address), text::in_quotes(named)));
            }
        }
    }
    /// Whether a row has another unit than the result and nothing that brings it there, and a column is not read: what a budget in which
    /// it is added as it stands would say, nobody wants to know.
    [[nodiscard]] bool needs_unread_column() {
        if (budget_.unread_columns.empty() || budget_.unit.empty()) {
            return false;
        }
        const auto row = std::find_if(budget_.rows.begin(), budget_.rows.end(), [this](const AuditedRow& one) {
            return !one.sensitivity && !one.contribution && !one.unit.empty() && known_unit(one.unit) &&
                   known_unit(budget_.unit) && !factor_between(one.unit, budget_.unit);
        });
        if (row == budget_.rows.end()) {
            return false;
        }
        tables_.not_read.push_back(
            say("{cell}: {text} has another unit than the result and no coefficient that is read; the "
                "table is not looked at; is it in the column {head}?",
                row->place, text::in_quotes(row->quantity), text::in_quotes(budget_.unread_columns.front())));
        return true;
    }
    /// Whether a column of relative uncertainties stands beside u, as of products in chemistry, and nothing shows that u is what was added: the
    /// rows state no unit that they share, and what is stated does not follow from them.
    [[nodiscard]] bool needs_relative_column() {
        const auto relative = std::find_if(budget_.unread_columns.begin(), budget_.unread_columns.end(),
                                           [](const std::string& head) { return is_of_relative_uncertainty(head); });
        const bool has_coefficients =
            heads_->columns.contains(Column::sensitivity) || heads_->columns.contains(Column::contribution);
        if (relative == budget_.unread_columns.end() || has_coefficients || budget_.rows.empty()) {
            return false;
        }
        const std::string& unit = budget_.rows.front().unit;
        const bool have_one_unit = !unit.empty() && unit != "1" &&
                                   std::all_of(budget_.rows.begin(), budget_.rows.end(),
                                               [&unit](const AuditedRow& row) { return row.unit == unit; });
        const ClaimCheck check = check_claims(budget_);
        const bool is_stated = budget_.claims.u_c || budget_.claims.U;
        const bool follows = is_stated && check.allowed && !check.u_c_outside && !check.U_outside;
        if (have_one_unit || (follows && !budget_.unit.empty())) {
            return false;
        }
        tables_.not_read.push_back(
            say("{table}: the table is not looked at; the column {head} has relative uncertainties and is not read, "
                "and u of the rows has no unit that all of them state, or does not give what is stated; is the result "
                "made up of that column?",
                budget_.place, text::in_quotes(*relative)));
        return true;
    }
    /// Whether the dimensions of the rows may make up that of the result as a product: those that are not in its unit by themselves, or
    /// together with it; as squares, too, where no row is in its unit.
    [[nodiscard]] bool may_be_product() const {
        constexpr std::size_t k_most = 4'096;
        const std::optional<gum::Unit> result = known_unit(budget_.unit);
        if (!result) {
            return true;
        }
        std::vector<gum::Dimension> reached(1), others;
        for (const AuditedRow& row : budget_.rows) {
            const std::optional<gum::Unit> unit = known_unit(row.unit);
            if (unit && !(unit->dimension() == result->dimension())) {
                others.push_back(unit->dimension());
            }
        }
        const bool may_be_squares = others.size() == budget_.rows.size();
        for (const gum::Dimension& other : others) {
            std::vector<gum::Dimension> next;
            for (const gum::Dimension& so_far : reached) {
                for (const double exponent : {1.0, -1.0, 2.0, -2.0}) {
                    const gum::Dimension product = so_far * other.power(exponent);
                    const bool is_new = std::find(next.begin(), next.end(), product) == next.end();
                    if (is_new && (may_be_squares || std::abs(exponent) < 2.0)) {
                        next.push_back(product);
                    }
                }
            }
            if (next.size() > k_most) {
                return true;
            }
            reached = std::move(next);
        }
        return std::any_of(reached.begin(), reached.end(), [&](const gum::Dimension& product) {
            return product == result->dimension() || (!may_be_squares && product.is_one());
        });
    }
    /// Whether what is stated follows from the rows: u_c, or U where no u_c is.
    [[nodiscard]] bool follows_from_rows() const {
        const ClaimCheck check = check_claims(budget_);
        const bool is_stated = budget_.claims.u_c || budget_.claims.U;
        return is_stated && check.allowed && !check.u_c_outside && (budget_.claims.u_c || !check.U_outside);
    }
    /// Whether nothing says how rows make up a result: they have no coefficients and no contributions, and their units cannot be added, or
    /// are not there beside a column that is not read. A sum of their u is a number of nobody. Where something is stated, that is known
    /// where it does not follow from the rows as they stand, no more than half of them are in its unit, and a product of them is; of rows
    /// of one dimension a quotient or power may be, where none is in its unit.
    [[nodiscard]] bool has_no_sum() {
        std::set<std::string> units;
        bool differ = false;
        std::size_t in_its_unit = 0;
        const bool is_stated = budget_.claims.u_c || budget_.claims.U;
        for (const AuditedRow& row : budget_.rows) {
            // One that is the conversion of a unit says nothing of the model.
            if (have_coefficients_ || (!is_stated && row.sensitivity) || row.contribution ||
                (row.unit != "1" && !row.unit.empty() && !known_unit(row.unit))) {
                return false;
            }
            differ = differ || (!units.empty() && !factor_between(row.unit, *units.begin()));
            in_its_unit += factor_between(row.unit, budget_.unit) ? 1U : 0U;
            units.insert(row.unit);
        }
        if (is_stated) {
            differ = differ || (in_its_unit == 0 && known_unit(budget_.unit));
            if (!differ || 2 * in_its_unit > budget_.rows.size() || !may_be_product() || follows_from_rows()) {
                return false;
            }
            tables_.not_read.push_back(
                say("{table}: the table is not looked at; its rows have no coefficients, and their units are not that "
                    "of the result, which does not follow from them as a sum or as a product of their values; how do "
                    "they make it up?",
                    budget_.place));
            return true;
        }
        const bool have_none = units.size() == 1 && units.contains("") && budget_.unit.empty();
        if (!differ && !(have_none && !budget_.unread_columns.empty())) {
            return false;
        }
        tables_.not_read.push_back(say(
            "{table}: the table is not looked at; its rows have no coefficients, their units cannot be added or are "
            "not stated, and no result is; how do they make it up?",
            budget_.place));
        return true;
    }
    /// Names a line with a number of which nothing is used, and the first of several together.
    void note_unread(const SheetView::Row& row) {
        const bool has_number = std::any_of(row.begin() + 1, row.end(), [this](const Cell* cell) {
            return sheet_.number_with_unit(*cell).has_value();
        });
        const std::uint32_t line = row.front()->address.row;
        if (!has_number || sheet_.value(*row.front()).kind != CellKind::text) {
            return;
        }
        if (!last_unread_ || line > *last_unread_ + 1) {
            tables_.not_read.push_back(
                say("{cell}: {text} has a number, and is no row and no statement that is known; it is not used",
                    sheet_.place(row.front()->address), text::in_quotes(sheet_.words(*row.front()))));
        }
        last_unread_ = line;
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

    struct CorrelationLine {
        const SheetView::Row* row;
        double r;
        Pairs pairs;  ///< what may be the symbols of its rows
    };
    /// What was read of a table so far. Rows below heads that are headed again before any result ("Type A" and "Type B", the next page)
    /// are set apart as such.
    struct TableSoFar {
        std::optional<Heads> heads;
        AuditedBudget budget;
        std::vector<RowUnits> units;  ///< of its rows
        Statements statements;
        std::set<const Cell*> with_numbers;  ///< unknown heads of columns of numbers
        std::string title, unit_in_words;
        bool is_too_long = false, is_unusable = false, is_open = false, is_told = false, lost_a_row = false;
        std::optional<NumbersUnderHeads> result_line;
        std::vector<const SheetView::Row*> last_constants;
        std::vector<CorrelationLine> correlation_lines;
        const SheetView::Row* covariance_line = nullptr;
    };
    /// Takes the table that is read out of the reader.
    [[nodiscard]] TableSoFar table_so_far() {
        TableSoFar table{.heads = std::move(heads_),
                         .budget = std::move(budget_),
                         .units = std::move(units_),
                         .statements = std::move(statements_),
                         .with_numbers = std::move(with_numbers_),
                         .title = title_,
                         .unit_in_words = unit_in_words_,
                         .is_too_long = is_too_long_,
                         .is_unusable = is_unusable_,
                         .is_open = is_open_,
                         .is_told = is_told_,
                         .lost_a_row = lost_a_row_,
                         .result_line = std::move(result_line_),
                         .last_constants = std::move(last_constants_),
                         .correlation_lines = std::move(correlation_lines_),
                         .covariance_line = covariance_line_};
        clear();
        return table;
    }
    void go_on_with(TableSoFar table) {
        clear();
        heads_ = std::move(table.heads);
        budget_ = std::move(table.budget);
        units_ = std::move(table.units);
        statements_ = std::move(table.statements);
        with_numbers_ = std::move(table.with_numbers);
        title_ = std::move(table.title);
        unit_in_words_ = std::move(table.unit_in_words);
        is_too_long_ = table.is_too_long;
        is_unusable_ = table.is_unusable;
        is_open_ = table.is_open;
        is_told_ = table.is_told;
        lost_a_row_ = table.lost_a_row;
        result_line_ = std::move(table.result_line);
        last_constants_ = std::move(table.last_constants);
        correlation_lines_ = std::move(table.correlation_lines);
        covariance_line_ = table.covariance_line;
    }
    /// Whether heads are those of the table above them, which has rows, and has stated no uncertainty so far.
    [[nodiscard]] bool may_go_on(const Heads& heads) const {
        constexpr std::size_t k_most = 20;  // parts
        const auto states = [this](Statement statement) { return statements_.numbers.contains(statement); };
        const bool is_plain = !is_too_long_ && !is_unusable_ && !is_open_ && !is_told_ && !lost_a_row_ &&
                              !result_line_ && correlation_lines_.empty() && covariance_line_ == nullptr &&
                              heads.type_b.empty();
        return heads_ && is_plain && !budget_.rows.empty() && apart_.size() < k_most &&
               heads.columns == heads_->columns && heads.units == heads_->units && !states(Statement::u_c) &&
               !states(Statement::U) && !states(Statement::reported_U) && !states(Statement::value);
    }
    /// Whether what is stated follows from rows as they stand, or from those of them that are no sums of others.
    [[nodiscard]] bool follow_from(std::vector<AuditedRow> rows, std::vector<RowUnits> units,
                                   Statements statements) const {
        const TableSums sums{rows, units, *heads_, statements};
        const auto follow = [&sums] {
            const std::optional<StatedResult> of = sums.stated_of_sum();
            const std::optional<Interval> sum = of ? sums.sum_above(*of) : std::nullopt;
            return sum && sums.gives_statements(*sum).value_or(false);
        };
        if (!sums.stated_of_sum() || follow()) {
            return sums.stated_of_sum().has_value();
        }
        std::vector<Sentence> unused;
        return !settle_sums(sums, result_line_.has_value(), unused) && follow();
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
        rows.insert(rows.end(), budget_.rows.begin(), budget_.rows.end());
        units.insert(units.end(), units_.begin(), units_.end());
        Statements merged = statements_;
        for (const TableSoFar& part : apart) {
            merged.numbers.insert(part.statements.numbers.begin(), part.statements.numbers.end());
            merged.parts.insert(part.statements.parts.begin(), part.statements.parts.end());
            merged.words.insert(part.statements.words.begin(), part.statements.words.end());
            if (merged.coverage.empty()) {
                merged.coverage = part.statements.coverage;
                merged.coverage_place = part.statements.coverage_place;
            }
        }
        const bool is_one = heads_ && rows.size() > before && rows.size() <= k_most_rows &&
                            follow_from(rows, units, merged) && !follow_from(budget_.rows, units_, merged);
        if (is_one) {
            statements_ = std::move(merged);
            budget_.rows = std::move(rows);
            units_ = std::move(units);
            budget_.place = apart.front().budget.place;
            title_ = apart.front().title;
            unit_in_words_ = unit_in_words_.empty() ? apart.front().unit_in_words : unit_in_words_;
            std::vector<const SheetView::Row*> constants;
            for (const TableSoFar& part : apart) {
                with_numbers_.insert(part.with_numbers.begin(), part.with_numbers.end());
                constants.insert(constants.end(), part.last_constants.begin(), part.last_constants.end());
            }
            last_constants_.insert(last_constants_.begin(), constants.begin(), constants.end());
            return;
        }
        TableSoFar last = table_so_far();
        for (TableSoFar& part : apart) {
            go_on_with(std::move(part));
            finish_one();
        }
        go_on_with(std::move(last));
    }
    void finish() {
        join_or_finish_rows_apart();
        finish_one();
    }
    void finish_one() {
        if (is_too_long_) {  // a part of its rows would give another u_c
            tables_.not_read.push_back(
                say("{table}: the table is not looked at; it has more than the {most:number} rows that an audit takes",
                    budget_.place, std::to_string(k_most_rows)));
        } else if (heads_ && (!budget_.rows.empty() || is_unusable_)) {
            budget_.name = name_;
            budget_.title = title_;
            settle_constants();
            tell_unknown_columns();
            is_open_ = settle_sums(sums(), result_line_.has_value(), tables_.not_read) || is_open_;
            product_ = take_product();
            settle_result_line();
            if (is_open_) {
                tables_.has_unusable = true;
                clear();
                return;
            }
            settle_lost_row();
            settle_statements();
            settle_correlations();
            settle_product();
            if (is_told_) {
                tables_.has_unusable = true;
                clear();
                return;
            }
            if (!product_ && (needs_unread_column() || needs_relative_column() || has_no_sum())) {
                tables_.has_unusable = true;
                clear();
                return;
            }
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
            if (checklist_of(budget_.method) == nullptr) {
                budget_.method = method_in_title(budget_.method + " " + budget_.name);
            }
            settle_contributions(budget_);
            take_parts_of_value(budget_, statements_, tables_.not_read);
            state_coverage(budget_);
            note_unexplained(budget_);
            budget_.name += point_.empty() ? "" : ", " + point_;
            tables_.budgets.push_back(std::move(budget_));
            titles_.push_back(title_);
        }
        clear();
    }
    /// The value of a row, or of the line of a result, as a factor; the unit is that of its cell or head, else of the row.
    [[nodiscard]] static Factor factor_of(const StatedNumber& number, const std::string& unit) {
        return {.value = number.value, .relative_half_step = relative_half_step(number), .unit = unit};
    }
    [[nodiscard]] static double relative_half_step(const StatedNumber& number) {
        return number.value != 0.0 ? std::abs(number.half_step / number.value) : 0.0;
    }
    /// How the values of rows without coefficients make up that of the result as a product or quotient, as in chemistry. The result may
    /// be the last row, without a name that is known, where U is k times its u, and no line states u_c.
    [[nodiscard]] std::optional<ProductOfRows> take_product() {
        std::vector<AuditedRow>& rows = budget_.rows;
        const auto headed = [this](Column column) { return heads_->columns.contains(column); };
        if (is_open_ || rows.empty() || headed(Column::sensitivity) || headed(Column::contribution) ||
            !headed(Column::u)) {
            return std::nullopt;
        }
        std::vector<Factor> factors;
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::string &of_u = units_[i].u, &of_value = units_[i].estimate;
            if (!rows[i].estimate || !rows[i].u || is_part_beside(of_u, of_value) || !factor_between(of_u, of_value)) {
                return std::nullopt;
            }
            factors.push_back(factor_of(*rows[i].estimate, of_value));
        }
        if (const auto value = statements_.numbers.find(Statement::value); value != statements_.numbers.end()) {
            return product_of_rows(factors, factor_of(value->second.number, sums().unit_of(value->second)));
        }
        if (rows.back().stated || rows.back().divisor || statements_.numbers.contains(Statement::u_c)) {
            return std::nullopt;
        }
        const Factor last = factors.back();
        factors.pop_back();
        std::optional<ProductOfRows> product = product_of_rows(factors, last);
        const StatedResult u{.number = *rows.back().u, .unit = units_.back().u},
            value{.number = *rows.back().estimate, .unit = units_.back().estimate};
        if (!product || product->has_equal_factors || !is_u_c_of_stated_U(u)) {
            return std::nullopt;
        }
        const std::optional<Interval> sum = sums().sum_above(u);
        const bool is_sum = sum && sums().gives_statements(*sum, &u).value_or(false);
        rows.pop_back();
        units_.pop_back();
        statements_.numbers.emplace(Statement::value, value);
        statements_.numbers.emplace(Statement::u_c, u);
        if (is_sum && !is_u_c_of_product(u)) {
            leave_product();  // the last row may be one of a sum as well
        }
        return product;
    }
    void leave_product() {
        is_told_ = true;
        tables_.not_read.push_back(
            say("{table}: the table is not looked at; the values of its rows make up that of the result as a product "
                "or quotient, and nothing shows with which coefficients; what are they?",
                budget_.place));
    }
    /// Whether U is stated and is k times a number, whatever the rows give.
    [[nodiscard]] bool is_u_c_of_stated_U(const StatedResult& amount) {
        const auto U = statements_.numbers.find(Statement::U);
        if (U == statements_.numbers.end()) {
            return false;
        }
        const std::optional<StatedNumber> stated = sums().stated(Statement::k);
        const CoverageText said = coverage_in(statements_.coverage);
        const std::optional<LeadingNumber> in_words =
            said.k.empty() ? std::nullopt : read_leading_number(said.k, "", Percent::unit);
        const double k = stated ? stated->value : in_words ? in_words->number.value : 0.0;
        const std::optional<double> factor = factor_between(sums().unit_of(U->second), sums().unit_of(amount));
        return k > 1.0 && factor && as_rounded(U->second.number, k / *factor).meets(as_rounded(amount.number, 1.0));
    }
    /// Whether a number is u_c of the rows with c = y/x, within the digits of all.
    [[nodiscard]] bool is_u_c_of_product(const StatedResult& amount) {
        const StatedResult& result = statements_.numbers.at(Statement::value);
        const std::string unit = sums().unit_of(amount);
        const double to_value = unit.empty() ? 1.0 : factor_between(unit, sums().unit_of(result)).value_or(0.0);
        if (to_value == 0.0) {
            return false;
        }
        AuditedBudget product;
        product.claims.u_c = amount.number;
        for (std::size_t i = 0; i < budget_.rows.size(); ++i) {
            const double factor = factor_between(units_[i].u, units_[i].estimate).value_or(0.0);
            const double c = result.number.value / budget_.rows[i].estimate->value * factor / to_value;
            product.rows.push_back(with_coefficient(budget_.rows[i], c, result.number));
        }
        const ClaimCheck check = check_u_c(product);
        return check.allowed && !check.u_c_outside;
    }
    /// A row with a coefficient as the value of the result and its own one leave it open.
    [[nodiscard]] static AuditedRow with_coefficient(AuditedRow row, double c, const StatedNumber& value) {
        row.sensitivity = exact_number(c, row.place);
        row.sensitivity->half_step = std::abs(c) * (relative_half_step(value) + relative_half_step(*row.estimate));
        complete_row(row);
        return row;
    }
    /// Whether U is a part beside a value that is one as well: 3.1 % of 667 mg/kg, or of what 667 mg/kg are of.
    [[nodiscard]] bool has_U_of_open_part() {
        const auto U = statements_.numbers.find(Statement::U), value = statements_.numbers.find(Statement::value);
        if (U == statements_.numbers.end() || value == statements_.numbers.end()) {
            return false;
        }
        const std::string of_U = sums().unit_of(U->second), of_value = sums().unit_of(value->second);
        return is_unit_of_part(of_U) && of_U != of_value && factor_between(of_U, of_value);
    }
    /// Gives the rows of a product y = Π x^e their sensitivity coefficients, e y/x, unless their u were added as they stand. What is stated
    /// has to follow, or to follow from no exponents that fit.
    void settle_product() {
        const std::optional<StatedNumber>& value = budget_.claims.value;
        if (!product_ || is_told_ || is_unusable_) {
            product_.reset();
            return;
        }
        if (!value) {  // it is in another unit than what the rows are held against, as U in %
            leave_product();
            return;
        }
        const std::vector<AuditedRow> as_they_stand = budget_.rows;
        const auto take = [&](const std::vector<double>& exponents) {
            for (std::size_t i = 0; i < exponents.size(); ++i) {
                const AuditedRow& row = as_they_stand[i];
                budget_.rows[i] = with_coefficient(row, exponents[i] * value->value / row.estimate->value, *value);
            }
        };
        // u that are parts of the values, or percentages, that a head does not call so.
        const auto may_be_relative = [&](double unit_of_part) {
            for (std::size_t i = 0; i < as_they_stand.size(); ++i) {
                budget_.rows[i] = with_coefficient(as_they_stand[i], unit_of_part * value->value, *value);
            }
            return follows_from_rows();
        };
        const bool is_stated = budget_.claims.u_c || budget_.claims.U;
        const bool states_other = statements_.numbers.contains(Statement::u_c) ||
                                  statements_.numbers.contains(Statement::U) || !statements_.parts.empty();
        const bool is_correlated = !correlation_lines_.empty() || covariance_line_ != nullptr;
        const bool is_a_sum = follows_from_rows();
        take(product_->choices.front());
        const bool follows = follows_from_rows();
        if (is_a_sum && !follows) {
            budget_.rows = as_they_stand;
            product_.reset();
            return;
        }
        const bool is_one = product_->choices.size() == 1 && product_->has_all_choices;
        bool is_open = (!is_stated && states_other) || (is_correlated && !is_one) ||
                       (has_U_of_open_part() && check_claims(budget_).U_outside);
        if (is_stated && !follows && !is_open) {
            is_open = product_->has_equal_factors || !product_->has_all_choices || may_be_relative(1.0) ||
                      may_be_relative(0.01) ||
                      std::any_of(product_->choices.begin() + 1, product_->choices.end(), [&](const auto& choice) {
                          take(choice);
                          return follows_from_rows();
                      });
            take(product_->choices.front());
        }
        if (is_open) {
            leave_product();
            return;
        }
        tables_.not_read.push_back(
            say("{table}: the rows have no coefficients, and their values make up that of the result as a product or "
                "quotient; c = y/x is taken for each",
                budget_.place));
    }
    void clear() {
        product_.reset();
        budget_ = {};
        units_ = {};
        unit_in_words_.clear();
        statements_ = {};
        heads_.reset();
        in_rows_ = is_near_ = is_behind_results_ = false;
        is_too_long_ = is_unusable_ = is_open_ = is_told_ = lost_a_row_ = false;
        result_line_.reset();
        last_unread_.reset();
        last_constants_.clear();
        with_numbers_.clear();
        correlation_lines_.clear();
        covariance_line_ = nullptr;
        looks_ = 0;
    }

    /// The rows and statements of the table so far.
    [[nodiscard]] TableSums sums() { return {budget_.rows, units_, *heads_, statements_}; }

    /// A row of which no uncertainty was read is missing, unless the others make up what is stated.
    void settle_lost_row() {
        if (!lost_a_row_ || budget_.rows.empty()) {
            return;
        }
        const std::optional<StatedResult> of = sums().stated_of_sum();
        const std::optional<Interval> sum = of ? sums().sum_above(*of) : std::nullopt;
        is_unusable_ = is_unusable_ || !sum || !sums().gives_statements(*sum).value_or(false);
    }

    /// What stands beside the value of a result under u or the contributions: u_c, or U where k says so.
    void settle_result_line() {
        if (!result_line_) {
            return;
        }
        const auto number = [&](Column column, Statement statement) -> std::optional<StatedResult> {
            const auto found = result_line_->find(column);
            std::vector<Sentence> unused;
            return found == result_line_->end() ? std::nullopt : result_in(sheet_, *found->second, statement, unused);
        };
        std::optional<StatedResult> amount = number(Column::contribution, Statement::u_c);
        amount = amount ? amount : number(Column::u, Statement::u_c);
        if (amount && product_ && (is_u_c_of_stated_U(*amount) || is_u_c_of_product(*amount))) {
            const auto value = statements_.numbers.find(Statement::value);
            if (value != statements_.numbers.end() && sums().unit_of(*amount).empty()) {
                amount->unit = sums().unit_of(value->second);  // whatever U is stated in
            }
            sums().state(Statement::u_c, std::move(amount));
            sums().state(Statement::nu_eff, number(Column::nu, Statement::nu_eff));
            return;
        }
        const std::optional<Interval> sum = amount ? sums().sum_above(*amount) : std::nullopt;
        if (!sum) {
            return;
        }
        const std::optional<StatedResult> divisor = number(Column::divisor, Statement::k);
        const std::optional<StatedResult> last = number(Column::nu, Statement::k);
        if (as_rounded(amount->number, 1.0).meets(*sum)) {
            sums().state(Statement::u_c, std::move(amount));
            sums().state(Statement::nu_eff, number(Column::nu, Statement::nu_eff));
            return;
        }
        const std::optional<StatedNumber> k = sums().stated(Statement::k);
        for (const std::optional<StatedNumber>& by : {divisor ? std::optional(divisor->number) : std::nullopt, k,
                                                      last ? std::optional(last->number) : std::nullopt}) {
            if (!by || !(by->value > 1.0) || !as_rounded(amount->number, by->value).meets(*sum)) {
                continue;
            }
            sums().state(Statement::U, std::move(amount));
            if (divisor && by->place == divisor->number.place) {
                sums().state(Statement::k, divisor);
            } else if (last && by->place == last->number.place) {
                sums().state(Statement::k, last);
            }
            return;
        }
        constexpr double k_still_u_c = 1.6;  // no coverage factor is as small
        if (!product_ && amount->number.value < k_still_u_c * sum->high) {
            sums().state(Statement::u_c, std::move(amount));
            sums().state(Statement::nu_eff, number(Column::nu, Statement::nu_eff));
            return;
        }
        is_open_ = true;
        tables_.not_read.push_back(
            say("{cell}: beside the value of the result stands {text}, which is neither u_c of the rows nor U with a k "
                "that is stated; the table is not looked at; what is it?",
                amount->number.place, text::in_quotes(amount->number.text)));
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
        settle_parts_of_value(of_contributions);
        const bool has_no_units = std::all_of(units_.begin(), units_.end(), [](const RowUnits& units) {
            return units.stated.empty() && units.u.empty() && units.contribution.empty() && units.sensitivity.empty();
        });
        state_claims(budget_, statements_, of_contributions, has_no_units ? unit_in_words_ : unit_of_rows(),
                     tables_.not_read);
        have_coefficients_ = std::any_of(budget_.rows.begin(), budget_.rows.end(),
                                         [](const AuditedRow& row) { return row.sensitivity.has_value(); });
        is_unusable_ = !settle_units(budget_.rows, units_, budget_.unit, tables_.not_read) || is_unusable_;
        for (AuditedRow& row : budget_.rows) {
            settle_words(row);
            ask_for_divisor(row);
            if (row.open_expansion && !row.origin_value && row.origin == Origin::certificate) {
                tables_.not_read.push_back(
                    say("{cell}: the words of {text} state U of a certificate, and its size does not follow from them; "
                        "what it was divided by is not checked; how large is U?",
                        row.place, text::in_quotes(row.quantity)));
            }
            note_row_facts(row);
            if (row.source.empty() && row.origin == Origin::certificate) {
                row.source = certificate_in(row.comment);
            }
        }
    }

    /// Rows that are parts of the value, "w (%)", make up its relative u_c and U: those are what the rows are held against, whatever
    /// stands beside them in the unit of the value.
    void settle_parts_of_value(const std::string& of_contributions) {
        const bool are_parts = std::all_of(budget_.rows.begin(), budget_.rows.end(),
                                           [](const AuditedRow& row) { return is_unit_of_part(row.unit); });
        const bool are_added = std::all_of(budget_.rows.begin(), budget_.rows.end(), [](const AuditedRow& row) {
            return !row.sensitivity || std::abs(row.sensitivity->value) == 1.0;
        });
        const bool have_units_of_coefficients = std::any_of(units_.begin(), units_.end(), [](const RowUnits& units) {
            return !says_nothing(units.sensitivity) && units.sensitivity != "1";
        });
        const bool is_sum_of_parts = is_unit_of_part(of_contributions) || (of_contributions.empty() && are_added);
        if (budget_.rows.empty() || !are_parts || have_units_of_coefficients || !is_sum_of_parts) {
            return;
        }
        // Without a value that has parts, and with nothing that says that the sum is one, a unit of another kind is a contradiction.
        const auto value = statements_.numbers.find(Statement::value);
        const bool has_value =
            value != statements_.numbers.end() && has_parts(value->second.number, value->second.unit);
        bool is_said = is_unit_of_part(of_contributions);
        for (const Statement statement : {Statement::u_c, Statement::U, Statement::reported_U}) {
            const auto number = statements_.numbers.find(statement);
            is_said = is_said || statements_.parts.contains(statement) ||
                      (number != statements_.numbers.end() && is_unit_of_part(number->second.unit));
        }
        if (!has_value && !is_said) {
            return;
        }
        statements_.unit_of_parts = of_contributions.empty() ? budget_.rows.front().unit : of_contributions;
        for (const Statement statement : {Statement::u_c, Statement::U, Statement::reported_U}) {
            const auto number = statements_.numbers.find(statement), part = statements_.parts.find(statement);
            if (number != statements_.numbers.end() && part != statements_.parts.end()) {
                std::swap(number->second, part->second);
            }
        }
    }

    /// What is divided by a number that nobody knows has no u: neither a divisor is stated, nor a distribution that has one.
    void ask_for_divisor(const AuditedRow& row) {
        const bool is_open = row.stated && !row.divisor && !row.u && !row.contribution && !row.certificate_k;
        const bool is_expanded = row.shape == Shape::normal && coverage_in(row.shape_text).p;  // "normal (95 %)"
        const bool has_no_divisor = row.shape == Shape::other || row.shape == Shape::trapezoidal || is_expanded;
        if (is_open && has_no_divisor && heads_->columns.contains(Column::distribution)) {
            is_told_ = true;
            tables_.not_read.push_back(
                say("{cell}: no divisor is stated, and {text} is no distribution that has one; the table is not looked "
                    "at; what is the number divided by?",
                    row.place, text::in_quotes(row.shape_text)));
        }
    }
    /// The unit that all rows state which are added as they are: what is added up has one unit, and the result has it. "1" where all
    /// are of dimension one, whatever their coefficients.
    [[nodiscard]] std::string unit_of_rows() const {
        const auto is_one = [](const std::string& unit) { return unit == "1" || unit == "-" || unit == "–"; };
        if (!budget_.rows.empty() && std::all_of(budget_.rows.begin(), budget_.rows.end(),
                                                 [&is_one](const AuditedRow& row) { return is_one(row.unit); })) {
            return "1";
        }
        std::optional<std::string> shared;
        std::size_t as_they_are = 0;
        for (const AuditedRow& row : budget_.rows) {
            const bool as_it_is = !row.sensitivity || std::abs(row.sensitivity->value) == 1.0;
            const std::string unit = is_one(row.unit) ? "1" : row.unit;
            if (as_it_is && (unit.empty() || (shared && *shared != unit))) {
                return "";
            }
            shared = as_it_is ? unit : shared;
            as_they_are += as_it_is ? 1U : 0U;
        }
        // One row alone may have a coefficient of 1/A beside another one's of 10 V/A².
        return as_they_are == budget_.rows.size() || as_they_are > 1 ? shared.value_or("") : "";
    }

    const SheetView& sheet_;
    const SheetView::Rows* rows_ = nullptr;  ///< that are read
    std::string point_;                      ///< of a table of several, that they are of
    std::string name_;
    ForeignTables& tables_;
    std::optional<Heads> heads_;
    bool in_rows_ = false;
    bool is_near_ = false;            ///< no two empty lines since the heads
    bool is_behind_results_ = false;  ///< no two empty lines since results that stand beside each other
    std::uint32_t skip_until_ = 0;    ///< line up to which all was taken together
    bool is_next_ = false;            ///< no empty line before this one
    bool is_open_ = false;            ///< nobody can know what the result is, and it was said
    bool lost_a_row_ = false;         ///< its uncertainty has digits, and was not read
    bool is_told_ = false;            ///< why the table is not looked at
    bool is_too_long_ = false;
    bool is_unusable_ = false;              ///< a row has an uncertainty that could not be read
    bool have_coefficients_ = false;        ///< rows state them
    std::optional<ProductOfRows> product_;  ///< that the values of the rows make up, where they do
    AuditedBudget budget_;
    std::vector<RowUnits> units_;    ///< of its rows
    std::deque<Cell> joined_;        ///< heads that stand in two lines
    std::vector<TableSoFar> apart_;  ///< rows above it, below the same heads
    Statements statements_;
    std::optional<NumbersUnderHeads> result_line_;       ///< states the value, and more
    std::size_t looks_ = 0;                              ///< at sums of the rows, for lines that look like rows
    std::optional<std::uint32_t> last_unread_;           ///< line that was named as not read, or follows such
    std::vector<const SheetView::Row*> last_constants_;  ///< behind the last row so far
    std::set<const Cell*> with_numbers_;                 ///< unknown heads of columns of numbers
    std::vector<CorrelationLine> correlation_lines_;
    const SheetView::Row* covariance_line_ = nullptr;  ///< the first one with a covariance
    std::string unit_in_words_;                        ///< that a line above or below the table has for all of it
    std::string unit_above_;                           ///< that the line `line_of_unit_` has for all
    std::uint32_t line_of_unit_ = 0;
    std::string above_, title_;  ///< last line of words alone, and that above the heads
    std::uint32_t line_above_ = 0;
    std::vector<std::string>& titles_;
};

}  // namespace

namespace {

/// Budgets of one name are told apart by the line above their heads, or by their place.
void tell_apart(std::vector<AuditedBudget>& budgets, const std::vector<std::string>& titles) {
    const auto add = [&budgets](const auto& words) {
        std::map<std::string, std::size_t> names;
        for (const AuditedBudget& budget : budgets) {
            ++names[budget.name];
        }
        for (std::size_t i = 0; i < budgets.size(); ++i) {
            if (names[budgets[i].name] > 1 && !words(i).empty()) {
                budgets[i].name += ", " + words(i);
            }
        }
    };
    add([&titles](std::size_t i) { return titles[i]; });
    add([&budgets](std::size_t i) { return budgets[i].place; });
}

/// What the points of one table have in common is said once.
void tell_once(std::vector<Sentence>& sentences, std::size_t from) {
    constexpr std::size_t k_most = 500;  // of so many nobody reads all
    if (sentences.size() - from > k_most) {
        return;
    }
    for (std::size_t i = from; i < sentences.size(); ++i) {
        const auto at = sentences.begin() + static_cast<std::ptrdiff_t>(i);
        sentences.erase(std::remove(at + 1, sentences.end(), Sentence(*at)), sentences.end());
    }
}

/// Says what of the heads of a sheet without a table is known, and what is missing.
void tell_nearest_heads(const SheetView& sheet, std::vector<Sentence>& not_read) {
    constexpr std::size_t k_most = 6;
    const std::optional<NearestHeads> heads = nearest_heads(sheet);
    if (!heads) {
        return;
    }
    const std::string place = sheet.place({.row = heads->row, .column = heads->column});
    const auto quoted = [](const std::vector<std::string>& texts) {
        std::vector<std::string> all;
        std::transform(texts.begin(), texts.end(), std::back_inserter(all),
                       [](const std::string& text) { return text::in_quotes(text); });
        return listed(sentences_of(all), k_most);
    };
    not_read.push_back(
        heads->has_quantity
            ? say("{cell}: nearest to such heads; known are {known}; none names u, the contributions, or what "
                  "is divided and by what",
                  place, quoted(heads->known))
            : say("{cell}: nearest to such heads; known are {known}; none names the quantities", place,
                  quoted(heads->known)));
    if (!heads->unknown.empty()) {
        not_read.push_back(say("{cell}: not known are {heads}", place, quoted(heads->unknown)));
    }
}

}  // namespace

ForeignTables budgets_in(const workbook::Workbook& workbook, const workbook::Evaluation& evaluation,
                         const std::string& file) {
    ForeignTables tables;
    std::vector<std::string> titles;
    const DecimalSign sign = decimal_sign_of(workbook);
    for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
        if (workbook.sheets[i].state != workbook::SheetState::visible) {
            continue;
        }
        const SheetView sheet(workbook, evaluation, i, sign);
        const std::string name = workbook.sheets.size() == 1 ? file : file + ", " + workbook.sheets[i].name;
        const std::size_t before = tables.budgets.size(), told = tables.not_read.size();
        const bool was_unusable = tables.has_unusable;
        const auto read = [&](const SheetView& view) {
            for (const TablePart& part : parts_of(view)) {
                TableReader(view, name, tables, titles).read(part);
            }
        };
        read(sheet);
        if (tables.budgets.size() == before && tables.has_unusable == was_unusable) {
            if (const std::optional<TurnedBlock> block = turned_block(sheet)) {
                // What was said of its rows as they stand there is not of the table.
                const auto first = tables.not_read.begin() + static_cast<std::ptrdiff_t>(told);
                const std::vector<Sentence> as_it_stands(first, tables.not_read.end());
                tables.not_read.erase(first, tables.not_read.end());
                read(SheetView(workbook, evaluation, i, sign, block));
                if (tables.budgets.size() == before) {
                    tables.not_read.resize(told);
                    tables.not_read.insert(tables.not_read.end(), as_it_stands.begin(), as_it_stands.end());
                }
            }
        }
        tell_once(tables.not_read, told);
    }
    tell_apart(tables.budgets, titles);
    if (tables.budgets.empty() && !tables.has_unusable) {
        tables.not_read.push_back(
            say("{file}: no uncertainty budget was found — a table begins with a row of heads, of which one names the "
                "quantities and one u, the contributions, or, beside a third column, what is divided — name the "
                "columns so, "
                "in English or German",
                file));
        for (std::size_t i = 0; i < workbook.sheets.size(); ++i) {
            if (workbook.sheets[i].state == workbook::SheetState::visible) {
                tell_nearest_heads(SheetView(workbook, evaluation, i, sign), tables.not_read);
            }
        }
    }
    return tables;
}

}  // namespace gumcert::audit
