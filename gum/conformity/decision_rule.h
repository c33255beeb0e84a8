#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "gum/conformity/tolerance_limits.h"

namespace gumcert::gum {

/// The rules that a certificate can name, DR-01 to DR-13.
/// Example: examples/api/conformity.cpp
enum class DecisionRule {
    simple_acceptance,             ///< DR-01 ILAC-G8 4.2.1
    simple_acceptance_with_ratio,  ///< DR-02 only where TUR ≥ N or U ≤ U_max; where both are stated, both
    guard_band_u,                  ///< DR-03 ILAC-G8 4.2.2, w = U
    guard_band_factor,             ///< DR-04 w = r U
    non_binary,                    ///< DR-05 ILAC-G8 4.2.3, w = U unless r or w is stated
    three_way,                     ///< DR-06 interval y ± U inside, straddling, outside
    specific_risk,                 ///< DR-07 1 − p_c ≤ largest risk
    iso_14253_1,                   ///< DR-08 conformance probability of 95 % proven
    z540_3,                        ///< DR-09 global false accept ≤ 2 %
    b89_7_3_1,                     ///< DR-10 ratio N and guard band r of U, inwards or outwards (r < 0)
    relaxed,                       ///< DR-11 w = −U
    prescribed,                    ///< DR-12 by a standard or regulation: stated limits, no further guard band
    agreed,                        ///< DR-13 customer-defined r or w
};
/// "DR-01" … and back; nothing for another text.
[[nodiscard]] std::string decision_rule_id(DecisionRule rule);
[[nodiscard]] std::optional<DecisionRule> decision_rule_from_id(const std::string& id);

/// The ids of all rules, in their order.
[[nodiscard]] std::vector<std::string_view> decision_rule_ids();

/// Parameters of a rule; which ones it needs is said by `check_decision_rule`. w, U_max, s0 and the centre are in the
/// unit of the value.
struct DecisionRuleParameters {
    std::optional<double> guard_factor = {};  ///< r of w = r U: DR-04, DR-05, DR-10, DR-13; DR-08 from a table
    std::optional<double> guard_band = {};    ///< w: DR-05, DR-13
    /// DR-07: largest risk, needed; DR-08: probability to prove, 0.95 where it is not stated; DR-09: largest global
    /// risk, 0.02 where it is not stated
    std::optional<double> probability = {};
    std::optional<double> test_uncertainty_ratio = {};  ///< least N: DR-02, DR-10; DR-09 in place of a method
    std::optional<double> largest_U = {};               ///< DR-02
    /// The rule where N or U_max is not kept, or no value can pass: DR-02, DR-09, DR-10. It takes its parameters from
    /// here, too, but for N, U_max and the alternative
    std::optional<DecisionRule> alternative = {};
    /// Knowledge about the items, for DR-09 methods 1 to 4. With any other rule it adds the global risks
    std::optional<double> population_reliability = {};  ///< EOPR
    std::optional<double> population_deviation = {};    ///< s0
    std::optional<double> population_centre = {};       ///< the middle of two-sided limits where it is not stated
    std::string method = {};                            ///< DR-09: "1" … "6", "rds", "rp10"
};

/// Whether the rule holds a probability of the measurand against a limit, so that its verdict needs the distribution and not
/// U alone: DR-07, DR-08 without a factor, DR-09 by method 4.
[[nodiscard]] bool decides_by_probability(DecisionRule rule, const DecisionRuleParameters& parameters);

/// What is missing, not used or contradictory, as English sentences that name the keys; empty: the rule can be applied.
[[nodiscard]] std::vector<std::string> check_decision_rule(DecisionRule rule, const DecisionRuleParameters& parameters,
                                                           const ToleranceLimits& limits);

/// Those that the alternative of a rule looks at.
[[nodiscard]] DecisionRuleParameters parameters_of_alternative(const DecisionRuleParameters& parameters);

/// Where the items of a population lie.
struct Population {
    double centre = 0.0;
    double deviation = 0.0;  ///< s0 > 0
};
/// The one that the parameters state; nothing where they state none.
[[nodiscard]] std::optional<Population> stated_population(const DecisionRuleParameters& parameters,
                                                          const ToleranceLimits& limits);

}  // namespace gumcert::gum
