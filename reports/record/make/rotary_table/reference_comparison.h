#pragma once

#include "gum/rotary_table/evaluate_rotary_table.h"
#include "jobs/rotary_table/rotary_table_job.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// Comparison of the error motions with the readings of the reference method of a job: at every point and direction,
/// with the full covariance of the displacement and that of the reference values.
///
/// The reference values are the mean readings, and their covariance that of the indicator: resolution and repeatability
/// of each point apart, the maximum permissible error common to a direction or of each point apart. With a budget of
/// the reference, values, uncertainties and covariance are those of the budget, evaluated at every point.
/// \param displacement  of the contact point, angle by angle, x, y, z, [m]
/// \throws InputError, NoResultError  those of side_of_budget(), covariance_of_stated_correlation() and
///                                    compare_methods()
[[nodiscard]] reports::Comparison reference_comparison(const jobs::RotaryTableJob& job,
                                                       const gum::QuantityUncertainty& displacement);

}  // namespace gumcert::reports
