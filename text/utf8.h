#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace gumcert::text {

/// A character of UTF-8 (The Unicode Standard, Table 3-7: no overlong forms, no surrogates, nothing above U+10FFFF).
struct Character {
    char32_t code = 0;
    std::size_t bytes = 0;  ///< 0: what stands there is no UTF-8
};

/// \param offset  smaller than text.size()
[[nodiscard]] Character decode_utf8(std::string_view text, std::size_t offset);
/// \param code  a Unicode scalar value
[[nodiscard]] std::string encode_utf8(char32_t code);
[[nodiscard]] bool is_utf8(std::string_view text);

/// Whether a byte continues the character before it.
[[nodiscard]] constexpr bool is_continuation(char byte) {
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}
/// Bytes that begin a character: the characters of a valid text.
[[nodiscard]] std::size_t character_count(std::string_view text);

/// Whether a reader cannot see a character, or it changes the order of what he sees: controls, characters without
/// width, marks of direction, tags (Unicode, categories Cc, Cf, Zl, Zp; Unicode Standard Annex #9). The two zero width
/// joiners are among them, though some scripts need them: see is_joiner.
[[nodiscard]] bool is_hidden(char32_t code);
/// A space of any script that stands within a line: U+0020, U+00A0, U+2000 to U+200A, U+202F and U+3000.
[[nodiscard]] constexpr bool is_blank(char32_t code) {
    return code == 0x20 || code == 0xA0 || code == 0x3000 || (code >= 0x2000 && code <= 0x200A) || code == 0x202F;
}
/// U+200C and U+200D.
[[nodiscard]] constexpr bool is_joiner(char32_t code) {
    return code == 0x200C || code == 0x200D;
}

}  // namespace gumcert::text
