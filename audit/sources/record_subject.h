#pragma once

#include <cstddef>
#include <optional>
#include <string>

#include "audit/subject.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::audit {

/// What an audit looks at of a record of ours: one budget a result, with the statements of its inputs from the job that
/// the record holds, capability and limits from its certificate, and the scores of a comparison.
///
/// Where a result is that of Monte Carlo, its k is U/u of what is reported. Contributions of correlations are kept as
/// they were evaluated.
/// \param name            of the file
/// \param compared_point  position of the point of a comparison at which the budgets of its sides are looked at; none: the
///                        one with the largest |E_n|
[[nodiscard]] AuditSubject subject_of(const reports::EvaluationRecord& record, const std::string& name,
                                      std::optional<std::size_t> compared_point = {});

}  // namespace gumcert::audit
