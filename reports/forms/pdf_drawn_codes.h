#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// Strings that a page draws one after the other in one font.
struct DrawnCodes {
    std::string font;   ///< its name among the resources of the page, without "/"; empty before the first is chosen
    std::string codes;  ///< bytes of the strings, decoded from their hexadecimal or literal form
};

/// What the content of a page draws as text, in its order (ISO 32000-1:2008, 7.8.2 and 9.4.3: Tf, Tj, TJ, ' and ").
/// Content that ends in the middle of an object ends there; what is no object is passed over.
/// \param content  of one page, without its filters
[[nodiscard]] std::vector<DrawnCodes> drawn_codes(std::string_view content);

/// A text that the content of a page states beside what it draws (ISO 32000-1:2008, 14.9).
struct TextBesideDrawn {
    /// /ActualText, which programs copy and read aloud in place of what is drawn; else /Alt, /E
    bool replaces = false;
    std::string text;
    std::vector<DrawnCodes> drawn = {};  ///< what it is taken in place of: drawn up to the EMC of its BDC
};

/// Texts as they are encoded.
/// \param content  of one page, without its filters
[[nodiscard]] std::vector<TextBesideDrawn> texts_beside_drawn_codes(std::string_view content);

}  // namespace gumcert::reports
