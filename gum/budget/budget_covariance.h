#pragma once

#include <Eigen/Core>

#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

/// Covariance of all results, points one after the other: (points · outputs) square, coherent SI.
///
/// Points are correlated through what they share: inputs that are common to them, and correlated inputs of which some
/// are common and others are stated by the points. These others are independent between points given the common ones:
/// with a common, b stated by the points and r(a, b), two points have cov(b, b') = r² u_b u_b'. The covariance of
/// points follows from that of inputs alone, in whatever order the inputs stand.
[[nodiscard]] Eigen::MatrixXd budget_covariance(const BudgetResult& result);

}  // namespace gumcert::gum
