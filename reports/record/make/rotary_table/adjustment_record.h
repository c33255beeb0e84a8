#pragma once

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/propagation.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// What a record holds of the adjustment itself: stations, dead paths, fixture, global test, variance components,
/// reliability and outlying distances.
/// \param propagation  of the reported quantities
/// \param k  coverage factor of the printed uncertainties of positions
void fill_adjustment(reports::RotaryTable& rotary, const engine::RotaryTableSolution& solution,
                     const engine::RotaryTableMeasurement& measurement, const gum::UncertaintyBudget& propagation,
                     double k);

}  // namespace gumcert::reports
