#pragma once

#include <string>

#include "certificate/certificate_data.h"
#include "gum/conformity/decision_rule.h"
#include "gum/conformity/tolerance_limits.h"

namespace gumcert::certificate {

/// The decision rule of a specification as it is applied to results of one unit (ISO/IEC 17025:2017, 7.8.6.2 c): the
/// rule that was agreed on, with its alternative. Which of both decided a value is for `gum::decide_conformity` to say.
struct AgreedRule {
    gum::DecisionRule rule = gum::DecisionRule::simple_acceptance;
    gum::DecisionRuleParameters parameters;  ///< in the unit of the results
    gum::ToleranceLimits limits;             ///< those that hold for all results, in their unit
    std::string problem;                     ///< English: why it cannot be applied; "" where it can
};

/// The parameters of a rule as a specification states them, in its unit.
[[nodiscard]] gum::DecisionRuleParameters stated_parameters(const AgreedSpecification::Rule& rule);

/// \param unit  of the results, as jobs state it: "um"
[[nodiscard]] AgreedRule agreed_rule(const AgreedSpecification& specification, const std::string& unit);

/// The same with limits of one value in place of those of the specification.
/// \param limits  in the unit of the results
[[nodiscard]] AgreedRule agreed_rule(const AgreedSpecification& specification, const std::string& unit,
                                     const gum::ToleranceLimits& limits);

}  // namespace gumcert::certificate
