#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// The declaration blocks of a style sheet, each as one text with what it stands in, such as "@media print|p{margin:0}";
/// comments left out, one blank for several. What is left over, such as a stray brace, is a block as well. Pages whose sheets
/// have the same blocks in the same order are shown alike.
[[nodiscard]] std::vector<std::string> style_blocks(std::string_view sheet);

/// Whether a block, as style_blocks() gives it, leaves what it is of where it is, and to be seen: it has listed properties with
/// listed words and lengths within limits, and no rule with '@' but media, no address, no quotes but of a listed font, no
/// colour but black of lines.
[[nodiscard]] bool is_plain_block(std::string_view block);

/// The same of one declaration, such as "margin: 0".
/// \param of_picture  it is of an element that has no text, and may be as narrow as one likes
[[nodiscard]] bool is_plain_declaration(std::string_view declaration, bool of_picture = false);

}  // namespace gumcert::reports
