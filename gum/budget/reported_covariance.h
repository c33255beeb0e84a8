#pragma once

#include <Eigen/Core>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

constexpr std::size_t k_most_drawn_together = 500;  ///< results whose covariance the trials give

/// Covariance of all results as they are reported, points one after the other: coherent SI.
///
/// Of two results that the law of propagation gives: J V Jᵀ (JCGM 100:2008, 5.2.2; JCGM 102:2011, 6.2), whatever other
/// results there are. Where one of them is reported by Monte Carlo, the law does not hold for it: it is taken apart into
/// what is linear in its inputs, b·(x − x̂)/σ with b from their covariance in the trials, and a remainder that has none
/// with them. The linear parts enter J V Jᵀ like sensitivity coefficients; of two remainders the trials give the
/// covariance. The sum is scaled to the standard uncertainties that are reported. So two results without a common input,
/// or correlated ones, have exactly 0, and the whole is positive semi-definite: what is left out of the remainders for
/// that makes it miss this by the noise of the trials at most, and is taken back by the same factor of all remainders.
///
/// Points are drawn together, so that what they have in common is equal. An input whose distribution has no variance has
/// no linear part: the correlation with it tends to 0. A result of Monte Carlo has NaN in its row and column where its
/// distribution has no variance, where there are more of them than k_most_drawn_together, or where a trial has no finite
/// value.
///
/// Accuracy: some 1/√M of the remainder of a result for its coefficients of correlation, M = 10⁶ of one point, 200 000 of several,
/// 80 000 for 500 results.
[[nodiscard]] Eigen::MatrixXd reported_covariance(const Budget& budget, const BudgetResult& result);

/// Whether reported_covariance is that of trials.
[[nodiscard]] bool has_result_of_trials(const BudgetResult& result);

/// What a reader of the covariance has to know: which results it leaves out, and why.
/// \param covariance  of all results, as reported_covariance gives it
void note_covariance(const Budget& budget, const Eigen::MatrixXd& covariance, BudgetResult& result);

}  // namespace gumcert::gum
