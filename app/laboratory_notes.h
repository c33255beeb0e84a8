#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "app/laboratory_summary.h"
#include "gum/quantity/diagnostic.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// What a record leaves out, beside what can be seen in it.
struct LeftOut {
    std::size_t vectors = 0;  ///< with a singular covariance
    bool pairs = false;       ///< too many of all items together
};

/// What the numbers of a comparison between laboratories can and cannot tell: sentences for its report.
[[nodiscard]] std::vector<std::string> laboratory_remarks(const engine::ComparisonJob& job,
                                                          const reports::Comparison& comparison,
                                                          const std::vector<EvaluatedItem>& items,
                                                          const LeftOut& left_out);

/// Warnings and notes that follow from the numbers, one of each kind however many items it concerns:
/// GC-COMPARE-0120 results that are not consistent, -0121 z' in place of z, -0122 homogeneity, -0123 stability, -0124
/// consensus against the independent value, -0126 assigned value without uncertainty, -0127 negative weights.
[[nodiscard]] std::vector<gum::Diagnostic> laboratory_diagnostics(const reports::Comparison& comparison);

}  // namespace gumcert::app
