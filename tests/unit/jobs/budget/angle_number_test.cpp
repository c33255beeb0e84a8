#include "jobs/budget/angle_number.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "certificate/point_limits.h"
#include "certificate/point_tables.h"
#include "jobs/input_codes.h"
#include "tests/support/budget_campaign.h"

namespace gumcert::jobs {
namespace {

using test::budget_refusals;
using test::read_budget;
using testing::ElementsAre;
using testing::HasSubstr;

const std::string k_table =
    R"j("model": ["E = phi_x + d_x - phi_s"],
        "inputs": {"phi_x": {"unit": "arcsec", "role": "indication", "form": "sexagesimal"},
                   "d_x": {"unit": "arcsec", "value": 0, "resolution": 0.1},
                   "phi_s": {"unit": "arcsec", "constant": true}},
        "outputs": {"E": {"unit": "arcsec", "role": "error"}},
        "points": {"file": "points.csv", "columns": {
            "nominal": {"unit": "arcsec", "role": "nominal", "form": "sexagesimal"}}})j";

std::string refusal(const std::string& keys, const test::BudgetFiles& files = {}) {
    std::string all;
    for (const gum::Diagnostic& one : budget_refusals(keys, files)) {
        all += one.code + " " + gum::message(one) + "\n";
    }
    return all;
}

TEST(AngleNumber, IsOneOfSecondsOrMinutes) {
    ProblemList problems("job.json");
    const auto angle = angle_number("-12° 30' 05.00\"", "arcsec", "here", problems);
    ASSERT_TRUE(angle);
    EXPECT_EQ(angle->value, -45005.0);
    EXPECT_EQ(angle->written, "-45005.00");
    EXPECT_EQ(angle_number("12° 30.5'", "arcmin", "here", problems).value().value, 750.5);
    EXPECT_EQ(problems.refusals(), 0U);
    for (const char* unit : {"deg", "m", "1", "rad"}) {
        EXPECT_FALSE(angle_number("12° 30'", unit, "here", problems)) << unit;
    }
    EXPECT_FALSE(angle_number("12° 30' 05\"", "arcmin", "here", problems));
    EXPECT_FALSE(angle_number("12° 75'", "arcsec", "here", problems));
    EXPECT_EQ(problems.refusals(), 6U);
}

TEST(AngleNumber, HasTheDecimalsOfItsLastPart) {
    const nlohmann::json angle = "12° 30' 05.00\"";
    EXPECT_EQ(decimals_of_angle(&angle, "arcsec"), 2);
    EXPECT_EQ(decimals_of_angle(&angle, "deg"), std::nullopt);
    EXPECT_EQ(decimals_of_angle(nullptr, "arcsec"), std::nullopt);
    const nlohmann::json number = 5.0;
    EXPECT_EQ(decimals_of_angle(&number, "arcsec"), std::nullopt);
}

TEST(AngleNumber, StandsInCellsOfAnyTable) {
    for (const char* table : {"nominal,phi_s,phi_x.1,phi_x.2\n"
                              "0°,0.12'',0° 00' 00.3'',0° 00′ 00.2″\n"
                              "12° 30',12° 30′ 04.98″,\"12° 30' 05.0\"\"\",45005.4''\n",
                              "nominal;phi_s;phi_x.1;phi_x.2\n"
                              "0;0,12'';0° 00' 00,3'';0° 00′ 00,2″\n"
                              "12,5°;12° 30′ 04,98″;12° 30' 05,0'';12° 30' 05,4''\n"}) {
        SCOPED_TRACE(table);
        const BudgetJob job = read_budget(k_table, {{"points.csv", table}});
        ASSERT_EQ(job.points.size(), 2U);
        const certificate::PointColumn& nominal = job.point_columns.at(0);
        EXPECT_EQ(nominal.values, (std::vector<std::optional<double>>{0.0, 45000.0}));
        EXPECT_THAT(nominal.printed, ElementsAre("0", "45000"));
        EXPECT_EQ(nominal.form, "sexagesimal");
        const certificate::PointColumn& read = *certificate::column_named(job.point_columns, "phi_x");
        EXPECT_THAT(read.printed, ElementsAre("0.25", "45005.20"));
        EXPECT_EQ(read.form, "sexagesimal");
    }
}

TEST(AngleNumber, StandsInTheJob) {
    const BudgetJob job = read_budget(
        R"j("model": ["E = a - b"],
            "inputs": {"a": {"unit": "arcsec", "u": 0.1, "role": "indication"},
                       "b": {"unit": "arcsec", "value": "30° 00' 00.50\"", "u": 0.1, "role": "reference"}},
            "outputs": {"E": {"unit": "arcsec"}},
            "points": {"columns": {"n": {"unit": "arcmin", "form": "sexagesimal"}},
                       "list": [{"a": "30° 00' 01.0\"", "n": "30°"}, {"a": {"value": "-0° 00' 03\""}, "n": "0° 30.5'"}]})j");
    EXPECT_THAT(job.point_columns.at(0).printed, ElementsAre("1800", "30.5"));
    EXPECT_THAT(certificate::column_named(job.point_columns, "a")->printed, ElementsAre("108001.0", "-3"));
    EXPECT_THAT(certificate::column_named(job.point_columns, "b")->printed, ElementsAre("108000.50", "108000.50"));
}

TEST(AngleNumber, StandsInReadingsAndLimitsOfTheJob) {
    const BudgetJob job = read_budget(
        R"j("model": ["E = a + b"],
            "inputs": {"a": {"unit": "arcsec", "role": "indication", "form": "sexagesimal",
                             "observations": ["12° 30' 05\"", "12° 30' 05.5\"", "12° 30' 07.5\""]},
                       "b": {"unit": "arcmin", "limits": ["-0° 01'", "0° 01.5'"]}},
            "outputs": {"E": {"unit": "arcsec"}},
            "points": [{}, {"a": {"observations": ["-0° 00' 01.50\"", "0° 00' 00.5\"", 0]}}])j");
    EXPECT_THAT(certificate::column_named(job.point_columns, "a")->printed, ElementsAre("45006.00", "-0.333"));
    const gum::StatedQuantity& a = job.inputs.at(0).components.front();
    EXPECT_EQ(a.observations.size(), 3U);
    EXPECT_EQ(a.observation_decimals, 1);
    constexpr double k_arcmin = 3.14159265358979323846 / 180.0 / 60.0;  // [rad]
    EXPECT_NEAR(job.inputs.at(1).components.front().value, 0.25 * k_arcmin, 1e-15);
}

TEST(AngleNumber, StandsBesideNoBareNumber) {
    const auto in_points = [](const std::string& points) {
        return refusal(R"j("inputs": {"X": {"unit": "arcsec", "u": 1}}, "points": {"columns": {
                           "n": {"unit": "arcsec"}, "t": "text"}, "list": )j" +
                       points + "}");
    };
    EXPECT_THAT(in_points(R"j([{"X": "30°"}, {"X": 30}])j"), HasSubstr("job.json#/points/list/1/X"));
    EXPECT_THAT(in_points(R"j([{"X": "30°"}, {"X": {"value": 30}}])j"), HasSubstr("GC-INPUT-0368"));
    EXPECT_THAT(in_points(R"j([{"X": 0, "n": "30°"}, {"X": 1, "n": 5.5}])j"), HasSubstr("\"5.5\" in \"n\""));
    EXPECT_EQ(in_points(R"j([{"X": "30°", "n": 5}, {"X": 0, "n": 1}])j"), "");
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "arcsec", "observations": ["12° 30' 05\"", 6]}})j"),
                HasSubstr("#/inputs/X/observations/1"));
    EXPECT_EQ(refusal(R"j("inputs": {"X": {"unit": "arcsec", "u": 1}},
                          "points": {"file": "points.csv", "columns": {"size": "text"}})j",
                      {{"points.csv", "X,size\n1,\"1/2\"\"\"\n2,3\n"}}),
              "")
        << "words are no angles";
}

TEST(AngleNumber, IsNoLimitInTheUnitOfASpecification) {
    const std::string job = R"j("inputs": {"X": {"unit": "arcsec", "u": 1}},
        "certificate": {"specifications": [{"id": "s", "results": ["X"], "unit": "arcsec", "rule": {"id": "DR-01"},
            "limits": {"by": "points"}}]}, "points": )j";
    EXPECT_THAT(refusal(job + R"j({"file": "points.csv"})j", {{"points.csv", "X,limit_high\n1°,1° 00' 05''\n"}}),
                HasSubstr("points.csv:2:4 — \"1° 00' 05''\" in a column of limits whose unit is not stated"));
    EXPECT_THAT(refusal(job + R"j([{"X": "1°", "limit_high": "1° 00' 05\""}])j"), HasSubstr("declare the column"));
    EXPECT_EQ(refusal(job + R"j({"list": [{"X": "1°", "limit_high": "1° 00' 05\""}],
                                 "columns": {"limit_high": {"unit": "arcsec"}}})j"),
              "");
}

TEST(AngleNumber, IsToldAsANumberWhereOnlyNumbersStand) {
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "arcsec", "value": "12°", "u": "0° 00' 02.50\""}})j"),
                HasSubstr("it is 2.5 in arcsec"));
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "arcsec", "groups": [["1'", "2'"], [3, 4]]}})j"),
                HasSubstr("it is 60 in arcsec"));
}

TEST(AngleNumber, IsRefusedWhereItMeansNoNumber) {
    const auto in_table = [](const std::string& rows) {
        return refusal(k_table, {{"points.csv", "nominal,phi_s,phi_x.1,phi_x.2\n" + rows}});
    };
    EXPECT_THAT(in_table("12° 60',0,0,1\n"), HasSubstr("GC-INPUT-0368"));
    EXPECT_THAT(in_table("12° 30',0,12.5° 5',1'\n"), HasSubstr("points.csv:2:11"));
    EXPECT_THAT(in_table("30°,0,0,1\n30,0,0,1\n"), HasSubstr("points.csv:3:1"));
    EXPECT_EQ(in_table("30°,0,0,1\n0,0,0,1\n"), "") << "0 is 0 in every unit";
    EXPECT_EQ(in_table("108000,0,0,1\n3.5,0,0,1\n"), "") << "numbers of the unit";
    EXPECT_THAT(in_table("12° 30' 05\",0,0,1\n"), HasSubstr("two apostrophes"));
    EXPECT_THAT(in_table("30°,0,12° 30' 05'',5\n"), HasSubstr("points.csv:2:20"))
        << "5 of the readings is no 12° 30' 05''";
    for (const char* const colons : {"12:30:05", "12 30 05.0", "-12:30"}) {
        EXPECT_THAT(in_table(std::string("30°,0,0,") + colons + "\n"), HasSubstr("each with its sign")) << colons;
    }
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "deg", "value": "12° 30'", "u": 0.1}})j"), HasSubstr("arcmin"));
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "arcsec", "value": "twelve", "u": 0.1}})j"),
                HasSubstr("must be a number"));
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "deg", "value": 12, "u": 0.1, "form": "sexagesimal"}},
                            "points": [{}])j"),
                HasSubstr("GC-INPUT-0368"));
    EXPECT_THAT(refusal(R"j("inputs": {"X": {"unit": "arcsec", "value": 12, "u": 0.1}},
                            "outputs": {"X": {"unit": "deg", "form": "sexagesimal"}}, "points": [{}])j"),
                HasSubstr("GC-INPUT-0368"));
}

}  // namespace
}  // namespace gumcert::jobs
