#pragma once

#include <string>

#include "gum/comparison/method_comparison.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Adds to the remarks what the points and the summary of a comparison can and cannot tell, in plain sentences.
/// What they say follows from the numbers of `result`; every number in them is a printed one of the record.
/// \param unit    of the differences, as the record writes it
/// \param record  has the points and the rows of `result`, in their order
void add_method_remarks(const gum::MethodComparison& comparison, const gum::MethodResult& result,
                        const std::string& unit, reports::Comparison& record);

}  // namespace gumcert::reports
