#pragma once

#include <optional>

#include "engine/curve_fit.h"
#include "gum/budget/budget.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::gum {

/// Probability below which residuals count as far too small for the uncertainties that the data of a fit were given with.
inline constexpr double k_fit_overstated_level = 0.01;

/// True where the residuals of a fit without stated uncertainties are zero, or rounding: like readings that are all
/// equal, they say that the scatter is below the resolution, not that there is none.
[[nodiscard]] bool is_without_scatter(const BudgetFit& fit, const engine::CurveFit& solved);

/// The warning that the digits of the data of a fit are lost beside their uncertainty, stated or from the residuals
/// (GC-BUDGET-0034; on a certificate the finding M02); nothing where they are held.
[[nodiscard]] std::optional<Diagnostic> lost_digits_message(const BudgetFit& fit, const engine::CurveFit& solved);

/// The warning of such a fit, GC-BUDGET-0036. On a certificate it is the finding F03.
[[nodiscard]] Diagnostic no_scatter_message(const BudgetFit& fit);

/// True where a fit was to be scaled by residuals that are far smaller than the stated uncertainties (by chance less
/// than once in a hundred fits): a smaller uncertainty would come from luck, or from data that were computed.
[[nodiscard]] bool keeps_stated_uncertainties(const BudgetFit& fit, const engine::CurveFit& solved);

/// The warning that the stated uncertainties hold, GC-BUDGET-0035.
[[nodiscard]] Diagnostic kept_uncertainties_message(const BudgetFit& fit);

}  // namespace gumcert::gum
