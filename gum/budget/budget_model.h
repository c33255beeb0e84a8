#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/curve_fit.h"
#include "gum/budget/budget.h"
#include "gum/expression/equation_system.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// One quantity that the law of propagation and Monte Carlo treat as one: a component of an input, or a parameter of a
/// fit.
struct BudgetQuantity {
    static constexpr std::size_t k_whole = std::numeric_limits<std::size_t>::max();
    std::size_t symbol = 0;
    std::size_t component = k_whole;  ///< of the input
};

/// The measurement model of a budget: every symbol of the equations is the sum of its quantities.
class BudgetModel final : public MeasurementModel {
public:
    /// \param system      nothing: the symbols themselves are the outputs
    /// \param quantities  one for each quantity of the groups, in their order
    /// \param results     without a system: the symbols that are the outputs; empty: all
    BudgetModel(std::optional<EquationSystem> system, const std::vector<InputSymbol>& symbols,
                std::vector<InputGroup> groups, std::vector<BudgetQuantity> quantities,
                std::vector<std::size_t> results = {});

    /// Whether the symbols themselves are the outputs.
    [[nodiscard]] bool is_of_symbols() const { return !system_.has_value(); }
    /// Whether an output depends on a symbol.
    [[nodiscard]] bool uses(std::size_t symbol) const;
    /// Whether an output depends on a quantity, for each of quantities().
    [[nodiscard]] std::vector<bool> quantities_of(Eigen::Index output) const;

    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] const std::vector<BudgetQuantity>& quantities() const { return quantities_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override;
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override;
    [[nodiscard]] std::vector<Eigen::MatrixXd> hessians(const Eigen::VectorXd& x) const override;
    void evaluate_trials(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const override;
    /// Whether max, min or abs stand in the equations.
    [[nodiscard]] bool has_choices() const { return system_ && system_->has_choices(); }
    /// Trials with every max, min and abs as it is at the estimates (EquationSystem::evaluate_as_chosen); of a model that
    /// has them. Called from one thread.
    void evaluate_as_chosen(const Eigen::Ref<const Eigen::MatrixXd>& x, Eigen::Ref<Eigen::MatrixXd> y) const;
    /// This model with an angle that leaps by full turns, as atan2 does at ±180°, taken as near to its estimate as turns bring it.
    /// \param output  in rad
    /// \param values  estimates of all outputs
    [[nodiscard]] std::shared_ptr<const BudgetModel> turned(Eigen::Index output, const Eigen::VectorXd& values) const;
    /// How far each output may be off because numbers are rounded to double precision (EquationSystem::rounding).
    [[nodiscard]] Eigen::VectorXd rounding(const Eigen::VectorXd& x) const;

private:
    [[nodiscard]] Eigen::VectorXd symbols(const Eigen::VectorXd& x) const;
    [[nodiscard]] Eigen::MatrixXd symbols_of_trials(const Eigen::Ref<const Eigen::MatrixXd>& x) const;
    void turn(Eigen::Ref<Eigen::MatrixXd> y) const;
    /// Derivative of the outputs by the symbols.
    [[nodiscard]] Eigen::MatrixXd by_symbol(const Eigen::VectorXd& x) const;

    std::optional<EquationSystem> system_;
    Eigen::Index symbol_count_ = 0;
    std::vector<InputGroup> groups_;
    std::vector<BudgetQuantity> quantities_;
    std::vector<OutputQuantity> outputs_;
    std::vector<bool> unused_;           ///< symbols, with a system
    std::vector<Eigen::Index> results_;  ///< without a system: symbols
    Eigen::VectorXd start_;              ///< solution of implicit equations at the estimates, where every trial begins
    bool one_to_one_ = false;            ///< quantity i is symbol i: nothing to add up
    std::map<Eigen::Index, double> turned_;  ///< outputs that leap by full turns, and their estimates
};

/// The groups of a budget at one point of its table, with all that follows from them.
struct BudgetInputs {
    std::vector<InputGroup> groups;
    std::vector<BudgetQuantity> quantities;
    std::vector<std::uint64_t> streams;  ///< of random numbers, one a group: equal for what points have in common
    std::vector<Diagnostic> notes;       ///< choices that a person should know of
};

/// What the symbols of a model stand for: the inputs of the budget, then the parameters of its fits; none is a constant
/// here.
[[nodiscard]] std::vector<InputSymbol> budget_symbols(const Budget& budget);

/// Puts the components of the inputs into groups: those of inputs tied by correlations form one, and those with samples
/// of one file; every other component is one of its own. An input that is one statement counts as one component.
///
/// The correlation r of two inputs belongs to all of their components in proportion to their standard uncertainties,
/// r u_i u_j/(u_a u_b): components of one input stay independent of each other, and the input keeps the distribution of
/// their sum.
///
/// Degrees of freedom of a correlated group: n − 1 of inputs observed together, the common ν of inputs that all have
/// the same one (an ensemble in the sense of Willink 2007, Metrologia 44, 340-349), else the least of them, which
/// claims no more than is known. Drawn by Monte Carlo as multivariate normal, multivariate t (observed together: ν = n
/// − 1, ADR 0030) or Gaussian copula with the stated coefficients of correlation; notes tell what was
/// chosen.
///
/// Points that share some inputs of a correlated group draw the others by themselves, given those that they share.
/// \param fits   one for each fit of the budget
/// \param point  position in budget.points, or nothing
/// \throws InputError     GC-BUDGET-0002 for a correlation that the distributions of its inputs cannot have,
///                        GC-BUDGET-0003 for one that contradicts joint samples
[[nodiscard]] BudgetInputs budget_inputs(const Budget& budget, const std::vector<engine::CurveFit>& fits,
                                         std::optional<std::size_t> point);

}  // namespace gumcert::gum
