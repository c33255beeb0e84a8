#pragma once

#include <cstddef>
#include <string_view>

namespace gumcert::text {

/// Number of bytes to insert, delete or replace until one word is the other (Levenshtein). Capitals of ASCII count as their
/// small letters: "Axis" is "axis" to who looks for it.
[[nodiscard]] std::size_t edit_distance(std::string_view a, std::string_view b);

}  // namespace gumcert::text
