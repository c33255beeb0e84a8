#include "reports/plots/rotary_plots.h"

#include "gum/quantity/unit.h"
#include "reports/printable_text.h"
#include "reports/result_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace gumcert::reports {

namespace {

bool any_place(const RotaryTable& rotary) {
    return std::any_of(rotary.reflectors.begin(), rotary.reflectors.end(), [](const Reflector& m) {
        return std::any_of(m.home_position_mm.begin(), m.home_position_mm.end(), [](double v) { return v != 0.0; });
    });
}

LayoutPlot with_words(const Wording& words, const std::string& axis) {
    LayoutPlot plot;
    plot.axis = axis;
    plot.stations_label = words("plot", "station_key").first();
    plot.reflectors_label = words("plot", "reflector_key").first();
    plot.axis_label = words("plot", "axis_key").first();
    plot.ellipse_label = words("plot", "ellipse_key").first();
    return plot;
}

}  // namespace

std::optional<LayoutPlot> layout_plot(const RotaryTable& rotary, const Wording& words) {
    if (!any_place(rotary)) {
        return std::nullopt;
    }
    LayoutPlot plot = with_words(words, rotary.axis);
    plot.id = "plot-layout";
    plot.title = words("plot", "layout_title").first();
    plot.description = words("plot", "layout_description").first();
    for (const Station& s : rotary.stations) {
        plot.stations.push_back({.name = s.name, .position_mm = s.position_mm, .covariance_mm2 = s.covariance_mm2});
    }
    for (const Reflector& m : rotary.reflectors) {  // their ellipses have a drawing of their own
        plot.reflectors.push_back({.name = m.name, .position_mm = m.home_position_mm});
    }
    return plot;
}

std::optional<LayoutPlot> reflector_plot(const RotaryTable& rotary, const Wording& words) {
    if (!any_place(rotary)) {
        return std::nullopt;
    }
    LayoutPlot plot = with_words(words, rotary.axis);
    plot.id = "plot-reflectors";
    plot.title = words("plot", "reflectors_title").first();
    plot.description = words("plot", "reflectors_description").first();
    for (const Reflector& m : rotary.reflectors) {
        // Frame of the fixture and frame of the table differ by arcseconds: the ellipses are the same.
        plot.reflectors.push_back(
            {.name = m.name, .position_mm = m.home_position_mm, .covariance_mm2 = m.covariance_mm2});
    }
    return plot;
}

Plot station_residual_plot(const RotaryTable& rotary, const Wording& words) {
    Plot plot{.id = "plot-station-residuals",
              .title = words("plot", "station_residuals_title").first(),
              .description = words("plot", "station_residuals_description").first(),
              .x_label = words("plot", "angle_axis").first(),
              .panels = {},
              .columns = 2,
              .panel_height = 84.0};
    double most = 0.0;
    for (const ReliabilityRow& row : rotary.reliability) {
        most = row.removed ? most : std::max(most, std::abs(row.residual_um));
    }
    for (const Station& station : rotary.stations) {
        if (plot.panels.size() == k_most_residual_panels) {
            break;
        }
        PlotSeries good{.label = words("plot", "kept_key").first(), .points = {}, .marker = PlotMarker::disc};
        PlotSeries flagged{.label = words("plot", "flagged_key").first(), .points = {}, .marker = PlotMarker::square};
        PlotSeries removed{.label = words("plot", "removed_key").first(), .points = {}, .marker = PlotMarker::cross};
        for (const ReliabilityRow& row : rotary.reliability) {
            if (row.station == station.name) {
                (row.removed   ? removed
                 : row.flagged ? flagged
                               : good)
                    .points.push_back({.x = row.angle_deg, .y = row.residual_um, .U = 0.0});
            }
        }
        PlotPanel panel{.heading = shortened(printable(station.name), 30),
                        .y_label = words("plot", "residual_axis").first(),
                        .series = {},
                        .limits = {},
                        .y_most = 1.1 * most};
        for (PlotSeries& series : std::array<PlotSeries, 3>{good, flagged, removed}) {
            if (!series.points.empty()) {
                panel.series.push_back(std::move(series));
            }
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

HistogramPlot redundancy_plot(const RotaryTable& rotary, const Wording& words) {
    constexpr std::size_t k_cells = 20;  // of 0 to 1
    HistogramPlot plot{.id = "plot-redundancy",
                       .title = words("plot", "redundancy_title").first(),
                       .description = words("plot", "redundancy_description").first(),
                       .x_label = words("plot", "redundancy_axis").first(),
                       .y_label = words("plot", "count_axis").first(),
                       .first_edge = 0.0,
                       .cell_width = 1.0 / static_cast<double>(k_cells),
                       .counts = std::vector<double>(k_cells, 0.0)};
    for (const ReliabilityRow& row : rotary.reliability) {
        if (!row.removed) {
            const double cell = std::clamp(row.redundancy_number, 0.0, 0.9999) * static_cast<double>(k_cells);
            plot.counts[static_cast<std::size_t>(cell)] += 1.0;
        }
    }
    return plot;
}

StackedPlot source_plot(const RotaryTable& rotary, const Wording& words) {
    StackedPlot plot{.id = "plot-sources",
                     .title = words("plot", "sources_title").first(),
                     .description = words("plot", "sources_description").first(),
                     .x_label = words("plot", "shares_axis").first(),
                     .text_head = words("label", "rms_u").first(),
                     .parts = {},
                     .bars = {}};
    for (const std::string& source : rotary.budget_sources) {
        plot.parts.push_back(shortened(printable(source_name(source, words).first()), 40));
    }
    for (const BudgetSummaryRow& row : rotary.budget_summary) {
        StackedBar bar{.label = shortened(printable(row.quantity), 20),
                       .shares = {},
                       .texts = row.shares.text,
                       .text = words.number(row.rms_u.text).first() + " " + gum::unit_for_people(row.unit)};
        for (const double share : row.shares.number) {
            bar.shares.push_back(100.0 * share);
        }
        plot.bars.push_back(std::move(bar));
    }
    return plot;
}

}  // namespace gumcert::reports
