#pragma once

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

/// The business rules above the schema (docs/digital_certificate.md), GC-DCC-0101 … -0111, in the order of the rules
/// and then of the document.
[[nodiscard]] std::vector<gum::Diagnostic> business_rule_breaches(const XmlElement& root, const std::string& file);

/// Parts that the schema demands of every DCC and that are missing, GC-DCC-0112; for version 3.0, of which
/// schema_breaches() knows nothing.
[[nodiscard]] std::vector<gum::Diagnostic> missing_parts(const XmlElement& root, const std::string& file);

}  // namespace gumcert::reports
