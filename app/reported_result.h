#pragma once

#include <optional>
#include <string>
#include <vector>

#include "app/evaluate_budget.h"
#include "engine/job/budget_job.h"
#include "engine/job/monte_carlo_request.h"
#include "gum/expression/equation_system.h"
#include "gum/propagation.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

// Which result of a budget holds: that of the law of propagation, or that of Monte Carlo (docs/adr/0024). Reasons are
// ids, those of reports::ReportedResult::because.

/// `coverage` as it holds for an output.
[[nodiscard]] gum::CoverageChoice coverage_choice_of(const engine::BudgetJob& job, const std::string& output);

/// A reason in English: "second-order terms change u or the estimate".
[[nodiscard]] std::string reason_in_words(const std::string& reason);

/// The law of propagation at one point, where the model may have no derivative there.
struct PointPropagation {
    gum::Propagation propagation;
    /// One an output: it has no derivative at the estimates, and its sensitivities are 0 because there are none. Empty
    /// where all have one.
    std::vector<bool> without_derivative;
};

/// As gum::propagate(), but outputs without a derivative are told instead of refused, where the job lets Monte Carlo
/// take their place.
/// \throws NoResultError  as gum::propagate(), where the job asks for the law of propagation of such an output
[[nodiscard]] PointPropagation propagate_where_possible(const engine::BudgetJob& job,
                                                        const std::optional<gum::EquationSystem>& system,
                                                        const BudgetModel& model,
                                                        const std::vector<BudgetSymbol>& symbols);

/// What speaks against the law of propagation before any trial is drawn, one reason an output; "" where nothing does.
/// \param linear_model  every output is an affine function of all inputs
[[nodiscard]] std::vector<std::string> evidence_against_law(const BudgetPointResult& point, bool linear_model);

/// Whether Monte Carlo has to be run for what is reported of an output.
[[nodiscard]] bool needs_monte_carlo(gum::CoverageChoice choice, const std::string& evidence);

/// The Monte Carlo that the program runs by itself: adaptive, to the two digits that are printed.
[[nodiscard]] gum::MonteCarloRequest automatic_monte_carlo();

/// An input with a t-distribution and ν ≤ 2, which has no variance, that an output depends on in the first order.
struct InputWithoutVariance {
    Eigen::Index column = 0;  ///< of the Jacobian
    double nu = 0.0;
};
[[nodiscard]] std::vector<InputWithoutVariance> inputs_without_variance(const BudgetPointResult& point,
                                                                        Eigen::Index output);

/// Whether a distribution that trials were drawn from has an expectation and a standard deviation.
///
/// Not where an input with a t-distribution and ν ≤ 2 (≤ 1: no expectation either) enters linearly; nor where the
/// largest deviations of the trials fall off like a power law with an exponent of 2 (1) or less, within its error (Hill
/// 1975, Ann. Statist. 3, 1163-1174). Trials that leave it open whether there is one count as none.
struct ExistingMoments {
    bool mean = true, u = true;
};
[[nodiscard]] ExistingMoments existing_moments(const std::optional<gum::EquationSystem>& system,
                                               const BudgetPointResult& point, Eigen::Index output, unsigned threads);

/// Decides what is reported of an output: `because`, `against` and `by_monte_carlo` of it.
/// \param evidence  against the law of propagation, before any trial
/// \param digits    of u that count in the comparison with Monte Carlo (JCGM 101:2008, clause 8)
void decide_reported(gum::CoverageChoice choice, const std::string& evidence, const gum::Unit& unit, double value,
                     int digits, BudgetOutputResult& output);

/// Notes on what is reported: one an output and reason, however many points it has.
void note_reported(const engine::BudgetJob& job, BudgetResult& result);

/// The reported result of an output with its printed texts, in its unit.
[[nodiscard]] reports::ReportedResult reported_of(const BudgetOutputResult& output, double y, const gum::Unit& unit,
                                                  gum::RoundingMode rounding);

}  // namespace gumcert::app
