#include "gum/budget/budget.h"

#include <cmath>
#include <set>

#include "gum/coverage.h"

namespace gumcert::gum {

std::vector<InputSymbol> model_inputs(const Budget& budget) {
    std::set<std::size_t> stated_by_points;
    for (const BudgetPoint& point : budget.points) {
        for (const auto& [index, input] : point.inputs) {
            stated_by_points.insert(index);
        }
    }
    std::vector<InputSymbol> symbols;
    for (std::size_t i = 0; i < budget.inputs.size(); ++i) {
        const BudgetInput& input = budget.inputs[i];
        InputSymbol& symbol = symbols.emplace_back(InputSymbol{input.name, input.unit, std::nullopt, input.where});
        // A constant that a point states anew is no constant of the equations: compiled into them, its value would hold
        // at all points.
        if (input.constant && !stated_by_points.contains(i)) {
            double value = 0.0;
            for (const StatedQuantity& component : input.components) {
                value += component.value;
            }
            symbol.constant = value;
        }
    }
    for (const BudgetFit& fit : budget.fits) {
        for (const BudgetFit::Parameter& parameter : fit.parameters) {
            symbols.push_back({parameter.name, parameter.unit, std::nullopt});
        }
    }
    return symbols;
}

std::vector<OutputSymbol> model_outputs(const Budget& budget) {
    std::vector<OutputSymbol> symbols;
    for (const BudgetOutput& output : budget.outputs) {
        symbols.push_back({output.name, output.unit, output.where});
    }
    return symbols;
}

namespace {

/// Part of a list that holds those of all sections, one section after the other.
template <class T>
std::vector<T> part_of(const std::vector<T>& all, const Budget& budget, std::size_t section,
                       std::size_t BudgetSection::*count) {
    std::size_t first = 0;
    for (std::size_t s = 0; s < section; ++s) {
        first += budget.sections[s].*count;
    }
    const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first);
    return {begin, begin + static_cast<std::ptrdiff_t>(budget.sections[section].*count)};
}

}  // namespace

Budget budget_of_section(const Budget& budget, std::size_t section) {
    return {.coverage_probability = budget.coverage_probability,
            .coverage = budget.coverage,
            .truncate_degrees_of_freedom = budget.truncate_degrees_of_freedom,
            .rounding = budget.rounding,
            .model = part_of(budget.model, budget, section, &BudgetSection::equations),
            .unknowns = part_of(budget.unknowns, budget, section, &BudgetSection::unknowns),
            .inputs = budget.inputs,
            .correlations = budget.correlations,
            .simultaneous = budget.simultaneous,
            .fits = budget.fits,
            .outputs = part_of(budget.outputs, budget, section, &BudgetSection::outputs),
            .points = part_of(budget.points, budget, section, &BudgetSection::points),
            .sections = {},
            .monte_carlo = budget.monte_carlo};
}

std::size_t first_point_of(const Budget& budget, std::size_t section) {
    std::size_t first = 0;
    for (std::size_t s = 0; s < section; ++s) {
        first += budget.sections[s].points;
    }
    return first;
}

std::optional<std::size_t> section_of_point(const Budget& budget, std::size_t point) {
    std::size_t end = 0;
    for (std::size_t s = 0; s < budget.sections.size(); ++s) {
        end += budget.sections[s].points;
        if (point < end) {
            return s;
        }
    }
    return std::nullopt;
}

const BudgetInput& input_at(const Budget& budget, std::size_t input, std::optional<std::size_t> point) {
    if (point) {
        for (const auto& [index, own] : budget.points[*point].inputs) {
            if (index == input) {
                return own;
            }
        }
    }
    return budget.inputs[input];
}

InputTotal input_total(const BudgetInput& input) {
    if (input.components.size() == 1) {
        // As stated, bit for bit: a square and a root could change the last digit.
        const StatedQuantity& only = input.components.front();
        return {.value = only.value, .u = only.u, .degrees_of_freedom = only.degrees_of_freedom};
    }
    InputTotal total;
    double variance = 0.0;
    std::vector<UncertaintyContribution> contributions;
    for (const StatedQuantity& component : input.components) {
        total.value += component.value;
        variance += component.u * component.u;
        contributions.push_back({.uncertainty = component.u, .degrees_of_freedom = component.degrees_of_freedom});
    }
    // Components are independent of each other: u² is the sum, and ν_eff is that of Welch and Satterthwaite.
    total.u = std::sqrt(variance);
    total.degrees_of_freedom = effective_degrees_of_freedom(contributions);
    return total;
}

}  // namespace gumcert::gum
