#pragma once

#include <string>
#include <string_view>

namespace gumcert::app {

/// A name without what spelling adds to it: letters and digits alone, small, without accents; zeros before a number
/// count for nothing. Names that are equal in this form may be one name. Latin, Greek and Cyrillic letters are folded,
/// composed or not, and letters that look like a Latin one are that letter; all others stay as they are.
[[nodiscard]] std::string without_spelling(std::string_view name);

}  // namespace gumcert::app
