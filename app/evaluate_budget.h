#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/budget_model.h"
#include "engine/curve_fit.h"
#include "engine/job/budget_job.h"
#include "gum/convolution.h"
#include "gum/joint_validation.h"
#include "gum/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

/// Everything computed for one output of a budget job at one point of its table, coherent SI.
struct BudgetOutputResult {
    double coverage_probability = 0.9545;
    /// u(y) of the law of propagation: of the first order, and where that vanishes, with the second-order terms.
    double standard_uncertainty = 0.0;
    double degrees_of_freedom = 0.0;        ///< ν_eff, truncated where the job asks for it; NaN: none can be stated
    std::optional<double> coverage_factor;  ///< none: no expanded uncertainty can be stated
    std::optional<double> expanded_uncertainty;
    std::optional<double> k_numerical_error;  ///< standard uncertainty of a k that was found by draws
    std::string coverage;                     ///< as reports::Result::coverage
    std::string coverage_note;
    /// How far the middle of the interval of the convolution lies from the estimate, in parts of its U; none where
    /// there is no convolution, or it certainly changes little.
    std::optional<double> asymmetry;
    bool second_order_matters = false;
    std::optional<gum::MonteCarloOutput> monte_carlo;
    std::uint64_t trials = 0;
    bool stabilised = true;
    std::optional<gum::Validation> validation;  ///< in the unit of the result
    /// What is reported (app/reported_result.h): the result of Monte Carlo, and why; or that of the law of propagation,
    /// and what speaks against it where the job asks for it. Ids as in reports::ReportedResult.
    bool by_monte_carlo = false;
    std::string because, against;
    bool has_mean = true, has_u = true;  ///< the distribution that the trials come from has them
};

/// A budget job at one point of its table (or the only one).
struct BudgetPointResult {
    std::shared_ptr<const BudgetModel> model;
    std::vector<std::uint64_t> streams;  ///< one a group: what points have in common is equal
    gum::Propagation propagation;
    std::vector<bool> without_derivative;  ///< one an output, as app/reported_result.h; empty: none
    std::optional<gum::SecondOrderPropagation> second_order;
    std::vector<BudgetOutputResult> outputs;
    std::optional<gum::MonteCarloResult> monte_carlo;      ///< of the first coverage probability
    std::optional<gum::JointValidation> joint_validation;  ///< several outputs, in their units
};

struct BudgetResult {
    std::vector<BudgetSymbol> symbols;
    std::vector<std::string> output_names;
    std::vector<gum::Unit> output_units;
    std::vector<engine::CurveFit> fits;
    std::vector<BudgetPointResult> points;  ///< one without a table of points
    std::vector<gum::Diagnostic> notes;
    /// What the program ran Monte Carlo with by itself; none where the job asks for it, or nothing called for it.
    std::optional<gum::MonteCarloRequest> automatic_monte_carlo;
    bool validation_failed = false;  ///< validation was demanded, and a result is not validated
};

/// Evaluates a budget job: fits, law of propagation, coverage, Monte Carlo, validation.
/// \param threads  of Monte Carlo; 0: as many as the machine has
/// \throws InputError, NoResultError
[[nodiscard]] BudgetResult evaluate_budget(const engine::BudgetJob& job, unsigned threads,
                                           const gum::Progress& progress = {});

}  // namespace gumcert::app
