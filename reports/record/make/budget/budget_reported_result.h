#pragma once

#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/unit.h"
#include "gum/rounding.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The value of a result in its unit, as records hold it: the decimal number that it stands for (gum::settled_decimal).
/// \param si        by the law of propagation
/// \param rounding  of it, BudgetModel::rounding()
[[nodiscard]] double recorded_value(double si, double rounding, const gum::Unit& unit);

/// The reported result of an output of a budget with its printed texts, in its unit.
/// \param y  its value by the law of propagation, in that unit
[[nodiscard]] reports::ReportedResult reported_of(const gum::BudgetOutputResult& output, double y,
                                                  const gum::Unit& unit, gum::RoundingMode rounding);

}  // namespace gumcert::reports
