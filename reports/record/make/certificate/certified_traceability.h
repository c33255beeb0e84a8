#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Whether the standards of a certificate and its budgets name the same standards: a standard is named by the `source`
/// of an input, with its identification, the number of its certificate or its name. Findings T06: major where none of
/// them is, minor for each one that is not. Nothing without standards, or where the record has no budget with inputs of
/// its own (rotary tables state standards as files).
[[nodiscard]] std::vector<certificate::Finding> traceability_findings(const reports::EvaluationRecord& record);

}  // namespace gumcert::reports
