#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What the fits and the repeated readings of a record give reason to say, as messages of the evaluation:
/// GC-BUDGET-0030 readings that depend on each other, -0031 an outlier among them, -0032 a fit whose uncertainties
/// chi-square refutes, -0033 one whose residuals are far too small for them (a note). One message for all points of one
/// input.
[[nodiscard]] std::vector<gum::Diagnostic> budget_remarks(const reports::EvaluationRecord& record);

/// The same as findings of a certificate: F01 a refuted fit (critical where the certificate is accredited), F02
/// residuals far too small, A01 an outlier, A02 readings that depend on each other; and, from messages of the record,
/// M01 Celsius temperatures in products and quotients, M02 digits that were lost (docs/findings.md).
[[nodiscard]] std::vector<certificate::Finding> budget_findings(const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
