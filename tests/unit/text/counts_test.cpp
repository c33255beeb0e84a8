#include "text/counts.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace gumcert::text {
namespace {

TEST(Counts, TakeAnyWholeNumber) {
    EXPECT_EQ(count_of(std::vector<int>{7}.size(), "row"), "1 row");
    EXPECT_EQ(count_of(3U, "quantity"), "3 quantities");
    EXPECT_EQ(count_of(0, "more problem"), "0 more problems");
}

}  // namespace
}  // namespace gumcert::text
