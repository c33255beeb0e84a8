#pragma once

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "reports/dcc/xml_document.h"

namespace gumcert::reports {

/// Statements of a certificate that contradict each other, in the order of the document: GC-DCC-0116 a conformity that
/// the limits beside it refute, -0117 a coverage factor that the distribution and the probability beside it do not
/// give, -0118 a unit that D-SI does not know.
[[nodiscard]] std::vector<gum::Diagnostic> contradicting_statements(const XmlElement& root, const std::string& file);

}  // namespace gumcert::reports
