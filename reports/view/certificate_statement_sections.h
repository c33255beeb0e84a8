#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

// The certified part of a certificate, from its second page on: what the laboratory states and answers for. All take a
// record with certificate data, and print the texts of record.certificate as they are.

/// Findings of the three gates, where they block the issue: on a draft only.
void findings_section(CertificateBuilder& builder, const Wording& words, const certificate::Certificate& certificate);

/// The same, whether they block or not: for the laboratory.
void all_findings(CertificateBuilder& builder, const Wording& words, const certificate::Certificate& certificate);

/// Method with deviations, traceability with the table of standards, conditions (ISO/IEC 17025:2017, 7.8.2.1 f, k, n;
/// 7.8.4.1 b, c).
void method_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// The certified tables with their plots (7.8.2.1 m, p; 7.8.4.1 a, d). Values outside of the accreditation are marked,
/// or left to closing_sections(), as the profile wants it.
void result_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// Statement of uncertainty, conformity, remarks, opinions, results outside of the accreditation and of external
/// providers, amendment (7.8.6, 7.8.7, 7.8.8).
void closing_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

}  // namespace gumcert::reports
