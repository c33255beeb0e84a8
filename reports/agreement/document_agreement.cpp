#include "reports/agreement/document_agreement.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "certificate/point_tables.h"
#include "json/members.h"
#include "reports/forms/html_texts.h"
#include "reports/forms/pdf_page_texts.h"
#include "text/small_letters.h"
#include "text/utf8.h"
#include "text/visible_text.h"

namespace gumcert::reports {

namespace {

constexpr std::string_view k_of_index = "_";  // "R_0" is set with an index
constexpr std::size_t k_gap_of_power = 5;     // "10" and an exponent
constexpr std::string_view k_degrees = "\u00B0", k_minutes = "\u2032", k_seconds = "\u2033";

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// Letters of units that look alike and have two codes: U+03BC and U+00B5, U+2126 and U+03A9, U+212B and U+00C5.
std::string one_sign(std::string text) {
    for (const auto& [sign, in_place] : {std::pair<std::string_view, std::string_view>{"\u03BC", "\u00B5"},
                                         {"\u2126", "\u03A9"},
                                         {"\u212B", "\u00C5"}}) {
        for (std::size_t at = text.size() < sign.size() ? std::string::npos : text.find(sign); at != std::string::npos;
             at = text.find(sign, at)) {
            text.replace(at, sign.size(), in_place);
        }
    }
    return text;
}

char32_t character_before(std::string_view text, std::size_t end) {
    std::size_t begin = end;
    do {
        if (begin == 0) {
            return 0;
        }
        --begin;
    } while (text::is_continuation(text[begin]));
    return text::decode_utf8(text, begin).code;
}

/// Letters, and what joins them to units: the dots of products, raised digits and signs.
bool belongs_to_a_unit(char32_t c) {
    const bool is_letter = (c >= U'a' && c <= U'z') || (c >= U'A' && c <= U'Z') || c == 0xB5 || c == 0xC5 ||
                           (c >= 0x370 && c < 0x400) || c == 0xB0;
    const bool is_raised = c == 0xB9 || c == 0xB2 || c == 0xB3 || (c >= 0x2070 && c < 0x2080);
    return is_letter || is_raised || c == 0xB7 || c == 0x22C5;
}

std::string all_digits(std::string_view text) {
    std::string digits;
    std::copy_if(text.begin(), text.end(), std::back_inserter(digits), is_digit);
    return digits;
}

bool belongs_to_a_number(char c) {
    return is_digit(c) || (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '/' || c == '-' || c == '_';
}

bool has_word(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        const std::size_t end = at + word.size();
        if ((at == 0 || !belongs_to_a_number(text[at - 1])) &&
            (end == text.size() || !belongs_to_a_number(text[end]))) {
            return true;
        }
    }
    return false;
}

/// Whether 05″ or 05.0″ stands behind an angle, which then does not end with its minutes.
bool begins_with_seconds(std::string_view text) {
    constexpr std::size_t k_digits = 2;
    const std::size_t end = std::min(text.find_first_not_of("0123456789.,"), text.size());
    return !text.empty() && text.front() < '6' &&
           std::min(text.find_first_not_of("0123456789"), text.size()) == k_digits &&
           text.substr(end).starts_with(k_seconds);
}

/// "0E+1" of a record, beside U = 4.8E+2: printed as "0", and by earlier versions as "0 × 10¹".
bool is_zero_with_power(const NumberAsPrinted& number) {
    return number.exponent != 0 && number.digits.find_first_not_of('0') == std::string::npos;
}

std::size_t verdicts_of_a_row(const certificate::TableLayout& layout) {
    return static_cast<std::size_t>(
        std::count_if(layout.shown.begin(), layout.shown.end(), [](const auto& c) { return c.show == "verdict"; }));
}

}  // namespace

/// What one cell of a table prints.
struct PrintedDocument::Cell {
    std::string digits;                     ///< all of a text, those of the mantissa of a number
    std::optional<NumberAsPrinted> number;  ///< none: a text, of which the digits are compared
    std::string unit = {};                  ///< that stands in the head of its column, or behind the row
    std::string angle = {};                 ///< of a number in degrees, minutes and seconds: its text, without sign
    bool is_negative = false;               ///< that number
};

/// Numbers that stand behind each other.
struct PrintedDocument::Row {
    std::vector<Cell> numbers;
    std::size_t largest_gap = 0;           ///< digits of other numbers between two of them
    std::string shown = {};                ///< for messages
    std::string verdict = {};              ///< code; "" where none follows
    std::size_t verdicts = 1;              ///< of so many that follow, one is this
    std::vector<Cell> otherwise = {};      ///< in place of `numbers` in another layout
    bool shows_units = false;              ///< the first row of a table, right below its head
    std::size_t rows_above = 0;            ///< of other results, where each of them is a row of one table
    std::vector<std::size_t> gaps = {};    ///< before each of `numbers`, in place of largest_gap
    std::vector<std::size_t> blocks = {};  ///< where the cells of each result begin: a table may be divided there
};

PrintedDocument::PrintedDocument(const std::vector<std::string>& pages) {
    for (const std::string& page : pages) {
        pages_.push_back(without_blanks(page));
        for (std::size_t at = 0; at < page.size();) {
            std::size_t bytes = 1;
            while (at + bytes < page.size() && text::is_continuation(page[at + bytes])) {
                ++bytes;
            }
            const std::string character = one_sign(page.substr(at, bytes));
            if (is_digit(page[at])) {
                digits_ += page[at];
                places_.push_back(text_.size());
            }
            if (character != k_of_index && !without_blanks(character).empty()) {
                text_ += character;
                for (std::size_t i = 0; i < character.size(); ++i) {
                    read_places_.push_back(read_.size() + i);
                }
            }
            read_ += character;
            at += bytes;
        }
        digits_ += ' ';
        places_.push_back(text_.size());
        text_ += '\n';
        read_places_.push_back(read_.size());
        read_ += '\n';
    }
}

PrintedDocument::Cell PrintedDocument::cell_of(const std::string& printed, const std::string& unit) {
    if (printed.find(k_degrees) != std::string::npos && printed.find(k_minutes) != std::string::npos) {
        return {.digits = all_digits(printed),
                .number = std::nullopt,
                .unit = unit,
                .angle = without_blanks(printed),
                .is_negative = printed.starts_with('-')};
    }
    std::optional<NumberAsPrinted> number = only_number_as_printed(printed);
    std::string digits = number ? number->digits : all_digits(printed);
    if (number && is_zero_with_power(*number)) {
        digits = "0";  // what both ways to print it begin with
    }
    return {.digits = std::move(digits), .number = std::move(number), .unit = unit};
}

/// The cells of some row that stand before and behind each other, with how far they may be apart.
PrintedDocument::Row PrintedDocument::row_of(const std::string& name, const std::vector<std::string>& printed,
                                             std::size_t gap, const std::string& unit) {
    Row row{.numbers = {}, .largest_gap = gap};
    for (const std::string& text : printed) {
        if (Cell cell = cell_of(text, row.numbers.empty() ? unit : ""); !cell.digits.empty()) {
            const bool has_power = cell.number && cell.number->exponent != 0;
            row.largest_gap = std::max(row.largest_gap, has_power ? k_gap_of_power : 0U);
            row.numbers.push_back(std::move(cell));
            row.shown += (row.shown.empty() ? "" : ", ") + text;
        }
    }
    row.shown = name + " = " + row.shown + (unit.empty() ? "" : " " + unit);
    return row;
}

std::vector<PrintedDocument::Row> PrintedDocument::rows_of(const CertifiedTable& table) {
    constexpr std::size_t k_gap_of_interval = 8;  // u beside it
    constexpr std::size_t k_gap_in_rows = 24;     // of limits, k and degrees of freedom
    constexpr std::size_t k_gap_in_layouts = 60;  // where only some cells of a row are known to be there
    std::vector<Row> rows;
    const auto put = [&](Row row) {
        if (!row.numbers.empty()) {
            rows.push_back(std::move(row));
        }
    };
    const auto argument_at = [&](std::size_t i) {
        return table.argument && i < table.argument->printed.size() ? table.argument->printed[i] : std::string();
    };
    const auto has_number = [&](std::size_t i) {  // names of points may have digits here and there
        return table.argument && i < table.argument->values.size() && table.argument->values[i].has_value();
    };
    const auto is_interval = [](const CertifiedValue& v) { return v.interval && !v.printed_low.empty(); };
    const auto as_value = [&](const CertifiedColumn& of, const std::string& printed) {
        return certificate::value_as_shown(table, of, printed);
    };
    const CertifiedColumn* before = nullptr;
    for (const CertifiedColumn& column : table.columns) {
        const auto shows = [&](const char* what) {
            return !table.layout || std::any_of(table.layout->shown.begin(), table.layout->shown.end(),
                                                [&](const auto& c) { return c.of == column.result && c.show == what; });
        };
        const bool verdict_in_row = table.layout && shows("verdict");
        for (std::size_t i = 0; i < column.values.size(); ++i) {
            const CertifiedValue& v = column.values[i];
            const std::string name = column.result + (argument_at(i).empty() ? "" : " at " + argument_at(i));
            if (is_interval(v)) {
                const bool with_U = shows("U") || shows("k") || shows("nu_eff");
                Row row = row_of(
                    name,
                    {shows("value") ? as_value(column, v.printed_value) : "",
                     with_U ? as_value(column, v.printed_low) : "", with_U ? as_value(column, v.printed_high) : ""},
                    table.layout ? k_gap_in_layouts : k_gap_of_interval, table.layout ? "" : column.printed_unit);
                row.shows_units = i == 0;
                row.rows_above = static_cast<std::size_t>(&column - table.columns.data());
                put(std::move(row));
            } else if (!table.layout) {
                Row row = row_of(name, {v.printed_value, v.printed_U}, 0, column.printed_unit);
                row.shows_units = i == 0;
                row.rows_above = static_cast<std::size_t>(&column - table.columns.data());
                if (has_number(i) && !row.numbers.empty()) {
                    // Behind the argument, or behind the quantity before it where both stand in one table.
                    const Cell point = cell_of(argument_at(i), "");
                    std::vector<Cell> own = row.numbers;
                    if (!point.digits.empty()) {
                        row.numbers.insert(row.numbers.begin(), point);
                    }
                    if (before != nullptr && i < before->values.size()) {
                        row.otherwise = row_of(name, {before->values[i].printed_value, before->values[i].printed_U}, 0,
                                               before->printed_unit)
                                            .numbers;
                        row.otherwise.insert(row.otherwise.end(), own.begin(), own.end());
                        row.largest_gap = std::max(row.largest_gap, k_gap_of_interval);
                    }
                }
                put(std::move(row));
            }
            if (v.verdict) {
                const bool value = !verdict_in_row || shows("value");
                const bool U = !verdict_in_row || (shows("U") && !is_interval(v));
                Row row = row_of(name, {value ? as_value(column, v.printed_value) : "", U ? v.printed_U : ""},
                                 verdict_in_row ? k_gap_in_layouts : 0U, "");
                row.verdict = v.verdict->verdict;
                row.shown += ", " + row.verdict;
                row.verdicts = verdict_in_row ? verdicts_of_a_row(*table.layout) : 1;
                put(std::move(row));
            }
        }
        before = &column;
    }
    const std::size_t count = table.layout && !table.columns.empty() ? table.columns.front().values.size() : 0;
    for (std::size_t i = 0; i < count; ++i) {
        std::set<bool> outside;  // values outside of the accreditation may stand in a table of their own
        Row whole{.numbers = {}, .largest_gap = k_gap_in_rows, .shows_units = i == 0};
        bool is_next = false;  // nothing else is printed between this cell and the one before
        std::string block;     // the result whose cells were last
        const auto add_cell = [&](const std::string& printed, const std::string& unit, bool number) {
            if (Cell cell = number ? cell_of(printed, unit) : Cell{all_digits(printed), std::nullopt, unit};
                !cell.digits.empty()) {
                whole.gaps.push_back(is_next ? 0U : k_gap_in_rows);
                whole.shown += (whole.shown.empty() ? "" : ", ") + printed + (unit.empty() ? "" : " " + unit);
                whole.numbers.push_back(std::move(cell));
            }
            is_next = printed.find_first_of("eE") == std::string::npos;  // no power of ten behind it
        };
        for (const certificate::ShownColumn& shown : table.layout->shown) {
            const bool of_points = shown.show == "point" || shown.show == "column";
            if (of_points ? !block.empty() : shown.of != block) {
                whole.blocks.push_back(whole.numbers.size());
            }
            block = of_points ? "" : shown.of;
            const auto result = std::find_if(table.columns.begin(), table.columns.end(),
                                             [&](const CertifiedColumn& c) { return c.result == shown.of; });
            const auto point = std::find_if(table.layout->columns.begin(), table.layout->columns.end(),
                                            [&](const certificate::PointColumn& c) { return c.name == shown.of; });
            if (shown.show == "point") {
                add_cell(argument_at(i), "", false);
            } else if (shown.show == "column" && point != table.layout->columns.end() && i < point->printed.size()) {
                const bool number = i < point->values.size() && point->values[i].has_value();
                add_cell(certificate::shown_cell(*point, i), number ? certificate::shown_unit(*point) : "", number);
            } else if ((shown.show == "value" || shown.show == "U") && result != table.columns.end() &&
                       i < result->values.size()) {
                const CertifiedValue& v = result->values[i];
                outside.insert(v.scope_entry.empty());
                if (shown.show == "value") {
                    add_cell(as_value(*result, v.printed_value), certificate::unit_of_values(table, *result), true);
                } else if (!is_interval(v)) {
                    add_cell(v.printed_U, result->printed_unit, true);
                }
                is_next = is_next && shown.show == "value";  // k, and what else U needs, stand behind it
            } else {
                is_next = false;
            }
        }
        if (outside.size() < 2) {
            put(std::move(whole));
        }
        for (const CertifiedColumn& column : table.columns) {
            if (outside.size() > 1 && i < column.values.size() && !is_interval(column.values[i])) {
                const auto shows = [&](const char* what) {
                    return std::any_of(table.layout->shown.begin(), table.layout->shown.end(),
                                       [&](const auto& c) { return c.of == column.result && c.show == what; });
                };
                Row row = row_of(column.result + " at " + argument_at(i),
                                 {shows("value") ? as_value(column, column.values[i].printed_value) : "",
                                  shows("U") ? column.values[i].printed_U : ""},
                                 k_gap_in_layouts, column.printed_unit);
                row.shows_units = i == 0;
                put(std::move(row));
            }
        }
    }
    return rows;
}

bool PrintedDocument::is_followed_by(std::size_t digit, const Row& row, const DocumentWords& words) const {
    constexpr std::size_t k_reach = 400;  // bytes: the other columns of the row, and U of a second language
    const std::size_t start = places_[digit - 1] + 1;
    const std::string_view reach = std::string_view(text_).substr(start, k_reach);
    std::size_t found = 0;
    for (std::size_t at = 0; at < reach.size() && found < row.verdicts;) {
        const auto word = std::find_if(words.verdicts.begin(), words.verdicts.end(),
                                       [&](const auto& one) { return reach.substr(at).starts_with(one.first); });
        if (word != words.verdicts.end()) {
            if (word->second == row.verdict) {
                return true;
            }
            ++found;
        }
        at += word != words.verdicts.end() ? word->first.size() : 1;
    }
    return false;
}

bool PrintedDocument::is_at(std::size_t digit, const Cell& cell) const {
    if (digits_.compare(digit, cell.digits.size(), cell.digits) != 0) {
        return false;
    }
    if (!cell.angle.empty()) {
        const std::string_view text = text_;
        const std::string_view here = text.substr(places_[digit], cell.angle.size());
        return begins_a_number(read_, read_place_of_digit(digit), cell.is_negative) &&
               here.size() == cell.angle.size() &&
               !(here.ends_with(k_minutes) && begins_with_seconds(text.substr(places_[digit] + here.size()))) &&
               std::equal(here.begin(), here.end(), cell.angle.begin(),
                          [](char a, char b) { return a == b || (a == ',' && b == '.'); });
    }
    if (!cell.number) {
        return true;
    }
    const std::size_t begin = read_place_of_digit(digit);
    return is_printed_at(read_, begin, *cell.number) ||
           (is_zero_with_power(*cell.number) && is_printed_at(read_, begin, {.digits = "0"}));
}

bool PrintedDocument::has(const Row& row, const std::vector<Cell>& numbers, const DocumentWords& words,
                          std::size_t& from) const {
    const std::string& start = numbers.front().digits;
    for (const std::size_t begin : {from, std::size_t{0}}) {
        for (std::size_t first = digits_.find(start, begin); first != std::string::npos;
             first = digits_.find(start, first + 1)) {
            if (!is_at(first, numbers.front())) {
                continue;
            }
            std::set<std::size_t> ends{first + start.size()};
            for (std::size_t i = 1; i < numbers.size() && !ends.empty(); ++i) {
                std::set<std::size_t> next;
                for (const std::size_t end : ends) {
                    const std::size_t largest =
                        &numbers == &row.numbers && i < row.gaps.size() ? row.gaps[i] : row.largest_gap;
                    for (std::size_t gap = 0; gap <= largest && end + gap < digits_.size(); ++gap) {
                        if (is_at(end + gap, numbers[i])) {
                            next.insert(end + gap + numbers[i].digits.size());
                        }
                    }
                }
                ends = std::move(next);
            }
            if (std::any_of(ends.begin(), ends.end(), [&](std::size_t end) {
                    return (row.verdict.empty() || is_followed_by(end, row, words)) &&
                           (!row.shows_units || has_units(first, end, numbers, row.gaps.empty(), row.rows_above));
                })) {
                from = first;
                return true;
            }
        }
    }
    return false;
}

/// Whether the units of a row stand in the head above it, in the order of its cells, or the one unit of a row behind it.
bool PrintedDocument::has_units(std::size_t first, std::size_t end, const std::vector<Cell>& numbers,
                                bool may_stand_behind, std::size_t rows_above) const {
    constexpr std::size_t k_reach_behind = 60;     // bytes: marks between U and the unit
    constexpr std::size_t k_reach_before = 3000;   // bytes of a head of twenty columns in two languages
    constexpr std::size_t k_numbers_in_heads = 6;  // "Table 3", "Range 10 V"; more of them are those of another table
    constexpr std::size_t k_bytes_of_a_row = 600;  // its name in two languages
    constexpr std::size_t k_numbers_of_a_row = 8;
    std::vector<std::string> units;
    for (const Cell& cell : numbers) {
        if (!cell.unit.empty()) {
            units.push_back(one_sign(without_blanks(cell.unit)));
        }
    }
    if (units.empty()) {
        return true;
    }
    const std::size_t last = read_place_of_digit(end - 1) + 1;
    for (std::size_t at = last; may_stand_behind && at < std::min(last + k_reach_behind, read_.size()); ++at) {
        if (has_unit_at(units.back(), at)) {
            return true;
        }
    }
    std::size_t wanted = units.size();
    std::size_t other_numbers = 0;
    const std::size_t begin = read_place_of_digit(first);
    for (std::size_t at = begin; at > 0 && begin - at < k_reach_before + rows_above * k_bytes_of_a_row;) {
        --at;
        const bool ends_a_number = is_digit(read_[at]) && !is_digit(read_[at + 1]) && read_[at + 1] != '.' &&
                                   read_[at + 1] != ',' && read_[at + 1] != k_end_of_drawn_text;
        other_numbers += ends_a_number ? 1U : 0U;
        if (other_numbers > k_numbers_in_heads + numbers.size() + rows_above * k_numbers_of_a_row) {
            return false;
        }
        if (has_unit_at(units[wanted - 1], at) && --wanted == 0) {
            return true;
        }
    }
    return false;
}

/// Whether a unit begins here and is no part of another one: "m" in "mm" or "m/s".
bool PrintedDocument::has_unit_at(const std::string& unit, std::size_t begin) const {
    if (!std::string_view(read_).substr(begin).starts_with(unit.substr(0, 1))) {
        return false;
    }
    std::size_t at = begin;
    for (std::size_t i = 0; i < unit.size(); ++at) {
        if (at < read_.size() && read_[at] == unit[i]) {
            ++i;
        } else if (at >= read_.size() || i == 0 ||
                   (read_[at] != ' ' && read_[at] != '\n' && read_[at] != k_end_of_drawn_text)) {
            return false;
        }
    }
    const std::size_t before = begin == 0 ? 0 : begin - 1;
    const bool joined = begin > 0 && (belongs_to_a_unit(character_before(read_, begin)) ||
                                      (read_[before] == '/' && belongs_to_a_unit(character_before(read_, before))));
    return !joined && !(at < read_.size() && (belongs_to_a_unit(text::decode_utf8(read_, at).code) ||
                                              is_digit(read_[at]) || read_[at] == '/'));
}

std::size_t PrintedDocument::read_place_of_digit(std::size_t digit) const {
    return read_places_[places_[digit]];
}

/// Whether a row stands in a table that was divided by its results: the cells that all results share, or the first of them,
/// and right behind them those of some results, in each table.
bool PrintedDocument::has_in_parts(const Row& row, const DocumentWords& words) const {
    if (row.blocks.empty() || row.blocks.front() == 0) {
        return false;
    }
    const auto has_part = [&](std::size_t shared, std::size_t begin, std::size_t end) {
        Row part{.numbers = {}, .largest_gap = row.largest_gap, .shows_units = row.shows_units};
        const auto take = [&](std::size_t i, std::size_t gap) {
            part.numbers.push_back(row.numbers[i]);
            part.gaps.push_back(gap);
        };
        for (std::size_t i = 0; i < shared; ++i) {
            take(i, row.gaps[i]);
        }
        for (std::size_t i = begin; i < end; ++i) {
            take(i, i == begin ? k_gap_of_power : row.gaps[i]);
        }
        std::size_t from = 0;
        return has(part, part.numbers, words, from);
    };
    // The last cells before the first result may be its own, such as its indication.
    for (std::size_t first = row.blocks.front(); first > 0; --first) {
        std::vector<std::size_t> ends(row.blocks.begin() + 1, row.blocks.end());
        ends.push_back(row.numbers.size());
        std::size_t begin = first;
        while (begin < row.numbers.size()) {
            const auto fits = [&](std::size_t end) {
                return end > begin && (has_part(first, begin, end) || has_part(1, begin, end));
            };
            const auto end = std::find_if(ends.rbegin(), ends.rend(), fits);
            if (end == ends.rend()) {
                break;
            }
            begin = *end;
        }
        if (begin == row.numbers.size()) {
            return true;
        }
    }
    return false;
}

std::string PrintedDocument::disagreement_with(const certificate::Certificate& certificate,
                                               const DocumentWords& words) const {
    if (std::string mark = mark_on(words); !mark.empty()) {
        return mark;
    }
    std::size_t from = 0;
    for (const CertifiedTable& table : certificate.tables) {
        for (const Row& row : rows_of(table)) {
            const bool is_printed = has(row, row.numbers, words, from) ||
                                    (!row.otherwise.empty() && has(row, row.otherwise, words, from)) ||
                                    has_in_parts(row, words);
            if (!is_printed) {
                return "does not print \"" + row.shown + "\" of the record";
            }
        }
    }
    return {};
}

const DocumentWords::Mark* PrintedDocument::mark_of(const std::vector<DocumentWords::Mark>& marks) const {
    constexpr std::size_t k_longest_value = 200;  // bytes of a number
    for (const DocumentWords::Mark& mark : marks) {
        const std::string& first = mark.before.empty() ? mark.behind : mark.before;
        for (std::size_t at = first.empty() ? std::string::npos : text_.find(first); at != std::string::npos;
             at = text_.find(first, at + 1)) {
            const std::string_view rest = std::string_view(text_).substr(at + first.size(), k_longest_value);
            if (&first == &mark.behind || rest.find(mark.behind) != std::string_view::npos) {
                return &mark;
            }
        }
    }
    return nullptr;
}

std::string PrintedDocument::mark_on(const DocumentWords& words) const {
    const DocumentWords::Mark* const mark = mark_of(words.marks);
    if (mark == nullptr) {
        return "";
    }
    std::string text = mark->text;  // "SUPERSEDED by {number}": the place of a number
    for (std::size_t begin = text.find('{'); begin != std::string::npos; begin = text.find('{')) {
        text.replace(begin, std::min(text.find('}', begin), text.size() - 1) + 1 - begin, "\u2026");
    }
    return "is marked \"" + text + "\", and is no certificate as it is issued";
}

bool PrintedDocument::names_other_templates(const DocumentWords& words) const {
    return mark_of(words.other_templates) != nullptr;
}

bool PrintedDocument::has_head_of_archive(const DocumentWords& words) const {
    return mark_of(words.head_of_archive) != nullptr;
}

bool PrintedDocument::says(const std::string& text) const {
    const auto is_word = [](char c) {
        return is_digit(c) || (text::small_letter(c) >= 'a' && text::small_letter(c) <= 'z');
    };
    const auto joins = [](char c) { return c == '-' || c == '/' || c == '_'; };
    std::string wanted = one_sign(without_blanks(text));
    std::erase(wanted, k_of_index.front());
    for (std::size_t at = wanted.empty() ? std::string::npos : text_.find(wanted); at != std::string::npos;
         at = text_.find(wanted, at + 1)) {
        const std::size_t begin = read_places_[at];
        const std::size_t end = read_places_[at + wanted.size() - 1] + 1;
        const auto character = [&](std::size_t place) { return place < read_.size() ? read_[place] : ' '; };
        const bool goes_on_before =
            is_word(read_[begin]) &&
            (is_word(character(begin - 1)) || (joins(character(begin - 1)) && is_word(character(begin - 2))));
        const bool goes_on_behind = is_word(read_[end - 1]) &&
                                    (is_word(character(end)) || (joins(character(end)) && is_word(character(end + 1))));
        if (!goes_on_before && !goes_on_behind) {
            return true;
        }
    }
    return false;
}

std::string PrintedDocument::disagreement_with_facts(const std::vector<DocumentFact>& facts,
                                                     const PrintedDocument& made_now) const {
    for (const DocumentFact& fact : facts) {
        const auto is_said_by = [&](const PrintedDocument& document) {
            return std::any_of(fact.spellings.begin(), fact.spellings.end(),
                               [&](const std::string& spelling) { return document.says(spelling); });
        };
        if (is_said_by(made_now) && !is_said_by(*this)) {
            return "does not print the " + fact.what + ' ' + text::in_quotes(fact.spellings.front()) + " of the record";
        }
    }
    return {};
}

std::string PrintedDocument::disagreement_with_pages(const DocumentWords& words) const {
    const auto says_where_it_is = [&](const std::string& page, std::size_t number) {
        return std::any_of(words.pages.begin(), words.pages.end(), [&](const auto& around) {
            const std::string wanted = around[0] + std::to_string(number) + around[1] + std::to_string(pages_.size());
            for (std::size_t at = page.find(wanted); at != std::string::npos; at = page.find(wanted, at + 1)) {
                const std::size_t end = at + wanted.size();
                if ((end == page.size() || !is_digit(page[end])) &&
                    page.compare(end, around[2].size(), around[2]) == 0) {
                    return true;
                }
            }
            return false;
        });
    };
    for (std::size_t i = 0; i < pages_.size(); ++i) {
        if (!says_where_it_is(pages_[i], i + 1)) {
            return "has " + std::to_string(pages_.size()) + " pages, and number " + std::to_string(i + 1) +
                   " of them does not say that it is this one of so many";
        }
    }
    return {};
}

std::string PrintedDocument::disagreement_with_report(const nlohmann::json& view, const DocumentWords& words) const {
    if (std::string mark = mark_on(words); !mark.empty()) {
        return mark;
    }
    nlohmann::json sections = json::part_of(view, "sections");
    for (nlohmann::json& section : sections) {
        for (nlohmann::json& block : section["blocks"]) {
            block["paragraph"] = block["definitions"] = nlohmann::json::array();
        }
    }
    return disagreement_with_view({{"sections", std::move(sections)}});
}

std::string PrintedDocument::disagreement_with_view(const nlohmann::json& view) const {
    const std::vector<gum::Diagnostic> missing = check_numbers(pages_, view);
    return missing.empty()
               ? ""
               : "does not print " + missing.front().what.substr(0, missing.front().what.find(" of the record")) +
                     " of the record";
}

std::string difference_of_texts(std::string_view stated, std::string_view expected, std::string_view verb) {
    constexpr std::size_t k_shown = 60;  // bytes around the place
    const auto bare = [](std::string_view text) {
        std::string out;
        std::copy_if(text.begin(), text.end(), std::back_inserter(out),
                     [](char c) { return c != ' ' && c != '\n' && c != '\r' && c != '\t'; });
        return out;
    };
    const std::string left = bare(stated);
    const std::string right = bare(expected);
    if (left == right) {
        return {};
    }
    const auto both = static_cast<std::ptrdiff_t>(std::min(left.size(), right.size()));
    auto place =
        static_cast<std::size_t>(std::mismatch(left.begin(), left.begin() + both, right.begin()).first - left.begin());
    const auto shown = [&](const std::string& text) {
        std::size_t begin = place > k_shown / 2 ? place - k_shown / 2 : 0;
        std::size_t end = std::min(place + k_shown / 2, text.size());
        while (begin > 0 && text::is_continuation(text[begin])) {
            --begin;
        }
        while (end < text.size() && text::is_continuation(text[end])) {
            ++end;
        }
        return text::in_quotes(text.substr(begin, end - begin));
    };
    return std::string(verb) + shown(left) + ", and the page that the record gives " + std::string(verb) + shown(right);
}

bool says_number(std::string_view html, const std::string& number) {
    constexpr std::string_view k_head = " data-text=\"";
    if (html.find(k_head) == std::string_view::npos) {
        return has_word(text_of_html(html), number);
    }
    for (std::size_t at = html.find(k_head); at != std::string_view::npos; at = html.find(k_head, at + 1)) {
        const std::size_t from = at + k_head.size();
        const std::size_t end = std::min(html.find('"', from), html.size());
        if (has_word(text_of_html(html.substr(from, end - from)), number)) {
            return true;
        }
    }
    return false;
}

}  // namespace gumcert::reports
