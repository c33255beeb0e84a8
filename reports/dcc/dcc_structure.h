#pragma once

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

/// What the schema of the version of the document refuses (3.1 to 3.3; nothing is reported for 3.0), in the order of
/// the document: GC-DCC-0112 a part that is missing, -0113 an element that does not belong where it stands, -0114 an
/// attribute, -0115 a text. Signatures, and what is foreign to DCC and D-SI, are not looked into.
[[nodiscard]] std::vector<gum::Diagnostic> schema_breaches(const XmlElement& root, const std::string& file);

}  // namespace gumcert::reports
