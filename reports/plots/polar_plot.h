#pragma once

#include "reports/plots/svg_plot.h"

#include <string>
#include <vector>

namespace gumcert::reports {

/// One curve of a polar plot: x is the angle [°], y the radius, U the half width of its band.
struct PolarPanel {
    std::string heading;  ///< with the unit
    std::vector<PlotPoint> points;
};

/// Curves about a base circle that stands for zero, as ISO 230-7 shows error motions; three panels a row.
struct PolarPlot {
    std::string id, title, description;
    bool is_closed = true;  ///< the last point is joined to the first one
    std::vector<PolarPanel> panels;
};

/// A polar plot as a whole SVG document, as svg(const Plot&) makes it. Zero degrees are on the right, angles turn
/// counter-clockwise; the base circle is drawn solid, the rings beside it at equal steps.
/// \throws gum::NoResultError if a number is not finite
[[nodiscard]] std::string svg(const PolarPlot& plot);

}  // namespace gumcert::reports
