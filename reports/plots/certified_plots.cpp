#include "reports/plots/certified_plots.h"

#include "certificate/point_tables.h"
#include "reports/plots/svg_drawing.h"
#include "reports/point_headings.h"
#include "reports/printable_text.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using certificate::CertifiedColumn;
using certificate::CertifiedTable;
using certificate::CertifiedValue;

constexpr std::size_t k_least_values = 3;
constexpr std::size_t k_most_certified_panels = 12;
constexpr double k_certified_margin = 8.0;  // so that the bars of the outermost points stand inside of the frame

/// A printed number as the number that the table shows: the plot and the table cannot disagree.
std::optional<double> number_of(std::string printed) {
    static constexpr std::string_view k_minus = "\u2212";
    if (printed.starts_with(k_minus)) {
        printed.replace(0, k_minus.size(), "-");
    }
    double v = 0.0;
    const auto [end, error] = std::from_chars(printed.data(), printed.data() + printed.size(), v);
    if (error != std::errc() || end != printed.data() + printed.size() || !std::isfinite(v)) {
        return std::nullopt;
    }
    return v;
}

/// What numbers of an axis are divided by, and the unit that they then have: angles that the table shows in degrees, minutes and
/// seconds are drawn in degrees, where one of them has a degree. Errors of some seconds are drawn in seconds, as their U is
/// stated.
struct AxisUnit {
    double divisor = 1.0;
    std::string unit;
};
AxisUnit axis_unit(const std::string& form, const std::string& unit, const std::string& printed_unit,
                   const std::vector<std::optional<double>>& values) {
    constexpr double k_minutes = 60.0;  // of a degree
    const auto last = form.empty() || unit.empty() ? std::nullopt : certificate::last_part_of(unit);
    const double degree = last == text::AnglePart::seconds ? k_minutes * k_minutes : k_minutes;
    const auto has_degree = [&](const std::optional<double>& value) { return value && std::abs(*value) >= degree; };
    return !last || std::none_of(values.begin(), values.end(), has_degree)
               ? AxisUnit{.divisor = 1.0, .unit = printed_unit}
               : AxisUnit{.divisor = degree, .unit = "\u00B0"};
}

std::vector<std::optional<double>> printed_values(const CertifiedColumn& column) {
    std::vector<std::optional<double>> values;
    for (const CertifiedValue& value : column.values) {
        values.push_back(number_of(value.printed_value));
    }
    return values;
}

/// Whether values are one that scatters: what a power meter shows at 1 mW and ten frequencies.
bool is_one_that_scatters(const std::vector<std::optional<double>>& values) {
    constexpr double k_scatter = 0.05;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    // What rises or falls from point to point is a range, as 293 K to 303 K; three values do so by chance in one case of three.
    constexpr std::size_t k_few = 3;
    const auto falls = [](const auto& a, const auto& b) { return *b < *a; };
    const auto rises = [](const auto& a, const auto& b) { return *a < *b; };
    const bool follows_points = std::adjacent_find(values.begin(), values.end(), falls) == values.end() ||
                                std::adjacent_find(values.begin(), values.end(), rises) == values.end();
    return !(follows_points && values.size() > k_few) &&
           **high - **low < k_scatter * std::max(std::abs(**low), std::abs(**high));
}

/// Numbers of the points of a table with a layout that its results are drawn against, the first that differ from point to
/// point: of a sensitivity at 100 m/s² and ten frequencies these, and not what the reference scatters about its nominal value.
/// None: without any.
const certificate::PointColumn* abscissa_of(const CertifiedTable& table) {
    if (!table.layout) {
        return nullptr;
    }
    const certificate::PointColumn* constant = nullptr;
    const certificate::PointColumn* scattered = nullptr;
    std::vector<const char*> roles{"nominal", "reference", "setting", "indication"};
    for (std::size_t i = 0; i < roles.size(); ++i) {
        for (const certificate::PointColumn& column : table.layout->columns) {
            const bool complete =
                std::all_of(column.values.begin(), column.values.end(), [](const auto& v) { return v.has_value(); });
            if (column.role != roles[i] || !complete) {
                continue;
            }
            const bool differs = std::any_of(column.values.begin(), column.values.end(),
                                             [&](const auto& v) { return v != column.values.front(); });
            const bool is_measured = column.role == "reference" || column.role == "indication";
            if (differs && is_measured && is_one_that_scatters(column.values)) {
                scattered = scattered == nullptr ? &column : scattered;
                continue;
            }
            if (differs) {
                return &column;
            }
            if (i == 0 && constant == nullptr) {
                std::swap(roles[1], roles[2]);  // "reference" behind "setting"
            }
            constant = constant == nullptr ? &column : constant;  // all results upon one another
        }
    }
    return scattered != nullptr ? scattered : constant;
}

/// One limit of all values: a line where it is the same for all, else a bar at each value. Between the points nothing is
/// known here: a limit by steps jumps there, one by an expression curves, and a line from bar to bar would state others.
struct CertifiedLimit {
    std::vector<PlotPoint> points = {};
    bool constant = true;

    void add(double x, const std::optional<double>& limit) {
        if (limit) {
            constant = constant && (points.empty() || points.front().y == *limit);
            points.push_back({.x = x, .y = *limit, .U = 0.0});
        }
    }
    /// \param acceptance  of a limit of acceptance, which is drawn differently from that of a tolerance
    /// \param values      how many the panel shows: what some of them lack is no line across all
    void put(PlotPanel& panel, const std::string& label, bool acceptance, std::size_t values) const {
        if (points.empty()) {
            return;
        }
        if (constant && points.size() == values) {
            panel.limits.push_back({.y = points.front().y, .label = label, .dotted = acceptance});
        } else {
            panel.series.push_back(
                {.label = label, .points = points, .marker = acceptance ? PlotMarker::broken_bar : PlotMarker::bar});
        }
    }
};

/// What a result is called in the table, where the job says so; else its name.
struct PanelName {
    std::string stage, result;  ///< "Before the adjustment: " or ""
    bool values = false;        ///< its role is that of a value, not of a difference
};
PanelName name_of_panel(const CertifiedTable& table, const CertifiedColumn& column, const Wording& words) {
    if (table.layout) {
        for (const certificate::ShownColumn& shown : table.layout->shown) {
            if (shown.show == "value" && shown.of == column.result && !shown.role.empty()) {
                return {.stage = shown.stage.empty() ? "" : words("point_table", shown.stage).first() + ": ",
                        .result = heading_of_shown(table, shown, words).first(),
                        .values = !certificate::is_role_of_difference(shown.role)};
            }
        }
    }
    return {.stage = "", .result = column.result};
}

/// Whether a plot can show all numbers of a panel.
bool is_of_ordinary_size(const PlotPanel& panel) {
    const auto are_ordinary = [&](const PlotSeries& series) {
        return std::all_of(series.points.begin(), series.points.end(), [&](const PlotPoint& p) {
            return is_ordinary(p.x) && is_ordinary(p.y) && is_ordinary(p.U);
        });
    };
    return std::all_of(panel.series.begin(), panel.series.end(), are_ordinary) &&
           std::all_of(panel.limits.begin(), panel.limits.end(), [&](const PlotLimit& l) { return is_ordinary(l.y); });
}

PlotPanel panel_of(const CertifiedTable& table, const CertifiedColumn& column, const Wording& words) {
    const certificate::PointColumn* const abscissa = abscissa_of(table);
    PlotSeries series{
        .label = "", .points = {}, .marker = PlotMarker::disc, .bars = PlotBars::bars, .joined = abscissa == nullptr};
    CertifiedLimit lower;
    CertifiedLimit upper;
    CertifiedLimit acceptance_lower;
    CertifiedLimit acceptance_upper;
    const AxisUnit across = abscissa != nullptr
                                ? axis_unit(abscissa->form, abscissa->unit, abscissa->printed_unit, abscissa->values)
                                : AxisUnit();
    const AxisUnit up = axis_unit(certificate::form_of_result(table, column.result), column.unit, column.printed_unit,
                                  printed_values(column));
    const auto divided = [](const std::optional<double>& number, double divisor) {
        return number ? std::optional(*number / divisor) : std::nullopt;
    };
    for (std::size_t i = 0; i < column.values.size(); ++i) {
        const CertifiedValue& value = column.values[i];
        const std::optional<double> x =
            divided(abscissa != nullptr ? abscissa->values[i] : table.argument->values[i], across.divisor);
        const std::optional<double> y = divided(number_of(value.printed_value), up.divisor);
        if (!x || !y) {
            continue;
        }
        series.points.push_back({.x = *x, .y = *y, .U = number_of(value.printed_U).value_or(0.0) / up.divisor});
        if (value.verdict) {
            const certificate::Verdict& v = *value.verdict;
            lower.add(*x, divided(v.lower, up.divisor));
            upper.add(*x, divided(v.upper, up.divisor));
            if (v.acceptance_lower != v.lower) {
                acceptance_lower.add(*x, divided(v.acceptance_lower, up.divisor));
            }
            if (v.acceptance_upper != v.upper) {
                acceptance_upper.add(*x, divided(v.acceptance_upper, up.divisor));
            }
        }
    }
    const std::string unit = up.unit.empty() ? "" : " / " + up.unit;
    const PanelName name = name_of_panel(table, column, words);
    // The heading says when it was measured; the axis, which is shorter, what.
    PlotPanel panel{.heading = shortened(printable(name.stage + name.result), 40),
                    .y_label = shortened(printable(name.result), 40) + unit,
                    .series = {},
                    .limits = {},
                    .values = name.values};
    const std::string tolerance = words("certificate", "tolerance_limit").first();
    const std::string acceptance = words("certificate", "acceptance_limit").first();
    const std::size_t values = series.points.size();
    panel.series.push_back(std::move(series));
    lower.put(panel, tolerance, false, values);
    upper.put(panel, tolerance, false, values);
    acceptance_lower.put(panel, acceptance, true, values);
    acceptance_upper.put(panel, acceptance, true, values);
    return panel;
}

}  // namespace

std::optional<Plot> certified_plot(const CertifiedTable& table, const std::string& caption, const Wording& words,
                                   const std::string& id) {
    if (!table.argument || table.columns.empty() || table.columns.size() > k_most_certified_panels) {
        return std::nullopt;
    }
    const certificate::PointColumn* const abscissa = abscissa_of(table);
    const auto axis_of = [&](const certificate::PointColumn& of) {
        const std::string name =
            !of.heading.empty() ? words.localised(of.heading).first() : words("point_table", of.role).first();
        const std::string unit = axis_unit(of.form, of.unit, of.printed_unit, of.values).unit;
        return shortened(printable(name), 40) + (unit.empty() ? "" : " / " + unit);
    };
    const bool is_angle = table.argument->unit == "degree" || table.argument->printed_unit == "°";
    Plot plot{.id = id,
              .title = caption,
              .description = words.filled("statement", "certified_figure", {{"table", caption}}).first(),
              .x_label = is_angle ? words("plot", "angle_axis").first()
                         : abscissa != nullptr
                             ? axis_of(*abscissa)
                             : shortened(printable(table.argument->name), 40) +
                                   (table.argument->printed_unit.empty() ? "" : " / " + table.argument->printed_unit),
              .panels = {},
              .columns = table.columns.size() > 3 ? 2 : 1,
              .panel_height = 150.0,
              .x_is_angle = is_angle,
              .margin = abscissa != nullptr ? k_certified_margin : 0.0};
    for (const CertifiedColumn& column : table.columns) {
        PlotPanel panel = panel_of(table, column, words);
        // A certificate of 1e15 Ω is not refused for its figure.
        if (panel.series.front().points.size() < k_least_values || !is_of_ordinary_size(panel)) {
            return std::nullopt;
        }
        plot.panels.push_back(std::move(panel));
    }
    return plot;
}

}  // namespace gumcert::reports
