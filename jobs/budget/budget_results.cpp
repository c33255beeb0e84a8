#include "jobs/budget/budget_results.h"

#include <algorithm>

#include "gum/expression/equation_system.h"

namespace gumcert::jobs {

std::vector<std::pair<std::string, gum::Unit>> budget_results(const gum::Budget& budget) {
    std::vector<std::pair<std::string, gum::Unit>> results;
    const std::vector<gum::InputSymbol> inputs = gum::model_inputs(budget);
    if (!budget.model.empty()) {
        const auto system =
            gum::EquationSystem::compile(budget.model, inputs, budget.unknowns, gum::model_outputs(budget));
        for (std::size_t i = 0; i < system.output_count(); ++i) {
            results.emplace_back(system.output_name(i), system.output_unit(i));
        }
        return results;
    }
    for (const gum::InputSymbol& input : inputs) {
        const auto stated = std::find_if(budget.outputs.begin(), budget.outputs.end(),
                                         [&](const gum::BudgetOutput& output) { return output.name == input.name; });
        if (stated != budget.outputs.end() || budget.outputs.empty()) {
            results.emplace_back(input.name,
                                 stated != budget.outputs.end() && stated->unit ? *stated->unit : input.unit);
        }
    }
    return results;
}

const gum::Unit& result_unit(const BudgetJob& job, const gum::BudgetPointResult& point, std::size_t output) {
    const gum::BudgetOutputResult& result = point.outputs[output];
    if (!point.point || *point.point >= job.point_units.size()) {
        return result.unit;
    }
    const std::map<std::string, gum::Unit>& units = job.point_units[*point.point];
    const auto own = units.find(result.name);
    return own == units.end() ? result.unit : own->second;
}

}  // namespace gumcert::jobs
