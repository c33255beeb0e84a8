#pragma once

#include <string>
#include <string_view>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

/// The note of a result that constants alone define.
inline constexpr std::string_view k_exact_by_definition =
    "exact, by definition: all quantities that it depends on are stated as constants";

/// Whether everything that a result depends on is without uncertainty at a point, so that u = 0 was said on purpose. A
/// result of implicit equations depends on all of them.
[[nodiscard]] bool is_exact_by_definition(const Budget& budget, const BudgetPointResult& point,
                                          const std::string& output);

/// Where the law of propagation gives u = 0: an exact result keeps U = 0 and says so, without k. Where inputs have
/// uncertainties that cancel (y = a - a) or that the equation does not let through (0*a), nothing is stated in place
/// of them: no k and no U.
void state_zero_uncertainty(const Budget& budget, const BudgetPointResult& point, const std::string& output,
                            BudgetOutputResult& result);

/// What is said of it; GC-BUDGET-0029 a warning, -0028 a note for an exact result.
/// \param where  of the result
[[nodiscard]] Diagnostic zero_uncertainty_message(const BudgetOutputResult& result, const std::string& where);

}  // namespace gumcert::gum
