#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace gumcert::reports {

// Lines of a document for a terminal or a fixed-width font. Texts are valid UTF-8, as printable() leaves them.

constexpr std::size_t k_columns = 100;  ///< of a document as text

struct Glyph {
    std::string bytes;
    std::size_t width = 1;  ///< columns of a terminal or a fixed-width font
};

/// Characters of a text; combining marks are joined to the character before them.
[[nodiscard]] std::vector<Glyph> glyphs(const std::string& text);

/// Columns that a text takes; Chinese, Japanese and Korean characters take two.
[[nodiscard]] std::size_t width(const std::string& text);

/// Lines of at most `most` columns, broken at blanks, beside wide characters (Chinese has no blanks), and inside a word
/// only where the word alone is longer. At least one line.
[[nodiscard]] std::vector<std::string> wrapped(const std::string& text, std::size_t most);

/// A text with blanks up to a width, behind it or (`right`) before it.
[[nodiscard]] std::string padded(const std::string& text, std::size_t to, bool right);

}  // namespace gumcert::reports
