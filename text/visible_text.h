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
/// visible() without an end: a text of others that is printed whole is one honest line all the same. Whatever comes out of
/// a file, an archive or a command line goes through it, or through visible(), before a terminal shows it.
[[nodiscard]] std::string one_line(std::string_view text);
/// visible() between double quotes.
[[nodiscard]] std::string in_quotes(std::string_view text);

/// "00AD", "1F600": at least `digits` capital hexadecimal digits.
[[nodiscard]] std::string hexadecimal(std::uint32_t number, std::size_t digits = 4);

}  // namespace gumcert::text
