#include "gum/type_b.h"

#include <gtest/gtest.h>

#include <limits>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::prints_as;

TEST(TypeB, HalfWidths) {
    // JCGM 100:2008, 4.3.8 (copper, 16.40e-6 to 16.92e-6) and 4.4.5 (96 °C to 104 °C).
    EXPECT_TRUE(prints_as(u_from_half_width(0.26e-6), "0.15e-6"));
    EXPECT_TRUE(prints_as(u_from_half_width(4.0), "2.3"));
    EXPECT_EQ(u_from_half_width(0.0), 0.0);
    EXPECT_EQ(code_of<InputError>([] { (void)u_from_half_width(-0.8e-6); }), "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([] { (void)u_from_half_width(std::numeric_limits<double>::infinity()); }),
              "GC-GUM-0001");
}

TEST(TypeB, Resolution) {
    // JCGM 100:2008, F.2.2.1: u = 0.29 of the step.
    EXPECT_TRUE(prints_as(u_from_resolution(1.0), "0.29"));
    EXPECT_DOUBLE_EQ(u_from_resolution(1.0), u_from_half_width(0.5));
    EXPECT_EQ(u_from_resolution(0.0), 0.0);
    EXPECT_EQ(code_of<InputError>([] { (void)u_from_resolution(-0.1e-6); }), "GC-GUM-0002");
}

}  // namespace
}  // namespace gumcert::gum
