#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "audit/audited_budget.h"
#include "gum/expression/equation_system.h"
#include "gum/expression/tangent_bound.h"

namespace gumcert::audit {

/// The equation of a budget together with the rows that stand for its quantities, in the units of the table.
class BudgetModel {
public:
    /// Equations stand on lines of their own, or between semicolons. A row stands for a quantity where its name, or the
    /// first word of its name, is that of the quantity. Where the numbers of the table give the stated value and its
    /// quantities with their units do not, the equation is one of numbers ("60000 m/(ρ t)" in L/min).
    /// \return nothing where the equation cannot be read, or no row stands for any of its quantities
    [[nodiscard]] static std::optional<BudgetModel> of(const AuditedBudget& budget);

    /// Quantities of the equation, those without a row, and the position of the row of each of the others; of a quantity
    /// that is a sum the first of its parts.
    [[nodiscard]] const std::vector<std::string>& without_row() const { return without_row_; }
    [[nodiscard]] const std::vector<std::string>& quantities() const { return quantities_; }
    [[nodiscard]] const std::vector<std::size_t>& rows() const { return rows_; }
    /// Whether numbers can be computed: every quantity has a row with an estimate, and units balance, or none is stated.
    [[nodiscard]] bool can_be_evaluated() const { return system_.has_value(); }

    /// The estimates of the quantities, in the units of their rows; NaN for one that a budget does not have.
    [[nodiscard]] std::vector<double> estimates(const AuditedBudget& budget) const;
    /// How far from their estimates the quantities are looked at: bounded ones (rectangular, triangular, arcsine) to their
    /// limits, others ±k u. The parts of a sum may all be at their ends at once: their reaches add up. What is not in the
    /// sum of the budget does not vary.
    [[nodiscard]] std::vector<double> reach(const AuditedBudget& budget, double k) const;
    /// ∂y/∂x_i at x, [unit of the result / unit of the row i].
    /// \return nothing where the equation has no finite derivative there
    [[nodiscard]] std::optional<std::vector<double>> derivatives(const std::vector<double>& x) const;
    /// ∂²y/∂x_i∂x_j at x, row by row, n².
    [[nodiscard]] std::optional<std::vector<double>> second_derivatives(const std::vector<double>& x) const;

    /// What the tangent at x leaves out over x ± reach, in the unit of the result (gum/expression/tangent_bound.h).
    /// \return without a bound, the reason
    [[nodiscard]] gum::OutputBound tangent_bound(const std::vector<double>& x, const std::vector<double>& reach) const;

private:
    void compile(const std::vector<gum::EquationText>& equations, const AuditedBudget& budget);
    [[nodiscard]] bool gives_value(const AuditedBudget& budget) const;

    std::vector<std::string> quantities_, without_row_;
    std::vector<std::size_t> rows_;                ///< the first of `parts_` each
    std::vector<std::vector<std::size_t>> parts_;  ///< of each quantity: its row, or those of its parts
    std::vector<gum::Unit> units_;
    gum::Unit result_unit_;
    std::size_t output_ = 0;
    std::optional<gum::EquationSystem> system_;
    std::vector<gum::EquationText> equations_;  ///< of the system
    std::vector<gum::InputSymbol> inputs_;
};

}  // namespace gumcert::audit
