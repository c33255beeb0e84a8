#pragma once

#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The reported result of an output of a budget with its printed texts, in its unit.
/// \param y  its value by the law of propagation, in that unit
[[nodiscard]] reports::ReportedResult reported_of(const gum::BudgetOutputResult& output, double y,
                                                  const gum::Unit& unit, gum::RoundingMode rounding);

}  // namespace gumcert::reports
