#include "reports/dcc/printed_number.h"

#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

TEST(PrintedNumber, StandsForHalfAUnitOfItsLastDigit) {
    const struct {
        const char* text;
        double value, half_unit;
    } cases[] = {{"10.05", 10.05, 0.005}, {"10.050", 10.05, 0.0005}, {"100", 100.0, 0.5},  {"-0.2", -0.2, 0.05},
                 {"+3.1", 3.1, 0.05},     {"1.60E-3", 1.6e-3, 5e-6}, {"1e+3", 1e3, 500.0}, {"0", 0.0, 0.5}};
    for (const auto& one : cases) {
        const std::optional<PrintedNumber> number = printed_number(one.text);
        ASSERT_TRUE(number) << one.text;
        EXPECT_DOUBLE_EQ(number->value, one.value) << one.text;
        EXPECT_DOUBLE_EQ(number->half_unit, one.half_unit) << one.text;
    }
}

TEST(PrintedNumber, IsNoOtherText) {
    for (const char* const text :
         {"", "+", "ten", "1.2.3", "1,5", " 1", "1 ", "nan", "inf", "1e999", "5 mm", "+-5", "++5", "-+5"}) {
        EXPECT_FALSE(printed_number(text)) << text;
    }
}

}  // namespace
}  // namespace gumcert::reports
