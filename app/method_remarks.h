#pragma once

#include <string>
#include <vector>

#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// What the remarks on a comparison of methods need beside its record.
struct MethodFindings {
    std::string unit;                               ///< of the differences, as the record writes it
    bool correlation_unknown = false;               ///< of both methods
    std::vector<double> largest_en_by_chance = {};  ///< a number a row of the summary (gum::Agreement)
    std::vector<double> slope_of_noise =
        {};  ///< a number a row: of the bias line, from noise of reference values alone
    std::vector<double> beyond_covariance = {};  ///< a number a row
    std::vector<bool> worst_has_no_bound = {};   ///< a flag a row: both U are equal somewhere
};

/// Adds to the remarks what the points and the summary of a comparison can and cannot tell, in plain sentences.
/// Every number in them is a printed one of the record.
void add_method_remarks(const MethodFindings& findings, reports::Comparison& record);

}  // namespace gumcert::app
