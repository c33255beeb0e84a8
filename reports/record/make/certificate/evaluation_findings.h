#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What an evaluation has found against its own result: readings against the pool they are said to come from, residuals of
/// an adjustment against the uncertainties (findings F, G and C of docs/findings.md). Of every record, certified or not.
[[nodiscard]] std::vector<certificate::Finding> evaluation_findings(const EvaluationRecord& record);

}  // namespace gumcert::reports
