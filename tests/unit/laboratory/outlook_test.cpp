#include "laboratory/outlook.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::laboratory {
namespace {

using testing::HasSubstr;

/// Calibrated three times, a year apart; the value moves by 1 mV a year.
StandardRecord record_of(std::optional<IntervalPlan> plan = {}) {
    StandardRecord record;
    record.id = "STD-1";
    record.interval = std::move(plan);
    double value = 10.0;
    for (const char* day : {"2024-01-01", "2025-01-01", "2026-01-01"}) {
        Calibration& calibration = record.calibrations.emplace_back();
        calibration.calibrated = day;
        calibration.certificate = std::string("C ") + day;
        CalibrationResult& line = calibration.results.emplace_back();
        line.nominal = 10.0;
        line.value = value;
        line.unit = "V";
        line.U = 0.0001;
        line.k = 2.0;
        value += 0.001;
    }
    record.calibrations.back().valid_to = "2026-12-31";
    return record;
}

IntervalPlan staircase_plan() {
    IntervalPlan plan;
    plan.method = IntervalMethod::staircase;
    plan.limit = 2.0;
    plan.unit = "mV";
    plan.present_days = 300;
    plan.extend_by = 1.5;
    plan.reduce_by = 0.5;
    return plan;
}

TEST(CalibrationOutlook, FollowsTheLastDayOfUse) {
    const StandardRecord record = record_of();
    const CalibrationOutlook before = calibration_outlook(record, "2026-12-31");
    EXPECT_EQ(before.last, &record.calibrations.back());
    EXPECT_EQ(before.state, CalibrationState::valid);
    EXPECT_EQ(before.because, "");
    EXPECT_EQ(before.next, "");
    EXPECT_EQ(before.why, "the register states no plan of recalibration");
    const CalibrationOutlook after = calibration_outlook(record, "2027-01-01");
    EXPECT_EQ(after.state, CalibrationState::overdue);
    EXPECT_EQ(after.because, "valid until 2026-12-31");
}

TEST(CalibrationOutlook, FollowsThePlan) {
    StandardRecord record = record_of(staircase_plan());
    record.calibrations.back().valid_to = "";
    // Found 1 mV from its value, within 80 % of 2 mV: 300 d · 1.5 = 450 d after 2026-01-01.
    const CalibrationOutlook outlook = calibration_outlook(record, "2027-03-27");
    EXPECT_EQ(outlook.next, "2027-03-27");
    EXPECT_THAT(outlook.why, HasSubstr("staircase"));
    EXPECT_EQ(outlook.state, CalibrationState::valid);
    const CalibrationOutlook late = calibration_outlook(record, "2027-03-28");
    EXPECT_EQ(late.state, CalibrationState::overdue);
    EXPECT_EQ(late.because, "by its plan due on 2027-03-27");
}

TEST(CalibrationOutlook, SaysWhatCannotBeSaid) {
    StandardRecord record = record_of();
    record.calibrations.back().valid_to = "";
    EXPECT_EQ(calibration_outlook(record, "2030-01-01").state, CalibrationState::unknown);
    EXPECT_THAT(calibration_outlook(record, "2030-01-01").because, HasSubstr("no last day of use"));
    const CalibrationOutlook early = calibration_outlook(record, "2023-12-31");
    EXPECT_EQ(early.state, CalibrationState::not_calibrated);
    EXPECT_EQ(early.last, nullptr);
    IntervalPlan in_use;
    in_use.method = IntervalMethod::in_use_time;
    in_use.hours = 500.0;
    record.interval = in_use;
    const CalibrationOutlook unused = calibration_outlook(record, "2030-01-01");
    EXPECT_EQ(unused.next, "");
    EXPECT_EQ(unused.why, "in-use time: 0 h of 500 h used");
    EXPECT_EQ(unused.state, CalibrationState::unknown);
}

TEST(CalibrationOutlook, LooksAtADayOfThePast) {
    IntervalPlan chart;
    chart.method = IntervalMethod::control_chart;
    chart.limit = 5.0;
    chart.unit = "mV";
    StandardRecord record = record_of(chart);
    const CalibrationOutlook then = calibration_outlook(record, "2025-06-01");
    EXPECT_EQ(then.last, &record.calibrations[1]);
    EXPECT_EQ(then.next, "") << "a line needs three calibrations";
    EXPECT_FALSE(then.why.empty());
    EXPECT_NE(calibration_outlook(record, "2026-06-01").next, "");
    record.interval = staircase_plan();
    EXPECT_THAT(calibration_outlook(record, "2025-06-01").why, HasSubstr("belong to a later calibration"));
}

TEST(CalibrationOutlook, TakesTheEarliestLine) {
    StandardRecord record = record_of(staircase_plan());
    for (Calibration& calibration : record.calibrations) {
        CalibrationResult second = calibration.results.front();
        second.nominal = 100.0;
        second.value *= 10.0;  // 10 mV a year: beyond the limit
        calibration.results.push_back(second);
        CalibrationResult other = calibration.results.front();
        other.nominal = 1.0;
        other.unit = "ohm";
        calibration.results.push_back(other);
    }
    const CalibrationOutlook outlook = calibration_outlook(record, "2026-02-01");
    EXPECT_EQ(outlook.next, "2026-05-31") << "300 d · 0.5";
    EXPECT_THAT(outlook.why, HasSubstr("(100 V)"));
    EXPECT_THAT(outlook.why, HasSubstr("nothing can be said of 1 of 3 lines: "));
}

}  // namespace
}  // namespace gumcert::laboratory
