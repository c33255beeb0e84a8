#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/comparison/comparison_scheme.h"
#include "gum/quantity/unit.h"

namespace gumcert::reports {

/// What every named source contributes to one result of a budget: c_i u(x_i) with its sign, in the unit given.
/// Components of an input count one by one; those without a source are left out.
/// \param point, output  positions in the result
/// \param common_only    only inputs that all points of the table share
[[nodiscard]] std::vector<gum::UncertaintySource> uncertainty_sources(const gum::Budget& budget,
                                                                      const gum::BudgetResult& result,
                                                                      std::size_t point, std::size_t output,
                                                                      const gum::Unit& unit, bool common_only = false);

/// Sources of inputs in which a result is not linear: over x ± u(x) of an input the model departs from c u(x) by more
/// than a twentieth of the u that is reported. First-order terms do not tell what it shares through them.
[[nodiscard]] std::set<std::string> sources_beyond_first_order(const gum::Budget& budget,
                                                               const gum::BudgetResult& result, std::size_t point,
                                                               std::size_t output);

}  // namespace gumcert::reports
