#pragma once

#include <Eigen/Core>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

constexpr std::size_t k_most_drawn_together = 500;  ///< results at points, where the trials give their covariance

/// Covariance of all results as they are reported, points one after the other: coherent SI.
///
/// Where every result is that of the law of propagation: budget_covariance. Where one is reported by Monte Carlo, the
/// law does not hold for it: correlations are those of the trials, beside the standard uncertainties that are reported.
/// Points are drawn together, so that what they have in common is equal. A result whose distribution has no variance
/// has NaN in its row and column.
/// \return empty where Monte Carlo gives none: more results at points than k_most_drawn_together, or a trial without a
/// finite value
[[nodiscard]] Eigen::MatrixXd reported_covariance(const Budget& budget, const BudgetResult& result);

/// Whether reported_covariance is that of trials.
[[nodiscard]] bool has_result_of_trials(const BudgetResult& result);

/// What a reader of the covariance has to know: that it comes from trials, which results it leaves out, or why there is
/// none.
void note_covariance(const Budget& budget, const Eigen::MatrixXd& covariance, BudgetResult& result);

}  // namespace gumcert::gum
