#include "reports/forms/typeset_table.h"

#include "text/utf8.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using nlohmann::json;

constexpr std::size_t k_short = 12;           // characters of a text that stays in one line
constexpr std::size_t k_long_word = 30;       // of a word that may have to break anywhere
constexpr std::size_t k_longest_number = 28;  // of a number that is not made of digits alone, and does not break

/// Characters as a reader counts them: an accent behind its letter, a joiner or a selector of a form is none of its own.
std::size_t seen_characters(std::string_view utf8) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < utf8.size();) {
        const text::Character character = text::decode_utf8(utf8, i);
        const char32_t code = character.code;
        const bool belongs_to_another = (code >= 0x300 && code <= 0x36F) || (code >= 0x20D0 && code <= 0x20FF) ||
                                        (code >= 0xFE00 && code <= 0xFE0F) || text::is_joiner(code);
        count += belongs_to_another ? 0U : 1U;
        i += std::max<std::size_t>(character.bytes, 1);
    }
    return count;
}

/// A sign, digits, and a decimal sign with digits behind it.
struct PlainNumber {
    bool is_one = false;
    std::size_t whole = 0, fraction = 0;  ///< digits
};
PlainNumber plain_number(std::string_view number) {
    constexpr std::string_view k_minus = "−";
    if (number.starts_with(k_minus)) {
        number.remove_prefix(k_minus.size());
    } else if (number.starts_with('+')) {
        number.remove_prefix(1);
    }
    const auto digits = [&number] {
        const std::size_t count = std::min(number.find_first_not_of("0123456789"), number.size());
        number.remove_prefix(count);
        return count;
    };
    PlainNumber found;
    found.whole = digits();
    if (number.starts_with('.') || number.starts_with(',')) {
        number.remove_prefix(1);
    }
    found.fraction = digits();
    found.is_one = number.empty() && found.whole > 0;
    return found;
}

bool has_long_word(std::string_view utf8) {
    std::size_t begin = 0;
    for (std::size_t i = 0; i <= utf8.size();) {
        const text::Character character = i < utf8.size() ? text::decode_utf8(utf8, i) : text::Character{0x20, 1};
        const bool blank = text::is_blank(character.code) || (character.code >= 0x09 && character.code <= 0x0D);
        if (blank || i == utf8.size()) {
            if (i - begin >= k_long_word && seen_characters(utf8.substr(begin, i - begin)) >= k_long_word) {
                return true;
            }
            begin = i + std::max<std::size_t>(character.bytes, 1);
        }
        i += std::max<std::size_t>(character.bytes, 1);
    }
    return false;
}

bool is_number(const json& cell, const std::string& words) {
    return cell.at("align") == "number" && (seen_characters(words) <= k_longest_number || plain_number(words).is_one);
}

std::string form_of(const json& cell, bool first, const std::set<std::string>& letters) {
    constexpr std::size_t k_digits_together = 4;  // more are drawn in groups
    const auto& words = cell.at("text").get_ref<const std::string&>();
    if (is_number(cell, words)) {
        const PlainNumber number = plain_number(words + cell.at("pad").get<std::string>());
        return number.is_one && number.whole <= k_digits_together && number.fraction <= k_digits_together ? "digits"
                                                                                                          : "number";
    }
    if (first && letters.contains(words)) {
        return "letter";
    }
    return seen_characters(words) <= k_short ? "short" : has_long_word(words) ? "long" : "words";
}

/// Characters that the font of the template has, others having other heights, and between which no line ends (Unicode Standard
/// Annex #14) unless at a blank. Listed, not excluded: a row that is higher than was thought lies upon the next one.
bool is_within_a_line(char32_t code) {
    if (code < 0x80) {
        return (code >= '0' && code <= '9') || (code >= 'A' && code <= 'Z') || (code >= 'a' && code <= 'z') ||
               std::u32string_view(U" .=_[]()<>%:+'*&").find(code) != std::u32string_view::npos;
    }
    return (code >= 0xC0 && code <= 0x17F) || (code >= 0x391 && code <= 0x3C9) || (code >= 0x2070 && code <= 0x209C) ||
           std::u32string_view(U"−µ°²³¹±·\u00A0").find(code) != std::u32string_view::npos;
}

/// Characters of a number or its unit besides these: it does not break anywhere.
bool is_within_a_number(char32_t code) {
    return (code != ' ' && is_within_a_line(code)) ||
           std::u32string_view(U"-/,×Ω–∞\u00A0\u202F").find(code) != std::u32string_view::npos;
}

/// Whether a cell is one line of the height of any other, at any width.
bool is_one_line(const json& cell, std::size_t columns) {
    constexpr std::size_t k_hyphenated =
        9;  // characters of a word that the template hyphenates, in a table of many columns
    constexpr std::size_t k_many_columns = 8;
    const std::string_view form = cell.at("form").get_ref<const std::string&>();
    if (form == "words" || form == "long" || !cell.at("also").empty()) {
        return false;
    }
    const std::string_view words = cell.at("text").get_ref<const std::string&>();
    if (words == "–") {
        return true;  // nothing to state
    }
    const bool is_short = form == "short";
    std::size_t word = 0;  // its bytes so far
    for (std::size_t i = 0; i < words.size();) {
        const auto [code, bytes] = text::decode_utf8(words, i);
        const std::size_t step = std::max<std::size_t>(bytes, 1);
        i += step;
        word = code == ' ' || code == U'\u00A0' ? 0 : word + step;
        const bool is_kept = is_short ? is_within_a_line(code) : is_within_a_number(code);
        if (!is_kept || (is_short && columns > k_many_columns && word >= k_hyphenated)) {
            return false;
        }
    }
    return true;
}

/// The two longest texts; of equal ones those that come first.
class Longest {
public:
    void add(const std::string& words, std::size_t length) {
        if (length > lengths_[0]) {
            lengths_[1] = std::exchange(lengths_[0], length);
            texts_[1] = std::exchange(texts_[0], words);
        } else if (length > lengths_[1]) {
            lengths_[1] = length;
            texts_[1] = words;
        }
    }
    void tell(json& all) const {
        for (const std::string& words : texts_) {
            if (!words.empty()) {
                all.push_back({{"text", words}});
            }
        }
    }

private:
    std::array<std::string, 2> texts_;
    std::array<std::size_t, 2> lengths_{};
};

void typeset(json& table, const std::set<std::string>& letters) {
    json& columns = table.at("columns");
    // Numbers of digits alone by themselves: of as many characters, one with blanks and raised digits is narrower.
    std::vector<Longest> longest(columns.size()), of_digits(columns.size());
    std::vector<std::size_t> most(columns.size());
    for (json& row : table.at("rows")) {
        json& cells = row.at("cells");
        bool is_line = row.at("kind") != "closing";  // that one is bold
        for (std::size_t c = 0; c < cells.size(); ++c) {
            json& cell = cells[c];
            cell["form"] = form_of(cell, c == 0, letters);
            is_line = is_line && is_one_line(cell, columns.size());
            if (c >= columns.size()) {
                continue;
            }
            const bool numbers = columns[c].at("align") == "number";
            std::string words = cell.at("text").get<std::string>() + cell.at("pad").get<std::string>();
            if (!numbers) {
                for (const json& other : cell.at("also")) {  // it stands behind the first language
                    words += " " + other.at("text").get<std::string>();
                }
            }
            const std::size_t length = seen_characters(words);
            most[c] = std::max(most[c], numbers ? length : 0);
            if (!numbers || cell["form"] == "digits" || cell["form"] == "number") {
                (numbers && plain_number(words).is_one ? of_digits : longest)[c].add(words, length);
            }
        }
        row["line"] = is_line ? "one" : "";
    }
    std::size_t digits = 0;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        json& texts = columns[c]["longest"] = json::array();
        of_digits[c].tell(texts);
        longest[c].tell(texts);
        digits += most[c];
    }
    table["digits"] = std::to_string(digits);
}

void typeset_sections(json& holder, const std::set<std::string>& letters) {
    if (const auto sections = holder.find("sections"); sections != holder.end()) {
        for (json& section : *sections) {
            for (json& block : section.at("blocks")) {
                for (json& table : block.at("table")) {
                    typeset(table, letters);
                }
            }
        }
    }
}

}  // namespace

nlohmann::json with_typeset_tables(nlohmann::json view) {
    std::set<std::string> letters;
    if (const auto found = view.find("letters"); found != view.end()) {
        for (const json& letter : *found) {
            letters.insert(letter.at("text").get<std::string>());
        }
    }
    typeset_sections(view, letters);
    if (const auto pages = view.find("identity"); pages != view.end()) {
        for (json& page : *pages) {
            typeset_sections(page, letters);
        }
    }
    return view;
}

}  // namespace gumcert::reports
