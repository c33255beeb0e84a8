#pragma once

#include "certificate/certificate_data.h"
#include "reports/document_text.h"
#include "reports/wording.h"

#include <vector>

namespace gumcert::reports {

/// What a certificate states under "deviations" (ISO/IEC 17025:2017, 7.8.2.1 n): those from the method, then the findings
/// of the audit that somebody accepts, with name, date and reason. Empty: none are stated.
[[nodiscard]] std::vector<Text> deviations_in_words(const Wording& words, const certificate::CertificateData& data);

}  // namespace gumcert::reports
