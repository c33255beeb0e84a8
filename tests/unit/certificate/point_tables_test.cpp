#include "certificate/point_tables.h"

#include <gtest/gtest.h>

#include <optional>

#include "certificate/certified_results.h"

namespace gumcert::certificate {
namespace {

TEST(PointTables, IsThatOfUnitsWithParts) {
    EXPECT_EQ(last_part_of("arcsec"), text::AnglePart::seconds);
    EXPECT_EQ(last_part_of("″"), text::AnglePart::seconds);
    EXPECT_EQ(last_part_of("arcmin"), text::AnglePart::minutes);
    for (const char* unit : {"deg", "rad", "urad", "gon", "marcsec", "1", "s", "min", "m"}) {
        EXPECT_EQ(last_part_of(unit), std::nullopt) << unit;
    }
}

TEST(PointTables, PrintsOnlyWhatAsksForIt) {
    EXPECT_EQ(in_form("45005.0", "sexagesimal", "arcsec"), "12°\u00A030′\u00A005.0″");
    EXPECT_EQ(unit_in_form("″", "sexagesimal", "arcsec"), "");
    EXPECT_EQ(in_form("45005.0", "", "arcsec"), "45005.0");
    EXPECT_EQ(unit_in_form("″", "", "arcsec"), "″");
    // In the unit of its group a number has no such parts.
    EXPECT_EQ(in_form("12.501", "sexagesimal", "deg"), "12.501");
    EXPECT_EQ(unit_in_form("°", "sexagesimal", "deg"), "°");
    EXPECT_EQ(in_form("", "sexagesimal", "arcsec"), "");
    // Minutes and seconds of a number that is known to 10000″ would be digits that nobody knows.
    EXPECT_EQ(in_form("2.3E+5", "sexagesimal", "arcsec"), "2.3E+5\u00A0″");
}

TEST(PointTables, LeavesWordsOfAColumnAlone) {
    PointColumn column;
    column.unit = "arcsec";
    column.printed_unit = "″";
    column.form = "sexagesimal";
    column.values = {108'000.0, std::nullopt};
    column.printed = {"108000", ""};
    EXPECT_EQ(shown_cell(column, 0), "30°\u00A000′\u00A000″");
    EXPECT_EQ(shown_cell(column, 1), "");
    EXPECT_EQ(shown_unit(column), "");
}

TEST(PointTables, OfAResultIsThatOfItsTable) {
    CertifiedTable table;
    EXPECT_EQ(form_of_result(table, "phi"), "");
    EXPECT_EQ(column_of_values(table, "phi"), nullptr);
    table.layout = TableLayout();
    table.layout->shown.push_back(
        {.show = "value", .of = "phi", .heading = {}, .role = "", .stage = "", .form = "sexagesimal"});
    EXPECT_EQ(form_of_result(table, "phi"), "sexagesimal");
    EXPECT_EQ(form_of_result(table, "E"), "");
    EXPECT_EQ(column_of_values(table, "phi"), table.layout->shown.data());
    EXPECT_EQ(column_of_values(table, "E"), nullptr);
}

TEST(PointTables, ShowsValuesAsTheTableSays) {
    CertifiedColumn phi;
    phi.result = "phi";
    phi.unit = "arcsec";
    phi.printed_unit = "″";
    CertifiedTable table;
    EXPECT_EQ(value_as_shown(table, phi, "45005.0"), "45005.0");
    EXPECT_EQ(unit_of_values(table, phi), "″");
    table.layout = TableLayout();
    table.layout->shown.push_back(
        {.show = "value", .of = "phi", .heading = {}, .role = "", .stage = "", .form = "sexagesimal"});
    EXPECT_EQ(value_as_shown(table, phi, "45005.0"), "12°\u00A030′\u00A005.0″");
    EXPECT_EQ(unit_of_values(table, phi), "");
}

TEST(PointTables, KnowsRolesOfDifferences) {
    for (const char* role : {"error", "deviation", "correction"}) {
        EXPECT_TRUE(is_role_of_difference(role)) << role;
    }
    for (const char* role : {"", "measured_value", "indication", "nominal"}) {
        EXPECT_FALSE(is_role_of_difference(role)) << role;
    }
}

}  // namespace
}  // namespace gumcert::certificate
