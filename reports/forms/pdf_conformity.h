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

}  // namespace gumcert::reports
