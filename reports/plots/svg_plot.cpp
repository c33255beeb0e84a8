#include "reports/plots/svg_plot.h"

#include "reports/plots/plot_frame.h"
#include "reports/plots/svg_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

constexpr double k_left = 50.0;   // room for tick labels and the axis label, at least
constexpr double k_title = 12.0;  // of it, left of the middle of the axis label
constexpr double k_right = 10.0;
constexpr double k_head = 22.0;     // room for the heading of a panel
constexpr double k_foot = 8.0;      // below a panel that has no tick labels
constexpr double k_axis = 42.0;     // tick labels and label of the horizontal axis
constexpr double k_key = 20.0;      // the key above the panels
constexpr double k_between = 14.0;  // between columns
constexpr const char* k_plot_grid = "stroke=\"#e2e2e2\" stroke-width=\"0.6\"";
constexpr const char* k_plot_tick = "stroke=\"#000000\" stroke-width=\"0.8\"";
constexpr const char* k_solid = "fill=\"none\" stroke=\"#000000\" stroke-width=\"1\"";
constexpr const char* k_dashed = "fill=\"none\" stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"5 2.5\"";
constexpr const char* k_dotted = "fill=\"none\" stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"1.2 2.4\"";
constexpr const char* k_edge = "fill=\"none\" stroke=\"#555555\" stroke-width=\"0.8\" stroke-dasharray=\"2 2\"";
constexpr std::size_t k_many_points = 150;  // points of a series above which they are drawn as one path

const char* line_style(const PlotSeries& series) {
    return series.dotted ? k_dotted : series.dashed ? k_dashed : k_solid;
}

/// One path of dots for points too many to be told apart one by one. Dots that fall on the same place are drawn once.
void draw_dense(Drawing& drawing, const std::vector<PlotPoint>& sorted, const PlotFrame& frame, double shift) {
    std::set<std::pair<long, long>> places;  // twice the drawing units
    for (const PlotPoint& p : sorted) {
        places.emplace(std::lround(2.0 * (frame.px(p.x) + shift)), std::lround(2.0 * frame.py(p.y)));
    }
    drawing.body += "<path d=\"";
    for (const auto& [x, y] : places) {
        const double left = 0.5 * static_cast<double>(x) - 0.8;
        drawing.body += "M" + drawing_number(left) + "," + drawing_number(0.5 * static_cast<double>(y)) + "h1.6";
    }
    drawing.body += "\" fill=\"none\" stroke=\"#000000\" stroke-width=\"1.6\"/>\n";
}

/// Of points too many to be told apart, those at the edges of every place: the lowest and the highest curve, and the
/// lowest and the highest end of U.
std::vector<PlotPoint> thinned(const std::vector<PlotPoint>& sorted, const PlotFrame& frame) {
    if (static_cast<double>(sorted.size()) <= 4.0 * frame.width) {
        return sorted;
    }
    std::vector<PlotPoint> kept;
    for (std::size_t from = 0; from < sorted.size();) {
        const auto place = [&](std::size_t i) { return std::floor(frame.px(sorted[i].x)); };
        std::size_t to = from;
        std::array<std::size_t, 4> extremes = {from, from, from, from};
        for (; to < sorted.size() && place(to) == place(from); ++to) {
            const auto take = [&](std::size_t at, double candidate, double present) {
                extremes.at(at) = candidate > present ? to : extremes.at(at);
            };
            const PlotPoint& p = sorted[to];
            take(0, p.y, sorted[extremes[0]].y);
            take(1, -p.y, -sorted[extremes[1]].y);
            take(2, p.y + p.U, sorted[extremes[2]].y + sorted[extremes[2]].U);
            take(3, p.U - p.y, sorted[extremes[3]].U - sorted[extremes[3]].y);
        }
        std::sort(extremes.begin(), extremes.end());
        for (std::size_t i = 0; i < extremes.size(); ++i) {
            if (i == 0 || extremes.at(i) != extremes.at(i - 1)) {
                kept.push_back(sorted[extremes.at(i)]);
            }
        }
        from = to;
    }
    return kept;
}

void draw_curve(Drawing& drawing, const std::vector<PlotPoint>& sorted, const PlotFrame& frame, double shift,
                double sign_of_U, const char* style) {
    std::vector<std::pair<double, double>> curve;
    for (const PlotPoint& p : sorted) {
        curve.emplace_back(frame.px(p.x) + shift, frame.py(p.y + sign_of_U * p.U));
    }
    drawing.points("polyline", curve, style);
}

void draw_series(Drawing& drawing, const PlotSeries& series, const PlotFrame& frame) {
    std::vector<PlotPoint> sorted = series.points;
    std::stable_sort(sorted.begin(), sorted.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    const double radius = sorted.size() > 80 ? 1.3 : 2.2;
    const auto x = [&](const PlotPoint& p) { return frame.px(p.x) + series.shift; };
    const bool many_bars =
        sorted.size() > k_many_points && (series.marker == PlotMarker::bar || series.marker == PlotMarker::broken_bar);
    if (series.joined || series.bars == PlotBars::band || many_bars) {
        sorted = thinned(sorted, frame);
    }
    if (sorted.size() > k_many_points && series.marker == PlotMarker::disc && !series.joined) {
        draw_dense(drawing, sorted, frame, series.shift);
        return;
    }
    if (series.bars == PlotBars::band && !sorted.empty()) {
        std::vector<std::pair<double, double>> outline;
        for (const PlotPoint& p : sorted) {
            outline.emplace_back(x(p), frame.py(p.y + p.U));
        }
        for (auto p = sorted.rbegin(); p != sorted.rend(); ++p) {
            outline.emplace_back(x(*p), frame.py(p->y - p->U));
        }
        drawing.points("polygon", outline, "fill=\"#cfcfcf\" stroke=\"none\"");
    }
    if (series.bars == PlotBars::bars) {
        for (const PlotPoint& p : sorted) {
            if (p.U > 0.0) {
                constexpr const char* k_bar = "stroke=\"#555555\" stroke-width=\"0.8\"";
                drawing.line(x(p), frame.py(p.y - p.U), x(p), frame.py(p.y + p.U), k_bar);
                drawing.line(x(p) - 1.8, frame.py(p.y - p.U), x(p) + 1.8, frame.py(p.y - p.U), k_bar);
                drawing.line(x(p) - 1.8, frame.py(p.y + p.U), x(p) + 1.8, frame.py(p.y + p.U), k_bar);
            }
        }
    }
    if (series.bars == PlotBars::edges) {
        for (const double sign : {-1.0, 1.0}) {
            draw_curve(drawing, sorted, frame, series.shift, sign, k_edge);
        }
    }
    if (series.joined) {
        draw_curve(drawing, sorted, frame, series.shift, 0.0, line_style(series));
    }
    if (series.joined && sorted.size() > k_many_points) {
        return;  // markers would hide the curve
    }
    for (const PlotPoint& p : sorted) {
        drawing.marker(series.marker, x(p), frame.py(p.y), radius);
    }
}

/// Where a text stands, in drawing units.
struct TextBox {
    double left, right, upper, lower;
};

/// The label of a limit, at the end of its line where nothing is in the way: else on its other side, or further left.
/// \param labels  those that stand already; this one is added
void draw_limit_label(Drawing& drawing, const PlotPanel& panel, const PlotLimit& limit, const PlotFrame& frame,
                      std::vector<TextBox>& labels) {
    struct Place {
        double x, y;
        const char* anchor;
        double left;
    };
    constexpr double k_size = 10.0;
    constexpr std::size_t k_outside = 1'000'000;  // worse than any number of points
    const double width = label_width(limit.label, k_size);
    const double line = frame.py(limit.y);
    const auto hidden_at = [&](const Place& place) {
        const double upper = place.y - 0.8 * k_size;
        const double lower = place.y + 0.2 * k_size;
        std::size_t count = upper < frame.y || lower > frame.bottom() ? k_outside : 0;
        for (const PlotLimit& other : panel.limits) {
            const double y = frame.py(other.y);
            count += y > upper && y < lower ? k_outside : 0;
        }
        for (const TextBox& label : labels) {
            const bool apart = label.right < place.left || label.left > place.left + width || label.lower < upper ||
                               label.upper > lower;
            count += apart ? 0 : k_outside;
        }
        for (const PlotSeries& series : panel.series) {
            for (const PlotPoint& p : series.points) {
                const double x = frame.px(p.x) + series.shift;
                const double U = series.bars == PlotBars::none ? 0.0 : p.U;
                const bool across = x > place.left - 3.0 && x < place.left + width + 3.0;
                if (across && frame.py(p.y - U) > upper - 3.0 && frame.py(p.y + U) < lower + 3.0) {
                    ++count;
                }
            }
        }
        return count;
    };
    const double above = line - 4.0;
    const double below = line + 11.0;
    std::optional<Place> best;
    std::size_t least = 0;
    for (const double y : limit.y < 0.0 ? std::array{below, above} : std::array{above, below}) {
        const double right = frame.right() - 4.0;
        std::vector<Place> places = {{right, y, "end", right - width}, {frame.x + 4.0, y, "start", frame.x + 4.0}};
        constexpr int k_parts = 16;
        for (int i = k_parts - 2; i > 1; --i) {
            const double middle = frame.x + frame.width * i / k_parts;
            places.push_back({middle, y, "middle", middle - 0.5 * width});
        }
        for (const Place& place : places) {
            const std::size_t hidden = hidden_at(place);
            if (!best || hidden < least) {
                best = place;
                least = hidden;
            }
        }
    }
    drawing.text(best->x, best->y, limit.label, best->anchor, k_size);
    labels.push_back({best->left, best->left + width, best->y - 0.8 * k_size, best->y + 0.2 * k_size});
}

void draw_panel(Drawing& drawing, const PlotPanel& panel, const PlotFrame& frame, double left, bool with_axis) {
    drawing.text(frame.x, frame.y - 7.0, panel.heading, "start", 11.0, " font-weight=\"bold\"");
    drawing.rectangle(frame.x, frame.y, frame.width, frame.height, "fill=\"#ffffff\" stroke=\"none\"");
    draw_across_grid(drawing, frame);
    draw_up_ticks(drawing, frame);
    for (const PlotSeries& series : panel.series) {
        if (series.bars == PlotBars::band) {
            draw_series(drawing, series, frame);
        }
    }
    if (frame.up.low < 0.0 && frame.up.high > 0.0) {
        drawing.line(frame.x, frame.py(0.0), frame.x + frame.width, frame.py(0.0),
                     "stroke=\"#000000\" stroke-width=\"0.7\"");
    }
    std::vector<TextBox> labels;
    for (const PlotLimit& limit : panel.limits) {
        const double y = frame.py(limit.y);
        drawing.line(frame.x, y, frame.x + frame.width, y,
                     limit.dotted ? "stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"1.2 2.4\""
                                  : "stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"6 3\"");
        draw_limit_label(drawing, panel, limit, frame, labels);
    }
    for (const PlotSeries& series : panel.series) {
        if (series.bars == PlotBars::band) {
            PlotSeries upper = series;  // the curve again, above the zero line
            upper.bars = PlotBars::none;
            draw_series(drawing, upper, frame);
        } else {
            draw_series(drawing, series, frame);
        }
    }
    for (const PlotMark& mark : panel.marks) {
        const double at = frame.px(mark.x);
        drawing.line(at, frame.y, at, frame.bottom(),
                     "stroke=\"#000000\" stroke-width=\"0.7\" stroke-dasharray=\"2 2\"");
        drawing.text(at + 2.5, frame.y + 10.0, mark.label, "start", 9.0);
    }
    draw_outline(drawing, frame);
    draw_across_ticks(drawing, frame, with_axis);
    draw_upright_title(drawing, frame.x - left + k_title, frame.y + 0.5 * frame.height, frame.height, panel.y_label);
}

/// A low panel from zero up, with ticks at both ends only.
void draw_strip(Drawing& drawing, const PlotPanel& panel, const PlotFrame& frame, bool with_axis) {
    drawing.rectangle(frame.x, frame.y, frame.width, frame.height, "fill=\"#ffffff\" stroke=\"none\"");
    draw_across_grid(drawing, frame);
    draw_up_ticks(drawing, frame);
    for (const PlotSeries& series : panel.strip) {
        draw_series(drawing, series, frame);
    }
    draw_outline(drawing, frame);
    draw_across_ticks(drawing, frame, with_axis);
    drawing.text(frame.x + 4.0, frame.y + 9.5, panel.strip_label, "start", 9.0);
}

/// Zero and a step far enough above the strip that its label stands over it.
Ticks strip_ticks(const PlotPanel& panel) {
    double most = 0.0;
    for (const PlotSeries& series : panel.strip) {
        for (const PlotPoint& p : series.points) {
            most = std::max(most, p.y);
        }
    }
    Ticks ticks = nice_ticks(0.0, most > 0.0 ? 2.0 * most : 1.0, 4);
    const double high = ticks.high;
    ticks.step = high;
    return ticks;
}

/// A rectangle in the style of the part of that number: eight fillings that differ in grey and hatching.
void fill_part(Drawing& drawing, double x, double y, double width, double height, std::size_t part) {
    struct Style {
        const char* fill;
        bool rising, falling;
    };
    static constexpr std::array<Style, 8> k_styles = {{{"#ffffff", false, false},
                                                       {"#8c8c8c", false, false},
                                                       {"#ffffff", true, false},
                                                       {"#d4d4d4", false, false},
                                                       {"#ffffff", false, true},
                                                       {"#4d4d4d", false, false},
                                                       {"#ffffff", true, true},
                                                       {"#b3b3b3", true, false}}};
    const Style& style = k_styles.at(part % k_styles.size());
    const std::string outline = std::string("fill=\"") + style.fill + "\" stroke=\"#000000\" stroke-width=\"0.8\"";
    drawing.rectangle(x, y, width, height, outline.c_str());
    constexpr double k_spacing = 5.0;
    for (const bool rising : {true, false}) {
        if (!(rising ? style.rising : style.falling)) {
            continue;
        }
        // Lines at 45 degrees through the lower edge at `from`, cut off at the sides.
        for (double from = -height + k_spacing; from < width; from += k_spacing) {
            const double low = std::max(0.0, from);
            const double high = std::min(width, from + height);
            const double left = rising ? low : width - low;
            const double right = rising ? high : width - high;
            drawing.line(x + left, y + height - (low - from), x + right, y + height - (high - from),
                         "stroke=\"#000000\" stroke-width=\"0.6\"");
        }
    }
}

/// The marker of a series, or what stands in its place where its points have none.
void draw_key_symbol(Drawing& drawing, const PlotSeries& series, double x, double y) {
    const std::vector<std::pair<double, double>> line = {{x - 10.0, y}, {x + 4.0, y}};
    if (series.marker != PlotMarker::none) {
        drawing.marker(series.marker, x, y, 2.6);
    } else if (series.bars == PlotBars::band) {
        drawing.rectangle(x - 10.0, y - 4.0, 14.0, 8.0, "fill=\"#cfcfcf\" stroke=\"none\"");
    } else if (series.bars == PlotBars::edges) {
        drawing.points("polyline", line, k_edge);
        return;
    }
    if (series.joined) {
        drawing.points("polyline", line, line_style(series));
    }
}

/// The key above the panels, in as many lines as it needs.
/// \return its height
double draw_key(Drawing& drawing, const std::vector<PlotSeries>& series) {
    constexpr double k_line = 16.0;
    constexpr double k_letter = 6.4;
    const double scale = k_letter / text_width("x", 1.0);
    double x = k_left + 6.0;
    double y = 0.5 * k_key;
    for (const PlotSeries& s : series) {
        const double room = 8.0 + scale * label_width(s.label, 1.0);
        if (x + room > k_drawing_width && x > k_left + 6.0) {
            x = k_left + 6.0;
            y += k_line;
        }
        draw_key_symbol(drawing, s, x, y);
        drawing.text(x + 8.0, y + 3.5, s.label, "start", 10.5);
        x += room + 18.0;
    }
    return series.empty() ? 0.0 : y + 0.5 * k_key;
}

/// Ticks at whole numbers. The axis ends behind the last point, not at the next tick.
Ticks number_ticks(double low, double high, int most) {
    if (high - low < 1.0) {
        return {.low = std::floor(low) - 1.0, .high = std::ceil(high) + 1.0};
    }
    Ticks ticks = nice_ticks(low, high, most);
    if (ticks.decimals != 0) {
        return {.low = std::floor(low), .high = std::ceil(high)};
    }
    ticks.high = std::min(ticks.high, std::ceil(high) + 1.0);
    return ticks;
}

std::vector<double> ends_of_bars(const PlotPanel& panel) {
    std::vector<double> ends;
    for (const PlotSeries& series : panel.series) {
        for (const PlotPoint& p : series.points) {
            const double U = series.bars == PlotBars::none ? 0.0 : p.U;
            ends.insert(ends.end(), {p.y - U, p.y + U});
        }
    }
    return ends;
}

/// The axis of values that lie further from zero than they and their limits from each other: from zero on, neither their
/// uncertainty nor what is left to a limit could be seen.
std::optional<AxisRange> range_far_from_zero(const PlotPanel& panel) {
    std::vector<double> ends = ends_of_bars(panel);
    for (const PlotLimit& limit : panel.limits) {
        ends.push_back(limit.y);
    }
    if (!panel.values || panel.y_most > 0.0 || ends.empty()) {
        return std::nullopt;
    }
    const auto [low, high] = std::minmax_element(ends.begin(), ends.end());
    const double spread = *high - *low;
    // Labels of more digits would leave no room for the plot.
    constexpr double k_least_spread = 1e-5;
    const bool is_far =
        spread > k_least_spread * std::max(std::abs(*low), std::abs(*high)) && (*low > spread || *high < -spread);
    return is_far ? std::optional(AxisRange{.low = *low, .high = *high}.widened(0.15)) : std::nullopt;
}

/// What the vertical axis of a panel shows. The zero line belongs to every panel of errors and differences: they are read
/// against it.
AxisRange range_of(const PlotPanel& panel, double margin) {
    if (const std::optional<AxisRange> far = range_far_from_zero(panel)) {
        return *far;
    }
    AxisRange range{.low = -panel.y_most, .high = panel.y_most};
    for (const PlotLimit& limit : panel.limits) {
        range.include(limit.y * 1.15);
    }
    if (panel.y_most > 0.0) {
        return range;
    }
    const std::vector<double> ends = ends_of_bars(panel);
    for (const double end : ends) {
        range.include(end);
    }
    const double room = margin * (range.high - range.low);
    for (const double end : ends) {
        range.include(end - room);
        range.include(end + room);
    }
    return range;
}

void require_finite(const Plot& plot) {
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            for (const PlotPoint& p : series.points) {
                require_ordinary(plot.id + ", " + panel.heading, {p.x, p.y, p.U});
            }
        }
        for (const PlotSeries& series : panel.strip) {
            for (const PlotPoint& p : series.points) {
                require_ordinary(plot.id + ", " + panel.heading, {p.x, p.y, p.U});
            }
        }
    }
}

/// Room left of a panel for the labels of its vertical axis and its title.
double room_left(const Ticks& up) {
    constexpr double k_beside_labels = 21.0;  // tick, and the title beside the labels
    return std::max(k_left, widest_label(up) + k_beside_labels);
}

/// The plot with each axis in a power of ten that keeps its labels short: "Error / (10⁻¹² F)". Labels of numbers as they are
/// ran into the title of the axis, and beyond the picture: 5000000000 was read as 500000000.
Plot in_powers_of_ten(Plot plot) {
    double across = 0.0;
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            for (const PlotPoint& p : series.points) {
                across = std::max(across, std::abs(p.x));
            }
        }
    }
    const AxisScale x_scale =
        plot.x_is_angle || plot.x_is_number || plot.x_in_power ? AxisScale() : AxisScale::of(across);
    plot.x_label = x_scale.label(plot.x_label);
    for (PlotPanel& panel : plot.panels) {
        const AxisRange range = range_of(panel, 0.0);
        const AxisScale y_scale =
            panel.y_in_power ? AxisScale() : AxisScale::of(std::max(std::abs(range.low), std::abs(range.high)));
        panel.y_label = y_scale.label(panel.y_label);
        panel.strip_label = y_scale.label(panel.strip_label);
        panel.y_most = y_scale(panel.y_most);
        for (PlotLimit& limit : panel.limits) {
            limit.y = y_scale(limit.y);
        }
        for (PlotMark& mark : panel.marks) {
            mark.x = x_scale(mark.x);
        }
        for (std::vector<PlotSeries>* all : {&panel.series, &panel.strip}) {
            for (PlotSeries& series : *all) {
                for (PlotPoint& p : series.points) {
                    p = {.x = x_scale(p.x), .y = y_scale(p.y), .U = y_scale(p.U)};
                }
            }
        }
    }
    return plot;
}

}  // namespace

std::string svg(const Plot& stated) {
    require_finite(stated);
    const Plot plot = in_powers_of_ten(stated);
    double x_low = std::numeric_limits<double>::max();
    double x_high = std::numeric_limits<double>::lowest();
    std::vector<PlotSeries> key;
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            for (const PlotPoint& p : series.points) {
                x_low = std::min(x_low, p.x);
                x_high = std::max(x_high, p.x);
            }
            const bool known =
                std::any_of(key.begin(), key.end(), [&](const auto& k) { return k.label == series.label; });
            if (!series.label.empty() && !known) {
                key.push_back(series);
            }
        }
    }
    const int count = static_cast<int>(plot.panels.size());
    const int columns = std::max(1, plot.columns);
    const int rows = (count + columns - 1) / columns;
    const double column_width = (k_drawing_width - (columns - 1) * k_between) / columns;
    std::vector<Ticks> ups;
    double left = k_left;
    for (const PlotPanel& panel : plot.panels) {
        const AxisRange range = range_of(panel, plot.margin / plot.panel_height);
        ups.push_back(nice_ticks(range.low, range.high, plot.panel_height > 100.0 ? 6 : 4));
        left = std::max(left, room_left(ups.back()));
    }
    Ticks across;
    if (x_low <= x_high) {
        across = plot.x_is_number  ? number_ticks(x_low, x_high, 8)
                 : plot.x_is_angle ? angle_ticks(x_low, x_high, plot.columns > 2 ? 4 : 8)
                                   : ticks_apart(x_low, x_high, 8, column_width - left - k_right);
    }
    const double right = room_for_last_label(across, k_right);

    Drawing drawing;
    const double top = draw_key(drawing, key);
    const double strip = plot.strip_height > 0.0 ? plot.strip_height + k_foot : 0.0;
    const double panel_pitch = k_head + plot.panel_height + strip + k_foot;
    const double height = top + rows * panel_pitch - k_foot + k_axis;

    for (int i = 0; i < count; ++i) {
        PlotPanel panel = plot.panels[static_cast<std::size_t>(i)];
        const int column = i / rows;
        const int row = i % rows;
        const PlotFrame frame{.x = column * (column_width + k_between) + left,
                              .y = top + row * panel_pitch + k_head,
                              .width = column_width - left - right,
                              .height = plot.panel_height,
                              .across = across,
                              .up = ups[static_cast<std::size_t>(i)],
                              .margin = plot.margin};
        if (panel.y_most > 0.0) {
            const double room = 3.0 * (frame.up.high - frame.up.low) / frame.height;  // the marker stays inside
            for (PlotSeries& series : panel.series) {
                for (PlotPoint& p : series.points) {
                    p.y = std::clamp(p.y, frame.up.low + room, frame.up.high - room);
                }
            }
        }
        const bool lowest = row == rows - 1 || i == count - 1;
        draw_panel(drawing, panel, frame, left, lowest && strip == 0.0);
        PlotFrame below = frame;
        if (strip > 0.0) {
            below.y = frame.bottom() + k_foot;
            below.height = plot.strip_height;
            below.up = strip_ticks(panel);
            draw_strip(drawing, panel, below, lowest);
        }
        if (lowest) {
            draw_across_title(drawing, below, plot.x_label);
        }
    }

    return plot_document(plot.id, plot.title, plot.description, height, drawing);
}

std::string svg(const BarPlot& plot) {
    constexpr double k_texts = 46.0;  // room for the text at the end of a bar
    constexpr double k_pitch = 17.0;
    constexpr double k_bar = 11.0;
    double low = 0.0;
    double high = 0.0;
    double labels = 60.0;  // room for the names
    for (const ShareBar& bar : plot.bars) {
        require_ordinary(plot.id + ", " + bar.label, {bar.share});
        labels = std::max(labels, std::min(200.0, 16.0 + 6.0 * static_cast<double>(bar.label.size())));
        low = std::min(low, bar.share);
        high = std::max(high, bar.share);
    }
    const Ticks ticks = nice_ticks(low, high, 10);
    const double top = 4.0;
    const double bottom = top + k_pitch * static_cast<double>(plot.bars.size()) + 3.0;
    const double height = bottom + k_axis;
    const double width = k_drawing_width - labels - k_texts;
    const auto px = [&](double v) { return labels + (v - ticks.low) / (ticks.high - ticks.low) * width; };

    Drawing drawing;
    for (int i = 0; i < ticks.count(); ++i) {
        const double x = px(ticks.at(i));
        drawing.line(x, top, x, bottom, k_plot_grid);
        drawing.line(x, bottom, x, bottom + 4.0, k_plot_tick);
        drawing.text(x, bottom + 15.0, tick_text(ticks.at(i), ticks.decimals), "middle", 10.0);
    }
    for (std::size_t i = 0; i < plot.bars.size(); ++i) {
        const ShareBar& bar = plot.bars[i];
        const double y = top + k_pitch * (static_cast<double>(i) + 0.5);
        const double from = px(std::min(0.0, bar.share));
        const double to = px(std::max(0.0, bar.share));
        drawing.rectangle(from, y - 0.5 * k_bar, to - from, k_bar,
                          "fill=\"#b5b5b5\" stroke=\"#000000\" stroke-width=\"0.8\"");
        drawing.text(labels - 8.0, y + 3.6, bar.label, "end", 10.5);
        drawing.text(to + 5.0, y + 3.6, bar.text, "start", 10.5);
    }
    drawing.line(px(0.0), top, px(0.0), bottom, "stroke=\"#000000\" stroke-width=\"0.9\"");
    drawing.line(labels, bottom, labels + width, bottom, "stroke=\"#000000\" stroke-width=\"0.9\"");
    drawing.text(labels + 0.5 * width, bottom + 31.0, plot.x_label, "middle", 11.0);
    return plot_document(plot.id, plot.title, plot.description, height, drawing);
}

std::string svg(const DensityPlot& plot) {
    constexpr double k_strip = 19.0;  // room for one interval above the curve
    constexpr double k_curve = 190.0;
    constexpr double k_side = 26.0;
    double low = plot.low;
    double high = plot.high;
    double most = 0.0;
    require_ordinary(plot.id, {plot.low, plot.high, plot.first_edge, plot.cell_width});
    for (const double cell : plot.cells) {
        require_ordinary(plot.id, {cell});
        most = std::max(most, cell);
    }
    for (const PlotPoint& p : plot.curve) {
        require_ordinary(plot.id, {p.x, p.y});
        most = std::max(most, p.y);
    }
    for (const DensityInterval& interval : plot.intervals) {
        require_ordinary(plot.id + ", " + interval.label, {interval.low, interval.high});
        low = std::min(low, interval.low);
        high = std::max(high, interval.high);
    }
    const double strips = k_strip * static_cast<double>(plot.intervals.size());
    const Ticks across = ticks_apart(low, high, 10, k_drawing_width - k_side - k_right);
    const PlotFrame frame{.x = k_side,
                          .y = k_key + 2.0,
                          .width = k_drawing_width - k_side - room_for_last_label(across, k_right),
                          .height = strips + k_curve,
                          .across = across,
                          .up = {.low = 0.0, .high = most > 0.0 ? most * (strips + k_curve) / (0.96 * k_curve) : 1.0}};
    const double bottom = frame.y + frame.height;
    const double height = bottom + k_axis;

    Drawing drawing;
    drawing.rectangle(frame.x, 5.0, 16.0, 9.0, "fill=\"#cfcfcf\" stroke=\"#777777\" stroke-width=\"0.6\"");
    drawing.text(frame.x + 21.0, 13.5, plot.cells_label, "start", 10.5);
    const double second = frame.x + 0.42 * frame.width;
    drawing.line(second, 9.5, second + 22.0, 9.5, "stroke=\"#000000\" stroke-width=\"1.3\"");
    drawing.text(second + 27.0, 13.5, plot.curve_label, "start", 10.5);

    if (!plot.cells.empty()) {
        std::vector<std::pair<double, double>> outline = {{frame.px(plot.first_edge), bottom}};
        for (std::size_t i = 0; i < plot.cells.size(); ++i) {
            const double left = plot.first_edge + static_cast<double>(i) * plot.cell_width;
            outline.emplace_back(frame.px(left), frame.py(plot.cells[i]));
            outline.emplace_back(frame.px(left + plot.cell_width), frame.py(plot.cells[i]));
        }
        outline.emplace_back(outline.back().first, bottom);
        drawing.points("polygon", outline, "fill=\"#cfcfcf\" stroke=\"#777777\" stroke-width=\"0.6\"");
    }
    std::vector<std::pair<double, double>> curve;
    for (const PlotPoint& p : plot.curve) {
        curve.emplace_back(frame.px(p.x), frame.py(p.y));
    }
    drawing.points("polyline", curve, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1.3\"");
    for (std::size_t i = 0; i < plot.intervals.size(); ++i) {
        const DensityInterval& interval = plot.intervals[i];
        const double y = frame.y + k_strip * (static_cast<double>(i) + 0.8);
        const double from = frame.px(interval.low);
        const double to = frame.px(interval.high);
        for (const double x : {from, to}) {
            drawing.line(x, y, x, bottom, "stroke=\"#555555\" stroke-width=\"0.6\" stroke-dasharray=\"2 3\"");
            drawing.line(x, y - 4.0, x, y + 4.0, "stroke=\"#000000\" stroke-width=\"1.2\"");
        }
        drawing.line(from, y, to, y, "stroke=\"#000000\" stroke-width=\"1.2\"");
        drawing.text(0.5 * (from + to), y - 4.0, interval.label, "middle", 10.0);
    }
    draw_outline(drawing, frame);
    draw_across_ticks(drawing, frame);
    draw_across_title(drawing, frame, plot.x_label);
    draw_upright_title(drawing, frame.x - 10.0, frame.y + 0.5 * frame.height, frame.height, plot.y_label);
    return plot_document(plot.id, plot.title, plot.description, height, drawing);
}

std::string svg(const HistogramPlot& plot) {
    constexpr double k_panel = 170.0;
    constexpr double k_above = 8.0;
    double most = 0.0;
    require_ordinary(plot.id, {plot.first_edge, plot.cell_width});
    for (const double count : plot.counts) {
        require_ordinary(plot.id, {count});
        most = std::max(most, count);
    }
    const double end = plot.first_edge + plot.cell_width * static_cast<double>(plot.counts.size());
    const PlotFrame frame{.x = k_left + 8.0,
                          .y = k_above,
                          .width = k_drawing_width - k_left - 8.0 - k_right,
                          .height = k_panel,
                          .across = nice_ticks(plot.first_edge, end, 10),
                          .up = nice_ticks(0.0, std::max(1.0, most), 5)};
    const double bottom = frame.y + frame.height;
    const double height = bottom + k_axis;
    Drawing drawing;
    draw_up_ticks(drawing, frame);
    for (std::size_t i = 0; i < plot.counts.size(); ++i) {
        const double left = frame.px(plot.first_edge + plot.cell_width * static_cast<double>(i));
        const double right = frame.px(plot.first_edge + plot.cell_width * static_cast<double>(i + 1));
        if (plot.counts[i] > 0.0) {
            const double y = frame.py(plot.counts[i]);
            drawing.rectangle(left, y, right - left, bottom - y,
                              "fill=\"#b5b5b5\" stroke=\"#000000\" stroke-width=\"0.8\"");
        }
    }
    draw_outline(drawing, frame);
    draw_across_ticks(drawing, frame);
    draw_across_title(drawing, frame, plot.x_label);
    draw_upright_title(drawing, frame.x - 44.0, frame.y + 0.5 * frame.height, frame.height, plot.y_label);
    return plot_document(plot.id, plot.title, plot.description, height, drawing);
}

std::string svg(const StackedPlot& plot) {
    constexpr double k_texts = 70.0;  // room for the text at the end of a bar
    constexpr double k_pitch = 20.0;
    constexpr double k_bar = 14.0;
    constexpr double k_line = 16.0;  // of the key
    double labels = 44.0;            // room for the names
    for (const StackedBar& bar : plot.bars) {
        labels = std::max(labels, std::min(200.0, 16.0 + text_width(bar.label, 10.5)));
        for (const double share : bar.shares) {
            require_ordinary(plot.id + ", " + bar.label, {share});
        }
    }
    Drawing key;
    double key_x = labels;
    double top = 4.0;
    for (std::size_t i = 0; i < plot.parts.size(); ++i) {
        const double room = 20.0 + text_width(plot.parts[i], 10.5) + 16.0;
        if (key_x + room > k_drawing_width && key_x > labels) {
            key_x = labels;
            top += k_line;
        }
        fill_part(key, key_x, top, 14.0, 9.0, i);
        key.text(key_x + 19.0, top + 8.5, plot.parts[i], "start", 10.5);
        key_x += room;
    }
    top += k_line + 10.0;
    const double bottom = top + k_pitch * static_cast<double>(plot.bars.size());
    const double height = bottom + k_axis;
    const double width = k_drawing_width - labels - k_texts;
    const auto px = [&](double v) { return labels + v / 100.0 * width; };

    Drawing drawing;
    drawing.body += key.body;
    drawing.text(labels + width + 8.0, top - 4.0, plot.text_head, "start", 10.5);
    for (int percent = 0; percent <= 100; percent += 10) {
        drawing.line(px(percent), top, px(percent), bottom, k_plot_grid);
        drawing.line(px(percent), bottom, px(percent), bottom + 4.0, k_plot_tick);
        drawing.text(px(percent), bottom + 15.0, tick_text(percent, 0), "middle", 10.0);
    }
    for (std::size_t i = 0; i < plot.bars.size(); ++i) {
        const StackedBar& bar = plot.bars[i];
        const double y = top + k_pitch * (static_cast<double>(i) + 0.5);
        drawing.text(labels - 8.0, y + 3.6, bar.label, "end", 10.5);
        drawing.text(labels + width + 8.0, y + 3.6, bar.text, "start", 10.5);
        double whole = 0.0;
        for (const double share : bar.shares) {
            whole += std::max(0.0, share);
        }
        double from = 0.0;
        for (std::size_t part = 0; part < bar.shares.size(); ++part) {
            // Where some shares are negative, the others exceed the whole together.
            const double share = std::max(0.0, bar.shares[part]) * (whole > 100.0 ? 100.0 / whole : 1.0);
            const double part_width = share / 100.0 * width;
            if (part_width < 0.05) {
                continue;
            }
            fill_part(drawing, px(from), y - 0.5 * k_bar, part_width, k_bar, part);
            const std::string text = part < bar.texts.size() ? bar.texts[part] : "";
            const double room = text_width(text, 9.5) + 4.0;
            if (!text.empty() && room + 4.0 < part_width) {
                const double middle = px(from) + 0.5 * part_width;
                drawing.rectangle(middle - 0.5 * room, y - 5.5, room, 11.0, "fill=\"#ffffff\" stroke=\"none\"");
                drawing.text(middle, y + 3.2, text, "middle", 9.5);
            }
            from += share;
        }
    }
    drawing.line(px(0.0), top, px(0.0), bottom, "stroke=\"#000000\" stroke-width=\"0.9\"");
    drawing.line(labels, bottom, labels + width, bottom, "stroke=\"#000000\" stroke-width=\"0.9\"");
    drawing.text(labels + 0.5 * width, bottom + 31.0, plot.x_label, "middle", 11.0);
    return plot_document(plot.id, plot.title, plot.description, height, drawing);
}

}  // namespace gumcert::reports
