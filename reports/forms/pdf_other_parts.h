#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace gumcert::reports {

/// A text that programs show, copy or read aloud, and that no page draws.
struct PdfTextBesidePages {
    const char* what;  ///< "a bookmark"
    std::string text;
    bool replaces = false;  ///< it is taken in place of what a page draws (/ActualText)
};

/// What a PDF has beside the contents of its pages.
struct PdfOtherParts {
    std::string refused;  ///< the first thing by which it may show something else than they say; "" without one
    std::size_t attached_files = 0;    ///< by name; there are no others
    bool has_drawn_signature = false;  ///< a signature has a picture, which may lie over contents
    /// Bookmarks, labels of pages, properties, descriptions, and what signatures say; not those in the contents of pages.
    std::vector<PdfTextBesidePages> texts;
};

/// Annotations other than links, actions wherever they are that do more than to go to a place or to open an address, fields
/// other than those of signatures, layers, files that are attached without a name or to a part, and whatever else a catalog or a
/// page has that is not listed.
/// \throws std::exception of the reader if the file is no PDF, or damaged
[[nodiscard]] PdfOtherParts other_parts_of_pdf(std::string_view pdf);

}  // namespace gumcert::reports
