#include "app/archive/document_agreement.h"

#include <algorithm>
#include <charconv>
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

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

bool is_digit(char c) {
    return c >= '0' && c <= '9';
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
        for (const char* const mark : {"draft", "mark"}) {
            if (const std::string text = text_of(part_of(wording, "document"), mark); !text.empty()) {
                words.marks.push_back(reports::without_blanks(text));
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
    std::vector<std::string> numbers;  ///< digits
    std::size_t largest_gap = 0;       ///< digits of other numbers between two of them
    std::string shown = {};            ///< for messages
    std::string verdict = {};          ///< code; "" where none follows
    std::size_t verdicts = 1;          ///< of so many that follow, one is this
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

std::vector<PrintedDocument::Row> PrintedDocument::rows_of(const CertifiedTable& table) {
    constexpr std::size_t k_gap_of_power = 5;     // "10" and an exponent
    constexpr std::size_t k_gap_of_interval = 8;  // u beside it
    constexpr std::size_t k_gap_in_layouts = 60;  // a job may order the columns
    std::vector<Row> rows;
    for (const CertifiedColumn& column : table.columns) {
        const auto shows = [&](const char* what) {
            return !table.layout || std::any_of(table.layout->shown.begin(), table.layout->shown.end(),
                                                [&](const auto& c) { return c.of == column.result && c.show == what; });
        };
        const bool verdict_in_row = table.layout && shows("verdict");
        for (std::size_t i = 0; i < column.values.size(); ++i) {
            const CertifiedValue& v = column.values[i];
            const std::string name =
                column.result +
                (table.argument && i < table.argument->printed.size() ? " at " + table.argument->printed[i] : "");
            const auto add = [&](const std::vector<std::pair<const char*, std::string>>& numbers,
                                 const std::string& verdict) {
                Row row{.numbers = {}, .largest_gap = table.layout ? k_gap_in_layouts : 0U};
                for (const auto& [letter, printed] : numbers) {
                    const std::size_t gap = printed.find_first_of("eE") != std::string::npos ? k_gap_of_power
                                            : numbers.size() > 2                             ? k_gap_of_interval
                                                                                             : 0U;
                    row.largest_gap = std::max(row.largest_gap, gap);
                    if (std::string digits = mantissa_digits(printed); !digits.empty()) {
                        row.numbers.push_back(std::move(digits));
                        row.shown += (row.shown.empty() ? "" : ", ") + (letter + printed);
                    }
                }
                if (!row.numbers.empty()) {
                    row.shown = name + " = " + row.shown +
                                (column.printed_unit.empty() ? "" : " " + column.printed_unit) +
                                (verdict.empty() ? "" : ", " + verdict);
                    row.verdict = verdict;
                    row.verdicts = verdict_in_row ? verdicts_of_a_row(*table.layout) : 1;
                    rows.push_back(std::move(row));
                }
            };
            const bool is_interval = v.interval && !v.printed_low.empty();
            std::vector<std::pair<const char*, std::string>> numbers;
            if (shows("value")) {
                numbers.emplace_back("", v.printed_value);
            }
            if (is_interval && (shows("U") || shows("k") || shows("nu_eff"))) {
                numbers.emplace_back("from ", v.printed_low);
                numbers.emplace_back("to ", v.printed_high);
            } else if (shows("U")) {
                numbers.emplace_back("U = ", v.printed_U);
            }
            add(numbers, "");
            if (v.verdict && verdict_in_row) {
                add({{"", shows("value") ? v.printed_value : ""},
                     {"U = ", shows("U") && !is_interval ? v.printed_U : ""}},
                    v.verdict->verdict);
            } else if (v.verdict) {
                add({{"", v.printed_value}, {"U = ", v.printed_U}}, v.verdict->verdict);
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

bool PrintedDocument::has(const Row& row, const DocumentWords& words, std::size_t& from) const {
    for (const std::size_t begin : {from, std::size_t{0}}) {
        for (std::size_t first = digits_.find(row.numbers.front(), begin); first != std::string::npos;
             first = digits_.find(row.numbers.front(), first + 1)) {
            std::set<std::size_t> ends{first + row.numbers.front().size()};
            for (std::size_t i = 1; i < row.numbers.size() && !ends.empty(); ++i) {
                std::set<std::size_t> next;
                for (const std::size_t end : ends) {
                    for (std::size_t gap = 0; gap <= row.largest_gap; ++gap) {
                        if (digits_.compare(end + gap < digits_.size() ? end + gap : digits_.size(),
                                            row.numbers[i].size(), row.numbers[i]) == 0) {
                            next.insert(end + gap + row.numbers[i].size());
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

std::string PrintedDocument::disagreement_with(const certificate::Certificate& certificate,
                                               const DocumentWords& words) const {
    if (is_marked(words)) {
        return "is marked as a draft or a specimen";
    }
    std::size_t from = 0;
    for (const CertifiedTable& table : certificate.tables) {
        for (const Row& row : rows_of(table)) {
            if (!has(row, words, from)) {
                return "does not print \"" + row.shown + "\" of the record";
            }
        }
    }
    return {};
}

bool PrintedDocument::is_marked(const DocumentWords& words) const {
    return std::any_of(words.marks.begin(), words.marks.end(),
                       [&](const std::string& mark) { return text_.find(mark) != std::string::npos; });
}

std::string PrintedDocument::disagreement_with_report(const nlohmann::json& view, const DocumentWords& words) const {
    if (is_marked(words)) {
        return "is marked as a draft or a specimen";
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
