#include "reports/record/make/budget/budget_texts.h"
#include "text/numbers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gumcert::reports {
namespace {

TEST(BudgetTexts, StatedNumbersComeBackWithoutTracesOfConversion) {
    for (const double value : {5.007, 0.3, 123456.789, 1e-7, 20.1, -0.05}) {
        EXPECT_EQ(as_stated(value / 1000.0 * 1000.0), text::shortest(value));
        EXPECT_EQ(as_stated(-value * 1e-6 / 1e-6), text::shortest(-value));
    }
    EXPECT_EQ(as_stated(0.1 * 3.0), "0.3");
    EXPECT_EQ(as_stated(1.0 / 3.0), "0.3333333333333333");
    EXPECT_EQ(text::shortest(-0.0), "0");
}

TEST(BudgetTexts, EstimatesEndWithTheirUncertainty) {
    EXPECT_EQ(printed_estimate(10.12345, 0.0123), "10.123");
    EXPECT_EQ(printed_estimate(10.12345, 0.0), "10.12345");
    EXPECT_EQ(shown_degrees_of_freedom(INFINITY).text, "∞");
    EXPECT_EQ(shown_degrees_of_freedom(NAN).text, "–");
    EXPECT_FALSE(shown_degrees_of_freedom(NAN).number);
    EXPECT_EQ(shown_degrees_of_freedom(7.1234).number, 7.1234);
    EXPECT_EQ(shown_degrees_of_freedom(7.1234).text, "7.1");
    EXPECT_EQ(shown_degrees_of_freedom(148.6).text, "148") << "as in the line of the result: never more than there are";
    EXPECT_EQ(rounded(0.012345, 2), "0.012");
}

}  // namespace
}  // namespace gumcert::reports
