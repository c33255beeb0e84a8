#include "laboratory/recalibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/support/sample_standard.h"

namespace gumcert::laboratory {
namespace {

IntervalPlan staircase() {
    IntervalPlan plan;
    plan.limit = 1.0;
    plan.unit = "V";
    plan.present_days = 365;
    plan.extend_by = 1.5;
    plan.reduce_by = 0.7;
    plan.least_days = 100;
    plan.most_days = 500;
    return plan;
}

TEST(RecalibrationTest, StaircaseStepsAtEightyPercentAndAtTheLimit) {
    IntervalPlan plan = staircase();
    plan.most_days = 1000;
    EXPECT_EQ(staircase_interval(plan, 0.8), 547);  // 365·1.5 = 547.5
    EXPECT_EQ(staircase_interval(plan, -0.81), 365);
    EXPECT_EQ(staircase_interval(plan, 1.0), 365);
    EXPECT_EQ(staircase_interval(plan, -1.01), 255);
    plan.most_days = 500;
    EXPECT_EQ(staircase_interval(plan, 0.0), 500);
    plan.least_days = 300;
    EXPECT_EQ(staircase_interval(plan, 2.0), 300);
}

TEST(RecalibrationTest, ControlChartEndsOnTheLastDayWithinTheLimit) {
    const std::vector<SeriesPoint> series{{-200.0, 8.0, 0.1}, {-100.0, 9.05, 0.1}, {0.0, 10.0, 0.1}};
    const long days = control_chart_interval(series, false, 3.0, 2.0, 3653);
    const auto bound = [&](long day) {
        const Drift drift = linear_drift(series, false, static_cast<double>(day));
        return std::abs(drift.value) + 2.0 * drift.u;
    };
    EXPECT_GT(days, 0);
    EXPECT_LE(bound(days), 3.0);
    EXPECT_GT(bound(days + 1), 3.0);
    EXPECT_EQ(control_chart_interval(series, false, 3.0, 2.0, 30), 30);
    EXPECT_EQ(control_chart_interval(series, false, 1e-6, 2.0, 3653), 0);
}

TEST(RecalibrationTest, HoursAreCountedInPlaceOfDays) {
    IntervalPlan plan;
    plan.hours = 500.0;
    plan.hours_at_calibration = 100.0;
    const TimeInUse time = time_in_use(plan, 300.0, 100.0);
    EXPECT_EQ(time.used, 200.0);
    EXPECT_EQ(time.left, 300.0);
    EXPECT_EQ(time.days_left, 150);
    EXPECT_EQ(time_in_use(plan, 700.0, 100.0).left, -100.0);
    EXPECT_FALSE(time_in_use(plan, 100.0, 100.0).days_left);
}

TEST(RecalibrationTest, TheRecordProposesADay) {
    StandardRecord record = test::three_calibrations();
    const CalibrationResult& line = record.calibrations.back().results.front();
    EXPECT_FALSE(next_calibration(record, line));
    record.interval = staircase();  // found 2 V from the value before, outside of 1 V: 365·0.7 = 255 days
    EXPECT_EQ(next_calibration(record, line)->days, 255);
    EXPECT_EQ(next_calibration(record, line)->due, "2026-09-13");
    record.interval->limit = 2100.0;
    record.interval->unit = "mV";
    EXPECT_EQ(next_calibration(record, line)->days, 365);  // between 80 % and all of it
    record.interval->limit = 2000.0;
    EXPECT_EQ(next_calibration(record, line)->days, 365);  // on the limit is within it
    record.interval->limit = 1.0;
    record.interval->unit = "V";
    record.interval->method = IntervalMethod::control_chart;
    EXPECT_EQ(next_calibration(record, line)->days, 100);  // the limit is not kept on the first day: least_days
    record.interval->method = IntervalMethod::in_use_time;
    record.interval->hours = 500.0;
    record.interval->readings = {{"2026-04-11", 250.0}};
    EXPECT_EQ(next_calibration(record, line)->due, "2026-07-20");  // 250 h in 100 days, 250 h more
    record.interval->readings.clear();
    EXPECT_EQ(next_calibration(record, line)->due, "");
}

// One plan for a calibrator with lines from 1 V to 1000 V: a limit in ppm is a share of the nominal value, as of a drift.
TEST(RecalibrationTest, ARelativeLimitIsAShareOfTheNominalValue) {
    StandardRecord record = test::three_calibrations();
    record.interval = staircase();
    CalibrationResult& line = record.calibrations.back().results.front();
    for (const IntervalMethod method : {IntervalMethod::staircase, IntervalMethod::control_chart}) {
        record.interval->method = method;
        for (const double limit : {1.0, 1.9, 2.1, 2.4, 2.6, 5.0, 50.0}) {  // V
            record.interval->limit = limit;
            record.interval->unit = "V";
            const std::string day = next_calibration(record, line)->due;
            for (const auto& [unit, share] : {std::pair("ppm", 1e-6), std::pair("percent", 1e-2)}) {
                for (const double nominal : {10.0, -10.0, 1000.0}) {
                    for (Calibration& calibration : record.calibrations) {
                        calibration.results.front().nominal = nominal;
                    }
                    record.interval->limit = limit / std::abs(nominal) / share;
                    record.interval->unit = unit;
                    EXPECT_EQ(next_calibration(record, line)->due, day) << limit << " V, " << unit << " of " << nominal;
                }
            }
        }
    }
    const auto refused = [&] {
        try {
            static_cast<void>(next_calibration(record, line));
            return std::string();
        } catch (const gum::InputError& error) {
            return error.diagnostics().front().code + " " + error.diagnostics().front().what;
        }
    };
    line.nominal.reset();
    EXPECT_EQ(refused(), "GC-LAB-0013 a limit in \"percent\" of a line without a nominal value");
    record.interval->unit = "A";
    EXPECT_EQ(refused(), "GC-LAB-0013 a limit in \"A\" of a value in \"V\"");
}

// 10.005 - 10.0042 is 0.0008 in decimal numbers, and more than that in binary ones.
TEST(RecalibrationTest, FindsWhatTheDigitsOfTheCertificatesSay) {
    StandardRecord record = test::three_calibrations();
    record.interval = staircase();
    record.interval->most_days = 1000;
    std::vector<Calibration>& calibrations = record.calibrations;
    const auto next = [&](double before, double last, double limit) {
        calibrations[calibrations.size() - 2].results.front().value = before;
        calibrations.back().results.front().value = last;
        record.interval->limit = limit;
        return *next_calibration(record, calibrations.back().results.front());
    };
    for (const double start : {10.0042, 100.0037, 1.0001, 999.1}) {
        EXPECT_EQ(next(start, start + 0.0008, 0.001).days, 547) << start;
        EXPECT_EQ(next(start, start + 0.001, 0.001).days, 365) << start;
        EXPECT_EQ(next(start, start - 0.0011, 0.001).days, 255) << start;
    }
    EXPECT_EQ(next(10.0041, 10.005, 0.002).because, "staircase: found 0.00090 V from its value");
    // The number that is told gives the interval that is told.
    EXPECT_EQ(next(10.0, 10.01, 0.01).because, "staircase: found 0.010 V from its value");
    EXPECT_EQ(next(10.0, 10.0104, 0.01).days, 255);
    EXPECT_EQ(next(10.0, 10.0104, 0.01).because, "staircase: found 0.0104 V from its value");
    EXPECT_EQ(next(10.0, 9.99196, 0.01).because, "staircase: found -0.00804 V from its value");
    EXPECT_EQ(next(10.005, 10.005, 0.002).because, "staircase: found 0 V from its value");
}

TEST(RecalibrationTest, DaysAreThoseOfTheCalendar) {
    EXPECT_EQ(days_after("2024-02-28", 1), "2024-02-29");
    EXPECT_EQ(days_after("2026-12-31", 1), "2027-01-01");
    EXPECT_EQ(days_after("2026-03-01", -1), "2026-02-28");
    EXPECT_EQ(days_after("", 1), "");
}

}  // namespace
}  // namespace gumcert::laboratory
