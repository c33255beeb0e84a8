#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gumcert::certificate {

/// The words of a text, for comparisons only: runs of letters and digits in small letters, without accents, so that
/// "N/A", "n.a." and "Ｎ／Ａ" have the same letters. Full-width forms and the Cyrillic and Greek letters that look like
/// Latin ones count as these. Punctuation, symbols, spaces and letters without an image separate words.
[[nodiscard]] std::vector<std::u32string> words_of(std::string_view text);

/// All letters and digits in one, "EX-2026 0042" as "ex20260042": two texts with the same letters say the same.
[[nodiscard]] std::u32string letters_of(std::string_view text);

/// Whether a character is one of the digits 0 to 9.
[[nodiscard]] constexpr bool is_digit(char32_t character) {
    return character >= U'0' && character <= U'9';
}

/// Whether a character is of a script that has no spaces between words (Chinese, Japanese).
[[nodiscard]] bool is_ideograph(char32_t character);

}  // namespace gumcert::certificate
