#include "gum/budget/zero_uncertainty.h"

#include <algorithm>
#include <set>
#include <vector>

#include "gum/budget/budget_model.h"
#include "gum/expression/equation_system.h"
#include "gum/expression/name.h"

namespace gumcert::gum {

namespace {

/// The names that an output depends on, directly and through other equations, in the form in which names are compared.
std::set<std::string> names_behind(const Budget& budget, const std::string& output) {
    std::vector<EquationNames> equations;
    for (const EquationText& equation : budget.model) {
        equations.push_back(equation_names(equation));
    }
    std::set<std::string> unknowns;
    for (const UnknownSymbol& unknown : budget.unknowns) {
        unknowns.insert(canonical_name(unknown.name));
    }
    std::set<std::string> names;
    // The equations are read, and not their derivatives: in x − x, or where a derivative vanishes, those are 0 although
    // x is uncertain.
    std::vector<std::string> left{canonical_name(output)};
    while (!left.empty()) {
        const std::string name = left.back();
        left.pop_back();
        if (!names.insert(name).second) {
            continue;
        }
        for (const EquationNames& equation : equations) {
            // An implicit equation defines no single name: each unknown depends on all of them.
            if (equation.defines == name || (equation.defines.empty() && unknowns.contains(name))) {
                left.insert(left.end(), equation.uses.begin(), equation.uses.end());
            }
        }
    }
    return names;
}

}  // namespace

bool is_exact_by_definition(const Budget& budget, const BudgetPointResult& point, const std::string& output) {
    const std::set<std::string> names = names_behind(budget, output);
    const std::vector<InputSymbol> symbols = budget_symbols(budget);
    std::size_t quantity = 0;
    for (const InputGroup& group : point.model->inputs()) {
        for (Eigen::Index i = 0; i < group.size(); ++i, ++quantity) {
            const std::size_t symbol = point.model->quantities()[quantity].symbol;
            const bool is_fitted = symbol >= budget.inputs.size();  // no constant, whatever its covariance
            const double variance = group.covariance.cols() == 1 ? group.covariance(i, 0) : group.covariance(i, i);
            if ((is_fitted || variance != 0.0) && names.contains(canonical_name(symbols[symbol].name))) {
                return false;
            }
        }
    }
    return true;
}

void state_zero_uncertainty(const Budget& budget, const BudgetPointResult& point, const std::string& output,
                            BudgetOutputResult& result) {
    if (result.standard_uncertainty != 0.0 || result.coverage == "none") {
        return;
    }
    result.coverage_factor.reset();
    if (is_exact_by_definition(budget, point, output)) {
        result.coverage_note = k_exact_by_definition;
        result.expanded_uncertainty = 0.0;
        return;
    }
    result.coverage = "none";
    result.expanded_uncertainty.reset();
    result.coverage_note =
        "the standard uncertainty is 0 although quantities that the result depends on are uncertain: they cancel in "
        "the "
        "equation, its derivatives vanish at these estimates, or what is left of their uncertainty cannot be told from "
        "0";
}

Diagnostic zero_uncertainty_message(const BudgetOutputResult& result, const std::string& where) {
    if (result.coverage_note == k_exact_by_definition) {
        return {.code = "GC-BUDGET-0028",
                .where = where,
                .what = result.coverage_note,
                .rule = "a result without uncertainty was stated as such",
                .action = "State an uncertainty where one of the constants has one.",
                .severity = Severity::note};
    }
    return {.code = "GC-BUDGET-0029",
            .where = where,
            .what = result.coverage_note,
            .rule = "an uncertainty of 0 is stated on purpose, with \"constant\": true, or not at all",
            .action = "Correct the equation: a quantity that is read twice has two names, one for each reading.",
            .severity = Severity::warning};
}

}  // namespace gumcert::gum
