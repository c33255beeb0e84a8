#include "reports/plots/rotary_evidence_plots.h"

#include "reports/plots/certificate_plots.h"
#include "reports/plots/rotary_plots.h"
#include "reports/printable_text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr std::size_t k_name = 12;        // letters of a station at its mark
constexpr std::size_t k_most_marks = 24;  // of stations; more would cover each other

PlotSeries run_series(const PositioningAccuracy& p, bool up, const Wording& words) {
    PlotSeries series{.label = words("plot", up ? "run_up_key" : "run_down_key").first(),
                      .points = {},
                      .marker = up ? PlotMarker::disc : PlotMarker::ring};
    for (const PositioningTarget& t : p.targets) {
        for (const double v : up ? t.runs_up : t.runs_down) {
            series.points.push_back({.x = t.angle_deg.number, .y = v, .U = 0.0});
        }
    }
    return series;
}

/// The mean of one sense, with ± 2s where there is an s.
void add_sense(PlotPanel& panel, const PositioningAccuracy& p, bool up, const Wording& words) {
    PlotSeries spread{.label = words("plot", up ? "spread_up_key" : "spread_down_key").first(),
                      .points = {},
                      .marker = PlotMarker::none,
                      .bars = up ? PlotBars::band : PlotBars::edges};
    PlotSeries mean{.label = words("plot", up ? "mean_up_key" : "mean_down_key").first(),
                    .points = {},
                    .marker = PlotMarker::none,
                    .bars = PlotBars::none,
                    .joined = true,
                    .dashed = !up};
    for (const PositioningTarget& t : p.targets) {
        const std::optional<double>& middle = up ? t.mean_up.number : t.mean_down.number;
        const std::optional<double>& s = up ? t.s_up.number : t.s_down.number;
        if (middle) {
            mean.points.push_back({.x = t.angle_deg.number, .y = *middle, .U = 0.0});
        }
        if (middle && s) {
            spread.points.push_back({.x = t.angle_deg.number, .y = *middle, .U = 2.0 * *s});
        }
    }
    for (PlotSeries& series : std::array<PlotSeries, 3>{spread, run_series(p, up, words), mean}) {
        if (!series.points.empty()) {
            panel.series.push_back(std::move(series));
        }
    }
}

}  // namespace

Plot positioning_plot(const RotaryTable& rotary, const Wording& words) {
    Plot plot{.id = "plot-positioning",
              .title = words("plot", "positioning_title").first(),
              .description = words("plot", "positioning_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 200.0};
    PlotPanel panel{.heading = "", .y_label = words("plot", "positioning_axis").first(), .series = {}, .limits = {}};
    add_sense(panel, *rotary.iso230_2, true, words);
    add_sense(panel, *rotary.iso230_2, false, words);
    plot.panels.push_back(std::move(panel));
    return plot;
}

PolarPlot error_polar_plot(const RotaryTable& rotary, const Wording& words) {
    PolarPlot plot{.id = "plot-polar",
                   .title = words("plot", "polar_title").first(),
                   .description = words("plot", "polar_description").first(),
                   .is_closed = covers_circle(rotary),
                   .panels = {}};
    for (std::size_t i = 0; i < 6; ++i) {
        PolarPanel panel{.heading = rotary.error_names[i] + (i < 3 ? " / µm" : " / ″"), .points = {}};
        for (const ErrorsAtAngle& at : rotary.errors) {
            panel.points.push_back({.x = at.angle_deg.number, .y = at.errors[i].value, .U = at.errors[i].U});
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

Plot visit_plot(const RotaryTable& rotary, const Wording& words) {
    Plot plot{.id = "plot-visits",
              .title = words("plot", "visits_title").first(),
              .description = words("plot", "visits_description").first(),
              .x_label = words("plot", "visits_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 170.0,
              .x_is_angle = false,
              .x_is_number = true};
    PlotSeries limit{.label = words("plot", "visit_limit_key").first(),
                     .points = {},
                     .marker = PlotMarker::none,
                     .bars = PlotBars::band};
    PlotSeries up{.label = words("plot", "visit_up_key").first(), .points = {}, .marker = PlotMarker::disc};
    PlotSeries down{.label = words("plot", "visit_down_key").first(), .points = {}, .marker = PlotMarker::ring};
    PlotPanel panel{
        .heading = "", .y_label = words("plot", "visits_deviation_axis").first(), .series = {}, .limits = {}};
    std::string station;
    for (std::size_t i = 0; i < rotary.visits.size(); ++i) {
        const VisitRow& visit = rotary.visits[i];
        const auto x = static_cast<double>(i + 1);
        if (i == 0 || visit.station != station) {
            station = visit.station;
            panel.marks.push_back({.x = x, .label = shortened(printable(station), k_name)});
        }
        if (visit.deviation_um) {
            (visit.direction == "+" ? up : down).points.push_back({.x = x, .y = *visit.deviation_um, .U = 0.0});
            limit.points.push_back({.x = x, .y = 0.0, .U = visit.limit_um.value_or(0.0)});
        }
    }
    if (panel.marks.size() > k_most_marks) {
        panel.marks.clear();
    }
    for (PlotSeries& series : std::array<PlotSeries, 3>{limit, up, down}) {
        if (!series.points.empty()) {
            panel.series.push_back(std::move(series));
        }
    }
    plot.panels.push_back(std::move(panel));
    return plot;
}

Plot visit_scatter_plot(const RotaryTable& rotary, const Wording& words) {
    Plot plot{.id = "plot-visit-scatter",
              .title = words("plot", "scatter_title").first(),
              .description = words("plot", "scatter_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 3,
              .panel_height = 70.0};
    double most = 0.0;
    for (const VisitRow& visit : rotary.visits) {
        most = std::max(most, std::abs(visit.axial_arcsec.value_or(0.0)));
    }
    for (const Station& station : rotary.stations) {
        if (plot.panels.size() == k_most_residual_panels) {
            break;
        }
        PlotSeries up{.label = words("plot", "visit_up_key").first(), .points = {}, .marker = PlotMarker::disc};
        PlotSeries down{.label = words("plot", "visit_down_key").first(), .points = {}, .marker = PlotMarker::ring};
        for (const VisitRow& visit : rotary.visits) {
            if (visit.station == station.name && visit.axial_arcsec) {
                (visit.direction == "+" ? up : down)
                    .points.push_back({.x = visit.angle_deg, .y = *visit.axial_arcsec, .U = 0.0});
            }
        }
        PlotPanel panel{.heading = shortened(printable(station.name), 30),
                        .y_label = words("plot", "scatter_axis").first(),
                        .series = {},
                        .limits = {},
                        .y_most = 1.1 * most};
        for (PlotSeries& series : std::array<PlotSeries, 2>{up, down}) {
            if (!series.points.empty()) {
                panel.series.push_back(std::move(series));
            }
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

Plot temperature_plot(const Environment& environment, const Wording& words) {
    Plot plot{.id = "plot-temperatures",
              .title = words("plot", "temperatures_title").first(),
              .description = words("plot", "temperatures_description").first(),
              .x_label = words("plot", "station_number_axis").first(),
              .panels = {},
              .columns = 1,
              .panel_height = 110.0,
              .x_is_angle = false,
              .x_is_number = true,
              .margin = 20.0};
    PlotSeries fixture{.label = words("plot", "fixture_temperature_key").first(),
                       .points = {},
                       .marker = PlotMarker::disc,
                       .bars = PlotBars::bars};
    PlotSeries air{.label = words("plot", "air_temperature_key").first(), .points = {}, .marker = PlotMarker::ring};
    for (std::size_t i = 0; i < environment.stations.size(); ++i) {
        const StationEnvironment& s = environment.stations[i];
        const auto x = static_cast<double>(i + 1);
        fixture.points.push_back(
            {.x = x, .y = s.fixture_degC.number - environment.reference_degC.number, .U = 2.0 * s.u_fixture_K.number});
        if (s.air_degC.number) {
            air.points.push_back({.x = x, .y = *s.air_degC.number - environment.reference_degC.number, .U = 0.0});
        }
    }
    PlotPanel panel{
        .heading = "",
        .y_label =
            words.filled("plot", "temperature_axis", {{"reference", words.number(environment.reference_degC.text)}})
                .first(),
        .series = {fixture},
        .limits = {}};
    if (!air.points.empty()) {
        panel.series.push_back(std::move(air));
    }
    plot.panels.push_back(std::move(panel));
    return plot;
}

}  // namespace gumcert::reports
