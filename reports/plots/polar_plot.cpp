#include "reports/plots/polar_plot.h"

#include "reports/plots/plot_frame.h"
#include "reports/plots/svg_drawing.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

namespace gumcert::reports {

namespace {

constexpr int k_columns = 3;
constexpr double k_pitch = k_drawing_width / k_columns;
constexpr double k_radius = 84.0;  // of the outermost ring, drawing units
constexpr double k_polar_head = 26.0;
constexpr double k_polar_foot = 22.0;  // angles below a panel
constexpr double k_inner = 0.16;       // of the radius, left free about the centre

/// Places of a panel: its centre, and how values become radii.
struct PolarFrame {
    double x = 0.0, y = 0.0;
    Ticks rings;

    [[nodiscard]] double radius(double v) const {
        return k_radius * (k_inner + (1.0 - k_inner) * (v - rings.low) / (rings.high - rings.low));
    }
    [[nodiscard]] std::pair<double, double> at(double angle_deg, double v) const {
        const double angle = angle_deg * std::numbers::pi / 180.0;
        return {x + radius(v) * std::cos(angle), y - radius(v) * std::sin(angle)};
    }
};

Ticks rings_of(const PolarPanel& panel) {
    double most = 0.0;
    for (const PlotPoint& p : panel.points) {
        most = std::max(most, std::abs(p.y) + p.U);
    }
    return nice_ticks(-(most > 0.0 ? most : 1.0), most > 0.0 ? most : 1.0, 4);
}

void draw_rings(Drawing& drawing, const PolarFrame& frame) {
    const auto circle = [&](double v, const char* style) {
        drawing.body += "<circle cx=\"" + drawing_number(frame.x) + "\" cy=\"" + drawing_number(frame.y) + "\" r=\"" +
                        drawing_number(frame.radius(v)) + "\" fill=\"none\" " + style + "/>\n";
    };
    for (int i = 0; i < frame.rings.count(); ++i) {
        const double v = frame.rings.at(i);
        if (std::abs(v) > 0.5 * frame.rings.step) {
            circle(v, "stroke=\"#c8c8c8\" stroke-width=\"0.6\"");
        }
    }
    for (int angle = 0; angle < 360; angle += 45) {
        const auto [x1, y1] = frame.at(angle, frame.rings.low);
        const auto [x2, y2] = frame.at(angle, frame.rings.high);
        drawing.line(x1, y1, x2, y2, "stroke=\"#c8c8c8\" stroke-width=\"0.6\"");
    }
    circle(0.0, "stroke=\"#000000\" stroke-width=\"0.7\" stroke-dasharray=\"4 2\"");
}

void draw_numbers(Drawing& drawing, const PolarFrame& frame) {
    for (int angle = 0; angle < 360; angle += 90) {
        const double turn = angle * std::numbers::pi / 180.0;
        drawing.text(frame.x + (k_radius + 11.0) * std::cos(turn), frame.y - (k_radius + 9.0) * std::sin(turn) + 3.2,
                     std::to_string(angle) + "°", "middle", 9.0);
    }
    // Values of the rings stand along 67.5°, between two spokes, on white.
    for (int i = 0; i < frame.rings.count(); ++i) {
        const double v = frame.rings.at(i);
        const std::string text = tick_text(v, frame.rings.decimals);
        const auto [x, y] = frame.at(67.5, v);
        const double width = text_width(text, 8.5) + 2.0;
        drawing.rectangle(x - 0.5 * width, y - 4.4, width, 8.8, "fill=\"#ffffff\" stroke=\"none\"");
        drawing.text(x, y + 3.0, text, "middle", 8.5);
    }
}

void draw_polar_panel(Drawing& drawing, const PolarPanel& panel, const PolarFrame& frame, bool is_closed) {
    drawing.text(frame.x, frame.y - k_radius - 18.0, panel.heading, "middle", 11.0, " font-weight=\"bold\"");
    std::vector<PlotPoint> sorted = panel.points;
    std::stable_sort(sorted.begin(), sorted.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    std::vector<std::pair<double, double>> outline;
    std::vector<std::pair<double, double>> curve;
    const auto close = [&](std::vector<std::pair<double, double>>& points, std::size_t first) {
        if (is_closed && points.size() > first) {
            points.push_back(points[first]);
        }
    };
    for (const PlotPoint& p : sorted) {
        outline.push_back(frame.at(p.x, p.y + p.U));
        curve.push_back(frame.at(p.x, p.y));
    }
    close(outline, 0);
    close(curve, 0);
    const std::size_t inner = outline.size();
    for (const PlotPoint& p : sorted) {
        outline.push_back(frame.at(p.x, p.y - p.U));
    }
    close(outline, inner);
    std::reverse(outline.begin() + static_cast<std::ptrdiff_t>(inner), outline.end());
    drawing.points("polygon", outline, "fill=\"#bdbdbd\" stroke=\"none\"");
    draw_rings(drawing, frame);
    drawing.points("polyline", curve, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1.1\"");
    draw_numbers(drawing, frame);
}

}  // namespace

std::string svg(const PolarPlot& plot) {
    for (const PolarPanel& panel : plot.panels) {
        for (const PlotPoint& p : panel.points) {
            require_ordinary(plot.id + ", " + panel.heading, {p.x, p.y, p.U});
        }
    }
    Drawing drawing;
    const double pitch = k_polar_head + 2.0 * k_radius + k_polar_foot;
    const int rows = (static_cast<int>(plot.panels.size()) + k_columns - 1) / k_columns;
    for (std::size_t i = 0; i < plot.panels.size(); ++i) {
        const auto at = static_cast<int>(i);
        const PolarFrame frame{.x = (at % k_columns + 0.5) * k_pitch,
                               .y = (at / k_columns) * pitch + k_polar_head + k_radius,
                               .rings = rings_of(plot.panels[i])};
        draw_polar_panel(drawing, plot.panels[i], frame, plot.is_closed);
    }
    return plot_document(plot.id, plot.title, plot.description, rows * pitch, drawing);
}

}  // namespace gumcert::reports
