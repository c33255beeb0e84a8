#include "reports/plots/budget_plots.h"

#include "gum/quantity/unit.h"
#include "reports/plots/plot_frame.h"
#include "reports/printable_text.h"
#include "reports/result_names.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>

namespace gumcert::reports {

namespace {

/// A power of ten that brings the numbers of an axis to a readable size.
struct Scale {
    int exponent = 0;

    [[nodiscard]] double operator()(double v) const { return exponent == 0 ? v : v * std::pow(10.0, -exponent); }
};

/// \param most  largest magnitude on the axis
Scale scale_of(double most) {
    if (!(most > 0.0) || (most >= 0.1 && most < 1e5)) {
        return {};
    }
    return {.exponent = 3 * static_cast<int>(std::floor(std::log10(most) / 3.0))};
}

/// "x / µm", "x / 10⁻⁶ m", "x"
std::string axis_label(const std::string& name, const std::string& unit, Scale scale) {
    std::string divisor = scale.exponent == 0 ? "" : "10" + superscript(scale.exponent);
    const std::string people = gum::unit_for_people(unit);
    if (!people.empty()) {
        divisor += (divisor.empty() ? "" : " ") + people;
    }
    return shortened(printable(divisor.empty() ? name : name + " / " + divisor), 90);
}

/// Density of the t-distribution with ν degrees of freedom, infinite: of the standard normal.
double density(double z, double nu) {
    if (!std::isfinite(nu)) {
        return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
    }
    const double constant = std::lgamma(0.5 * (nu + 1.0)) - std::lgamma(0.5 * nu);
    return std::exp(constant - 0.5 * (nu + 1.0) * std::log1p(z * z / nu)) / std::sqrt(nu * std::numbers::pi);
}

}  // namespace

BarPlot share_plot(const Result& result, const Wording& words, const std::string& id) {
    constexpr std::size_t k_most_bars = 12;
    constexpr std::size_t k_label = 32;
    BarPlot plot{.id = id,
                 .title = printable(words.filled("plot", "shares_title", {{"name", result.name}}).first()),
                 .description = "",
                 .x_label = words("plot", "shares_axis").first(),
                 .bars = {}};
    for (const BudgetRow& row : result.budget) {
        plot.bars.push_back({shortened(printable(name_of_budget_row(row, words).first()), k_label),
                             100.0 * row.share.number, words.number(row.share.text).first()});
    }
    if (result.correlation) {
        plot.bars.push_back({words("label", "correlation").first(), 100.0 * result.correlation->share.number,
                             words.number(result.correlation->share.text).first()});
    }
    std::stable_sort(plot.bars.begin(), plot.bars.end(),
                     [](const ShareBar& a, const ShareBar& b) { return std::abs(a.share) > std::abs(b.share); });
    if (plot.bars.size() > k_most_bars) {
        ShareBar others{.label = words("plot", "others").first(), .share = 0.0, .text = ""};
        for (std::size_t i = k_most_bars - 1; i < plot.bars.size(); ++i) {
            others.share += plot.bars[i].share;
        }
        plot.bars.resize(k_most_bars - 1);
        plot.bars.push_back(others);
    }
    std::string all;
    for (const ShareBar& bar : plot.bars) {
        if (!bar.text.empty()) {
            all += (all.empty() ? "" : ", ") + bar.label + " " + bar.text + " %";
        }
    }
    plot.description =
        printable(words.filled("plot", "shares_description", {{"name", result.name}, {"shares", all}}).first());
    return plot;
}

DensityPlot monte_carlo_plot(const Result& result, const Wording& words, const std::string& id) {
    const MonteCarloSummary& m = *result.monte_carlo;
    const bool by_t = result.coverage == "student_t" && result.nu_eff.has_value();
    const double nu = by_t ? *result.nu_eff : std::numeric_limits<double>::infinity();
    DensityPlot plot;
    plot.id = id;
    plot.title = printable(words.filled("plot", "monte_carlo_title", {{"name", result.name}}).first());
    plot.description = printable(words
                                     .filled("plot", "monte_carlo_description",
                                             {{"name", result.name},
                                              {"trials", words.number(m.trials.text)},
                                              {"low", words.number(m.symmetric.text[0])},
                                              {"high", words.number(m.symmetric.text[1])},
                                              {"unit", gum::unit_for_people(result.unit)}})
                                     .first());
    plot.y_label = words("plot", "density_axis").first();
    plot.cells_label = words("plot", "trials_key").first();
    plot.curve_label = words("plot", by_t ? "t_key" : "normal_key").first();

    // The value is taken off, so that the ticks of a long number differ.
    plot.intervals = {{words("plot", "shortest_interval").first(), m.shortest.number[0] - result.value,
                       m.shortest.number[1] - result.value},
                      {words("plot", "symmetric_interval").first(), m.symmetric.number[0] - result.value,
                       m.symmetric.number[1] - result.value}};
    if (result.U) {
        plot.intervals.insert(plot.intervals.begin(), {words("plot", "U_interval").first(), -*result.U, *result.U});
    }
    double low = plot.intervals.front().low;
    double high = plot.intervals.front().high;
    for (const DensityInterval& interval : plot.intervals) {
        low = std::min(low, interval.low);
        high = std::max(high, interval.high);
    }
    // Trials far out would press everything of interest into one cell.
    const double room = 0.35 * (high - low);
    low -= room;
    high += room;

    const Scale scale = scale_of(std::max(std::abs(low), std::abs(high)));
    for (DensityInterval& interval : plot.intervals) {
        interval.low = scale(interval.low);
        interval.high = scale(interval.high);
    }
    plot.low = scale(low);
    plot.high = scale(high);
    plot.x_label =
        axis_label(words.filled("plot", "deviation_axis", {{"name", shortened(printable(result.name), 40)}}).first(),
                   result.unit, scale);

    const double width = (m.histogram_high - m.histogram_low) / static_cast<double>(m.histogram.size());
    const double unit_area = static_cast<double>(m.trials.number) * scale(width);
    plot.cell_width = scale(width);
    bool first = true;
    for (std::size_t i = 0; i < m.histogram.size(); ++i) {
        const double left = m.histogram_low + static_cast<double>(i) * width - result.value;
        if (left >= low && left + width <= high) {
            if (first) {
                plot.first_edge = scale(left);
                first = false;
            }
            plot.cells.push_back(static_cast<double>(m.histogram[i]) / unit_area);
        }
    }
    const double u = scale(result.u);
    constexpr int k_steps = 200;
    for (int i = 0; i <= k_steps && u > 0.0; ++i) {
        const double x = plot.low + (plot.high - plot.low) * i / k_steps;
        plot.curve.push_back({.x = x, .y = density(x / u, nu) / u, .U = 0.0});
    }
    return plot;
}

Plot residual_plot(const FitSummary& fit, const Wording& words, const std::string& id) {
    const bool numbered = fit.x_name.empty();
    Plot plot{.id = id,
              .title = printable(words.filled("plot", "residuals_title", {{"name", fit.name}}).first()),
              .description = printable(words.filled("plot", "residuals_description", {{"name", fit.name}}).first()),
              .x_label = "",
              .panels = {},
              .columns = 1,
              .panel_height = 130.0,
              .x_is_angle = false};
    double most_x = 0.0;
    double most_y = 0.0;
    for (std::size_t i = 0; i < fit.residual.number.size(); ++i) {
        most_x = std::max(most_x, numbered ? 1.0 : std::abs(fit.x.number[i]));
        most_y = std::max(most_y, std::abs(fit.residual.number[i]));
    }
    const Scale scale_x = numbered ? Scale{} : scale_of(most_x);
    const Scale scale_y = scale_of(most_y);
    PlotSeries series{.label = "", .points = {}, .marker = PlotMarker::disc, .bars = PlotBars::none};
    for (std::size_t i = 0; i < fit.residual.number.size(); ++i) {
        series.points.push_back({.x = numbered ? static_cast<double>(i + 1) : scale_x(fit.x.number[i]),
                                 .y = scale_y(fit.residual.number[i]),
                                 .U = 0.0});
    }
    plot.x_label = numbered ? words("plot", "observation_axis").first() : axis_label(fit.x_name, fit.x_unit, scale_x);
    plot.panels.push_back(
        {.heading = "",
         .y_label = shortened(axis_label(words("label", "residual").first(), fit.y_unit, scale_y), 30),
         .series = {series},
         .limits = {}});
    return plot;
}

}  // namespace gumcert::reports
