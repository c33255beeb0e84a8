#pragma once

#include <string_view>

namespace gumcert::text {

/// "+3.1" as "3.1", for std::from_chars, which takes no plus sign; a sign that stands before no digit and no point stays: "+-3"
/// has two of them, and is no number.
[[nodiscard]] std::string_view without_plus(std::string_view number);

}  // namespace gumcert::text
