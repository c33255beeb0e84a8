#include "workbook/read_csv.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>

#include "gum/quantity/diagnostic.h"
#include "text/csv_field.h"
#include "text/utf8.h"
#include "text/visible_text.h"
#include "workbook/letters.h"
#include "workbook/limits.h"
#include "workbook/workbook_parts.h"

namespace gumcert::workbook {

namespace {

constexpr std::array<char, 3> k_separators{'\t', ';', ','};

bool ends_line(char c) {
    return c == '\n' || c == '\r';
}

/// Whether the comma at a place may be one of a number or of a sentence: "0,5", "Mass, drift".
bool may_be_in_field(std::string_view text, std::size_t comma) {
    const bool is_behind_digit = comma > 0 && is_digit(text[comma - 1]);
    const char next = comma + 1 < text.size() ? text[comma + 1] : '\n';
    return next == ' ' || (is_behind_digit && is_digit(next));
}

/// The separator that stands in most lines. A comma that may be in a field is none in a line that has another separator, so that lines
/// of words below a table, "U = 0,5 mm", do not outvote its rows.
char most_common_separator(std::string_view text) {
    std::array<std::size_t, 3> lines{};
    std::array<bool, 3> in_line{};
    bool has_comma_in_field = false, is_quoted = false;
    const auto count = [&] {
        in_line[2] = in_line[2] || (has_comma_in_field && !in_line[0] && !in_line[1]);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            lines[i] += in_line[i] ? 1U : 0U;
            in_line[i] = false;
        }
        has_comma_in_field = false;
    };
    for (std::size_t at = 0; at < text.size(); ++at) {
        const char c = text[at];
        if (c == '"') {
            is_quoted = !is_quoted;
        } else if (!is_quoted && ends_line(c)) {
            count();
        } else if (!is_quoted && c == ',' && may_be_in_field(text, at)) {
            has_comma_in_field = true;
        } else if (!is_quoted) {
            for (std::size_t i = 0; i < lines.size(); ++i) {
                in_line[i] = in_line[i] || c == k_separators[i];
            }
        }
    }
    count();
    const auto* const best = std::max_element(lines.begin(), lines.end());  // the first of equals
    return *best == 0 ? ',' : k_separators[static_cast<std::size_t>(best - lines.begin())];
}

std::string_view without_blanks(std::string_view text) {
    while (!text.empty() && is_space(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && is_space(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

std::optional<double> printed_number(std::string_view digits, char mark) {
    std::string plain(digits.starts_with('+') ? digits.substr(1) : digits);
    if (digits.starts_with("+-") || plain.empty() ||
        (!is_digit(plain.front()) && plain.front() != '-' && plain.front() != mark)) {
        return std::nullopt;
    }
    if (mark != '.') {
        if (plain.find('.') != std::string::npos) {
            return std::nullopt;
        }
        std::replace(plain.begin(), plain.end(), mark, '.');
    }
    double number = 0.0;
    const auto [end, failure] = std::from_chars(plain.data(), plain.data() + plain.size(), number);
    if (failure != std::errc() || end != plain.data() + plain.size() || !std::isfinite(number)) {
        return std::nullopt;
    }
    return number;
}

class CsvReader {
public:
    CsvReader(std::string_view text, std::string file, Sheet& sheet)
        : text_(text), file_(std::move(file)), sheet_(sheet) {
        const std::optional<text::SeparatorLine> line = text::separator_line(text);
        separator_ = line ? line->separator : most_common_separator(text);
        if (line) {
            at_ =
                line->length;  // its characters are no cells; the rows below it have the numbers that a spreadsheet shows
        }
    }

    void read() {
        while (at_ < text_.size()) {
            field();
            if (at_ >= text_.size()) {
                break;
            }
            if (text_[at_] == separator_) {
                ++at_;
                ++address_.column;
                continue;
            }
            at_ += text_.substr(at_).starts_with("\r\n") ? 2U : 1U;
            address_ = {address_.row + 1, 1};
        }
        make_numbers();
    }

    [[nodiscard]] char separator() const { return separator_; }

private:
    [[noreturn]] void refuse_quote(const std::string& what) const {
        throw gum::InputError(
            gum::Diagnostic{.code = "GC-WORKBOOK-0017",
                            .where = file_ + " " + a1_text(address_),
                            .what = what,
                            .rule = "a field that begins with a quote ends with one (RFC 4180, 2.5 to 2.7)",
                            .action = "close the quote, and write a quote inside of it twice"});
    }

    void field() {
        std::string value;
        if (text_[at_] == '"') {
            for (++at_;; ++at_) {
                if (at_ >= text_.size()) {
                    refuse_quote("a quote that is not closed");
                }
                if (text_[at_] == '"') {
                    ++at_;
                    if (at_ >= text_.size() || text_[at_] != '"') {
                        break;
                    }
                }
                value += text_[at_];
            }
            if (at_ < text_.size() && text_[at_] != separator_ && !ends_line(text_[at_])) {
                refuse_quote("something behind the quote that closes a field");
            }
        } else {
            std::size_t end = at_;
            while (end < text_.size() && text_[end] != separator_ && !ends_line(text_[end])) {
                ++end;
            }
            value = std::string(text_.substr(at_, end - at_));
            at_ = end;
        }
        if (without_blanks(value).empty()) {
            return;
        }
        if (sheet_.cells.size() >= k_most_cells || address_.row > k_most_rows || address_.column > k_most_columns) {
            throw too_many(file_, "more cells than a sheet holds");
        }
        Cell& cell = sheet_.cells.emplace_back();
        cell.address = address_;
        cell.value = {.kind = CellKind::text, .text = std::move(value)};
    }

    void make_numbers() {
        const bool has_comma =
            separator_ == ';' && std::any_of(sheet_.cells.begin(), sheet_.cells.end(), [](const Cell& cell) {
                return cell.value.text.find(',') != std::string::npos &&
                       printed_number(without_blanks(cell.value.text), ',');
            });
        for (Cell& cell : sheet_.cells) {
            const std::string_view digits = without_blanks(cell.value.text);
            if (const std::optional<double> number = printed_number(digits, has_comma ? ',' : '.')) {
                cell.value = {.kind = CellKind::number, .number = *number, .text = std::string(digits)};
            }
        }
    }

    std::string_view text_;
    std::string file_;
    Sheet& sheet_;
    char separator_ = ',';
    std::size_t at_ = 0;
    CellAddress address_;
};

}  // namespace

Workbook read_csv(std::string_view text, const std::string& file, const std::string& sheet) {
    const std::string where = text::visible(file);
    if (text.size() > k_largest_file) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0001",
                                              .where = where,
                                              .what = std::to_string(text.size()) + " bytes",
                                              .rule = "workbooks are read up to 20 MB",
                                              .action = "store what is to be looked at as a workbook of its own"});
    }
    if (text.starts_with("\xEF\xBB\xBF")) {
        text.remove_prefix(3);
    }
    if (!text::is_utf8(text) || text.find('\0') != std::string_view::npos) {
        throw gum::InputError(gum::Diagnostic{.code = "GC-WORKBOOK-0016",
                                              .where = where,
                                              .what = "bytes that are no text in UTF-8",
                                              .rule = "CSV files are in UTF-8",
                                              .action = "store it as “CSV UTF-8” with the spreadsheet program"});
    }
    Workbook workbook;
    workbook.sheets.emplace_back().name = sheet;
    CsvReader reader(text, where, workbook.sheets.front());
    reader.read();
    workbook.csv_separator = reader.separator();
    return workbook;
}

}  // namespace gumcert::workbook
