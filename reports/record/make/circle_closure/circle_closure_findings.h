#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What the tests of a circle closure give reason to say, as messages of the evaluation: GC-CLOSURE-0020 the residuals
/// refute the stated repeatability, -0021 the misfit of the model is larger than the scatter of repetitions, -0022 an
/// outlying reading, -0023 series that do not close, -0024 nothing is known of a drift in common. Nothing of a record
/// of another kind.
/// \param states_drift  an effect of the job acts on the turn
[[nodiscard]] std::vector<gum::Diagnostic> circle_closure_remarks(const reports::EvaluationRecord& record,
                                                                  bool states_drift);

/// The same as findings of a certificate, from the messages of the record: C01 to C05 (docs/findings.md).
[[nodiscard]] std::vector<certificate::Finding> circle_closure_findings(const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
