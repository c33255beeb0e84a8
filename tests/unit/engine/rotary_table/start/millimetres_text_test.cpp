#include "engine/rotary_table/start/millimetres_text.h"

#include <gtest/gtest.h>

namespace gumcert::engine {
namespace {

TEST(MillimetresText, IsRoundedAndAZeroHasNoSign) {
    EXPECT_EQ(millimetres(0.012345, 1), "12.3");
    EXPECT_EQ(millimetres(-0.01236, 1), "-12.4");
    EXPECT_EQ(millimetres(1.2345, 0), "1235");
    EXPECT_EQ(millimetres(0.35e-3, 1), "0.4");
    EXPECT_EQ(millimetres(-1e-6, 1), "0.0");
    EXPECT_EQ(millimetres(-1e-4, 0), "0");
}

TEST(MillimetresText, OfAPositionNamesItsUnit) {
    EXPECT_EQ(in_millimetres({1.1834, -0.0001, -1.0556}), "(1183, 0, -1056) mm");
}

}  // namespace
}  // namespace gumcert::engine
