#include "reports/plots/layout_plot.h"

#include "gum/quantity/diagnostic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::array<std::array<double, 3>, 3> covariance(double xx, double xy, double yy) {
    return {{{xx, xy, 0.0}, {xy, yy, 0.0}, {0.0, 0.0, 0.0}}};
}

LayoutPlot six_stations() {
    LayoutPlot plot;
    plot.title = "t";
    plot.description = "d";
    plot.axis = "C";
    for (int i = 0; i < 6; ++i) {
        plot.stations.push_back({.name = "P" + std::to_string(i + 1),
                                 .position_mm = {900.0, -700.0 + 280.0 * i, 100.0 * (i % 3)},
                                 .covariance_mm2 = covariance(1e-6, 0.0, 1e-6)});
        plot.reflectors.push_back(
            {.name = "R" + std::to_string(i + 1), .position_mm = {30.0 * (i % 2), 60.0 * (i / 2) - 60.0, 20.0 * i}});
    }
    return plot;
}

/// Attribute of every element that has one of that name, in order.
std::vector<double> attributes(const std::string& svg, const std::string& element, const std::string& name) {
    std::vector<double> all;
    for (std::size_t at = svg.find("<" + element + " "); at != std::string::npos;
         at = svg.find("<" + element + " ", at + 1)) {
        const std::size_t from = svg.find(" " + name + "=\"", at) + name.size() + 3;
        all.push_back(std::stod(svg.substr(from)));
    }
    return all;
}

/// Corners of every polygon.
std::vector<std::vector<std::pair<double, double>>> polygons(const std::string& svg) {
    std::vector<std::vector<std::pair<double, double>>> all;
    const std::string open = "<polygon points=\"";
    for (std::size_t at = svg.find(open); at != std::string::npos; at = svg.find(open, at + 1)) {
        const std::size_t from = at + open.size();
        std::istringstream corners(svg.substr(from, svg.find('"', from) - from));
        auto& polygon = all.emplace_back();
        double x = 0.0;
        double y = 0.0;
        char comma = 0;
        while (corners >> x >> comma >> y) {
            polygon.emplace_back(x, y);
        }
    }
    return all;
}

std::size_t count(const std::string& text, const std::string& part) {
    std::size_t n = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) {
        ++n;
    }
    return n;
}

TEST(LayoutPlot, NamesEveryPointInEveryView) {
    const std::string text = svg(six_stations());
    EXPECT_EQ(text, svg(six_stations()));
    for (int i = 1; i <= 6; ++i) {
        EXPECT_EQ(count(text, ">P" + std::to_string(i) + "</text>"), 3U);
        EXPECT_EQ(count(text, ">R" + std::to_string(i) + "</text>"), 3U);
    }
    for (const char* label : {">x / mm<", ">y / mm<", ">z / mm<"}) {
        EXPECT_EQ(count(text, label), 2U) << label;
    }
    EXPECT_EQ(count(text, ">C</text>"), 3U);
    EXPECT_EQ(count(text, "stroke-dasharray=\"12 3 2 3\""), 3U) << "two views across the axis, and the key";
    EXPECT_THAT(text, HasSubstr("viewBox=\"0 0 680 "));
    for (const char* part : {"nan", "inf", "\"-0\"", "<ellipse", "transform=\"scale"}) {
        EXPECT_THAT(text, Not(HasSubstr(part)));
    }
}

TEST(LayoutPlot, HasOneScaleInAllViews) {
    LayoutPlot plot = six_stations();
    plot.stations = {{.name = "near", .position_mm = {0.0, 0.0, 0.0}},
                     {.name = "far", .position_mm = {400.0, 300.0, 200.0}}};
    plot.reflectors.clear();
    // Rectangles: background, key, then in each view its frame before its stations.
    const std::string text = svg(plot);
    const std::vector<double> x = attributes(text, "rect", "x");
    const std::vector<double> y = attributes(text, "rect", "y");
    const std::vector<double> width = attributes(text, "rect", "width");
    std::vector<std::pair<double, double>> stations;
    for (std::size_t i = 2; i < x.size(); ++i) {
        if (width[i] == 6.0) {
            stations.emplace_back(x[i], y[i]);
        }
    }
    ASSERT_EQ(stations.size(), 6U);
    const double scale = (stations[1].first - stations[0].first) / 400.0;  // x in the view of x and z
    EXPECT_GT(scale, 0.3);
    EXPECT_NEAR((stations[0].second - stations[1].second) / 200.0, scale, 1e-4);
    EXPECT_NEAR((stations[3].first - stations[2].first) / 300.0, scale, 1e-4);  // y and z
    EXPECT_NEAR((stations[2].second - stations[3].second) / 200.0, scale, 1e-4);
    EXPECT_NEAR((stations[5].first - stations[4].first) / 400.0, scale, 1e-4);  // x and y
    EXPECT_NEAR((stations[4].second - stations[5].second) / 300.0, scale, 1e-4);
}

TEST(LayoutPlot, EllipsesAreTheMagnifiedCovariances) {
    // Semi-axes 3 µm and 1 µm, the long one at 30° from x to y: V = R diag(9, 1) Rᵀ = [[7, 2√3], [2√3, 3]].
    LayoutPlot plot;
    plot.axis = "A";
    plot.ellipse_factor = 1.0;
    plot.stations = {{.name = "P1",
                      .position_mm = {1000.0, 0.0, 0.0},
                      .covariance_mm2 = covariance(7e-6, 2e-6 * std::sqrt(3.0), 3e-6)}};
    const LayoutMagnification magnification = layout_magnification(plot);
    EXPECT_EQ(magnification.reflectors, 0.0);
    EXPECT_EQ(magnification.stations, 20000.0);  // 8 % of 1.16 m over √7 µm, next lower of 1, 2, 5
    const std::string text = svg(plot);
    // In the key, then in x-z, y-z and x-y.
    const auto all = polygons(text);
    ASSERT_EQ(all.size(), 4U);
    const auto& ellipse = all[3];
    ASSERT_EQ(ellipse.size(), 40U);
    double centre_x = 0.0;
    double centre_y = 0.0;
    for (const auto& [x, y] : ellipse) {
        centre_x += x / 40.0;
        centre_y += y / 40.0;
    }
    double longest = 0.0;
    double shortest = std::numeric_limits<double>::infinity();
    double direction = 0.0;
    for (const auto& [x, y] : ellipse) {
        const double away = std::hypot(x - centre_x, y - centre_y);
        if (away > longest) {
            longest = away;
            direction = std::atan(-(y - centre_y) / (x - centre_x)) * 180.0 / 3.14159265358979;
        }
        shortest = std::min(shortest, away);
    }
    EXPECT_NEAR(longest / shortest, 3.0, 0.15);
    EXPECT_NEAR(direction, 30.0, 5.0);
}

TEST(LayoutPlot, MagnificationIsARoundNumber) {
    for (const double u : {1e-7, 3e-5, 2e-4, 1e-3, 7e-3, 0.4, 100.0}) {
        LayoutPlot plot = six_stations();
        for (LayoutPoint& station : plot.stations) {
            station.covariance_mm2 = covariance(u * u, 0.0, u * u);
        }
        double digit = layout_magnification(plot).stations;
        EXPECT_GE(digit, 1.0);
        while (digit >= 10.0) {
            digit /= 10.0;
        }
        EXPECT_TRUE(std::abs(digit - 1.0) < 1e-9 || std::abs(digit - 2.0) < 1e-9 || std::abs(digit - 5.0) < 1e-9)
            << digit;
    }
    LayoutPlot exact = six_stations();
    for (LayoutPoint& station : exact.stations) {
        station.covariance_mm2 = covariance(0.0, 0.0, 0.0);
    }
    EXPECT_EQ(layout_magnification(exact).stations, 0.0);
    EXPECT_THAT(svg(exact), Not(HasSubstr("confidence ellipse")));
}

TEST(LayoutPlot, CrowdedPointsAndHostileNamesStayReadable) {
    LayoutPlot plot = six_stations();
    for (int i = 0; i < 60; ++i) {
        plot.reflectors.push_back({.name = "<" + std::string(200, 'W'), .position_mm = {1.0, 1.0, 1.0}});
    }
    const std::string text = svg(plot);
    EXPECT_THAT(text, Not(HasSubstr("<WW")));
    EXPECT_THAT(text, Not(HasSubstr("WWWWWWWWWWWW")));
    EXPECT_THAT(text, HasSubstr("</svg>"));
    plot.stations.clear();
    plot.reflectors.clear();
    EXPECT_THAT(svg(plot), HasSubstr("</svg>"));
}

TEST(LayoutPlot, RefusesWhatItCannotDraw) {
    LayoutPlot plot = six_stations();
    plot.axis = "D";
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
    plot = six_stations();
    plot.stations[0].position_mm[1] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
    plot = six_stations();
    plot.stations[0].covariance_mm2 = covariance(std::numeric_limits<double>::infinity(), 0.0, 1.0);
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
}

}  // namespace
}  // namespace gumcert::reports
