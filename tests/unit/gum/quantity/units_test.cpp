#include "gum/quantity/units.h"

#include <gtest/gtest.h>

#include "gum/quantity/unit.h"

namespace gumcert::gum {
namespace {

TEST(Units, AreThoseOfTheTableOfUnits) {
    EXPECT_EQ(k_micrometre, Unit::parse("um").to_si(1.0));
    EXPECT_EQ(k_millimetre, Unit::parse("mm").to_si(1.0));
    EXPECT_DOUBLE_EQ(k_degree, Unit::parse("deg").to_si(1.0));
    EXPECT_DOUBLE_EQ(k_arcsecond, Unit::parse("arcsec").to_si(1.0));
}

}  // namespace
}  // namespace gumcert::gum
