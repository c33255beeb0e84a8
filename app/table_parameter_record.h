#pragma once

#include <string>

#include "engine/table_parameters.h"
#include "gum/propagation.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// What a record holds of the quantities derived from the error motions: ranges (ISO 230-7), location errors of the
/// axis average line, accuracy and repeatability of positioning (ISO 230-2).
/// \param parameters  law of propagation of `model`
void fill_table_parameters(reports::RotaryTable& rotary, const engine::TableParameterModel& model,
                           const engine::RotaryTableMeasurement& measurement, const gum::Propagation& parameters);

/// True for the parameters of ISO 230-2 that rest on standard deviations of runs: R, R_up, A …. Monte Carlo would add
/// the noise of the distances a second time to deviations that hold it already, and make them larger than they are.
[[nodiscard]] bool rests_on_scatter(const std::string& short_name);

}  // namespace gumcert::app
