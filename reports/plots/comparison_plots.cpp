// The plots of a method against a reference method.

#include "reports/plots/comparison_plots.h"
#include "reports/printable_text.h"

#include "gum/quantity/unit.h"
#include "reports/plots/plot_frame.h"

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

using Symbol = PlotKey::Symbol;

constexpr std::size_t k_most_panels = 12;
constexpr double k_most_of_axis = 1e4;  // above it a tick label needs more room than there is
constexpr std::size_t k_many = 150;     // points of a direction above which directions get panels of their own
constexpr double k_margin = 8.0;        // between the outermost points and the frame
constexpr std::size_t k_dense = 1200;   // points of a direction above which only the outermost of each place are drawn

/// The points of one direction, in the order of the record.
struct Direction {
    std::string name;
    std::vector<const ComparisonPoint*> points;
};

std::vector<Direction> directions_of(const Comparison& comparison) {
    std::vector<Direction> directions;
    for (const ComparisonPoint& p : comparison.points) {
        const auto found = std::find_if(directions.begin(), directions.end(),
                                        [&](const Direction& d) { return d.name == p.direction; });
        if (found != directions.end()) {
            found->points.push_back(&p);
        } else {
            directions.push_back({.name = p.direction, .points = {&p}});
        }
    }
    return directions;
}

std::size_t most_points(const std::vector<Direction>& directions) {
    std::size_t most = 0;
    for (const Direction& d : directions) {
        most = std::max(most, d.points.size());
    }
    return most;
}

/// Panels of directions: below each other, or in two columns where they would need more than half of a page.
struct PanelGrid {
    int columns = 1, rows = 1;
    double panel_height = 120.0;

    /// \param alone  height of a single panel
    PanelGrid(std::size_t panels, double alone)
        : columns(panels > 3 ? 2 : 1),
          rows((static_cast<int>(panels) + columns - 1) / columns),
          panel_height(panels <= 1   ? alone
                       : panels <= 8 ? 120.0
                                     : 90.0) {}
};

/// Horizontal axis of all points: angle, position, or the number of the point in its direction where one has neither.
struct PositionAxis {
    enum class Kind { angle, position, number } kind = Kind::number;
    AxisScale scale = {};
    std::string title;

    PositionAxis(const Comparison& comparison, const Wording& words) {
        const auto all = [&](auto member) {
            return std::all_of(comparison.points.begin(), comparison.points.end(),
                               [&](const ComparisonPoint& p) { return (p.*member).has_value(); });
        };
        if (all(&ComparisonPoint::angle_deg)) {
            kind = Kind::angle;
            title = words("plot", "angle_axis").first();
        } else if (all(&ComparisonPoint::position)) {
            kind = Kind::position;
            double largest = 0.0;
            for (const ComparisonPoint& p : comparison.points) {
                largest = std::max(largest, std::abs(*p.position));
            }
            scale = AxisScale::of(largest, k_most_of_axis);
            title = scale.label(shortened(printable(comparison.position_name), 40),
                                gum::unit_for_people(comparison.position_unit));
        } else {
            title = words("plot", "point_axis").first();
        }
    }

    [[nodiscard]] double of(const Direction& direction, std::size_t i) const {
        switch (kind) {
            case Kind::angle:
                return *direction.points[i]->angle_deg;
            case Kind::position:
                return scale(*direction.points[i]->position);
            case Kind::number:
                break;
        }
        return static_cast<double>(i + 1);
    }
    [[nodiscard]] bool is_angle(const Comparison& comparison) const {
        return kind == Kind::angle ||
               (kind == Kind::position && scale.exponent == 0 && gum::unit_for_people(comparison.position_unit) == "°");
    }
};

/// Of many points, the lowest and the highest at each place of the horizontal axis: what can be seen of them.
std::vector<PlotPoint> visible(std::vector<PlotPoint> points) {
    if (points.size() <= k_dense) {
        return points;
    }
    std::stable_sort(points.begin(), points.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    const double low = points.front().x;
    const double width = points.back().x - low;
    constexpr double k_places = 500.0;
    std::vector<PlotPoint> outermost;
    for (std::size_t i = 0; i < points.size();) {
        const auto place = [&](const PlotPoint& p) {
            return width > 0.0 ? std::floor(k_places * ((p.x - low) / width)) : 0.0;
        };
        PlotPoint lowest = points[i];
        PlotPoint highest = points[i];
        std::size_t j = i;
        for (; j < points.size() && place(points[j]) == place(points[i]); ++j) {
            lowest = points[j].y - points[j].U < lowest.y - lowest.U ? points[j] : lowest;
            highest = points[j].y + points[j].U > highest.y + highest.U ? points[j] : highest;
        }
        outermost.push_back(lowest);
        outermost.push_back(highest);
        i = j;
    }
    return outermost;
}

std::string panel_name(const Direction& direction, const Wording& words) {
    return direction.name.empty()
               ? words("plot", "all_points").first()
               : words.filled("plot", "direction", {{"direction", shortened_name(printable(direction.name), 30)}})
                     .first();
}

Wording::Values method_names(const Comparison& comparison, const Wording& words) {
    const std::string method = comparison.method_name.empty() ? words("label", "measured").first()
                                                              : shortened(printable(comparison.method_name), 60);
    return {{"method", method}, {"reference", shortened(printable(comparison.reference_name), 60)}};
}

PlotSeries score_series(const Direction& direction, const PositionAxis& axis) {
    PlotSeries series;
    for (std::size_t i = 0; i < direction.points.size(); ++i) {
        if (direction.points[i]->En.number) {
            series.points.push_back(
                {.x = axis.of(direction, i), .y = on_axis("En", *direction.points[i]->En.number), .U = 0.0});
        }
    }
    series.points = visible(std::move(series.points));
    return series;
}

/// Takes what lies beyond `most` out of the series of a panel and marks it at the edge.
void mark_beyond(PlotPanel& panel, double most, const Wording& words) {
    PlotSeries beyond{.label = words("plot", "beyond_key").first(), .points = {}, .marker = PlotMarker::cross};
    for (PlotSeries& series : panel.series) {
        std::vector<PlotPoint> inside;
        for (const PlotPoint& p : series.points) {
            if (std::abs(p.y) > most) {
                beyond.points.push_back({.x = p.x, .y = std::copysign(2.0 * most, p.y), .U = 0.0});
            } else {
                inside.push_back(p);
            }
        }
        series.points = std::move(inside);
    }
    if (!beyond.points.empty()) {
        panel.y_most = most;
        panel.series.push_back(std::move(beyond));
    }
}

constexpr double k_most_score = 5.0;  // a huge E_n is marked at the edge: the limits must stay apart

/// Panel of E_n numbers with its limits, without series.
PlotPanel score_panel(const Wording& words) {
    PlotPanel panel{.heading = "", .y_label = words("label", "En").first(), .series = {}, .limits = {}};
    panel.limits = {{-1.0, "\u22121 " + words("label", "En_limit").first()},
                    {1.0, "+1 " + words("label", "En_limit").first()}};
    return panel;
}

PlotSeries value_series(const Direction& direction, const PositionAxis& axis, const AxisScale& scale, bool reference) {
    PlotSeries series{.label = "",
                      .points = {},
                      .marker = reference ? PlotMarker::square : PlotMarker::disc,
                      .bars = PlotBars::bars,
                      .joined = !reference,
                      .shift = reference ? 1.5 : -1.5};
    for (std::size_t i = 0; i < direction.points.size(); ++i) {
        const ComparisonPoint& p = *direction.points[i];
        const double y = on_axis("values", scale(reference ? p.reference_value.number : p.value.number));
        const double U = on_axis("values", scale((reference ? p.reference_U.number : p.U.number).value_or(0.0)));
        series.points.push_back({.x = axis.of(direction, i), .y = y, .U = U});
    }
    if (series.points.size() > k_many) {
        series.joined = false;
        series.shift = 0.0;
    }
    series.points = visible(std::move(series.points));
    return series;
}

constexpr double k_room_at_ends = 0.03;  // of the vertical axis, so that no point lies on the frame

/// One panel of the differences with the bias line of its direction.
struct BiasPanel {
    std::string heading;
    std::vector<PlotPoint> points;  ///< in the units of the axes
    std::vector<std::pair<double, double>> line;
    AxisRange ends = {};  ///< of the horizontal axis
};

void draw_differences(Drawing& drawing, const PlotFrame& frame, const std::vector<PlotPoint>& points) {
    const bool thin = points.size() > k_many;
    std::vector<Stroke> bars;
    for (const PlotPoint& p : points) {
        const double low = frame.py_inside(p.y - p.U);
        const double high = frame.py_inside(p.y + p.U);
        if (low > high) {
            bars.push_back({.x = frame.px(p.x), .low = low, .high = high});
        }
    }
    draw_strokes(drawing, bars,
                 thin ? "stroke=\"#a8a8a8\" stroke-width=\"0.6\"" : "stroke=\"#555555\" stroke-width=\"0.8\"");
    for (const PlotPoint& p : points) {
        if (p.y < frame.up.low || p.y > frame.up.high) {
            draw_beyond(drawing, frame, frame.px(p.x), p.y > frame.up.high);
        } else {
            drawing.marker(PlotMarker::disc, frame.px(p.x), frame.py(p.y), thin ? 1.2 : 2.2);
        }
    }
}

/// The bulk of the differences with their U, and zero; what is many spreads away stands at the edge.
AxisRange range_of_differences(const std::vector<BiasPanel>& panels) {
    std::vector<double> values;
    std::vector<double> uncertainties;
    for (const BiasPanel& panel : panels) {
        for (const PlotPoint& p : panel.points) {
            values.push_back(p.y);
            uncertainties.push_back(p.U);
        }
    }
    const double middle = middle_of(values);
    constexpr double k_spreads = 10.0;
    constexpr double k_spreads_of_bar = 4.0;  // a longer bar of U is cut off at the edge
    const double spread = std::max(spread_of(values), 0.5 * middle_of(uncertainties));
    AxisRange range;
    for (const BiasPanel& panel : panels) {
        for (const PlotPoint& p : panel.points) {
            const double reach = spread > 0.0 ? k_spreads * spread : std::abs(p.y - middle) + p.U;
            if (std::abs(p.y - middle) <= reach) {
                const double bar = spread > 0.0 ? std::min(p.U, k_spreads_of_bar * spread) : p.U;
                range.include(p.y - bar);
                range.include(p.y + bar);
            }
        }
    }
    return range;
}

/// What the bias lines of a comparison are fitted to.
std::optional<std::string> bias_argument(const Comparison& comparison) {
    for (const ComparisonSummary& s : comparison.summary) {
        if (s.bias) {
            return s.bias->against;
        }
    }
    return std::nullopt;
}

const BiasLineSummary* bias_of(const Comparison& comparison, const std::string& direction) {
    for (const ComparisonSummary& s : comparison.summary) {
        if (s.direction == direction) {
            return s.bias ? &*s.bias : nullptr;
        }
    }
    return nullptr;
}

/// A plot without panels over the positions of the points.
/// \param texts  its words: texts_title, texts_description
Plot plot_over(const PositionAxis& axis, const PanelGrid& grid, const Comparison& comparison, const Wording& words,
               const std::string& texts) {
    return {.id = {},
            .title = words.filled("plot", texts + "_title", method_names(comparison, words)).first(),
            .description = words("plot", texts + "_description").first(),
            .x_label = axis.title,
            .panels = {},
            .columns = grid.columns,
            .panel_height = grid.panel_height,
            .x_is_angle = axis.is_angle(comparison),
            .x_is_number = axis.kind == PositionAxis::Kind::number,
            .x_in_power = axis.scale.exponent != 0,
            .margin = k_margin};
}

/// What the axes of the differences are divided by.
struct BiasAxes {
    AxisScale up, across;
};

BiasAxes bias_axes(const Comparison& comparison, const PositionAxis& positions, bool by_position) {
    std::vector<double> magnitudes;
    double largest_reference = 0.0;
    for (const ComparisonPoint& p : comparison.points) {
        magnitudes.push_back(std::max(std::abs(p.D.number), p.U_D.number.value_or(0.0)));
        largest_reference = std::max(largest_reference, std::abs(p.reference_value.number));
    }
    double largest_D = middle_of(magnitudes);
    largest_D =
        largest_D > 0.0 || magnitudes.empty() ? largest_D : *std::max_element(magnitudes.begin(), magnitudes.end());
    return {.up = AxisScale::of(largest_D),
            .across = by_position ? positions.scale : AxisScale::of(largest_reference, k_most_of_axis)};
}

/// A line for each direction that has one, else one for all.
std::vector<std::pair<Direction, const BiasLineSummary*>> bias_lines(const Comparison& comparison) {
    std::vector<std::pair<Direction, const BiasLineSummary*>> lines;
    for (const Direction& direction : directions_of(comparison)) {
        const BiasLineSummary* line = bias_of(comparison, direction.name);
        if (line != nullptr && lines.size() < k_most_panels) {
            lines.emplace_back(direction, line);
        }
    }
    if (const BiasLineSummary* line = bias_of(comparison, "all"); lines.empty() && line != nullptr) {
        Direction all;
        for (const ComparisonPoint& p : comparison.points) {
            all.points.push_back(&p);
        }
        lines.emplace_back(std::move(all), line);
    }
    return lines;
}

/// \param positions  of the points; null: they stand at their reference values
std::vector<BiasPanel> bias_panels(const Comparison& comparison, const BiasAxes& axes, const PositionAxis* positions,
                                   const Wording& words, const std::string& id) {
    std::vector<BiasPanel> panels;
    for (const auto& [direction, line] : bias_lines(comparison)) {
        BiasPanel panel{
            .heading = direction.name.empty() ? "" : panel_name(direction, words), .points = {}, .line = {}};
        for (std::size_t i = 0; i < direction.points.size(); ++i) {
            const ComparisonPoint& p = *direction.points[i];
            const double x = positions != nullptr ? positions->of(direction, i) : axes.across(p.reference_value.number);
            panel.points.push_back({.x = on_axis(id, x),
                                    .y = on_axis(id, axes.up(p.D.number)),
                                    .U = on_axis(id, axes.up(p.U_D.number.value_or(0.0)))});
            panel.ends = i == 0 ? AxisRange{.low = x, .high = x} : panel.ends;
            panel.ends.include(x);
        }
        panel.points = visible(std::move(panel.points));
        const double slope = axes.up(line->slope.number) / axes.across(1.0);  // in the units of the axes
        for (const double x : {panel.ends.low, panel.ends.high}) {
            panel.line.emplace_back(
                x, on_axis(id, axes.up(line->constant.number) + slope * (x - axes.across(line->centre.number))));
        }
        panels.push_back(std::move(panel));
    }
    return panels;
}

/// The frame of each panel, but for its place in the grid.
PlotFrame bias_frame(const std::vector<BiasPanel>& panels, const PanelGrid& grid, bool is_angle) {
    AxisRange x_range = panels.front().ends;
    AxisRange y_range = range_of_differences(panels);
    for (const BiasPanel& panel : panels) {
        x_range.include(panel.ends.low);
        x_range.include(panel.ends.high);
        for (const auto& [x, y] : panel.line) {
            y_range.include(y);
        }
    }
    PlotFrame frame{.height = grid.panel_height, .margin = k_margin};
    frame.across = is_angle ? angle_ticks(x_range.low, x_range.high) : nice_ticks(x_range.low, x_range.high, 8);
    y_range = y_range.widened(k_room_at_ends);
    frame.up = nice_ticks(y_range.low, y_range.high, 5);
    frame.x = room_for_axis(frame.up);
    frame.width = k_drawing_width / grid.columns - frame.x - 16.0;
    return frame;
}

PlotKey bias_key(const std::vector<BiasPanel>& panels, const PlotFrame& frame, const Wording& words) {
    const bool beyond = std::any_of(panels.begin(), panels.end(), [&](const BiasPanel& panel) {
        return std::any_of(panel.points.begin(), panel.points.end(),
                           [&](const PlotPoint& p) { return p.y < frame.up.low || p.y > frame.up.high; });
    });
    PlotKey key;
    key.add(Symbol::bar, words("plot", "difference_key").first());
    key.add(Symbol::line, words("plot", "bias_key").first());
    if (beyond) {
        key.add(Symbol::beyond, words("plot", "beyond_key").first());
    }
    return key;
}

/// Zero, the differences, the line of the bias.
void draw_bias(Drawing& body, const PlotFrame& frame, const BiasPanel& panel) {
    body.line(frame.x, frame.py(0.0), frame.right(), frame.py(0.0), "stroke=\"#000000\" stroke-width=\"0.7\"");
    draw_differences(body, frame, panel.points);
    const auto& [x1, y1] = panel.line.front();
    const auto& [x2, y2] = panel.line.back();
    body.line(frame.px(x1), frame.py(y1), frame.px(x2), frame.py(y2), "stroke=\"#000000\" stroke-width=\"1.2\"");
    draw_outline(body, frame);
}

}  // namespace

std::string method_scores_plot(const Comparison& comparison, const std::string& id, const Wording& words) {
    const std::vector<Direction> directions = directions_of(comparison);
    const PositionAxis axis(comparison, words);
    if (std::none_of(comparison.points.begin(), comparison.points.end(),
                     [](const ComparisonPoint& p) { return p.En.number.has_value(); })) {
        return "";
    }
    // A cross stands for what is beyond the axis, and for no direction.
    static constexpr std::array<PlotMarker, 4> k_markers = {PlotMarker::disc, PlotMarker::square, PlotMarker::triangle,
                                                            PlotMarker::ring};
    const bool together = directions.size() <= k_markers.size() && most_points(directions) <= k_many;
    const bool one_panel = together || directions.size() > k_most_panels;
    const PanelGrid grid(one_panel ? 1 : directions.size(), 180.0);
    Plot plot = plot_over(axis, grid, comparison, words, "method_scores");
    plot.id = id;
    if (one_panel) {
        PlotPanel panel = score_panel(words);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            PlotSeries series = score_series(directions[i], axis);
            series.marker = together ? k_markers.at(i) : PlotMarker::disc;
            if (together) {
                series.label = shortened_name(printable(directions[i].name), 40);
            }
            if (!series.points.empty()) {
                panel.series.push_back(std::move(series));
            }
        }
        mark_beyond(panel, k_most_score, words);
        plot.panels.push_back(std::move(panel));
    } else {
        for (const Direction& direction : directions) {
            PlotPanel panel = score_panel(words);
            panel.heading = panel_name(direction, words);
            panel.series = {score_series(direction, axis)};
            mark_beyond(panel, k_most_score, words);
            plot.panels.push_back(std::move(panel));
        }
    }
    return svg(plot);
}

std::string method_values_plot(const Comparison& comparison, const std::string& id, const Wording& words) {
    const std::vector<Direction> directions = directions_of(comparison);
    double largest = 0.0;
    std::vector<double> differences;  // or uncertainties, whatever is larger
    for (const ComparisonPoint& p : comparison.points) {
        differences.push_back(
            std::max({p.U.number.value_or(0.0), p.reference_U.number.value_or(0.0), std::abs(p.D.number)}));
        for (const double v : {p.value.number, p.reference_value.number}) {
            largest = std::max(largest, std::abs(v));
        }
    }
    std::vector<double> magnitudes;
    for (const ComparisonPoint& p : comparison.points) {
        magnitudes.push_back(std::abs(p.value.number));
        magnitudes.push_back(std::abs(p.reference_value.number));
    }
    // A single value far from all others must not take the room of all.
    constexpr double k_spreads = 20.0;
    const double bulk = middle_of(magnitudes) + k_spreads * spread_of(magnitudes);
    const double most = bulk > 0.0 ? std::min(largest, bulk) : largest;
    constexpr double k_visible = 2e-3;
    if (directions.empty() || directions.size() > k_most_panels || middle_of(differences) < k_visible * most) {
        return "";
    }
    const PositionAxis axis(comparison, words);
    const AxisScale scale = AxisScale::of(most, k_most_of_axis);
    const Wording::Values names = method_names(comparison, words);
    const PanelGrid grid(directions.size(), 190.0);
    Plot plot = plot_over(axis, grid, comparison, words, "method_values");
    plot.id = id;
    for (const Direction& direction : directions) {
        const std::string name = shortened(printable(direction.name), 14);
        PlotPanel panel{
            .heading = panel_name(direction, words),
            .y_label = scale.label(name.empty() ? words("label", "value").first() : name,
                                   gum::unit_for_people(comparison.unit)),
            .series = {value_series(direction, axis, scale, false), value_series(direction, axis, scale, true)},
            .limits = {},
            .y_in_power = scale.exponent != 0};
        panel.series[0].label = shortened(names[0].second.first(), 40);
        panel.series[1].label = shortened(names[1].second.first(), 40);
        if (most < largest) {
            mark_beyond(panel, scale(most), words);
        }
        plot.panels.push_back(std::move(panel));
    }
    return svg(plot);
}

std::string bias_plot(const Comparison& comparison, const std::string& id, const Wording& words) {
    const std::optional<std::string> against = bias_argument(comparison);
    if (!against) {
        return "";
    }
    const PositionAxis positions(comparison, words);
    const bool by_position = *against == "position" && positions.kind != PositionAxis::Kind::number;
    const BiasAxes axes = bias_axes(comparison, positions, by_position);
    const std::vector<BiasPanel> panels = bias_panels(comparison, axes, by_position ? &positions : nullptr, words, id);
    if (panels.empty()) {
        return "";
    }
    const PanelGrid grid(panels.size(), 190.0);
    PlotFrame frame = bias_frame(panels, grid, by_position && positions.is_angle(comparison));
    const Wording::Values names = method_names(comparison, words);
    const std::string unit = gum::unit_for_people(comparison.unit);
    const std::string x_title =
        by_position
            ? positions.title
            : axes.across.label(
                  words.filled("plot", "reference_value_axis", {{"reference", shortened(names[1].second.first(), 40)}})
                      .first(),
                  unit);
    const std::string y_title = axes.up.label(words("plot", "difference_axis").first(), unit);
    Drawing body;
    const bool headed = panels.size() > 1 || !panels[0].heading.empty();
    const double head = headed ? 22.0 : 4.0;
    const double top = bias_key(panels, frame, words).draw(body, frame.x, k_drawing_width);
    const double pitch = head + frame.height + 8.0;
    for (std::size_t i = 0; i < panels.size(); ++i) {
        const int column = static_cast<int>(i) / grid.rows;
        const int row = static_cast<int>(i) % grid.rows;
        frame.x = column * (k_drawing_width / grid.columns) + room_for_axis(frame.up);
        frame.y = top + row * pitch + head;
        if (headed) {
            body.text(frame.x, frame.y - 7.0, panels[i].heading, "start", 11.0, " font-weight=\"bold\"");
        }
        draw_up_axis(body, frame, y_title);
        if (row + 1 == grid.rows || i + 1 == panels.size()) {
            draw_across_axis(body, frame, x_title);
        }
        draw_bias(body, frame, panels[i]);
    }
    const double height = top + grid.rows * pitch + 34.0;
    return plot_document(id, words.filled("plot", "bias_title", names).first(),
                         words("plot", "bias_description").first(), height, body);
}

}  // namespace gumcert::reports
