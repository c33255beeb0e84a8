#pragma once

#include <string>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The headline numbers of a record on a few lines, in English, as they stand in the record: results with their expanded
/// uncertainties; of a comparison the assigned values and scores, of a rotary table set-up, ranges and adjustment.
[[nodiscard]] std::string summary_text(const EvaluationRecord& record);

}  // namespace gumcert::reports
