#include "laboratory/applicability.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "laboratory/outlook.h"
#include "laboratory/recalibration.h"
#include "tests/support/sample_standard.h"

namespace gumcert::laboratory {
namespace {

StandardRecord two_ranges() {
    StandardRecord record = test::three_calibrations();
    std::vector<CalibrationResult>& lines = record.calibrations.back().results;
    lines = {test::line_at(1.0, 1.01), test::line_at(10.0, 10.0), test::line_at(100.0, 99.0)};
    lines[0].range = "1 V";
    lines[1].range = lines[2].range = "100 V";
    return record;
}

Answer answer_of(const StandardRecord& record, const StandardUse& use) {
    return applicability(record, use).answer;
}

TEST(ApplicabilityTest, OneLineOnAValidDayIsEnough) {
    EXPECT_EQ(applicability(test::three_calibrations(), {.date = "2026-06-01"}), (Applicability{Answer::yes, ""}));
}

TEST(ApplicabilityTest, DaysAreThoseOfTheCalibration) {
    StandardRecord record = test::three_calibrations();
    EXPECT_EQ(answer_of(record, {.date = "2023-12-31"}), Answer::no);
    EXPECT_EQ(answer_of(record, {.date = "2027-12-31"}), Answer::yes);
    EXPECT_EQ(answer_of(record, {.date = "2028-01-01"}), Answer::no);
    EXPECT_EQ(answer_of(record, {}), Answer::unknown);
    record.calibrations.back().valid_to.clear();
    EXPECT_EQ(answer_of(record, {.date = "2028-01-01"}), Answer::unknown);
}

TEST(ApplicabilityTest, AgreesWithTheOverviewOnEveryDay) {
    // Overview and gate speak of one standard: what the one calls valid the other does not call unknown.
    for (const bool has_plan : {false, true}) {
        for (const char* valid_to : {"", "2026-09-30", "2028-09-30"}) {
            StandardRecord record = test::three_calibrations();
            record.calibrations.back().valid_to = valid_to;
            record.interval.reset();
            if (has_plan) {
                IntervalPlan& plan = record.interval.emplace();
                plan.method = IntervalMethod::staircase;
                plan.present_days = 500;
                plan.limit = 1000.0;
                plan.unit = record.calibrations.back().results.front().unit;
            }
            for (long day = 0; day < 2000; day += 7) {
                const std::string date = days_after(record.calibrations.back().calibrated, day);
                const CalibrationState state = calibration_outlook(record, date).state;
                const Answer answer = answer_of(record, {.date = date});
                EXPECT_EQ(answer == Answer::unknown, state == CalibrationState::unknown) << valid_to << " " << date;
                if (*valid_to == '\0' || !has_plan) {  // with both, a plan that is overdue is a finding of its own
                    EXPECT_EQ(answer == Answer::no, state == CalibrationState::overdue) << valid_to << " " << date;
                }
            }
        }
    }
}

TEST(ApplicabilityTest, QuantityRangeAndModeNarrowTheLines) {
    const StandardRecord record = two_ranges();
    const std::string day = "2026-06-01";
    EXPECT_EQ(answer_of(record, {.range = "1 V", .date = day}), Answer::yes);
    EXPECT_EQ(answer_of(record, {.range = "10 V", .date = day}), Answer::no);
    EXPECT_EQ(answer_of(record, {.date = day}), Answer::unknown);
    EXPECT_EQ(answer_of(record, {.range = "1 V", .mode = "AC", .date = day}),
              Answer::unknown);  // nothing is said of modes
    EXPECT_EQ(answer_of(record, {.quantity = "current", .range = "1 V", .date = day}), Answer::no);
    EXPECT_NE(applicability(record, {.range = "1 V", .mode = "AC", .date = day}).because.find("AC"), std::string::npos);
}

TEST(ApplicabilityTest, ValuesAreCalibratedOrBetweenCalibratedOnes) {
    StandardRecord record = two_ranges();
    StandardUse use{.range = "100 V", .at = 10.0, .date = "2026-06-01"};
    EXPECT_EQ(answer_of(record, use), Answer::yes);
    use.at = 50.0;
    EXPECT_EQ(answer_of(record, use), Answer::unknown);
    record.interpolation = Interpolation::nearest;
    EXPECT_EQ(answer_of(record, use), Answer::yes);
    use.at = 101.0;
    EXPECT_EQ(answer_of(record, use), Answer::no);
    use.at.reset();
    EXPECT_EQ(answer_of(record, use), Answer::unknown);
    record.calibrations.back().results[2].low = 90.0;
    record.calibrations.back().results[2].high = 110.0;
    use.at = 110.0;
    EXPECT_EQ(answer_of(record, use), Answer::yes);
    use.at = 110.1;
    EXPECT_EQ(answer_of(record, use), Answer::no);
    record.calibrations.back().results[1].nominal.reset();
    EXPECT_EQ(answer_of(record, use), Answer::unknown);
}

TEST(ApplicabilityTest, SaysTheValueWithItsUnit) {
    const StandardRecord record = two_ranges();
    EXPECT_THAT(applicability(record, {.range = "100 V", .at = 101.0, .date = "2026-06-01"}).because,
                testing::HasSubstr("101 V lies outside"));
    EXPECT_EQ(value_in_words(7.5, {}), "7.5");
    CalibrationResult volts, millivolts;
    volts.unit = "V";
    millivolts.unit = "V";
    millivolts.nominal_unit = "mV";
    EXPECT_EQ(value_in_words(7.5, {&volts}), "7.5 V");
    EXPECT_EQ(value_in_words(7.5, {&millivolts}), "7.5 mV");
    EXPECT_EQ(value_in_words(7.5, {&volts, &millivolts}), "7.5") << "nobody can tell which";
}

TEST(ApplicabilityTest, NoGoesBeforeUnknown) {
    const Applicability verdict = applicability(two_ranges(), {.date = "2030-01-01"});
    EXPECT_EQ(verdict.answer, Answer::no);
    EXPECT_NE(verdict.because.find("valid to 2027-12-31"), std::string::npos);
}

TEST(ApplicabilityTest, CandidatesAreTheLinesThatAreLeft) {
    const StandardRecord record = two_ranges();
    const Candidates found = candidates_for(record, {.range = "100 V", .date = "2026-06-01"});
    EXPECT_EQ(found.calibration, &record.calibrations.back());
    EXPECT_EQ(found.results.size(), 2U);
    EXPECT_TRUE(is_same_value(0.1 + 0.2, 0.3));
    EXPECT_FALSE(is_same_value(1.0, 1.0 + 1e-8));
}

}  // namespace
}  // namespace gumcert::laboratory
