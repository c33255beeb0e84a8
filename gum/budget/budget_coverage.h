#pragma once

#include <Eigen/Core>
#include <string>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"

namespace gumcert::gum {

/// Fills in what the law of propagation says of one output: u, ν_eff, where k comes from, k and U, or why there are
/// none (docs/adr/0014-coverage-of-budgets.md).
/// \param point   with model, propagation and second order
/// \param result with its coverage probability, which is that of the propagation too
void expand_by_propagation(const Budget& budget, const BudgetPointResult& point, Eigen::Index output,
                           BudgetOutputResult& result);

/// A sentence: k is that of the convolution, and what it would be else.
/// \param k  of the t- or normal distribution
[[nodiscard]] std::string convolution_note(double degrees_of_freedom, double k);

}  // namespace gumcert::gum
