#include "laboratory/standard_value.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_standard.h"

namespace gumcert::laboratory {
namespace {

const std::string k_day = "2026-01-11";  // ten days after the last calibration

StandardRecord curve() {
    StandardRecord record = test::three_calibrations();
    record.calibrations.back().results = {test::line_at(0.0, 0.0, 0.2), test::line_at(10.0, 10.1, 0.4),
                                          test::line_at(20.0, 20.4, 0.2)};
    return record;
}

std::string code_of(const StandardRecord& record, const StandardUse& use) {
    try {
        (void)value_of_standard(record, use);
    } catch (const gum::InputError& error) {
        return error.diagnostics().front().code;
    }
    return "";
}

TEST(StandardValueTest, ACalibratedValueIsTakenAsItStands) {
    const StandardRecord record = test::three_calibrations();
    const StandardValue value = value_of_standard(record, {.date = k_day});
    EXPECT_EQ(value.value, 10.0);
    EXPECT_EQ(value.U, 0.2);
    EXPECT_EQ(value.k, 2.0);
    EXPECT_EQ(value.days, 10.0);
    EXPECT_EQ(value.calibration, &record.calibrations.back());
    EXPECT_EQ(value.drift.u, 0.0);
    EXPECT_EQ(value_of_standard(record, {.date = "2025-06-01"}).value, 8.0);  // by the calibration of that day
}

TEST(StandardValueTest, DriftIsThatOfTheModel) {
    StandardRecord record = test::three_calibrations();
    record.drift = {DriftKind::limit_per_year, "", 3652.5, "mV", false};
    EXPECT_NEAR(value_of_standard(record, {.date = k_day}).drift.half_width, 0.1, 1e-12);
    record.drift = {DriftKind::last_difference, "", 0.0, "", false};
    EXPECT_DOUBLE_EQ(value_of_standard(record, {.date = k_day}).drift.half_width, 2.0);
    record.drift = {DriftKind::linear, "", 0.0, "", false};
    EXPECT_NEAR(value_of_standard(record, {.date = "2027-01-01"}).drift.value, 4.0 / 3.0, 0.005);  // 366, 365, 365 days
    EXPECT_EQ(code_of(record, {.date = "2025-06-01"}), "GC-LAB-0012");  // two calibrations up to then
    record.drift = {DriftKind::limit_per_year, "", 1.0, "K", false};
    EXPECT_EQ(code_of(record, {.date = k_day}), "GC-LAB-0013");
}

// One limit for a calibrator: 10 ppm of 1 V and of 1000 V are not the same voltage.
TEST(StandardValueTest, ARelativeDriftIsAShareOfTheNominalValue) {
    StandardRecord record = curve();
    record.drift = {DriftKind::limit_per_year, "", 3652.5, "ppm", false};
    EXPECT_NEAR(value_of_standard(record, {.at = 10.0, .date = k_day}).drift.half_width, 1e-3, 1e-15);
    record.drift.unit = "percent";
    EXPECT_NEAR(value_of_standard(record, {.at = 20.0, .date = k_day}).drift.half_width, 20.0, 1e-12);
    CalibrationResult& line = record.calibrations.back().results[1];
    line.value = 0.1;  // an error, not near its nominal value
    EXPECT_NEAR(value_of_standard(record, {.at = 10.0, .date = k_day}).drift.half_width, 10.0, 1e-12);
    line.nominal_unit = "mV";  // of 10 mV, in V
    EXPECT_NEAR(value_of_standard(record, {.at = 10.0, .date = k_day}).drift.half_width, 0.01, 1e-15);
    line.nominal_unit = "degC";  // a resistance thermometer
    EXPECT_EQ(code_of(record, {.at = 10.0, .date = k_day}), "GC-LAB-0013");
    EXPECT_EQ(code_of(record, {.at = 0.0, .date = k_day}), "GC-LAB-0013");
    line.nominal_unit.clear();
    line.unit = "degC";
    EXPECT_EQ(code_of(record, {.at = 10.0, .date = k_day}), "GC-LAB-0013");
    record.calibrations.back().results = {test::line_at(10.0, 10.1, 0.4)};
    record.calibrations.back().results[0].nominal.reset();
    EXPECT_EQ(code_of(record, {.date = k_day}), "GC-LAB-0013");
}

TEST(StandardValueTest, SaysWhichLinesThereAre) {
    StandardRecord record = curve();
    record.calibrations.back().results[0].range = "1 V";
    record.calibrations.back().results[1].range = record.calibrations.back().results[2].range = "10 V";
    const auto said = [&](const StandardUse& use) {
        try {
            (void)value_of_standard(record, use);
        } catch (const gum::InputError& error) {
            return error.diagnostics().front().what + "; " + error.diagnostics().front().action;
        }
        return std::string();
    };
    EXPECT_THAT(said({.range = "10V", .at = 10.0, .date = k_day}),
                testing::HasSubstr("the lines of its certificate have range \"1 V\", \"10 V\""));
    EXPECT_THAT(said({.at = 10.0, .date = k_day}), testing::HasSubstr("have range \"1 V\", \"10 V\""));
    EXPECT_THAT(said({.range = "10 V", .at = 15.0, .date = k_day}), testing::HasSubstr("no calibrated value at 15 V"));
}

TEST(StandardValueTest, HistoryIsInOneUnit) {
    StandardRecord record = test::three_calibrations();
    CalibrationResult& first = record.calibrations.front().results.front();
    first.value = 7000.0;
    first.U = 200.0;
    first.unit = "mV";
    first.nominal_unit = "V";
    const Calibration& last = record.calibrations.back();
    const std::vector<SeriesPoint> series = history_of(record, last, last.results.front());
    ASSERT_EQ(series.size(), 3U);
    EXPECT_EQ(series[0].days, -731.0);
    EXPECT_DOUBLE_EQ(series[0].value, 7.0);
    EXPECT_DOUBLE_EQ(series[0].u, 0.1);
    first.unit = "A";
    EXPECT_THROW((void)history_of(record, last, last.results.front()), gum::InputError);
    record.calibrations.front().results.front().range = "100 V";  // another line
    EXPECT_EQ(history_of(record, last, last.results.front()).size(), 2U);
    EXPECT_EQ(drift_of(record, last, last.results.front(), 10.0).u, 0.0);
}

TEST(StandardValueTest, LinesAreTheSameByTheirNominalValueWithItsUnit) {
    struct Case {
        double earlier;
        const char* earlier_unit;
        double last;
        const char* last_unit;
        bool same;
    };
    // An empty unit is that of the value, V.
    for (const Case& c :
         {Case{10000.0, "mV", 10.0, "", true}, Case{10.0, "V", 10.0, "", true}, Case{0.01, "kV", 10000.0, "mV", true},
          Case{10.0, "mV", 10.0, "V", false}, Case{10.0, "mV", 10.0, "", false}, Case{10.0, "A", 10.0, "V", false},
          Case{68.0, "°F", 20.0, "°C", true}, Case{20.0, "°C", 20.0, "K", false}, Case{0.0, "mV", 0.0, "V", true},
          Case{0.1, "mm", 100.0, "µm", true}}) {
        StandardRecord record = test::three_calibrations();
        record.calibrations.erase(record.calibrations.begin());
        CalibrationResult& earlier = record.calibrations.front().results.front();
        CalibrationResult& last = record.calibrations.back().results.front();
        earlier.nominal = c.earlier;
        earlier.nominal_unit = c.earlier_unit;
        last.nominal = c.last;
        last.nominal_unit = c.last_unit;
        const Calibration& calibration = record.calibrations.back();
        EXPECT_EQ(history_of(record, calibration, last).size(), c.same ? 2U : 1U)
            << c.earlier << " " << c.earlier_unit << " and " << c.last << " " << c.last_unit;
        record.drift = {DriftKind::last_difference, "", 0.0, "", false};
        EXPECT_EQ(code_of(record, {.date = k_day}), c.same ? "" : "GC-LAB-0011");
    }
}

TEST(StandardValueTest, AValueInTwoUnitsIsNotChosenByTheOrderOfTheLines) {
    StandardRecord record = curve();
    CalibrationResult small = test::line_at(10.0, 0.0101, 0.0002);
    small.nominal_unit = "mV";
    record.calibrations.back().results.push_back(small);
    EXPECT_EQ(code_of(record, {.at = 10.0, .date = k_day}), "GC-LAB-0014");
    record.calibrations.back().results.back().range = "100 mV";
    EXPECT_EQ(value_of_standard(record, {.range = "100 mV", .at = 10.0, .date = k_day}).value, 0.0101);
    record.calibrations.back().results.back() = test::line_at(10.0, 10.1, 0.4);
    record.calibrations.back().results.back().nominal_unit = "V";
    EXPECT_EQ(code_of(record, {.at = 10.0, .date = k_day}), "") << "V in both";
}

TEST(StandardValueTest, NearestHasTheDifferenceToItsNeighbour) {
    StandardRecord record = curve();
    record.interpolation = Interpolation::nearest;
    const StandardValue value = value_of_standard(record, {.at = 14.0, .date = k_day});
    EXPECT_DOUBLE_EQ(value.value, 14.1);
    EXPECT_EQ(value.U, 0.4);
    EXPECT_NEAR(value.interpolation_half_width, 0.3 * 4.0 / 10.0, 1e-12);
    EXPECT_EQ(value.result, &record.calibrations.back().results[1]);
}

TEST(StandardValueTest, AnErrorOfTheNearerPointIsNotMoved) {
    StandardRecord record = curve();
    record.interpolation = Interpolation::nearest;
    for (CalibrationResult& line : record.calibrations.back().results) {
        line.value -= *line.nominal;  // 0, 0.1 and 0.4 V at 0, 10 and 20 V
    }
    const StandardValue value = value_of_standard(record, {.at = 14.0, .date = k_day});
    EXPECT_NEAR(value.value, 0.1, 1e-12);  // 4.1 V would be the distance to its neighbour, and no error
    EXPECT_NEAR(value.interpolation_half_width, 0.3 * 4.0 / 10.0, 1e-12);
}

TEST(StandardValueTest, LinearHasTheRemainderOfTheChord) {
    StandardRecord record = curve();
    record.interpolation = Interpolation::linear;
    const StandardValue value = value_of_standard(record, {.at = 12.5, .date = k_day});
    EXPECT_NEAR(value.value, 12.5 + 0.75 * 0.1 + 0.25 * 0.4, 1e-12);
    EXPECT_NEAR(value.U, 0.75 * 0.2 + 0.25 * 0.1, 1e-12);
    EXPECT_EQ(value.k, 1.0);
    // Second divided difference of the corrections 0, 0.1, 0.4 at 0, 10, 20: (0.03 - 0.01)/20 = 0.001.
    EXPECT_NEAR(value.interpolation_half_width, 2.5 * 7.5 * 0.001, 1e-12);
    record.calibrations.back().results.pop_back();
    EXPECT_EQ(code_of(record, {.at = 5.0, .date = k_day}), "GC-LAB-0015");
}

TEST(StandardValueTest, LinesOfSeveralRangesOrUnitsAreNotMixed) {
    StandardRecord record = curve();
    record.interpolation = Interpolation::nearest;
    std::vector<CalibrationResult>& lines = record.calibrations.back().results;
    lines[2].range = "20 V";
    EXPECT_EQ(code_of(record, {.at = 20.0, .date = k_day}), "GC-LAB-0014");
    EXPECT_EQ(code_of(record, {.range = "20 V", .at = 20.0, .date = k_day}), "");
    lines[2].range.clear();
    lines[2].unit = "mV";
    EXPECT_EQ(code_of(record, {.at = 14.0, .date = k_day}), "GC-LAB-0013");
}

TEST(StandardValueTest, WhatIsNotDecidedIsRefused) {
    const StandardRecord record = curve();
    EXPECT_EQ(code_of(record, {.date = k_day}), "GC-LAB-0014");                     // which line?
    EXPECT_EQ(code_of(record, {.at = 5.0, .date = k_day}), "GC-LAB-0014");          // no interpolation
    EXPECT_EQ(code_of(record, {.at = 30.0, .date = k_day}), "GC-LAB-0014");         // beyond
    EXPECT_EQ(code_of(record, {.at = 10.0, .date = "2020-01-01"}), "GC-LAB-0014");  // before
    EXPECT_EQ(code_of(record, {.range = "x", .at = 10.0, .date = k_day}), "");      // unknown, and told by the gate
}

}  // namespace
}  // namespace gumcert::laboratory
