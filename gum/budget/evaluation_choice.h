#pragma once

#include <optional>
#include <string>
#include <vector>

#include "gum/budget/budget.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/expression/equation_system.h"
#include "gum/propagation.h"

namespace gumcert::gum {

// Which result of a budget holds: that of the law of propagation, or that of Monte Carlo (docs/adr/0024). Reasons are
// ids such as "second_order".

/// `coverage` as it holds for an output.
[[nodiscard]] CoverageChoice coverage_choice_of(const Budget& budget, const std::string& output);

/// A reason in English: "second-order terms change u or the estimate".
[[nodiscard]] std::string reason_in_words(const std::string& reason);

/// The law of propagation at one point, where the model may have no derivative there.
struct PointPropagation {
    Propagation propagation;
    /// One an output: it has no derivative at the estimates, and its sensitivities are 0 because there are none. Empty
    /// where all have one.
    std::vector<bool> without_derivative;
};

/// As propagate(), but outputs without a derivative are listed instead of refused, where the budget lets Monte Carlo
/// take their place.
/// \throws NoResultError  as propagate(), where the budget asks for the law of propagation of such an output
[[nodiscard]] PointPropagation propagate_where_possible(const Budget& budget,
                                                        const std::optional<EquationSystem>& system,
                                                        const BudgetModel& model,
                                                        const std::vector<InputSymbol>& symbols);

/// What speaks against the law of propagation before any trial is drawn, one reason an output; "" where nothing does.
/// Outputs that are found to be angles that leap by full turns are turned in the model of the point.
/// \param linear_model  every output is an affine function of all inputs
[[nodiscard]] std::vector<std::string> evidence_against_law(BudgetPointResult& point, bool linear_model);

/// Whether Monte Carlo has to be run for what is reported of an output.
[[nodiscard]] bool needs_monte_carlo(CoverageChoice choice, const std::string& evidence);

/// The Monte Carlo that the program runs by itself: adaptive, to the two digits that are printed.
[[nodiscard]] MonteCarloRequest automatic_monte_carlo();

/// An input with a t-distribution and ν ≤ 2, which has no variance, that an output depends on in the first order.
struct InputWithoutVariance {
    Eigen::Index column = 0;  ///< of the Jacobian
    double nu = 0.0;
};
[[nodiscard]] std::vector<InputWithoutVariance> inputs_without_variance(const BudgetPointResult& point,
                                                                        Eigen::Index output);

/// Whether a distribution that trials were drawn from has an expectation and a standard deviation.
///
/// Not where an input with a t-distribution and ν ≤ 2 (≤ 1: no expectation either) enters linearly. An output that is
/// affine in all inputs has them exactly where its inputs have. Any other has none where the largest deviations of the
/// trials fall off like a power law with an exponent of 2 (1) or less, within its error (Hill 1975, Ann. Statist. 3,
/// 1163-1174); where that leaves it open, more trials are looked at, and where these do as well it counts as none.
struct ExistingMoments {
    bool mean = true, u = true;
};
[[nodiscard]] ExistingMoments existing_moments(const std::optional<EquationSystem>& system,
                                               const BudgetPointResult& point, Eigen::Index output, unsigned threads);

/// Whether an output certainly has no standard deviation, by its inputs or by a number of its first trials: what adaptive
/// trials need not wait for.
[[nodiscard]] bool has_no_variance(const std::optional<EquationSystem>& system, const BudgetPointResult& point,
                                   Eigen::Index output, std::uint64_t seed, std::uint64_t trials, unsigned threads);

/// Decides what is reported of an output: `because`, `against` and `by_monte_carlo` of it.
/// \param evidence  against the law of propagation, before any trial
/// \param digits    of u that count in the comparison with Monte Carlo (JCGM 101:2008, clause 8)
void decide_reported(CoverageChoice choice, const std::string& evidence, const Unit& unit, double value, int digits,
                     BudgetOutputResult& output);

/// Notes on what is reported: one an output and reason, however many points it has.
void note_reported(const Budget& budget, BudgetResult& result);

}  // namespace gumcert::gum
