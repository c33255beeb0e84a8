#include "audit/words/stated_rule.h"

#include <gtest/gtest.h>

#include <cctype>
#include <string>

namespace gumcert::audit {
namespace {

using gum::DecisionRule;

TEST(StatedRule, IsFoundByItsIdWhereverItStands) {
    // The law: every id, however it is written.
    for (const std::string_view id : gum::decision_rule_ids()) {
        const std::string digits(id.substr(3));
        const std::optional<DecisionRule> rule = gum::decision_rule_from_id(std::string(id));
        ASSERT_TRUE(rule);
        for (const std::string& text :
             {std::string(id), "ILAC-G8 " + std::string(id), "Rule " + std::string(id), "dr-" + digits, "DR" + digits,
              "Dr " + digits, "DR-" + std::to_string(std::stoi(digits)), "(" + std::string(id) + ")",
              "Entscheidungsregel " + std::string(id) + ", vereinbart"}) {
            EXPECT_EQ(rule_of_id_in(text), rule) << text;
            const std::optional<StatedRule> stated = stated_rule(text);
            ASSERT_TRUE(stated) << text;
            EXPECT_EQ(stated->rule, *rule) << text;
        }
    }
    EXPECT_FALSE(rule_of_id_in("DR-03 or DR-01"));
    EXPECT_FALSE(rule_of_id_in("DR-14"));
    EXPECT_FALSE(rule_of_id_in("Dr. Miller, 03"));
    EXPECT_FALSE(rule_of_id_in("drift 3"));
}

TEST(StatedRule, IsReadInWords) {
    struct Case {
        std::string words;
        DecisionRule rule;
        std::optional<double> factor = {};
    };
    for (const Case& one : {Case{"simple acceptance", DecisionRule::simple_acceptance},
                            Case{"Simple acceptance (ILAC-G8:09/2019, 4.2.1)", DecisionRule::simple_acceptance},
                            Case{"shared risk", DecisionRule::simple_acceptance},
                            Case{"einfache Akzeptanz", DecisionRule::simple_acceptance},
                            Case{"ohne Schutzband", DecisionRule::simple_acceptance},
                            Case{"no guard band (w = 0)", DecisionRule::simple_acceptance},
                            Case{"ILAC-G8:09/2019 4.2.1", DecisionRule::simple_acceptance},
                            Case{"guard band w = U", DecisionRule::guard_band_u},
                            Case{"Guard band U", DecisionRule::guard_band_u},
                            Case{"w=U", DecisionRule::guard_band_u},
                            Case{"Schutzband = U", DecisionRule::guard_band_u},
                            Case{"DR-03 (guard band w = U)", DecisionRule::guard_band_u},
                            Case{"w = 1.0 U", DecisionRule::guard_band_u},
                            Case{"w = 0.83 U", DecisionRule::guard_band_factor, 0.83},
                            Case{"Schutzband w = 0,83·U", DecisionRule::guard_band_factor, 0.83},
                            Case{"DR-04, w = 0.5 U", DecisionRule::guard_band_factor, 0.5},
                            Case{"DR-13: w = 0.5 U", DecisionRule::agreed, 0.5},
                            Case{"non-binary with guard band w = U", DecisionRule::non_binary, 1.0},
                            Case{"w = -U", DecisionRule::relaxed},
                            Case{"ISO 14253-1", DecisionRule::iso_14253_1},
                            Case{"DR-02, simple acceptance", DecisionRule::simple_acceptance_with_ratio}}) {
        const std::optional<StatedRule> stated = stated_rule(one.words);
        ASSERT_TRUE(stated) << one.words;
        EXPECT_EQ(stated->rule, one.rule) << one.words;
        EXPECT_EQ(stated->parameters.guard_factor, one.factor) << one.words;
    }
    for (const char* const words :
         {"", "as agreed", "see order", "guard band", "guard band w = 0.5 mm", "w = u", "DR-01 with guard band w = U",
          "simple acceptance; guard band w = U", "4.2.1", "within limits"}) {
        EXPECT_FALSE(stated_rule(words)) << words;
    }
}

}  // namespace
}  // namespace gumcert::audit
