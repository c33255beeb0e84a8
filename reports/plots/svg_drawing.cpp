#include "reports/plots/svg_drawing.h"

#include "gum/quantity/diagnostic.h"
#include "text/markup.h"
#include "text/numbers.h"
#include "text/utf8.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gumcert::reports {

namespace {

constexpr const char* k_font = "font-family=\"'Libertinus Serif', 'DejaVu Serif', Georgia, serif\"";

}  // namespace

std::string drawing_number(double v) {
    const std::string text = text::without_trailing_zeros(text::fixed(v, 2));
    return text == "-0" ? "0" : text;
}

std::string tick_text(double v, int decimals) {
    const std::string text = text::fixed(std::abs(v), decimals);
    const bool zero = text.find_first_not_of("0.") == std::string::npos;
    return v < 0.0 && !zero ? "\u2212" + text : text;
}

double text_width(const std::string& text, double size) {
    constexpr double k_mean_width = 0.53;  // of a character of a serif font, in units of its size
    const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return !text::is_continuation(c); });
    return k_mean_width * size * static_cast<double>(characters);
}

int Ticks::count() const {
    constexpr double k_rounding = 1e-6;  // of a step
    return static_cast<int>(std::floor((high - low) / step + k_rounding)) + 1;
}

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

Ticks angle_ticks(double low, double high, int most) {
    if (high - low < 10.0) {
        return nice_ticks(low, high, most);
    }
    for (const double step : {5.0, 10.0, 15.0, 30.0, 45.0, 60.0, 90.0}) {
        const double from = std::floor(low / step + 1e-9) * step;
        const double to = std::ceil(high / step - 1e-9) * step;
        if (to - from <= (most + 0.5) * step) {
            return {.low = from, .high = to, .step = step, .decimals = 0};
        }
    }
    return nice_ticks(low, high, most);
}

void Drawing::line(double x1, double y1, double x2, double y2, const char* style) {
    body += "<line x1=\"" + drawing_number(x1) + "\" y1=\"" + drawing_number(y1) + "\" x2=\"" + drawing_number(x2) +
            "\" y2=\"" + drawing_number(y2) + "\" " + style + "/>\n";
}

void Drawing::rectangle(double x, double y, double width, double height, const char* style) {
    body += "<rect x=\"" + drawing_number(x) + "\" y=\"" + drawing_number(y) + "\" width=\"" + drawing_number(width) +
            "\" height=\"" + drawing_number(height) + "\" " + style + "/>\n";
}

void Drawing::points(const char* element, const std::vector<std::pair<double, double>>& at, const char* style) {
    body += std::string("<") + element + " points=\"";
    for (std::size_t i = 0; i < at.size(); ++i) {
        body += (i == 0 ? "" : " ") + drawing_number(at[i].first) + "," + drawing_number(at[i].second);
    }
    body += std::string("\" ") + style + "/>\n";
}

void Drawing::text(double x, double y, const std::string& content, const char* anchor, double size, const char* more) {
    body += "<text x=\"" + drawing_number(x) + "\" y=\"" + drawing_number(y) + "\" font-size=\"" +
            drawing_number(size) + "\" text-anchor=\"" + anchor + "\" fill=\"#000000\" " + k_font + more + ">" +
            text::escaped_markup(content) + "</text>\n";
}

void Drawing::upright_text(double x, double y, const std::string& content, double size) {
    const std::string turn = " transform=\"rotate(-90 " + drawing_number(x) + " " + drawing_number(y) + ")\"";
    text(x, y, content, "middle", size, turn.c_str());
}

void Drawing::marker(PlotMarker kind, double x, double y, double r) {
    switch (kind) {
        case PlotMarker::disc:
            body += "<circle cx=\"" + drawing_number(x) + "\" cy=\"" + drawing_number(y) + "\" r=\"" +
                    drawing_number(r) + "\" fill=\"#000000\" stroke=\"none\"/>\n";
            return;
        case PlotMarker::ring:
            body += "<circle cx=\"" + drawing_number(x) + "\" cy=\"" + drawing_number(y) + "\" r=\"" +
                    drawing_number(r) + "\" fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.9\"/>\n";
            return;
        case PlotMarker::square:
            rectangle(x - r, y - r, 2.0 * r, 2.0 * r, "fill=\"#ffffff\" stroke=\"#000000\" stroke-width=\"0.9\"");
            return;
        case PlotMarker::triangle:
            points("polygon", {{x, y - 1.3 * r}, {x + 1.2 * r, y + 0.9 * r}, {x - 1.2 * r, y + 0.9 * r}},
                   "fill=\"#9a9a9a\" stroke=\"#000000\" stroke-width=\"0.9\"");
            return;
        case PlotMarker::cross:
            line(x - r, y - r, x + r, y + r, "stroke=\"#000000\" stroke-width=\"1.2\"");
            line(x - r, y + r, x + r, y - r, "stroke=\"#000000\" stroke-width=\"1.2\"");
            return;
        case PlotMarker::bar:
            line(x - 2.4 * r, y, x + 2.4 * r, y, "stroke=\"#000000\" stroke-width=\"1.2\"");
            return;
        case PlotMarker::broken_bar:
            line(x - 2.4 * r, y, x - 0.9 * r, y, "stroke=\"#000000\" stroke-width=\"1.2\"");
            line(x + 0.9 * r, y, x + 2.4 * r, y, "stroke=\"#000000\" stroke-width=\"1.2\"");
            return;
        case PlotMarker::none:
            return;
    }
}

bool is_ordinary(double number) {
    constexpr double k_most = 1e11;
    return std::abs(number) < k_most;
}

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

std::string svg_document(const std::string& id, const std::string& title, const std::string& description, double height,
                         const Drawing& drawing) {
    const std::string size = drawing_number(k_drawing_width) + " " + drawing_number(height);
    return "<svg xmlns=\"http://www.w3.org/2000/svg\" version=\"1.1\" viewBox=\"0 0 " + size +
           "\" role=\"img\" aria-labelledby=\"" + id + "-title " + id + "-desc\">\n<title id=\"" + id + "-title\">" +
           text::escaped_markup(title) + "</title>\n<desc id=\"" + id + "-desc\">" + text::escaped_markup(description) +
           "</desc>\n" + drawing.body + "</svg>\n";
}

}  // namespace gumcert::reports
