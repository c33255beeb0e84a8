#include "reports/record/make/certificate/environment_findings.h"

#include <gtest/gtest.h>

#include "tests/support/sample_certificate.h"
#include "tests/support/sample_record.h"

namespace gumcert::reports {
namespace {

using certificate::Condition;
using certificate::FindingSeverity;
using reports::EvaluationRecord;

using Ids = std::vector<std::string>;

Condition temperature(double minimum, double maximum, const std::string& unit = "degC") {
    Condition condition;
    condition.quantity = "Temperature";
    condition.kind = "temperature";
    condition.minimum = minimum;
    condition.maximum = maximum;
    condition.unit = unit;
    condition.U = unit == "degF" ? 0.18 : 0.1;
    return condition;
}

Condition with_limits(Condition condition, double lower, double upper) {
    condition.lower_limit = lower;
    condition.upper_limit = upper;
    return condition;
}

/// Two stations, the fixture at 20.21 °C and at the stated temperature.
EvaluationRecord record_at(double fixture, std::vector<Condition> conditions, double air = 20.2) {
    EvaluationRecord record = test::sample_record();
    record.rotary->environment.emplace().stations = {{"P1", {20.21}, {0.02}, {20.2}, {1013.0}, {45.0}},
                                                     {"P2", {fixture}, {0.02}, {air}, {}, {}}};
    record.certificate.emplace();
    record.certificate->data.conditions = std::move(conditions);
    return record;
}

Ids ids_of(const EvaluationRecord& record) {
    Ids all;
    for (const certificate::Finding& finding : environment_findings(record)) {
        EXPECT_EQ(finding.severity, FindingSeverity::critical);
        all.push_back(finding.id);
    }
    return all;
}

TEST(EnvironmentFindings, TemperaturesThatTheCertificateDoesNotState) {
    EXPECT_EQ(ids_of(record_at(20.4, {temperature(20.1, 20.4)})), Ids());
    EXPECT_EQ(ids_of(record_at(28.1, {temperature(20.1, 20.4)})), Ids{"E04"});
    EXPECT_EQ(ids_of(record_at(12.0, {temperature(20.1, 20.4)})), Ids{"E04"});
    EXPECT_EQ(ids_of(record_at(28.1, {with_limits(temperature(20.1, 20.4), 18.0, 22.0)})), (Ids{"E04", "E05"}));
    const auto found = environment_findings(record_at(28.1, {temperature(20.1, 20.4)}));
    EXPECT_EQ(found.front().where, "/conditions/0");
    EXPECT_EQ(
        found.front().what,
        "the environment file has the temperature of the fixture from 20.21 °C to 28.10 °C, and \"Temperature\" is "
        "stated from 20.1 °C to 20.4 °C");
}

TEST(EnvironmentFindings, WithinItsUncertaintyAValueIsAsStated) {
    // U: 0.04 K of the value and 0.1 K of the sensor, together 0.108 K, and 0.05 K of the last digit.
    EXPECT_EQ(ids_of(record_at(20.55, {temperature(20.1, 20.4)})), Ids());
    EXPECT_EQ(ids_of(record_at(20.57, {temperature(20.1, 20.4)})), Ids{"E04"});
    // A whole number hides no more than 0.05 K; limits have no last digit.
    EXPECT_EQ(ids_of(record_at(21.3, {temperature(20.0, 21.0)})), Ids{"E04"});
    EXPECT_EQ(ids_of(record_at(22.12, {with_limits(temperature(20.0, 22.2), 18.0, 22.0)})), Ids{"E05"});
    EXPECT_EQ(ids_of(record_at(22.10, {with_limits(temperature(20.0, 22.2), 18.0, 22.0)})), Ids());
}

TEST(EnvironmentFindings, ADeviationThatIsStatedExplainsALimitAndNoOtherRange) {
    EvaluationRecord record = record_at(28.1, {with_limits(temperature(20.1, 20.4), 18.0, 22.0)});
    record.certificate->data.method.deviations = {
        "The fixture was calibrated at 28 degrees, outside of the limits of the procedure."};
    EXPECT_EQ(ids_of(record), Ids{"E04"});
    record.certificate->data.conditions.front().maximum = 28.1;
    EXPECT_EQ(ids_of(record), Ids());
}

TEST(EnvironmentFindings, OtherUnits) {
    EXPECT_EQ(ids_of(record_at(20.4, {temperature(68.2, 68.7, "degF")})), Ids());
    EXPECT_EQ(ids_of(record_at(21.4, {temperature(68.2, 68.7, "degF")})), Ids{"E04"});
    EXPECT_EQ(ids_of(record_at(20.4, {temperature(293.25, 293.55, "K")})), Ids());
    EXPECT_EQ(ids_of(record_at(21.4, {temperature(293.25, 293.55, "K")})), Ids{"E04"});
}

TEST(EnvironmentFindings, OfSeveralTemperaturesOneHasToFit) {
    EXPECT_EQ(ids_of(record_at(20.3, {temperature(22.0, 23.0), temperature(20.1, 20.4)}, 20.2)), Ids());
    EXPECT_EQ(ids_of(record_at(20.3, {temperature(22.0, 23.0), temperature(20.1, 20.4)}, 24.0)), Ids{"E04"});
    EXPECT_EQ(ids_of(record_at(20.3, {temperature(20.1, 20.4)}, 24.0)), Ids())
        << "one temperature: nothing says that it is that of the air";
}

TEST(EnvironmentFindings, PressureAndHumidityOfTheAir) {
    Condition pressure = temperature(1020.0, 1024.0, "hPa");
    pressure.kind = "pressure";
    pressure.U = 0.5;
    EXPECT_EQ(ids_of(record_at(20.3, {temperature(20.1, 20.4), pressure})), Ids{"E04"});
    pressure.minimum = 1013.4;  // 0.4 hPa: within the sensor
    EXPECT_EQ(ids_of(record_at(20.3, {temperature(20.1, 20.4), pressure})), Ids());
    Condition humidity = temperature(30.0, 40.0, "percent");
    humidity.kind = "humidity";
    humidity.U = 2.0;
    EXPECT_EQ(ids_of(record_at(20.3, {temperature(20.1, 20.4), humidity})), Ids{"E04"});
}

TEST(EnvironmentFindings, WithoutFileOrCertificateAreNone) {
    EvaluationRecord record = record_at(28.1, {temperature(20.1, 20.4)});
    record.rotary->environment.reset();
    EXPECT_EQ(ids_of(record), Ids());
    record = record_at(28.1, {temperature(20.1, 20.4)});
    record.certificate.reset();
    EXPECT_EQ(ids_of(record), Ids());
    EXPECT_EQ(ids_of(EvaluationRecord()), Ids());
}

}  // namespace
}  // namespace gumcert::reports
