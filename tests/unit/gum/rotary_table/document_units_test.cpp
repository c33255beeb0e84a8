#include "gum/rotary_table/document_units.h"

#include <gtest/gtest.h>

#include <numbers>
#include <string>

namespace gumcert::gum {
namespace {

TEST(UnitsOfDocuments, AreThoseOfTheirNamesInARecord) {
    for (const DocumentUnit* const unit : {&k_um, &k_arcsec}) {
        EXPECT_EQ(&unit_of(std::string(unit->record)), unit) << unit->record;
    }
    EXPECT_STREQ(unit_of(std::string("um")).print, "µm");
    EXPECT_STREQ(unit_of(std::string("arcsec")).print, "″");
}

TEST(UnitsOfDocuments, OfAQuantityAndOfItsRecordAreOne) {
    const OutputQuantity length{.name = "EXA(0)", .unit = "m"};
    const OutputQuantity angle{.name = "EAA(0)", .unit = "rad"};
    EXPECT_EQ(&unit_of(length), &unit_of(std::string(unit_of(length).record)));
    EXPECT_EQ(&unit_of(angle), &unit_of(std::string(unit_of(angle).record)));
    EXPECT_NE(&unit_of(length), &unit_of(angle));
}

TEST(UnitsOfDocuments, FactorsToSi) {
    EXPECT_DOUBLE_EQ(180.0 * 3600.0 * k_arcsec.si, std::numbers::pi);
    EXPECT_DOUBLE_EQ(k_mm.si / k_um.si, 1000.0);
    EXPECT_DOUBLE_EQ(k_mm.si, 0.001);
    EXPECT_STREQ(k_mm.record, "mm");
    EXPECT_STREQ(k_mm.print, "mm");
}

}  // namespace
}  // namespace gumcert::gum
