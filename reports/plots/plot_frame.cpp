#include "reports/plots/plot_frame.h"

#include "reports/printable_text.h"
#include "text/utf8.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gumcert::reports {

namespace {

constexpr const char* k_grid = "stroke=\"#e2e2e2\" stroke-width=\"0.6\"";
constexpr const char* k_tick = "stroke=\"#000000\" stroke-width=\"0.8\"";
constexpr double k_tick_size = 10.0;
constexpr double k_title_size = 11.0;
constexpr double k_key_size = 10.5;

void draw_symbol(Drawing& drawing, PlotKey::Symbol symbol, double x, double y) {
    switch (symbol) {
        case PlotKey::Symbol::disc:
            drawing.marker(PlotMarker::disc, x, y, 2.6);
            return;
        case PlotKey::Symbol::ring:
            drawing.marker(PlotMarker::ring, x, y, 2.6);
            return;
        case PlotKey::Symbol::square:
            drawing.rectangle(x - 4.0, y - 4.0, 8.0, 8.0, "fill=\"#000000\" stroke=\"none\"");
            return;
        case PlotKey::Symbol::cross:
            drawing.marker(PlotMarker::cross, x, y, 2.6);
            return;
        case PlotKey::Symbol::bar:
            drawing.line(x, y - 5.0, x, y + 5.0, "stroke=\"#555555\" stroke-width=\"0.8\"");
            drawing.line(x - 1.8, y - 5.0, x + 1.8, y - 5.0, "stroke=\"#555555\" stroke-width=\"0.8\"");
            drawing.line(x - 1.8, y + 5.0, x + 1.8, y + 5.0, "stroke=\"#555555\" stroke-width=\"0.8\"");
            drawing.marker(PlotMarker::disc, x, y, 2.2);
            return;
        case PlotKey::Symbol::line:
            drawing.line(x - 8.0, y, x + 8.0, y, "stroke=\"#000000\" stroke-width=\"1.2\"");
            return;
        case PlotKey::Symbol::grey_line:
            drawing.line(x - 8.0, y, x + 8.0, y, "stroke=\"#8a8a8a\" stroke-width=\"0.9\"");
            return;
        case PlotKey::Symbol::dashed:
            drawing.line(x - 8.0, y, x + 8.0, y, "stroke=\"#000000\" stroke-width=\"0.9\" stroke-dasharray=\"4 2\"");
            return;
        case PlotKey::Symbol::band:
            drawing.rectangle(x - 8.0, y - 4.5, 16.0, 9.0, "fill=\"#d9d9d9\" stroke=\"none\"");
            drawing.line(x - 8.0, y, x + 8.0, y, "stroke=\"#000000\" stroke-width=\"1.2\"");
            return;
        case PlotKey::Symbol::open_bar:
            drawing.rectangle(x - 4.0, y - 5.0, 8.0, 10.0, "fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.8\"");
            return;
        case PlotKey::Symbol::filled_bar:
            drawing.rectangle(x - 4.0, y - 5.0, 8.0, 10.0, "fill=\"#b5b5b5\" stroke=\"#000000\" stroke-width=\"0.8\"");
            return;
        case PlotKey::Symbol::beyond:
            drawing.points("polygon", {{x, y - 4.0}, {x + 3.5, y + 3.0}, {x - 3.5, y + 3.0}},
                           "fill=\"#000000\" stroke=\"none\"");
            return;
    }
}

}  // namespace

std::string superscript(int n) {
    static constexpr const char* k_digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
    std::string text = n < 0 ? "⁻" : "";
    for (const char c : std::to_string(std::abs(n))) {
        text += k_digits[c - '0'];
    }
    return text;
}

AxisScale AxisScale::of(double largest, double most) {
    const double magnitude = std::abs(largest);
    if (!(magnitude > 0.0) || (magnitude >= 1e-3 && magnitude < most)) {
        return {};
    }
    return {.exponent = 3 * static_cast<int>(std::floor(std::log10(magnitude) / 3.0))};
}

double AxisScale::operator()(double v) const {
    // Beyond 10^±300 the power itself would not be a number.
    return exponent == 0 ? v : v / std::pow(10.0, exponent / 2) / std::pow(10.0, exponent - exponent / 2);
}

std::string AxisScale::label(const std::string& name, const std::string& unit) const {
    if (exponent == 0) {
        return unit.empty() ? name : name + " / " + unit;
    }
    const std::string power = "10" + superscript(exponent);
    return name + " / " + (unit.empty() ? power : "(" + power + " " + unit + ")");
}

std::string AxisScale::label(const std::string& title) const {
    const std::size_t unit_at = title.rfind(" / ");
    return exponent == 0 ? title
           : unit_at == std::string::npos
               ? label(title, "")
               : label(title.substr(0, unit_at), title.substr(unit_at + std::string_view(" / ").size()));
}

void AxisRange::include(double v) {
    low = std::min(low, v);
    high = std::max(high, v);
}

AxisRange AxisRange::widened(double share) const {
    const double room = share * (high - low);
    return {.low = low - room, .high = high + room};
}

void require_finite(const std::string& where, std::initializer_list<double> numbers) {
    for (const double v : numbers) {
        if (!std::isfinite(v)) {
            require_ordinary(where, {v});
        }
    }
}

double on_axis(const std::string& where, double v) {
    constexpr double k_far = 1e11;
    require_finite(where, {v});
    return std::clamp(v, -k_far, k_far);
}

double middle_of(std::vector<double> numbers) {
    if (numbers.empty()) {
        return 0.0;
    }
    for (const double v : numbers) {
        require_finite("median", {v});
    }
    std::sort(numbers.begin(), numbers.end());
    const std::size_t half = numbers.size() / 2;
    return numbers.size() % 2 == 1 ? numbers[half] : 0.5 * numbers[half - 1] + 0.5 * numbers[half];
}

double spread_of(const std::vector<double>& numbers) {
    const double middle = middle_of(numbers);
    std::vector<double> deviations;
    deviations.reserve(numbers.size());
    for (const double v : numbers) {
        deviations.push_back(std::abs(v - middle));
    }
    return 1.483 * middle_of(std::move(deviations));
}

double label_width(const std::string& text, double size) {
    constexpr unsigned char k_ideographs = 0xE3;  // first byte of U+3000 and above in UTF-8
    const auto wide =
        std::count_if(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) >= k_ideographs; });
    return text_width(text, size) + 0.5 * size * static_cast<double>(wide);
}

void draw_upright_title(Drawing& drawing, double x, double y, double height, const std::string& title) {
    constexpr double k_size = 11.0;
    constexpr double k_least_size = 8.0;
    constexpr double k_beyond = 12.0;  // half of what two panels leave between them
    const double room = height + k_beyond;
    const double width = label_width(title, k_size);
    if (width <= room) {
        drawing.upright_text(x, y, title, k_size);
        return;
    }
    const double size = std::max(k_least_size, k_size * room / width);
    std::string shown = title;
    const std::size_t unit_at = std::min(title.rfind(" / "), title.size());
    const std::string name = title.substr(0, unit_at);
    const std::string unit = title.substr(unit_at);
    for (std::size_t most = name.size(); label_width(shown, size) > room && most > 1; --most) {
        shown = shortened(name, most) + unit;
    }
    drawing.upright_text(x, y, shown, size);
}

std::string shortened_name(const std::string& name, std::size_t most) {
    constexpr std::size_t k_end = 8;
    std::vector<std::size_t> starts;  // of the characters
    for (std::size_t i = 0; i < name.size(); ++i) {
        if (!text::is_continuation(name[i])) {
            starts.push_back(i);
        }
    }
    if (starts.size() <= most) {
        return name;
    }
    return name.substr(0, starts[most - k_end - 1]) + "…" + name.substr(starts[starts.size() - k_end]);
}

void draw_upright_name(Drawing& drawing, double x, double y, const std::string& name, double size) {
    const std::string turn = " transform=\"rotate(-90 " + drawing_number(x) + " " + drawing_number(y) + ")\"";
    drawing.text(x, y, name, "end", size, turn.c_str());
}

double PlotFrame::py_inside(double v) const {
    return py(std::clamp(v, up.low, up.high));
}

double widest_label(const Ticks& ticks) {
    double widest = 0.0;
    for (int i = 0; i < ticks.count(); ++i) {
        widest = std::max(widest, text_width(tick_text(ticks.at(i), ticks.decimals), k_tick_size));
    }
    return widest;
}

Ticks ticks_apart(double low, double high, int most, double width) {
    constexpr double k_apart = 2.0;  // widths are estimated amply
    Ticks ticks = nice_ticks(low, high, most);
    for (int fewer = most - 1; fewer > 0; --fewer) {
        if (widest_label(ticks) + k_apart <= width * ticks.step / (ticks.high - ticks.low)) {
            break;
        }
        ticks = nice_ticks(low, high, fewer);
    }
    return ticks;
}

double room_for_last_label(const Ticks& across, double least) {
    const double half = 0.5 * text_width(tick_text(across.at(across.count() - 1), across.decimals), k_tick_size);
    return half > least + 1.0 ? half : least;
}

double room_for_axis(const Ticks& up) {
    return widest_label(up) + 6.0 + 5.0 + k_title_size + 4.0;
}

void draw_up_ticks(Drawing& drawing, const PlotFrame& frame) {
    for (int i = 0; i < frame.up.count(); ++i) {
        const double y = frame.py(frame.up.at(i));
        drawing.line(frame.x, y, frame.right(), y, k_grid);
        drawing.line(frame.x - 4.0, y, frame.x, y, k_tick);
        drawing.text(frame.x - 6.0, y + 3.4, tick_text(frame.up.at(i), frame.up.decimals), "end", k_tick_size);
    }
}

void draw_up_axis(Drawing& drawing, const PlotFrame& frame, const std::string& title) {
    draw_up_ticks(drawing, frame);
    draw_upright_title(drawing, frame.x - room_for_axis(frame.up) + k_title_size + 1.0, frame.y + 0.5 * frame.height,
                       frame.height, title);
}

void draw_across_grid(Drawing& drawing, const PlotFrame& frame) {
    for (int i = 0; i < frame.across.count(); ++i) {
        const double x = frame.px(frame.across.at(i));
        drawing.line(x, frame.y, x, frame.bottom(), k_grid);
    }
}

void draw_across_ticks(Drawing& drawing, const PlotFrame& frame, bool numbered) {
    for (int i = 0; i < frame.across.count(); ++i) {
        const double x = frame.px(frame.across.at(i));
        drawing.line(x, frame.bottom(), x, frame.bottom() + 4.0, k_tick);
        if (numbered) {
            drawing.text(x, frame.bottom() + 15.0, tick_text(frame.across.at(i), frame.across.decimals), "middle",
                         k_tick_size);
        }
    }
}

void draw_across_title(Drawing& drawing, const PlotFrame& frame, const std::string& title) {
    drawing.text(frame.x + 0.5 * frame.width, frame.bottom() + 31.0, title, "middle", k_title_size);
}

void draw_across_axis(Drawing& drawing, const PlotFrame& frame, const std::string& title) {
    draw_across_grid(drawing, frame);
    draw_across_ticks(drawing, frame);
    draw_across_title(drawing, frame, title);
}

void draw_outline(Drawing& drawing, const PlotFrame& frame) {
    drawing.rectangle(frame.x, frame.y, frame.width, frame.height,
                      "fill=\"none\" stroke=\"#000000\" stroke-width=\"0.9\"");
}

void draw_limit(Drawing& drawing, const PlotFrame& frame, double at, const std::string& label) {
    const double y = frame.py(at);
    drawing.line(frame.x, y, frame.right(), y, "stroke=\"#000000\" stroke-width=\"1\" stroke-dasharray=\"6 3\"");
    drawing.text(frame.right() + 4.0, y + 3.4, label, "start", k_tick_size);
}

double room_for_limit(const std::string& label) {
    return 1.2 * label_width(label, k_tick_size) + 8.0;
}

void draw_beyond(Drawing& drawing, const PlotFrame& frame, double x, bool above) {
    const double tip = above ? frame.y + 1.0 : frame.bottom() - 1.0;
    const double base = above ? tip + 7.0 : tip - 7.0;
    drawing.points("polygon", {{x, tip}, {x + 3.5, base}, {x - 3.5, base}}, "fill=\"#000000\" stroke=\"none\"");
}

void draw_strokes(Drawing& drawing, const std::vector<Stroke>& strokes, const char* style) {
    if (strokes.empty()) {
        return;
    }
    drawing.body += "<path d=\"";
    for (const Stroke& s : strokes) {
        drawing.body += "M" + drawing_number(s.x) + "," + drawing_number(s.low) + "V" + drawing_number(s.high);
    }
    drawing.body += std::string("\" fill=\"none\" ") + style + "/>\n";
}

double PlotKey::draw(Drawing& drawing, double left, double right) const {
    constexpr double k_line = 16.0;
    constexpr double k_symbol = 22.0;
    double x = left;
    double y = 10.0;
    for (const auto& [symbol, label] : entries_) {
        const double room = k_symbol + label_width(label, k_key_size) + 14.0;
        if (x + room > right && x > left) {
            x = left;
            y += k_line;
        }
        draw_symbol(drawing, symbol, x + 8.0, y);
        drawing.text(x + k_symbol, y + 3.5, label, "start", k_key_size);
        x += room;
    }
    return entries_.empty() ? 4.0 : y + 12.0;
}

std::string plot_document(const std::string& id, const std::string& title, const std::string& description,
                          double height, const Drawing& elements) {
    Drawing drawing;
    drawing.rectangle(0.0, 0.0, k_drawing_width, height, "fill=\"#ffffff\" stroke=\"none\"");
    drawing.body += elements.body;
    return svg_document(id, title, description, height, drawing);
}

}  // namespace gumcert::reports
