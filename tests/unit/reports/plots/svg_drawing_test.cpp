#include "reports/plots/svg_drawing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

TEST(SvgDrawing, WritesNumbersShort) {
    EXPECT_EQ(drawing_number(12.5), "12.5");
    EXPECT_EQ(drawing_number(3.0), "3");
    EXPECT_EQ(drawing_number(-0.25), "-0.25");
    EXPECT_EQ(drawing_number(-0.001), "0") << "no minus before nothing";
    EXPECT_EQ(tick_text(-1.5, 1), "\u22121.5");
    EXPECT_EQ(tick_text(-0.01, 1), "0.0") << "no minus before nothing";
}

TEST(SvgDrawing, HasTicksAtRoundNumbersAroundTheRange) {
    const Ticks ticks = nice_ticks(0.3, 9.2, 5);
    EXPECT_DOUBLE_EQ(ticks.low, 0.0);
    EXPECT_DOUBLE_EQ(ticks.high, 10.0);
    EXPECT_DOUBLE_EQ(ticks.step, 2.0);
    EXPECT_EQ(ticks.count(), 6);
    EXPECT_DOUBLE_EQ(ticks.at(5), 10.0);
    const Ticks small = nice_ticks(-0.012, 0.031, 5);
    EXPECT_LE(small.low, -0.012);
    EXPECT_GE(small.high, 0.031);
    EXPECT_LE(small.count(), 6);
    EXPECT_EQ(small.decimals, 2);
    const Ticks point = nice_ticks(5.0, 5.0, 4);
    EXPECT_LT(point.low, 5.0);
    EXPECT_GT(point.high, 5.0) << "one value has room around it";
}

TEST(SvgDrawing, DividesACircle) {
    const Ticks turn = angle_ticks(0.0, 360.0);
    EXPECT_DOUBLE_EQ(turn.step, 45.0);
    EXPECT_EQ(turn.count(), 9);
    EXPECT_DOUBLE_EQ(angle_ticks(-30.0, 60.0).step, 15.0);
    EXPECT_DOUBLE_EQ(angle_ticks(0.0, 4.0, 4).step, 1.0) << "decimal steps";
}

TEST(SvgDrawing, PaintsElementsInTheirOrder) {
    Drawing drawing;
    drawing.line(0.0, 1.0, 2.5, 3.0, "stroke=\"#000000\"");
    drawing.points("polyline", {{0.0, 0.0}, {1.0, 2.0}}, "fill=\"none\"");
    drawing.text(5.0, 6.0, "a < b & c", "middle", 11.0);
    EXPECT_THAT(
        drawing.body,
        testing::StartsWith("<line x1=\"0\" y1=\"1\" x2=\"2.5\" y2=\"3\" stroke=\"#000000\"/>\n"
                            "<polyline points=\"0,0 1,2\" fill=\"none\"/>\n<text x=\"5\" y=\"6\" font-size=\"11\""));
    EXPECT_THAT(drawing.body, testing::HasSubstr(">a &lt; b &amp; c</text>\n"));
}

}  // namespace
}  // namespace gumcert::reports
