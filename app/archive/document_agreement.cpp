#include "app/archive/document_agreement.h"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <tuple>

#include "app/archive/record_parts.h"
#include "app/read_file.h"
#include "reports/dcc/dcc_reader.h"
#include "reports/forms/html_texts.h"
#include "reports/forms/pdf_page_texts.h"
#include "text/numbers.h"

namespace gumcert::app {

namespace {

constexpr std::size_t k_gap_of_power = 5;  // "10" and an exponent

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

std::string all_digits(std::string_view text) {
    std::string digits;
    std::copy_if(text.begin(), text.end(), std::back_inserter(digits), is_digit);
    return digits;
}

/// Digits of a printed number without those of its exponent, which documents set in several ways.
std::string mantissa_digits(std::string_view printed) {
    std::string digits;
    for (const char c : printed.substr(0, printed.find_first_of("eE"))) {
        digits += is_digit(c) ? std::string(1, c) : "";
    }
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

/// The same number in the same digits or others: "50000838" and "50000838.0".
std::string compared(const std::string& printed) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(printed.data(), printed.data() + printed.size(), value);
    constexpr int k_digits = 12;
    return error == std::errc() && end == printed.data() + printed.size() ? text::significant(value, k_digits)
                                                                          : printed;
}

struct StatedResult {
    std::string value, unit, uncertainty, conformity;

    [[nodiscard]] std::string shown() const {
        return value + " " + unit + (uncertainty.empty() ? "" : ", " + uncertainty) +
               (conformity.empty() ? "" : ", " + conformity);
    }
};

std::vector<StatedResult> stated_results(std::string_view bytes, const std::string& name) {
    std::vector<StatedResult> results;
    for (const reports::ImportedQuantity& one : reports::read_dcc(bytes, name).quantities) {
        if (one.role == "result" && one.kind != "none") {
            std::string uncertainty;
            for (const auto& [letter, text] :
                 {std::pair("U = ", &one.U), {"u = ", &one.u}, {"from ", &one.low}, {"to ", &one.high}}) {
                uncertainty += text->empty() ? "" : (uncertainty.empty() ? "" : " ") + (letter + compared(*text));
            }
            results.push_back({compared(one.value), one.d_si_unit, std::move(uncertainty), one.conformity});
        }
    }
    return results;
}

/// Whether a text of the wording is the mark of a document. They are found by their names, not listed: a document of a new
/// kind or state has a mark of its own, and is none that may be issued.
bool is_mark(std::string_view group, std::string_view key) {
    if (group == "document") {
        return key == "draft" || key == "superseded" || key == "mark" ||
               (key.ends_with("_mark") && !key.ends_with("end_mark"));
    }
    return key == "mark";
}

DocumentWords::Mark mark_of(const std::string& text) {
    const std::size_t open = text.find('{');
    const std::size_t close = text.find('}');
    const bool is_filled = open != std::string::npos && close != std::string::npos && open < close;
    return {.text = text,
            .before = reports::without_blanks(text.substr(0, is_filled ? open : std::string::npos)),
            .behind = reports::without_blanks(is_filled ? text.substr(close + 1) : "")};
}

std::size_t verdicts_of_a_row(const certificate::TableLayout& layout) {
    return static_cast<std::size_t>(
        std::count_if(layout.shown.begin(), layout.shown.end(), [](const auto& c) { return c.show == "verdict"; }));
}

}  // namespace

DocumentWords document_words(const std::filesystem::path& templates) {
    const std::filesystem::path folder = templates / "wording";
    DocumentWords words;
    for (const std::string& language : json_files_in(folder)) {
        const nlohmann::json wording = nlohmann::json::parse(read_file(folder / (language + ".json")), nullptr, false);
        const nlohmann::json& verdicts = part_of(wording, "verdict_name");
        if (!verdicts.is_object()) {
            continue;  // sentences, and what else stands beside the wording of a language
        }
        for (const auto& [code, word] : verdicts.items()) {
            if (word.is_string()) {
                words.verdicts.emplace_back(reports::without_blanks(word.get<std::string>()), code);
            }
        }
        for (const auto& [group, texts] : wording.items()) {
            if (!texts.is_object()) {
                continue;  // the language
            }
            for (const auto& [key, text] : texts.items()) {
                if (text.is_string() && is_mark(group, key)) {
                    words.marks.push_back(mark_of(text.get<std::string>()));
                }
            }
        }
    }
    if (words.verdicts.empty()) {
        throw gum::StorageError(gum::Diagnostic{.code = "GC-REPORT-0001",
                                                .where = folder.string(),
                                                .what = "no language has words for verdicts",
                                                .rule = "every text of a document is in the wording file",
                                                .action = "take the templates of this release"});
    }
    std::sort(words.verdicts.begin(), words.verdicts.end(), [](const auto& a, const auto& b) {
        return std::tuple(b.first.size(), a.first) < std::tuple(a.first.size(), b.first);
    });
    return words;
}

/// Numbers that stand behind each other.
struct PrintedDocument::Row {
    std::vector<std::string> numbers;         ///< digits
    std::size_t largest_gap = 0;              ///< digits of other numbers between two of them
    std::string shown = {};                   ///< for messages
    std::string verdict = {};                 ///< code; "" where none follows
    std::size_t verdicts = 1;                 ///< of so many that follow, one is this
    std::vector<std::string> otherwise = {};  ///< in place of `numbers` in another layout
    std::vector<std::size_t> gaps = {};       ///< before each of `numbers`, in place of largest_gap
    std::vector<std::size_t> blocks = {};     ///< where the cells of each result begin: a table may be divided there
};

PrintedDocument::PrintedDocument(const std::vector<std::string>& pages) : pages_(pages) {
    for (const std::string& page : pages) {
        for (const char c : reports::without_blanks(page)) {
            if (is_digit(c)) {
                digits_ += c;
                places_.push_back(text_.size());
            }
            text_ += c;
        }
        digits_ += ' ';
        places_.push_back(text_.size());
        text_ += '\n';
    }
}

/// The cells of some row that stand before and behind each other, with how far they may be apart.
PrintedDocument::Row PrintedDocument::row_of(const std::string& name, const std::vector<std::string>& cells,
                                             std::size_t gap) {
    Row row{.numbers = {}, .largest_gap = gap};
    for (const std::string& cell : cells) {
        if (std::string digits = mantissa_digits(cell); !digits.empty()) {
            const bool has_power = digits.size() < cell.size() && cell.find_first_of("eE") != std::string::npos;
            row.largest_gap = std::max(row.largest_gap, has_power ? k_gap_of_power : 0U);
            row.numbers.push_back(std::move(digits));
            row.shown += (row.shown.empty() ? "" : ", ") + cell;
        }
    }
    row.shown = name + " = " + row.shown;
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
                put(row_of(
                    name,
                    {shows("value") ? v.printed_value : "", with_U ? v.printed_low : "", with_U ? v.printed_high : ""},
                    table.layout ? k_gap_in_layouts : k_gap_of_interval));
            } else if (!table.layout) {
                Row row = row_of(name, {v.printed_value, v.printed_U}, 0);
                if (has_number(i) && !row.numbers.empty()) {
                    // Behind the argument, or behind the quantity before it where both stand in one table.
                    row.numbers = row_of(name, {argument_at(i), v.printed_value, v.printed_U}, 0).numbers;
                    if (before != nullptr && i < before->values.size()) {
                        row.otherwise = row_of(name,
                                               {before->values[i].printed_value, before->values[i].printed_U,
                                                v.printed_value, v.printed_U},
                                               0)
                                            .numbers;
                        row.largest_gap = std::max(row.largest_gap, k_gap_of_interval);
                    }
                }
                put(std::move(row));
            }
            if (v.verdict) {
                const bool value = !verdict_in_row || shows("value");
                const bool U = !verdict_in_row || (shows("U") && !is_interval(v));
                Row row = row_of(name, {value ? v.printed_value : "", U ? v.printed_U : ""},
                                 verdict_in_row ? k_gap_in_layouts : 0U);
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
        Row whole{.numbers = {}, .largest_gap = k_gap_in_rows};
        bool is_next = false;  // nothing else is printed between this cell and the one before
        std::string block;     // the result whose cells were last
        const auto add_cell = [&](std::string digits, const std::string& cell) {
            if (!digits.empty()) {
                whole.gaps.push_back(is_next ? 0U : k_gap_in_rows);
                whole.numbers.push_back(std::move(digits));
                whole.shown += (whole.shown.empty() ? "" : ", ") + cell;
            }
            is_next = cell.find_first_of("eE") == std::string::npos;  // no power of ten behind it
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
                add_cell(all_digits(argument_at(i)), argument_at(i));
            } else if (shown.show == "column" && point != table.layout->columns.end() && i < point->printed.size()) {
                const bool number = i < point->values.size() && point->values[i].has_value();
                add_cell(number ? mantissa_digits(point->printed[i]) : all_digits(point->printed[i]),
                         point->printed[i]);
            } else if ((shown.show == "value" || shown.show == "U") && result != table.columns.end() &&
                       i < result->values.size()) {
                const CertifiedValue& v = result->values[i];
                outside.insert(v.scope_entry.empty());
                const std::string& printed = shown.show == "value" ? v.printed_value : v.printed_U;
                if (shown.show == "value" || !is_interval(v)) {
                    add_cell(mantissa_digits(printed), printed);
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
                put(row_of(column.result + " at " + argument_at(i),
                           {shows("value") ? column.values[i].printed_value : "",
                            shows("U") ? column.values[i].printed_U : ""},
                           k_gap_in_layouts));
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

bool PrintedDocument::has(const Row& row, const std::vector<std::string>& numbers, const DocumentWords& words,
                          std::size_t& from) const {
    for (const std::size_t begin : {from, std::size_t{0}}) {
        for (std::size_t first = digits_.find(numbers.front(), begin); first != std::string::npos;
             first = digits_.find(numbers.front(), first + 1)) {
            std::set<std::size_t> ends{first + numbers.front().size()};
            for (std::size_t i = 1; i < numbers.size() && !ends.empty(); ++i) {
                std::set<std::size_t> next;
                for (const std::size_t end : ends) {
                    const std::size_t largest =
                        &numbers == &row.numbers && i < row.gaps.size() ? row.gaps[i] : row.largest_gap;
                    for (std::size_t gap = 0; gap <= largest && end + gap < digits_.size(); ++gap) {
                        if (digits_.compare(end + gap, numbers[i].size(), numbers[i]) == 0) {
                            next.insert(end + gap + numbers[i].size());
                        }
                    }
                }
                ends = std::move(next);
            }
            if (std::any_of(ends.begin(), ends.end(),
                            [&](std::size_t end) { return row.verdict.empty() || is_followed_by(end, row, words); })) {
                from = first;
                return true;
            }
        }
    }
    return false;
}

/// Whether a row stands in a table that was divided by its results: the cells that all results share, or the first of them,
/// and right behind them those of some results, in each table.
bool PrintedDocument::has_in_parts(const Row& row, const DocumentWords& words) const {
    if (row.blocks.empty() || row.blocks.front() == 0) {
        return false;
    }
    const auto has_part = [&](std::size_t shared, std::size_t begin, std::size_t end) {
        Row part{.numbers = {}, .largest_gap = row.largest_gap};
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

std::string PrintedDocument::mark_on(const DocumentWords& words) const {
    constexpr std::size_t k_longest_value = 200;  // bytes of a number
    for (const DocumentWords::Mark& mark : words.marks) {
        const std::string& first = mark.before.empty() ? mark.behind : mark.before;
        for (std::size_t at = first.empty() ? std::string::npos : text_.find(first); at != std::string::npos;
             at = text_.find(first, at + 1)) {
            const std::string_view rest = std::string_view(text_).substr(at + first.size(), k_longest_value);
            if (&first == &mark.behind || rest.find(mark.behind) != std::string_view::npos) {
                return "is marked \"" + mark.text + "\", and is no certificate as it is issued";
            }
        }
    }
    return {};
}

std::string PrintedDocument::disagreement_with_report(const nlohmann::json& view, const DocumentWords& words) const {
    if (std::string mark = mark_on(words); !mark.empty()) {
        return mark;
    }
    nlohmann::json sections = part_of(view, "sections");
    for (nlohmann::json& section : sections) {
        for (nlohmann::json& block : section["blocks"]) {
            block["paragraph"] = block["definitions"] = nlohmann::json::array();
        }
    }
    const std::vector<gum::Diagnostic> missing = reports::check_numbers(pages_, {{"sections", std::move(sections)}});
    return missing.empty()
               ? ""
               : "does not print " + missing.front().what.substr(0, missing.front().what.find(" of the record")) +
                     " of the record";
}

bool says_number(std::string_view html, const std::string& number) {
    constexpr std::string_view k_head = " data-text=\"";
    if (html.find(k_head) == std::string_view::npos) {
        return has_word(reports::text_of_html(html), number);
    }
    for (std::size_t at = html.find(k_head); at != std::string_view::npos; at = html.find(k_head, at + 1)) {
        const std::size_t from = at + k_head.size();
        const std::size_t end = std::min(html.find('"', from), html.size());
        if (has_word(reports::text_of_html(html.substr(from, end - from)), number)) {
            return true;
        }
    }
    return false;
}

std::string disagreement_of_dcc(std::string_view bytes, const std::string& name, std::string_view made_of_record) {
    std::vector<StatedResult> expected = stated_results(made_of_record, "digital certificate of the record");
    for (const StatedResult& stated : stated_results(bytes, name)) {
        const auto same = std::find_if(expected.begin(), expected.end(), [&](const StatedResult& one) {
            return one.value == stated.value && one.unit == stated.unit && one.uncertainty == stated.uncertainty &&
                   (stated.conformity.empty() || one.conformity == stated.conformity);
        });
        if (same == expected.end()) {
            return "states \"" + stated.shown() + "\", and the record does not";
        }
        expected.erase(same);
    }
    return expected.empty() ? "" : "does not state \"" + expected.front().shown() + "\" of the record";
}

}  // namespace gumcert::app
