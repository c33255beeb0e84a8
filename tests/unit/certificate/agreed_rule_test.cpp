#include "certificate/agreed_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace gumcert::certificate {
namespace {

using testing::HasSubstr;

AgreedSpecification agreed_length() {
    AgreedSpecification s;
    s.id = "length";
    s.lower = 9.999;
    s.upper = 10.001;
    s.unit = "mm";
    s.rule.id = "DR-02";
    s.rule.largest_U = 2e-4;
    s.rule.alternative = "DR-04";
    s.rule.guard_factor = 0.5;
    return s;
}

TEST(AgreedRule, IsTheRuleThatWasAgreedOnWithItsAlternativeInTheUnitOfTheResults) {
    const AgreedRule rule = agreed_rule(agreed_length(), "um");
    EXPECT_EQ(rule.problem, "");
    EXPECT_EQ(rule.rule, gum::DecisionRule::simple_acceptance_with_ratio);
    EXPECT_EQ(rule.parameters.alternative, gum::DecisionRule::guard_band_factor);
    EXPECT_EQ(rule.parameters.guard_factor, 0.5);
    EXPECT_NEAR(*rule.parameters.largest_U, 0.2, 1e-12);
    EXPECT_NEAR(*rule.limits.lower, 9999.0, 1e-9);
    EXPECT_NEAR(*rule.limits.upper, 10001.0, 1e-9);
}

TEST(AgreedRule, DifferencesOfCelsiusTemperaturesHaveNoZero) {
    AgreedSpecification s = agreed_length();
    s.unit = "degC";
    s.rule = {};
    s.rule.id = "DR-13";
    s.rule.guard_band = 0.5;
    s.rule.population_centre = 20.0;
    s.rule.population_deviation = 0.1;
    const AgreedRule rule = agreed_rule(s, "degC");
    EXPECT_EQ(rule.parameters.guard_band, 0.5);
    EXPECT_EQ(rule.parameters.population_centre, 20.0);
    EXPECT_THAT(agreed_rule(s, "K").problem, HasSubstr("the specification has the unit \"degC\""));
}

TEST(AgreedRule, TakesTheLimitsOfOneValue) {
    AgreedSpecification s = agreed_length();
    s.lower = s.upper = std::nullopt;
    EXPECT_NE(agreed_rule(s, "um").problem, "");
    const AgreedRule rule = agreed_rule(s, "um", {.lower = {}, .upper = 3.0});
    EXPECT_EQ(rule.problem, "");
    EXPECT_EQ(rule.limits.upper, 3.0);
}

TEST(AgreedRule, SaysWhyItCannotBeApplied) {
    AgreedSpecification s = agreed_length();
    s.rule.guard_factor.reset();
    EXPECT_NE(agreed_rule(s, "um").problem, "");
    EXPECT_THAT(agreed_rule(s, "N").problem, HasSubstr("the result \"N\""));
    s.rule.id = "DR-99";
    EXPECT_THAT(agreed_rule(s, "um").problem, HasSubstr("is not known"));
}

}  // namespace
}  // namespace gumcert::certificate
