#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "gum/comparison/method_correlation.h"
#include "jobs/comparison/comparison_job.h"
#include "reports/record/make/comparison/method_side.h"

namespace gumcert::reports {

/// The covariance of gum::stated_correlation().
/// \param remarks  receives what the coefficient is taken to come from
/// \throws InputError  GC-COMPARE-0204
[[nodiscard]] Eigen::MatrixXd covariance_of_stated_correlation(double r, const gum::MethodComparison& comparison,
                                                               const std::vector<std::string>& may_share,
                                                               const std::string& where,
                                                               std::vector<std::string>& remarks);

/// What the job says of the correlation of both methods: none, a number, unknown, or through the sources that both
/// budgets name. Fills the cross covariance of the comparison, and the record and its remarks with what was found.
/// \throws InputError  GC-COMPARE-0204, -0207 what both budgets say of a source cannot hold together
void add_correlation(const jobs::ComparisonJob& job, const MethodSide& method, const MethodSide& reference,
                     gum::MethodComparison& comparison, reports::Comparison& record);

}  // namespace gumcert::reports
