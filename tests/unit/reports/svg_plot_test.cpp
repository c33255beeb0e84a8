#include "reports/svg_plot.h"

#include "gum/quantity/diagnostic.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

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

TEST(SvgPlot, RefusesNumbersThatAreNotFinite) {
    for (const double v : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
        EXPECT_THROW(static_cast<void>(svg(one_panel(0.0, v))), gum::NoResultError);
    }
}

}  // namespace
}  // namespace gumcert::reports
