#include "gum/conformity/conformity.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::message_of;
using test::prints_as;
using enum ConformityVerdict;
using Parameters = DecisionRuleParameters;

const ToleranceLimits k_limits{.lower = 9.0, .upper = 10.0};
const ToleranceLimits k_upper{.upper = 10.0};
const ToleranceLimits k_lower{.lower = 9.0};
const ToleranceLimits k_symmetric_tolerance{.lower = -1.0, .upper = 1.0};

MeasuredValue normal_value(double y, double u) {
    return {.value = y, .standard_uncertainty = u, .expanded_uncertainty = 2.0 * u};
}

/// U = 0.1 for values between 9 and 10.
ConformityDecision decide(DecisionRule rule, double y, const Parameters& parameters = {},
                          const ToleranceLimits& limits = k_limits) {
    return decide_conformity(rule, parameters, limits, normal_value(y, 0.05));
}
ConformityVerdict verdict(DecisionRule rule, double y, const Parameters& parameters = {},
                          const ToleranceLimits& limits = k_limits) {
    return decide(rule, y, parameters, limits).verdict;
}

// A numerical distribution ends somewhere: what lies further out is no risk of 0.
TEST(DecideConformity, SaysNothingOfProbabilitiesThatADistributionDoesNotKnow) {
    MeasuredValue y = normal_value(9.5, 0.05);
    const Distribution normal = Distribution::normal(9.5, 0.05);
    y.least_probability = 1e-9;
    y.distribution = [&](double x) {
        const double below = lower_tail_probability(normal, x);
        return below < 1e-9 ? 0.0 : below > 1.0 - 1e-9 ? 1.0 : below;
    };
    for (const double R : {1e-3, 1e-8}) {
        const ConformityDecision known =
            decide_conformity(DecisionRule::specific_risk, {.probability = R}, k_limits, y);
        EXPECT_EQ(known.verdict, pass);
        EXPECT_NEAR(known.guard_band, 0.05 * upper_quantile(Distribution::normal(0.0, 1.0), R), 1e-6);
    }
    for (const auto& [rule, parameters] : std::vector<std::pair<DecisionRule, Parameters>>{
             {DecisionRule::specific_risk, {.probability = 1e-10}},
             {DecisionRule::iso_14253_1, {.probability = 1.0 - 1e-10}},
             {DecisionRule::z540_3, {.probability = 1e-10, .population_deviation = 0.2, .method = "4"}}}) {
        const ConformityDecision unknown = decide_conformity(rule, parameters, k_limits, y);
        EXPECT_EQ(unknown.verdict, not_applicable);
        EXPECT_EQ(unknown.guard_band, 0.0);
        EXPECT_FALSE(unknown.acceptance.lower || unknown.acceptance.upper || unknown.largest_specific_risk);
        EXPECT_NE(unknown.note.find("not known for so small a probability"), std::string::npos) << unknown.note;
    }
    // y ± U outside of the limits needs no tail; 1 − 1e-10 is not proven by it.
    y.value = 20.0;
    EXPECT_EQ(decide_conformity(DecisionRule::specific_risk, {.probability = 1e-10}, k_limits, y).verdict, fail);
    EXPECT_EQ(decide_conformity(DecisionRule::iso_14253_1, {.probability = 1.0 - 1e-10}, k_limits, y).verdict,
              not_applicable);
}

/// Both limits of one value are limits of the other: the mirror image of a situation has the same verdict.
ConformityDecision mirrored(DecisionRule rule, const Parameters& parameters, const ToleranceLimits& limits,
                            MeasuredValue y) {
    ToleranceLimits other;
    if (limits.upper) {
        other.lower = -*limits.upper;
    }
    if (limits.lower) {
        other.upper = -*limits.lower;
    }
    y.value = -y.value;
    return decide_conformity(rule, parameters, other, y);
}

const std::vector<std::pair<DecisionRule, Parameters>>& every_rule() {
    static const std::vector<std::pair<DecisionRule, Parameters>> rules{
        {DecisionRule::simple_acceptance, {}},
        {DecisionRule::simple_acceptance_with_ratio, {.largest_U = 0.2}},
        {DecisionRule::guard_band_u, {}},
        {DecisionRule::guard_band_factor, {.guard_factor = 0.5}},
        {DecisionRule::non_binary, {}},
        {DecisionRule::non_binary, {.guard_factor = 0.7}},
        {DecisionRule::three_way, {}},
        {DecisionRule::specific_risk, {.probability = 0.02}},
        {DecisionRule::iso_14253_1, {}},
        {DecisionRule::iso_14253_1, {.guard_factor = 0.825}},
        {DecisionRule::z540_3, {.method = "5"}},
        {DecisionRule::b89_7_3_1, {.guard_factor = -0.5}},
        {DecisionRule::relaxed, {}},
        {DecisionRule::prescribed, {}},
        {DecisionRule::agreed, {.guard_factor = 1.2}},
    };
    return rules;
}
/// And those that need two limits.
std::vector<std::pair<DecisionRule, Parameters>> every_two_sided_rule() {
    auto rules = every_rule();
    rules.insert(rules.end(), {{DecisionRule::simple_acceptance_with_ratio, {.test_uncertainty_ratio = 4.0}},
                               {DecisionRule::z540_3, {.population_reliability = 0.9, .method = "1"}},
                               {DecisionRule::z540_3, {.population_reliability = 0.9, .method = "2"}},
                               {DecisionRule::z540_3, {.population_reliability = 0.9, .method = "3"}},
                               {DecisionRule::z540_3, {.population_reliability = 0.9, .method = "4"}},
                               {DecisionRule::z540_3, {.method = "6"}},
                               {DecisionRule::z540_3, {.method = "rds"}},
                               {DecisionRule::z540_3, {.method = "rp10"}},
                               {DecisionRule::z540_3, {.test_uncertainty_ratio = 4.0}},
                               {DecisionRule::b89_7_3_1, {.test_uncertainty_ratio = 4.0}}});
    return rules;
}

TEST(DecisionRuleId, ThereAndBack) {
    for (int i = 0; i < 13; ++i) {
        const auto rule = static_cast<DecisionRule>(i);
        EXPECT_EQ(decision_rule_from_id(decision_rule_id(rule)), rule);
    }
    EXPECT_EQ(decision_rule_id(DecisionRule::simple_acceptance), "DR-01");
    EXPECT_EQ(decision_rule_id(DecisionRule::agreed), "DR-13");
    for (const char* text : {"", "DR-00", "DR-14", "DR-1", "dr-01", "DR-01 ", "1"}) {
        EXPECT_FALSE(decision_rule_from_id(text)) << text;
    }
    EXPECT_EQ(verdict_name(pass), "pass");
    EXPECT_EQ(verdict_name(fail), "fail");
    EXPECT_EQ(verdict_name(conditional_pass), "conditional_pass");
    EXPECT_EQ(verdict_name(conditional_fail), "conditional_fail");
    EXPECT_EQ(verdict_name(undetermined), "undetermined");
    EXPECT_EQ(verdict_name(not_applicable), "not_applicable");
}

TEST(DecideConformity, Dr01SimpleAcceptance) {
    const ConformityDecision at_limit = decide(DecisionRule::simple_acceptance, 10.0);
    EXPECT_EQ(at_limit.verdict, pass);
    EXPECT_EQ(at_limit.formula, "AL = TL, AU = TU");
    EXPECT_EQ(at_limit.guard_band, 0.0);
    EXPECT_EQ(at_limit.acceptance.upper, 10.0);
    EXPECT_EQ(at_limit.acceptance.lower, 9.0);
    EXPECT_TRUE(agrees(at_limit.conformance_probability, 0.5, 1e-13));
    EXPECT_TRUE(agrees(at_limit.specific_risk, 0.5, 1e-13));
    EXPECT_TRUE(agrees(*at_limit.largest_specific_risk, 0.5, 1e-13));
    EXPECT_TRUE(agrees(*at_limit.test_uncertainty_ratio, 5.0, 1e-14));
    EXPECT_FALSE(at_limit.false_accept);
    EXPECT_EQ(at_limit.note, "");
    const ConformityDecision beyond = decide(DecisionRule::simple_acceptance, 10.001);
    EXPECT_EQ(beyond.verdict, fail);
    EXPECT_EQ(beyond.specific_risk, beyond.conformance_probability);  // that of a false rejection
    EXPECT_EQ(verdict(DecisionRule::simple_acceptance, 9.0), pass);
    EXPECT_EQ(verdict(DecisionRule::simple_acceptance, 8.999), fail);
    EXPECT_EQ(verdict(DecisionRule::simple_acceptance, -50.0, {}, k_upper), pass);
    EXPECT_EQ(verdict(DecisionRule::simple_acceptance, 50.0, {}, k_lower), pass);
    EXPECT_EQ(verdict(DecisionRule::simple_acceptance, 8.9, {}, k_lower), fail);
    EXPECT_EQ(decide(DecisionRule::simple_acceptance, 8.9, {}, k_lower).formula, "AL = TL");
    EXPECT_FALSE(decide(DecisionRule::simple_acceptance, 8.9, {}, k_lower).test_uncertainty_ratio);
}

TEST(DecideConformity, Dr02OnlyWithAGoodMeasurement) {
    const auto rule = DecisionRule::simple_acceptance_with_ratio;
    EXPECT_EQ(verdict(rule, 9.99, {.test_uncertainty_ratio = 5.0}), pass);  // TUR is exactly 5
    EXPECT_EQ(verdict(rule, 10.01, {.test_uncertainty_ratio = 5.0}), fail);
    EXPECT_EQ(verdict(rule, 9.99, {.largest_U = 0.1}), pass);
    EXPECT_EQ(decide(rule, 9.99, {.test_uncertainty_ratio = 4.0, .largest_U = 0.1}).formula,
              "AL = TL, AU = TU, if TUR ≥ 4 and U ≤ U_max");
    const ConformityDecision coarse = decide(rule, 9.99, {.test_uncertainty_ratio = 5.1});
    EXPECT_EQ(coarse.verdict, not_applicable);
    EXPECT_EQ(coarse.note, "DR-02 cannot be applied: the test uncertainty ratio is below the least one of the rule.");
    EXPECT_FALSE(coarse.largest_specific_risk);
    EXPECT_EQ(verdict(rule, 9.5, {.test_uncertainty_ratio = 4.0, .largest_U = 0.09}), not_applicable);
    EXPECT_EQ(verdict(rule, 9.5, {.largest_U = 0.09}, k_upper), not_applicable);
}

TEST(DecideConformity, Dr02TakesTheAgreedAlternative) {
    const Parameters parameters{.test_uncertainty_ratio = 10.0, .alternative = DecisionRule::guard_band_u};
    const ConformityDecision decision = decide(DecisionRule::simple_acceptance_with_ratio, 9.95, parameters);
    EXPECT_EQ(decision.verdict, fail);
    EXPECT_EQ(decision.rule, DecisionRule::guard_band_u);
    EXPECT_EQ(decision.formula, "AL = TL + U, AU = TU − U");
    EXPECT_EQ(decision.note,
              "DR-02 cannot be applied: the test uncertainty ratio is below the least one of the rule. The agreed "
              "alternative DR-03 takes its place.");
    const Parameters good{.test_uncertainty_ratio = 4.0, .alternative = DecisionRule::guard_band_u};
    EXPECT_EQ(decide(DecisionRule::simple_acceptance_with_ratio, 9.95, good).rule,
              DecisionRule::simple_acceptance_with_ratio);
    // The alternative may fail to apply, too.
    const ConformityDecision neither = decide_conformity(
        DecisionRule::simple_acceptance_with_ratio,
        {.guard_factor = 1.0, .test_uncertainty_ratio = 4.0, .alternative = DecisionRule::guard_band_factor}, k_limits,
        normal_value(9.5, 0.3));
    EXPECT_EQ(neither.verdict, not_applicable);
    EXPECT_EQ(neither.rule, DecisionRule::guard_band_factor);
    EXPECT_NE(neither.note.find("DR-04 cannot be applied: no value can pass"), std::string::npos) << neither.note;
}

TEST(DecideConformity, Dr03GuardBandU) {
    const ConformityDecision at_limit = decide(DecisionRule::guard_band_u, 9.9);
    EXPECT_EQ(at_limit.verdict, pass);
    EXPECT_TRUE(agrees(*at_limit.acceptance.lower, 9.1, 1e-15));
    EXPECT_TRUE(agrees(*at_limit.acceptance.upper, 9.9, 1e-15));
    EXPECT_EQ(at_limit.guard_band, 0.1);
    EXPECT_TRUE(prints_as(100.0 * *at_limit.largest_specific_risk, "2.28"));
    EXPECT_EQ(verdict(DecisionRule::guard_band_u, 9.901), fail);
    EXPECT_EQ(verdict(DecisionRule::guard_band_u, 9.099), fail);
    EXPECT_EQ(verdict(DecisionRule::guard_band_u, 9.1), pass);
    EXPECT_EQ(verdict(DecisionRule::guard_band_u, 9.9, {}, k_upper), pass);
    EXPECT_EQ(verdict(DecisionRule::guard_band_u, 9.95, {}, k_upper), fail);
    EXPECT_EQ(verdict(DecisionRule::guard_band_u, 9.05, {}, k_lower), fail);
}

TEST(DecideConformity, Dr04GuardBandFactorAndItsRisks) {
    // ILAC-G8 table of guard bands: one-sided, k = 2, value on the acceptance limit.
    struct Case {
        double r;
        const char* percent;
    };
    for (const Case& c : std::vector<Case>{
             {3.0, "1.0e-7"}, {1.5, "0.135"}, {1.0, "2.28"}, {0.83, "4.85"}, {0.5, "15.9"}, {0.0, "50"}}) {
        const ConformityDecision decision =
            decide(DecisionRule::guard_band_factor, 9.0, {.guard_factor = c.r}, k_upper);
        EXPECT_TRUE(prints_as(100.0 * *decision.largest_specific_risk, c.percent)) << c.r;
        EXPECT_TRUE(agrees(decision.guard_band, c.r * 0.1, 1e-15));
    }
    EXPECT_EQ(decide(DecisionRule::guard_band_factor, 9.94, {.guard_factor = 0.5}).formula,
              "AL = TL + r·U, AU = TU − r·U, r = 0.5");
    EXPECT_EQ(verdict(DecisionRule::guard_band_factor, 9.95, {.guard_factor = 0.5}), pass);
    EXPECT_EQ(verdict(DecisionRule::guard_band_factor, 9.951, {.guard_factor = 0.5}), fail);
    EXPECT_EQ(verdict(DecisionRule::guard_band_factor, 9.04, {.guard_factor = 0.5}, k_lower), fail);
}

TEST(DecideConformity, Dr05FourVerdicts) {
    const auto rule = DecisionRule::non_binary;
    for (const ToleranceLimits& limits : {k_limits, k_upper}) {
        EXPECT_EQ(verdict(rule, 9.9, {}, limits), pass);
        EXPECT_EQ(verdict(rule, 9.901, {}, limits), conditional_pass);
        EXPECT_EQ(verdict(rule, 10.0, {}, limits), conditional_pass);
        EXPECT_EQ(verdict(rule, 10.001, {}, limits), conditional_fail);
        EXPECT_EQ(verdict(rule, 10.1, {}, limits), conditional_fail);
        EXPECT_EQ(verdict(rule, 10.101, {}, limits), fail);
    }
    EXPECT_EQ(verdict(rule, 9.05), conditional_pass);
    EXPECT_EQ(verdict(rule, 8.95, {}, k_lower), conditional_fail);
    EXPECT_EQ(verdict(rule, 8.89, {}, k_lower), fail);
    const ConformityDecision decision = decide(rule, 10.05);
    EXPECT_TRUE(agrees(*decision.rejection.upper, 10.1, 1e-15));
    EXPECT_TRUE(agrees(*decision.rejection.lower, 8.9, 1e-15));
    EXPECT_EQ(decision.specific_risk, decision.conformance_probability);
    EXPECT_TRUE(prints_as(100.0 * decide(rule, 10.1).specific_risk, "2.28"));
    EXPECT_EQ(verdict(rule, 9.93, {.guard_band = 0.05}), pass);
    EXPECT_EQ(verdict(rule, 9.97, {.guard_band = 0.05}), conditional_pass);
    EXPECT_EQ(verdict(rule, 9.97, {.guard_factor = 0.2}), pass);
}

TEST(DecideConformity, Dr06ThreeWay) {
    const auto rule = DecisionRule::three_way;
    EXPECT_EQ(verdict(rule, 9.9), pass);
    EXPECT_EQ(verdict(rule, 9.95), undetermined);
    EXPECT_EQ(verdict(rule, 10.1), undetermined);  // the interval touches the limit
    EXPECT_EQ(verdict(rule, 10.11), fail);
    EXPECT_EQ(verdict(rule, 8.95), undetermined);
    EXPECT_EQ(verdict(rule, 8.85), fail);
    EXPECT_EQ(verdict(rule, 8.95, {}, k_lower), undetermined);
    EXPECT_EQ(verdict(rule, 10.2, {}, k_upper), fail);
    EXPECT_EQ(verdict(rule, 7.0, {}, k_upper), pass);
    const ConformityDecision open = decide(rule, 10.0);
    EXPECT_TRUE(agrees(open.specific_risk, 0.5, 1e-13));
}

TEST(DecideConformity, Dr07SpecificRisk) {
    const auto rule = DecisionRule::specific_risk;
    // Golden vector 4: p_c = 0.977250, risk 2.275 %.
    const ConformityDecision decision =
        decide_conformity(rule, {.probability = 0.023}, k_limits, normal_value(9.8, 0.1));
    EXPECT_EQ(decision.verdict, pass);
    EXPECT_TRUE(prints_as(decision.conformance_probability, "0.977250"));
    EXPECT_EQ(decision.formula, "pass: 1 − P(TL ≤ Y ≤ TU) ≤ R, R = 0.023");
    EXPECT_TRUE(agrees(*decision.largest_specific_risk, 0.023, 1e-11));
    EXPECT_EQ(decide_conformity(rule, {.probability = 0.0227}, k_limits, normal_value(9.8, 0.1)).verdict, fail);
    EXPECT_EQ(verdict(rule, 10.0, {.probability = 0.5}, k_upper), pass);
    EXPECT_EQ(decide(rule, 10.1, {.probability = 0.5}, k_upper).formula, "pass: 1 − P(Y ≤ TU) ≤ R, R = 0.5");
    EXPECT_EQ(verdict(rule, 9.08, {.probability = 0.05}, k_lower), fail);
    EXPECT_EQ(verdict(rule, 9.083, {.probability = 0.05}, k_lower), pass);
    // With few degrees of freedom the same value has more risk.
    MeasuredValue few = normal_value(9.8, 0.1);
    few.degrees_of_freedom = 5.0;
    EXPECT_EQ(decide_conformity(rule, {.probability = 0.023}, k_limits, few).verdict, fail);
    const ConformityDecision hopeless =
        decide_conformity(rule, {.probability = 0.023}, k_limits, normal_value(9.5, 0.3));
    EXPECT_EQ(hopeless.verdict, not_applicable);
    EXPECT_FALSE(hopeless.acceptance.upper);
    EXPECT_EQ(hopeless.note,
              "DR-07 cannot be applied: no value can pass, because U is too large against the tolerance.");
}

TEST(DecideConformity, Dr07WithTheTrueDistribution) {
    // Rectangular ±0.5 about 9.4: nothing of it is beyond 10, where a normal distribution with its u has 1.9 %.
    MeasuredValue y{.value = 9.4, .standard_uncertainty = 0.5 / std::sqrt(3.0), .expanded_uncertainty = 0.475};
    const Parameters parameters{.probability = 0.01};
    EXPECT_EQ(decide_conformity(DecisionRule::specific_risk, parameters, k_upper, y).verdict, fail);
    y.distribution = [](double x) { return lower_tail_probability(Distribution::uniform(9.4, 0.5), x); };
    const ConformityDecision decision = decide_conformity(DecisionRule::specific_risk, parameters, k_upper, y);
    EXPECT_EQ(decision.verdict, pass);
    EXPECT_EQ(decision.conformance_probability, 1.0);
    EXPECT_TRUE(agrees(*decision.acceptance.upper, 9.51, 1e-13));
}

TEST(DecideConformity, Dr08Iso14253) {
    const auto rule = DecisionRule::iso_14253_1;
    const ConformityDecision decision = decide(rule, 9.5);
    EXPECT_EQ(decision.verdict, pass);
    EXPECT_TRUE(agrees(decision.guard_band, 1.6448536269514722 * 0.05, 1e-11));
    EXPECT_TRUE(agrees(*decision.rejection.upper, 10.0 + 1.6448536269514722 * 0.05, 1e-13));
    EXPECT_TRUE(agrees(*decision.largest_specific_risk, 0.05, 1e-11));
    EXPECT_EQ(decision.formula, "pass: P(TL ≤ Y ≤ TU) ≥ p; fail: P(TL ≤ Y ≤ TU) ≤ 1 − p; else undetermined; p = 0.95");
    for (const ToleranceLimits& limits : {k_limits, k_upper}) {
        EXPECT_EQ(verdict(rule, 9.9177, {}, limits), pass);
        EXPECT_EQ(verdict(rule, 9.9178, {}, limits), undetermined);
        EXPECT_EQ(verdict(rule, 10.0822, {}, limits), undetermined);
        EXPECT_EQ(verdict(rule, 10.0823, {}, limits), fail);
    }
    EXPECT_EQ(verdict(rule, 8.9177, {}, k_lower), fail);
    EXPECT_EQ(verdict(rule, 9.05, {}, k_lower), undetermined);
    EXPECT_EQ(verdict(rule, 9.0823, {}, k_lower), pass);
    EXPECT_EQ(verdict(rule, 9.9, {.probability = 0.99}), undetermined);
    // A factor from a table, 0.825 U for k = 2.
    const ConformityDecision tabled = decide(rule, 9.9175, {.guard_factor = 0.825});
    EXPECT_EQ(tabled.verdict, pass);
    EXPECT_EQ(verdict(rule, 9.9176, {.guard_factor = 0.825}), undetermined);
    EXPECT_EQ(verdict(rule, 10.0826, {.guard_factor = 0.825}), fail);
    // Narrow tolerances: both tails, then nothing at all.
    const ConformityDecision narrow = decide_conformity(rule, {}, k_symmetric_tolerance, normal_value(0.25, 0.45));
    EXPECT_EQ(narrow.verdict, undetermined);
    EXPECT_TRUE(agrees(*narrow.acceptance.upper, 0.247379946360962, 1e-11));
    EXPECT_EQ(decide_conformity(rule, {}, k_symmetric_tolerance, normal_value(0.24, 0.45)).verdict, pass);
    EXPECT_EQ(decide_conformity(rule, {}, k_symmetric_tolerance, normal_value(0.0, 0.52)).verdict, not_applicable);
    EXPECT_EQ(decide_conformity(rule, {}, k_symmetric_tolerance, normal_value(5.0, 0.52)).verdict, fail);
}

/// Half of the tolerance is 1; y = 0.9 unless said otherwise.
ConformityDecision z540_3(const Parameters& parameters, double ratio, double y = 0.9) {
    return decide_conformity(DecisionRule::z540_3, parameters, k_symmetric_tolerance, normal_value(y, 0.5 / ratio));
}

TEST(DecideConformity, Dr09GuardBandsOfTheHandbook) {
    struct Row {
        double ratio;
        const char *a6, *a_rds, *a5;
    };
    for (const Row& row : std::vector<Row>{{1.0, "0.5427", "0", "0"},
                                           {1.5, "0.7599", "0.7454", "0.333"},
                                           {2.0, "0.8592", "0.8660", "0.500"},
                                           {3.0, "0.9482", "0.9428", "0.667"},
                                           {4.0, "0.9867", "0.9682", "0.750"},
                                           {4.6, "1.0000", "0.9761", "0.783"},
                                           {6.0, "1.0000", "0.9860", "0.833"}}) {
        EXPECT_NEAR(*z540_3({.method = "6"}, row.ratio).acceptance.upper, test::number(row.a6), 5.1e-5) << row.ratio;
        EXPECT_NEAR(*z540_3({.method = "rds"}, row.ratio).acceptance.upper, test::number(row.a_rds), 5.1e-5);
        EXPECT_NEAR(*z540_3({.method = "5"}, row.ratio).acceptance.upper, test::number(row.a5), 5.1e-4);
        EXPECT_TRUE(agrees(*z540_3({.method = "rp10"}, row.ratio).acceptance.upper,
                           std::min(1.0, 1.25 - 1.0 / row.ratio), 1e-14));
    }
    const ConformityDecision decision = z540_3({.method = "6"}, 2.0, 0.86);
    EXPECT_EQ(decision.verdict, fail);
    EXPECT_EQ(z540_3({.method = "6"}, 2.0, 0.859).verdict, pass);
    EXPECT_EQ(decision.formula, "AL = TL + M·U, AU = TU − M·U, M = 1.04 − exp(0.38·ln TUR − 0.54), not below 0");
    EXPECT_TRUE(prints_as(100.0 * *decision.false_accept, "1.92"));  // worst case over the reliability
    EXPECT_FALSE(decision.false_reject);
    EXPECT_NE(decision.note.find("largest one of all normal populations"), std::string::npos) << decision.note;
    EXPECT_EQ(z540_3({.method = "rds"}, 2.0, 0.867).verdict, fail);
    EXPECT_EQ(z540_3({.method = "rds"}, 2.0, 0.866).verdict, pass);
    EXPECT_EQ(z540_3({.method = "rds"}, 1.0, 0.0).verdict, not_applicable);  // the zone is one value
    EXPECT_EQ(z540_3({.method = "rp10"}, 2.0, 0.76).verdict, fail);
    EXPECT_EQ(z540_3({.method = "5"}, 2.0, -0.5).verdict, pass);
}

TEST(DecideConformity, Dr09WhereNoValueCanPass) {
    for (const char* method : {"5", "6", "rds", "rp10"}) {
        const ConformityDecision decision = z540_3({.method = method}, 0.5, 0.0);
        EXPECT_EQ(decision.verdict, not_applicable) << method;
        EXPECT_FALSE(decision.false_accept) << method;
        EXPECT_NE(decision.note.find("DR-09 cannot be applied: "), std::string::npos) << method;
    }
    const Parameters wide{.population_deviation = 3.0, .method = "3"};
    EXPECT_EQ(z540_3(wide, 0.25, 0.0).verdict, not_applicable);
    Parameters with_alternative = wide;
    with_alternative.alternative = DecisionRule::simple_acceptance;
    const ConformityDecision other = z540_3(with_alternative, 0.25, 0.0);
    EXPECT_EQ(other.verdict, pass);
    EXPECT_EQ(other.rule, DecisionRule::simple_acceptance);
}

TEST(DecideConformity, Dr09RisksOfAPopulation) {
    // EOPR 0.9, TUR 2, 1 %: w by Brent's method with SciPy. Unguarded 2.264 %.
    for (const char* method : {"1", "2"}) {
        const ConformityDecision decision =
            z540_3({.probability = 0.01, .population_reliability = 0.9, .method = method}, 2.0);
        EXPECT_EQ(decision.verdict, fail);
        EXPECT_TRUE(agrees(decision.guard_band, 0.154418217216571, 1e-11));
        EXPECT_TRUE(agrees(*decision.false_accept, 0.01, 1e-11));
        EXPECT_TRUE(agrees(*decision.false_reject, 0.108322438029831, 1e-10));
        EXPECT_EQ(decision.formula, "AL = TL + w, AU = TU − w, w ≥ 0 the smallest with global PFA ≤ 0.01");
        EXPECT_EQ(decision.note, "");
    }
    const ConformityDecision conditional =
        z540_3({.probability = 0.01, .population_reliability = 0.9, .method = "3"}, 2.0);
    EXPECT_TRUE(agrees(conditional.guard_band, 0.193420634667528, 1e-11));
    EXPECT_TRUE(agrees(*conditional.false_accept, 0.00780182322978012, 1e-10));
    // Where the plain risk is below 2 %, no guard band is needed.
    const ConformityDecision plain = z540_3({.population_deviation = 0.5, .method = "1"}, 4.0, 1.0);
    EXPECT_EQ(plain.guard_band, 0.0);
    EXPECT_EQ(plain.verdict, pass);
    EXPECT_TRUE(prints_as(100.0 * *plain.false_accept, "0.8006"));
    EXPECT_TRUE(prints_as(100.0 * *plain.false_reject, "1.4851"));
}

TEST(DecideConformity, Dr09PosteriorOfOneValue) {
    // s0 = 0.5, u = 0.25: by Brent's method with SciPy.
    const Parameters parameters{.population_deviation = 0.5, .method = "4"};
    const ConformityDecision decision = z540_3(parameters, 2.0);
    EXPECT_EQ(decision.verdict, fail);
    EXPECT_TRUE(agrees(*decision.acceptance.upper, 0.675959728372843, 1e-11));
    EXPECT_TRUE(agrees(*decision.acceptance.lower, -0.675959728372843, 1e-11));
    EXPECT_TRUE(agrees(1.0 - decision.conformance_probability, 0.105248850027676, 1e-12));
    EXPECT_TRUE(agrees(*decision.largest_specific_risk, 0.02, 1e-11));
    EXPECT_EQ(z540_3(parameters, 2.0, 0.675).verdict, pass);
    Parameters off_centre = parameters;
    off_centre.population_centre = 0.1;
    const ConformityDecision moved = z540_3(off_centre, 2.0);
    EXPECT_TRUE(agrees(*moved.acceptance.upper, 0.650959728372843, 1e-11));
    EXPECT_TRUE(agrees(*moved.acceptance.lower, -0.700959728372843, 1e-11));
    EXPECT_TRUE(agrees(1.0 - moved.conformance_probability, 0.122464389118019, 1e-12));
}

TEST(DecideConformity, Dr09PosteriorOfAMeasurementThatIsNotNormal) {
    const Parameters parameters{.population_deviation = 0.05, .population_centre = 10.0, .method = "4"};
    const ToleranceLimits limits{.lower = 9.9, .upper = 10.1};
    const Distribution rectangle = Distribution::uniform(10.0739, 0.03);
    const double u = standard_deviation(rectangle);
    const MeasuredValue y{
        .value = 10.0739, .standard_uncertainty = u, .expanded_uncertainty = 1.65 * u, .distribution = [&](double x) {
            return lower_tail_probability(rectangle, x);
        }};
    const ConformityDecision decision = decide_conformity(DecisionRule::z540_3, parameters, limits, y);
    EXPECT_EQ(decision.verdict, fail) << "1.9 % would be the risk of a normal distribution";
    EXPECT_TRUE(prints_as(100.0 * (1.0 - decision.conformance_probability), "2.276"));
    ASSERT_TRUE(decision.acceptance.upper);
    EXPECT_LT(*decision.acceptance.upper, y.value);
    EXPECT_NEAR(*decision.largest_specific_risk, 0.02, 1e-4);
    // With 3 degrees of freedom: as wide at 2 % as a normal distribution of u·3.48/2.05. The risk is 0.78 % by
    // quadrature, 1.5 % of that normal one, and 0.2 % of one with u.
    const MeasuredValue few{
        .value = 10.064, .standard_uncertainty = 0.015, .expanded_uncertainty = 0.05, .degrees_of_freedom = 3.0};
    const ConformityDecision wide = decide_conformity(DecisionRule::z540_3, parameters, limits, few);
    EXPECT_EQ(wide.verdict, pass);
    EXPECT_NEAR(1.0 - wide.conformance_probability, 0.015, 0.001);
    EXPECT_NE(wide.note.find("taken as normally distributed"), std::string::npos);
}

/// y + side·u (n − G)/√n with G of a gamma distribution of a whole order n: skewed to the left for side = 1.
MeasuredValue skewed(double y, double u, int n, double side) {
    const auto above = [n](double t) {  // P(G > t)
        double term = std::exp(-t);
        double sum = 0.0;
        for (int k = 0; k < n; term *= t / ++k) {
            sum += term;
        }
        return t <= 0.0 ? 1.0 : sum;
    };
    const double root = std::sqrt(static_cast<double>(n));
    return {.value = y, .standard_uncertainty = u, .expanded_uncertainty = 2.0 * u, .distribution = [=](double x) {
                const double P = above(n - side * root * (x - y) / u);
                return side > 0.0 ? P : 1.0 - P;
            }};
}

/// P(Y outside of 10 ± 0.1) of `skewed` to the left by Bayes, by the trapezoidal rule over ± 12 s0.
double posterior_of_skewed(double y, double u, int n, double s0, double centre) {
    constexpr int k_steps = 20000;
    const double root = std::sqrt(static_cast<double>(n));
    std::vector<std::pair<double, double>> logarithms;
    double most = -std::numeric_limits<double>::infinity();
    for (int i = 0; i <= k_steps; ++i) {
        const double x = centre + s0 * (24.0 * i / k_steps - 12.0);
        const double t = n - root * (x - y) / u;
        if (t > 0.0) {
            logarithms.emplace_back(x, (n - 1) * std::log(t) - t - 0.5 * std::pow((x - centre) / s0, 2));
            most = std::max(most, logarithms.back().second);
        }
    }
    double all = 0.0, outside = 0.0;
    for (const auto& [x, logarithm] : logarithms) {
        const double weight = std::exp(logarithm - most);
        all += weight;
        outside += x < 9.9 || x > 10.1 ? weight : 0.0;
    }
    return outside / all;
}

TEST(DecideConformity, Dr09PosteriorOfASkewedMeasurementHasNoLimitsOfItsTail) {
    const ToleranceLimits limits{.lower = 9.9, .upper = 10.1};
    const auto decide = [&](const Parameters& parameters, const MeasuredValue& y) {
        return decide_conformity(DecisionRule::z540_3, parameters, limits, y);
    };
    for (const int n : {9, 16, 40}) {
        for (const double u : {0.02, 0.05}) {
            for (const double s0 : {0.01, 0.02, 0.03, 0.05}) {
                const Parameters parameters{.population_deviation = s0, .population_centre = 10.0, .method = "4"};
                const ConformityDecision left = decide(parameters, skewed(10.02, u, n, 1.0));
                const ConformityDecision right = decide(parameters, skewed(9.98, u, n, -1.0));
                EXPECT_EQ(left.verdict, pass);
                EXPECT_NEAR(left.conformance_probability, 1.0 - posterior_of_skewed(10.02, u, n, s0, 10.0), 1e-5);
                ASSERT_TRUE(left.acceptance.lower && left.acceptance.upper && right.acceptance.upper);
                EXPECT_NEAR(*left.acceptance.upper - 10.0, 10.0 - *right.acceptance.lower, 1e-6 * u);
                EXPECT_NEAR(10.0 - *left.acceptance.lower, *right.acceptance.upper - 10.0, 1e-6 * u);
                for (const double limit : {*left.acceptance.lower, *left.acceptance.upper}) {
                    EXPECT_LT(posterior_of_skewed(limit, u, n, s0, 10.0), 0.0203) << n << " " << u << " " << s0;
                }
                // What is shown farther out is never accepted, and never said to be in the zone.
                for (const double beyond : {0.5, 3.0, 6.0, 12.0, 25.0}) {
                    const ConformityDecision far =
                        decide(parameters, skewed(*left.acceptance.upper + beyond * u, u, n, 1.0));
                    EXPECT_NE(far.verdict, pass) << n << " " << u << " " << s0 << " " << beyond;
                    if (far.note.find("contradict") != std::string::npos && far.verdict == fail) {
                        EXPECT_LT(far.conformance_probability, 0.05) << "that of the measurement alone";
                    }
                }
            }
        }
    }
    // A population beside the tolerance: the cut end of the tail, which lies between the limits, accepts nothing.
    const ConformityDecision beside =
        decide({.population_deviation = 0.01, .population_centre = 9.7, .method = "4"}, skewed(10.3, 0.02, 9, 1.0));
    EXPECT_EQ(beside.verdict, fail);
    EXPECT_FALSE(beside.acceptance.upper);
}

TEST(DecideConformity, TrialsDecideOnlyWhereTheirNumberDoes) {
    // P(Y > 10) is 5 % to within the scatter of 10 000 trials: 3·√(0.05·0.95/10⁴) = 0.65 %.
    const auto value_with_risk = [](double risk, double trials) {
        const MeasuredValue normal = normal_value(10.0 - upper_quantile(Distribution::normal(0.0, 0.05), risk), 0.05);
        MeasuredValue counted = normal;
        counted.distribution = [normal](double x) { return distribution_function(normal, x); };
        counted.trials = trials;
        return counted;
    };
    for (const double risk : {0.044, 0.0499, 0.0501, 0.056}) {
        for (const auto& [rule, open] : {std::pair(DecisionRule::specific_risk, not_applicable),
                                         std::pair(DecisionRule::iso_14253_1, undetermined)}) {
            const Parameters parameters{.probability = rule == DecisionRule::specific_risk ? 0.05 : 0.95};
            const ConformityDecision counted =
                decide_conformity(rule, parameters, k_upper, value_with_risk(risk, 10000.0));
            EXPECT_EQ(counted.verdict, open) << risk;
            EXPECT_NE(counted.note.find("do not decide"), std::string::npos);
            const ConformityDecision sure = decide_conformity(rule, parameters, k_upper, value_with_risk(risk, 1e8));
            EXPECT_EQ(sure.verdict == pass, risk < 0.05) << risk;
            EXPECT_EQ(sure.note, "");
        }
    }
    EXPECT_EQ(
        decide_conformity(DecisionRule::specific_risk, {.probability = 0.05}, k_upper, value_with_risk(0.043, 10000.0))
            .verdict,
        pass);
    // Of a risk of which no trial is expected, the outermost trial is no limit of acceptance; one far beyond it fails.
    for (const double trials : {1e6, 1e8}) {
        for (const double risk : {1e-12, 1e-3}) {
            const ConformityDecision d = decide_conformity(DecisionRule::specific_risk, {.probability = 1e-7}, k_upper,
                                                           value_with_risk(risk, trials));
            EXPECT_EQ(d.verdict, risk > 1e-7 ? fail : trials < 1e7 ? not_applicable : pass);
            EXPECT_EQ(d.acceptance.upper.has_value(), trials > 1e7);
            EXPECT_EQ(d.largest_specific_risk.has_value(), trials > 1e7);
            EXPECT_EQ(d.guard_band > 0.0, trials > 1e7);
        }
    }
    EXPECT_EQ(decide_conformity(DecisionRule::guard_band_u, {}, k_upper, value_with_risk(0.05, 10.0)).note, "")
        << "a rule with U does not ask for the probability";
}

TEST(DecideConformity, Dr09RatioWhereARiskIsImpracticable) {
    EXPECT_EQ(z540_3({.test_uncertainty_ratio = 4.0}, 4.0, 1.0).verdict, pass);
    EXPECT_EQ(z540_3({.test_uncertainty_ratio = 4.0}, 4.0, 1.01).verdict, fail);
    EXPECT_EQ(z540_3({.test_uncertainty_ratio = 4.0}, 3.9, 0.5).verdict, not_applicable);
    EXPECT_EQ(z540_3({.test_uncertainty_ratio = 4.0}, 4.0, 1.0).formula, "AL = TL, AU = TU, if TUR ≥ 4");
    // A plain 4:1 does not guarantee 2 %.
    EXPECT_TRUE(prints_as(100.0 * *z540_3({.test_uncertainty_ratio = 4.0}, 4.0, 1.0).false_accept, "2.24"));
}

TEST(DecideConformity, Dr09OneSided) {
    const auto decide_upper = [](const Parameters& parameters, double y) {
        return decide_conformity(DecisionRule::z540_3, parameters, {.upper = 1.0}, normal_value(y, 0.1));
    };
    const ConformityDecision decision = decide_upper(
        {.probability = 0.001, .population_deviation = 0.4, .population_centre = 0.2, .method = "1"}, 0.95);
    EXPECT_TRUE(agrees(*decision.false_accept, 0.001, 1e-11));
    EXPECT_EQ(decision.verdict, fail);
    EXPECT_FALSE(decision.acceptance.lower);
    const ConformityDecision by_U = decide_upper({.method = "5"}, 0.8);
    EXPECT_EQ(by_U.verdict, pass);
    EXPECT_FALSE(by_U.false_accept);  // nothing is known about the items
    const ConformityDecision posterior =
        decide_upper({.population_deviation = 0.4, .population_centre = 0.2, .method = "4"}, 0.5);
    EXPECT_EQ(posterior.verdict, pass);
    EXPECT_FALSE(posterior.acceptance.lower);
}

TEST(DecideConformity, Dr10StringentAndRelaxed) {
    const auto rule = DecisionRule::b89_7_3_1;
    EXPECT_EQ(verdict(rule, 9.99, {.test_uncertainty_ratio = 4.0}), pass);
    EXPECT_EQ(verdict(rule, 10.01, {.test_uncertainty_ratio = 4.0}), fail);
    EXPECT_EQ(verdict(rule, 9.5, {.test_uncertainty_ratio = 6.0}), not_applicable);
    EXPECT_EQ(verdict(rule, 9.95, {.guard_factor = 0.5}), pass);
    EXPECT_EQ(verdict(rule, 9.96, {.guard_factor = 0.5}), fail);
    EXPECT_EQ(verdict(rule, 10.05, {.guard_factor = -0.5}), pass);
    EXPECT_EQ(verdict(rule, 10.06, {.guard_factor = -0.5}, k_upper), fail);
    EXPECT_EQ(verdict(rule, 8.95, {.guard_factor = -0.5}, k_lower), pass);
    EXPECT_EQ(decide(rule, 9.5, {.guard_factor = 0.5, .test_uncertainty_ratio = 4.0}).formula,
              "AL = TL + r·U, AU = TU − r·U, r = 0.5, if TUR ≥ 4");
    EXPECT_EQ(decide(rule, 9.5, {.test_uncertainty_ratio = 6.0, .alternative = DecisionRule::three_way}).rule,
              DecisionRule::three_way);
}

TEST(DecideConformity, Dr11RejectsOnlyWhatIsProven) {
    EXPECT_EQ(verdict(DecisionRule::relaxed, 10.1), pass);
    EXPECT_EQ(verdict(DecisionRule::relaxed, 10.101), fail);
    EXPECT_EQ(verdict(DecisionRule::relaxed, 8.9, {}, k_lower), pass);
    EXPECT_EQ(verdict(DecisionRule::relaxed, 8.89, {}, k_lower), fail);
    EXPECT_EQ(verdict(DecisionRule::relaxed, 10.2, {}, k_upper), fail);
    const ConformityDecision decision = decide(DecisionRule::relaxed, 10.1);
    EXPECT_EQ(decision.formula, "AL = TL − U, AU = TU + U");
    EXPECT_EQ(decision.guard_band, -0.1);
    EXPECT_TRUE(prints_as(100.0 * *decision.largest_specific_risk, "97.72"));
    EXPECT_LT(decide(DecisionRule::relaxed, 10.101).specific_risk, 0.025);
    // Even the poorest measurement can be decided: nothing is guarded.
    EXPECT_EQ(decide_conformity(DecisionRule::relaxed, {}, k_limits, normal_value(9.5, 5.0)).verdict, pass);
}

TEST(DecideConformity, Dr12PrescribedLimits) {
    EXPECT_EQ(verdict(DecisionRule::prescribed, 10.0), pass);
    EXPECT_EQ(verdict(DecisionRule::prescribed, 10.01), fail);
    EXPECT_EQ(verdict(DecisionRule::prescribed, 8.9, {}, k_lower), fail);
    EXPECT_EQ(decide(DecisionRule::prescribed, 10.0).guard_band, 0.0);
}

TEST(DecideConformity, Dr13AsAgreed) {
    EXPECT_EQ(verdict(DecisionRule::agreed, 9.98, {.guard_band = 0.02}), pass);
    EXPECT_EQ(verdict(DecisionRule::agreed, 9.981, {.guard_band = 0.02}), fail);
    EXPECT_EQ(verdict(DecisionRule::agreed, 10.02, {.guard_band = -0.02}, k_upper), pass);
    EXPECT_EQ(verdict(DecisionRule::agreed, 9.12, {.guard_factor = 1.2}, k_lower), pass);
    EXPECT_EQ(verdict(DecisionRule::agreed, 9.11, {.guard_factor = 1.2}, k_lower), fail);
    EXPECT_EQ(decide(DecisionRule::agreed, 9.5, {.guard_band = 0.02}).formula, "AL = TL + w, AU = TU − w, w as agreed");
}

TEST(DecideConformity, OnlyWhatIsProvenFailsWhereNothingCanPass) {
    // U = 0.6 against a tolerance of ±0.5 about 9.5.
    for (const auto& [rule, parameters] :
         std::vector<std::pair<DecisionRule, Parameters>>{{DecisionRule::guard_band_u, {}},
                                                          {DecisionRule::guard_band_factor, {.guard_factor = 1.0}},
                                                          {DecisionRule::non_binary, {}},
                                                          {DecisionRule::three_way, {}},
                                                          {DecisionRule::specific_risk, {.probability = 0.02}},
                                                          {DecisionRule::iso_14253_1, {}},
                                                          {DecisionRule::iso_14253_1, {.guard_factor = 1.0}},
                                                          {DecisionRule::z540_3, {.method = "5"}},
                                                          {DecisionRule::b89_7_3_1, {.guard_factor = 1.0}},
                                                          {DecisionRule::agreed, {.guard_band = 0.6}}}) {
        for (const double y : {8.6, 9.0, 9.5, 10.2, 10.4}) {
            const ConformityDecision decision = decide_conformity(rule, parameters, k_limits, normal_value(y, 0.3));
            EXPECT_EQ(decision.verdict, not_applicable) << decision_rule_id(rule) << ' ' << y;
            EXPECT_NE(decision.note.find("no value can pass"), std::string::npos) << decision.note;
            EXPECT_FALSE(decision.largest_specific_risk);
            if (decision.acceptance.lower) {
                EXPECT_GT(*decision.acceptance.lower, *decision.acceptance.upper);
            }
        }
        for (const double y : {-100.0, 8.39, 10.61, 50.0, 100.0}) {  // beyond the limits by more than U
            const ConformityDecision decision = decide_conformity(rule, parameters, k_limits, normal_value(y, 0.3));
            EXPECT_EQ(decision.verdict, fail) << decision_rule_id(rule) << ' ' << y;
            EXPECT_EQ(decision.specific_risk, decision.conformance_probability);
            EXPECT_NE(decision.note.find("Nonconformity is proven all the same"), std::string::npos) << decision.note;
            EXPECT_NE(decision.note.find("accepts no value here: no value can pass"), std::string::npos);
            EXPECT_FALSE(decision.largest_specific_risk);
        }
        // With one limit there is always a value that passes.
        EXPECT_EQ(decide_conformity(rule, parameters, k_upper, normal_value(-100.0, 0.3)).verdict, pass);
    }
    // The proof of ISO 14253-1 begins 1.645 u beyond the limit. A tolerance that is narrow against u proves nothing,
    // although every value has a small probability of conformity.
    const auto iso = [](double y, double u) {
        return decide_conformity(DecisionRule::iso_14253_1, {}, k_limits, normal_value(y, u)).verdict;
    };
    EXPECT_EQ(iso(10.0 + 1.644 * 0.3, 0.3), not_applicable);
    EXPECT_EQ(iso(10.0 + 1.646 * 0.3, 0.3), fail);
    EXPECT_EQ(iso(9.5, 100.0), not_applicable);
    EXPECT_EQ(iso(10.1, 100.0), not_applicable);
    EXPECT_EQ(iso(180.0, 100.0), fail);
}

// U = T: A_L and A_U were the same or not by the last bit of a conversion, and the item failed or the rule was not applicable.
TEST(DecideConformity, AZoneWithoutWidthAcceptsNothing) {
    for (const double tolerance : {1.1, 3.0, 0.7, 0.03, 12.0, 1e-9}) {
        for (const double unit : {1.0, 1e-3, 1e-6, 1e3}) {
            const double T = tolerance * unit;
            for (int bits = -3; bits <= 3; ++bits) {
                const double U = T * (1.0 + bits * std::numeric_limits<double>::epsilon());
                for (const double y : {-0.6 * T, 0.0, 0.6 * T, T}) {
                    const MeasuredValue value{.value = y, .standard_uncertainty = U / 2.0, .expanded_uncertainty = U};
                    const ToleranceLimits limits{.lower = -T, .upper = T};
                    for (const DecisionRule rule :
                         {DecisionRule::guard_band_u, DecisionRule::non_binary, DecisionRule::three_way}) {
                        const ConformityDecision decision = decide_conformity(rule, {}, limits, value);
                        EXPECT_EQ(decision.verdict, not_applicable)
                            << decision_rule_id(rule) << ' ' << T << ' ' << bits;
                        EXPECT_TRUE(decision.accepts_nothing);
                    }
                }
            }
            const MeasuredValue narrower{
                .value = 0.0, .standard_uncertainty = 0.4999999 * T, .expanded_uncertainty = 0.9999998 * T};
            EXPECT_EQ(decide_conformity(DecisionRule::guard_band_u, {}, {.lower = -T, .upper = T}, narrower).verdict,
                      pass);
        }
    }
    const ConformityDecision agreed =
        decide_conformity(DecisionRule::agreed, {.guard_band = 1.0}, k_symmetric_tolerance, normal_value(0.0, 0.1));
    EXPECT_EQ(agreed.note,
              "DR-13 cannot be applied: no value can pass, because the guard band is half of the "
              "tolerance.");
}

TEST(DecideConformity, WhereTheRatioIsNotReachedTheFarFailAndNothingIsPrinted) {
    const ConformityDecision far =
        decide(DecisionRule::simple_acceptance_with_ratio, 10.11, {.test_uncertainty_ratio = 6.0});
    EXPECT_EQ(far.verdict, fail);
    EXPECT_FALSE(far.acceptance.upper);
    EXPECT_EQ(
        far.note,
        "DR-02 accepts no value here: the test uncertainty ratio is below the least one of the rule. Nonconformity "
        "is proven all the same: y ± U lies outside of the limits.");
    EXPECT_EQ(decide(DecisionRule::simple_acceptance_with_ratio, 10.09, {.test_uncertainty_ratio = 6.0}).verdict,
              not_applicable);
    // The agreed alternative decides first: this one accepts far outside.
    EXPECT_EQ(verdict(DecisionRule::simple_acceptance_with_ratio, 10.11,
                      {.guard_band = -0.5, .test_uncertainty_ratio = 6.0, .alternative = DecisionRule::agreed}),
              pass);
}

TEST(DecisionFormula, IsThatOfADecision) {
    for (const auto& [rule, parameters] : every_two_sided_rule()) {
        EXPECT_EQ(decision_formula(rule, parameters, k_limits), decide(rule, 9.7, parameters).formula)
            << decision_rule_id(rule) << ' ' << parameters.method;
        EXPECT_NE(decision_formula(rule, parameters, k_limits), "");
    }
    for (const auto& [rule, parameters] : every_rule()) {
        EXPECT_EQ(decision_formula(rule, parameters, k_upper), decide(rule, 9.7, parameters, k_upper).formula);
    }
    EXPECT_EQ(decision_formula(DecisionRule::guard_band_factor, {}, k_limits), "");
    EXPECT_EQ(decision_formula(DecisionRule::guard_band_u, {}, {}), "");
}

TEST(DecideConformity, SmallRatiosUseBothTails) {
    const auto risk = [](double ratio) {
        return decide_conformity(DecisionRule::simple_acceptance, {}, k_symmetric_tolerance,
                                 normal_value(0.0, 0.5 / ratio));
    };
    EXPECT_TRUE(prints_as(100.0 * risk(1.0).conformance_probability, "95.45"));
    EXPECT_TRUE(prints_as(100.0 * risk(0.8).conformance_probability, "89.0"));
    EXPECT_TRUE(agrees(*risk(1.0).largest_specific_risk, 0.5 + 3.167124183312e-05, 1e-10));
}

TEST(DecideConformity, ValuesOnALimitPassByHandCalculation) {
    // In double precision 0.3 − 0.1 is below 0.2 by one unit of the last place.
    const MeasuredValue y = {.value = 0.2, .standard_uncertainty = 0.05, .expanded_uncertainty = 0.1};
    EXPECT_EQ(decide_conformity(DecisionRule::guard_band_u, {}, {.upper = 0.3}, y).verdict, pass);
    EXPECT_EQ(mirrored(DecisionRule::guard_band_u, {}, {.upper = 0.3}, y).verdict, pass);
    MeasuredValue beyond = y;
    beyond.value = 0.2 + 1e-12;
    EXPECT_EQ(decide_conformity(DecisionRule::guard_band_u, {}, {.upper = 0.3}, beyond).verdict, fail);
}

TEST(DecideConformity, MirrorImagesHaveTheSameVerdict) {
    const auto check = [](DecisionRule rule, const Parameters& parameters, const ToleranceLimits& limits, double y) {
        const ConformityDecision one = decide_conformity(rule, parameters, limits, normal_value(y, 0.05));
        const ConformityDecision other = mirrored(rule, parameters, limits, normal_value(y, 0.05));
        EXPECT_EQ(one.verdict, other.verdict) << decision_rule_id(rule) << ' ' << parameters.method << ' ' << y;
        EXPECT_NEAR(one.conformance_probability, other.conformance_probability, 1e-13);
        EXPECT_NEAR(one.guard_band, other.guard_band, 1e-12);
    };
    for (double y = 8.8; y < 10.2; y += 0.0173) {
        for (const auto& [rule, parameters] : every_rule()) {
            check(rule, parameters, k_upper, y);
            check(rule, parameters, k_lower, y);
        }
    }
    for (double y = 8.8; y < 10.2; y += 0.173) {
        for (const auto& [rule, parameters] : every_two_sided_rule()) {
            check(rule, parameters, k_limits, y);
        }
    }
}

TEST(DecideConformity, VerdictDoesNotDependOnTheUnit) {
    for (const double scale : {1e-9, 25.4, 1.0 / 3.0, 1e6}) {
        for (const auto& [rule, parameters] : every_two_sided_rule()) {
            Parameters scaled = parameters;
            for (std::optional<double>* number :
                 {&scaled.guard_band, &scaled.largest_U, &scaled.population_deviation, &scaled.population_centre}) {
                if (*number) {
                    **number *= scale;
                }
            }
            for (const double y : {8.85, 8.9, 9.0, 9.05, 9.1, 9.5, 9.9, 9.95, 10.0, 10.1, 10.15}) {
                const ConformityDecision one = decide_conformity(rule, parameters, k_limits, normal_value(y, 0.05));
                const ConformityDecision other =
                    decide_conformity(rule, scaled, {9.0 * scale, 10.0 * scale}, normal_value(y * scale, 0.05 * scale));
                EXPECT_EQ(one.verdict, other.verdict)
                    << decision_rule_id(rule) << ' ' << parameters.method << ' ' << y << ' ' << scale;
                EXPECT_NEAR(one.conformance_probability, other.conformance_probability, 1e-12);
                EXPECT_NEAR(one.guard_band * scale, other.guard_band, 1e-10 * scale);
            }
        }
    }
}

TEST(DecideConformity, RisksAreProbabilitiesAndGuardedOnesAreSmall) {
    for (const auto& [rule, parameters] : every_two_sided_rule()) {
        for (double y = 8.8; y < 10.2; y += 0.05) {
            const ConformityDecision decision = decide_conformity(rule, parameters, k_limits, normal_value(y, 0.05));
            for (const double p : {decision.conformance_probability, decision.specific_risk,
                                   decision.largest_specific_risk.value_or(0.0), decision.false_accept.value_or(0.0),
                                   decision.false_reject.value_or(0.0)}) {
                EXPECT_GE(p, 0.0);
                EXPECT_LE(p, 1.0);
            }
            if (decision.verdict == pass) {
                EXPECT_LE(decision.specific_risk, *decision.largest_specific_risk * (1.0 + 1e-9) + 1e-15)
                    << decision_rule_id(rule) << ' ' << y;
            }
        }
    }
}

TEST(DecideConformity, PopulationAddsGlobalRisksToAnyRule) {
    const ConformityDecision decision =
        decide_conformity(DecisionRule::simple_acceptance, {.population_deviation = 0.5}, k_symmetric_tolerance,
                          normal_value(0.0, 0.125));
    EXPECT_TRUE(prints_as(100.0 * *decision.false_accept, "0.8006"));
    MeasuredValue few = normal_value(0.0, 0.125);
    few.degrees_of_freedom = 7.0;
    EXPECT_EQ(
        decide_conformity(DecisionRule::simple_acceptance, {.population_deviation = 0.5}, k_symmetric_tolerance, few)
            .note,
        "The global risk takes the measurement as normally distributed with u.");
}

/// max(N(0.2, 1), 0) and |N(0.2, 1)|: amounts, which no limit at 0 can find below it.
TEST(DecideConformity, ALimitThatTheQuantityCannotPassIsNoRiskOfAnotherValue) {
    const auto normal = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
    const auto clipped = [&](double x, bool with) { return x < 0.0 || (x == 0.0 && !with) ? 0.0 : normal(x - 0.2); };
    const auto folded = [&](double x, bool) { return x <= 0.0 ? 0.0 : normal(x - 0.2) - normal(-x - 0.2); };
    for (const auto& shape :
         {std::function<double(double, bool)>(clipped), std::function<double(double, bool)>(folded)}) {
        const MeasuredValue y{.value = 0.5,
                              .standard_uncertainty = 0.6,
                              .expanded_uncertainty = 1.7,
                              .distribution = [shape](double x) { return shape(x, true); },
                              .distribution_below = [shape](double x) { return shape(x, false); }};
        const ConformityDecision simple =
            decide_conformity(DecisionRule::simple_acceptance, {}, {.lower = 0.0, .upper = 3.0}, y);
        EXPECT_EQ(simple.verdict, ConformityVerdict::pass);
        EXPECT_FALSE(simple.largest_specific_risk);
        EXPECT_DOUBLE_EQ(simple.specific_risk, 1.0 - shape(3.0, true));
        const ConformityDecision by_risk =
            decide_conformity(DecisionRule::specific_risk, {.probability = 0.05}, {.lower = 0.0, .upper = 3.0}, y);
        EXPECT_EQ(by_risk.verdict, ConformityVerdict::pass);
        EXPECT_EQ(by_risk.acceptance.lower, 0.0);
        EXPECT_LT(*by_risk.acceptance.upper, 3.0);
        EXPECT_EQ(by_risk.largest_specific_risk, 0.05);
        // A limit that it can pass: as ever.
        EXPECT_TRUE(decide_conformity(DecisionRule::simple_acceptance, {}, {.lower = 0.4, .upper = 3.0}, y)
                        .largest_specific_risk);
        EXPECT_TRUE(decide_conformity(DecisionRule::simple_acceptance, {}, {.lower = -1.0, .upper = 3.0}, y)
                        .largest_specific_risk);
    }
}

/// 0 is 4.2 u away: that no trial falls below it is chance, and no bound that would be the limit of acceptance itself.
TEST(DecideConformity, ALimitFarFromTheTrialsIsNoBound) {
    const auto normal = [](double x) { return 0.5 * std::erfc(-x / std::sqrt(2.0)); };
    for (const double value : {4.2, 4.5, 4.7, 5.1}) {
        const auto shape = [=](double x) { return x < 0.0 ? 0.0 : normal(x - value); };
        const MeasuredValue y{.value = value,
                              .standard_uncertainty = 1.0,
                              .expanded_uncertainty = 2.0,
                              .distribution = shape,
                              .distribution_below = [=](double x) { return x <= 0.0 ? 0.0 : shape(x); },
                              .trials = 1e5};
        const ToleranceLimits limits{.lower = 0.0, .upper = 20.0};
        const ConformityDecision by_risk =
            decide_conformity(DecisionRule::specific_risk, {.probability = 0.05}, limits, y);
        EXPECT_NEAR(by_risk.acceptance.lower.value(), 1.645, 1e-3) << value;
        const ConformityDecision simple = decide_conformity(DecisionRule::simple_acceptance, {}, limits, y);
        EXPECT_NEAR(simple.largest_specific_risk.value_or(0.0), 0.5, 1e-3) << value;
    }
}

TEST(DecideConformity, RefusesLimitsValuesAndRules) {
    const auto code = [](DecisionRule rule, const Parameters& parameters, const ToleranceLimits& limits,
                         const MeasuredValue& y) {
        return test::code_of<InputError>([&] { (void)decide_conformity(rule, parameters, limits, y); });
    };
    const MeasuredValue fine = normal_value(0.0, 0.1);
    EXPECT_EQ(code(DecisionRule::simple_acceptance, {}, {}, fine), "GC-GUM-0080");
    EXPECT_EQ(code(DecisionRule::simple_acceptance, {}, k_limits, normal_value(0.0, 0.0)), "GC-GUM-0081");
    EXPECT_EQ(code(DecisionRule::agreed, {}, k_limits, fine), "GC-GUM-0082");
    EXPECT_EQ(
        message_of<InputError>([&] { (void)decide_conformity(DecisionRule::guard_band_factor, {}, k_limits, fine); }),
        "decision rule DR-04 — DR-04 needs guard_factor, the r of w = r·U. — a rule is applied with the parameters "
        "that it has, and with no others — Correct the decision rule of the specification.");
}

TEST(CheckDecisionRule, AcceptsCompleteRules) {
    for (const auto& [rule, parameters] : every_two_sided_rule()) {
        EXPECT_TRUE(check_decision_rule(rule, parameters, k_limits).empty())
            << decision_rule_id(rule) << ' ' << parameters.method;
    }
    for (const auto& [rule, parameters] : every_rule()) {
        EXPECT_TRUE(check_decision_rule(rule, parameters, k_upper).empty()) << decision_rule_id(rule);
    }
}

std::string fault(DecisionRule rule, const Parameters& parameters, const ToleranceLimits& limits = k_limits) {
    const std::vector<std::string> sentences = check_decision_rule(rule, parameters, limits);
    EXPECT_EQ(sentences.size(), 1U) << decision_rule_id(rule) << (sentences.size() > 1 ? sentences[1] : "");
    return sentences.empty() ? "" : sentences.front();
}

TEST(CheckDecisionRule, SaysWhatIsMissing) {
    using enum DecisionRule;
    EXPECT_EQ(fault(simple_acceptance_with_ratio, {}),
              "DR-02 needs test_uncertainty_ratio (the least ratio) or largest_U.");
    EXPECT_EQ(fault(guard_band_factor, {}), "DR-04 needs guard_factor, the r of w = r·U.");
    EXPECT_EQ(fault(specific_risk, {}), "DR-07 needs probability, the largest risk that is accepted.");
    EXPECT_EQ(fault(z540_3, {}),
              "DR-09 needs method (1 to 6, rds or rp10), or test_uncertainty_ratio where a risk is impracticable.");
    for (const char* method : {"1", "2", "3", "4"}) {
        EXPECT_EQ(fault(z540_3, {.method = method}),
                  std::string("Method ") + method + " of DR-09 needs population_reliability or population_deviation.");
    }
    EXPECT_EQ(fault(z540_3, {.population_deviation = 1.0, .method = "1"}, k_upper),
              "A population needs two limits, between which it is centred, or population_centre.");
    for (const char* method : {"6", "rds", "rp10"}) {
        EXPECT_EQ(fault(z540_3, {.method = method}, k_lower),
                  std::string("Method ") + method + " of DR-09 needs two limits.");
    }
    EXPECT_EQ(fault(b89_7_3_1, {}),
              "DR-10 needs guard_factor (the guard band as a part of U), test_uncertainty_ratio, or both.");
    EXPECT_EQ(fault(agreed, {}), "DR-13 needs guard_factor or guard_band, and not both.");
    EXPECT_EQ(fault(simple_acceptance, {}, {}), "The limits cannot be used: no tolerance limit.");
    EXPECT_EQ(fault(simple_acceptance, {}, {2.0, 1.0}),
              "The limits cannot be used: the lower limit 2 is not below the upper limit 1.");
}

TEST(CheckDecisionRule, SaysWhatIsContradictory) {
    using enum DecisionRule;
    EXPECT_EQ(fault(agreed, {.guard_factor = 1.0, .guard_band = 1.0}),
              "DR-13 needs guard_factor or guard_band, and not both.");
    EXPECT_EQ(fault(non_binary, {.guard_factor = 1.0, .guard_band = 1.0}),
              "guard_factor and guard_band are both stated; DR-05 takes one of them, or none for w = U.");
    EXPECT_EQ(fault(iso_14253_1, {.guard_factor = 1.0, .probability = 0.95}),
              "guard_factor and probability are both stated; the one follows from the other in DR-08.");
    EXPECT_EQ(fault(z540_3, {.test_uncertainty_ratio = 4.0, .method = "6"}),
              "method and test_uncertainty_ratio are both stated; the ratio stands in the place of a method.");
    EXPECT_EQ(fault(z540_3, {.population_reliability = 0.9, .population_deviation = 1.0, .method = "1"}),
              "population_reliability and population_deviation are both stated; the one follows from the other.");
    EXPECT_EQ(fault(z540_3, {.probability = 0.01, .method = "6"}),
              "Method 6 of DR-09 has a guard band of its own; a probability other than 0.02 cannot be kept by it.");
    EXPECT_TRUE(check_decision_rule(z540_3, {.probability = 0.02, .method = "6"}, k_limits).empty());
    EXPECT_EQ(fault(z540_3, {.probability = 0.02, .test_uncertainty_ratio = 4.0}),
              "probability is stated, but without a method no risk is calculated.");
    EXPECT_EQ(fault(simple_acceptance, {.population_centre = 9.5}),
              "population_centre is stated without population_reliability or population_deviation.");
    EXPECT_EQ(fault(simple_acceptance, {.population_reliability = 0.9, .population_centre = 11.0}),
              "No population with this population_centre has this population_reliability.");
    EXPECT_EQ(fault(simple_acceptance_with_ratio, {.test_uncertainty_ratio = 4.0}, k_upper),
              "test_uncertainty_ratio is stated, but with one limit alone there is no such ratio.");
}

TEST(CheckDecisionRule, SaysWhatIsNotUsed) {
    using enum DecisionRule;
    for (const DecisionRule rule : {simple_acceptance, guard_band_u, three_way, relaxed, prescribed}) {
        const std::string id = decision_rule_id(rule);
        EXPECT_EQ(fault(rule, {.guard_factor = 0.5}), "guard_factor is stated, but " + id + " does not use it.");
        EXPECT_EQ(fault(rule, {.guard_band = 0.5}), "guard_band is stated, but " + id + " does not use it.");
        EXPECT_EQ(fault(rule, {.probability = 0.5}), "probability is stated, but " + id + " does not use it.");
        EXPECT_EQ(fault(rule, {.test_uncertainty_ratio = 4.0}),
                  "test_uncertainty_ratio is stated, but " + id + " does not use it.");
        EXPECT_EQ(fault(rule, {.largest_U = 4.0}), "largest_U is stated, but " + id + " does not use it.");
        EXPECT_EQ(fault(rule, {.alternative = guard_band_u}), "alternative is stated, but " + id + " does not use it.");
        EXPECT_EQ(fault(rule, {.method = "6"}), "method is stated, but " + id + " does not use it.");
    }
}

TEST(CheckDecisionRule, SaysWhatIsOutOfRange) {
    using enum DecisionRule;
    EXPECT_EQ(fault(guard_band_factor, {.guard_factor = -0.5}),
              "guard_factor is -0.5; it must be finite and not negative.");
    EXPECT_EQ(fault(agreed, {.guard_band = std::numeric_limits<double>::infinity()}),
              "guard_band is inf; it must be finite.");
    EXPECT_EQ(fault(specific_risk, {.probability = 0.6}),
              "probability is 0.6; it must be the largest risk, greater than 0 and not above 0.5.");
    EXPECT_EQ(fault(specific_risk, {.probability = 0.0}),
              "probability is 0; it must be the largest risk, greater than 0 and not above 0.5.");
    EXPECT_EQ(fault(iso_14253_1, {.probability = 0.05}),
              "probability is 0.05; it must be the probability to prove, above 0.5 and below 1.");
    EXPECT_EQ(fault(iso_14253_1, {.guard_factor = 0.0}), "guard_factor is 0; in DR-08 it must be greater than 0.");
    EXPECT_EQ(fault(simple_acceptance_with_ratio, {.test_uncertainty_ratio = 0.0}),
              "test_uncertainty_ratio is 0; it must be finite and greater than 0.");
    EXPECT_EQ(fault(simple_acceptance_with_ratio, {.largest_U = -1.0}),
              "largest_U is -1; it must be finite and greater than 0.");
    EXPECT_EQ(fault(z540_3, {.population_reliability = 1.0, .method = "1"}),
              "population_reliability is 1; it must be greater than 0 and less than 1.");
    EXPECT_EQ(fault(z540_3, {.population_deviation = 0.0, .method = "1"}),
              "population_deviation is 0; it must be finite and greater than 0.");
    EXPECT_EQ(fault(z540_3, {.method = "7"}), "method is \"7\"; it must be 1, 2, 3, 4, 5, 6, rds or rp10.");
}

TEST(CheckDecisionRule, LooksAtTheAlternative) {
    using enum DecisionRule;
    const Parameters parameters{.test_uncertainty_ratio = 4.0, .alternative = guard_band_factor};
    EXPECT_EQ(fault(simple_acceptance_with_ratio, parameters),
              "Alternative: DR-04 needs guard_factor, the r of w = r·U.");
    EXPECT_EQ(fault(simple_acceptance_with_ratio,
                    {.test_uncertainty_ratio = 4.0, .alternative = simple_acceptance_with_ratio}),
              "The alternative of DR-02 is the same rule again.");
    EXPECT_TRUE(check_decision_rule(simple_acceptance_with_ratio,
                                    {.test_uncertainty_ratio = 4.0, .alternative = z540_3, .method = "6"}, k_limits)
                    .empty());
    EXPECT_TRUE(check_decision_rule(simple_acceptance_with_ratio,
                                    {.guard_factor = -0.2, .test_uncertainty_ratio = 4.0, .alternative = b89_7_3_1},
                                    k_limits)
                    .empty());
}

}  // namespace
}  // namespace gumcert::gum
