#pragma once

#include <vector>

#include "app/assigned_value.h"
#include "app/laboratory_data.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// Scores of all results of one item in one round against its assigned value.
///
/// u_D and U_D take the correlation of a result with the assigned value into account where it is known (AssignedValue).
/// The reference laboratory has a difference of 0 by definition, and no score. E_n with findings corrected has U'_D² =
/// U_D² + (1 − w)² (U'² − U²), w the weight of the result: the assigned value stays as it is.
/// \param evaluation  of the item, complete
[[nodiscard]] std::vector<reports::ComparisonPoint> laboratory_scores(
    const engine::ComparisonJob& job, const LaboratoryData& data, const AssignedValue& assigned,
    const reports::ComparisonItemEvaluation& evaluation);

}  // namespace gumcert::app
