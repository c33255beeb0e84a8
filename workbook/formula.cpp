#include "workbook/formula.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/utf8.h"
#include "text/visible_text.h"
#include "workbook/letters.h"
#include "workbook/limits.h"

namespace gumcert::workbook {

namespace {

using NodeKind = FormulaNodeKind;

bool is_word(char c) {
    return is_letter(c) || is_digit(c) || c == '_' || c == '.' || c == '\\' || c == '?' || c == '$' ||
           static_cast<unsigned char>(c) >= 0x80U;
}

struct BinaryOperator {
    std::string_view text;
    NodeKind kind;
    int level;  ///< the higher, the closer it binds
};

// Longer ones first. The operators of references bind closest, and are read with the operands.
constexpr std::array<BinaryOperator, 12> k_operators{{{"<=", NodeKind::less_equal, 1},
                                                      {">=", NodeKind::greater_equal, 1},
                                                      {"<>", NodeKind::not_equal, 1},
                                                      {"=", NodeKind::equal, 1},
                                                      {"<", NodeKind::less, 1},
                                                      {">", NodeKind::greater, 1},
                                                      {"&", NodeKind::concatenate, 2},
                                                      {"+", NodeKind::add, 3},
                                                      {"-", NodeKind::subtract, 3},
                                                      {"*", NodeKind::multiply, 4},
                                                      {"/", NodeKind::divide, 4},
                                                      {"^", NodeKind::power, 5}}};

constexpr std::array<std::string_view, 14> k_error_words{
    "#NULL!",  "#DIV/0!", "#VALUE!",       "#REF!",   "#NAME?",    "#NUM!",     "#N/A",
    "#SPILL!", "#CALC!",  "#GETTING_DATA", "#FIELD!", "#BLOCKED!", "#CONNECT!", "#UNKNOWN!"};

class FormulaParser {
public:
    FormulaParser(std::string_view text, std::string_view where) : text_(text), where_(where) {}

    Formula parse() {
        if (text::character_count(text_) > k_longest_formula) {
            throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0013",
                                                  .where = std::string(where_),
                                                  .what = "a formula of " + std::to_string(text_.size()) + " bytes",
                                                  .rule = "a formula has at most 8192 characters",
                                                  .action = "divide it over several cells"});
        }
        skip_spaces();
        if (at_ < text_.size() && text_[at_] == '=') {
            ++at_;
        }
        const std::uint32_t root = expression(0);
        skip_spaces();
        if (at_ != text_.size()) {
            refuse("what follows is no operator");
        }
        if (root + 1 != formula_.nodes.size()) {
            refuse("no formula");
        }
        return std::move(formula_);
    }

private:
    [[noreturn]] void refuse(const std::string& what) const {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-WORKBOOK-0014",
                            .where = std::string(where_),
                            .what = what + " at byte " + std::to_string(at_ + 1) + " of " + text::in_quotes(text_),
                            .rule = "a formula is written as spreadsheets store it (ECMA-376 Part 1, 18.17)",
                            .action = "store the workbook again with the program that made it"});
    }

    /// Counts the levels of brackets, calls and signs that are open.
    class Level {
    public:
        explicit Level(FormulaParser& parser) : parser_(parser) { parser_.go_deeper(); }
        ~Level() { --parser_.depth_; }
        Level(const Level&) = delete;
        Level& operator=(const Level&) = delete;

    private:
        FormulaParser& parser_;
    };

    void go_deeper() {
        if (depth_ >= k_deepest_nesting) {
            throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0015",
                                                  .where = std::string(where_),
                                                  .what = "a formula nested more than 64 levels deep",
                                                  .rule = "brackets, functions and signs stand at most 64 levels deep",
                                                  .action = "divide the formula over several cells"});
        }
        ++depth_;
    }

    void skip_spaces() {
        while (at_ < text_.size() && is_space(text_[at_])) {
            ++at_;
        }
    }

    [[nodiscard]] bool begins(std::string_view word) const { return text_.substr(at_).starts_with(word); }

    std::uint32_t add(FormulaNode node, std::size_t begin, std::span<const std::uint32_t> children = {}) {
        node.offset = static_cast<std::uint32_t>(begin);
        node.length = static_cast<std::uint32_t>(at_ - begin);
        node.first_child = static_cast<std::uint32_t>(formula_.children.size());
        node.children = static_cast<std::uint32_t>(children.size());
        formula_.children.insert(formula_.children.end(), children.begin(), children.end());
        formula_.nodes.push_back(std::move(node));
        return formula_.root();
    }

    std::uint32_t expression(int least) {
        skip_spaces();
        const std::size_t begin = at_;
        std::uint32_t left = signed_operand();
        for (;;) {
            skip_spaces();
            const auto* const found = std::find_if(k_operators.begin(), k_operators.end(),
                                                   [&](const BinaryOperator& one) { return begins(one.text); });
            if (found == k_operators.end() || found->level <= least) {
                return left;
            }
            at_ += found->text.size();
            const std::uint32_t right = expression(found->level);
            left = add({.kind = found->kind}, begin, std::array{left, right});
        }
    }

    std::uint32_t signed_operand() {
        skip_spaces();
        const std::size_t begin = at_;
        if (at_ < text_.size() && (text_[at_] == '-' || text_[at_] == '+' || text_[at_] == '@')) {
            const char sign = text_[at_++];
            const Level level(*this);
            const std::uint32_t operand = signed_operand();
            if (sign == '@') {
                return operand;  // one cell of a range, which is what a single cell takes anyway
            }
            return add({.kind = sign == '-' ? NodeKind::negate : NodeKind::plus}, begin, std::array{operand});
        }
        std::uint32_t operand = joined_references(begin);
        std::size_t percents = 0;
        for (skip_spaces(); at_ < text_.size() && text_[at_] == '%'; skip_spaces()) {
            ++at_;
            ++percents;
            go_deeper();
            operand = add({.kind = NodeKind::percent}, begin, std::array{operand});
        }
        depth_ -= percents;
        return operand;
    }

    [[nodiscard]] bool is_reference(std::uint32_t node) const {
        const NodeKind kind = formula_.nodes[node].kind;
        return kind == NodeKind::reference || kind == NodeKind::name || kind == NodeKind::call ||
               kind == NodeKind::range || kind == NodeKind::intersection || kind == NodeKind::reunion ||
               kind == NodeKind::structured;
    }

    std::uint32_t joined_references(std::size_t begin) {
        std::uint32_t left = operand();
        for (;;) {
            const std::size_t end = at_;
            skip_spaces();
            const char next = at_ < text_.size() ? text_[at_] : '\0';
            if (next == ':' && is_reference(left)) {
                ++at_;
                skip_spaces();
                const std::uint32_t right = operand();
                left = add({.kind = NodeKind::range}, begin, std::array{left, right});
            } else if (at_ > end && is_reference(left) &&
                       (is_word(next) || next == '\'' || next == '[' || next == '(')) {
                const std::uint32_t right = operand();
                left = add({.kind = NodeKind::intersection}, begin, std::array{left, right});
            } else {
                return left;
            }
        }
    }

    std::uint32_t operand() {
        const std::size_t begin = at_;
        if (at_ >= text_.size()) {
            refuse("a value is missing");
        }
        const char c = text_[at_];
        if (c == '(') {
            return bracket(begin);
        }
        if (c == '"') {
            std::string text = quoted('"');
            return add({.kind = NodeKind::text, .text = std::move(text)}, begin);
        }
        if (c == '#') {
            return error(begin);
        }
        if (c == '{') {
            return array(begin);
        }
        if (c == '\'' || c == '[' || is_word(c)) {
            return word_operand(begin);
        }
        refuse("a character that begins no value");
    }

    std::uint32_t bracket(std::size_t begin) {
        const Level level(*this);
        ++at_;
        std::uint32_t inner = expression(0);
        skip_spaces();
        while (at_ < text_.size() && text_[at_] == ',' && is_reference(inner)) {
            ++at_;
            const std::uint32_t right = expression(0);
            inner = add({.kind = NodeKind::reunion}, begin, std::array{inner, right});
            skip_spaces();
        }
        expect(')');
        return inner;
    }

    void expect(char c) {
        if (at_ >= text_.size() || text_[at_] != c) {
            refuse(std::string("`") + c + "` is missing");
        }
        ++at_;
    }

    /// What stands between two marks; two marks inside stand for one.
    std::string quoted(char mark) {
        std::string inside;
        for (++at_;; ++at_) {
            if (at_ >= text_.size()) {
                refuse("a quote that is not closed");
            }
            if (text_[at_] == mark) {
                ++at_;
                if (at_ >= text_.size() || text_[at_] != mark) {
                    return inside;
                }
            }
            inside += text_[at_];
        }
    }

    std::uint32_t error(std::size_t begin) {
        for (const std::string_view word : k_error_words) {
            if (begins(word)) {
                at_ += word.size();
                return add({.kind = NodeKind::error, .error = *read_error(word), .text = std::string(word)}, begin);
            }
        }
        refuse("an unknown error value");
    }

    std::uint32_t array(std::size_t begin) {
        ++at_;
        std::vector<std::uint32_t> elements;
        std::size_t columns = 0;
        for (std::size_t in_row = 1;; ++in_row) {
            elements.push_back(array_element());
            skip_spaces();
            const char next = at_ < text_.size() ? text_[at_] : '\0';
            if (next == ',') {
                ++at_;
                continue;
            }
            if (columns != 0 && in_row != columns) {
                refuse("rows of an array that differ in length");
            }
            columns = in_row;
            if (next == ';') {
                ++at_;
                in_row = 0;
                continue;
            }
            expect('}');
            return add({.kind = NodeKind::array, .columns = static_cast<std::uint32_t>(columns)}, begin, elements);
        }
    }

    std::uint32_t array_element() {
        skip_spaces();
        const std::size_t begin = at_;
        const bool negative = at_ < text_.size() && text_[at_] == '-';
        if (negative || (at_ < text_.size() && text_[at_] == '+')) {
            ++at_;
        }
        if (at_ >= text_.size()) {
            refuse("a value is missing");
        }
        const char c = text_[at_];
        if (is_digit(c) || c == '.') {
            const std::uint32_t node = number();
            formula_.nodes[node].number *= negative ? -1.0 : 1.0;
            formula_.nodes[node].text = std::string(text_.substr(begin, at_ - begin));
            return node;
        }
        if (at_ != begin) {
            refuse("a sign before no number");
        }
        if (c == '"') {
            std::string text = quoted('"');
            return add({.kind = NodeKind::text, .text = std::move(text)}, begin);
        }
        if (c == '#') {
            return error(begin);
        }
        const std::string word = folded_text(next_word());
        if (word == "TRUE" || word == "FALSE") {
            at_ += word.size();
            return add({.kind = NodeKind::boolean, .number = word == "TRUE" ? 1.0 : 0.0}, begin);
        }
        refuse("an array holds constants only");
    }

    std::uint32_t number() {
        const std::size_t begin = at_;
        double value = 0.0;
        const auto [end, failure] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
        if (failure != std::errc() || !std::isfinite(value)) {
            refuse("a number that cannot be read");
        }
        at_ = static_cast<std::size_t>(end - text_.data());
        if (at_ < text_.size() && is_word(text_[at_])) {
            refuse("a number that goes on as a word");
        }
        return add({.kind = NodeKind::number, .number = value, .text = std::string(text_.substr(begin, at_ - begin))},
                   begin);
    }

    [[nodiscard]] std::string_view next_word() const {
        std::size_t end = at_;
        while (end < text_.size() && is_word(text_[end])) {
            ++end;
        }
        return text_.substr(at_, end - at_);
    }

    /// Numbers, references, names and calls, with the sheet before them.
    std::uint32_t word_operand(std::size_t begin) {
        Reference reference;
        if (is_digit(text_[at_]) || text_[at_] == '.') {
            if (rows(reference)) {
                return add_reference(std::move(reference), begin);
            }
            return number();
        }
        if (sheet_before(reference)) {
            if (begins("#REF!")) {
                return error(begin);
            }
            if (cells(reference)) {
                return add_reference(std::move(reference), begin);
            }
            const std::string_view word = next_word();
            if (word.empty()) {
                refuse("a sheet without a cell");
            }
            at_ += word.size();
            return add({.kind = NodeKind::name, .text = std::string(text_.substr(begin, at_ - begin))}, begin);
        }
        if (cells(reference)) {
            return add_reference(std::move(reference), begin);
        }
        const std::string_view word = next_word();
        at_ += word.size();
        const char next = at_ < text_.size() ? text_[at_] : '\0';
        if (next == '(') {
            return call(std::string(word), begin);
        }
        if (next == '[') {
            return structured(begin);
        }
        const std::string folded = folded_text(word);
        if (folded == "TRUE" || folded == "FALSE") {
            return add({.kind = NodeKind::boolean, .number = folded == "TRUE" ? 1.0 : 0.0}, begin);
        }
        if (word.find('$') != std::string_view::npos || word.empty()) {
            refuse("a name that there cannot be");
        }
        return add({.kind = NodeKind::name, .text = std::string(word)}, begin);
    }

    std::uint32_t add_reference(Reference reference, std::size_t begin) {
        formula_.references.push_back(std::move(reference));
        return add(
            {.kind = NodeKind::reference, .reference = static_cast<std::uint32_t>(formula_.references.size() - 1)},
            begin);
    }

    /// `Sheet1!`, `'My sheet'!`, `[1]Sheet1!`, `'[1]My sheet'!`, `First:Last!`; nothing is taken where none stands.
    bool sheet_before(Reference& reference) {
        const std::size_t begin = at_;
        std::string name;
        if (text_[at_] == '\'') {
            name = quoted('\'');
            if (!begins("!")) {
                refuse("a quoted name without an exclamation mark");
            }
        } else {
            if (text_[at_] == '[') {
                const std::size_t end = text_.find(']', at_);
                if (end == std::string_view::npos) {
                    refuse("`]` is missing");
                }
                name = std::string(text_.substr(at_, end + 1 - at_));
                at_ = end + 1;
            }
            const std::string_view first = next_word();
            at_ += first.size();
            name += first;
            if (begins(":")) {
                ++at_;
                const std::string_view last = next_word();
                at_ += last.size();
                name += ":";
                name += last;
            }
            if (!begins("!") || first.find('$') != std::string_view::npos) {
                if (text_[begin] == '[') {
                    refuse("another workbook without a sheet");
                }
                at_ = begin;
                return false;
            }
        }
        ++at_;
        const std::size_t bracket = name.rfind(']');
        if (bracket != std::string::npos) {
            const std::size_t open = name.find('[');
            if (open == std::string::npos || open > bracket) {
                refuse("brackets that do not belong together");
            }
            // A path before the bracket belongs to the name of the file.
            reference.workbook = name.substr(0, open) + name.substr(open + 1, bracket - open - 1);
            name.erase(0, bracket + 1);
        }
        const std::size_t colon = name.find(':');
        reference.sheet = name.substr(0, colon);
        reference.last_sheet = colon == std::string::npos ? "" : name.substr(colon + 1);
        if ((reference.sheet.empty() && reference.workbook.empty()) ||
            (colon != std::string::npos && reference.last_sheet.empty())) {
            refuse("a sheet without a name");
        }
        return true;
    }

    bool mark(std::size_t& at) const {
        const bool marked = at < text_.size() && text_[at] == '$';
        at += marked ? 1U : 0U;
        return marked;
    }

    [[nodiscard]] bool ends_word(std::size_t at) const {
        return at >= text_.size() || (!is_word(text_[at]) && text_[at] != '(' && text_[at] != '!' && text_[at] != '[');
    }

    std::optional<ReferenceCorner> corner(std::size_t& at) const {
        ReferenceCorner one;
        one.column_is_absolute = mark(at);
        const std::optional<std::uint32_t> column = read_column(text_, at);
        if (!column) {
            return std::nullopt;
        }
        one.row_is_absolute = mark(at);
        const std::optional<std::uint32_t> row = read_row(text_, at);
        if (!row || !ends_word(at)) {
            return std::nullopt;
        }
        one.address = {*row, *column};
        return one;
    }

    /// `A1`, `A1:B2`, `A:B`, `1:2`.
    bool cells(Reference& reference) {
        std::size_t at = at_;
        if (const std::optional<ReferenceCorner> first = corner(at)) {
            reference.first = reference.last = *first;
            at_ = at;
            if (begins(":")) {
                std::size_t behind = at + 1;
                if (const std::optional<ReferenceCorner> last = corner(behind)) {
                    reference.last = *last;
                    reference.shape = ReferenceShape::range;
                    at_ = behind;
                }
            }
            return true;
        }
        return columns(reference) || rows(reference);
    }

    bool columns(Reference& reference) {
        std::size_t at = at_;
        ReferenceCorner first{.address = {1, 1}, .row_is_absolute = true};
        ReferenceCorner last{.address = {k_most_rows, 1}, .row_is_absolute = true};
        first.column_is_absolute = mark(at);
        const std::optional<std::uint32_t> first_column = read_column(text_, at);
        if (!first_column || at >= text_.size() || text_[at] != ':') {
            return false;
        }
        ++at;
        last.column_is_absolute = mark(at);
        const std::optional<std::uint32_t> last_column = read_column(text_, at);
        if (!last_column || !ends_word(at)) {
            return false;
        }
        first.address.column = *first_column;
        last.address.column = *last_column;
        reference.shape = ReferenceShape::columns;
        reference.first = first;
        reference.last = last;
        at_ = at;
        return true;
    }

    bool rows(Reference& reference) {
        std::size_t at = at_;
        ReferenceCorner first{.address = {1, 1}, .column_is_absolute = true};
        ReferenceCorner last{.address = {1, k_most_columns}, .column_is_absolute = true};
        first.row_is_absolute = mark(at);
        const std::optional<std::uint32_t> first_row = read_row(text_, at);
        if (!first_row || at >= text_.size() || text_[at] != ':') {
            return false;
        }
        ++at;
        last.row_is_absolute = mark(at);
        const std::optional<std::uint32_t> last_row = read_row(text_, at);
        if (!last_row || !ends_word(at)) {
            return false;
        }
        first.address.row = *first_row;
        last.address.row = *last_row;
        reference.shape = ReferenceShape::rows;
        reference.first = first;
        reference.last = last;
        at_ = at;
        return true;
    }

    std::uint32_t structured(std::size_t begin) {
        std::size_t open = 0;
        for (; at_ < text_.size(); ++at_) {
            if (text_[at_] == '\'' && at_ + 1 < text_.size()) {
                ++at_;  // a mark before a bracket that belongs to the name of a column
            } else if (text_[at_] == '[') {
                ++open;
            } else if (text_[at_] == ']' && --open == 0) {
                ++at_;
                return add({.kind = NodeKind::structured, .text = std::string(text_.substr(begin, at_ - begin))},
                           begin);
            }
        }
        refuse("`]` is missing");
    }

    std::uint32_t call(std::string name, std::size_t begin) {
        const Level level(*this);
        name = folded_text(name);
        for (const std::string_view prefix : {"_XLFN.", "_XLWS."}) {
            if (name.starts_with(prefix)) {
                name.erase(0, prefix.size());
            }
        }
        if (name.empty()) {
            refuse("a function without a name");
        }
        ++at_;
        std::vector<std::uint32_t> arguments;
        skip_spaces();
        if (at_ < text_.size() && text_[at_] == ')') {
            ++at_;
            return add({.kind = NodeKind::call, .text = std::move(name)}, begin);
        }
        for (;;) {
            skip_spaces();
            if (at_ < text_.size() && (text_[at_] == ',' || text_[at_] == ')')) {
                arguments.push_back(add({.kind = NodeKind::missing}, at_));
            } else {
                arguments.push_back(expression(0));
                skip_spaces();
            }
            if (at_ < text_.size() && text_[at_] == ',') {
                ++at_;
                continue;
            }
            expect(')');
            return add({.kind = NodeKind::call, .text = std::move(name)}, begin, arguments);
        }
    }

    std::string_view text_;
    std::string_view where_;
    std::size_t at_ = 0;
    std::size_t depth_ = 0;
    Formula formula_;
};

bool same_value(const FormulaNode& a, const FormulaNode& b) {
    if (a.kind != b.kind || a.children != b.children || a.columns != b.columns) {
        return false;
    }
    switch (a.kind) {
        case NodeKind::number:
        case NodeKind::boolean:
            return a.number == b.number;
        case NodeKind::error:
        case NodeKind::text:
        case NodeKind::call:
            return a.text == b.text;
        case NodeKind::name:
        case NodeKind::structured:
            return folded_text(a.text) == folded_text(b.text);
        default:
            return true;
    }
}

}  // namespace

CellRange area(const Reference& reference) {
    const CellAddress a = reference.first.address;
    const CellAddress b = reference.last.address;
    return {{std::min(a.row, b.row), std::min(a.column, b.column)},
            {std::max(a.row, b.row), std::max(a.column, b.column)}};
}

Formula parse_formula(std::string_view text, std::string_view where) {
    return FormulaParser(text, where).parse();
}

bool same_formula(const Formula& a, const Formula& b) {
    if (a.nodes.empty() || b.nodes.empty()) {
        return a.nodes.empty() && b.nodes.empty();
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> open{{a.root(), b.root()}};
    while (!open.empty()) {
        const auto [one, other] = open.back();
        open.pop_back();
        const FormulaNode& left = a.nodes[one];
        const FormulaNode& right = b.nodes[other];
        if (!same_value(left, right) ||
            (left.kind == NodeKind::reference && a.references[left.reference] != b.references[right.reference])) {
            return false;
        }
        for (std::uint32_t i = 0; i < left.children; ++i) {
            open.emplace_back(a.children_of(left)[i], b.children_of(right)[i]);
        }
    }
    return true;
}

}  // namespace gumcert::workbook
