#pragma once

#include <span>
#include <string>

#include "audit/subject.h"
#include "gum/quantity/diagnostic.h"
#include "reports/dcc/dcc_reader.h"

namespace gumcert::audit {

/// Results of a certificate that are audited; what is beyond is said.
inline constexpr std::size_t k_most_certified_results = 2000;

/// What an audit looks at of a digital calibration certificate, by whomever it was made: one budget a result with an
/// uncertainty, without rows, with value, U, k and p, or u, as they are printed, and with its limits, verdict and decision
/// rule; and the data of the certificate as far as the format states them. A decision rule that is stated in words only
/// cannot be applied here: the sentence about it is in `not_read`, and the verdict is not held against it. Where acceptance
/// limits stand beside a verdict, it is decided by them.
/// \param checks  what is wrong with the document: of imports::check_certificate(). What has a rule of the audit
///                becomes a finding of it, what could not be read a sentence
/// \param name    of the file
[[nodiscard]] AuditSubject subject_of(const reports::ParsedDcc& document, std::span<const gum::Diagnostic> checks,
                                      const std::string& name);

}  // namespace gumcert::audit
