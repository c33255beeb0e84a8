#pragma once

#include <string>
#include <vector>

namespace gumcert::text {

/// The parts of a text between separators, empty ones too: one more than there are separators.
[[nodiscard]] std::vector<std::string> split(const std::string& text, char separator);

}  // namespace gumcert::text
