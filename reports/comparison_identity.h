#pragma once

#include "reports/document_text.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

#include <string>

namespace gumcert::reports {

/// Who issues a comparison report, and under which number and date. "" where the job does not say it.
struct ComparisonIdentity {
    Text laboratory;
    std::string number;
    std::string issued;  ///< "2026-11-21"
};

/// From the certificate data of the record, or of its job.
[[nodiscard]] ComparisonIdentity comparison_identity(const EvaluationRecord& record, const Wording& words);

}  // namespace gumcert::reports
