// Youden plot of two items.

#include "reports/plots/comparison_plots.h"
#include "reports/printable_text.h"

#include "gum/quantity/unit.h"
#include "reports/plots/plot_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

namespace {

using Symbol = PlotKey::Symbol;

bool is_inside(const std::vector<std::pair<double, double>>& curve, double x, double y) {
    bool inside = false;
    for (std::size_t i = 0, j = curve.size() - 1; i < curve.size(); j = i++) {
        const auto& [xi, yi] = curve[i];
        const auto& [xj, yj] = curve[j];
        if ((yi > y) != (yj > y) && x < (xj - xi) * (y - yi) / (yj - yi) + xi) {
            inside = !inside;
        }
    }
    return inside;
}

/// One axis of a Youden plot: the ellipse and the bulk of the points; what is beyond stands at the edge.
AxisRange range_of_youden(const std::vector<double>& points, const std::vector<double>& ellipse, double centre) {
    AxisRange range{.low = centre, .high = centre};
    for (const double v : ellipse) {
        range.include(v);
    }
    constexpr double k_spreads = 10.0;
    const double reach = std::max(k_spreads * spread_of(points), 2.0 * (range.high - range.low));
    for (const double v : points) {
        if (reach == 0.0 || std::abs(v - centre) <= reach) {
            range.include(v);
        }
    }
    return range.widened(0.04);
}

std::vector<double> scaled(const std::string& where, std::vector<double> numbers, const AxisScale& scale) {
    for (double& v : numbers) {
        v = on_axis(where, scale(v));
    }
    return numbers;
}

/// Numbers of one of the two items.
struct YoudenAxis {
    std::vector<double> points, ellipse;
    double centre = 0.0;
    AxisScale scale;
    std::string title;

    YoudenAxis(std::vector<double> p, std::vector<double> e, double c, const std::string& item, const std::string& unit,
               bool in_z, const Wording& words) {
        double largest = std::abs(c);
        for (const auto* numbers : {&p, &e}) {
            for (const double v : *numbers) {
                largest = std::max(largest, std::abs(v));
            }
        }
        // An outlier must not take the digits of all others.
        const double bulk = std::max({std::abs(c), std::abs(middle_of(p)), 10.0 * spread_of(p)});
        scale = AxisScale::of(bulk > 0.0 ? std::min(bulk, largest) : largest);
        points = scaled("Youden, " + item, std::move(p), scale);
        ellipse = scaled("Youden, " + item, std::move(e), scale);
        centre = on_axis("Youden, " + item, scale(c));
        title = scale.label(
            words.filled("plot", in_z ? "z_of_axis" : "deviation_of_axis", {{"item", shortened(printable(item), 40)}})
                .first(),
            gum::unit_for_people(unit));
    }
    [[nodiscard]] AxisRange range() const { return range_of_youden(points, ellipse, centre); }
};

/// Names beside their points. Of the four places at a point a name takes the first with the fewest names and points
/// below it.
class PointNames {
public:
    PointNames(const PlotFrame& frame, const std::vector<std::pair<double, double>>& points) : frame_(frame) {
        constexpr double k_mark = 2.4;
        for (const auto& [x, y] : points) {
            covered_.push_back({.left = x - k_mark, .top = y - k_mark, .right = x + k_mark, .bottom = y + k_mark});
        }
    }

    void draw(Drawing& drawing, double x, double y, const std::string& name) {
        constexpr double k_size = 9.0;
        constexpr double k_aside = 5.0;
        const double width = label_width(name, k_size);
        const auto box = [&](bool left, double base) {
            const double from = left ? x - k_aside - width : x + k_aside;
            return Box{.left = from, .top = base - 7.0, .right = from + width, .bottom = base + 2.0};
        };
        const double above = std::max(y - 3.0, frame_.y + 9.0);
        const double below = std::min(y + 9.0, frame_.bottom() - 3.0);
        bool left = x > frame_.x + 0.75 * frame_.width;
        double base = above;
        std::size_t fewest = std::numeric_limits<std::size_t>::max();
        for (const auto& [on_left, at] :
             std::array<std::pair<bool, double>, 4>{{{left, above}, {!left, above}, {left, below}, {!left, below}}}) {
            const Box place = box(on_left, at);
            const auto hidden = static_cast<std::size_t>(
                std::count_if(covered_.begin(), covered_.end(), [&](const Box& b) { return b.meets(place); }));
            if (hidden < fewest && place.left > frame_.x && place.right < frame_.right()) {
                fewest = hidden;
                left = on_left;
                base = at;
            }
        }
        const Box place = box(left, base);
        if (fewest == 0) {  // lines end before a name; nothing else lies below it
            drawing.rectangle(place.left, place.top, width, place.bottom - place.top, "fill=\"#ffffff\"");
        }
        covered_.push_back(place);
        drawing.text(left ? x - k_aside : x + k_aside, base, name, left ? "end" : "start", k_size);
    }

private:
    struct Box {
        double left = 0.0, top = 0.0, right = 0.0, bottom = 0.0;

        [[nodiscard]] bool meets(const Box& b) const {
            return left < b.right && b.left < right && top < b.bottom && b.top < bottom;
        }
    };
    const PlotFrame& frame_;
    std::vector<Box> covered_;
};

using Outline = std::vector<std::pair<double, double>>;  // in drawing units

/// Of the first item and of the second one.
std::pair<YoudenAxis, YoudenAxis> youden_axes(const YoudenDiagram& diagram, const Wording& words) {
    std::vector<double> first;
    std::vector<double> second;
    for (const YoudenPoint& p : diagram.points) {
        first.push_back(p.first);
        second.push_back(p.second);
    }
    std::vector<double> ellipse_first;
    std::vector<double> ellipse_second;
    for (const auto& [x, y] : diagram.ellipse) {
        ellipse_first.push_back(x);
        ellipse_second.push_back(y);
    }
    const bool in_z = diagram.sigma_first && diagram.sigma_second;
    return {YoudenAxis(first, ellipse_first, diagram.centre_first, diagram.first_item, diagram.first_unit, in_z, words),
            YoudenAxis(second, ellipse_second, diagram.centre_second, diagram.second_item, diagram.second_unit, in_z,
                       words)};
}

bool is_shown(const PlotFrame& frame, double x, double y) {
    return x >= frame.across.low && x <= frame.across.high && y >= frame.up.low && y <= frame.up.high;
}

/// The medians, and below them the part of the line of equal deviations through both that lies inside the panel.
/// \param slope  of that line in the units of the axes; 0: there is none
void draw_medians(Drawing& body, const PlotFrame& frame, const YoudenAxis& across, const YoudenAxis& up, double slope) {
    if (slope > 0.0) {
        const auto height_at = [&](double x) { return up.centre + slope * (x - across.centre); };
        const auto at_height = [&](double y) { return across.centre + (y - up.centre) / slope; };
        const double from = std::max(frame.across.low, at_height(frame.up.low));
        const double to = std::min(frame.across.high, at_height(frame.up.high));
        body.line(frame.px(from), frame.py(height_at(from)), frame.px(to), frame.py(height_at(to)),
                  "stroke=\"#8a8a8a\" stroke-width=\"0.9\"");
    }
    constexpr const char* k_median = "stroke=\"#000000\" stroke-width=\"0.9\" stroke-dasharray=\"4 2\"";
    body.line(frame.px(across.centre), frame.y, frame.px(across.centre), frame.bottom(), k_median);
    body.line(frame.x, frame.py(up.centre), frame.right(), frame.py(up.centre), k_median);
}

/// The points, and the names of all where they are few, else of those outside of the ellipse.
/// \param ellipse  empty: there is none
void draw_laboratories(Drawing& body, const PlotFrame& frame, const YoudenDiagram& diagram, const YoudenAxis& across,
                       const YoudenAxis& up, const Outline& ellipse) {
    const std::size_t laboratories = diagram.points.size();
    const double radius = laboratories > 400 ? 1.2 : laboratories > 60 ? 1.8 : 2.4;
    Outline places;
    for (std::size_t i = 0; i < laboratories; ++i) {
        const double x = frame.px(std::clamp(across.points[i], frame.across.low, frame.across.high));
        const double y = frame.py_inside(up.points[i]);
        places.emplace_back(x, y);
        const bool shown = is_shown(frame, across.points[i], up.points[i]);
        body.marker(shown ? PlotMarker::disc : PlotMarker::cross, x, y, shown ? radius : 3.0);
    }
    constexpr std::size_t k_all_named = 15;
    constexpr std::size_t k_most_named = 40;
    std::size_t named = 0;
    PointNames names(frame, places);
    for (std::size_t i = 0; i < laboratories && named < k_most_named; ++i) {
        const auto& [x, y] = places[i];
        if (laboratories <= k_all_named || (!ellipse.empty() && !is_inside(ellipse, x, y))) {
            ++named;
            names.draw(body, x, y, shortened_name(printable(diagram.points[i].participant), 18));
        }
    }
}

}  // namespace

std::string youden_plot(const YoudenDiagram& diagram, const std::string& id, const Wording& words) {
    if (diagram.points.empty()) {
        return "";
    }
    const auto [across, up] = youden_axes(diagram, words);
    const AxisRange x_range = across.range();
    const AxisRange y_range = up.range();
    PlotFrame frame{.width = 400.0, .height = 400.0};
    frame.across = nice_ticks(x_range.low, x_range.high, 7);
    frame.up = nice_ticks(y_range.low, y_range.high, 8);
    frame.x = 0.5 * (k_drawing_width - frame.width - room_for_axis(frame.up)) + room_for_axis(frame.up);

    const bool same_unit = diagram.first_unit == diagram.second_unit;
    const double slope = same_unit ? 1.0 : diagram.scale_first > 0.0 ? diagram.scale_second / diagram.scale_first : 0.0;
    // In the units of the axes.
    const double drawn_slope = up.scale(slope) / across.scale(1.0);
    bool beyond = false;
    for (std::size_t i = 0; i < diagram.points.size(); ++i) {
        beyond = beyond || !is_shown(frame, across.points[i], up.points[i]);
    }
    PlotKey key;
    const bool with_ellipse = diagram.ellipse.size() > 2;
    if (with_ellipse) {
        key.add(Symbol::line, words("plot", "ellipse_95_key").first());
    }
    key.add(Symbol::dashed, words("plot", "medians_key").first());
    if (drawn_slope > 0.0) {
        key.add(Symbol::grey_line, words("plot", "equal_key").first());
    }
    if (beyond) {
        key.add(Symbol::cross, words("plot", "beyond_key").first());
    }
    Drawing body;
    frame.y = key.draw(body, 40.0, k_drawing_width) + 4.0;
    draw_up_axis(body, frame, up.title);
    draw_across_axis(body, frame, across.title);
    draw_medians(body, frame, across, up, drawn_slope);
    Outline outline;
    for (std::size_t i = 0; i < diagram.ellipse.size(); ++i) {
        outline.emplace_back(frame.px(across.ellipse[i]), frame.py(up.ellipse[i]));
    }
    if (with_ellipse) {
        body.points("polygon", outline, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1.2\"");
    }
    draw_laboratories(body, frame, diagram, across, up, with_ellipse ? outline : Outline());
    draw_outline(body, frame);
    const double height = frame.bottom() + 42.0;
    const Wording::Values items = {{"first", shortened(printable(diagram.first_item), 60)},
                                   {"second", shortened(printable(diagram.second_item), 60)}};
    return plot_document(id, words.filled("plot", "youden_title", items).first(),
                         words.filled("plot", "youden_description", items).first(), height, body);
}

}  // namespace gumcert::reports
