#pragma once

#include "reports/plots/polar_plot.h"
#include "reports/plots/svg_plot.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

namespace gumcert::reports {

// Plots of what a record holds of a rotary table beside its results. Each caller looks first whether the record has it.

/// Deviations of the runs, means of both senses and mean ± 2s, as ISO 230-2 draws them.
[[nodiscard]] Plot positioning_plot(const RotaryTable& rotary, const Wording& words);

/// The six error motions about base circles.
[[nodiscard]] PolarPlot error_polar_plot(const RotaryTable& rotary, const Wording& words);

/// Deviations of all visits in the order of the measurement, with their limits and the changes of station.
[[nodiscard]] Plot visit_plot(const RotaryTable& rotary, const Wording& words);

/// Axial rotation of the table in the single visits against the angle, one panel a station.
[[nodiscard]] Plot visit_scatter_plot(const RotaryTable& rotary, const Wording& words);

/// Temperatures of fixture and air at the stations, beside the reference temperature.
[[nodiscard]] Plot temperature_plot(const Environment& environment, const Wording& words);

}  // namespace gumcert::reports
