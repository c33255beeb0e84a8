#pragma once

#include <string>
#include <vector>

namespace gumcert::reports {

enum class PlotMarker { disc, square, triangle };
enum class PlotBars { none, bars, band };  ///< how the expanded uncertainty is drawn

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
    double shift = 0.0;   ///< horizontal displacement in drawing units, so that bars of two series stand side by side
};

struct PlotLimit {
    double y = 0.0;
    std::string label;
};

struct PlotPanel {
    std::string heading;
    std::string y_label;
    std::vector<PlotSeries> series;
    std::vector<PlotLimit> limits;  ///< dashed horizontal lines; always inside the panel
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
};

/// A plot as a whole SVG 1.1 document: lines, rectangles, polygons, circles and plain text elements only.
///
/// Series differ by marker and filling, not by colour; numbers are fixed texts, so the same plot has the same bytes.
/// \throws gum::NoResultError if a number is not finite
[[nodiscard]] std::string svg(const Plot& plot);

/// The five characters that mean something to XML and HTML, escaped.
[[nodiscard]] std::string escape_markup(const std::string& text);

}  // namespace gumcert::reports
