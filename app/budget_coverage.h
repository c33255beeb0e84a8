#pragma once

#include <Eigen/Core>

#include "app/evaluate_budget.h"
#include "engine/job/budget_job.h"

namespace gumcert::app {

/// Fills in what the law of propagation says of one output: u, ν_eff, where k comes from, k and U, or why there are
/// none (docs/adr/0014-coverage-of-budgets.md). \param point   with model, propagation and second order \param result
/// with its coverage probability, which is that of the propagation too
void expand_by_propagation(const engine::BudgetJob& job, const BudgetPointResult& point, Eigen::Index output,
                           BudgetOutputResult& result);

}  // namespace gumcert::app
