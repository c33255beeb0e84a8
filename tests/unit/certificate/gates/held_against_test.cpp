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

TEST(HeldAgainst, NominalValueNearZeroIsWithinAHundredthOfTheRange) {
    EXPECT_TRUE(is_nominal_in(0.0, 0.49, -40.0, 300.0));
    EXPECT_FALSE(is_nominal_in(0.0, 4.9, -40.0, 300.0));
    EXPECT_TRUE(is_nominal_in(100.0, 109.0, 0.0, 1000.0));
    EXPECT_FALSE(is_nominal_in(20.0, 50.0, 0.0, 100.0));
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
    // Only of what was held against its own value the role and the point may be missing.
    const Measured itself = measured_at(bare, bare.columns[0], 0, Unit::parse("uV"));
    EXPECT_TRUE(first.is_place);
    EXPECT_FALSE(itself.is_place);
    EXPECT_EQ(action_of_range(first),
              "Hold the range against the result (\"of\": \"value\"), or state the true parameter.");
    EXPECT_NE(action_of_range(itself).find("state its role in the outputs of the job, and at least one point"),
              std::string::npos);
    for (const Measured& measured : {first, itself}) {
        const std::optional<Finding> taken = capability_taken_elsewhere(
            {}, 0, {.name = "V", .unit = "uV", .of = "V_n"}, {.name = "V_n", .value = 0.1, .unit = "uV"}, measured);
        ASSERT_TRUE(taken);
        EXPECT_EQ(taken->action.find("state its role") == std::string::npos, measured.is_place) << taken->action;
    }
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

/// At the ice point another number was measured than 0 °C, at 0 V another than 0 V: what the scope allows there is the same.
TEST(HeldAgainst, CapabilityThatIsTheSameElsewhereIsNotTold) {
    const auto told = [](const std::string& expression, double claimed, double value) {
        ScopeEntry entry;
        entry.id = "T1";
        entry.capability.form = "function";
        entry.capability.unit = "K";
        entry.capability.arguments = {{.name = "t", .unit = "degC", .of = "t_N"}};
        entry.capability.expression = expression;
        const Measured measured{{.name = "t_c", .value = value, .unit = "degC"}, "the result"};
        const std::optional<Finding> finding = capability_taken_elsewhere(
            entry, 0, entry.capability.arguments.front(), {.name = "t_N", .value = claimed, .unit = "degC"}, measured);
        return finding && finding->severity == FindingSeverity::critical;
    };
    const std::string slow = "0.05 + 0.0001*abs(t)", steep = "0.05 + 0.01*abs(t)";
    EXPECT_FALSE(told(slow, 0.0, 0.49));
    EXPECT_FALSE(told(slow, 0.0, -0.49));
    EXPECT_TRUE(told(slow, 0.0, 20.0)) << "52 mK in place of 50 mK";
    EXPECT_TRUE(told(steep, 0.0, 0.49)) << "55 mK in place of 50 mK";
    EXPECT_FALSE(told(steep, 0.0, 0.02));
    EXPECT_TRUE(told("0.05 + ", 0.0, 0.49)) << "nothing is known of it";
    // Of two arguments, wherever the other one is.
    const auto told_of_two = [](double slope, double value, bool is_stated) {
        ScopeEntry entry;
        entry.id = "A1";
        entry.capability.form = is_stated ? "matrix" : "function";
        entry.capability.unit = "dB";
        entry.capability.arguments = {{.name = "f", .unit = "GHz", .of = "f"},
                                      {.name = "A", .unit = "dB", .of = "A_N"}};
        if (is_stated) {
            entry.capability.rows = {1.0, 18.0};
            entry.capability.columns = {0.0, 10.0};
            entry.capability.matrix = {{0.01, 0.01}, {0.02, 0.02 + 10.0 * slope}};
            entry.capability.lookup = "linear";
        } else {
            entry.capability.expression = "0.01 + 0.001*f + 0.001*A";
        }
        const Measured measured{{.name = "A", .value = value, .unit = "dB"}, "the result"};
        return capability_taken_elsewhere(entry, 0, entry.capability.arguments.back(),
                                          {.name = "A_N", .value = 0.0, .unit = "dB"}, measured)
            .has_value();
    };
    EXPECT_FALSE(told_of_two(0.001, 0.12, true));
    EXPECT_TRUE(told_of_two(0.01, 0.12, true)) << "at 18 GHz 21.2 mdB in place of 20 mdB";
    EXPECT_TRUE(told_of_two(0.001, 0.12, false)) << "where the frequency is, nobody says";
}

TEST_F(TakenElsewhere, SaysNothingWhereItIsTheResultOrAnotherKind) {
    EXPECT_FALSE(told({.name = "nominal", .value = 50.0, .unit = "mm"}));
    EXPECT_FALSE(told({.name = "nominal", .value = 5.0, .unit = "cm"}));
    EXPECT_FALSE(told({.name = "t", .value = 20.0, .unit = "degC"}));
    EXPECT_TRUE(found.empty());
}

}  // namespace
}  // namespace gumcert::certificate
