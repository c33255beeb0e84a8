#include "reports/studies/simulation_figures.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "reports/plots/svg_plot.h"

namespace gumcert::reports::simulation {

using gum::AngleStudy;
using gum::k_angular_tally;
using gum::k_histogram_first;
using gum::k_histogram_width;
using gum::k_linear_tally;
using gum::k_offset_tally;
using gum::k_tilt_tally;

std::optional<reports::StudyFigure> parts_figure(const std::vector<AngleStudy>& studies, const Scales& scales) {
    if (studies.size() < 2) {
        return std::nullopt;
    }
    reports::Plot plot{.id = "plot-parts",
                       .title = "Differences from the assumed values against the number of angles",
                       .description = "Root mean square of the datum part and of the measurement part",
                       .x_label = "number of angles",
                       .panels = {},
                       .columns = 2,
                       .panel_height = 150.0,
                       .x_is_angle = false};
    const std::array<std::pair<std::size_t, const char*>, 4> kinds{{{k_offset_tally, "set-up, offset"},
                                                                    {k_tilt_tally, "set-up, tilt"},
                                                                    {k_linear_tally, "error motions, linear"},
                                                                    {k_angular_tally, "error motions, angular"}}};
    for (const auto& [kind, heading] : kinds) {
        if (!(scales.of(kind) > 0.0)) {
            continue;
        }
        reports::PlotSeries home{.label = "datum part, home", .points = {}, .joined = true};
        reports::PlotSeries average{.label = "datum part, axis average line",
                                    .points = {},
                                    .marker = reports::PlotMarker::square,
                                    .joined = true};
        reports::PlotSeries measurement{.label = "measurement part, joint, axis average line",
                                        .points = {},
                                        .marker = reports::PlotMarker::triangle,
                                        .joined = true};
        for (const AngleStudy& study : studies) {
            const auto x = static_cast<double>(study.angles);
            const auto point = [&, scale = scales.of(kind)](double value) {
                return reports::PlotPoint{.x = x, .y = 100.0 * value / scale, .U = 0.0};
            };
            average.points.push_back(point(study.datum_only[0][kind].rms()));
            home.points.push_back(point(study.datum_only[1][kind].rms()));
            if (study.noisy.evaluated[0] > 0) {
                measurement.points.push_back(point(study.noisy.tallies[0][kind].measurement_rms()));
            }
        }
        plot.panels.push_back({.heading = heading,
                               .y_label = "rms / %",
                               .series = {std::move(home), std::move(average), std::move(measurement)},
                               .limits = {{0.0, ""}}});
    }
    if (plot.panels.empty()) {
        return std::nullopt;
    }
    return reports::StudyFigure{
        .caption = "Root mean square of the two parts of the differences against the number of angles",
        .alternative_text =
            "The datum parts fall with the number of angles; the measurement part is far smaller throughout",
        .drawing = reports::svg(plot)};
}

std::optional<reports::StudyFigure> histogram_figure(const std::vector<AngleStudy>& studies) {
    const AngleStudy* chosen = nullptr;
    for (const AngleStudy& study : studies) {
        if (study.noisy.evaluated[0] > 0) {
            chosen = &study;
        }
    }
    if (chosen == nullptr) {
        return std::nullopt;
    }
    double total = 0.0;
    for (const std::size_t cell : chosen->noisy.histogram) {
        total += static_cast<double>(cell);
    }
    reports::DensityPlot plot{.id = "plot-normalised-errors",
                              .title = "Normalised errors",
                              .description = "Histogram of errors divided by their standard uncertainties",
                              .x_label = "error / standard uncertainty",
                              .y_label = "probability density",
                              .low = k_histogram_first,
                              .high = -k_histogram_first,
                              .first_edge = k_histogram_first,
                              .cell_width = k_histogram_width,
                              .cells = {},
                              .cells_label = "campaigns",
                              .curve = {},
                              .curve_label = "standard normal distribution",
                              .intervals = {}};
    for (const std::size_t cell : chosen->noisy.histogram) {
        plot.cells.push_back(static_cast<double>(cell) / (total * k_histogram_width));
    }
    for (int i = -45; i <= 45; ++i) {
        const double z = 0.1 * i;
        plot.curve.push_back({.x = z, .y = std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi), .U = 0.0});
    }
    return reports::StudyFigure{
        .caption = "Errors of the six error motions of all campaigns with " + std::to_string(chosen->angles) +
                   " angles, each divided by its standard uncertainty (joint adjustment, axis average line)",
        .alternative_text = "A histogram that follows the standard normal density",
        .drawing = reports::svg(plot)};
}

}  // namespace gumcert::reports::simulation
