#include "certificate/result_names.h"

#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

TEST(ResultNames, NameAResultOrAllThatBeginSo) {
    EXPECT_TRUE(is_named({"EXA", "l"}, "l"));
    EXPECT_TRUE(is_named({"E*"}, "EXA"));
    EXPECT_FALSE(is_named({"EX"}, "EXA"));
    EXPECT_FALSE(is_named({}, "l"));
}

TEST(ResultNames, ScopeOfALocationErrorCoversTheAxisInTheFixture) {
    EXPECT_TRUE(is_covered({"EY0A"}, "axis_y"));
    EXPECT_TRUE(is_covered({"EA0C"}, "axis_a"));
    EXPECT_TRUE(is_covered({"axis_*"}, "axis_y"));
    EXPECT_TRUE(is_covered({"EY0A"}, "EY0A"));
    EXPECT_FALSE(is_covered({"EY0A"}, "axis_z"));
    EXPECT_FALSE(is_covered({"EYA"}, "axis_y"));
    EXPECT_FALSE(is_covered({"EY0A"}, "axis_yy"));
    EXPECT_FALSE(is_named({"EY0A"}, "axis_y")) << "a limit of the machine does not judge the fixture";
}

}  // namespace
}  // namespace gumcert::certificate
