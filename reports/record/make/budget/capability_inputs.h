#pragma once

#include "certificate/capability_inputs.h"
#include "gum/budget/evaluate_budget.h"
#include "jobs/budget/budget_job.h"

namespace gumcert::reports {

/// What the evaluation of a budget knows for its certificate: values of the inputs at every point, the distribution of
/// results whose k comes from a convolution, and the trials of those whose U comes from Monte Carlo.
/// \param threads  to draw trials again; 0: as many as the machine has
[[nodiscard]] certificate::CapabilityInputs capability_inputs(const jobs::BudgetJob& job,
                                                              const gum::BudgetResult& result, unsigned threads = 1);

}  // namespace gumcert::reports
