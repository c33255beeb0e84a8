#include "reports/record/certified_tables.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

#include "gum/quantity/unit.h"
#include "tests/support/sample_budget_record.h"

namespace gumcert::reports {
namespace {

using certificate::CertifiedTable;

TEST(CertifiedTables, HoldABudgetWithoutPointsAsColumnsOfOneValue) {
    const std::vector<CertifiedTable> tables = certified_tables(test::sample_two_results_record());
    ASSERT_EQ(tables.size(), 1U);
    EXPECT_EQ(tables[0].id, "results");
    EXPECT_FALSE(tables[0].argument);
    ASSERT_EQ(tables[0].columns.size(), 2U);
    EXPECT_EQ(tables[0].columns[0].result, "R");
    EXPECT_EQ(tables[0].columns[0].name.plain, "resistance");
    EXPECT_EQ(tables[0].columns[0].printed_unit, "Ω");
    const certificate::CertifiedValue& R = tables[0].columns[0].values.at(0);
    EXPECT_EQ(R.value, 127.732);
    EXPECT_EQ(R.printed_value, "127.73");
    EXPECT_EQ(R.printed_U, "0.20");
    EXPECT_EQ(R.printed_k, "2.87");
    const certificate::CertifiedValue& X = tables[0].columns[1].values.at(0);
    EXPECT_EQ(X.coverage, "none");
    EXPECT_EQ(X.printed_U, "");
    EXPECT_FALSE(X.U);
    EXPECT_EQ(X.u, 0.2956);
}

TEST(CertifiedTables, PutResultsOfTheSamePointsIntoOneTable) {
    EvaluationRecord record = test::sample_budget_record();
    const Result one = record.results[0];
    record.results.clear();
    for (const char* point : {"a", "b", "c"}) {
        for (const char* quantity : {"l", "d"}) {
            if (std::string(quantity) == "l" || std::string(point) != "b") {
                record.results.push_back(one);
                record.results.back().quantity = quantity;
                record.results.back().point = point;
            }
        }
    }
    const std::vector<CertifiedTable> tables = certified_tables(record);
    ASSERT_EQ(tables.size(), 2U);  // d has no point b
    EXPECT_EQ(tables[0].argument->printed, (std::vector<std::string>{"a", "b", "c"}));
    EXPECT_EQ(tables[0].columns.at(0).values.size(), 3U);
    EXPECT_EQ(tables[1].argument->printed, (std::vector<std::string>{"a", "c"}));
    EXPECT_EQ(tables[1].columns.at(0).result, "d");
}

TEST(CertifiedTables, HoldAGroupOfPointsEachInItsUnits) {
    EvaluationRecord record = test::sample_budget_record();
    Result one = record.results[0];
    one.quantity = "E";
    record.results.clear();
    certificate::PointTable& points = record.points.emplace();
    points.points = {"1", "2", "3"};
    for (const std::string& point : points.points) {
        one.point = point;
        one.name = "E[" + point + "]";
        record.results.push_back(one);
    }
    points.columns = {{.name = "range",
                       .heading = {},
                       .role = "",
                       .stage = "",
                       .unit = "",
                       .printed_unit = "",
                       .values = {{}, {}, {}},
                       .printed = {"100 mV", "10 V", "100 mV"}},
                      {.name = "V_s",
                       .heading = {},
                       .role = "reference",
                       .stage = "",
                       .unit = "V",
                       .printed_unit = "V",
                       .values = {0.05, 10.0, 0.1},
                       .printed = {"0.05000", "10", "0.1"}}};
    certificate::TableRequest request;
    request.group_by = "range";
    request.units = {{.group = "100 mV", .of = "V_s", .unit = "mV"}};
    request.columns = {{.show = "column", .of = "V_s", .heading = {}, .role = "reference", .stage = ""},
                       {.show = "value", .of = "E", .heading = {}, .role = "error", .stage = ""},
                       {.show = "U", .of = "E", .heading = {}, .role = "", .stage = ""}};
    points.tables = {request};
    const std::vector<CertifiedTable> tables = certified_tables(record);
    ASSERT_EQ(tables.size(), 2U);
    ASSERT_TRUE(tables[0].layout);
    EXPECT_EQ(tables[0].layout->group, "100 mV");
    EXPECT_EQ(tables[0].argument->printed, (std::vector<std::string>{"1", "3"}));
    const certificate::PointColumn& reference = tables[0].layout->columns.at(0);
    EXPECT_EQ(reference.printed_unit, "mV");
    EXPECT_EQ(reference.printed, (std::vector<std::string>{"50.00", "100"})) << "the decimals that were written";
    EXPECT_EQ(tables[0].columns.at(0).values.size(), 2U);
    EXPECT_EQ(tables[1].layout->columns.at(0).printed, (std::vector<std::string>{"10"}));
    EXPECT_EQ(tables[1].layout->columns.at(0).unit, "V");

    points.columns.back().decimals = "of_uncertainty";
    const std::vector<CertifiedTable> computed = certified_tables(record);
    EXPECT_EQ(computed[0].layout->columns.at(0).printed, (std::vector<std::string>{"50.00", "1E+2"}))
        << "each as its uncertainty has it";
    points.tables[0].units.clear();
    EXPECT_EQ(certified_tables(record)[0].layout->columns.at(0).printed, (std::vector<std::string>{"0.05000", "0.1"}));
}

/// 0.1 in is 2.54 mm and not 3 mm: what was written keeps its value in another unit, whatever the factor between the two.
TEST(CertifiedTables, KeepTheValueOfWhatWasWrittenInAnotherUnit) {
    EvaluationRecord record;
    record.kind = "budget";
    Result one;
    one.quantity = "E";
    one.unit = "mm";
    one.point = "1";
    one.name = "E[1]";
    record.results = {one};
    certificate::PointTable& points = record.points.emplace();
    points.points = {"1"};
    std::string name = "x";
    const auto printed = [&](const std::string& written, const std::string& unit, const std::string& in) {
        points.columns = {{.name = name,
                           .heading = {},
                           .role = "",
                           .stage = "",
                           .unit = unit,
                           .printed_unit = unit,
                           .values = {std::stod(written)},
                           .printed = {written}}};
        certificate::TableRequest request;
        request.units = {{.group = "", .of = name, .unit = in}};
        request.columns = {{.show = "column", .of = name, .heading = {}, .role = "", .stage = ""},
                           {.show = "value", .of = "E", .heading = {}, .role = "", .stage = ""}};
        points.tables = {request};
        return certified_tables(record).at(0).layout->columns.at(0).printed.at(0);
    };
    EXPECT_EQ(printed("0.1", "in", "mm"), "2.54");
    EXPECT_EQ(printed("1.250", "in", "mm"), "31.75");
    EXPECT_EQ(printed("2", "in", "mm"), "50.8");
    EXPECT_EQ(printed("0.5", "deg", "arcmin"), "30");
    EXPECT_EQ(printed("20.1", "degC", "degF"), "68.18");
    EXPECT_EQ(printed("68.2", "degF", "degC"), "20.111");
    EXPECT_EQ(printed("0.50", "V", "mV"), "500") << "a power of ten moves the decimal sign";
    EXPECT_EQ(printed("20.1", "degC", "K"), "20.1") << "no unit of its kind: as it is";
    for (const auto& [unit, in] : {std::pair{"in", "mm"},
                                   {"mm", "in"},
                                   {"psi", "kPa"},
                                   {"kPa", "psi"},
                                   {"deg", "rad"},
                                   {"rad", "arcsec"},
                                   {"degC", "degF"},
                                   {"degF", "degC"},
                                   {"lb", "g"},
                                   {"h", "s"}}) {
        const gum::Unit from = gum::Unit::parse(unit);
        const gum::Unit to = gum::Unit::parse(in);
        for (const auto& [written, step] :
             {std::pair{"0.1", 0.1}, {"1.25", 0.01}, {"2", 1.0}, {"-37.0", 0.1}, {"123.4567", 1e-4}, {"0.003", 1e-3}}) {
            const double exact = to.from_si(from.to_si(std::stod(written)));
            EXPECT_NEAR(std::stod(printed(written, unit, in)), exact,
                        0.0501 * to.difference_from_si(from.difference_to_si(step)))
                << written << " " << unit << " in " << in;
        }
    }
    name = "s(x)";
    EXPECT_EQ(printed("0.2517", "arcsec", "urad"), "1.2") << "a standard deviation has two significant digits";
    EXPECT_EQ(printed("0.34", "in", "mm"), "8.6");
    EXPECT_EQ(printed("0.00012", "V", "mV"), "0.12");
    EXPECT_EQ(printed("0.152753", "V", "mV"), "1.5E+2") << "as in units that are no power of ten away";
    EXPECT_EQ(printed("0", "in", "mm"), "0");
}

TEST(CertifiedTables, HoldARotaryTable) {
    const EvaluationRecord record = test::sample_record();
    const std::vector<CertifiedTable> tables = certified_tables(record);
    std::vector<std::string> ids;
    for (const CertifiedTable& table : tables) {
        ids.push_back(table.id);
        for (const certificate::CertifiedColumn& column : table.columns) {
            EXPECT_EQ(column.values.size(), table.argument ? table.argument->printed.size() : 1U);
        }
    }
    ASSERT_GE(ids.size(), 2U);
    EXPECT_EQ(ids[0], "set_up");
    EXPECT_EQ(ids[1], "error_motions");
    const CertifiedTable& motions = tables[1];
    EXPECT_EQ(motions.argument->name, "angle");
    EXPECT_EQ(motions.argument->unit, "deg");
    ASSERT_EQ(motions.columns.size(), 6U);
    EXPECT_EQ(motions.columns[3].unit, "arcsec");
    EXPECT_EQ(motions.columns[3].values[2].printed_value, record.rotary->errors[2].errors[3].printed.value);
    for (const CertifiedTable& table : tables) {
        if (table.id == "ranges") {
            EXPECT_TRUE(table.columns.at(0).result.starts_with("range_"));
        }
    }
}

TEST(CertifiedTables, ShowAVerdictWhereTheyShowTheLimits) {
    CertifiedTable table;
    EXPECT_FALSE(shows_verdict(table, "E")) << "no layout";
    table.layout.emplace();
    const auto show = [&](const char* what, const char* of) {
        table.layout->shown.emplace_back();
        table.layout->shown.back().show = what;
        table.layout->shown.back().of = of;
    };
    show("verdict", "E");
    show("limit", "F");
    EXPECT_FALSE(shows_verdict(table, "E")) << "limits of another result";
    show("limit_high", "E");
    EXPECT_TRUE(shows_verdict(table, "E"));
    EXPECT_FALSE(shows_verdict(table, "F"));
}

}  // namespace
}  // namespace gumcert::reports
