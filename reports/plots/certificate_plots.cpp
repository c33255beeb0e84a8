#include "reports/plots/certificate_plots.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

/// The value at the first angle again a turn later, where the angles cover the circle.
void close_turn(std::vector<PlotPoint>& points, bool is_full) {
    if (is_full && points.size() > 2) {
        PlotPoint first = points.front();
        first.x += 360.0;
        points.push_back(first);
    }
}

PlotSeries sense_series(const SenseCurve& curve, std::size_t motion, bool is_full, const Wording& words) {
    const bool up = curve.direction == "+";
    PlotSeries series{.label = words("plot", up ? "sense_up_key" : "sense_down_key").first(),
                      .points = {},
                      .marker = PlotMarker::none,
                      .bars = PlotBars::none,
                      .joined = true,
                      .dashed = !up};
    for (const SensePoint& p : curve.points) {
        series.points.push_back({.x = p.angle_deg, .y = p.value[motion], .U = 0.0});
    }
    close_turn(series.points, is_full);
    return series;
}

/// The expanded uncertainty itself: a band of it can be too thin to be seen.
std::vector<PlotSeries> strip_of(const RotaryTable& rotary, std::size_t motion, bool is_full) {
    PlotSeries U{.label = "", .points = {}, .marker = PlotMarker::none, .joined = true};
    for (const ErrorsAtAngle& at : rotary.errors) {
        U.points.push_back({.x = at.angle_deg.number, .y = at.errors[motion].U, .U = 0.0});
    }
    close_turn(U.points, is_full);
    std::vector<PlotSeries> strip = {U};
    if (!rotary.sense_curves.empty()) {
        PlotSeries sense{.label = "", .points = {}, .marker = PlotMarker::none, .joined = true, .dashed = true};
        for (const SensePoint& p : rotary.sense_curves.front().points) {
            sense.points.push_back({.x = p.angle_deg, .y = p.U[motion], .U = 0.0});
        }
        close_turn(sense.points, is_full);
        strip.push_back(std::move(sense));
    }
    return strip;
}

}  // namespace

bool covers_circle(const RotaryTable& rotary) {
    double gap = 0.0;
    for (std::size_t i = 1; i < rotary.errors.size(); ++i) {
        gap = std::max(gap, rotary.errors[i].angle_deg.number - rotary.errors[i - 1].angle_deg.number);
    }
    return rotary.errors.size() > 2 &&
           rotary.errors.front().angle_deg.number + 360.0 - rotary.errors.back().angle_deg.number <= 1.5 * gap;
}

Plot error_motion_plot(const RotaryTable& rotary, const Wording& words) {
    const bool is_full = covers_circle(rotary);
    const bool by_sense = !rotary.sense_curves.empty();
    Plot plot{.id = "plot-errors",
              .title = words("plot", "errors_title").first(),
              .description = words("plot", by_sense ? "errors_by_sense_description" : "errors_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 3,
              .panel_height = 120.0,
              .strip_height = 28.0};
    // Panels fill column by column: the motions along and about one coordinate stand below each other.
    for (const std::size_t i : {0U, 3U, 1U, 4U, 2U, 5U}) {
        PlotSeries mean{.label = by_sense ? words("plot", "mean_band_key").first() : "",
                        .points = {},
                        .marker = by_sense ? PlotMarker::none : PlotMarker::disc,
                        .bars = PlotBars::band,
                        .joined = !by_sense};
        for (const ErrorsAtAngle& at : rotary.errors) {
            mean.points.push_back({.x = at.angle_deg.number, .y = at.errors[i].value, .U = at.errors[i].U});
        }
        close_turn(mean.points, is_full);
        const std::string unit = i < 3 ? "µm" : "″";
        PlotPanel panel{.heading = rotary.error_names[i],
                        .y_label = rotary.error_names[i] + " / " + unit,
                        .series = {mean},
                        .limits = {},
                        .strip = strip_of(rotary, i, is_full),
                        .strip_label = words("plot", by_sense ? "strip_by_sense" : "strip").first() + " / " + unit};
        for (const SenseCurve& curve : rotary.sense_curves) {
            panel.series.push_back(sense_series(curve, i, is_full, words));
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

}  // namespace gumcert::reports
