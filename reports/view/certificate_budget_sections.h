#pragma once

#include "reports/record/evaluation_record.h"
#include "reports/view/certificate_builder.h"
#include "reports/wording.h"

namespace gumcert::reports {

// The sections of a record whose results come from a measurement model.

/// The results with the sentences on their coverage. A certificate states them in its certified part instead, see
/// result_sections().
void budget_results(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// How the results came about: the model, budgets in the layout of JCGM 100:2008, table H.1, and, where the record
/// holds them, second-order terms, Monte Carlo, covariances and coverage region, fits, readings and analyses of
/// variance.
void budget_sections(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

/// The budgets alone, as tables.
void budget_tables(CertificateBuilder& builder, const Wording& words, const EvaluationRecord& record);

}  // namespace gumcert::reports
