#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Scopes whose ranges and capabilities are held against inputs of a budget that are not what was measured (X12): a
/// constant that the author states, another length. Nothing for values outside of the scope.
[[nodiscard]] std::vector<certificate::Finding> measurand_findings(const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
