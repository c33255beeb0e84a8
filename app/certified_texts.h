#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Puts the printed texts of the certified tables in place of those that the record had: a value that stands in two
/// places of a document reads the same in both. Unrounded numbers stay as they are.
void print_as_certified(reports::EvaluationRecord& record, const std::vector<certificate::CertifiedTable>& tables);

}  // namespace gumcert::app
