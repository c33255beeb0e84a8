#pragma once

#include <optional>
#include <string_view>

#include "gum/conformity/decision_rule.h"

namespace gumcert::audit {

/// A decision rule as somebody states it.
struct StatedRule {
    gum::DecisionRule rule = gum::DecisionRule::simple_acceptance;
    gum::DecisionRuleParameters parameters;  ///< r of "w = 0.83 U"
};

/// The rule whose id stands anywhere in a text: "ILAC-G8 DR-03", "dr-03", "DR03". Nothing where none does, or two.
[[nodiscard]] std::optional<gum::DecisionRule> rule_of_id_in(std::string_view text);

/// The rule that a text states by its id or in words, English, German or Spanish: "simple acceptance", "ohne Schutzband" and
/// ILAC-G8:09/2019, 4.2.1 are DR-01, "guard band w = U" and 4.2.2 are DR-03, "w = 0.83 U" is DR-04, "non-binary" and 4.2.3 are
/// DR-05, ISO 14253-1 is DR-08, "w = −U" is DR-11.
/// \return nothing where the words are not understood, and where they state two rules
[[nodiscard]] std::optional<StatedRule> stated_rule(std::string_view text);

}  // namespace gumcert::audit
