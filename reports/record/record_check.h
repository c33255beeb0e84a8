#pragma once

#include "reports/record/comparison_check.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What must hold between the parts of a record, so that a document can be made of it: what is named is there, numbers
/// that stand in two places are the same, lists are as long as others say.
/// \param report  called for each breach, with its JSON pointer inside the record
void check_record(const EvaluationRecord& record, const RecordBreach& report);

}  // namespace gumcert::reports
