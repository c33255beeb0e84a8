#include "engine/degrees_text.h"

#include <gtest/gtest.h>

namespace gumcert::engine {
namespace {

TEST(DegreesText, HasTheFewestDigits) {
    EXPECT_EQ(degrees_text(22.5), "22.5°");
    EXPECT_EQ(degrees_text(-0.0), "0°");
}

}  // namespace
}  // namespace gumcert::engine
