#pragma once

#include <string>
#include <string_view>

namespace gumcert::reports {

/// The text of an HTML page as a reader sees it, whichever template it was made with: without head, style, scripts, comments
/// and drawings, references replaced, a blank in place of each tag. Texts that a style sheet puts on the page (attribute
/// data-text) stand where their element does.
[[nodiscard]] std::string text_of_html(std::string_view html);

}  // namespace gumcert::reports
