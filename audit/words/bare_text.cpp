#include "audit/words/bare_text.h"

#include <algorithm>

namespace gumcert::audit {

std::string_view without_brackets(std::string_view text) {
    const std::size_t square = text.find('[');
    if (square != std::string_view::npos && square > 0) {
        return text.substr(0, square);
    }
    const std::size_t round = text.find(" (");
    return round != std::string_view::npos && round > 0 ? text.substr(0, round) : text;
}

std::string_view trimmed(std::string_view text) {
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) {
        text.remove_prefix(1);
    }
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t' || text.back() == ':' || text.back() == '=')) {
        text.remove_suffix(1);
    }
    return text;
}

bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || static_cast<unsigned char>(c) >= 0x80;
}

bool is_of_number(char c) {
    return (c >= '0' && c <= '9') || c == '.' || c == ',';
}

bool is_symbol(std::string_view word) {
    constexpr std::size_t k_longest = 12;
    if (word.empty() || word.size() > k_longest || word.find('%') != std::string_view::npos) {
        return false;
    }
    for (const std::string_view small :
         {"of", "in", "by", "to", "at", "or", "an", "on", "is", "de", "zu", "im", "am"}) {
        if (word == small) {
            return false;
        }
    }
    if (word.find_first_of("_(/|^") != std::string_view::npos || word.find("·") != std::string_view::npos) {
        return true;
    }
    const auto letters = std::count_if(word.begin(), word.end(),
                                       [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; });
    return letters <= 2 && is_letter(word.front());
}

}  // namespace gumcert::audit
