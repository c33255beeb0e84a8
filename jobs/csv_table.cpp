#include "jobs/csv_table.h"
#include "text/angle_text.h"
#include "text/counts.h"
#include "text/csv_field.h"
#include "text/lists.h"
#include "text/place.h"
#include "text/plus_sign.h"
#include "text/utf8.h"
#include "text/visible_text.h"

#include <algorithm>
#include <charconv>
#include <deque>
#include <system_error>

namespace gumcert::jobs {

namespace {

/// The text of a file, and the texts of quoted fields that differ from it.
struct Storage {
    std::string text;
    std::deque<std::string> unquoted;
};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

bool all_digits(std::string_view text) {
    return !text.empty() && std::all_of(text.begin(), text.end(), is_digit);
}

/// Splits a checked text into records and fields.
class Scanner {
public:
    Scanner(std::string_view text, Storage& storage, ProblemList& problems, char separator = ',')
        : text_(text), storage_(storage), problems_(problems), separator_(separator) {
        // Its characters are no fields, but they count in the places of messages.
        if (const std::optional<text::SeparatorLine> line = text::separator_line(text)) {
            while (offset_ < line->length) {
                advance();
            }
            skip_line_end();
        }
    }

    [[nodiscard]] bool at_end() const { return offset_ >= text_.size(); }

    /// The next record; empty for a blank line.
    /// \return false when the rest cannot be read
    bool next(std::vector<CsvCell>& fields) {
        fields.clear();
        if (skip_line_end()) {
            return true;
        }
        while (true) {
            CsvCell field{{}, line_, column_};
            if (!(at('"') ? quoted_field(field) : plain_field(field))) {
                return false;
            }
            if (fields.size() == k_columns) {
                problems_.refuse(k_csv_too_many_columns,
                                 text::where_in_text(problems_.file(), {field.line, field.column}),
                                 "more than " + std::to_string(k_columns) + " fields in a row",
                                 "a row has at most " + std::to_string(k_columns) + " fields",
                                 "check that the file is the table that the job means");
                return false;
            }
            fields.push_back(field);
            if (at(separator_)) {
                advance();
                continue;
            }
            skip_line_end();
            return true;
        }
    }

private:
    static constexpr std::size_t k_columns = 10'000;  ///< a row of commas must not use up the memory

    [[nodiscard]] bool at(char c) const { return !at_end() && text_[offset_] == c; }
    [[nodiscard]] bool at_line_end() const {
        return at_end() || at('\n') || (at('\r') && text_.substr(offset_, 2) == "\r\n");
    }

    void advance() {
        if (text_[offset_] == '\n') {
            ++line_;
            column_ = 1;
        } else if (!text::is_continuation(text_[offset_])) {
            ++column_;
        }
        ++offset_;
    }

    bool skip_line_end() {
        if (at_end() || !at_line_end()) {
            return false;
        }
        if (at('\r')) {
            advance();
        }
        advance();
        return true;
    }

    bool refuse_quote(std::uint32_t line, std::uint32_t column, std::string what,
                      std::string action = "correct the quotes") {
        problems_.refuse(k_csv_quote, text::where_in_text(problems_.file(), {line, column}), std::move(what),
                         "a field with commas or quotes stands between double quotes, and a quote inside it is doubled "
                         "(RFC 4180)",
                         std::move(action));
        return false;
    }

    bool plain_field(CsvCell& field) {
        const std::size_t start = offset_;
        while (!at(separator_) && !at_line_end()) {
            if (at('"')) {
                // Signs before it: 12° 30' 05"
                const bool is_angle = text::has_angle_sign(text_.substr(start, offset_ - start));
                return refuse_quote(
                    line_, column_, "a double quote inside a field that does not begin with one",
                    is_angle ? "write the seconds of an angle with \u2033 or two apostrophes" : "correct the quotes");
            }
            advance();
        }
        field.text = text_.substr(start, offset_ - start);
        return true;
    }

    bool quoted_field(CsvCell& field) {
        advance();
        const std::size_t start = offset_;
        std::string* copy = nullptr;
        std::size_t copied = start;
        while (true) {
            if (at_end()) {
                return refuse_quote(field.line, field.column, "a double quote that is not closed");
            }
            if (!at('"')) {
                advance();
                continue;
            }
            const std::size_t end = offset_;
            advance();
            if (at('"')) {
                copy = copy == nullptr ? &storage_.unquoted.emplace_back() : copy;
                copy->append(text_.substr(copied, end + 1 - copied));
                advance();
                copied = offset_;
                continue;
            }
            if (!at(separator_) && !at_line_end()) {
                return refuse_quote(line_, column_, "text after a closing double quote");
            }
            if (copy != nullptr) {
                copy->append(text_.substr(copied, end - copied));
                field.text = *copy;
            } else {
                field.text = text_.substr(start, end - start);
            }
            return true;
        }
    }

    std::string_view text_;
    Storage& storage_;
    ProblemList& problems_;
    char separator_;
    std::size_t offset_ = 0;
    std::uint32_t line_ = 1;
    std::uint32_t column_ = 1;
};

std::string where_is(const CsvCell& cell, const ProblemList& problems) {
    return text::where_in_text(problems.file(), {cell.line, cell.column});
}

/// True when the fields that a row has too many can be explained by decimal commas: 12,345 reads as two fields.
bool looks_like_decimal_commas(const std::vector<CsvCell>& fields, std::size_t expected, std::string& example) {
    std::size_t pairs = 0;
    for (std::size_t i = 0; i + 1 < fields.size(); ++i) {
        std::string_view whole = fields[i].text;
        if (!whole.empty() && (whole.front() == '-' || whole.front() == '+')) {
            whole.remove_prefix(1);
        }
        const std::string_view fraction = fields[i + 1].text;
        if (all_digits(whole) && all_digits(fraction)) {
            if (pairs == 0) {
                example = std::string{fields[i].text} + "," + std::string{fraction};
            }
            ++pairs;
            ++i;
        }
    }
    return pairs > 0 && fields.size() - expected <= pairs;
}

/// A text of a cell for a message: as it stands where it looks like the text of a table, else its length only. A job
/// may name any file that its user may read; what is no table is not shown.
std::string shown(std::string_view text) {
    constexpr std::size_t k_longest = 40;
    const auto fits = [](char c) {
        return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') ||
               static_cast<unsigned char>(c) >= 0x80U ||
               std::string_view(" +-.,_'%()[]<>/^").find(c) != std::string_view::npos;
    };
    return text.size() <= k_longest && std::all_of(text.begin(), text.end(), fits)
               ? text::in_quotes(text)
               : "a text of " + std::to_string(text.size()) + " bytes";
}

void refuse_ragged(const std::vector<CsvCell>& fields, std::size_t expected, std::string_view what_expected,
                   ProblemList& problems) {
    const std::string what = std::to_string(fields.size()) + (fields.size() == 1 ? " field" : " fields") + " where " +
                             std::string{what_expected} + " " + std::to_string(expected);
    const CsvCell& last = fields.back();
    std::string example;
    if (fields.size() > expected && looks_like_decimal_commas(fields, expected, example)) {
        problems.refuse(k_csv_decimal_comma, where_is(last, problems),
                        what + "; " + shown(example) + " looks like a number with a decimal comma",
                        "numbers have a decimal point, and columns are separated by commas",
                        "save the file with decimal points");
        return;
    }
    problems.refuse(k_csv_ragged_row, where_is(last, problems), what, "every row has the same number of fields",
                    fields.size() > expected ? "remove what is too much, or put text with commas in double quotes"
                                             : "add the missing fields; is the file cut off?");
}

/// A number with a decimal comma and nothing else: 10,5 or -0,3e-6.
bool has_decimal_comma(std::string_view text) {
    if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
        text.remove_prefix(1);
    }
    const std::size_t comma = text.find(',');
    if (comma == std::string_view::npos || (comma > 0 && !all_digits(text.substr(0, comma)))) {
        return false;
    }
    text.remove_prefix(comma + 1);
    const std::size_t end = text.find_first_of("eE");
    if (!all_digits(text.substr(0, end)) || end == std::string_view::npos) {
        return all_digits(text);
    }
    text.remove_prefix(end + 1);
    if (!text.empty() && (text.front() == '-' || text.front() == '+')) {
        text.remove_prefix(1);
    }
    return all_digits(text);
}

/// \param decimal_comma  the table has decimal commas: none of its numbers has a point
std::optional<double> parse_number(const CsvCell& cell, std::string_view column, const NumberRange& range,
                                   ProblemList& problems, bool decimal_comma = false) {
    const std::string of_column = column.empty() ? std::string{} : " in column " + text::visible(column);
    const auto refuse = [&](const InputCode& code, const std::string& rule, const std::string& action) {
        problems.refuse(code, where_is(cell, problems), shown(cell.text) + of_column, rule, action);
        return std::nullopt;
    };
    const std::string must_be_number = "must be a number with a decimal point";
    std::string_view text = cell.text;
    std::string with_point;
    if (decimal_comma && has_decimal_comma(text)) {
        with_point = text;
        with_point[with_point.find(',')] = '.';
        text = with_point;
    } else if (decimal_comma && text.find('.') != std::string_view::npos &&
               text.find_first_not_of("0123456789,.+-eE") == std::string_view::npos) {
        return refuse(k_csv_decimal_comma, "the numbers of this table have decimal commas and no other separators",
                      "write it with a decimal comma");
    }
    if (text.empty()) {
        problems.refuse(k_csv_missing_value, where_is(cell, problems), "an empty cell" + of_column, must_be_number,
                        "state the value, or remove the row");
        return std::nullopt;
    }
    text = text::without_plus(text);
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = end == text.data() + text.size();
    std::string small(text.substr(0, 16));
    std::transform(small.begin(), small.end(), small.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; });
    if (!small.empty() && (small.front() == '-' || small.front() == '+')) {
        small.erase(0, 1);
    }
    if (small.starts_with("nan") || small == "inf" || small == "infinity" || small.starts_with("#") || small == "n/a") {
        return refuse(k_csv_not_finite, "a number must be finite", "state the value, or remove the row");
    }
    if (error == std::errc::result_out_of_range && whole) {
        return refuse(k_csv_number_range,
                      "a number must be within the range of double precision, about 1e-307 to 1e308 in magnitude",
                      "check the exponent");
    }
    if (error != std::errc{} || !whole) {
        if (text.find(',') != std::string_view::npos &&
            text.find_first_not_of("0123456789,.+-eE \xC2\xA0") == std::string_view::npos) {
            return decimal_comma
                       ? refuse(k_csv_decimal_comma,
                                "the numbers of this table have decimal commas and no other separators",
                                "write it with one comma and without separators")
                       : refuse(k_csv_decimal_comma, "numbers have a decimal point and no thousands separators",
                                "write it with a decimal point and without separators");
        }
        std::string action = "correct the value";
        if (text.front() == ' ' || text.back() == ' ' || text.front() == '\t' || text.back() == '\t') {
            action = "remove the spaces around the number";
        } else if (text.find("\xE2\x88\x92") != std::string_view::npos) {
            action = "write the minus sign as - (U+002D), not as U+2212";
        } else if (error == std::errc{}) {
            action = "write the number only, without unit or other text";
        }
        return refuse(k_csv_not_a_number, must_be_number, action);
    }
    if (!range.contains(value)) {
        problems.refuse(k_csv_out_of_range, where_is(cell, problems), range.with_unit(value) + of_column, range.rule(),
                        range.action());
        return std::nullopt;
    }
    return value;
}

/// The first line, to see which separator a person used.
bool refuse_other_separator(const std::vector<CsvCell>& header, ProblemList& problems) {
    if (header.size() > 1) {
        return false;
    }
    for (const auto& [separator, name] :
         {std::pair{';', "semicolons"}, std::pair{'\t', "tabs"}, std::pair{'|', "bars"}}) {
        if (header.front().text.find(separator) != std::string_view::npos) {
            problems.refuse(k_csv_separator, where_is(header.front(), problems),
                            "the columns are separated by " + std::string{name}, "columns are separated by commas",
                            separator == ';' ? "save the file with commas, and numbers with decimal points"
                                             : "save the file with commas");
            return true;
        }
    }
    return false;
}

}  // namespace

char csv_separator(std::string_view text) {
    if (const std::optional<text::SeparatorLine> line = text::separator_line(text)) {
        return line->separator;
    }
    bool is_quoted = false;
    bool has_semicolon = false;
    bool has_begun = false;
    for (const char c : text) {
        if ((c == '\n' || c == '\r') && !is_quoted) {
            if (has_begun) {
                break;
            }
            continue;
        }
        has_begun = true;
        is_quoted = is_quoted != (c == '"');
        if (c == ',' && !is_quoted) {
            return ',';
        }
        has_semicolon = has_semicolon || (c == ';' && !is_quoted);
    }
    return has_semicolon ? ';' : ',';
}

std::optional<CsvTable> read_csv_table(std::string bytes, std::span<const std::string_view> required,
                                       std::span<const std::string_view> optional, ProblemList& problems,
                                       const CsvLimits& limits) {
    const auto storage = std::make_shared<Storage>();
    storage->text = std::move(bytes);
    const std::optional<std::string_view> text = check_text(storage->text, problems);
    if (!text) {
        return std::nullopt;
    }
    const char separator = csv_separator(*text);
    Scanner scanner(*text, *storage, problems, separator);
    std::vector<CsvCell> fields;
    while (fields.empty() && !scanner.at_end()) {
        if (!scanner.next(fields)) {
            return std::nullopt;
        }
    }
    if (fields.empty()) {
        problems.refuse(k_empty_file, text::visible(problems.file()), "the file is empty",
                        "a table has a header and rows", "check the name of the file and its content");
        return std::nullopt;
    }
    if (refuse_other_separator(fields, problems)) {
        return std::nullopt;
    }

    CsvTable table;
    table.storage_ = storage;
    table.problems_ = &problems;
    table.width_ = fields.size();
    table.names_.assign(required.begin(), required.end());
    table.names_.insert(table.names_.end(), optional.begin(), optional.end());
    table.positions_.resize(table.names_.size());
    std::vector<CsvCell> unknown;
    bool usable = true;
    for (std::size_t i = 0; i < fields.size(); ++i) {
        const auto known = std::find(table.names_.begin(), table.names_.end(), fields[i].text);
        if (known == table.names_.end()) {
            unknown.push_back(fields[i]);
            continue;
        }
        std::optional<std::size_t>& position = table.positions_[static_cast<std::size_t>(known - table.names_.begin())];
        if (position) {
            problems.refuse(k_csv_repeated_column, where_is(fields[i], problems),
                            "the column " + text::in_quotes(fields[i].text) + " occurs twice", "a column occurs once",
                            "remove one of the two");
            usable = false;
        }
        position = i;
    }
    std::string all_required;
    for (const std::string_view name : required) {
        all_required += (all_required.empty() ? "" : ", ") + std::string{name};
    }
    for (std::size_t i = 0; i < required.size(); ++i) {
        if (table.positions_[i]) {
            continue;
        }
        std::vector<std::string_view> candidates;
        std::transform(unknown.begin(), unknown.end(), std::back_inserter(candidates),
                       [](const CsvCell& cell) { return cell.text; });
        const std::optional<std::string_view> nearest = nearest_word(required[i], candidates);
        problems.refuse(
            k_csv_missing_column, where_is(fields.front(), problems),
            "the column " + text::in_quotes(required[i]) + " is missing", "the required columns are " + all_required,
            nearest ? "is it the column " + shown(*nearest) + "?" : "add it to the header and to every row");
        usable = false;
    }
    if (!usable) {
        return std::nullopt;
    }
    for (const CsvCell& cell : unknown) {
        const std::optional<std::string_view> nearest = nearest_word(cell.text, optional);
        problems.warn(k_warn_extra_column, where_is(cell, problems),
                      "the column " + text::in_quotes(cell.text) + " is not used", "columns are known by their names",
                      nearest ? "did you mean \"" + std::string{*nearest} + "\"?" : "remove it if it is not needed");
    }
    table.unused_ = std::move(unknown);

    std::size_t row_count = 0;
    while (!scanner.at_end()) {
        if (!scanner.next(fields)) {
            return std::nullopt;
        }
        if (fields.empty()) {
            continue;
        }
        if (++row_count > limits.rows) {
            problems.refuse(k_csv_too_many_rows, where_is(fields.front(), problems),
                            "more than " + std::to_string(limits.rows) + " rows",
                            "a table may have at most " + std::to_string(limits.rows) + " rows", "split the data");
            return std::nullopt;
        }
        if (fields.size() != table.width_) {
            refuse_ragged(fields, table.width_, "the header has", problems);
            table.is_complete_ = false;
            continue;
        }
        table.cells_.insert(table.cells_.end(), fields.begin(), fields.end());
    }
    table.decimal_comma_ =
        separator != ',' && std::any_of(table.cells_.begin(), table.cells_.end(),
                                        [](const CsvCell& cell) { return has_decimal_comma(cell.text); });
    if (row_count == 0) {
        problems.refuse(k_csv_no_rows, text::visible(problems.file()), "a header and no rows",
                        "a table has at least one row", "check that the file is complete");
        return std::nullopt;
    }
    return table;
}

std::vector<std::string_view> CsvTable::missing_columns() const {
    std::vector<std::string_view> missing;
    for (std::size_t i = 0; i < names_.size(); ++i) {
        if (!positions_[i]) {
            missing.push_back(names_[i]);
        }
    }
    return missing;
}

const CsvCell& CsvTable::cell(std::size_t row, std::size_t column) const {
    return cells_[row * width_ + positions_[column].value()];
}

std::string CsvTable::where(const CsvCell& cell) const {
    return where_is(cell, *problems_);
}

std::optional<double> CsvTable::number(std::size_t row, std::size_t column, const NumberRange& range) const {
    return parse_number(cell(row, column), names_[column], range, *problems_, decimal_comma_);
}

std::string CsvTable::number_text(std::size_t row, std::size_t column) const {
    std::string text{cell(row, column).text};
    if (text.starts_with('+')) {
        text.erase(0, 1);
    }
    if (decimal_comma_ && has_decimal_comma(text)) {
        text[text.find(',')] = '.';
    }
    return text;
}

std::optional<double> CsvTable::number_if_any(std::size_t row, std::size_t column, const NumberRange& range) const {
    if (!has_column(column) || cell(row, column).text.empty()) {
        return std::nullopt;
    }
    return number(row, column, range);
}

std::optional<std::int64_t> CsvTable::integer(std::size_t row, std::size_t column, const NumberRange& range) const {
    const std::optional<double> value = number(row, column, range);
    constexpr double k_largest = 9007199254740992.0;  // 2^53: up to it every integer has a double
    if (value && (!(*value >= -k_largest && *value <= k_largest) ||
                  *value != static_cast<double>(static_cast<std::int64_t>(*value)))) {
        problems_->refuse(k_csv_not_an_integer, where(cell(row, column)),
                          text::in_quotes(cell(row, column).text) + " in column " + names_[column],
                          "must be a whole number", "write a number without fraction");
        return std::nullopt;
    }
    return value ? std::optional{static_cast<std::int64_t>(*value)} : std::nullopt;
}

std::optional<std::string_view> CsvTable::name(std::size_t row, std::size_t column) const {
    const CsvCell& field = cell(row, column);
    if (const std::optional<std::string> objection = name_objection(field.text)) {
        problems_->refuse(
            field.text.empty() ? k_csv_missing_value : k_csv_name, where(field),
            field.text.empty()
                ? "an empty cell in column " + names_[column]
                : "the name " + text::in_quotes(field.text) + " in column " + names_[column] + " " + *objection,
            "a name has 1 to 256 bytes, no spaces around it and no control or hidden characters", "correct the name");
        return std::nullopt;
    }
    return field.text;
}

std::optional<std::size_t> CsvTable::choice(std::size_t row, std::size_t column,
                                            std::span<const std::string_view> words) const {
    const CsvCell& field = cell(row, column);
    const auto found = std::find(words.begin(), words.end(), field.text);
    if (found == words.end()) {
        problems_->refuse(field.text.empty() ? k_csv_missing_value : k_csv_unknown_choice, where(field),
                          (field.text.empty() ? "an empty cell" : shown(field.text)) + " in column " + names_[column],
                          "must be " + text::any_of(words), "correct the value");
        return std::nullopt;
    }
    return static_cast<std::size_t>(found - words.begin());
}

std::optional<Eigen::MatrixXd> read_csv_matrix(const std::string& bytes, std::size_t order, std::string_view unit,
                                               ProblemList& problems) {
    const std::optional<std::string_view> text = check_text(bytes, problems);
    if (!text) {
        return std::nullopt;
    }
    const std::size_t problems_before = problems.refusals();
    Storage storage;
    // A matrix has no header: a semicolon in it separates columns, and a comma beside it is that of a number.
    const char separator = text::separator_line(*text)                 ? csv_separator(*text)
                           : text->find(';') == std::string_view::npos ? ','
                                                                       : ';';
    const bool decimal_comma = separator != ',' && text->find(',') != std::string_view::npos;
    Scanner scanner(*text, storage, problems, separator);
    std::vector<CsvCell> fields;
    const auto size = static_cast<Eigen::Index>(order);
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
    std::size_t rows = 0;
    NumberRange range;
    range.unit = unit;
    while (!scanner.at_end()) {
        if (!scanner.next(fields)) {
            return std::nullopt;
        }
        if (fields.empty()) {
            continue;
        }
        if (rows == 0 && order > 1 && refuse_other_separator(fields, problems)) {
            return std::nullopt;
        }
        if (++rows > order) {
            continue;
        }
        if (fields.size() != order) {
            refuse_ragged(fields, order, "the matrix has", problems);
            continue;
        }
        for (std::size_t i = 0; i < order; ++i) {
            if (const auto value = parse_number(fields[i], "", range, problems, decimal_comma)) {
                matrix(static_cast<Eigen::Index>(rows - 1), static_cast<Eigen::Index>(i)) = *value;
            }
        }
    }
    if (rows != order) {
        problems.refuse(k_csv_matrix_size, text::visible(problems.file()), text::count_of(rows, "row"),
                        "the matrix has " + std::to_string(order) + " rows and columns, and no header",
                        "check that the file is complete and belongs to this job");
    }
    if (problems.refusals() != problems_before) {
        return std::nullopt;
    }
    return matrix;
}

}  // namespace gumcert::jobs
