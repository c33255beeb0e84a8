#include "reports/plots/svg_plot.h"

#include "gum/quantity/diagnostic.h"
#include "reports/plots/plot_frame.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace gumcert::reports {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Plot one_panel(double low, double high) {
    PlotSeries series{.label = "a <b> & \"c\"",
                      .points = {{0.0, low, 0.0}, {180.0, high, 0.0}},
                      .marker = PlotMarker::square,
                      .bars = PlotBars::bars,
                      .joined = true};
    return {.id = "p",
            .title = "t < u",
            .description = "d",
            .x_label = "x",
            .panels = {{.heading = "h", .y_label = "y", .series = {series}, .limits = {{1.0, "+1"}}}}};
}

TEST(SvgPlot, KeepsTheRulesForEveryRenderer) {
    const std::string text = svg(one_panel(-2.0, 3.0));
    EXPECT_EQ(text, svg(one_panel(-2.0, 3.0)));
    EXPECT_THAT(text, HasSubstr("viewBox=\"0 0 680 "));
    EXPECT_THAT(text, HasSubstr("<title id=\"p-title\">t &lt; u</title>"));
    EXPECT_THAT(text, HasSubstr("<desc id=\"p-desc\">d</desc>"));
    EXPECT_THAT(text, HasSubstr("a &lt;b&gt; &amp; &quot;c&quot;"));
    EXPECT_THAT(text, HasSubstr("stroke-dasharray"));
    for (const char* part : {"currentColor", "<use", "<tspan", "e-0", "nan", "inf", "\"-0\""}) {
        EXPECT_THAT(text, Not(HasSubstr(part)));
    }
}

/// Whatever the titles and the height of the panels are: those of neighbours do not touch, and the unit stays.
TEST(SvgPlot, KeepsTitlesOfAxesOffEachOther) {
    const std::regex form(
        "<text x=\"([^\"]*)\" y=\"([^\"]*)\" font-size=\"([^\"]*)\" text-anchor=\"middle\"[^>]*rotate[^>]*>([^<]*)<");
    for (const std::size_t length : {1U, 20U, 30U, 40U, 80U}) {
        for (const double height : {60.0, 110.0, 150.0, 300.0}) {
            for (const std::string letter : {"n", "差"}) {
                std::string name;
                for (std::size_t i = 0; i < length; ++i) {
                    name += letter;
                }
                Plot plot = one_panel(-2.0, 3.0);
                plot.panel_height = height;
                plot.columns = 1;
                plot.panels.front().y_label = name + " / mV";
                plot.panels.push_back(plot.panels.front());
                const std::string drawing = svg(plot);
                double end = -1e9;
                int titles = 0;
                for (std::sregex_iterator found(drawing.begin(), drawing.end(), form); found != std::sregex_iterator();
                     ++found, ++titles) {
                    const std::string title = (*found)[4];
                    const double half = 0.5 * label_width(title, std::stod((*found)[3]));
                    const double middle = std::stod((*found)[2]);
                    EXPECT_GE(middle - half, end) << title << " at a height of " << height;
                    EXPECT_THAT(title, testing::EndsWith(" / mV"));
                    end = middle + half;
                }
                EXPECT_EQ(titles, 2) << name;
            }
        }
    }
}

/// Left and upper end, width and height of the texts whose words are given.
std::vector<std::array<double, 4>> boxes_of(const std::string& drawing, const std::string& words) {
    std::vector<std::array<double, 4>> boxes;
    const std::regex form(
        "<text x=\"([^\"]*)\" y=\"([^\"]*)\" font-size=\"10\" text-anchor=\"([a-z]*)\"[^>]*>([^<]*)<");
    for (std::sregex_iterator found(drawing.begin(), drawing.end(), form); found != std::sregex_iterator(); ++found) {
        const std::string text = (*found)[4];
        if (text.find(words) == std::string::npos) {
            continue;
        }
        const double width = label_width(text, 10.0);
        const std::string anchor = (*found)[3];
        const double x = std::stod((*found)[1]) - (anchor == "end" ? width : anchor == "middle" ? 0.5 * width : 0.0);
        boxes.push_back({x, std::stod((*found)[2]) - 8.0, width, 10.0});
    }
    return boxes;
}

TEST(SvgPlot, LabelsOfLimitsDoNotCoverEachOther) {
    // A guard band is narrow or wide: limits of acceptance come as near to those of the tolerance as they like.
    for (double band = 1e-6; band < 1.0; band *= 1.3) {
        Plot plot = one_panel(-1.5, 1.5);
        plot.panels[0].limits = {{-1.0, "a limit of the tolerance"},
                                 {1.0, "a limit of the tolerance"},
                                 {-1.0 + band, "a limit of acceptance", true},
                                 {1.0 - band, "a limit of acceptance", true}};
        const std::vector<std::array<double, 4>> boxes = boxes_of(svg(plot), "a limit");
        ASSERT_EQ(boxes.size(), 4U) << band;
        for (std::size_t i = 0; i < boxes.size(); ++i) {
            for (std::size_t j = 0; j < i; ++j) {
                const auto& a = boxes[i];
                const auto& b = boxes[j];
                EXPECT_TRUE(a[0] + a[2] <= b[0] || b[0] + b[2] <= a[0] || a[1] + a[3] <= b[1] || b[1] + b[3] <= a[1])
                    << "labels " << i << " and " << j << " with a band of " << band;
            }
        }
    }
}

TEST(SvgPlot, TicksAreRoundNumbersWithOneSign) {
    const std::string text = svg(one_panel(-0.043, 0.071));
    EXPECT_THAT(text, HasSubstr(">\u22120.5<"));  // the limit at 1 sets the scale
    EXPECT_THAT(text, HasSubstr(">0.0<"));
    EXPECT_THAT(text, HasSubstr(">1.0<"));
    Plot free = one_panel(-0.043, 0.071);
    free.panels[0].limits.clear();
    EXPECT_THAT(svg(free), HasSubstr(">\u22120.05<"));
    EXPECT_THAT(svg(free), HasSubstr(">0.00<"));
    EXPECT_THAT(svg(free), HasSubstr(">0.10<"));
    EXPECT_THAT(svg(free), HasSubstr(">180<"));
}

/// Labels were cut at the edge of the picture, where 5000000000 was read as 500000000, and ran into each other and the titles.
TEST(SvgPlot, LabelsOfAxesOfAnySizeStandInsideThePictureAndApart) {
    const std::regex form(
        "<text x=\"([^\"]*)\" y=\"([^\"]*)\" font-size=\"10\" text-anchor=\"(end|middle)\"[^>]*serif\">([^<]*)<");
    const std::regex title("<text x=\"([^\"]*)\"[^>]*rotate[^>]*>([^<]*)<");
    constexpr double k_middle_of_letters = 4.0;
    for (const double size : {1e-15, 7e-7, 0.012, 5e3, 3.2e5, 5e9}) {
        for (const double offset : {0.0, size < 1e6 ? 1e3 : 10.0}) {
            for (const int columns : {1, 2}) {
                Plot plot = one_panel(-size, size);
                plot.panels[0].limits.clear();
                plot.panels[0].y_label = "Error / F";
                plot.x_label = "Reference / F";
                plot.x_is_angle = false;
                plot.margin = 8.0;
                plot.columns = columns;
                plot.panels[0].series[0].points = {{offset * size, -size, 0.0},
                                                   {(offset + 1.0) * size, 0.0, size},
                                                   {(offset + 2.0) * size, size, 0.0}};
                plot.panels.push_back(plot.panels[0]);
                const std::string drawing = svg(plot);
                std::vector<double> titles;
                for (std::sregex_iterator t(drawing.begin(), drawing.end(), title); t != std::sregex_iterator(); ++t) {
                    titles.push_back(std::stod((*t)[1]) + k_middle_of_letters);
                }
                ASSERT_EQ(titles.size(), 2U);
                double before = -1e9;
                std::string line;
                for (std::sregex_iterator l(drawing.begin(), drawing.end(), form); l != std::sregex_iterator(); ++l) {
                    const double x = std::stod((*l)[1]);
                    const double width = 0.9 * text_width((*l)[4], 10.0);  // the estimate is ample
                    const std::string where = (*l)[4].str() + " of " + std::to_string(size) + " " +
                                              std::to_string(offset) + " " + std::to_string(columns);
                    if ((*l)[3] == "end") {
                        const bool second = columns == 2 && x > 340.0;
                        EXPECT_GE(x - width, titles[second ? 1 : 0]) << where;
                        continue;
                    }
                    EXPECT_LE(x + 0.5 * width, 680.5) << where;
                    const bool continues = line == (*l)[2] && x > before;
                    EXPECT_TRUE(!continues || x - 0.5 * width > before) << where;
                    before = x + 0.5 * width;
                    line = (*l)[2];
                }
                EXPECT_NE(line, "");
            }
        }
    }
    Plot tiny = one_panel(1e-12, 3e-12);
    tiny.panels[0].limits.clear();
    tiny.panels[0].y_label = "Error / F";
    EXPECT_THAT(svg(tiny), HasSubstr(">Error / (10⁻¹² F)<"));
    EXPECT_THAT(svg(tiny), HasSubstr(">3.0<"));
    EXPECT_THAT(svg(tiny), HasSubstr(">x<")) << "an angle has no power";
    // A strip below has the power of its panel, and says so.
    tiny.strip_height = 28.0;
    tiny.panels[0].strip = {tiny.panels[0].series[0]};
    tiny.panels[0].strip_label = "U / F";
    EXPECT_THAT(svg(tiny), HasSubstr(">U / (10⁻¹² F)<"));
}

/// The power of an axis is what its maker says, not what its title looks like.
TEST(SvgPlot, AnAxisIsPutIntoAPowerOfTenOnce) {
    Plot plot = one_panel(-2e-9, 2e-9);  // beside a panel of ordinary numbers in the same power
    plot.panels[0].limits.clear();
    plot.panels[0].y_label = "D / 10⁶";
    plot.panels[0].y_in_power = true;
    EXPECT_THAT(svg(plot), HasSubstr(">D / 10⁶</text>"));
    plot.panels[0].y_in_power = false;
    EXPECT_THAT(svg(plot), HasSubstr(">D / (10⁻⁹ 10⁶)</text>"));

    Plot named = one_panel(-5e9, 5e9);
    named.panels[0].limits.clear();
    named.panels[0].y_label = "h / (10 mm)";
    EXPECT_THAT(svg(named), Not(HasSubstr(">5000000000</text>")));
    named.x_is_angle = false;
    named.x_label = "x / 10⁹";
    named.panels[0].series[0].points = {{1e-9, 0.0, 0.0}, {2e-9, 1.0, 0.0}};
    named.x_in_power = true;
    EXPECT_THAT(svg(named), HasSubstr(">x / 10⁹</text>"));
}

TEST(SvgPlot, DegenerateScalesStillHaveAPlot) {
    for (const double v : {0.0, 1e-30, 5.0, -1e9}) {
        Plot flat = one_panel(v, v);
        flat.panels[0].limits.clear();
        EXPECT_THAT(svg(flat), Not(HasSubstr("nan"))) << v;
    }
    Plot empty = one_panel(0.0, 1.0);
    empty.panels[0].series.clear();
    EXPECT_THAT(svg(empty), HasSubstr("</svg>"));
}

TEST(SvgPlot, ThinsCurvesAndKeepsTheirExtremes) {
    Plot plot = one_panel(0.0, 1.0);
    PlotSeries& curve = plot.panels[0].series[0];
    plot.panels[0].limits.clear();
    curve.bars = PlotBars::none;
    curve.marker = PlotMarker::none;
    curve.label.clear();  // no key: the curve is the first polyline
    curve.points.clear();
    for (int i = 0; i < 20000; ++i) {
        curve.points.push_back({.x = 0.018 * i, .y = i == 7777 ? 10.0 : i == 7778 ? -10.0 : 0.0, .U = 0.0});
    }
    const std::string text = svg(plot);
    const std::size_t at = text.find("<polyline points=\"") + 18;
    std::istringstream points(text.substr(at, text.find('"', at) - at));
    std::vector<double> heights;
    for (std::string point; points >> point;) {
        heights.push_back(std::stod(point.substr(point.find(',') + 1)));
    }
    EXPECT_LT(heights.size(), 1500U);
    EXPECT_GT(heights.size(), 300U);
    std::sort(heights.begin(), heights.end());
    EXPECT_NEAR(heights.back() - heights.front(), plot.panel_height, 0.1) << "both extremes are drawn";
    EXPECT_GT(heights[1] - heights[0], 0.4 * plot.panel_height);
}

DensityPlot density() {
    return {.id = "d",
            .title = "t",
            .description = "<d>",
            .x_label = "x",
            .y_label = "y",
            .low = -3.0,
            .high = 3.0,
            .first_edge = -1.0,
            .cell_width = 1.0,
            .cells = {0.5, 0.5},
            .cells_label = "trials",
            .curve = {{-3.0, 0.01, 0.0}, {0.0, 0.4, 0.0}, {3.0, 0.01, 0.0}},
            .curve_label = "curve",
            .intervals = {{"a & b", -2.0, 2.0}, {"c", -1.9, 4.1}}};
}

TEST(SvgPlot, BarsRunFromZeroToTheirShare) {
    BarPlot plot{.id = "b",
                 .title = "t",
                 .description = "d",
                 .x_label = "share / %",
                 .bars = {{"<x>", 130.0, "130.0"}, {"correlation", -30.0, "-30.0"}}};
    const std::string text = svg(plot);
    EXPECT_THAT(text, HasSubstr(">&lt;x&gt;</text>"));
    EXPECT_THAT(text, HasSubstr(">130.0</text>"));
    EXPECT_THAT(text, HasSubstr(">\u221220</text>"));
    EXPECT_EQ(text, svg(plot));
    plot.bars.clear();
    EXPECT_THAT(svg(plot), HasSubstr("</svg>"));
    plot.bars = {{"x", std::numeric_limits<double>::quiet_NaN(), ""}};
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
}

TEST(SvgPlot, StackedBarsFillOneHundredPercent) {
    StackedPlot plot{.id = "s",
                     .title = "t",
                     .description = "d",
                     .x_label = "share / %",
                     .text_head = "rms u",
                     .parts = {"<a>", "b", "c"},
                     .bars = {{"EXA", {25.0, 75.0, 0.0}, {"25.0", "75.0", "0.0"}, "0.21 µm"},
                              {"EYA", {130.0, 20.0, -50.0}, {"130.0", "20.0", "-50.0"}, "0.3 µm"}}};
    const std::string text = svg(plot);
    EXPECT_EQ(text, svg(plot));
    for (const char* part : {">&lt;a&gt;</text>", ">25.0</text>", ">75.0</text>", ">130.0</text>", ">0.21 µm</text>",
                             ">rms u</text>", ">100</text>"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    EXPECT_THAT(text, Not(HasSubstr("-50.0")));  // a negative share has no place in a bar
    EXPECT_THAT(text, Not(HasSubstr("width=\"-")));
    plot.bars[0].shares[1] = std::numeric_limits<double>::infinity();
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
    plot.bars.clear();
    EXPECT_THAT(svg(plot), HasSubstr("</svg>"));
}

TEST(SvgPlot, HistogramHasABarForEveryCellWithCounts) {
    HistogramPlot plot{.id = "h",
                       .title = "t",
                       .description = "d",
                       .x_label = "r",
                       .y_label = "n",
                       .first_edge = 0.0,
                       .cell_width = 0.25,
                       .counts = {0.0, 4.0, 40.0, 2.0}};
    const std::string text = svg(plot);
    std::size_t bars = 0;
    for (std::size_t at = text.find("#b5b5b5"); at != std::string::npos; at = text.find("#b5b5b5", at + 1)) {
        ++bars;
    }
    EXPECT_EQ(bars, 3U);
    EXPECT_THAT(text, HasSubstr(">40</text>"));
    EXPECT_THAT(text, HasSubstr(">1.0</text>"));
    plot.counts.assign(4, 0.0);
    EXPECT_THAT(svg(plot), Not(HasSubstr("nan")));
    plot.counts[0] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(static_cast<void>(svg(plot)), gum::NoResultError);
}

TEST(SvgPlot, ManyPointsAreOnePath) {
    Plot plot = one_panel(-2.0, 3.0);
    plot.panels[0].series[0].marker = PlotMarker::disc;
    plot.panels[0].series[0].bars = PlotBars::none;
    plot.panels[0].series[0].joined = false;
    for (int i = 0; i < 100000; ++i) {
        plot.panels[0].series[0].points.push_back({.x = i % 360 * 0.5, .y = (i % 77) * 0.03, .U = 0.0});
    }
    const std::string text = svg(plot);
    EXPECT_THAT(text, HasSubstr("<path d=\"M"));
    EXPECT_LT(text.size(), 700'000U);
    EXPECT_EQ(text, svg(plot));
}

TEST(SvgPlot, WhatIsBeyondAFixedScaleStandsAtItsEdge) {
    Plot plot = one_panel(-2.0, 300.0);
    plot.panels[0].limits.clear();
    plot.panels[0].y_most = 4.0;
    const std::string text = svg(plot);
    EXPECT_THAT(text, HasSubstr(">4</text>"));
    EXPECT_THAT(text, Not(HasSubstr(">300</text>")));
    EXPECT_THAT(text, Not(HasSubstr("y=\"-")));
}

TEST(SvgPlot, DensityShowsCellsCurveAndIntervals) {
    const std::string text = svg(density());
    for (const char* part : {">a &amp; b</text>", ">c</text>", ">trials</text>", ">curve</text>", "<polygon",
                             "<polyline", "stroke-dasharray", "&lt;d&gt;"}) {
        EXPECT_THAT(text, HasSubstr(part));
    }
    EXPECT_THAT(text, HasSubstr(">5</text>"));  // the axis holds the interval that is wider than the cells
    DensityPlot empty = density();
    empty.cells.clear();
    empty.curve.clear();
    EXPECT_THAT(svg(empty), Not(HasSubstr("nan")));
    DensityPlot bad = density();
    bad.intervals[0].high = std::numeric_limits<double>::infinity();
    EXPECT_THROW(static_cast<void>(svg(bad)), gum::NoResultError);
}

TEST(SvgPlot, AnAxisThatIsNoAngleHasDecimalTicks) {
    Plot plot = one_panel(-2.0, 3.0);
    EXPECT_THAT(svg(plot), HasSubstr(">90</text>"));
    plot.x_is_angle = false;
    EXPECT_THAT(svg(plot), Not(HasSubstr(">90</text>")));
    EXPECT_THAT(svg(plot), HasSubstr(">150</text>"));
}

// 10 dB within 9.8 dB to 10.2 dB was drawn from 0 dB to 12 dB, and neither U nor what was left to the limits could be seen.
TEST(SvgPlot, AnAxisOfValuesLeavesTheZeroLineOutWhereItIsFar) {
    const auto ticks_of = [](std::vector<double> y, bool values) {
        Plot plot{
            .id = "v", .title = "t", .description = "d", .x_label = "x", .panels = {PlotPanel{}}, .x_is_angle = false};
        PlotPanel& panel = plot.panels.front();
        panel.values = values;
        panel.limits = {{.y = y.front() < 1e6 ? 0.98 * y.front() : y.front(), .label = "l", .dotted = false}};
        panel.series = {
            {.label = "", .points = {}, .marker = PlotMarker::disc, .bars = PlotBars::bars, .joined = false}};
        for (std::size_t i = 0; i < y.size(); ++i) {
            panel.series.front().points.push_back({.x = static_cast<double>(i), .y = y[i], .U = 0.03});
        }
        return svg(plot);
    };
    for (const double sign : {1.0, -1.0}) {
        const std::string far = ticks_of({sign * 10.02, sign * 10.06, sign * 10.13}, true);
        EXPECT_NE(far.find(sign > 0.0 ? ">9.8<" : ">−9.8<"), std::string::npos) << far;
        EXPECT_NE(far.find(sign > 0.0 ? ">10.1<" : ">−10.1<"), std::string::npos) << far;
        EXPECT_EQ(far.find(sign > 0.0 ? ">5<" : ">−5<"), std::string::npos) << far;
    }
    EXPECT_EQ(ticks_of({10.02, 10.06, 10.13}, false).find(">9.8<"), std::string::npos)
        << "differences have their zero line";
    EXPECT_EQ(ticks_of({10.0, 50.0, 100.0}, true), ticks_of({10.0, 50.0, 100.0}, false)) << "zero is near enough";
    EXPECT_EQ(ticks_of({1e7, 1e7 + 1.0}, true), ticks_of({1e7, 1e7 + 1.0}, false)) << "labels of eight digits";
}

TEST(SvgPlot, AMarginKeepsPointsOffTheFrame) {
    Plot plot = one_panel(0.0, 3.0);  // from 0 to 180, and 3 is a tick
    plot.panels[0].series[0].marker = PlotMarker::disc;
    EXPECT_THAT(svg(plot), HasSubstr("<circle cx=\"50\""));
    EXPECT_THAT(svg(plot), HasSubstr("<circle cx=\"670\" cy=\"42\""));
    plot.margin = 8.0;
    const std::string text = svg(plot);
    EXPECT_THAT(text, HasSubstr("<circle cx=\"58\""));
    EXPECT_THAT(text, HasSubstr("<circle cx=\"662\""));
    EXPECT_THAT(text, Not(HasSubstr("cy=\"42\"")));
}

TEST(SvgPlot, NumbersOfPointsHaveWholeTicks) {
    Plot plot = one_panel(-2.0, 3.0);
    plot.x_is_number = true;
    auto& points = plot.panels[0].series[0].points;
    points = {{1.0, 0.0, 0.0}};
    EXPECT_THAT(svg(plot), HasSubstr(">1</text>"));
    EXPECT_THAT(svg(plot), HasSubstr(">2</text>"));
    points.push_back({3.0, 0.5, 0.0});
    EXPECT_THAT(svg(plot), HasSubstr(">3</text>"));
    EXPECT_THAT(svg(plot), Not(HasSubstr(">1.5</text>")));
    points.push_back({400.0, 0.5, 0.0});
    EXPECT_THAT(svg(plot), HasSubstr(">400</text>"));
    // The axis ends behind the last point, which stands at its right end (670).
    points = {{1.0, 0.0, 0.0}, {216.0, 0.5, 0.0}};
    plot.panels[0].series[0].marker = PlotMarker::disc;
    EXPECT_THAT(svg(plot), HasSubstr(">200</text>"));
    EXPECT_THAT(svg(plot), Not(HasSubstr(">250</text>")));
    EXPECT_THAT(svg(plot), HasSubstr("<circle cx=\"667"));
}

TEST(SvgPlot, AKeyThatIsTooLongHasSeveralLines) {
    Plot plot = one_panel(-2.0, 3.0);
    plot.panels[0].series[0].label = "one";
    const std::string one = svg(plot);
    EXPECT_THAT(one, HasSubstr("x=\"64\" y=\"13.5\""));
    for (const char* name : {"工作間的三坐標測量機與溫度補償以及空氣折射率補償系統",
                             "帶有折射率計的激光干涉儀與階梯規和環境站的組合系統"}) {
        PlotSeries series = plot.panels[0].series[0];
        series.label = name;
        plot.panels[0].series.push_back(series);
    }
    const std::string three = svg(plot);
    EXPECT_THAT(three, HasSubstr("x=\"64\" y=\"13.5\""));
    EXPECT_THAT(three, HasSubstr("x=\"64\" y=\"29.5\""));
    EXPECT_THAT(three, Not(HasSubstr("y=\"45.5\"")));
}

TEST(SvgPlot, RefusesNumbersThatAreNotFinite) {
    for (const double v : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
        EXPECT_THROW(static_cast<void>(svg(one_panel(0.0, v))), gum::NoResultError);
    }
}

}  // namespace
}  // namespace gumcert::reports
