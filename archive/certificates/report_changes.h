#pragma once

#include <vector>

#include "certificate/certified_results.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::archive {

/// What the report of a comparison says otherwise than an earlier one, place by place of its record: each text whole, each element
/// of each list, and a number as it is printed. All of it, for the list of an amendment is the statement of what has changed
/// (ISO/IEC 17025:2017, 7.8.8.1), and one that ends somewhere would say that nothing else has.
///
/// Left out are number, date and amendment of the report, which are those of the amendment itself, and what tells whose result is
/// whose where the later report does not: a list of changes goes to every participant with the evidence, and out of a log nothing
/// is removed.
[[nodiscard]] std::vector<certificate::Change> changes_of_report(const reports::EvaluationRecord& earlier,
                                                                 const reports::EvaluationRecord& later);

}  // namespace gumcert::archive
