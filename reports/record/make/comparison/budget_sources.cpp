#include "reports/record/make/comparison/budget_sources.h"

#include <optional>

#include "gum/budget/budget_model.h"

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

}  // namespace gumcert::reports
