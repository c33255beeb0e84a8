#pragma once

#include "reports/plots/svg_drawing.h"

#include <cstddef>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {

/// Power of ten by which an axis is divided, so that its tick labels stay short: 1 for numbers of ordinary size, else
/// 10^(3n).
struct AxisScale {
    int exponent = 0;

    /// \param largest  greatest magnitude on the axis
    /// \param most     magnitude above which the labels would be too long
    [[nodiscard]] static AxisScale of(double largest, double most = 1e6);
    [[nodiscard]] double operator()(double v) const;
    /// "name / unit", "name / (10⁻⁶ unit)", "name" without unit.
    [[nodiscard]] std::string label(const std::string& name, const std::string& unit) const;
    /// The same of "name / unit".
    [[nodiscard]] std::string label(const std::string& title) const;
};

/// Lowest and highest of the numbers that an axis has to show.
struct AxisRange {
    double low = 0.0, high = 0.0;

    void include(double v);
    /// The same with room at both ends, a share of the range.
    [[nodiscard]] AxisRange widened(double share) const;
};

/// \throws gum::NoResultError  GC-REPORT-0003 a number is not finite
void require_finite(const std::string& where, std::initializer_list<double> numbers);

/// A number of an axis; one that is far beyond any axis is brought nearer, for it stands at the edge wherever it is.
/// \throws gum::NoResultError  GC-REPORT-0003 it is not finite
[[nodiscard]] double on_axis(const std::string& where, double v);

/// Median of numbers; 0 without any.
/// \throws gum::NoResultError  GC-REPORT-0003 a number is not finite
[[nodiscard]] double middle_of(std::vector<double> numbers);

/// How far the bulk of the numbers lies from their median: 1.483 times the median of the absolute deviations.
[[nodiscard]] double spread_of(const std::vector<double>& numbers);

/// Width of a text, about, in drawing units; ideographs count as squares.
[[nodiscard]] double label_width(const std::string& text, double size);
/// The title of an axis that goes up: in smaller type where it is longer than the axis, and shortened, but for its unit,
/// where that is not enough, so that titles of panels that stand below each other do not touch.
/// \param y       middle of the axis
/// \param height  of the axis
void draw_upright_title(Drawing& drawing, double x, double y, double height, const std::string& title);

/// An exponent in superscript digits: "⁻¹²".
[[nodiscard]] std::string superscript(int exponent);

/// At most so many characters of a name. What is left out of a longer one was in its middle: names of laboratories
/// often differ at their end only.
[[nodiscard]] std::string shortened_name(const std::string& name, std::size_t most);

/// A name turned upright below `y`.
void draw_upright_name(Drawing& drawing, double x, double y, const std::string& name, double size);

/// A panel with its axes, in drawing units.
struct PlotFrame {
    double x = 0.0, y = 0.0, width = 0.0, height = 0.0;
    Ticks across = {}, up = {};
    double margin = 0.0;  ///< left and right of the horizontal axis, inside the panel

    [[nodiscard]] double px(double v) const {
        return x + margin + (v - across.low) / (across.high - across.low) * (width - 2.0 * margin);
    }
    [[nodiscard]] double py(double v) const { return y + height - (v - up.low) / (up.high - up.low) * height; }
    [[nodiscard]] double bottom() const { return y + height; }
    [[nodiscard]] double right() const { return x + width; }
    /// Vertical position of a value, at the edge where it lies beyond the axis.
    [[nodiscard]] double py_inside(double v) const;
};

/// Width of the widest label of an axis, about, in drawing units.
[[nodiscard]] double widest_label(const Ticks& ticks);
/// Ticks of a horizontal axis of that width: at most `most` intervals, and so few that their labels stand apart.
[[nodiscard]] Ticks ticks_apart(double low, double high, int most, double width);
/// Room right of a panel that half of the label at the end of its horizontal axis needs, at least `least`.
[[nodiscard]] double room_for_last_label(const Ticks& across, double least);

/// Room that the labels of a vertical axis and its title need left of the panel.
[[nodiscard]] double room_for_axis(const Ticks& up);

/// Grid, ticks and their numbers left of the panel.
void draw_up_ticks(Drawing& drawing, const PlotFrame& frame);
/// The same with a title.
void draw_up_axis(Drawing& drawing, const PlotFrame& frame, const std::string& title);
void draw_across_grid(Drawing& drawing, const PlotFrame& frame);
/// Ticks below the panel, and where asked for their numbers.
void draw_across_ticks(Drawing& drawing, const PlotFrame& frame, bool numbered = true);
void draw_across_title(Drawing& drawing, const PlotFrame& frame, const std::string& title);
/// Grid, ticks with their numbers, and title below the panel.
void draw_across_axis(Drawing& drawing, const PlotFrame& frame, const std::string& title);
void draw_outline(Drawing& drawing, const PlotFrame& frame);
/// Dashed line across the panel with its label right of it.
void draw_limit(Drawing& drawing, const PlotFrame& frame, double at, const std::string& label);
/// Room right of the panel for such a label.
[[nodiscard]] double room_for_limit(const std::string& label);
/// A filled triangle at the upper or lower edge: a value lies beyond the axis.
void draw_beyond(Drawing& drawing, const PlotFrame& frame, double x, bool above);
/// A horizontal coordinate, and a lower and an upper vertical one at it.
struct Stroke {
    double x = 0.0, low = 0.0, high = 0.0;
};
/// Upright lines as one path.
void draw_strokes(Drawing& drawing, const std::vector<Stroke>& strokes, const char* style);

/// The key above a plot: symbols with their texts, in as many lines as they need.
class PlotKey {
public:
    enum class Symbol { disc, ring, square, cross, bar, line, grey_line, dashed, band, open_bar, filled_bar, beyond };

    void add(Symbol symbol, const std::string& label) { entries_.emplace_back(symbol, label); }
    /// \return height that the key takes
    double draw(Drawing& drawing, double left, double right) const;

private:
    std::vector<std::pair<Symbol, std::string>> entries_;
};

/// The elements of a plot on a white ground, inside its document.
[[nodiscard]] std::string plot_document(const std::string& id, const std::string& title, const std::string& description,
                                        double height, const Drawing& elements);

}  // namespace gumcert::reports
