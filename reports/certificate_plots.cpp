#include "reports/certificate_plots.h"

#include "reports/certificate_view.h"

#include <array>
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

Plot En_plot(const Comparison& comparison, const Wording& words) {
    Plot plot{.id = "plot-en",
              .title = words("plot", "En_title").first(),
              .description = words("plot", "En_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 180.0};
    PlotPanel panel{.heading = "", .y_label = words("label", "En").first(), .series = {}, .limits = {}};
    panel.limits = {{-1.0, "\u22121 " + words("label", "En_limit").first()},
                    {1.0, "+1 " + words("label", "En_limit").first()}};
    static constexpr std::array<const char*, 3> k_directions = {"x", "y", "z"};
    static constexpr std::array<PlotMarker, 3> k_markers = {PlotMarker::disc, PlotMarker::square, PlotMarker::triangle};
    for (std::size_t i = 0; i < 3; ++i) {
        PlotSeries series{.label = k_directions[i], .points = {}, .marker = k_markers[i]};
        for (const ComparisonPoint& p : comparison.points) {
            if (p.direction == k_directions[i]) {
                series.points.push_back({.x = p.angle_deg, .y = p.En, .U = 0.0});
            }
        }
        if (!series.points.empty()) {
            panel.series.push_back(series);
        }
    }
    plot.panels.push_back(panel);
    return plot;
}

Plot displacement_plot(const Comparison& comparison, const Wording& words) {
    Plot plot{.id = "plot-displacement",
              .title = words("plot", "displacement_title").first(),
              .description = words("plot", "displacement_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 120.0};
    for (const char* direction : {"x", "y", "z"}) {
        PlotSeries measured{.label = words("label", "measured").first(),
                            .points = {},
                            .marker = PlotMarker::disc,
                            .bars = PlotBars::bars,
                            .joined = true,
                            .shift = -1.5};
        PlotSeries reference{.label = shortened(printable(comparison.reference_name), 40),
                             .points = {},
                             .marker = PlotMarker::square,
                             .bars = PlotBars::bars,
                             .joined = false,
                             .shift = 1.5};
        for (const ComparisonPoint& p : comparison.points) {
            if (p.direction == direction) {
                measured.points.push_back({.x = p.angle_deg, .y = p.value, .U = p.U});
                reference.points.push_back({.x = p.angle_deg, .y = p.reference_value, .U = p.reference_U});
            }
        }
        if (!measured.points.empty()) {
            const std::string name = words.filled("plot", "direction", {{"direction", direction}}).first();
            plot.panels.push_back({.heading = name,
                                   .y_label = std::string(direction) + " / µm",
                                   .series = {measured, reference},
                                   .limits = {}});
        }
    }
    return plot;
}

}  // namespace gumcert::reports
