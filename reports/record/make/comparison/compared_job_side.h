#pragma once

#include "jobs/comparison/comparison_job.h"
#include "reports/record/make/comparison/method_side.h"
#include "reports/record/make/comparison/refuted_side.h"

namespace gumcert::reports {

/// One side of a comparison of methods whose values are the deviations of an angle that a job measured: the axial error
/// motion of a rotary table, or one of the two circles of a circle closure.
/// What its evaluation says of itself goes along: warnings, and what refutes it (docs/findings.md, G01 … and C01 …).
/// \param unit  of the comparison, an angle
/// \throws InputError, NoResultError  of the evaluation of the job
[[nodiscard]] MethodSide side_of_job(const jobs::ComparisonSide& side, const gum::Unit& unit,
                                     double coverage_probability, const JobJudges& judges);

/// Brings a side to the datum in which its values have the mean 0: two methods take their zero from different readings,
/// and only what does not depend on it can be compared.
///
/// x' = D x, V' = D V Dᵀ, D = I − 1 1ᵀ/n; u from V', U = k u with the k of the side.
void take_off_mean(MethodSide& side, double coverage_probability);

}  // namespace gumcert::reports
