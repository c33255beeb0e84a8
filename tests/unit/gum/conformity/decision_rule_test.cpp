#include "gum/conformity/decision_rule.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace gumcert::gum {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(DecisionRuleTable, NamesEveryRuleOnce) {
    EXPECT_THAT(decision_rule_ids(), ElementsAre("DR-01", "DR-02", "DR-03", "DR-04", "DR-05", "DR-06", "DR-07", "DR-08",
                                                 "DR-09", "DR-10", "DR-11", "DR-12", "DR-13"));
    for (const std::string_view id : decision_rule_ids()) {
        const auto rule = decision_rule_from_id(std::string(id));
        ASSERT_TRUE(rule) << id;
        EXPECT_EQ(decision_rule_id(*rule), id);
    }
}

TEST(DecisionRuleTable, SaysWhatARuleNeedsAndWhatItDoesNotUse) {
    const ToleranceLimits limits{.lower = -1.0, .upper = 1.0};
    EXPECT_THAT(check_decision_rule(DecisionRule::guard_band_factor, {}, limits),
                ElementsAre("DR-04 needs guard_factor, the r of w = r·U."));
    EXPECT_THAT(check_decision_rule(DecisionRule::guard_band_factor, {.guard_factor = 0.8}, limits), IsEmpty());
    EXPECT_THAT(check_decision_rule(DecisionRule::relaxed, {.guard_factor = 0.8}, limits),
                ElementsAre("guard_factor is stated, but DR-11 does not use it."));
}

TEST(DecisionRuleTable, LetsTheGuardBandReachOutwardsOnlyWhereTheRuleMay) {
    const ToleranceLimits limits{.lower = -1.0, .upper = 1.0};
    EXPECT_THAT(check_decision_rule(DecisionRule::b89_7_3_1, {.guard_factor = -0.1}, limits), IsEmpty());
    EXPECT_THAT(check_decision_rule(DecisionRule::agreed, {.guard_factor = -0.1}, limits), IsEmpty());
    EXPECT_THAT(check_decision_rule(DecisionRule::guard_band_factor, {.guard_factor = -0.1}, limits),
                ElementsAre("guard_factor is -0.1; it must be finite and not negative."));
}

TEST(DecisionRuleTable, TakesAProbabilityForWhatTheRuleMeansByIt) {
    const ToleranceLimits limits{.lower = -1.0, .upper = 1.0};
    EXPECT_THAT(check_decision_rule(DecisionRule::specific_risk, {.probability = 0.05}, limits), IsEmpty());
    EXPECT_THAT(check_decision_rule(DecisionRule::specific_risk, {.probability = 0.95}, limits),
                ElementsAre("probability is 0.95; it must be the largest risk, greater than 0 and not above 0.5."));
    EXPECT_THAT(check_decision_rule(DecisionRule::iso_14253_1, {.probability = 0.05}, limits),
                ElementsAre("probability is 0.05; it must be the probability to prove, above 0.5 and below 1."));
}

TEST(DecisionRuleTable, SaysWhichRulesHoldAProbabilityAgainstALimit) {
    EXPECT_TRUE(decides_by_probability(DecisionRule::specific_risk, {}));
    EXPECT_TRUE(decides_by_probability(DecisionRule::iso_14253_1, {}));
    EXPECT_FALSE(decides_by_probability(DecisionRule::iso_14253_1, {.guard_factor = 1.0})) << "by U";
    EXPECT_TRUE(decides_by_probability(DecisionRule::z540_3, {.method = "4"}));
    EXPECT_FALSE(decides_by_probability(DecisionRule::z540_3, {.method = "6"}));
    EXPECT_FALSE(decides_by_probability(DecisionRule::guard_band_factor, {.method = "4"}));
    EXPECT_FALSE(decides_by_probability(DecisionRule::agreed, {}));
}

}  // namespace
}  // namespace gumcert::gum
