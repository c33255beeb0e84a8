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
    CertifiedValue value;
    value.value = -2500.0;
    EXPECT_DOUBLE_EQ(value_for_scope(value, Unit::parse("um"), Unit::parse("mm")), 2.5);
    value.value = -40.0;
    EXPECT_DOUBLE_EQ(value_for_scope(value, Unit::parse("degC"), Unit::parse("degC")), -40.0);
    EXPECT_NEAR(value_for_scope(value, Unit::parse("degF"), Unit::parse("degC")), -40.0, 1e-12);
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

class TakenElsewhere : public testing::Test {
protected:
    /// Whether a capability in mm that is taken at `held` is told of for a result of 50.000838 mm.
    bool told(const HeldAgainst& held) {
        const Certificate certificate = passed_certificate();
        const CertifiedColumn& column = certificate.tables[0].columns[0];
        FindingList list(certificate.data);
        ScopeEntry entry;
        entry.id = "L1";
        const bool tells = capability_taken_elsewhere(list, entry, 2, {.name = "L", .unit = "mm", .of = "nominal"},
                                                      held, column, column.values[0]);
        found = list.take();
        return tells;
    }
    std::vector<Finding> found;
};

TEST_F(TakenElsewhere, IsCriticalWhereTheResultIsLarger) {
    EXPECT_TRUE(told({.name = "nominal", .value = 10.0, .unit = "mm"}));
    const Finding finding = only(found);
    expect_finding(finding, "X12", "ILAC-P14:09/2020", k_critical, "/accreditation/scope/2/capability");
    EXPECT_EQ(finding.what,
              "the capability of \"L1\" is taken at \"nominal\" = 10 mm, and the result \"l\" is 50000838 nm");
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
