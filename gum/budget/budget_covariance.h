#pragma once

#include <Eigen/Core>
#include <vector>

#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

/// Covariance of all results, points one after the other: (points · outputs) square, coherent SI.
///
/// Points are correlated through what they share: inputs that are common to them, and correlated inputs of which some
/// are common and others are stated by the points. These others are independent between points given the common ones:
/// with a common, b stated by the points and r(a, b), two points have cov(b, b') = r² u_b u_b'. The covariance of
/// points follows from that of inputs alone, in whatever order the inputs stand.
[[nodiscard]] Eigen::MatrixXd budget_covariance(const BudgetResult& result);

/// The same for other sensitivity coefficients than those of the law of propagation.
/// \param jacobians  one a point, of the size of its own
[[nodiscard]] Eigen::MatrixXd budget_covariance(const BudgetResult& result,
                                                const std::vector<Eigen::MatrixXd>& jacobians);

}  // namespace gumcert::gum
