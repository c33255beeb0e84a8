#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {

/// What a PDF/A-3a with an attached DCC must be, as far as it can be seen in the file: header, /ID, no encryption, XMP
/// with part and conformance, output intent, embedded fonts with ToUnicode, attachment with F, UF, AFRelationship and
/// MIME type listed in /AF, no JavaScript, actions or rich media, no LZW, no interpolation, printable annotations,
/// title, language, tags. Empty: nothing found.
/// \param attachment  bytes that the attachment must have; "" = there must be none
[[nodiscard]] std::vector<gum::Diagnostic> check_pdf(std::string_view pdf, std::string_view attachment);

struct CheckedPdf {
    std::vector<gum::Diagnostic> findings;  ///< of check_pdf()
    std::vector<std::string> page_texts;    ///< as of texts_of_pages(); none where there are findings
};
/// The check and the texts of the pages of a PDF that is read once for both.
/// \throws as texts_of_pages()
[[nodiscard]] CheckedPdf check_and_read_pdf(std::string_view pdf, std::string_view attachment);

}  // namespace gumcert::reports
