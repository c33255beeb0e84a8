#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace gumcert::reports {

/// One station or reflector of a layout.
struct LayoutPoint {
    std::string name;
    std::array<double, 3> position_mm{};  ///< in the frame T of the table
    /// Of the position, in the same frame, [mm²]; none, or all zero: no ellipse is drawn.
    std::optional<std::array<std::array<double, 3>, 3>> covariance_mm2 = {};
    bool marked = false;  ///< drawn filled: what the reader is to look at, e.g. a station that a plan proposes
};

/// Stations and reflectors about an axis of rotation, seen along the three coordinates at one scale: x-z, beside it
/// y-z, and below it x-y. Confidence ellipses are magnified, because a layout has metres and its uncertainties
/// micrometres; the caption has to say by how much, see layout_magnification().
struct LayoutPlot {
    std::string id = "plot-layout";  ///< unique in a document, [a-z0-9-]
    std::string title = {};          ///< for screen readers
    std::string description = {};    ///< for screen readers
    std::string axis = "A";          ///< "A", "B" or "C": the axis of rotation lies along x, y or z of T
    std::vector<LayoutPoint> stations = {}, reflectors = {};
    /// Semi-axis of an ellipse in standard deviations; 2.448 holds 95 % of a two-dimensional normal distribution.
    double ellipse_factor = 2.448;
    // Texts of the key.
    std::string stations_label = "station";
    std::string marked_label = "station, marked";
    std::string reflectors_label = "reflector";
    std::string axis_label = "axis of rotation";
    std::string ellipse_label = "confidence ellipse, magnified";
};

/// How many times the ellipses of a layout are magnified: 1, 2 or 5 times a power of ten; 0 where there are none.
struct LayoutMagnification {
    double stations = 0.0, reflectors = 0.0;
};

[[nodiscard]] LayoutMagnification layout_magnification(const LayoutPlot& plot);

/// A whole SVG 1.1 document, 680 units wide, by the rules of svg_plot.h.
/// \throws gum::NoResultError if a number is not finite or an axis has no such letter
[[nodiscard]] std::string svg(const LayoutPlot& plot);

}  // namespace gumcert::reports
