#include "reports/plots/polar_plot.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {
namespace {

TEST(PolarPlot, IsAClosedCurveAboutTheCircleOfZero) {
    PolarPlot plot{.id = "p", .title = "t", .description = "d", .panels = {{.heading = "h", .points = {}}}};
    for (int i = 0; i < 4; ++i) {
        plot.panels[0].points.push_back({.x = 90.0 * i, .y = i == 1 ? 2.0 : 0.0, .U = 0.1});
    }
    const std::string text = svg(plot);
    const std::size_t at = text.find("<polyline points=\"") + 18;
    std::istringstream points(text.substr(at, text.find('"', at) - at));
    std::vector<std::string> corners;
    for (std::string point; points >> point;) {
        corners.push_back(point);
    }
    ASSERT_EQ(corners.size(), 5U);
    EXPECT_EQ(corners.front(), corners.back());
    // 90° is above the centre, farther from it than the zero of 270° below.
    const auto height = [&](std::size_t i) { return std::stod(corners[i].substr(corners[i].find(',') + 1)); };
    const double centre = height(0);
    EXPECT_GT(centre - height(1), height(3) - centre + 10.0);
    plot.is_closed = false;
    EXPECT_NE(svg(plot), text);
    plot.panels[0].points[0].y = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
}

}  // namespace
}  // namespace gumcert::reports
