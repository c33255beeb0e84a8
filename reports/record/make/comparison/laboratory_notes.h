#pragma once

#include <string>
#include <vector>

#include "gum/comparison/laboratory_comparison.h"
#include "gum/quantity/diagnostic.h"
#include "jobs/comparison/comparison_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What the numbers of a comparison between laboratories can and cannot tell: sentences for its report. What they say
/// follows from the numbers; the texts of numbers in them are those of the record.
[[nodiscard]] std::vector<std::string> laboratory_remarks(const jobs::ComparisonJob& job,
                                                          const gum::LaboratoryComparison& comparison,
                                                          const reports::Comparison& record);

/// Warnings and notes that follow from the numbers, one of each kind however many items it concerns:
/// GC-COMPARE-0120 results that are not consistent, -0121 z' in place of z, -0122 homogeneity, -0123 stability, -0124
/// consensus against the independent value, -0126 assigned value without uncertainty, -0127 negative weights, -0128 an
/// assigned value too uncertain to clear some results.
[[nodiscard]] std::vector<gum::Diagnostic> laboratory_diagnostics(const jobs::ComparisonJob& job,
                                                                  const gum::LaboratoryComparison& comparison,
                                                                  const reports::Comparison& record);

}  // namespace gumcert::reports
