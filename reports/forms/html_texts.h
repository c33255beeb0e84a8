#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// The text of an HTML page as a reader sees it, whichever template it was made with: without head, style, scripts, comments
/// and drawings, references replaced, a blank in place of each tag but of those within a line. Texts that a style sheet puts
/// on the page are left out. Of a page that hidden_part_of_html() finds nothing in.
[[nodiscard]] std::string text_of_html(std::string_view html);

/// What a page is made of, as one text: its tags with all attributes, and its texts, also those of head, style and drawings.
/// Pages that have the same show the same. Left out: comments, blanks between words and tags, and how quotes and
/// characters are written.
[[nodiscard]] std::string structure_of_html(std::string_view html);

/// The first thing in a page of HTML that may show a reader something else than text_of_html() has: attributes and style
/// sheets that hide or cover, elements that do more than to show their contents, texts that only a style sheet shows,
/// raised and lowered digits that stand behind digits as if they were one number, characters that are not seen. "" where nothing was found. Pictures are not looked at.
/// \param style  sheet of the templates, of which every block is known
[[nodiscard]] std::string hidden_part_of_html(std::string_view html, std::string_view style);

/// The languages that a page is in: that of its root, and those of the texts beside them, each once.
[[nodiscard]] std::vector<std::string> languages_of_html(std::string_view html);

/// Whether a page has the style sheet of the templates and no other.
[[nodiscard]] bool has_style_of(std::string_view html, std::string_view style);

}  // namespace gumcert::reports
