#include "text/degrees_of_freedom.h"

#include <gtest/gtest.h>

namespace gumcert::text {
namespace {

TEST(DegreesOfFreedom, HaveASingularForOneAlone) {
    EXPECT_EQ(degrees_of_freedom("1"), "1 degree of freedom");
    EXPECT_EQ(degrees_of_freedom("11"), "11 degrees of freedom");
    EXPECT_EQ(degrees_of_freedom("1.5"), "1.5 degrees of freedom");
    EXPECT_EQ(degrees_of_freedom("0"), "0 degrees of freedom");
}

}  // namespace
}  // namespace gumcert::text
