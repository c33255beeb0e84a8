#pragma once

#include "reports/plots/svg_plot.h"

#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

constexpr double k_drawing_width = 680.0;  ///< of every drawing of a document, in drawing units

/// With at most two decimals and without trailing zeros: 12.5, 3, -0.25.
[[nodiscard]] std::string drawing_number(double v);

/// Text of a tick, with U+2212 as minus sign.
[[nodiscard]] std::string tick_text(double v, int decimals);

/// Width of a text, about, in drawing units.
[[nodiscard]] double text_width(const std::string& text, double size);

struct Ticks {
    double low = 0.0, high = 1.0, step = 1.0;
    int decimals = 0;

    [[nodiscard]] int count() const;
    [[nodiscard]] double at(int i) const { return low + i * step; }
};

/// Steps of 1, 2 or 5 times a power of ten that cover [low, high] with at most `most` intervals.
[[nodiscard]] Ticks nice_ticks(double low, double high, int most);

/// Steps that divide a circle, for angles in degrees, with at most `most` intervals; other axes fall back to decimal
/// steps.
[[nodiscard]] Ticks angle_ticks(double low, double high, int most = 8);

/// The elements of a drawing, in the order in which they are painted.
class Drawing {
public:
    std::string body;

    void line(double x1, double y1, double x2, double y2, const char* style);
    void rectangle(double x, double y, double width, double height, const char* style);
    /// \param element  "polygon" or "polyline"
    void points(const char* element, const std::vector<std::pair<double, double>>& at, const char* style);
    void text(double x, double y, const std::string& content, const char* anchor, double size, const char* more = "");
    void upright_text(double x, double y, const std::string& content, double size);
    void marker(PlotMarker kind, double x, double y, double r);
};

/// Whether a plot can show a number, with the room that is left around it: not those that require_ordinary() refuses.
[[nodiscard]] bool is_ordinary(double number);
/// \throws gum::NoResultError  for a number whose tick label could not be read
void require_ordinary(const std::string& where, std::initializer_list<double> numbers);

/// The drawing inside its document, with the texts for screen readers.
[[nodiscard]] std::string svg_document(const std::string& id, const std::string& title, const std::string& description,
                                       double height, const Drawing& drawing);

}  // namespace gumcert::reports
