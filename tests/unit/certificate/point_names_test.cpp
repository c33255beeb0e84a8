#include "certificate/point_names.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace gumcert::certificate {
namespace {

/// A table of points: a column for each role, with cells in their order.
CertifiedTable table_of(const std::string& group, std::size_t first,
                        const std::vector<std::pair<std::string, std::vector<std::string>>>& columns) {
    CertifiedTable table;
    table.argument.emplace().name = "point";
    TableLayout& layout = table.layout.emplace();
    layout.group = group;
    for (const auto& [role, cells] : columns) {
        PointColumn column;
        column.name = column.role = role;
        column.printed = cells;
        column.values.assign(cells.size(), 1.0);
        column.printed_unit = "V";
        layout.columns.push_back(column);
    }
    for (std::size_t i = 0; i < columns.front().second.size(); ++i) {
        table.argument->printed.push_back(std::to_string(first + i));
    }
    CertifiedColumn result;
    result.result = "E";
    table.columns.push_back(result);
    return table;
}

TEST(PointNames, AreAsShortAsTheyTellPointsApart) {
    const std::vector<CertifiedTable> tables = {
        table_of("10 V", 1,
                 {{"indication", {"7", "8", "9"}}, {"reference", {"1", "2", "1"}}, {"setting", {"5", "5", "6"}}}),
        table_of("100 V", 4, {{"reference", {"1"}}})};
    const auto points = identities_of_points(tables);
    EXPECT_EQ(points.at("1").name, "10 V, 5\u00A0V, 1\u00A0V");
    EXPECT_EQ(points.at("2").name, "10 V, 5\u00A0V, 2\u00A0V");
    EXPECT_EQ(points.at("3").name, "10 V, 6\u00A0V");
    EXPECT_EQ(points.at("4").name, "100 V, 1\u00A0V");
}

TEST(PointNames, EndWithTheNumberWhereNothingElseDiffers) {
    const auto points = identities_of_points(
        {table_of("", 1, {{"setting", {"5", "5"}}}), table_of("", 3, {{"indication", {"7", "8"}}})});
    EXPECT_EQ(points.at("1").name, "5\u00A0V, 1");
    EXPECT_EQ(points.at("2").name, "5\u00A0V, 2");
    EXPECT_EQ(points.at("3").name, "3") << "what was found says not which point it is";
}

// A value is called by a result and its point: "E[5 V]" of two tables is two values, whatever else one of them has.
TEST(PointNames, TellPointsApartThatHaveOneResultInCommon) {
    std::vector<CertifiedTable> tables = {table_of("", 1, {{"setting", {"5"}}}), table_of("", 2, {{"setting", {"5"}}})};
    CertifiedColumn other;
    other.result = "F";
    tables[1].columns.push_back(other);
    EXPECT_EQ(identities_of_points(tables).at("1").name, "5\u00A0V, 1");
    EXPECT_EQ(identities_of_points(tables).at("2").name, "5\u00A0V, 2");
    tables[1].columns = {other};
    EXPECT_EQ(identities_of_points(tables).at("1").name, "5\u00A0V") << "no result is in both";
    EXPECT_EQ(identities_of_points(tables).at("2").name, "5\u00A0V");
}

// Sentences call a row by what it shows, whatever its point is called and whoever measured that.
TEST(PointNames, OfRowsAreAllThatTheyShow) {
    CertifiedTable table = table_of("", 1, {{"indication", {"7", "8", "8"}}});
    table.argument->printed[0] = "low";
    EXPECT_TRUE(hides_points(table));
    const auto rows = identities_of_rows({table});
    EXPECT_EQ(rows.at("low").name, "7\u00A0V");
    EXPECT_EQ(rows.at("2").name, "8\u00A0V, 2");
    EXPECT_EQ(rows.at("3").name, "8\u00A0V, 3");
    EXPECT_EQ(identities_of_rows({table_of("", 1, {{"indication", {"7", "8"}}, {"setting", {"5", "5"}}})}).at("1").name,
              "5\u00A0V, 7\u00A0V")
        << "what was found comes last";
    table.layout->shown.push_back({.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    EXPECT_FALSE(hides_points(table));
    EXPECT_TRUE(identities_of_rows({table}).empty());
}

TEST(PointNames, AreThoseOfTablesThatShowNoNumbersOfPoints) {
    CertifiedTable table = table_of("", 1, {{"setting", {"5", "[6]"}}});
    EXPECT_TRUE(has_unnamed_points(table));
    EXPECT_EQ(identities_of_points({table}).at("2").name, "(6)\u00A0V");
    CertifiedTable other = table;
    other.layout->shown.push_back({.show = "point", .of = "", .heading = {}, .role = "", .stage = ""});
    EXPECT_FALSE(has_unnamed_points(other));
    EXPECT_TRUE(identities_of_points({other}).empty());
    other = table;
    other.argument->printed[0] = "10 V";
    EXPECT_FALSE(has_unnamed_points(other)) << "somebody named it";
    other = table;
    other.layout.reset();
    EXPECT_FALSE(has_unnamed_points(other));
    other = table;
    other.argument->name = "angle";
    EXPECT_FALSE(has_unnamed_points(other));
    other.argument.reset();
    EXPECT_FALSE(has_unnamed_points(other));
}

}  // namespace
}  // namespace gumcert::certificate
