#pragma once

#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/unit.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The value of a result in its unit, as records hold it: the decimal number that it stands for (gum::settled_decimal).
/// \param si        by the law of propagation
/// \param rounding  of it, BudgetModel::rounding()
[[nodiscard]] double recorded_value(double si, double rounding, const gum::Unit& unit);

/// The reported result of an output of a budget with its printed texts, in its unit.
/// A result of Monte Carlo has the digits that were asked for, and no more than its trials hold: half a unit of the last
/// one is no smaller than the numerical error (JCGM 101:2008, 7.9.2). One digit is taken from 3 on, and U is then rounded
/// upwards.
/// \param y       its value by the law of propagation, in that unit
/// \param budget  how it wants U rounded, and the digits that it asks of Monte Carlo
[[nodiscard]] reports::ReportedResult reported_of(const gum::BudgetOutputResult& output, double y,
                                                  const gum::Unit& unit, const gum::Budget& budget);

}  // namespace gumcert::reports
