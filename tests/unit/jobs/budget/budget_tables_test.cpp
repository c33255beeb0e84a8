#include "jobs/budget/budget_tables.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "certificate/statement_of_uncertainty.h"
#include "gum/budget/budget.h"

#include "jobs/input_codes.h"
#include "tests/support/budget_campaign.h"
#include "text/numbers.h"

namespace gumcert::jobs {
namespace {

using test::budget_refusals;
using test::read_budget;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string k_meter =
    R"j("model": ["E = V_x + dV - V_s"],
        "inputs": {"V_x": {"unit": "V", "role": "indication"}, "dV": {"unit": "V", "value": 0, "u": 1e-6},
                   "V_s": {"unit": "V", "constant": true, "role": "reference"}},
        "outputs": {"E": {"unit": "mV", "role": "error"}})j";

const test::BudgetFiles k_points{{"points.csv",
                                  "range;V_s;V_x.1;V_x.2;remark;nominal\n"
                                  "100 mV;0,0500;0,0501;0,0503;;50,0\n"
                                  "10 V;10,0;10,0001;10,0002;warm;10000\n"}};

std::string meter(const std::string& columns, const std::string& more = "") {
    return k_meter + R"j(, "points": {"file": "points.csv", "columns": )j" + columns + "}" + more;
}

const std::string k_columns = R"j({"range": "text", "remark": {"heading": "Note"}, "nominal": "mV"})j";

void expect_refusal(const std::string& keys, const InputCode& code, const std::string& part,
                    const test::BudgetFiles& files = k_points) {
    SCOPED_TRACE(part);
    const std::vector<gum::Diagnostic> found = budget_refusals(keys, files);
    std::string all;
    bool is_told = false;
    for (const gum::Diagnostic& one : found) {
        const std::string message = gum::message(one);
        is_told = is_told || (one.code == code.code && message.find(part) != std::string::npos);
        all += one.code + " " + message + "\n";
    }
    EXPECT_TRUE(is_told) << all;
}

std::vector<std::string> shown(const certificate::TableRequest& table) {
    std::vector<std::string> all;
    for (const certificate::ShownColumn& column : table.columns) {
        all.push_back(column.show + ":" + column.of);
    }
    return all;
}

/// A text as the form "Unicode text" of spreadsheets has it.
std::string utf16(const std::string& text, bool little) {
    std::string bytes = little ? "\xFF\xFE" : "\xFE\xFF";
    for (const char c : text) {
        bytes += little ? std::string{c, '\0'} : std::string{'\0', c};
    }
    return bytes;
}

TEST(BudgetTables, AFaultOfTheTableIsNoFaultOfTheInputs) {
    const std::string rows = "1,1.01,1.02\n2,2.01,2.02\n";
    const std::string good = "V_s,V_x.1,V_x.2\n" + rows;
    const auto with = [&](char separator) {
        std::string text = good;
        std::replace(text.begin(), text.end(), ',', separator);
        return text;
    };
    struct Broken {
        const char* name;
        std::string bytes;
        bool is_unreadable = false;  ///< nothing but this can be said of it
    };
    const std::vector<Broken> all = {
        {"UTF-16, little", utf16(good, true), true},
        {"UTF-16, big", utf16(good, false), true},
        {"tabs", with('\t'), true},
        {"bars", with('|'), true},
        {"empty", "", true},
        {"header only", "V_s,V_x.1,V_x.2\n", true},
        {"Latin-1 in a row", good + "\xB5,1,1\n", true},
        {"Latin-1 in the header", "V_s,V_x.1,V_x.2,\xB5\n1,1,1,1\n", true},
        {"NUL", good + std::string(1, '\0'), true},
        {"carriage returns", "V_s,V_x.1,V_x.2\r1,1.01,1.02\r", true},
        {"blank in a key", "V_s,V_x. 1,V_x.2\n" + rows},
        {"wrong key", "V_s,V_x.1,dV.K\n" + rows},
        {"unknown column", "V_S,V_x.1,V_x.2\n" + rows},
        {"column twice", "V_s,V_x.1,V_x.1\n" + rows},
        {"quote", "V_s,V_x.1,\"V_x.2\n" + rows},
        {"rows too short", "V_s,V_x.1,V_x.2\n1,1\n2,2\n"},
        {"decimal commas", "V_s,V_x.1,V_x.2\n1,1,01,1,02\n2,2,01,2,02\n"},
        {"not there", ""},
    };
    for (const Broken& broken : all) {
        SCOPED_TRACE(broken.name);
        std::vector<gum::Diagnostic> told;
        try {
            const bool is_there = std::string(broken.name) != "not there";
            (void)read_budget(k_meter + R"j(, "points": {"file": "points.csv"})j",
                              is_there ? test::BudgetFiles{{"points.csv", broken.bytes}} : test::BudgetFiles{});
        } catch (const gum::DiagnosedError& error) {
            told = error.diagnostics();
        }
        EXPECT_FALSE(told.empty());
        EXPECT_TRUE(!broken.is_unreadable || told.size() == 1U) << told.size() << " messages";
        for (const gum::Diagnostic& one : told) {
            EXPECT_EQ(one.where.find("job.json"), std::string::npos) << gum::message(one);
        }
    }
    // What the job states itself, and states wrongly, is told beside it.
    std::string wrong = k_meter + R"j(, "points": {"file": "points.csv"})j";
    wrong.replace(wrong.find("1e-6"), 4, "-1e-6");
    // Limits of points are no fault of a specification whose points were refused.
    for (const gum::Diagnostic& one : budget_refusals(
             k_meter + R"j(, "points": {"file": "points.csv"}, "certificate": {"specifications": [{"id": "s",
                 "results": ["E"], "unit": "mV", "rule": {"id": "DR-01"}, "limits": {"by": "points"}}]})j",
             {{"points.csv", "V_s,V_x.1,dV.K\n" + rows}})) {
        EXPECT_NE(one.code, k_point_without_limit.code) << gum::message(one);
    }
    expect_refusal(wrong, k_number_out_of_range, "-1e-06", {{"points.csv", with('\t')}});
    expect_refusal(wrong, k_csv_separator, "tabs", {{"points.csv", with('\t')}});
}

TEST(BudgetTables, ShowLimitsWhereASpecificationNamesAPoint) {
    const auto columns = [](const std::string& named) {
        return shown(
            read_budget(meter(k_columns, R"j(, "certificate": {"specifications": [{"id": "s", "results": [")j" + named +
                                             R"j("], "unit": "mV", "rule": {"id": "DR-01"},
                                                      "lower": -1, "upper": 1}]})j"),
                        k_points)
                .tables.at(0));
    };
    EXPECT_THAT(columns("E[2]"), testing::Contains("verdict:E"));
    EXPECT_THAT(columns("E[2]"), testing::Contains("limit:E"));
    EXPECT_THAT(columns("E"), testing::Contains("verdict:E"));
    EXPECT_THAT(columns("E[3]"), testing::Not(testing::Contains("verdict:E"))) << "no such point";
}

TEST(BudgetTables, SayWhetherTheirRowsAreDrawn) {
    EXPECT_EQ(read_budget(meter(k_columns, R"j(, "tables": [{"plot": "none"}])j"), k_points).tables.at(0).plot, "none");
    EXPECT_EQ(read_budget(meter(k_columns, R"j(, "tables": [{"plot": "each"}])j"), k_points).tables.at(0).plot, "");
    EXPECT_EQ(read_budget(meter(k_columns), k_points).tables.at(0).plot, "");
}

TEST(BudgetTables, ReadReadingsAndColumnsOfPoints) {
    const BudgetJob job = read_budget(meter(k_columns), k_points);
    ASSERT_EQ(job.points.size(), 2U);
    ASSERT_EQ(job.points[0].inputs.size(), 2U);
    EXPECT_EQ(job.points[0].name, "1");
    EXPECT_THAT(job.points[0].inputs[0].second.components.front().observations, ElementsAre(0.0501, 0.0503));
    ASSERT_EQ(job.point_columns.size(), 5U);
    EXPECT_EQ(job.point_columns[0].printed, (std::vector<std::string>{"100 mV", "10 V"}));
    EXPECT_EQ(job.point_columns[1].printed, (std::vector<std::string>{"", "warm"}));
    EXPECT_EQ(job.point_columns[2].role, "nominal") << "by its name";
    EXPECT_EQ(job.point_columns[2].values.at(1), 10000.0);
    // Inputs as they were written, a mean of several readings with one decimal more.
    EXPECT_EQ(job.point_columns[3].name, "V_x");
    EXPECT_EQ(job.point_columns[3].printed, (std::vector<std::string>{"0.05020", "10.00015"}));
    EXPECT_EQ(job.point_columns[4].printed, (std::vector<std::string>{"0.0500", "10.0"}));
}

TEST(BudgetTables, ShowWhatHasARoleByThemselves) {
    const BudgetJob job = read_budget(meter(k_columns), k_points);
    ASSERT_EQ(job.tables.size(), 1U);
    EXPECT_EQ(job.tables[0].group_by, "range");
    EXPECT_THAT(shown(job.tables[0]),
                ElementsAre("column:remark", "column:nominal", "column:V_s", "column:V_x", "value:E", "U:E"));
}

TEST(BudgetTables, AreNotMadeWhereNobodyAsks) {
    const BudgetJob job = read_budget(R"j("inputs": {"x": {"unit": "V", "u": 1}}, "points": [{"x": 1}, {"x": 2}])j");
    EXPECT_TRUE(job.tables.empty());
    EXPECT_TRUE(job.point_columns.empty());
}

TEST(BudgetTables, ShowTheColumnsThatTheJobChooses) {
    const BudgetJob job =
        read_budget(meter(k_columns,
                          R"j(, "tables": [{"title": {"en": "Volts", "de": "Volt"}, "group_by": "range",
                     "columns": ["range", "nominal", "reference", {"column": "V_x", "heading": "Read"}, "error", "U", "k"],
                     "units": {"100 mV": {"V_x": "mV", "E": "uV"}, "10 V": "V"}}])j"),
                    k_points);
    ASSERT_EQ(job.tables.size(), 1U);
    EXPECT_THAT(shown(job.tables[0]),
                ElementsAre("column:nominal", "column:V_s", "column:V_x", "value:E", "U:E", "k:E"))
        << "the column of the groups stands above them";
    EXPECT_EQ(job.tables[0].columns[2].heading, certificate::LocalisedText("Read"));
    ASSERT_EQ(job.point_units.size(), 2U);
    EXPECT_EQ(job.point_units[0].at("E").text(), "uV");
    EXPECT_EQ(job.point_units[1].at("E").text(), "V");
}

/// s of readings is what a balance or a pipette is calibrated for as well.
TEST(BudgetTables, ShowTheScatterOfReadings) {
    const BudgetJob job = read_budget(
        meter(k_columns, R"j(, "tables": [{"columns": ["reference", "indication", "s(V_x)", "E", "U"]}])j"), k_points);
    ASSERT_EQ(job.tables.size(), 1U);
    EXPECT_THAT(shown(job.tables.front()), ElementsAre("column:V_s", "column:V_x", "column:s(V_x)", "value:E", "U:E"));
    const certificate::PointColumn& s = job.point_columns.back();
    EXPECT_EQ(s.name, "s(V_x)");
    EXPECT_EQ(s.unit, "V");
    EXPECT_THAT(s.printed, ElementsAre("0.00014", "0.000071"));  // 0.2 mV/√2 and 0.1 mV/√2
    EXPECT_NEAR(s.values[0].value_or(0.0), 2e-4 / std::sqrt(2.0), 1e-18);
}

/// Readings stand beside the step of the display, or beside other components: their scatter is the same.
TEST(BudgetTables, ShowTheScatterOfReadingsBesideOtherComponents) {
    for (const std::string beside :
         {R"j("resolution": 1e-5)j",
          R"j("components": [{"name": "display", "resolution": 1e-5}, {"name": "zero", "u": 1e-6}])j"}) {
        std::string keys = meter(k_columns, R"j(, "tables": [{"columns": ["indication", "s(V_x)", "E", "U"]}])j");
        keys.insert(keys.find(R"j("role": "indication")j"), beside + ", ");
        const BudgetJob job = read_budget(keys, k_points);
        ASSERT_EQ(job.tables.size(), 1U);
        EXPECT_THAT(job.point_columns.back().printed, ElementsAre("0.00014", "0.000071")) << beside;
    }
}

TEST(BudgetTables, ShowNoScatterOfWhatHasNoReadings) {
    for (const char* const name : {"s(dV)", "s(V_s)", "s(V_y)", "s()", "s(", "s(V_x", "s(E)"}) {
        expect_refusal(meter(k_columns, std::string(R"j(, "tables": [{"columns": ["E", "U", ")j") + name + R"j("]}])j"),
                       k_table_column, "is nothing that the points of this job have");
    }
}

TEST(BudgetTables, PutResultsBeforeAndAfterAnAdjustmentSideBySide) {
    const BudgetJob job = read_budget(
        R"j("model": ["a = x - r", "b = y - r"],
            "inputs": {"r": {"unit": "V", "constant": true, "role": "reference"},
                       "x": {"unit": "V", "u": 0.1, "role": "indication", "stage": "as_found"},
                       "y": {"unit": "V", "u": 0.1, "role": "indication", "stage": "as_left"}},
            "outputs": {"a": {"role": "error", "stage": "as_found"}, "b": {"role": "error", "stage": "as_left"}},
            "points": [{"r": 1, "x": 1.1, "y": 1.0}])j");
    ASSERT_EQ(job.tables.size(), 1U);
    EXPECT_THAT(shown(job.tables[0]),
                ElementsAre("column:r", "column:x", "value:a", "U:a", "column:y", "value:b", "U:b"));
    EXPECT_EQ(job.tables[0].columns[2].stage, "as_found");
    EXPECT_EQ(job.tables[0].columns[6].stage, "as_left");
}

TEST(BudgetTables, ReadPointsOfTheJobWithColumns) {
    const BudgetJob job = read_budget(k_meter + R"j(, "points": {"columns": {"range": "text"}, "list": [
            {"point": "low", "range": "1 V", "V_s": 1, "V_x": {"observations": [1.01, 1.02]}, "mpe": 0.5},
            {"point": "high", "range": "1 V", "V_s": 2, "V_x": {"observations": [2.01, 2.02]}}]})j");
    ASSERT_EQ(job.points.size(), 2U);
    ASSERT_GE(job.point_columns.size(), 2U);
    EXPECT_EQ(job.point_columns[0].printed, (std::vector<std::string>{"1 V", "1 V"}));
    EXPECT_EQ(job.point_columns[1].name, "mpe");
    EXPECT_EQ(job.point_columns[1].values, (std::vector<std::optional<double>>{0.5, std::nullopt}));
}

TEST(BudgetTables, KnowThePiecesOfASet) {
    const test::BudgetFiles files{
        {"points.csv", "serial,identification,V_s,V_x.1,V_x.2\nA 1,first,1,1.01,1.02\nA 2,,2,2.0,2.1\n"}};
    const BudgetJob job =
        read_budget(meter(R"j({"serial": {"role": "serial_number"}, "identification": "text"})j",
                          R"j(, "tables": [{"columns": ["serial_number", "identification", "E", "U"]}])j"),
                    files);
    ASSERT_EQ(job.point_columns.size(), 2U);
    EXPECT_EQ(job.point_columns[0].role, "serial_number");
    EXPECT_EQ(job.point_columns[1].role, "identification") << "by its name";
    EXPECT_THAT(shown(job.tables.at(0)), ElementsAre("column:serial", "column:identification", "value:E", "U:E"));
    expect_refusal(meter(R"j({"serial": {"role": "serial_number", "unit": "V"}, "identification": "text"})j"),
                   k_unknown_choice, "serial_number", files);
}

TEST(BudgetTables, RefuseColumnsOfPointsThatCannotBe) {
    expect_refusal(meter(R"j({"range": "text", "remark": "text", "nominal": "mV", "V_x": "V"})j"), k_point_column,
                   "is an input and a column of points");
    expect_refusal(meter(R"j({"range": "text", "remark": "text", "nominal": "mV", "U": "V"})j"), k_point_column,
                   "stands for something else");
    expect_refusal(meter(R"j({"range": "text", "nominal": "mV"})j"), k_unknown_quantity,
                   "\"remark\" is none of the inputs");
    expect_refusal(meter(R"j({"range": "text", "remark": 1, "nominal": "mV"})j"), k_wrong_type, "a unit or an object");
    expect_refusal(meter(R"j({"range": "V", "remark": "text", "nominal": "mV"})j"), k_csv_not_a_number,
                   "\"100 mV\" in column range");
}

TEST(BudgetTables, RefuseAMissingReading) {
    test::BudgetFiles files = k_points;
    files["points.csv"].replace(files["points.csv"].find("0,0503"), 6, "");
    expect_refusal(meter(k_columns), k_empty_cell, "no value in the column \"V_x.2\"", files);
}

/// A unit goes to what it fits: a temperature of a scale with an origin never becomes a difference, nor the other way round.
TEST(BudgetTables, StateNumbersInUnitsOfTheirKind) {
    const auto thermometer = [](const std::string& units) {
        return R"j("model": ["E = t_x - t_s"], "inputs": {"t_x": {"unit": "degC", "u": 0.1},
                    "t_s": {"unit": "degF", "constant": true}}, "outputs": {"E": {"unit": "mK"}},
                   "points": {"list": [{"range": "A", "nom": 20, "t_x": 20.1, "t_s": 68}],
                              "columns": {"range": "text", "nom": "degC"}},
                   "tables": [{"columns": ["nom", "t_x", "t_s", "E", "U"], "units": {"A": )j" +
               units + "}}]";
    };
    for (const std::string name : {"nom", "t_x", "t_s", "E"}) {
        for (const std::string unit : {"degC", "degF", "K", "mK", "delta_degF", "kg", "1"}) {
            const bool fits =
                name == "E" ? unit == "K" || unit == "mK" || unit == "delta_degF" : unit == "degC" || unit == "degF";
            const std::string keys = thermometer("{\"" + name + "\": \"" + unit + "\"}");
            if (fits) {
                EXPECT_TRUE(budget_refusals(keys, {}).empty()) << name << " " << unit;
            } else {
                expect_refusal(keys, k_unit_does_not_fit, "and \"" + name + "\" is in ", {});
            }
        }
    }
    EXPECT_TRUE(read_budget(thermometer("\"degF\"")).point_units.at(0).empty()) << "the error stays in mK";
    EXPECT_EQ(read_budget(thermometer("\"K\"")).point_units.at(0).at("E").text(), "K");
    expect_refusal(thermometer("\"kg\""), k_unit_does_not_fit, "fits nothing that the table shows", {});
    expect_refusal(thermometer("{\"range\": \"1\"}"), k_unit_does_not_fit, "\"range\" has no unit", {});
}

TEST(BudgetTables, RefuseWhatTheyCannotShow) {
    const auto tables = [](const std::string& list) { return meter(k_columns, R"j(, "tables": )j" + list); };
    expect_refusal(tables(R"j([{"columns": ["V_y", "E", "U"]}])j"), k_table_column, "did you mean \"V_x\"?");
    expect_refusal(tables(R"j([{"columns": ["E"]}])j"), k_table_incomplete, "shows \"E\" without U");
    expect_refusal(tables(R"j([{"columns": ["nominal"]}])j"), k_table_incomplete, "a table without a result");
    expect_refusal(tables(R"j([{"columns": ["U", "nominal"]}])j"), k_table_incomplete,
                   "\"U\" in a table without a result");
    expect_refusal(tables(R"j([{"group_by": "nominal"}])j"), k_table_column, "no column of points with words");
    expect_refusal(tables(R"j([{"units": {"1 V": "mV"}}])j"), k_table_column, "the group \"1 V\", which no point has");
    expect_refusal(tables(R"j([{"units": {"10 V": "xV"}}])j"), InputCode{"GC-UNIT-0001", ""}, "xV");
    expect_refusal(tables(R"j([{"where": {"range": "10 V"}}])j"), k_table_incomplete, "no table shows the point \"1\"");
    expect_refusal(tables(R"j([{}, {}])j"), k_table_incomplete, "two tables show \"E\" of the same points");
    expect_refusal(tables(R"j([{"where": {"range": "1 V"}}, {}])j"), k_table_incomplete, "a table without rows");
    expect_refusal(tables("[]"), k_wrong_size, "0 tables");
    expect_refusal(k_meter + R"j(, "tables": [{}])j", k_no_statement, "nothing is stated");
}

/// Sentences name a value by its point: a table that the program makes says which row that is.
TEST(BudgetTables, ShowTheNamesOfPointsThatTheirRowsDoNotSay) {
    struct Named {
        std::string first, second;
        std::string specified;  ///< result of a specification
        bool is_shown;
    };
    const std::vector<Named> all = {
        {"1", "2", "", false},            // they count the rows
        {"1", "2", "E", false},           // the specification is about all of them
        {"1", "2", "E[2]", true},         // about one of them: which?
        {"10", "10000", "E[10]", false},  // the nominal values
        {"10 V", "10 kV", "E[10 V]", false},
        {"10V", "10000 V", "", false},
        {"low", "high", "", true},
        {"10 V", "10 kV, warm", "", true},
        {"10 V", "11 V", "", true},  // another number than the row has
        {"10/50", "10000/50", "", true},
        {"P1", "P2", "E[P1]", true},
        {"10 V", "10 kW", "", true},
    };
    for (const Named& named : all) {
        SCOPED_TRACE(named.first + " " + named.second + " " + named.specified);
        const test::BudgetFiles files{
            {"points.csv", "point;V_s;V_x\n" + named.first + ";10;10.1\n" + named.second + ";10000;10000.1\n"}};
        std::string keys = k_meter + R"j(, "points": {"file": "points.csv"})j";
        keys.replace(keys.find(R"j("unit": "V", "role": "indication")j"), 11, R"j("unit": "V", "u": 0.1)j");
        if (!named.specified.empty()) {
            keys += R"j(, "certificate": {"specifications": [{"id": "s", "results": [")j" + named.specified +
                    R"j("], "unit": "mV", "rule": {"id": "DR-01"}, "lower": -1, "upper": 1}]})j";
        }
        const BudgetJob job = read_budget(keys, files);
        EXPECT_EQ(shown(job.tables.at(0)).front(), named.is_shown ? "point:" : "column:V_s");
        // Columns that the job chooses stay; what a specification of one point needs is told.
        for (const std::string point : {"", R"j("point", )j"}) {
            const BudgetJob chosen =
                read_budget(keys + R"j(, "tables": [{"columns": [)j" + point + R"j("V_s", "V_x", "E", "U"]}])j", files);
            EXPECT_EQ(shown(chosen.tables.at(0)).front(), point.empty() ? "column:V_s" : "point:");
            const bool is_told =
                std::any_of(chosen.warnings.begin(), chosen.warnings.end(),
                            [](const gum::Diagnostic& one) { return one.code == k_warn_point_not_shown.code; });
            EXPECT_EQ(is_told, point.empty() && named.is_shown && named.specified.find('[') != std::string::npos);
        }
    }
}

/// Roles are those of columns: where no table of points can show them that is told, and the cure is one row.
TEST(BudgetTables, TellRolesThatNoPointsShow) {
    struct Case {
        std::string input, output, rest;
        std::vector<std::string> named;
    };
    const std::vector<Case> all = {
        {R"j(, "role": "nominal")j", R"j(, "role": "deviation")j", "", {R"("m_N")", R"("E")"}},
        {"", R"j(, "role": "deviation")j", "", {R"("E")"}},
        {"", R"j(, "stage": "as_left")j", "", {R"("E")"}},
        {R"j(, "role": "nominal")j", "", "", {R"("m_N")"}},
        {"", "", "", {}},
        {"", R"j(, "role": "measured_value")j", "", {}},
        {R"j(, "role": "nominal")j", R"j(, "role": "deviation")j", R"j(, "points": [{}])j", {}},
        {R"j(, "role": "nominal")j", R"j(, "role": "deviation")j", R"j(, "points": [{"m": 1001}, {"m": 999}])j", {}}};
    for (const Case& one : all) {
        SCOPED_TRACE(one.input + one.output + one.rest);
        const BudgetJob job =
            read_budget(R"j("model": "E = m - m_N", "inputs": {"m": {"unit": "g", "value": 1000.005, "u": 0.001},
            "m_N": {"unit": "g", "value": 1000, "constant": true)j" +
                        one.input + R"j(}}, "outputs": {"E": {"unit": "mg")j" + one.output + "}}" + one.rest);
        const auto told = std::find_if(job.warnings.begin(), job.warnings.end(), [](const gum::Diagnostic& d) {
            return d.code == k_warn_roles_without_points.code;
        });
        ASSERT_EQ(told != job.warnings.end(), !one.named.empty());
        for (const std::string& name : one.named) {
            EXPECT_THAT(told->what, testing::HasSubstr(name));
        }
        if (told != job.warnings.end()) {
            EXPECT_THAT(told->action, testing::HasSubstr(R"("points": [{}])"));
            EXPECT_THAT(told->where,
                        testing::StartsWith(one.input.empty() ? "job.json#/outputs/E" : "job.json#/inputs/m_N"));
        }
        if (one.rest == R"j(, "points": [{}])j") {
            EXPECT_THAT(shown(job.tables.at(0)), testing::IsSupersetOf({"column:m_N", "value:E", "U:E"}));
        }
    }
}

/// An input whose role no section shows is told by itself, and not where another section shows it.
TEST(BudgetTables, TellRolesOfInputsThatNoSectionShows) {
    for (const bool is_shown : {false, true}) {
        const BudgetJob job = read_budget(
            R"j("inputs": {"m": {"unit": "g", "value": 1000.005, "u": 0.001},
            "m_N": {"unit": "g", "value": 1000, "constant": true, "role": "nominal"}},
            "sections": {"first": {"model": "E = m - m_N", "outputs": {"E": {"unit": "mg"}}},
            "second": {"model": "R = m)j" +
            std::string(is_shown ? "/m_N" : "*2") + R"j(", "points": [{"m": 999}, {"m": 1001}]}})j");
        const auto told = std::find_if(job.warnings.begin(), job.warnings.end(), [](const gum::Diagnostic& d) {
            return d.code == k_warn_roles_without_points.code;
        });
        ASSERT_EQ(told == job.warnings.end(), is_shown);
        if (!is_shown) {
            EXPECT_THAT(told->where, testing::StartsWith("job.json#/inputs/m_N"));
        }
    }
}

/// A row of 1 V is that of the point "1" only where it is the only one; rows that show the same are told apart by the names.
TEST(BudgetTables, ShowTheNamesOfPointsThatTheirRowsDoNotTellApart) {
    struct Case {
        std::string rows;   ///< V_s and V_x of each, and a mode
        std::string named;  ///< result of one point
        bool is_needed;
    };
    const std::vector<Case> all = {
        {"1;1.001;dc\n1;1.001;dc\n2;2.001;dc\n", "E[1]", true},
        {"1;1.001;dc\n1;1.002;dc\n2;2.001;dc\n", "E[1]", true},
        {"1;1.001;dc\n2;2.001;dc\n3;3.001;dc\n", "E[1]", false},
        {"1;1.001;dc\n1;1.001;dc\n2;2.001;dc\n", "E", false},
        {"1;1.001;dc\n2;2.001;dc\n1;1.001;ac\n", "E[1]", true},  // two tables, told apart by their titles
        {"1;1.001;dc\n2;2.001;dc\n3;1.001;ac\n", "E[1]", false},
        {"1;4;dc\n2;2.001;dc\n4;1;ac\n", "E[1]", false},  // the same numbers in other columns
    };
    const auto is_told = [](const BudgetJob& job) {
        return std::any_of(job.warnings.begin(), job.warnings.end(),
                           [](const gum::Diagnostic& one) { return one.code == k_warn_point_not_shown.code; });
    };
    for (const Case& one : all) {
        SCOPED_TRACE(one.rows + one.named);
        const test::BudgetFiles files{{"points.csv", "V_s;V_x;mode\n" + one.rows}};
        std::string keys = k_meter + R"j(, "points": {"file": "points.csv", "columns": {"mode": "text"}})j";
        keys.replace(keys.find(R"j("unit": "V", "role": "indication")j"), 11, R"j("unit": "V", "u": 0.1)j");
        const std::string specified = R"j(, "certificate": {"specifications": [{"id": "s", "results": [")j" +
                                      one.named +
                                      R"j("], "unit": "mV", "rule": {"id": "DR-01"}, "lower": -1, "upper": 1}]})j";
        const std::string provided = R"j(, "certificate": {"external_results": [{"provider": "Other", "results": [")j" +
                                     one.named + R"j("]}]})j";
        const bool has_modes = one.rows.find("ac") != std::string::npos;
        for (const std::string& statement : {specified, provided}) {
            const std::string columns = R"j("columns": ["V_s", "V_x", "E", "U"])j";
            const auto of_mode = [&](const std::string& mode, const std::string& shown) {
                return R"j({"where": {"mode": ")j" + mode + "\"}, " + shown + "}";
            };
            const std::string own =
                has_modes ? of_mode("dc", columns) + "," + of_mode("ac", columns) : "{" + columns + "}";
            EXPECT_EQ(is_told(read_budget(keys + statement + R"j(, "tables": [)j" + own + "]", files)), one.is_needed);
            if (!has_modes) {
                const BudgetJob made = read_budget(keys + statement, files);
                EXPECT_EQ(shown(made.tables.at(0)).front() == "point:", one.is_needed);
                EXPECT_FALSE(is_told(made));
            }
        }
    }
}

/// Of a list of accuracies the first that fits is taken: a range that no point has leaves its points to another one.
TEST(BudgetTables, TellAnAccuracyThatNoPointTakes) {
    const auto accuracy = [](const std::string& entries) {
        return meter(k_columns, R"j(, "certificate": {"specifications": [{"id": "s", "results": ["E"], "unit": "mV",
            "rule": {"id": "DR-01"}, "limits": {"by": "accuracy", "of": "V_s", "accuracy": [)j" +
                                    entries + "]}}]}");
    };
    const auto entry = [](const std::string& range) {
        return R"j({"percent_of_reading": 1)j" + (range.empty() ? "" : R"j(, "range": ")j" + range + "\"") + "}";
    };
    for (const std::string slip : {"100mV", "100 mv", "100  mV"}) {
        expect_refusal(accuracy(entry(slip) + "," + entry("")), k_limits_not_meant,
                       "the range \"" + slip + "\", and points have \"100 mV\"");
    }
    expect_refusal(accuracy(entry("") + "," + entry("10 V")), k_limits_not_meant, "behind the one without a range");
    expect_refusal(accuracy(entry("10 V") + "," + entry("") + "," + entry("")), k_limits_not_meant,
                   "behind the one without a range");
    expect_refusal(accuracy(entry("10 V") + "," + entry("100 mV") + "," + entry("10 V")), k_limits_not_meant,
                   "the accuracy of the range \"10 V\" twice");
    const auto told = [](const std::string& keys) {
        std::set<std::string> codes;
        for (const gum::Diagnostic& one : read_budget(keys, k_points).warnings) {
            codes.insert(one.code);
        }
        return codes.contains(std::string(k_warn_range_of_no_point.code));
    };
    EXPECT_TRUE(told(accuracy(entry("1 V") + "," + entry(""))));
    EXPECT_TRUE(told(accuracy(entry("100 MV") + "," + entry("")))) << "another prefix: told, not refused";
    EXPECT_TRUE(told(accuracy(entry("10 V") + "," + entry("1 V") + "," + entry(""))));
    EXPECT_FALSE(told(accuracy(entry("10 V") + "," + entry(""))));
    EXPECT_FALSE(told(accuracy(entry(""))));
    EXPECT_FALSE(told(accuracy(entry("10 V") + "," + entry("100 mV") + "," + entry("1 V"))))
        << "a data sheet has ranges that were not measured";
    EXPECT_FALSE(told(accuracy(entry("10 V") + "," + entry("100 mV") + "," + entry("1 V") + "," + entry(""))))
        << "no point is left to the one without a range";
}

TEST(BudgetTables, RefuseLimitsOfAnErrorAboutANominalValue) {
    const auto limits = [](const std::string& result, const std::string& role, const std::string& about) {
        std::string keys = meter(
            k_columns, R"j(, "certificate": {"specifications": [{"id": "s", "results": [")j" + result +
                           R"j("], "unit": "mV", "rule": {"id": "DR-01"}, "limits": {"by": "accuracy", "of": "V_s",
                "about": ")j" +
                           about + R"j(", "accuracy": [{"percent_of_reading": 1}]}}]})j");
        keys.replace(keys.find(R"j("role": "error")j"), 15, R"j("role": ")j" + role + "\"");
        return keys;
    };
    for (const std::string role : {"error", "deviation", "correction"}) {
        for (const std::string result : {"E", "E*", "E[2]"}) {
            for (const std::string about : {"nominal", "V_s", "V_x"}) {
                expect_refusal(limits(result, role, about), k_limits_not_meant, "has the role \"" + role + "\"");
            }
        }
    }
    EXPECT_TRUE(budget_refusals(limits("E", "measured_value", "nominal"), k_points).empty());
}

/// Limits in a column that no specification takes would be other ones than those of the verdicts.
TEST(BudgetTables, TellLimitsOfPointsThatNoSpecificationTakes) {
    const auto told = [](const std::string& result, const std::string& limits, const std::string& mpe_of_low,
                         const std::string& column) {
        const std::string keys =
            k_meter + R"j(, "points": {"columns": {"range": "text"}, "list": [
            {"point": "low", "range": "1 V", "V_s": 1, "V_x": {"observations": [1.01, 1.02]})j" +
            mpe_of_low +
            R"j(}, {"point": "high", "range": "1 V", "V_s": 2, "V_x": {"observations": [2.01, 2.02]}, ")j" + column +
            R"j(": 0.5}]}, "certificate": {"specifications": [{"id": "s", "results": [")j" + result +
            R"j("], "unit": "mV", "rule": {"id": "DR-01"}, )j" + limits + "}]}";
        std::string all;
        for (const gum::Diagnostic& one : read_budget(keys).warnings) {
            all += one.code == k_warn_extra_column.code ? gum::message(one) : "";
        }
        return all;
    };
    const std::string by_points = R"j("limits": {"by": "points"})j", constant = R"j("lower": -1, "upper": 1)j";
    const std::string accuracy =
        R"j("limits": {"by": "accuracy", "of": "V_s", "accuracy": [{"percent_of_reading": 1}]})j";
    for (const std::string column : {"mpe", "limit_low", "limit_high"}) {
        SCOPED_TRACE(column);
        const std::string stated = ", \"" + column + "\": 0.4";
        EXPECT_EQ(told("E", by_points, stated, column), "");
        EXPECT_EQ(told("E[high]", by_points, "", column), "");
        for (const std::string& other : {constant, accuracy}) {
            EXPECT_THAT(told("E", other, stated, column), HasSubstr("\"low\", \"high\", and no specification"));
            EXPECT_THAT(told("E", other, "", column), HasSubstr("the point \"high\", and no specification"));
        }
        EXPECT_THAT(told("E[high]", by_points, stated, column), HasSubstr("the point \"low\", and no specification"));
        EXPECT_THAT(told("F", by_points, stated, column), HasSubstr("no specification takes them"));
    }
}

/// What a specification does not name needs no limits of it.
TEST(BudgetTables, AskLimitsOfThePointsThatASpecificationNames) {
    const auto keys = [](const std::string& result) {
        return k_meter + R"j(, "points": {"columns": {"range": "text"}, "list": [
            {"point": "low", "range": "1 V", "V_s": 1, "V_x": {"observations": [1.01, 1.02]}, "mpe": 0.5},
            {"point": "high", "range": "1 V", "V_s": 2, "V_x": {"observations": [2.01, 2.02]}}]},
            "certificate": {"specifications": [{"id": "s", "results": [")j" +
               result + R"j("], "unit": "mV", "rule": {"id": "DR-01"}, "limits": {"by": "points"}}]})j";
    };
    EXPECT_TRUE(budget_refusals(keys("E[low]"), {}).empty());
    expect_refusal(keys("E"), k_point_without_limit, "at the point \"high\"", {});
    expect_refusal(keys("E[high]"), k_point_without_limit, "at the point \"high\"", {});
}

/// A weight of 50 g has a mass of 50.00001 g: limits by steps are of nominal values.
TEST(BudgetTables, TellWhereAMeasuredValuePassesTheEndOfAStep) {
    const auto codes = [](const std::string& role, double first, double second, double last_step) {
        const std::string keys = R"j("model": ["E = x - m"],
            "inputs": {"m": {"unit": "g", "U": 1e-5, "k": 2)j" +
                                 role + R"j(}, "x": {"unit": "g", "u": 1e-5}},
            "points": [{"m": )j" +
                                 text::shortest(first) + R"j(, "x": 50}, {"m": )j" + text::shortest(second) +
                                 R"j(, "x": 100}],
            "certificate": {"specifications": [{"id": "s", "results": ["E"], "unit": "mg", "rule": {"id": "DR-01"},
                "limits": {"by": "steps", "arguments": [{"name": "m", "unit": "g", "of": "m"}],
                           "steps": [{"up_to": 50, "mpe": 0.5}, {"up_to": )j" +
                                 text::shortest(last_step) + R"j(, "mpe": 1}]}}]})j";
        std::set<std::string> all;
        for (const gum::Diagnostic& told : read_budget(keys).warnings) {
            all.insert(told.code);
        }
        return all.contains("GC-WARN-0016");
    };
    EXPECT_TRUE(codes("", 50.00001, 100.0, 200.0));
    EXPECT_FALSE(codes("", 50.0, 49.99999, 200.0));
    EXPECT_FALSE(codes("", 51.0, 99.0, 200.0)) << "far behind the end of a step nothing is in doubt";
    EXPECT_FALSE(codes(R"j(, "role": "nominal")j", 50.00001, 100.0, 200.0)) << "that is what is meant";
}

TEST(BudgetTables, RefuseAPointWithoutTheLimitsOfItsSpecification) {
    const auto limits = [](const std::string& how) {
        return meter(k_columns, R"j(, "certificate": {"specifications": [{"id": "s", "results": ["E"], "unit": "mV",
            "rule": {"id": "DR-01"}, "limits": )j" +
                                    how + "}]}");
    };
    expect_refusal(limits(R"j({"by": "points"})j"), k_point_without_limit,
                   "the points \"1\", \"2\": the point states no limit");
    expect_refusal(
        limits(R"j({"by": "accuracy", "of": "V_s", "accuracy": [{"range": "10 V", "percent_of_reading": 1}]})j"),
        k_point_without_limit, "the point \"1\": the accuracy is not stated for the range \"100 mV\"");
    expect_refusal(
        limits(
            R"j({"by": "steps", "arguments": [{"name": "L", "unit": "V", "of": "W"}], "steps": [{"up_to": 1, "mpe": 1}]})j"),
        k_table_column, "\"W\" is nothing that the points of this job have");
    expect_refusal(limits(R"j({"by": "accuracy", "of": "reference", "accuracy": [{"percent_of_reading": 1}]})j"),
                   k_table_column, "\"reference\" is the role of \"V_s\", and no column of the points");
    EXPECT_TRUE(budget_refusals(limits(R"j({"by": "accuracy", "of": "V_s", "accuracy": [{"percent_of_reading": 1}]})j"),
                                k_points)
                    .empty());
}

/// A standard with four calibrations of four nominal values.
std::string calibrated_standard(const std::string& drift, const std::string& interpolation) {
    std::string calibrations;
    const std::vector<std::string> days{"2022-03-01", "2023-03-06", "2024-03-04", "2026-03-02"};
    for (std::size_t c = 0; c < days.size(); ++c) {
        std::string lines;
        for (int n = 0; n <= 60; n += 20) {
            const double value = n * 1.0001 + 0.001 * static_cast<double>(c * (c % 2U + 1U));
            lines += (n > 0 ? "," : "") + std::string(R"({"nominal": )") + std::to_string(n) + R"(, "value": )" +
                     std::to_string(value) + R"(, "unit": "bar", "U": )" + std::to_string(0.004 + n * 1e-4) +
                     R"(, "k": 2, "nu": 30})";
        }
        calibrations += (c > 0 ? "," : "") + std::string(R"({"calibrated": ")") + days[c] +
                        R"(", "valid_to": "2027-03-31", "certificate": "C", "issuer": "I", "route": "2",
                            "issuer_accreditation": "A", "results": [)" +
                        lines + "]}";
    }
    return R"({"schema": "gumcert/standard/1", "id": "PR-1", "description": "Calibrator", "calibrations": [)" +
           calibrations + R"(], "drift": )" + drift +
           (interpolation.empty() ? "" : R"(, "interpolation": ")" + interpolation + "\"") + "}";
}

// Readers of a certificate take every printed digit of a reference value for one that somebody measured.
TEST(BudgetTables, PrintNoDigitOfAStandardBehindItsUncertainty) {
    for (const char* drift :
         {R"({"model": "none", "reason": "r"})", R"({"model": "limit_per_year", "limit": 0.0123, "unit": "bar"})",
          R"({"model": "linear", "weights": "equal"})", R"({"model": "linear", "weights": "by_uncertainty"})",
          R"({"model": "last_difference"})"}) {
        for (const std::string interpolation : {"", "nearest", "linear"}) {
            for (const std::string take : {"value", "deviation"}) {
                SCOPED_TRACE(drift + (" " + interpolation + " " + take));
                const std::string at = interpolation.empty() ? "0\n20\n40\n60\n" : "0\n7\n20\n31.3\n40\n59\n60\n";
                const BudgetJob job = read_budget(
                    R"j("laboratory": "lab", "model": ["E = p_x - p_s"], "inputs": {
                        "p_x": {"unit": "bar", "value": 1, "u": 0.1},
                        "p_s": {"standard": "PR-1", "unit": "bar", "date": "2026-11-19", "take": ")j" +
                        take + R"j("}}, "outputs": {"E": {"unit": "bar"}}, "points": {"file": "points.csv"},
                        "tables": [{"columns": ["p_s", "E", "U"]}])j",
                    {{"points.csv", "p_s.at\n" + at},
                     {"lab/standards/PR-1.json", calibrated_standard(drift, interpolation)}});
                const auto column = std::find_if(job.point_columns.begin(), job.point_columns.end(),
                                                 [](const auto& c) { return c.name == "p_s"; });
                ASSERT_NE(column, job.point_columns.end());
                EXPECT_EQ(column->decimals, "of_uncertainty");
                for (std::size_t p = 0; p < job.points.size(); ++p) {
                    const double u =
                        job.inputs[1].unit.difference_from_si(gum::input_total(gum::input_at(job, 1, p)).u);
                    ASSERT_GT(u, 0.0);
                    const int justified = 1 - static_cast<int>(std::floor(std::log10(u)));  // two digits of u
                    EXPECT_LE(certificate::decimals_of(column->printed[p]), justified) << column->printed[p];
                    EXPECT_NEAR(certificate::number_of(column->printed[p]).value(), column->values[p].value(),
                                0.51 * std::pow(10.0, 1 - justified));
                }
            }
        }
    }
}

TEST(BudgetTables, RoundMeansThatTheJobStatesToo) {
    const BudgetJob job = read_budget(R"j("model": ["E = x - m - n"], "inputs": {
            "x": {"unit": "V"}, "n": {"unit": "V", "value": 0.125, "u": 0.1},
            "m": {"unit": "V", "observations": [1.01, 1.02, 1.02]}},
            "outputs": {"E": {"unit": "V"}},
            "points": [{"x": {"value": 1, "u": 0.1}}, {"x": {"value": 2, "u": 0.1}}],
            "tables": [{"columns": ["m", "n", "E", "U"]}])j");
    for (const certificate::PointColumn& column : job.point_columns) {
        if (column.name == "m") {  // 1.016666…, u = 0.0033
            EXPECT_THAT(column.printed, ElementsAre("1.0167", "1.0167"));
        } else if (column.name == "n") {
            EXPECT_THAT(column.printed, ElementsAre("0.125", "0.125")) << "as it was written";
        }
    }
}

// What a table shows, or a limit depends on, is used, though no result depends on it.
TEST(BudgetTables, AndLimitsUseInputs) {
    const auto warnings = [](const std::string& more) {
        std::vector<std::string> codes;
        for (const gum::Diagnostic& one : read_budget(R"j("model": ["E = x"], "inputs": {"x": {"unit": "mm", "u": 0.1},
                          "n": {"unit": "mm", "constant": true)j" +
                                                      more + R"j(, "points": [{"x": 1, "n": 10}, {"x": 2, "n": 20}])j")
                                              .warnings) {
            codes.push_back(one.code);
        }
        return codes;
    };
    const std::string outputs = R"j("outputs": {"E": {"unit": "mm"}})j";
    EXPECT_THAT(warnings("}}, " + outputs), ElementsAre(k_warn_unused_input.code));
    EXPECT_THAT(warnings(R"j(, "role": "nominal"}}, )j" + outputs), ElementsAre()) << "a column by its role";
    EXPECT_THAT(warnings("}}, " + outputs + R"j(, "tables": [{"columns": ["n", "E", "U"]}])j"), ElementsAre());
    const std::string table =
        outputs + R"j(, "tables": [{"columns": ["E", "U"]}], "certificate": {"status": "specimen")j";
    EXPECT_THAT(warnings("}}, " + table + "}"), ElementsAre(k_warn_unused_input.code));
    EXPECT_THAT(warnings("}}, " + table +
                         R"j(, "specifications": [{"id": "s", "results": ["E"], "unit": "mm", "rule": {"id": "DR-06"},
                "limits": {"by": "expression", "arguments": [{"name": "L", "unit": "mm", "of": "n"}],
                           "expression": "0.02 + 0.0001*L"}}]})j"),
                ElementsAre());
    EXPECT_THAT(warnings("}}, " + table + R"j(, "accreditation": {"body": "B", "number": "1", "scope": [{"id": "a",
                "results": ["E"], "capability": {"form": "function", "unit": "mm", "expression": "0.1 + 0*L",
                "arguments": [{"name": "L", "unit": "mm", "of": "n"}]}}]}})j"),
                ElementsAre());
}

}  // namespace
}  // namespace gumcert::jobs
