#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "audit/rule.h"

namespace gumcert::audit {

// The rules by families, one file each; W, of worksheets, are a layer of their own. Ids never change and are never used again.

[[nodiscard]] std::vector<Rule> input_rules();         ///< U: inputs, Type A and Type B
[[nodiscard]] std::vector<Rule> type_a_rules();        ///< U of readings, a part of input_rules()
[[nodiscard]] std::vector<Rule> model_rules();         ///< S: model and sensitivity
[[nodiscard]] Rule certified_bound_rule();             ///< S19, the last of model_rules()
[[nodiscard]] std::vector<Rule> coverage_rules();      ///< K: combination and coverage
[[nodiscard]] std::vector<Rule> contributor_rules();   ///< B: completeness of contributors
[[nodiscard]] std::vector<Rule> scope_rules();         ///< X: capability and scope
[[nodiscard]] std::vector<Rule> traceability_rules();  ///< T: traceability and equipment
[[nodiscard]] std::vector<Rule> environment_rules();   ///< E: environment
[[nodiscard]] std::vector<Rule> reporting_rules();     ///< R: reporting
[[nodiscard]] std::vector<Rule> conformity_rules();    ///< D: conformity
[[nodiscard]] std::vector<Rule> comparison_rules();    ///< N: comparisons
[[nodiscard]] std::vector<Rule> record_rules();        ///< P: records, people, software

/// A rule of the catalogue that the program does not apply, and why.
struct RuleLeftOut {
    std::string_view id, title, because;
};

/// All rules, in the order of their families: made once.
[[nodiscard]] std::span<const Rule> all_rules();
[[nodiscard]] std::span<const RuleLeftOut> rules_left_out();

}  // namespace gumcert::audit
