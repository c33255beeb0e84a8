#include "reports/record/make/record_parts.h"

#include <gtest/gtest.h>

#include <limits>

namespace gumcert::reports {
namespace {

TEST(RecordParts, ShowANumberUnroundedWithItsRoundedText) {
    const Shown<double> u = shown_significant(0.0123456, k_digits_of_u);
    EXPECT_EQ(u.number, 0.0123456);
    EXPECT_EQ(u.text, "0.012");
    const Shown<double> statistic = shown_to_quantum(12.3456, 1);
    EXPECT_EQ(statistic.number, 12.3456);
    EXPECT_EQ(statistic.text, "12.3");
}

TEST(RecordParts, HaveNoDegreesOfFreedomWhereTheyAreInfiniteOrCannotBeStated) {
    EXPECT_EQ(finite_or_none(4.5), 4.5);
    EXPECT_FALSE(finite_or_none(std::numeric_limits<double>::infinity()));
    EXPECT_FALSE(finite_or_none(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace gumcert::reports
