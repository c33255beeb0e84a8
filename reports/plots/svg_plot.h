#pragma once

#include <string>
#include <vector>

namespace gumcert::reports {

/// `bar` and `broken_bar` lie across the axis: a limit that holds at a point, and says nothing beside it.
enum class PlotMarker { disc, ring, square, triangle, cross, bar, broken_bar, none };
/// How the expanded uncertainty is drawn; `edges` are dashed lines at y - U and y + U.
enum class PlotBars { none, bars, band, edges };

/// One value with its expanded uncertainty, in the units of the axes; U = 0: none is drawn.
struct PlotPoint {
    double x = 0.0, y = 0.0, U = 0.0;
};

struct PlotSeries {
    std::string label;  ///< in the key; "" leaves it out
    std::vector<PlotPoint> points;
    PlotMarker marker = PlotMarker::disc;
    PlotBars bars = PlotBars::none;
    bool joined = false;  ///< neighbours in x are joined by a line
    bool dashed = false;  ///< this line is dashed
    double shift = 0.0;   ///< horizontal displacement in drawing units, so that bars of two series stand side by side
    bool dotted = false;  ///< this line is dotted
};

struct PlotLimit {
    double y = 0.0;
    std::string label;  ///< stands where it hides the fewest points
    bool dotted = false;
};

/// An upright line across a panel, with a text at its upper end.
struct PlotMark {
    double x = 0.0;
    std::string label;
};

struct PlotPanel {
    std::string heading;
    std::string y_label;
    std::vector<PlotSeries> series;
    std::vector<PlotLimit> limits;  ///< dashed or dotted horizontal lines; always inside the panel
    /// Greatest magnitude of the vertical axis; what is beyond it is drawn at the edge. 0: as the points need it.
    double y_most = 0.0;
    /// Values of a quantity, not differences: without the zero line where that is further away than they are apart.
    bool values = false;
    std::vector<PlotMark> marks = {};
    /// y is in a power of ten already, which its label names: panels share one, or the axis ends before its points do.
    bool y_in_power = false;
    /// Curves of a low panel of their own below this one, from zero up, where Plot::strip_height is not 0.
    std::vector<PlotSeries> strip = {};
    std::string strip_label = {};
};

/// Panels in rows of `columns`, filled column by column; all share the horizontal axis.
struct Plot {
    std::string id;           ///< unique in a document, [a-z0-9-]
    std::string title;        ///< for screen readers
    std::string description;  ///< for screen readers
    std::string x_label;
    std::vector<PlotPanel> panels;
    int columns = 1;
    double panel_height = 150.0;  ///< drawing units; a plot is 680 wide
    bool x_is_angle = true;       ///< ticks divide a circle of 360
    bool x_is_number = false;     ///< of a point: ticks are whole numbers
    bool x_in_power = false;      ///< x is in a power of ten already, which its label names
    /// Drawing units that stay free between points and frame; 0: the outermost points may lie on it.
    double margin = 0.0;
    double strip_height = 0.0;  ///< of the low panels below the panels
};

/// One horizontal bar of a bar plot, with the text that stands at its end.
struct ShareBar {
    std::string label;
    double share = 0.0;  ///< [%]
    std::string text;
};

/// Horizontal bars, from the top down.
struct BarPlot {
    std::string id, title, description;
    std::string x_label;
    std::vector<ShareBar> bars;
};

/// Parts of a whole side by side in one bar.
struct StackedBar {
    std::string label;
    std::vector<double> shares;  ///< [%], parallel to StackedPlot::parts; what is negative is not drawn
    std::vector<std::string> texts;
    std::string text;  ///< at the end of the bar
};

/// Horizontal stacked bars, from the top down, with a key of the parts.
struct StackedPlot {
    std::string id, title, description;
    std::string x_label;
    std::string text_head;  ///< above the texts at the ends of the bars
    std::vector<std::string> parts;
    std::vector<StackedBar> bars;
};

/// Counts in cells of equal width side by side.
struct HistogramPlot {
    std::string id, title, description;
    std::string x_label, y_label;
    double first_edge = 0.0, cell_width = 1.0;
    std::vector<double> counts;
};

struct DensityInterval {
    std::string label;
    double low = 0.0, high = 0.0;
};

/// A histogram, the curve of a probability density over it, and intervals as brackets above both.
struct DensityPlot {
    std::string id, title, description;
    std::string x_label, y_label;
    double low = 0.0, high = 0.0;  ///< ends of the horizontal axis at least
    double first_edge = 0.0, cell_width = 1.0;
    std::vector<double> cells;  ///< heights, side by side from `first_edge` on
    std::string cells_label;
    std::vector<PlotPoint> curve;  ///< in ascending order of x; U is not drawn
    std::string curve_label;
    std::vector<DensityInterval> intervals;
};

/// A plot as a whole SVG 1.1 document: lines, rectangles, polygons, circles, paths and plain text elements only.
///
/// A curve of more points than the drawing can show keeps the least and the greatest of every place.
/// Series differ by marker and filling, not by colour; numbers are fixed texts, so the same plot has the same bytes.
/// \throws gum::NoResultError if a number is not finite
[[nodiscard]] std::string svg(const Plot& plot);
[[nodiscard]] std::string svg(const BarPlot& plot);
[[nodiscard]] std::string svg(const DensityPlot& plot);
[[nodiscard]] std::string svg(const StackedPlot& plot);
[[nodiscard]] std::string svg(const HistogramPlot& plot);

}  // namespace gumcert::reports
