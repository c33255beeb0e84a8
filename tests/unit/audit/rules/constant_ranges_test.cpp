#include "audit/rules/constant_ranges.h"

#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/unit.h"

namespace gumcert::audit {
namespace {

const ConstantRange* range_of(const std::string& quantity, const std::string& comment = "") {
    AuditedRow row;
    row.quantity = quantity;
    row.comment = comment;
    return constant_range(row);
}

struct Plausible {
    const char* words;
    double value;  ///< a handbook's, coherent SI
};

TEST(ConstantRanges, HoldTheValuesOfHandbooks) {
    for (const Plausible& one :
         {Plausible{"thermal expansion of steel", 11.5e-6}, Plausible{"CTE of stainless steel", 17.3e-6},
          Plausible{"Ausdehnungskoeffizient Aluminium", 23.1e-6}, Plausible{"expansion of granite", 6e-6},
          Plausible{"expansion of invar", 1.2e-6}, Plausible{"density of air", 1.2}, Plausible{"Dichte Wasser", 998.2},
          Plausible{"density of steel", 7850.0}, Plausible{"refractivity n-1", 2.7e-4},
          Plausible{"specific heat capacity of water", 4184.0}, Plausible{"local gravity", 9.8067}}) {
        const ConstantRange* range = range_of(one.words);
        ASSERT_NE(range, nullptr) << one.words;
        EXPECT_LT(range->low, one.value) << one.words;
        EXPECT_GT(range->high, one.value) << one.words;
        EXPECT_NO_THROW(static_cast<void>(gum::Unit::parse(range->unit))) << range->unit;
        // A slip of a power of ten is outside.
        EXPECT_TRUE(10.0 * one.value > range->high) << one.words;
        EXPECT_TRUE(0.1 * one.value < range->low) << one.words;
    }
}

TEST(ConstantRanges, AreNothingForOtherWords) {
    EXPECT_EQ(range_of("drift"), nullptr);
    EXPECT_EQ(range_of("density"), nullptr);
    EXPECT_NE(range_of("density", "of air"), nullptr);
}

}  // namespace
}  // namespace gumcert::audit
