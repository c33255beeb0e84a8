#include "engine/median.h"

#include <gtest/gtest.h>

namespace gumcert::engine {
namespace {

TEST(Median, IsTheMiddleOne) {
    std::vector<double> odd{5.0, -1.0, 3.0};
    EXPECT_EQ(median(odd), 3.0);
    EXPECT_EQ(upper_median(odd), 3.0);
    std::vector<double> one{2.5};
    EXPECT_EQ(median(one), 2.5);
}

TEST(Median, OfAnEvenNumberIsTheMeanOfTwoOrTheUpperOne) {
    std::vector<double> even{4.0, 1.0, 2.0, 10.0};
    EXPECT_EQ(median(even), 3.0);
    EXPECT_EQ(upper_median(even), 4.0);
}

}  // namespace
}  // namespace gumcert::engine
