#pragma once

#include <initializer_list>
#include <string_view>

namespace gumcert::audit {

/// What stands before a unit or explanation in brackets: "u(xi) [µm]" and "U95 (k=2)" begin with what they are.
[[nodiscard]] std::string_view without_brackets(std::string_view text);
/// Without blanks at its ends, and without a colon or a sign of equality behind it.
[[nodiscard]] std::string_view trimmed(std::string_view text);
[[nodiscard]] bool is_one_of(std::string_view word, std::initializer_list<std::string_view> words);
[[nodiscard]] bool is_letter(char c);
[[nodiscard]] bool is_of_number(char c);
/// A symbol behind the word of a head: "X_i", "u(x)", "dT/dx", "a".
[[nodiscard]] bool is_symbol(std::string_view word);

}  // namespace gumcert::audit
