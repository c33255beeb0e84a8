#pragma once

#include "reports/plots/layout_plot.h"
#include "reports/plots/svg_plot.h"
#include "reports/record/evaluation_record.h"
#include "reports/wording.h"

#include <cstddef>
#include <optional>

namespace gumcert::reports {

constexpr std::size_t k_most_residual_panels = 24;

/// Stations, reflectors at the home angle and the axis; none for records that do not hold where the reflectors stood.
[[nodiscard]] std::optional<LayoutPlot> layout_plot(const RotaryTable& rotary, const Wording& words);

/// The reflectors alone, large enough to tell them apart.
[[nodiscard]] std::optional<LayoutPlot> reflector_plot(const RotaryTable& rotary, const Wording& words);

/// Residuals against the angle, one panel a station, all with the same scale: that of the distances that were kept. The
/// first k_most_residual_panels stations.
[[nodiscard]] Plot station_residual_plot(const RotaryTable& rotary, const Wording& words);

/// How many distances have which redundancy number.
[[nodiscard]] HistogramPlot redundancy_plot(const RotaryTable& rotary, const Wording& words);

/// Shares of the sources in the variance of each quantity.
[[nodiscard]] StackedPlot source_plot(const RotaryTable& rotary, const Wording& words);

}  // namespace gumcert::reports
