#pragma once

#include "app/assigned_value.h"
#include "app/laboratory_data.h"
#include "reports/record/comparison_evaluation.h"

namespace gumcert::app {

/// Everything that the record says of one item in one round, except the scores of its results and their pairs.
///
/// u²(X) = u² of the characterisation + s_s² between items + u² of instability           (after ISO 13528:2022, clause
/// 7 and annex B). s_s is always in it: every laboratory has an item of its own, or s_s is 0. Instability is in it only
/// where the check of stability fails by its expanded criterion, for else the difference is one that the repeatability
/// of the check explains; then an uncorrected drift of up to the difference in either direction is taken, u =
/// difference/√3.
/// U(X) = k u(X), k = t_p(ν_eff); as stated where one result, or the job, states it and nothing is added.
/// \throws InputError  GC-COMPARE-0104 a check of items without σ_pt and δ_E; those of gum with the item in `where`
[[nodiscard]] reports::ComparisonItemEvaluation item_evaluation(const engine::ComparisonJob& job,
                                                                const LaboratoryData& data,
                                                                const AssignedValue& assigned);

}  // namespace gumcert::app
