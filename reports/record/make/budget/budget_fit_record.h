#pragma once

#include <Eigen/Core>
#include <vector>

#include "engine/curve_fit.h"
#include "gum/quantity/unit.h"
#include "jobs/budget/budget_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Probability below which chi-square refutes the uncertainties that the data of a fit were given with
/// (ISO/TS 28037:2010 wants the test before a fit is used).
inline constexpr double k_fit_test_level = 0.05;

/// A fit of a job as its record holds it: parameters, covariance, test of chi-square, the data with their
/// uncertainties and residuals. In the units of the job.
[[nodiscard]] reports::FitSummary fit_summary(const gum::BudgetFit& fit, const engine::CurveFit& solved);

/// What a fit contributes to a result: one row for all its parameters with their covariances; inside, what comes from
/// each column of the data (their squares add up to it), and the parameters.
///
/// \param sensitivity  ∂y/∂a, one a parameter, coherent SI; parameters with 0 everywhere but one stand for that one
/// \param result_unit  unit of the result
/// \param result_u     its standard uncertainty of the first order, coherent SI
[[nodiscard]] reports::BudgetRow fit_row(const gum::BudgetFit& fit, const engine::CurveFit& solved,
                                         const Eigen::VectorXd& sensitivity, const gum::Unit& result_unit,
                                         double result_u);

}  // namespace gumcert::reports
