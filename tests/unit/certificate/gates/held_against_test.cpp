#include "certificate/gates/held_against.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

using gum::Unit;

TEST(HeldAgainst, KindsAreTold) {
    EXPECT_TRUE(of_one_kind(Unit::parse("mm"), Unit::parse("um")));
    EXPECT_FALSE(of_one_kind(Unit::parse("mm"), Unit::parse("K")));
    EXPECT_TRUE(of_one_kind(Unit::parse("degC"), Unit::parse("degF")));
    EXPECT_FALSE(of_one_kind(Unit::parse("degC"), Unit::parse("K"))) << "a temperature, and a difference of two";
}

TEST(HeldAgainst, ScopeSeesTheMagnitudeOrTheTemperatureItself) {
    EXPECT_DOUBLE_EQ(value_for_scope(-2500.0, Unit::parse("um"), Unit::parse("mm"), 0.0), 2.5);
    EXPECT_DOUBLE_EQ(value_for_scope(-40.0, Unit::parse("degC"), Unit::parse("degC"), 0.0), -40.0);
    EXPECT_NEAR(value_for_scope(-40.0, Unit::parse("degF"), Unit::parse("degC"), 0.0), -40.0, 1e-12);
    // A range from -70 dB, or from -10 V, speaks of the sign as well.
    EXPECT_DOUBLE_EQ(value_for_scope(-60.0, Unit::parse("dB"), Unit::parse("dB"), -70.0), -60.0);
    EXPECT_DOUBLE_EQ(value_for_scope(-60.0, Unit::parse("dB"), Unit::parse("dB"), 0.0), 60.0);
    EXPECT_FALSE(has_sign(Unit::parse("V"), 0.0));
    EXPECT_TRUE(has_sign(Unit::parse("V"), -10.0));
    EXPECT_TRUE(has_sign(Unit::parse("degC"), 0.0));
}

TEST(HeldAgainst, NominalValueIsWithinATenth) {
    EXPECT_TRUE(is_nominal_of(100.0, 109.0));
    EXPECT_TRUE(is_nominal_of(100.0, 111.0)) << "a tenth of the larger one";
    EXPECT_FALSE(is_nominal_of(100.0, 112.0));
    EXPECT_TRUE(is_nominal_of(0.0, 0.0));
    EXPECT_FALSE(is_nominal_of(0.0, 1e-9));
    EXPECT_FALSE(is_nominal_of(5.0, -5.0));
}

TEST(HeldAgainst, RangeReachesAHundredthFurther) {
    EXPECT_FALSE(is_beyond(100.5, 0.0, 100.0));
    EXPECT_TRUE(is_beyond(101.5, 0.0, 100.0));
    EXPECT_FALSE(is_beyond(-0.5, 0.0, 100.0));
    EXPECT_TRUE(is_beyond(-1.5, 0.0, 100.0));
}

/// Errors of indication at 10 mV and at -1 V, before and after an adjustment.
CertifiedTable errors() {
    CertifiedTable table{.id = "results", .argument = {}, .layout = TableLayout{}, .columns = {}};
    const auto column = [](const char* name, const char* role, const char* stage, double first, double second) {
        return PointColumn{.name = name,
                           .heading = {},
                           .role = role,
                           .stage = stage,
                           .unit = "mV",
                           .printed_unit = "mV",
                           .values = {first, second},
                           .printed = {"10.0", "-1000.0"}};
    };
    table.layout->columns = {column("V_x", "indication", "", 10.1, -1001.0),
                             column("V_f", "reference", "as_found", 9.0, 9.0),
                             column("V_l", "reference", "as_left", 10.0, -1000.0)};
    table.layout->shown = {{.show = "value", .of = "E", .heading = {}, .role = "error", .stage = "as_left"},
                           {.show = "value", .of = "V", .heading = {}, .role = "measured_value", .stage = ""}};
    CertifiedColumn error;
    error.result = "E";
    error.unit = "uV";
    error.values.resize(2);
    error.values[0].value = 3.0;
    error.values[0].printed_value = "3.0";
    table.columns = {error, error};
    table.columns[1].result = "V";
    return table;
}

TEST(HeldAgainst, AnErrorWasMeasuredAtItsPoint) {
    const CertifiedTable table = errors();
    const Measured first = measured_at(table, table.columns[0], 0, Unit::parse("V"));
    EXPECT_EQ(first.name, "V_l") << "the reference before the indication, of its own stage";
    EXPECT_EQ(first.value, 10.0);
    EXPECT_EQ(first.unit, "mV");
    EXPECT_EQ(first.in_words, "the result \"E\" was measured at \"V_l\" = 10.0 mV");
    EXPECT_EQ(measured_at(table, table.columns[0], 1, Unit::parse("V")).value, -1000.0);
    // What is no error was measured itself, and so was one beside which nothing of the kind of the scope stands.
    EXPECT_EQ(measured_at(table, table.columns[1], 0, Unit::parse("V")).in_words, "the result \"V\" is 3.0 uV");
    EXPECT_EQ(measured_at(table, table.columns[0], 0, Unit::parse("Hz")).name, "E");
    CertifiedTable bare = table;
    bare.layout.reset();
    EXPECT_EQ(measured_at(bare, bare.columns[0], 0, Unit::parse("V")).name, "E");
}

class TakenElsewhere : public testing::Test {
protected:
    /// Whether a capability in mm that is taken at `held` is told of for a result of 50.000838 mm.
    bool told(const HeldAgainst& held) {
        const Certificate certificate = passed_certificate();
        const CertifiedColumn& column = certificate.tables[0].columns[0];
        ScopeEntry entry;
        entry.id = "L1";
        const std::optional<Finding> told =
            capability_taken_elsewhere(entry, 2, {.name = "L", .unit = "mm", .of = "nominal"}, held,
                                       measured_at(certificate.tables[0], column, 0, Unit::parse("mm")));
        found = told ? std::vector<Finding>{*told} : std::vector<Finding>();
        return told.has_value();
    }
    std::vector<Finding> found;
};

TEST_F(TakenElsewhere, IsCriticalWhereTheResultIsLarger) {
    EXPECT_TRUE(told({.name = "nominal", .value = 10.0, .unit = "mm"}));
    const Finding finding = only(found);
    expect_finding(finding, "X12", "ILAC-P14:09/2020", k_critical, "/accreditation/scope/2/capability");
    EXPECT_EQ(finding.what,
              "the capability of \"L1\" is taken at \"nominal\" = 10 mm, and the result \"l\" is 50000838 nm");
    EXPECT_NE(finding.action.find("\"role\": \"error\""), std::string::npos) << "of an error the role is missing";
    EXPECT_TRUE(told({.name = "nominal", .value = 0.1, .unit = "m"}));
    EXPECT_EQ(only(found).severity, FindingSeverity::minor)
        << "a capability at more than was measured is the worse one";
}

TEST_F(TakenElsewhere, SaysNothingWhereItIsTheResultOrAnotherKind) {
    EXPECT_FALSE(told({.name = "nominal", .value = 50.0, .unit = "mm"}));
    EXPECT_FALSE(told({.name = "nominal", .value = 5.0, .unit = "cm"}));
    EXPECT_FALSE(told({.name = "t", .value = 20.0, .unit = "degC"}));
    EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace gumcert::certificate
