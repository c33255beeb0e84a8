#pragma once

#include <cstddef>
#include <string>

namespace gumcert::reports {

/// A text as it may stand in a document: tab and line feed become blanks; other control characters, characters that
/// change the direction of writing, and bytes that are not UTF-8 become U+FFFD.
[[nodiscard]] std::string printable(const std::string& text);

/// At most `most` characters of a UTF-8 text, with an ellipsis where something was left out.
[[nodiscard]] std::string shortened(const std::string& text, std::size_t most);

}  // namespace gumcert::reports
