#pragma once

#include <vector>

#include "certificate/certified_results.h"

namespace gumcert::certificate {

// The gates before a certificate is issued. Each looks at what is there and says what an assessor would say.
// docs/findings.md lists every finding. None of them reads a clock: whether a certificate is issued in the future is
// seen where it is issued (certificate/gates/day_of_issue.h).

/// First gate, completeness: ISO/IEC 17025:2017, 7.8.2.1 b to p, 7.8.4.1 a to f, 7.8.6, 7.8.7, 7.8.8 and 7.8.4.3; the
/// order of the dates, persons, validity of method and standards. An item of 7.8.2.1 that is left out with a stored
/// reason (CertificateData::omissions) is an information. Title, page numbers, end mark and the sentence on the items
/// are put on every document by the renderer, and are not looked for here.
[[nodiscard]] std::vector<Finding> completeness_findings(const Certificate& certificate);

/// Of the first gate: the standards used, one by one and against laboratory, item and results (7.8.4.1 c, 6.4, 6.5).
[[nodiscard]] std::vector<Finding> standard_findings(const Certificate& certificate);
/// Of the first gate: what was agreed on for statements of conformity (7.1.3, 7.8.6).
[[nodiscard]] std::vector<Finding> specification_findings(const Certificate& certificate);

/// Second part of the first gate, plausibility: what is filled in and cannot be so. Texts of one field that stand in
/// another one, the laboratory as its own customer, persons in all roles or without name, periods of years, conditions
/// that nature does not have.
[[nodiscard]] std::vector<Finding> plausibility_findings(const Certificate& certificate);

/// Second gate, uncertainty: what can be seen of the statement itself (digits, places, k stated, verdicts that can be
/// decided and that the printed numbers give too). Findings of the audit of the budget are added by the caller.
[[nodiscard]] std::vector<Finding> uncertainty_findings(const Certificate& certificate);

/// Third gate, eligibility for the symbol: accreditation, scope valid on the dates, capabilities that can be used,
/// signatory, routes of traceability, values in scope and not below the capability, mixed results and opinions by the
/// profile. Nothing where the status is not "accredited".
[[nodiscard]] std::vector<Finding> symbol_findings(const Certificate& certificate);
/// Of the third gate: what the scope itself says. Validity, signatories, ranges that limit what was measured,
/// capabilities that can be true.
[[nodiscard]] std::vector<Finding> scope_findings(const Certificate& certificate);

/// Texts that are given in some languages and not in every language of the certificate. The document shows another
/// language in their place.
[[nodiscard]] std::vector<Finding> language_findings(const Certificate& certificate);

/// All of them, the gravest first; sets `findings`, `blocked` and `symbol`. A specimen is not issued, so that nothing
/// blocks it.
/// \param audit  findings of the evaluation, put to those of the gates
/// Example: examples/api/records.cpp
void pass_gates(Certificate& certificate, const std::vector<Finding>& audit = {});

/// Puts what was found later to the findings of a certificate that has passed the gates, the gravest first; a critical
/// one blocks it, and takes the symbol.
void add_findings(Certificate& certificate, const std::vector<Finding>& later);

}  // namespace gumcert::certificate
