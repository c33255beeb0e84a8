#include "workbook/sheet_part.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "text/plus_sign.h"
#include "text/utf8.h"
#include "text/visible_text.h"
#include "workbook/formula_text.h"
#include "workbook/letters.h"
#include "workbook/limits.h"
#include "workbook/xml_events.h"

namespace gumcert::workbook {

namespace {

template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
    Number value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    return failure == std::errc() && end == text.data() + text.size() && !text.empty() ? std::optional(value)
                                                                                       : std::nullopt;
}

std::optional<CellRange> read_range(std::string_view text) {
    const std::size_t colon = text.find(':');
    const std::optional<CellAddress> first = read_a1(text.substr(0, colon));
    const std::optional<CellAddress> last = colon == std::string_view::npos ? first : read_a1(text.substr(colon + 1));
    return first && last ? std::optional(CellRange{*first, *last}) : std::nullopt;
}

/// A formula that other cells share, at the cell that has its text.
struct SharedFormula {
    CellAddress at;
    std::string text;
    std::optional<Formula> formula;  ///< nothing: it is not understood, and its copies will not be either
};

class SheetReader final : public XmlHandler {
public:
    SheetReader(std::string where, const SheetSurroundings& surroundings, Sheet& sheet)
        : where_(std::move(where)), surroundings_(surroundings), sheet_(sheet) {}

    void start(std::string_view name, const XmlAttributes& attributes) override {
        if (name == "c" && is_in("row")) {
            start_cell(attributes);
        } else if (name == "row" && is_in("sheetData")) {
            start_row(attributes);
        } else if (name == "v" && is_in("c")) {
            target_ = &value_;
        } else if (name == "f" && is_in("c")) {
            start_formula(attributes);
        } else if (name == "t" && (is_in("is") || is_in("r"))) {
            target_ = &value_;
        } else if (name == "sheetProtection" && is_in("worksheet")) {
            sheet_.is_protected = attributes.is_true("sheet");
        } else if (name == "col" && is_in("cols") && attributes.is_true("hidden")) {
            hide_columns(attributes);
        }
    }

    void end(std::string_view name) override {
        target_ = nullptr;
        if (name == "c" && is_in("row")) {
            end_cell();
        }
    }

    void text(std::string_view characters) override {
        if (target_ != nullptr) {
            surroundings_.texts.take(characters.size(), where_);
            *target_ += characters;
        }
    }

    void finish() {
        for (const auto& [cell, group] : copies_) {
            const auto shared = shared_.find(group);
            if (shared == shared_.end()) {
                throw bad_content(at(sheet_.cells[cell].address), "a shared formula of which no cell has the text");
            }
            Cell& copy = sheet_.cells[cell];
            const SharedFormula& origin = shared->second;
            copy.formula =
                origin.formula ? copied_formula(origin.text, *origin.formula, origin.at, copy.address) : origin.text;
            surroundings_.texts.take(copy.formula.size(), where_);
        }
        const auto before = [](const Cell& a, const Cell& b) { return a.address < b.address; };
        if (!std::is_sorted(sheet_.cells.begin(), sheet_.cells.end(), before)) {
            std::sort(sheet_.cells.begin(), sheet_.cells.end(), before);
        }
        const auto twice = std::adjacent_find(sheet_.cells.begin(), sheet_.cells.end(),
                                              [](const Cell& a, const Cell& b) { return a.address == b.address; });
        if (twice != sheet_.cells.end()) {
            throw bad_content(at(twice->address), "a cell that occurs twice");
        }
    }

private:
    [[nodiscard]] std::string at(const CellAddress& address) const {
        return where_ + " " + text::visible(sheet_a1(sheet_.name, address));
    }

    void start_row(const XmlAttributes& attributes) {
        std::uint32_t row = address_.row + 1;
        if (const std::string& said = attributes.value("r"); !said.empty()) {
            row = whole_number<std::uint32_t>(said).value_or(0);
        }
        if (row < 1 || row > k_most_rows) {
            throw bad_content(where_, "a row " + text::in_quotes(attributes.value("r")));
        }
        address_ = {row, 0};
        if (attributes.is_true("hidden")) {
            if (!sheet_.hidden_rows.empty() && sheet_.hidden_rows.back().last + 1 == row) {
                sheet_.hidden_rows.back().last = row;
            } else {
                sheet_.hidden_rows.push_back({row, row});
            }
        }
    }

    void hide_columns(const XmlAttributes& attributes) {
        const std::uint32_t first = whole_number<std::uint32_t>(attributes.value("min")).value_or(0);
        const std::uint32_t last = whole_number<std::uint32_t>(attributes.value("max")).value_or(0);
        if (first < 1 || last < first || last > k_most_columns) {
            throw bad_content(where_, "columns from " + text::in_quotes(attributes.value("min")) + " to " +
                                          text::in_quotes(attributes.value("max")));
        }
        sheet_.hidden_columns.push_back({first, last});
    }

    void start_cell(const XmlAttributes& attributes) {
        cell_ = {};
        value_.clear();
        group_.reset();
        const std::string& said = attributes.value("r");
        if (said.empty()) {
            ++address_.column;
        } else {
            const std::optional<CellAddress> address = read_a1(said);
            if (!address || address->row != address_.row) {
                throw bad_content(where_,
                                  "a cell " + text::in_quotes(said) + " in row " + std::to_string(address_.row));
            }
            address_ = *address;
        }
        if (address_.column > k_most_columns) {
            throw bad_content(where_, "a cell beyond the last column in row " + std::to_string(address_.row));
        }
        cell_.address = address_;
        type_ = attributes.value("t");
        const std::string& style = attributes.value("s");
        const std::size_t place = style.empty() ? 0 : whole_number<std::size_t>(style).value_or(k_most_formats);
        if (place < surroundings_.format_of_style.size()) {
            cell_.number_format = surroundings_.format_of_style[place];
        }
    }

    void start_formula(const XmlAttributes& attributes) {
        const std::string& type = attributes.value("t");
        cell_.formula_kind = type == "array"       ? FormulaKind::array
                             : type == "dataTable" ? FormulaKind::data_table
                                                   : FormulaKind::plain;
        if (type == "shared") {
            group_ = whole_number<std::uint32_t>(attributes.value("si"));
            if (!group_) {
                throw bad_content(at(address_), "a shared formula without a number");
            }
        }
        if (type == "array") {
            const std::optional<CellRange> range = read_range(attributes.value("ref"));
            if (!range || range->first != address_) {
                throw bad_content(at(address_), "an array formula over " + text::in_quotes(attributes.value("ref")));
            }
            if (range->first != range->last) {
                sheet_.array_ranges.push_back(*range);
            }
        }
        if (type == "dataTable") {
            cell_.formula = "TABLE(" + attributes.value("r1") + "," + attributes.value("r2") + ")";
            surroundings_.texts.take(cell_.formula.size(), where_);
            return;
        }
        target_ = &cell_.formula;
    }

    void end_cell() {
        if (text::character_count(cell_.formula) > k_longest_formula) {
            throw gum::InputError(
                gum::Diagnostic{.code = "GC-WORKBOOK-0013",
                                .where = at(address_),
                                .what = "a formula of " + std::to_string(cell_.formula.size()) + " bytes",
                                .rule = "a formula has at most 8192 characters",
                                .action = "divide it over several cells"});
        }
        set_value();
        if (cell_.formula.empty() && !group_) {
            cell_.formula_kind = FormulaKind::none;
            if (cell_.value.kind == CellKind::blank) {
                return;  // a cell that has a format and nothing else
            }
        }
        if (surroundings_.cells_left == 0) {
            throw too_many(where_, "more than 2 million cells");
        }
        --surroundings_.cells_left;
        if (group_) {
            if (cell_.formula.empty()) {
                copies_.emplace_back(sheet_.cells.size(), *group_);
            } else {
                share();
            }
        }
        sheet_.cells.push_back(std::move(cell_));
    }

    void share() {
        SharedFormula shared{.at = address_, .text = cell_.formula, .formula = {}};
        try {
            shared.formula = parse_formula(shared.text, "");
        } catch (const gum::InputError&) {
            shared.formula.reset();
        }
        if (!shared_.emplace(*group_, std::move(shared)).second) {
            throw bad_content(at(address_), "a second shared formula of the number " + std::to_string(*group_));
        }
    }

    void set_value() {
        CellValue& value = cell_.value;
        const bool has_formula = !cell_.formula.empty() || group_.has_value();
        if (type_ == "s") {
            const std::optional<std::size_t> place = whole_number<std::size_t>(value_);
            if (!place || *place >= surroundings_.shared_strings.size()) {
                throw bad_content(at(address_), "a shared text " + text::in_quotes(value_) + " that there is not");
            }
            surroundings_.texts.take(surroundings_.shared_strings[*place].size(), where_);
            value = {.kind = CellKind::text, .text = surroundings_.shared_strings[*place]};
        } else if (type_ == "str" || type_ == "inlineStr" || type_ == "d") {
            // A formula that gave an empty text has it as its stored value; a cell with an empty text shows nothing.
            value = {.kind = value_.empty() && !has_formula ? CellKind::blank : CellKind::text,
                     .text = std::move(value_)};
        } else if (value_.empty()) {
            value = {};
        } else if (type_ == "b") {
            if (value_ != "0" && value_ != "1" && value_ != "true" && value_ != "false") {
                throw bad_content(at(address_), "a truth value " + text::in_quotes(value_));
            }
            value = {.kind = CellKind::boolean, .number = value_ == "1" || value_ == "true" ? 1.0 : 0.0};
        } else if (type_ == "e") {
            const std::optional<CellError> error = read_error(value_);
            if (!error) {
                throw bad_content(at(address_), "an error value " + text::in_quotes(value_));
            }
            value = {.kind = CellKind::error, .error = *error, .text = std::move(value_)};
        } else {
            set_number();
        }
    }

    void set_number() {
        std::string_view digits = value_;
        while (!digits.empty() && is_space(digits.front())) {
            digits.remove_prefix(1);
        }
        while (!digits.empty() && is_space(digits.back())) {
            digits.remove_suffix(1);
        }
        double number = 0.0;
        const std::string_view unsigned_digits = text::without_plus(digits);
        const auto [end, failure] =
            std::from_chars(unsigned_digits.data(), unsigned_digits.data() + unsigned_digits.size(), number);
        if (failure != std::errc() || end != unsigned_digits.data() + unsigned_digits.size() ||
            !std::isfinite(number)) {
            throw bad_content(at(address_), "a number " + text::in_quotes(value_));
        }
        cell_.value = {.kind = CellKind::number, .number = number, .text = std::string(digits)};
    }

    std::string where_;
    const SheetSurroundings& surroundings_;
    Sheet& sheet_;
    CellAddress address_{.row = 0, .column = 0};
    Cell cell_;
    std::string type_, value_;
    std::optional<std::uint32_t> group_;
    std::string* target_ = nullptr;
    std::unordered_map<std::uint32_t, SharedFormula> shared_;
    std::vector<std::pair<std::size_t, std::uint32_t>> copies_;  ///< place of the cell, group
};

}  // namespace

void read_sheet_part(std::string_view xml, const std::string& where, const SheetSurroundings& surroundings,
                     Sheet& sheet) {
    SheetReader reader(where, surroundings, sheet);
    read_xml_events(xml, where, reader);
    reader.finish();
}

}  // namespace gumcert::workbook
