#include "reports/plots/layout_plot.h"

#include "gum/quantity/diagnostic.h"
#include "reports/plots/svg_drawing.h"
#include "reports/printable_text.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

namespace gumcert::reports {

namespace {

constexpr double k_layout_left = 52.0;     // tick labels and the label of the vertical axis
constexpr double k_layout_right = 8.0;     // after the last panel
constexpr double k_layout_between = 60.0;  // between the panels of a row
constexpr double k_below = 40.0;           // tick labels and label of the horizontal axis
constexpr double k_most_height = 470.0;
constexpr double k_label_size = 9.5;
constexpr const char* k_ellipse = "fill=\"none\" stroke=\"#6a6a6a\" stroke-width=\"0.8\"";
constexpr const char* k_axis_line = "stroke=\"#000000\" stroke-width=\"0.9\" stroke-dasharray=\"12 3 2 3\"";
constexpr const char* k_reflector = "fill=\"#000000\" stroke=\"none\"";
constexpr const char* k_station = "fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"1.1\"";
constexpr const char* k_marked = "fill=\"#8c8c8c\" stroke=\"#000000\" stroke-width=\"1.1\"";

std::size_t axis_index(const LayoutPlot& plot) {
    if (plot.axis == "A" || plot.axis == "B" || plot.axis == "C") {
        return static_cast<std::size_t>(plot.axis[0] - 'A');
    }
    throw gum::NoResultError(gum::Diagnostic{.code = "GC-REPORT-0005",
                                             .where = "plot " + plot.id,
                                             .what = "axis \"" + plot.axis + '"',
                                             .rule = "an axis of rotation is A, B or C",
                                             .action = "look for it in the record"});
}

double largest_deviation(const LayoutPoint& point) {
    double most = 0.0;
    for (std::size_t c = 0; point.covariance_mm2 && c < 3; ++c) {
        most = std::max(most, (*point.covariance_mm2)[c][c]);
    }
    return std::sqrt(most);
}

struct Range {
    double low = 0.0, high = 0.0;  // the origin, through which the axis goes, is always inside

    [[nodiscard]] double length() const { return high - low; }
};

std::array<Range, 3> ranges_of(const LayoutPlot& plot) {
    std::array<Range, 3> all;
    double longest = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
        for (const auto* group : {&plot.stations, &plot.reflectors}) {
            for (const LayoutPoint& point : *group) {
                require_ordinary(plot.id + ", " + point.name, {point.position_mm[c]});
                all[c].low = std::min(all[c].low, point.position_mm[c]);
                all[c].high = std::max(all[c].high, point.position_mm[c]);
            }
        }
        longest = std::max(longest, all[c].length());
    }
    longest = longest > 0.0 ? longest : 1.0;
    for (Range& range : all) {
        const double room = 0.08 * longest + 0.5 * std::max(0.0, 0.12 * longest - range.length());
        range = {.low = range.low - room, .high = range.high + room};
    }
    return all;
}

/// 1, 2 or 5 times a power of ten, not above v and not below 1.
double round_down(double v) {
    if (!(v > 1.0)) {
        return 1.0;
    }
    const double power = std::pow(10.0, std::floor(std::log10(v) + 1e-12));
    for (const double digit : {5.0, 2.0}) {
        if (digit * power <= v * (1.0 + 1e-12)) {
            return digit * power;
        }
    }
    return power;
}

double magnification_of(const std::vector<LayoutPoint>& points, double factor, double longest) {
    double most = 0.0;
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < points.size(); ++i) {
        most = std::max(most, largest_deviation(points[i]));
        for (std::size_t j = 0; j < i; ++j) {
            const auto& a = points[i].position_mm;
            const auto& b = points[j].position_mm;
            const double apart = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
            nearest = std::min(nearest, apart);
        }
    }
    if (!(most > 0.0)) {
        return 0.0;
    }
    // Large enough to be seen, and neighbours do not run into each other.
    const double semi_axis = std::clamp(0.45 * nearest, 0.015 * longest, 0.08 * longest);
    return round_down(semi_axis / (factor * most));
}

struct Box {
    double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;

    [[nodiscard]] double overlap(const Box& other) const {
        const double across = std::min(right, other.right) - std::max(left, other.left);
        const double down = std::min(bottom, other.bottom) - std::max(top, other.top);
        return across > 0.0 && down > 0.0 ? across * down : 0.0;
    }
    [[nodiscard]] bool inside(const Box& other) const {
        return left >= other.left && right <= other.right && top >= other.top && bottom <= other.bottom;
    }
};

Box around(double x, double y, double half_width, double half_height) {
    return {.left = x - half_width, .top = y - half_height, .right = x + half_width, .bottom = y + half_height};
}

/// One of the three views.
struct View {
    std::size_t across = 0, up = 0;  // coordinates
    Box frame;
    double scale = 1.0;  // drawing units a millimetre
    Range across_range, up_range;

    [[nodiscard]] double px(double v) const { return frame.left + (v - across_range.low) * scale; }
    [[nodiscard]] double py(double v) const { return frame.bottom - (v - up_range.low) * scale; }
};

constexpr std::array<const char*, 3> k_names = {"x", "y", "z"};

/// Decimal steps with at least 50 drawing units between two ticks, the same in all views.
Ticks ticks_of(double scale) {
    return nice_ticks(0.0, 500.0 / scale, 10);
}

void draw_frame(Drawing& drawing, const View& view, const Ticks& ticks) {
    constexpr const char* k_grid = "stroke=\"#ececec\" stroke-width=\"0.6\"";
    constexpr const char* k_tick = "stroke=\"#000000\" stroke-width=\"0.8\"";
    const Box& f = view.frame;
    const auto each = [&](const Range& range, const auto& draw) {
        for (double i = std::ceil(range.low / ticks.step); i * ticks.step <= range.high; i += 1.0) {
            draw(i * ticks.step);
        }
    };
    each(view.across_range, [&](double v) {
        const double x = view.px(v);
        drawing.line(x, f.top, x, f.bottom, k_grid);
        drawing.line(x, f.bottom, x, f.bottom + 4.0, k_tick);
        drawing.text(x, f.bottom + 14.0, tick_text(v, ticks.decimals), "middle", 9.5);
    });
    each(view.up_range, [&](double v) {
        const double y = view.py(v);
        drawing.line(f.left, y, f.right, y, k_grid);
        drawing.line(f.left - 4.0, y, f.left, y, k_tick);
        drawing.text(f.left - 6.0, y + 3.2, tick_text(v, ticks.decimals), "end", 9.5);
    });
    drawing.rectangle(f.left, f.top, f.right - f.left, f.bottom - f.top,
                      "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"");
    drawing.text(0.5 * (f.left + f.right), f.bottom + 29.0, std::string(k_names.at(view.across)) + " / mm", "middle",
                 11.0);
    drawing.upright_text(f.left - 40.0, 0.5 * (f.top + f.bottom), std::string(k_names.at(view.up)) + " / mm", 11.0);
}

void draw_axis(Drawing& drawing, const View& view, std::size_t axis, const std::string& letter,
               std::vector<Box>& taken) {
    const double x = view.px(0.0);
    const double y = view.py(0.0);
    double label_x = x + 9.0;
    double label_y = y - 6.0;
    if (axis == view.across) {
        drawing.line(view.frame.left, y, view.frame.right, y, k_axis_line);
        taken.push_back({.left = view.frame.left, .top = y - 0.5, .right = view.frame.right, .bottom = y + 0.5});
        label_x = view.frame.right - 10.0;
    } else if (axis == view.up) {
        drawing.line(x, view.frame.top, x, view.frame.bottom, k_axis_line);
        taken.push_back({.left = x - 0.5, .top = view.frame.top, .right = x + 0.5, .bottom = view.frame.bottom});
        label_x = x + 6.0;
        label_y = view.frame.top + 12.0;
    } else {  // seen from its end
        drawing.body += "<circle cx=\"" + drawing_number(x) + "\" cy=\"" + drawing_number(y) +
                        "\" r=\"4\" fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"/>\n";
        drawing.line(x - 7.0, y, x + 7.0, y, "stroke=\"#000000\" stroke-width=\"0.9\"");
        drawing.line(x, y - 7.0, x, y + 7.0, "stroke=\"#000000\" stroke-width=\"0.9\"");
    }
    drawing.text(label_x, label_y, letter, "start", 10.5, " font-style=\"italic\"");
    taken.push_back({.left = label_x - 1.0, .top = label_y - 9.0, .right = label_x + 8.0, .bottom = label_y + 1.0});
}

/// The ellipse (f, g) with f = (√V_aa cos t, V_ab/√V_aa cos t + √(V_bb − V_ab²/V_aa) sin t): the unit circle under a
/// square root of the covariance V of the two coordinates.
void draw_ellipse(Drawing& drawing, const View& view, const LayoutPoint& point, double magnified_factor) {
    if (!point.covariance_mm2 || !(largest_deviation(point) > 0.0)) {
        return;
    }
    const auto& v = *point.covariance_mm2;
    const double first = std::sqrt(std::max(0.0, v[view.across][view.across]));
    const double shared = first > 0.0 ? v[view.across][view.up] / first : 0.0;
    const double second = std::sqrt(std::max(0.0, v[view.up][view.up] - shared * shared));
    const double size = magnified_factor * view.scale;
    const double x = view.px(point.position_mm[view.across]);
    const double y = view.py(point.position_mm[view.up]);
    constexpr int k_corners = 40;
    std::vector<std::pair<double, double>> outline;
    for (int i = 0; i < k_corners; ++i) {
        const double t = 2.0 * std::numbers::pi * i / k_corners;
        outline.emplace_back(x + size * first * std::cos(t), y - size * (shared * std::cos(t) + second * std::sin(t)));
    }
    drawing.points("polygon", outline, k_ellipse);
}

void draw_station(Drawing& drawing, double x, double y, bool marked) {
    drawing.rectangle(x - 3.0, y - 3.0, 6.0, 6.0, marked ? k_marked : k_station);
}

void draw_reflector(Drawing& drawing, double x, double y) {
    drawing.points("polygon", {{x, y - 3.0}, {x + 3.0, y}, {x, y + 3.0}, {x - 3.0, y}}, k_reflector);
}

/// Places a name beside its point where it hides nothing; where there is no such place, it is left out.
/// \param ellipse  greatest extent of the ellipse of the point, in drawing units
void draw_label(Drawing& drawing, const View& view, double x, double y, double ellipse, const std::string& name,
                std::vector<Box>& taken) {
    const double half_width = 0.5 * text_width(name, k_label_size) + 1.0;
    constexpr double k_half_height = 4.6;
    constexpr int k_directions = 16;
    const double nearest = std::max(5.5, ellipse + 1.5);
    for (const double further : {0.0, 4.5, 10.5, 18.5, 28.5, 40.5, 54.5}) {
        const double away = nearest + further;
        for (int i = 0; i < k_directions; ++i) {
            // To the right first, then alternately above and below it.
            const double turn = (i % 2 == 0 ? 0.5 : -0.5) * (i + i % 2);
            const double t = 2.0 * std::numbers::pi * turn / k_directions;
            const double reach_x = std::cos(t) * (away + half_width);
            const double reach_y = std::sin(t) * (away + k_half_height);
            const Box box = around(x + reach_x, y - reach_y, half_width, k_half_height);
            const bool free = box.inside(view.frame) && std::none_of(taken.begin(), taken.end(), [&](const Box& other) {
                                  return box.overlap(other) > 0.0;
                              });
            if (!free) {
                continue;
            }
            if (further > 6.0) {
                const double end_x = std::clamp(x, box.left, box.right);
                const double end_y = std::clamp(y, box.top + 1.0, box.bottom - 1.0);
                drawing.line(x, y, end_x, end_y, "stroke=\"#8c8c8c\" stroke-width=\"0.5\"");
                for (const double part : {0.35, 0.6, 0.85}) {
                    taken.push_back(around(x + part * (end_x - x), y + part * (end_y - y), 1.0, 1.0));
                }
            }
            taken.push_back(box);
            drawing.text(x + reach_x, y - reach_y + 3.2, name, "middle", k_label_size);
            return;
        }
    }
}

void draw_view(Drawing& drawing, const LayoutPlot& plot, const View& view, std::size_t axis, const Ticks& ticks,
               const LayoutMagnification& magnification) {
    std::vector<Box> taken;
    draw_frame(drawing, view, ticks);
    draw_axis(drawing, view, axis, plot.axis, taken);
    for (const LayoutPoint& point : plot.stations) {
        draw_ellipse(drawing, view, point, plot.ellipse_factor * magnification.stations);
    }
    for (const LayoutPoint& point : plot.reflectors) {
        draw_ellipse(drawing, view, point, plot.ellipse_factor * magnification.reflectors);
    }
    for (const auto* group : {&plot.stations, &plot.reflectors}) {
        for (const LayoutPoint& point : *group) {
            taken.push_back(
                around(view.px(point.position_mm[view.across]), view.py(point.position_mm[view.up]), 4.0, 4.0));
        }
    }
    Drawing symbols;  // above the lines that lead to names
    for (const auto* group : {&plot.stations, &plot.reflectors}) {
        for (const LayoutPoint& point : *group) {
            const double x = view.px(point.position_mm[view.across]);
            const double y = view.py(point.position_mm[view.up]);
            double most = 0.0;
            for (const std::size_t c : {view.across, view.up}) {
                most = point.covariance_mm2 ? std::max(most, (*point.covariance_mm2)[c][c]) : 0.0;
            }
            const double magnified = group == &plot.stations ? magnification.stations : magnification.reflectors;
            const double ellipse = std::sqrt(most) * plot.ellipse_factor * magnified * view.scale;
            draw_label(drawing, view, x, y, ellipse, shortened(printable(point.name), 12), taken);
            if (group == &plot.stations) {
                draw_station(symbols, x, y, point.marked);
            } else {
                draw_reflector(symbols, x, y);
            }
        }
    }
    drawing.body += symbols.body;
}

/// \return height of the key
double draw_key(Drawing& drawing, const LayoutPlot& plot, const LayoutMagnification& magnification) {
    constexpr double k_line = 16.0;
    double x = k_layout_left;
    double y = 9.0;
    const auto entry = [&](const std::string& text, double symbol_width, const auto& symbol) {
        const double room = symbol_width + 6.0 + text_width(text, 10.5) + 18.0;
        if (x > k_layout_left && x + room > k_drawing_width) {
            x = k_layout_left;
            y += k_line;
        }
        symbol(x + 0.5 * symbol_width, y);
        drawing.text(x + symbol_width + 6.0, y + 3.5, text, "start", 10.5);
        x += room;
    };
    const auto has = [&](bool marked) {
        return std::any_of(plot.stations.begin(), plot.stations.end(),
                           [&](const LayoutPoint& p) { return p.marked == marked; });
    };
    for (const bool marked : {false, true}) {
        if (has(marked)) {
            entry(marked ? plot.marked_label : plot.stations_label, 8.0,
                  [&](double at, double level) { draw_station(drawing, at, level, marked); });
        }
    }
    if (!plot.reflectors.empty()) {
        entry(plot.reflectors_label, 8.0, [&](double at, double level) { draw_reflector(drawing, at, level); });
    }
    entry(plot.axis_label + " " + plot.axis, 36.0,
          [&](double at, double level) { drawing.line(at - 18.0, level, at + 18.0, level, k_axis_line); });
    if (magnification.stations > 0.0 || magnification.reflectors > 0.0) {
        entry(plot.ellipse_label, 16.0, [&](double at, double level) {
            std::vector<std::pair<double, double>> outline;
            for (int i = 0; i < 24; ++i) {
                const double t = 2.0 * std::numbers::pi * i / 24.0;
                outline.emplace_back(at + 8.0 * std::cos(t), level + 4.0 * std::sin(t));
            }
            drawing.points("polygon", outline, k_ellipse);
        });
    }
    return y + 16.0;
}

}  // namespace

LayoutMagnification layout_magnification(const LayoutPlot& plot) {
    double longest = 0.0;
    for (const Range& range : ranges_of(plot)) {
        longest = std::max(longest, range.length());
    }
    for (const auto* group : {&plot.stations, &plot.reflectors}) {
        for (const LayoutPoint& point : *group) {
            if (point.covariance_mm2) {
                for (const auto& row : *point.covariance_mm2) {
                    require_ordinary(plot.id + ", " + point.name, {row[0], row[1], row[2]});
                }
            }
        }
    }
    return {.stations = magnification_of(plot.stations, plot.ellipse_factor, longest),
            .reflectors = magnification_of(plot.reflectors, plot.ellipse_factor, longest)};
}

std::string svg(const LayoutPlot& plot) {
    const std::size_t axis = axis_index(plot);
    std::array<Range, 3> range = ranges_of(plot);
    const LayoutMagnification magnification = layout_magnification(plot);

    Drawing drawing;
    const double top = draw_key(drawing, plot, magnification);
    const double room_across = k_drawing_width - k_layout_left - k_layout_between - k_layout_right;
    const double scale = std::min(room_across / (range[0].length() + range[1].length()),
                                  k_most_height / (range[2].length() + range[1].length()));
    // Where the height decides, the views are widened to the whole width, but not made taller.
    const Range y_up = range[1];
    const double spare = 0.25 * (room_across / scale - range[0].length() - range[1].length());
    for (const std::size_t c : {0U, 1U}) {
        range[c].low -= spare;
        range[c].high += spare;
    }
    const auto view_of = [&](std::size_t across, std::size_t up, double left, double upper) {
        const Range up_range = up == 1 ? y_up : range[up];
        return View{.across = across,
                    .up = up,
                    .frame = {.left = left,
                              .top = upper,
                              .right = left + range[across].length() * scale,
                              .bottom = upper + up_range.length() * scale},
                    .scale = scale,
                    .across_range = range[across],
                    .up_range = up_range};
    };
    const View front = view_of(0, 2, k_layout_left, top);
    const View side = view_of(1, 2, front.frame.right + k_layout_between, top);
    const View plan = view_of(0, 1, k_layout_left, front.frame.bottom + k_below + 6.0);
    const double height = plan.frame.bottom + k_below;

    Drawing whole;
    whole.rectangle(0.0, 0.0, k_drawing_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    const Ticks ticks = ticks_of(scale);
    for (const View& view : {front, side, plan}) {
        draw_view(drawing, plot, view, axis, ticks, magnification);
    }
    whole.body += drawing.body;
    return svg_document(plot.id, plot.title, plot.description, height, whole);
}

}  // namespace gumcert::reports
