#include "reports/record/make/comparison/budget_sources.h"

#include <cmath>
#include <optional>

#include "gum/budget/budget_model.h"
#include "gum/propagation.h"
#include "gum/quantity/diagnostic.h"

namespace gumcert::reports {

using gum::UncertaintySource;

std::vector<UncertaintySource> uncertainty_sources(const gum::Budget& budget, const gum::BudgetResult& result,
                                                   std::size_t point, std::size_t output, const gum::Unit& unit,
                                                   bool common_only) {
    const gum::BudgetPointResult& at = result.points[point];
    // All quantities of a symbol have its sensitivity.
    std::vector<double> sensitivity(result.symbols.size(), 0.0);
    const std::vector<gum::BudgetQuantity>& quantities = at.model->quantities();
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        sensitivity[quantities[q].symbol] =
            at.propagation.jacobian(static_cast<Eigen::Index>(output), static_cast<Eigen::Index>(q));
    }
    std::vector<UncertaintySource> sources;
    for (std::size_t i = 0; i < budget.inputs.size(); ++i) {
        const gum::BudgetInput& input =
            gum::input_at(budget, i, budget.points.empty() ? std::nullopt : std::optional<std::size_t>(point));
        if (common_only && !input.common) {
            continue;
        }
        for (const gum::StatedQuantity& component : input.components) {
            const double contribution = unit.difference_from_si(sensitivity[i] * component.u);
            if (!component.source.empty() && contribution != 0.0) {
                sources.push_back({.source = component.source,
                                   .input = input.components.size() > 1 && !component.name.empty()
                                                ? input.name + ", " + component.name
                                                : input.name,
                                   .contribution = contribution});
            }
        }
    }
    return sources;
}

std::set<std::string> sources_beyond_first_order(const gum::Budget& budget, const gum::BudgetResult& result,
                                                 std::size_t point, std::size_t output) {
    constexpr double k_most_beyond = 0.05;  // of u
    const gum::BudgetPointResult& at = result.points[point];
    const gum::BudgetOutputResult& of = at.outputs[output];
    const double u = of.by_monte_carlo ? of.monte_carlo->standard_uncertainty : of.standard_uncertainty;
    const auto row = static_cast<Eigen::Index>(output);
    const Eigen::VectorXd x = gum::input_estimates(*at.model);
    const double y = at.propagation.value(row);
    const auto departs = [&](Eigen::Index column, double step) {
        const double expected = at.propagation.jacobian(row, column) * step;
        for (const double side : {-1.0, 1.0}) {
            Eigen::VectorXd moved = x;
            moved(column) += side * step;
            double change = 0.0;
            try {
                change = at.model->evaluate(moved)(row) - y;
            } catch (const gum::NoResultError&) {
                return true;  // the model ends within u
            }
            if (!(std::abs(change - side * expected) <= k_most_beyond * u)) {
                return true;
            }
        }
        return false;
    };
    std::set<std::string> names;
    const std::vector<gum::BudgetQuantity>& quantities = at.model->quantities();
    for (std::size_t q = 0; q < quantities.size(); ++q) {
        if (quantities[q].symbol >= budget.inputs.size()) {
            continue;  // a parameter of a fit has no source
        }
        const gum::BudgetInput& input = gum::input_at(
            budget, quantities[q].symbol, budget.points.empty() ? std::nullopt : std::optional<std::size_t>(point));
        for (std::size_t c = 0; c < input.components.size(); ++c) {
            const gum::StatedQuantity& component = input.components[c];
            const bool is_it = quantities[q].component == gum::BudgetQuantity::k_whole || quantities[q].component == c;
            if (is_it && !component.source.empty() && departs(static_cast<Eigen::Index>(q), component.u)) {
                names.insert(component.source);
            }
        }
    }
    return names;
}

}  // namespace gumcert::reports
