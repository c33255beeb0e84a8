#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/curve_fit.h"
#include "gum/budget/budget.h"
#include "gum/budget/budget_model.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/monte_carlo/joint_validation.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/progress.h"

namespace gumcert::gum {

/// Everything computed for one output of a budget at one point of its table, coherent SI.
struct BudgetOutputResult {
    std::string name;
    Unit unit;  ///< that it is asked for in
    double coverage_probability = 0.9545;
    /// u(y) of the law of propagation: of the first order, and where that vanishes, with the second-order terms.
    double standard_uncertainty = 0.0;
    double degrees_of_freedom = 0.0;        ///< ν_eff, truncated where the budget asks for it; NaN: none can be stated
    std::optional<double> coverage_factor;  ///< none: no expanded uncertainty can be stated
    std::optional<double> expanded_uncertainty;
    std::optional<double> k_numerical_error;  ///< standard uncertainty of a k that was found by draws
    /// Where k comes from: "normal", "student_t", "convolution"; "none": there is none, and the note says why.
    std::string coverage;
    std::string coverage_note;
    /// How far the middle of the interval of the convolution lies from the estimate, in parts of its U; none where
    /// there is no convolution, or it certainly changes little.
    std::optional<double> asymmetry;
    bool second_order_matters = false;
    std::optional<MonteCarloOutput> monte_carlo;
    std::uint64_t trials = 0;
    bool stabilised = true;
    /// Share of the trials in which a max, min or abs chooses otherwise (gum/budget/other_choice.h).
    double other_choice = 0.0;
    std::optional<Validation> validation;  ///< in the unit of the result
    /// What is reported (gum/budget/evaluation_choice.h): the result of Monte Carlo, and why; or that of the law of propagation,
    /// and what speaks against it where the budget asks for it.
    bool by_monte_carlo = false;
    std::string because, against;
    bool has_mean = true, has_u = true;  ///< the distribution that the trials come from has them
};

/// A budget at one point of its table (or the only one).
struct BudgetPointResult {
    std::optional<std::size_t> point;    ///< position in Budget::points; nothing without a table
    std::optional<std::size_t> section;  ///< position in Budget::sections; nothing where there are none
    std::shared_ptr<const BudgetModel> model;
    std::vector<std::uint64_t> streams;  ///< one a group: what points have in common is equal
    Propagation propagation;
    std::vector<bool> without_derivative;  ///< one an output, as gum/budget/evaluation_choice.h; empty: none
    std::optional<SecondOrderPropagation> second_order;
    std::vector<BudgetOutputResult> outputs;
    std::optional<MonteCarloResult> monte_carlo;      ///< of the first coverage probability
    std::optional<JointValidation> joint_validation;  ///< several outputs, in their units
};

struct BudgetResult {
    std::vector<InputSymbol> symbols;
    std::vector<engine::CurveFit> fits;
    std::vector<BudgetPointResult> points;  ///< one without a table of points; those of all sections in their order
    std::vector<Diagnostic> notes;
    /// What the program ran Monte Carlo with by itself; none where the budget asks for it, or nothing called for it.
    std::optional<MonteCarloRequest> automatic_monte_carlo;
    bool validation_failed = false;  ///< validation was demanded, and a result is not validated
};

/// Evaluates a budget: fits, law of propagation, coverage, Monte Carlo, validation, and which result is reported of each
/// output.
///
/// Equations, units and distributions are checked here; positions and sizes have to be right, which the reader of a job
/// sees to.
/// \param threads  of Monte Carlo; 0: as many as the machine has
/// \throws InputError, NoResultError
/// Accuracy: that of its parts, docs/accuracy.md#law-of-propagation and what follows there.
/// Example: examples/api/uncertainty_budget.cpp
[[nodiscard]] BudgetResult evaluate_budget(const Budget& budget, unsigned threads, const Progress& progress = {});

/// How many results there are at all points.
[[nodiscard]] std::size_t budget_result_count(const BudgetResult& result);

/// Names of all results, points one after the other: "l", or "l[20 mm]" at a point of a table.
[[nodiscard]] std::vector<std::string> budget_result_names(const Budget& budget, const BudgetResult& result);

}  // namespace gumcert::gum
