#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "app/method_comparison.h"
#include "app/method_side.h"
#include "engine/job/comparison_job.h"

namespace gumcert::app {

/// Covariance of two methods, cov(method i, reference j), from one coefficient r that is stated for equal points.
///
/// An effect of each point apart, C_ii = r u_i u_ref,i, counts the points least. Where the points of the methods share
/// so much that this cannot be, it is an effect that points share, C_ij = r u_i u_ref,j.
/// \param comparison   the covariance of each method is taken from it
/// \param may_share    one a point: only points with the same name share such an effect
/// \param where        place of r in the job, for messages
/// \param remarks      receives which of both it is
/// \throws InputError  GC-COMPARE-0204 neither can be
[[nodiscard]] Eigen::MatrixXd covariance_of_stated_correlation(double r, const MethodComparison& comparison,
                                                               const std::vector<std::string>& may_share,
                                                               const std::string& where,
                                                               std::vector<std::string>& remarks);

/// What the job says of the correlation of both methods: none, a number, unknown, or through the sources that both
/// budgets name. Fills the cross covariance of the comparison, and the record and its remarks with what was found.
/// \throws InputError  GC-COMPARE-0204, -0207 what both budgets say of a source cannot hold together
void add_correlation(const engine::ComparisonJob& job, const MethodSide& method, const MethodSide& reference,
                     MethodComparison& comparison, reports::Comparison& record);

}  // namespace gumcert::app
