#include "reports/plots/plot_frame.h"

#include <gtest/gtest.h>

#include <limits>

#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {
namespace {

TEST(PlotFrame, ScalesAnAxisWhoseLabelsWouldBeLong) {
    EXPECT_EQ(AxisScale::of(0.0).exponent, 0);
    EXPECT_EQ(AxisScale::of(999.0).exponent, 0);
    EXPECT_EQ(AxisScale::of(-2e-7).exponent, -9);
    EXPECT_EQ(AxisScale::of(5e7).exponent, 6);
    EXPECT_EQ(AxisScale::of(5e3, 1e3).exponent, 3);
    EXPECT_DOUBLE_EQ(AxisScale::of(5e7)(5e7), 50.0);
    EXPECT_NEAR(AxisScale{.exponent = 306}(1e307), 10.0, 1e-12) << "the power itself would be too large";
    EXPECT_EQ(AxisScale{}.label("D", "mm"), "D / mm");
    EXPECT_EQ(AxisScale{}.label("D", ""), "D");
    EXPECT_EQ(AxisScale{.exponent = -6}.label("D", "m"), "D / (10⁻⁶ m)");
    EXPECT_EQ(AxisScale{.exponent = 12}.label("D", ""), "D / 10¹²");
    EXPECT_EQ(AxisScale{}.label("D / mm"), "D / mm");
    EXPECT_EQ(AxisScale{.exponent = -6}.label("a / b / m"), "a / b / (10⁻⁶ m)");
    EXPECT_EQ(AxisScale{.exponent = -6}.label("D"), "D / 10⁻⁶");
}

TEST(PlotFrame, MakesRoomForLabels) {
    EXPECT_EQ(ticks_apart(0.0, 10.0, 10, 600.0).count(), 11);
    const Ticks close = ticks_apart(1234.5678901, 1234.5678909, 10, 300.0);
    EXPECT_LT(widest_label(close), 300.0 * close.step / (close.high - close.low));
    EXPECT_LT(close.count(), 9);
    EXPECT_DOUBLE_EQ(room_for_last_label({.low = 0.0, .high = 360.0, .step = 45.0}, 10.0), 10.0);
    EXPECT_GT(room_for_last_label({.low = 0.0, .high = 1e5, .step = 1e4}, 10.0), 14.0);
}

TEST(PlotFrame, HasMedianAndSpreadOfTheBulk) {
    EXPECT_DOUBLE_EQ(middle_of({}), 0.0);
    EXPECT_DOUBLE_EQ(middle_of({3.0, 1.0, 2.0}), 2.0);
    EXPECT_DOUBLE_EQ(middle_of({4.0, 1.0, 3.0, 2.0}), 2.5);
    EXPECT_DOUBLE_EQ(spread_of({1.0, 2.0, 3.0, 4.0, 1000.0}), 1.483);
    EXPECT_THROW((void)middle_of({1.0, std::numeric_limits<double>::quiet_NaN()}), gum::NoResultError);
}

TEST(PlotFrame, ShortensANameInItsMiddle) {
    EXPECT_EQ(shortened_name("Laboratory", 12), "Laboratory");
    const std::string name = shortened_name("Institute of Metrology, branch 17", 16);
    EXPECT_EQ(name, "Institu…ranch 17");
    EXPECT_EQ(shortened_name("größergrößergrößer", 12).substr(0, 3), "gr\xC3") << "whole characters";
}

TEST(PlotFrame, PutsValuesWhereTheyBelong) {
    const PlotFrame frame{.x = 10.0,
                          .y = 20.0,
                          .width = 100.0,
                          .height = 50.0,
                          .across = {.low = 0.0, .high = 10.0},
                          .up = {.low = -1.0, .high = 1.0}};
    EXPECT_DOUBLE_EQ(frame.px(0.0), 10.0);
    EXPECT_DOUBLE_EQ(frame.px(5.0), 60.0);
    EXPECT_DOUBLE_EQ(frame.py(1.0), 20.0) << "up is less";
    EXPECT_DOUBLE_EQ(frame.py(-1.0), frame.bottom());
    EXPECT_DOUBLE_EQ(frame.py_inside(7.0), 20.0);
    EXPECT_DOUBLE_EQ(frame.py_inside(-7.0), frame.bottom());
    AxisRange range{.low = 1.0, .high = 2.0};
    range.include(4.0);
    EXPECT_DOUBLE_EQ(range.widened(0.5).low, -0.5);
    EXPECT_DOUBLE_EQ(range.widened(0.5).high, 5.5);
    EXPECT_EQ(superscript(-12), "⁻¹²");
}

}  // namespace
}  // namespace gumcert::reports
