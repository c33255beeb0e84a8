#include "reports/point_headings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "reports/forms/asset_files.h"
#include "tests/unit/reports/document_text.h"

namespace gumcert::reports {
namespace {

using certificate::CertifiedTable;
using certificate::ShownColumn;

const Wording& english() {
    static const nlohmann::json texts = nlohmann::json::parse(read_asset(assets().templates / "wording" / "en.json"));
    static const Wording words(texts);
    return words;
}

ShownColumn shown(const std::string& show, const std::string& of, const std::string& role,
                  const std::string& stage = "") {
    return {.show = show, .of = of, .heading = {}, .role = role, .stage = stage};
}

certificate::PointColumn column_of_points(const std::string& name, const std::string& role) {
    certificate::PointColumn column;
    column.name = name;
    column.role = role;
    return column;
}

/// Two indications and two errors, one of which has its name alone.
CertifiedTable two_of_each() {
    CertifiedTable table;
    table.layout.emplace();
    table.layout->columns = {column_of_points("p_n", "nominal"), column_of_points("p_up", "indication"),
                             column_of_points("p_dn", "indication")};
    table.columns.resize(2);
    table.columns[0].result = "e_up";
    table.columns[0].name = "error, rising";
    table.columns[1].result = "e_dn";
    table.columns[1].name = "e_dn";
    table.layout->shown = {shown("column", "p_n", "nominal"),
                           shown("column", "p_up", "indication"),
                           shown("value", "e_up", "error"),
                           shown("U", "e_up", ""),
                           shown("column", "p_dn", "indication"),
                           shown("value", "e_dn", "error"),
                           shown("U", "e_dn", "")};
    return table;
}

std::string heading(const CertifiedTable& table, std::size_t at) {
    return heading_of_shown(table, table.layout->shown[at], english()).first();
}

TEST(PointHeadings, NameColumnsByHeadingRoleOrName) {
    certificate::PointColumn column;
    column.name = "serial";
    EXPECT_EQ(heading_of(column, english()).first(), "serial");
    column.name = "range";
    EXPECT_EQ(heading_of(column, english()).first(), "Range");
    column.role = "reference";
    EXPECT_EQ(heading_of(column, english()).first(), "Reference value");
    column.heading = "Applied";
    EXPECT_EQ(heading_of(column, english()).first(), "Applied");
}

TEST(PointHeadings, TellResultsOfOneRoleApart) {
    const CertifiedTable table = two_of_each();
    EXPECT_EQ(heading(table, 0), "Nominal value");
    EXPECT_EQ(heading(table, 1), "Indication p_up");
    EXPECT_EQ(heading(table, 2), "error, rising");
    EXPECT_EQ(heading(table, 4), "Indication p_dn");
    EXPECT_EQ(heading(table, 5), "Error e_dn");
}

/// A hysteresis has the role of a deviation, so that it is held against the place where it was measured.
TEST(PointHeadings, ADeviationIsCalledByItsDescription) {
    CertifiedTable table = two_of_each();
    table.columns[0].name = "hysteresis";
    table.layout->shown[2].role = "deviation";
    EXPECT_EQ(heading(table, 2), "hysteresis");
    table.columns[0].name = "Deviation of the set torque from the torque measured";
    EXPECT_EQ(heading(table, 2), "Deviation") << "it says no more";
    table.columns[0].name = "e_up";
    EXPECT_EQ(heading(table, 2), "Deviation");
}

TEST(PointHeadings, StagesTellThemApartAlready) {
    CertifiedTable table = two_of_each();
    table.layout->shown[1].stage = table.layout->shown[2].stage = "as_found";
    table.layout->shown[4].stage = table.layout->shown[5].stage = "as_left";
    for (const std::size_t value : {2U, 5U}) {
        EXPECT_EQ(heading(table, value), "Error");
    }
    EXPECT_EQ(heading(table, 1), "Indication");
}

TEST(PointHeadings, AHeadingOfTheJobStaysAsItIs) {
    CertifiedTable table = two_of_each();
    table.layout->shown[2].heading = "Up";
    EXPECT_EQ(heading(table, 2), "Up");
    EXPECT_EQ(heading(table, 5), "Error") << "it is the only one that is called so";
}

/// Whatever roles, stages and descriptions: no two columns of a stage have one heading.
TEST(PointHeadings, NoTwoQuantitiesOfAStageHaveOneHeading) {
    for (unsigned choice = 0; choice < 256U; ++choice) {
        CertifiedTable table = two_of_each();
        const auto is = [&](unsigned bit) { return (choice & bit) != 0; };
        table.columns[0].name = is(1) ? "error" : "e_up";
        table.columns[1].name = is(2) ? "error" : "Error e_up";
        table.layout->shown[2].stage = is(4) ? "as_found" : "";
        table.layout->shown[5].stage = is(8) ? "as_found" : "";
        table.layout->shown[5].role = is(16) ? "indication" : "error";
        table.layout->shown[2].role = is(32) ? "indication" : "error";
        table.layout->shown[4].role = table.layout->columns[2].role = is(64) ? "nominal" : "indication";
        table.layout->shown[1].role = table.layout->columns[1].role = is(128) ? "" : "indication";
        std::set<std::string> seen;
        for (const std::size_t at : {0U, 1U, 2U, 4U, 5U}) {
            EXPECT_TRUE(seen.insert(table.layout->shown[at].stage + "/" + heading(table, at)).second)
                << choice << ": " << heading(table, at);
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
