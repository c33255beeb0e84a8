#pragma once

#include <string>
#include <string_view>

namespace gumcert::text {

/// "A" as "a"; others as they are. Letters of ASCII only, whatever the locale.
[[nodiscard]] constexpr char small_letter(char letter) {
    return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
}

/// A text with small_letter() of each byte: UTF-8 stays UTF-8.
[[nodiscard]] std::string in_small_letters(std::string_view text);

}  // namespace gumcert::text
