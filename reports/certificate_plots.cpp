#include "reports/certificate_plots.h"

#include <cstddef>
#include <string>

namespace gumcert::reports {

Plot error_motion_plot(const RotaryTable& rotary, const Wording& words) {
    Plot plot{.id = "plot-errors",
              .title = words("plot", "errors_title").first(),
              .description = words("plot", "errors_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 2,
              .panel_height = 150.0};
    for (std::size_t i = 0; i < 6; ++i) {  // the linear three fill the left column, the angular three the right one
        PlotSeries series{
            .label = "", .points = {}, .marker = PlotMarker::disc, .bars = PlotBars::band, .joined = true};
        for (const ErrorsAtAngle& at : rotary.errors) {
            series.points.push_back({.x = at.angle_deg, .y = at.errors[i].value, .U = at.errors[i].U});
        }
        const std::string unit = i < 3 ? "µm" : "″";
        plot.panels.push_back({.heading = rotary.error_names[i],
                               .y_label = rotary.error_names[i] + " / " + unit,
                               .series = {series},
                               .limits = {}});
    }
    return plot;
}

}  // namespace gumcert::reports
