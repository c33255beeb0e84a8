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

TEST(RecordParts, ShowSizesInTheHundredsWithoutAPowerOfTen) {
    EXPECT_EQ(shown_plain(0.3472, 2).text, "0.35");
    EXPECT_EQ(shown_plain(12.34, 2).text, "12");
    EXPECT_EQ(shown_plain(99.49, 2).text, "99");
    EXPECT_EQ(shown_plain(99.6, 2).text, "100");
    EXPECT_EQ(shown_plain(-140.4, 2).text, "-140");
    EXPECT_EQ(shown_plain(1152.7, 2).text, "1153");
    EXPECT_EQ(shown_plain(1.234e-6, 2).text, "1.2E-6");
    EXPECT_EQ(shown_plain(0.0, 2).text, "0");
    EXPECT_EQ(shown_plain(140.4, 2).number, 140.4);
}

TEST(RecordParts, HaveNoDegreesOfFreedomWhereTheyAreInfiniteOrCannotBeStated) {
    EXPECT_EQ(finite_or_none(4.5), 4.5);
    EXPECT_FALSE(finite_or_none(std::numeric_limits<double>::infinity()));
    EXPECT_FALSE(finite_or_none(std::numeric_limits<double>::quiet_NaN()));
}

}  // namespace
}  // namespace gumcert::reports
