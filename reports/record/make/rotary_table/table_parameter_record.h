#pragma once

#include <string>

#include "engine/rotary_table/table_parameters.h"
#include "gum/propagation.h"
#include "gum/rotary_table/positioning_scope.h"
#include "reports/record/evaluation_record.h"
#include "reports/record/make/rotary_table/document_units.h"

namespace gumcert::reports {

/// One output of a model in the unit of the document.
[[nodiscard]] reports::TableParameter table_parameter(const gum::UncertaintyBudget& propagation, Eigen::Index index,
                                                      const DocumentUnit& unit, const std::string& name,
                                                      const std::string& description);

/// What a record holds of the quantities derived from the error motions: ranges (ISO 230-7), the axis average line
/// in the frame of the fixture, accuracy and repeatability of positioning (ISO 230-2).
/// \param parameters  law of propagation of `model`
/// \param scope       which parameters of ISO 230-2 are stated
void fill_table_parameters(reports::RotaryTable& rotary, const engine::TableParameterModel& model,
                           const engine::RotaryTableMeasurement& measurement, const gum::UncertaintyBudget& parameters,
                           const gum::PositioningScope& scope);

}  // namespace gumcert::reports
