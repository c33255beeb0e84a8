#include "text/visible_text.h"

#include "text/utf8.h"

namespace gumcert::text {

std::string visible(std::string_view text, std::size_t longest, bool joiners) {
    std::string shown;
    std::size_t characters = 0;
    for (std::size_t i = 0; i < text.size(); ++characters) {
        if (characters == longest) {
            return shown + "…";
        }
        const Character character = decode_utf8(text, i);
        if (character.bytes == 0) {
            shown += "\\x{" + hexadecimal(static_cast<unsigned char>(text[i]), 2) + '}';
            ++i;
            continue;
        }
        const bool hidden = is_hidden(character.code) && (joiners || !is_joiner(character.code));
        shown += hidden ? "\\u{" + hexadecimal(character.code) + '}' : std::string(text.substr(i, character.bytes));
        i += character.bytes;
    }
    return shown;
}

std::string one_line(std::string_view text) {
    return visible(text, text.size());
}

std::string in_quotes(std::string_view text) {
    return '"' + visible(text) + '"';
}

std::string hexadecimal(std::uint32_t number, std::size_t digits) {
    std::string text;
    for (; number != 0 || text.size() < digits; number /= 16U) {
        text.insert(text.begin(), "0123456789ABCDEF"[number % 16U]);
    }
    return text;
}

}  // namespace gumcert::text
