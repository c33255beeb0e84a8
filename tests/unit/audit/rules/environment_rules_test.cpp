#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/row_meaning.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::found_by;
using testing::HasSubstr;

AuditSubject subject_at(double low, double high) {
    AuditedBudget budget = test::sound_budget();
    AuditedRow& row = budget.rows[5];
    row.unit = "K";
    row.origin = Origin::limits;
    row.origin_value = 0.5;
    AuditSubject subject = test::subject_with_certificate({budget});
    certificate::Condition condition;
    condition.kind = "temperature";
    condition.unit = "degC";
    condition.minimum = low;
    condition.maximum = high;
    condition.U = 0.1;
    condition.sensor = "EX-T1";
    subject.certificate->data.conditions = {condition};
    return subject;
}

TEST(EnvironmentRules, E02_takes_the_recorded_range_into_the_budget) {
    EXPECT_EQ(found_by(environment_rules(), "E02", subject_at(19.6, 20.6)), "");
    const auto findings = test::findings_of(environment_rules(), "E02", subject_at(19.0, 21.0));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_THAT(findings[0].what.english(), HasSubstr("±1 K about its middle, and the budget has ±0.5 K"));
    AuditedBudget corrected = test::sound_budget();
    findings[0].correct(corrected);
    EXPECT_NEAR(corrected.rows[5].used_u, 0.10, 1e-12);
}

/// A row in a budget of a result, and a condition of the room that swings by more than its half-width.
struct RowAndRoom {
    const char* quantity;
    const char* unit;
    double value, half_width;
    const char* result;  ///< unit of the result
    double c;
    const char* kind;
    const char* unit_of_room;
    double low, high;
};
std::size_t ranges_found(const RowAndRoom& is, bool measured) {
    AuditedBudget budget = test::sound_budget();
    budget.unit = is.result;
    AuditedRow& row = budget.rows[5];
    row.quantity = is.quantity;
    row.unit = is.unit;
    row.estimate = exact_number(is.value, "");
    row.used_u = is.half_width / std::sqrt(3.0);
    row.used_sensitivity = is.c;
    row.origin = Origin::limits;
    row.origin_value = is.half_width;
    row.contributor = contributor_of(row.quantity, "", "");
    row.is_measured = measured;
    AuditSubject subject = test::subject_with_certificate({budget});
    certificate::Condition condition;
    condition.kind = is.kind;
    condition.unit = is.unit_of_room;
    condition.minimum = is.low;
    condition.maximum = is.high;
    subject.certificate->data.conditions = {condition};
    return test::findings_of(environment_rules(), "E02", subject).size();
}

TEST(EnvironmentRules, E02_takes_no_measurand_for_the_room) {
    const RowAndRoom of_room[] = {
        {"temperature of the gauge block, deviation from 20 °C", "K", 0.0, 0.2, "um", 1.15, "temperature", "degC", 19,
         21},
        {"Raumtemperatur", "degC", 20.0, 0.2, "um", 1.15, "temperature", "degC", 19, 21},
        {"temperature of the air", "degC", 20.5, 0.2, "degC", 1.0, "temperature", "degC", 19, 21},
        {"relative humidity", "percent", 45.0, 1.0, "um", 0.01, "humidity", "percent", 40, 50},
        {"Luftfeuchte", "percent", 0.0, 1.0, "um", 0.01, "humidity", "percent", 40, 50},
        {"air pressure", "hPa", 0.0, 1.0, "um", 0.3, "pressure", "hPa", 1002, 1012},
        {"pressure", "hPa", 1007.0, 1.0, "um", 0.3, "pressure", "hPa", 1002, 1012},
    };
    for (const RowAndRoom& row : of_room) {
        EXPECT_EQ(ranges_found(row, false), 1U) << row.quantity;
        EXPECT_EQ(ranges_found(row, true), 0U) << row.quantity << ", of a standard or with a role";
        RowAndRoom calm = row;
        calm.half_width = 20.0;
        EXPECT_EQ(ranges_found(calm, false), 0U) << row.quantity;
    }
    const RowAndRoom of_something_else[] = {
        {"temperature of the standard", "degC", -20.0, 0.02, "K", 1.0, "temperature", "degC", 19, 21},
        {"temperature, homogeneity of the chamber", "K", 0.0, 0.06, "K", -1.0, "temperature", "degC", 19, 21},
        {"temperature of the bath", "degC", 20.0, 0.02, "ohm", 0.4, "temperature", "degC", 19, 21},
        {"ice point, temperature", "degC", 0.0, 0.01, "uV", 40.0, "temperature", "degC", 19, 21},
        {"temperature of the furnace", "degC", 400.0, 0.5, "uV", 40.0, "temperature", "degC", 19, 21},
        {"temperature", "degC", 400.0, 0.5, "uV", 40.0, "temperature", "degC", 19, 21},
        {"temperature of the solution", "degC", 20.0, 0.05, "mS/cm", 0.02, "temperature", "degC", 19.7, 20.3},
        {"Temperatur der Lösung", "degC", 20.0, 0.05, "mS/cm", 0.02, "temperature", "degC", 19.7, 20.3},
        {"Temperatur im Thermostat", "degC", 20.0, 0.05, "mS/cm", 0.02, "temperature", "degC", 19.7, 20.3},
        {"溶液溫度", "degC", 20.0, 0.05, "mS/cm", 0.02, "temperature", "degC", 19.7, 20.3},
        {"temperature", "degC", 25.02, 0.05, "mS/cm", 0.02, "temperature", "degC", 19.7, 20.3},
        {"humidity of the chamber", "percent", 45.0, 0.4, "percent", 1.0, "humidity", "percent", 40, 50},
        {"humidity standard", "percent", 10.0, 0.4, "mA", 0.16, "humidity", "percent", 40, 50},
        {"Feuchte", "percent", 45.0, 0.4, "percent", -1.0, "humidity", "percent", 40, 50},
        {"pressure standard", "bar", 0.0, 0.001, "1", 0.1, "pressure", "hPa", 1002, 1012},
        {"Druck am Kolben", "bar", 10.0, 0.001, "mA", 1.6, "pressure", "hPa", 1002, 1012},
    };
    for (const RowAndRoom& row : of_something_else) {
        EXPECT_EQ(ranges_found(row, false), 0U) << row.quantity;
    }
}

/// The law: a value that is not called one of the room is one only where its half-width reaches the observed range.
TEST(EnvironmentRules, E02_takes_what_lies_outside_of_the_range_for_no_room) {
    for (double value = 17.0; value < 26.0; value += 0.31) {
        for (const double half_width : {0.02, 0.1, 0.25}) {
            const RowAndRoom row{"temperature", "degC",        value,  half_width, "mS/cm",
                                 0.02,          "temperature", "degC", 19.7,       20.3};
            EXPECT_EQ(ranges_found(row, false), value + half_width >= 19.7 && value - half_width <= 20.3 ? 1U : 0U)
                << value << " ± " << half_width;
            RowAndRoom of_room = row;
            of_room.quantity = "room temperature";
            EXPECT_EQ(ranges_found(of_room, false), 1U) << value << " ± " << half_width;
        }
    }
}

TEST(EnvironmentRules, E02_holds_the_range_against_the_widest_part_of_an_input) {
    AuditSubject subject = subject_at(19.0, 21.0);
    AuditedBudget& budget = subject.budgets[0];
    budget.rows[5].input = "t";
    budget.rows.push_back(budget.rows[5]);
    budget.rows.back().origin_value = 0.1;  // the calibration of its sensor
    EXPECT_EQ(test::findings_of(environment_rules(), "E02", subject).size(), 1U);
    budget.rows[5].origin_value = 1.2;
    EXPECT_EQ(found_by(environment_rules(), "E02", subject), "");
}

TEST(EnvironmentRules, E03_asks_for_the_calibration_of_a_sensor) {
    AuditSubject subject = subject_at(19.9, 20.1);
    EXPECT_EQ(found_by(environment_rules(), "E03", subject), "");
    subject.certificate->data.conditions[0].U.reset();
    EXPECT_THAT(found_by(environment_rules(), "E03", subject), HasSubstr("EX-T1 has no U"));
    subject.certificate->data.standards.emplace_back().identification = "EX-T1";
    EXPECT_EQ(found_by(environment_rules(), "E03", subject), "");
}

TEST(EnvironmentRules, E04_asks_for_the_time_to_acclimatise) {
    AuditSubject subject = subject_at(19.9, 20.1);
    EXPECT_EQ(found_by(environment_rules(), "E04", subject), "");
    subject.certificate->data.dates.received = subject.certificate->data.dates.performed_from = "2026-03-02";
    EXPECT_THAT(found_by(environment_rules(), "E04", subject), HasSubstr("on the day of receipt"));
    subject.certificate->data.dates.received = "2026-03-01";
    EXPECT_EQ(found_by(environment_rules(), "E04", subject), "");
}

TEST(EnvironmentRules, E06_sees_a_trend_of_readings) {
    AuditSubject subject = test::subject_with({test::sound_budget()});
    std::vector<double>& readings = subject.budgets[0].rows[3].readings;
    readings = {1.0, 1.11, 1.19, 1.32, 1.38, 1.51, 1.60};
    EXPECT_THAT(found_by(environment_rules(), "E06", subject), HasSubstr("have a trend in their order"));
    readings = {1.0, 1.5, 0.9, 1.4, 1.1, 1.3, 1.2};
    EXPECT_EQ(found_by(environment_rules(), "E06", subject), "");
    readings = {1.0, 1.1, 1.2, 1.3, 1.41};  // five readings tell too little
    EXPECT_EQ(found_by(environment_rules(), "E06", subject), "");
    readings = {1.0, 1.0, 1.0, 1.0, 1.0, 1.0};
    EXPECT_EQ(found_by(environment_rules(), "E06", subject), "");
}

TEST(EnvironmentRules, E06_sees_a_trend_without_scatter) {
    AuditSubject subject = test::subject_with({test::sound_budget()});
    std::vector<double>& readings = subject.budgets[0].rows[3].readings;
    readings = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
    EXPECT_THAT(found_by(environment_rules(), "E06", subject), HasSubstr("on one straight line in their order"));
    // Equal steps are a trend wherever they begin and however small they are; equal readings are none, whatever the
    // rounding of their mean leaves.
    for (const double first : {0.0, 0.1, -7.3, 100000.1, 1e-9}) {
        for (const double step : {0.1, -0.1, 0.3, 1e-6, 12.7}) {
            for (const std::size_t n : {6U, 7U, 10U, 30U}) {
                readings.clear();
                for (std::size_t i = 0; i < n; ++i) {
                    readings.push_back(first + step * static_cast<double>(i));
                }
                EXPECT_THAT(found_by(environment_rules(), "E06", subject), HasSubstr("in their order"))
                    << first << " + i * " << step << ", n = " << n;
                readings.assign(n, first);
                EXPECT_EQ(found_by(environment_rules(), "E06", subject), "") << first << ", n = " << n;
                readings.assign(n, first + step);
                EXPECT_EQ(found_by(environment_rules(), "E06", subject), "") << first + step << ", n = " << n;
            }
        }
    }
    // Equal but for the last bit: nothing that an instrument shows.
    readings = {0.3, 0.1 + 0.2, 0.3, 0.1 + 0.2, 0.1 + 0.2, 0.1 + 0.2};
    EXPECT_EQ(found_by(environment_rules(), "E06", subject), "");
}

TEST(EnvironmentRules, E07_sees_limits_in_place_of_observations) {
    AuditSubject subject = subject_at(18.0, 22.0);
    EXPECT_EQ(found_by(environment_rules(), "E07", subject), "");
    subject.certificate->data.conditions[0].lower_limit = 18.0;
    subject.certificate->data.conditions[0].upper_limit = 22.0;
    EXPECT_THAT(found_by(environment_rules(), "E07", subject), HasSubstr("exactly the limits"));
    subject.certificate->data.conditions[0].maximum = 21.9;
    EXPECT_EQ(found_by(environment_rules(), "E07", subject), "");
}

}  // namespace
}  // namespace gumcert::audit
