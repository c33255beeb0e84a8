#include "audit/rules/registry.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include "audit/rules/gate_findings.h"
#include "audit/worksheets/worksheet_rules.h"

namespace gumcert::audit {

std::span<const Rule> all_rules() {
    static const std::vector<Rule> k_rules = [] {
        std::vector<Rule> all;
        for (std::vector<Rule> (*family)() :
             {input_rules, model_rules, coverage_rules, contributor_rules, scope_rules, traceability_rules,
              environment_rules, reporting_rules, conformity_rules, comparison_rules, record_rules, worksheet_rules}) {
            std::vector<Rule> rules = family();
            all.insert(all.end(), std::make_move_iterator(rules.begin()), std::make_move_iterator(rules.end()));
        }
        // Which rule reports which finding of the gates stands in one table (gate_findings.cpp), for all families.
        for (Rule& rule : all) {
            if (rule.examine == take_gate_findings) {
                std::replace(rule.needs.begin(), rule.needs.end(), Need::certificate, Need::gates);
            }
            if (takes_gate_findings(rule.id)) {
                rule.examine_gates = take_gate_findings;
            }
        }
        return all;
    }();
    return k_rules;
}

}  // namespace gumcert::audit
