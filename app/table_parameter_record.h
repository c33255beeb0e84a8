#pragma once

#include "engine/table_parameters.h"
#include "gum/propagation.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// What a record holds of the quantities derived from the error motions: ranges (ISO 230-7), location errors of the
/// axis average line, accuracy and repeatability of positioning (ISO 230-2).
/// \param parameters  law of propagation of `model`
void fill_table_parameters(reports::RotaryTable& rotary, const engine::TableParameterModel& model,
                           const engine::RotaryTableMeasurement& measurement, const gum::Propagation& parameters);

}  // namespace gumcert::app
