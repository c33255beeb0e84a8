#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace gumcert::text {

/// A foreign text as a message shows it, so that the message stays one honest line: hidden characters as `\u{202E}`
/// (the zero width joiners too, with `joiners`), bytes that are no UTF-8 as `\x{FF}`, and an ellipsis behind `longest`
/// characters.
[[nodiscard]] std::string visible(std::string_view text, std::size_t longest = 80, bool joiners = false);
/// visible() between double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// "00AD", "1F600": at least `digits` capital hexadecimal digits.
[[nodiscard]] std::string hexadecimal(std::uint32_t number, std::size_t digits = 4);

}  // namespace gumcert::text
