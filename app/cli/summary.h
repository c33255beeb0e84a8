#pragma once

#include "reports/record/evaluation_record.h"

namespace gumcert::cli {

/// Headline numbers of a record, for the terminal.
void print_summary(const reports::EvaluationRecord& record);

}  // namespace gumcert::cli
