#include "reports/svg_plot.h"

#include "gum/quantity/diagnostic.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <utility>

namespace gumcert::reports {

namespace {

constexpr double k_width = 680.0;
constexpr double k_left = 50.0;  // room for tick labels and the axis label
constexpr double k_right = 10.0;
constexpr double k_head = 22.0;     // room for the heading of a panel
constexpr double k_foot = 8.0;      // below a panel that has no tick labels
constexpr double k_axis = 42.0;     // tick labels and label of the horizontal axis
constexpr double k_key = 20.0;      // the key above the panels
constexpr double k_between = 14.0;  // between columns
constexpr const char* k_font = "font-family=\"'Libertinus Serif', 'DejaVu Serif', Georgia, serif\"";

/// With at most two decimals and without trailing zeros: 12.5, 3, -0.25.
std::string number(double v) {
    std::array<char, 64> buffer{};
    const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), v, std::chars_format::fixed, 2).ptr;
    std::string text(buffer.data(), end);
    while (text.back() == '0') {
        text.pop_back();
    }
    if (text.back() == '.') {
        text.pop_back();
    }
    return text == "-0" ? "0" : text;
}

std::string tick_text(double v, int decimals) {
    std::array<char, 64> buffer{};
    const auto end =
        std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::abs(v), std::chars_format::fixed, decimals)
            .ptr;
    const std::string text(buffer.data(), end);
    const bool zero = text.find_first_not_of("0.") == std::string::npos;
    return v < 0.0 && !zero ? "\u2212" + text : text;
}

struct Ticks {
    double low = 0.0, high = 1.0, step = 1.0;
    int decimals = 0;

    [[nodiscard]] int count() const { return static_cast<int>(std::lround((high - low) / step)) + 1; }
    [[nodiscard]] double at(int i) const { return low + i * step; }
};

/// Steps of 1, 2 or 5 times a power of ten that cover [low, high] with at most `most` intervals.
Ticks nice_ticks(double low, double high, int most) {
    if (!(high - low > 1e-9 * std::max(1e-3, std::abs(high)))) {
        const double room = std::max(1e-3, 0.1 * std::abs(low));
        low -= room;
        high += room;
    }
    const double raw = (high - low) / most;
    Ticks ticks;
    int exponent = static_cast<int>(std::floor(std::log10(raw)));
    double step = 0.0;
    for (;; ++exponent) {
        for (const double digit : {1.0, 2.0, 5.0}) {
            step = digit * std::pow(10.0, exponent);
            ticks.low = std::floor(low / step + 1e-9) * step;
            ticks.high = std::ceil(high / step - 1e-9) * step;
            if (ticks.high - ticks.low <= (most + 0.5) * step) {
                ticks.step = step;
                ticks.decimals = std::max(0, -exponent);
                return ticks;
            }
        }
    }
}

/// Steps that divide a circle, for angles in degrees; other axes fall back to decimal steps.
Ticks angle_ticks(double low, double high) {
    if (high - low < 10.0) {
        return nice_ticks(low, high, 8);
    }
    for (const double step : {5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0}) {
        const double from = std::floor(low / step + 1e-9) * step;
        const double to = std::ceil(high / step - 1e-9) * step;
        if (to - from <= 8.5 * step) {
            return {.low = from, .high = to, .step = step, .decimals = 0};
        }
    }
    return nice_ticks(low, high, 8);
}

class Drawing {
public:
    std::string body;

    void line(double x1, double y1, double x2, double y2, const char* style) {
        body += "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) + "\" y2=\"" +
                number(y2) + "\" " + style + "/>\n";
    }

    void rectangle(double x, double y, double width, double height, const char* style) {
        body += "<rect x=\"" + number(x) + "\" y=\"" + number(y) + "\" width=\"" + number(width) + "\" height=\"" +
                number(height) + "\" " + style + "/>\n";
    }

    void points(const char* element, const std::vector<std::pair<double, double>>& at, const char* style) {
        body += std::string("<") + element + " points=\"";
        for (std::size_t i = 0; i < at.size(); ++i) {
            body += (i == 0 ? "" : " ") + number(at[i].first) + "," + number(at[i].second);
        }
        body += std::string("\" ") + style + "/>\n";
    }

    void text(double x, double y, const std::string& content, const char* anchor, double size, const char* more = "") {
        body += "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" font-size=\"" + number(size) +
                "\" text-anchor=\"" + anchor + "\" fill=\"#000000\" " + k_font + more + ">" + escape_markup(content) +
                "</text>\n";
    }

    void upright_text(double x, double y, const std::string& content, double size) {
        const std::string turn = " transform=\"rotate(-90 " + number(x) + " " + number(y) + ")\"";
        text(x, y, content, "middle", size, turn.c_str());
    }

    void marker(PlotMarker kind, double x, double y, double r) {
        switch (kind) {
            case PlotMarker::disc:
                body += "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + number(r) +
                        "\" fill=\"#000000\" stroke=\"none\"/>\n";
                return;
            case PlotMarker::square:
                rectangle(x - r, y - r, 2.0 * r, 2.0 * r, "fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.9\"");
                return;
            case PlotMarker::triangle:
                points("polygon", {{x, y - 1.3 * r}, {x + 1.2 * r, y + 0.9 * r}, {x - 1.2 * r, y + 0.9 * r}},
                       "fill=\"#9a9a9a\" stroke=\"#000000\" stroke-width=\"0.9\"");
                return;
        }
    }
};

struct Frame {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    Ticks across, up;

    [[nodiscard]] double px(double v) const { return x + (v - across.low) / (across.high - across.low) * width; }
    [[nodiscard]] double py(double v) const { return y + height - (v - up.low) / (up.high - up.low) * height; }
};

void draw_series(Drawing& drawing, const PlotSeries& series, const Frame& frame) {
    std::vector<PlotPoint> sorted = series.points;
    std::stable_sort(sorted.begin(), sorted.end(), [](const PlotPoint& a, const PlotPoint& b) { return a.x < b.x; });
    const double radius = sorted.size() > 80 ? 1.3 : 2.2;
    const auto x = [&](const PlotPoint& p) { return frame.px(p.x) + series.shift; };
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
    if (series.joined) {
        std::vector<std::pair<double, double>> curve;
        for (const PlotPoint& p : sorted) {
            curve.emplace_back(x(p), frame.py(p.y));
        }
        drawing.points("polyline", curve, "fill=\"none\" stroke=\"#000000\" stroke-width=\"1\"");
    }
    for (const PlotPoint& p : sorted) {
        drawing.marker(series.marker, x(p), frame.py(p.y), radius);
    }
}

void draw_panel(Drawing& drawing, const PlotPanel& panel, const Frame& frame, bool with_axis) {
    drawing.text(frame.x, frame.y - 7.0, panel.heading, "start", 11.0, " font-weight=\"bold\"");
    drawing.rectangle(frame.x, frame.y, frame.width, frame.height, "fill=\"#ffffff\" stroke=\"none\"");
    constexpr const char* k_grid = "stroke=\"#e2e2e2\" stroke-width=\"0.6\"";
    for (int i = 0; i < frame.across.count(); ++i) {
        drawing.line(frame.px(frame.across.at(i)), frame.y, frame.px(frame.across.at(i)), frame.y + frame.height,
                     k_grid);
    }
    for (int i = 0; i < frame.up.count(); ++i) {
        const double y = frame.py(frame.up.at(i));
        drawing.line(frame.x, y, frame.x + frame.width, y, k_grid);
        drawing.line(frame.x - 4.0, y, frame.x, y, "stroke=\"#000000\" stroke-width=\"0.8\"");
        drawing.text(frame.x - 6.0, y + 3.4, tick_text(frame.up.at(i), frame.up.decimals), "end", 10.0);
    }
    for (const PlotSeries& series : panel.series) {
        if (series.bars == PlotBars::band) {
            draw_series(drawing, series, frame);
        }
    }
    if (frame.up.low < 0.0 && frame.up.high > 0.0) {
        drawing.line(frame.x, frame.py(0.0), frame.x + frame.width, frame.py(0.0),
                     "stroke=\"#000000\" stroke-width=\"0.7\"");
    }
    for (const PlotLimit& limit : panel.limits) {
        const double y = frame.py(limit.y);
        drawing.line(frame.x, y, frame.x + frame.width, y,
                     "stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"6 3\"");
        drawing.text(frame.x + frame.width - 4.0, limit.y < 0.0 ? y + 11.0 : y - 4.0, limit.label, "end", 10.0);
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
    drawing.rectangle(frame.x, frame.y, frame.width, frame.height,
                      "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"");
    for (int i = 0; i < frame.across.count(); ++i) {
        const double x = frame.px(frame.across.at(i));
        drawing.line(x, frame.y + frame.height, x, frame.y + frame.height + 4.0,
                     "stroke=\"#000000\" stroke-width=\"0.8\"");
        if (with_axis) {
            drawing.text(x, frame.y + frame.height + 15.0, tick_text(frame.across.at(i), frame.across.decimals),
                         "middle", 10.0);
        }
    }
    drawing.upright_text(frame.x - 38.0, frame.y + 0.5 * frame.height, panel.y_label, 11.0);
}

/// \throws gum::NoResultError  for a number whose tick label could not be read
void require_ordinary(const std::string& where, std::initializer_list<double> numbers) {
    constexpr double k_most = 1e12;
    for (const double v : numbers) {
        if (!(std::abs(v) < k_most)) {
            throw gum::NoResultError(gum::Diagnostic{.code = "GC-REPORT-0003",
                                                     .where = "plot " + where,
                                                     .what = "a number that is not finite, or above 1e12",
                                                     .rule = "a plot shows finite numbers of ordinary size",
                                                     .action = "look for it in the record"});
        }
    }
}

void require_finite(const Plot& plot) {
    for (const PlotPanel& panel : plot.panels) {
        for (const PlotSeries& series : panel.series) {
            for (const PlotPoint& p : series.points) {
                require_ordinary(plot.id + ", " + panel.heading, {p.x, p.y, p.U});
            }
        }
    }
}

/// The drawing inside its document, with the texts for screen readers.
std::string document(const std::string& id, const std::string& title, const std::string& description, double height,
                     const Drawing& drawing) {
    const std::string size = number(k_width) + " " + number(height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" viewBox=\"0 0 " + size +
           "\" role=\"img\" aria-labelledby=\"" + id + "-title " + id + "-desc\">\n<title id=\"" + id + "-title\">" +
           escape_markup(title) + "</title>\n<desc id=\"" + id + "-desc\">" + escape_markup(description) + "</desc>\n" +
           drawing.body + "</svg>\n";
}

}  // namespace

std::string escape_markup(const std::string& text) {
    std::string out;
    out.reserve(text.size());
    for (const char c : text) {
        switch (c) {
            case '&':
                out += "&amp;";
                break;
            case '<':
                out += "&lt;";
                break;
            case '>':
                out += "&gt;";
                break;
            case '"':
                out += "&quot;";
                break;
            case '\'':
                out += "&#39;";
                break;
            default:
                out += c;
        }
    }
    return out;
}

std::string svg(const Plot& plot) {
    require_finite(plot);
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
    Ticks across;
    if (x_low <= x_high) {
        across = plot.x_is_angle ? angle_ticks(x_low, x_high) : nice_ticks(x_low, x_high, 8);
    }

    Drawing drawing;
    const int count = static_cast<int>(plot.panels.size());
    const int columns = std::max(1, plot.columns);
    const int rows = (count + columns - 1) / columns;
    const double top = key.empty() ? 0.0 : k_key;
    const double panel_pitch = k_head + plot.panel_height + k_foot;
    const double height = top + rows * panel_pitch - k_foot + k_axis;
    const double column_width = (k_width - (columns - 1) * k_between) / columns;

    drawing.rectangle(0.0, 0.0, k_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    double key_x = k_left + 6.0;
    for (const PlotSeries& series : key) {
        drawing.marker(series.marker, key_x, 10.0, 2.6);
        drawing.text(key_x + 8.0, 13.5, series.label, "start", 10.5);
        key_x += 8.0 + 6.4 * static_cast<double>(series.label.size()) + 18.0;
    }
    for (int i = 0; i < count; ++i) {
        const PlotPanel& panel = plot.panels[static_cast<std::size_t>(i)];
        const int column = i / rows;
        const int row = i % rows;
        double low = 0.0;  // the zero line belongs to every panel: errors and differences are read against it
        double high = 0.0;
        for (const PlotSeries& series : panel.series) {
            for (const PlotPoint& p : series.points) {
                const double U = series.bars == PlotBars::none ? 0.0 : p.U;
                low = std::min(low, p.y - U);
                high = std::max(high, p.y + U);
            }
        }
        for (const PlotLimit& limit : panel.limits) {
            low = std::min(low, limit.y * 1.15);
            high = std::max(high, limit.y * 1.15);
        }
        const Frame frame{.x = column * (column_width + k_between) + k_left,
                          .y = top + row * panel_pitch + k_head,
                          .width = column_width - k_left - k_right,
                          .height = plot.panel_height,
                          .across = across,
                          .up = nice_ticks(low, high, plot.panel_height > 100.0 ? 6 : 4)};
        const bool lowest = row == rows - 1 || i == count - 1;
        draw_panel(drawing, panel, frame, lowest);
        if (lowest) {
            drawing.text(frame.x + 0.5 * frame.width, frame.y + frame.height + 31.0, plot.x_label, "middle", 11.0);
        }
    }

    return document(plot.id, plot.title, plot.description, height, drawing);
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
    const double width = k_width - labels - k_texts;
    const auto px = [&](double v) { return labels + (v - ticks.low) / (ticks.high - ticks.low) * width; };

    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    for (int i = 0; i < ticks.count(); ++i) {
        const double x = px(ticks.at(i));
        drawing.line(x, top, x, bottom, "stroke=\"#e2e2e2\" stroke-width=\"0.6\"");
        drawing.line(x, bottom, x, bottom + 4.0, "stroke=\"#000000\" stroke-width=\"0.8\"");
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
    return document(plot.id, plot.title, plot.description, height, drawing);
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
    const Frame frame{.x = k_side,
                      .y = k_key + 2.0,
                      .width = k_width - k_side - k_right,
                      .height = strips + k_curve,
                      .across = nice_ticks(low, high, 10),
                      .up = {.low = 0.0, .high = most > 0.0 ? most * (strips + k_curve) / (0.96 * k_curve) : 1.0}};
    const double bottom = frame.y + frame.height;
    const double height = bottom + k_axis;

    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_width, height, "fill=\"#ffffff\" stroke=\"none\"");
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
    drawing.rectangle(frame.x, frame.y, frame.width, frame.height,
                      "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"");
    for (int i = 0; i < frame.across.count(); ++i) {
        const double x = frame.px(frame.across.at(i));
        drawing.line(x, bottom, x, bottom + 4.0, "stroke=\"#000000\" stroke-width=\"0.8\"");
        drawing.text(x, bottom + 15.0, tick_text(frame.across.at(i), frame.across.decimals), "middle", 10.0);
    }
    drawing.text(frame.x + 0.5 * frame.width, bottom + 31.0, plot.x_label, "middle", 11.0);
    drawing.upright_text(frame.x - 10.0, frame.y + 0.5 * frame.height, plot.y_label, 11.0);
    return document(plot.id, plot.title, plot.description, height, drawing);
}

}  // namespace gumcert::reports
