#pragma once

#include <optional>

#include "engine/curve_fit.h"
#include "engine/job/budget_job.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::app {

/// True where the residuals of a fit without stated uncertainties are zero, or rounding: like readings that are all
/// equal, they say that the scatter is below the resolution, not that there is none.
[[nodiscard]] bool is_without_scatter(const engine::BudgetFit& fit, const engine::CurveFit& solved);

/// The warning that the digits of the data of a fit are lost beside their uncertainty, stated or from the residuals
/// (GC-BUDGET-0034; on a certificate the finding M02); nothing where they are held.
[[nodiscard]] std::optional<gum::Diagnostic> lost_digits_message(const engine::BudgetFit& fit,
                                                                 const engine::CurveFit& solved);

/// The warning of such a fit, GC-BUDGET-0036. On a certificate it is the finding F03.
[[nodiscard]] gum::Diagnostic no_scatter_message(const engine::BudgetFit& fit);

/// True where a fit was to be scaled by residuals that are far smaller than the stated uncertainties (by chance less
/// than once in a hundred fits): a smaller uncertainty would come from luck, or from data that were computed.
[[nodiscard]] bool keeps_stated_uncertainties(const engine::BudgetFit& fit, const engine::CurveFit& solved);

/// The warning that the stated uncertainties hold, GC-BUDGET-0035.
[[nodiscard]] gum::Diagnostic kept_uncertainties_message(const engine::BudgetFit& fit);

}  // namespace gumcert::app
