#include "reports/printable_text.h"

#include <algorithm>
#include <cstddef>

#include "text/utf8.h"

namespace gumcert::reports {

std::string printable(const std::string& text) {
    static constexpr const char* k_replacement = "\uFFFD";
    if (std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; })) {
        return text;  // most texts of a document are numbers
    }
    std::string out;
    for (std::size_t i = 0; i < text.size();) {
        const text::Character character = text::decode_utf8(text, i);
        const std::size_t bytes = std::max<std::size_t>(character.bytes, 1);
        if (character.code == U'\n' || character.code == U'\t') {
            out += ' ';
        } else if (character.bytes == 0 || (text::is_hidden(character.code) && !text::is_joiner(character.code))) {
            out += k_replacement;
        } else {
            out += text.substr(i, bytes);
        }
        i += bytes;
    }
    return out;
}

std::string shortened(const std::string& text, std::size_t most) {
    std::size_t characters = 0;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const bool starts = !text::is_continuation(text[i]);
        if (starts && characters++ == most) {
            return text.substr(0, i) + "…";
        }
    }
    return text;
}

}  // namespace gumcert::reports
