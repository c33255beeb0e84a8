#include "reports/view/named_tables.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <nlohmann/json.hpp>
#include <optional>

#include "text/small_letters.h"

namespace gumcert::reports {

namespace {

using nlohmann::json;

/// The number that begins at `at`, which is moved behind it.
std::optional<std::size_t> number_at(std::string_view text, std::size_t& at) {
    std::size_t number = 0;
    const auto read = std::from_chars(text.data() + at, text.data() + text.size(), number);
    if (read.ec != std::errc()) {
        return std::nullopt;
    }
    at = static_cast<std::size_t>(read.ptr - text.data());
    return number;
}

/// One of these words at a place, which is moved behind it.
template <std::size_t n>
bool skip_word(std::string_view text, std::size_t& at, const std::array<std::string_view, n>& words) {
    for (const std::string_view word : words) {
        if (text.substr(at).starts_with(word)) {
            at += word.size();
            return true;
        }
    }
    return false;
}

void skip_blanks(std::string_view text, std::size_t& at) {
    static constexpr std::array<std::string_view, 3> k_blanks{" ", "\u00a0", "\u202f"};
    while (skip_word(text, at, k_blanks)) {
    }
}

// The longer one of two words that begin alike comes first.
constexpr std::array<std::string_view, 9> k_tables{"tables", "table", "tabellen", "tabelle", "tablas",
                                                   "tabla",  "表格",  "附表",     "表"};
constexpr std::array<std::string_view, 15> k_between{"and", "und", "to", "bis", "y", "e", "a", "及",
                                                     "與",  "和",  "至", "、",  ",", "-", "–"};
// What may stand beside the numbers of own tables. Anything else may speak of another document: in how many ways that can
// be done nobody knows, so that words are allowed and not forbidden.
constexpr std::string_view k_words =
    " see the results result values as found before adjustment are is in stand stated given shown listed of and to"
    " siehe die der den werte ergebnisse vor bei eingang justierung stehen steht sind im angegeben und bis"
    " ver v\u00e9ase v\u00e9anse los las la el resultados resultado valores antes del ajuste a y recepci\u00f3n "
    "est\u00e1n"
    " est\u00e1 se indican figuran en de e ";
constexpr std::array<std::string_view, 34> k_signs{
    "見", "請", "詳", "參", "閱", "如", "列", "於", "在", "為", "之", "的", "所", "示", "載", "調", "整",
    "前", "結", "果", "收", "件", "狀", "態", "第", "及", "與", "和", "至", "、", "。", "，", "“",  "”"};

bool is_of_word(char c) {
    const auto byte = static_cast<unsigned char>(c);
    return (c >= 'a' && c <= 'z') || (byte >= 0xC3 && byte < 0xE0) || (byte >= 0x80 && byte < 0xC0);
}

/// A blank, a sign or a word that may stand beside the numbers of own tables; `at` is moved behind it.
bool skip_harmless(std::string_view text, std::size_t& at) {
    const std::size_t begin = at;
    skip_blanks(text, at);
    if (at != begin || skip_word(text, at, k_signs)) {
        return true;
    }
    if (std::string_view(".,;:()\"'-").find(text[at]) != std::string_view::npos) {
        ++at;
        return true;
    }
    while (at < text.size() && is_of_word(text[at])) {
        ++at;
    }
    const std::string word = " " + std::string(text.substr(begin, at - begin)) + " ";
    return at > begin && k_words.find(word) != std::string_view::npos;
}

/// Numbers of the tables with results in the view of a document. A draft has one of its findings before them, which the
/// certificate has not.
std::vector<std::size_t> tables_with_results(const json& view) {
    std::vector<std::size_t> numbers;
    std::size_t of_findings = 0;
    for (const json& section : view.at("sections")) {
        const std::string& id = section.at("id").get_ref<const std::string&>();
        if (id == "findings") {
            for (const json& block : section.at("blocks")) {
                of_findings += block.at("table").size();
            }
        }
        if (section.at("kind") == "annex" || id == "findings" || id == "traceability" || id == "conditions" ||
            id == "amendment") {
            continue;
        }
        for (const json& block : section.at("blocks")) {
            for (const json& table : block.at("table")) {
                const std::string& number = table.at("number").get_ref<const std::string&>();
                std::size_t at = number.find_first_of("0123456789");
                const bool of_conditions = table.at("id").get_ref<const std::string&>().starts_with("conditions");
                if (at != std::string::npos && !of_conditions) {
                    numbers.push_back(number_at(number, at).value_or(0) - of_findings);
                }
            }
        }
    }
    return numbers;
}

}  // namespace

std::vector<std::size_t> own_tables_named(std::string_view words) {
    const std::string text = text::in_small_letters(words);
    std::vector<std::size_t> named;
    std::size_t at = 0;
    while (at < text.size()) {
        if (!skip_word(text, at, k_tables)) {
            if (!skip_harmless(text, at)) {
                return {};
            }
            continue;
        }
        skip_blanks(text, at);
        // "Tables 2, 3 and 5": what stands between two numbers is a word of the list, and belongs to it only then.
        std::size_t next = at;
        while (const std::optional<std::size_t> number = number_at(text, next)) {
            named.push_back(*number);
            at = next;
            if (at < text.size() && is_of_word(text[at])) {  // "Table 3a"
                return {};
            }
            skip_blanks(text, next);
            skip_word(text, next, k_between);
            skip_blanks(text, next);
            skip_word(text, next, k_tables);
            skip_blanks(text, next);
            if (next == at) {
                break;
            }
        }
    }
    return named;
}

bool names_tables_before_adjustment(const certificate::Certificate& certificate) {
    if (!certificate.data.adjustment || !certificate.data.adjustment->adjusted) {
        return false;
    }
    const certificate::LocalisedText& where = certificate.data.adjustment->as_found;
    return !own_tables_named(where.plain).empty() ||
           std::any_of(where.by_language.begin(), where.by_language.end(),
                       [](const auto& one) { return !own_tables_named(one.second).empty(); });
}

std::vector<certificate::Finding> findings_on_named_tables(const certificate::Certificate& certificate,
                                                           const nlohmann::json& view,
                                                           const std::vector<std::string>& languages) {
    if (!names_tables_before_adjustment(certificate)) {
        return {};
    }
    const std::vector<std::size_t> there = tables_with_results(view);
    std::vector<certificate::Finding> found;
    for (const std::string& language : languages) {
        for (const std::size_t number : own_tables_named(certificate.data.adjustment->as_found.in(language))) {
            if (there.empty() || std::find(there.begin(), there.end(), number) != there.end()) {
                continue;
            }
            const auto [first, last] = std::minmax_element(there.begin(), there.end());
            const std::string named =
                "the results before the adjustment are said to stand in table " + std::to_string(number) + ", and ";
            const auto is_this = [&](const certificate::Finding& f) {
                return f.where == "/adjustment/as_found" && f.what.starts_with(named);
            };
            if (std::ranges::any_of(certificate.findings, is_this) || std::ranges::any_of(found, is_this)) {
                continue;
            }
            found.push_back(
                {.id = "R07-4d",
                 .clause = "ISO/IEC 17025:2017, 7.8.4.1 d",
                 .severity = certificate::FindingSeverity::critical,
                 .where = "/adjustment/as_found",
                 .what = *first == *last
                             ? named + "table " + std::to_string(*first) + " has the results of this certificate"
                             : named + "tables " + std::to_string(*first) + " to " + std::to_string(*last) +
                                   " have the results of this certificate",
                 .action = "Name the table that has them, or the certificate with its number."});
        }
    }
    return found;
}

}  // namespace gumcert::reports
