#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// E_n is not above 1, and is for the worst plausible correlation: whether the result agrees cannot be said.
[[nodiscard]] bool agreement_is_open(const ComparisonPoint& point);

/// The report of a job of kind comparison: a page with the answer, the graph and the table of scores first, then
/// everything that is needed to recompute them.
void comparison_report_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// The comparison of a rotary table with its reference method, as a section of its certificate.
void reference_comparison_section(CertificateBuilder& builder, const Wording& words, const Comparison& comparison);

/// Its points with E_n: an annex.
void reference_comparison_points(CertificateBuilder& builder, const Wording& words, const Comparison& comparison);

}  // namespace gumcert::reports
