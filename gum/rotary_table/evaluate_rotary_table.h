#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/table_parameters.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/progress.h"
#include "gum/rotary_table/fixture_budget.h"
#include "gum/rotary_table/location_errors.h"
#include "gum/rotary_table/positioning_scope.h"
#include "gum/rotary_table/rotary_table_request.h"

namespace gumcert::gum {

/// Monte Carlo of the whole measurement, and what it says of the law of propagation.
struct RotaryTableMonteCarlo {
    MonteCarloResult result;  ///< outputs: the reported quantities, then the table parameters
    /// One an output, in the unit of documents; none where the law of propagation states no uncertainty.
    std::vector<std::optional<Validation>> validations;
    /// One an output: Monte Carlo may say something of it. Not of a parameter whose estimate holds the noise already
    /// (holds_noise_already), and not of one that is not stated: there the law of propagation stands alone.
    std::vector<bool> compared;
    /// One an output that is compared: the law of propagation stands, because an estimated variance with so few degrees of freedom is in
    /// it that the trials did not draw it (RotaryTableTrials). Nothing of Monte Carlo is stated or compared there.
    std::vector<bool> law_stands;
    std::int64_t most_steps = 0;  ///< of one trial until it converged
    double mean_steps = 0.0;
};

/// What the law of propagation states of quantities that stand angle by angle.
struct QuantityUncertainty {
    UncertaintyBudget budget;
    engine::AnglewiseCovariance covariance;
    std::vector<Eigen::VectorXd> sensitivity;  ///< ∂y/∂x of a group of one input; empty for others
};

/// Everything computed for a measured rotary table, coherent SI.
struct RotaryTableResult {
    engine::EvaluationOptions options;
    engine::RotaryTableSolution solution;
    QuantityUncertainty reported;  ///< of the reported quantities
    std::shared_ptr<const engine::TableParameterModel> parameter_model;
    UncertaintyBudget parameters;                      ///< ranges, axis average line, positioning (ISO 230-2)
    PositioningScope positioning;                      ///< which of the parameters of ISO 230-2 are stated
    std::optional<LocationErrors> location_errors;     ///< where the frame of the machine is known
    std::optional<QuantityUncertainty> contact_point;  ///< of the comparison: x, y, z at every angle
    std::optional<RotaryTableMonteCarlo> monte_carlo;
    FixtureUncertainty fixture;      ///< where the covariance of the fixture comes from
    bool validation_failed = false;  ///< validation was demanded, and a quantity is not validated
};

/// Options of an adjustment that tests single distances: critical values and non-centrality. What does not change a result,
/// tests of groups and of the fixture, is left out.
[[nodiscard]] engine::EvaluationOptions single_test_options(const engine::RotaryTableMeasurement& measurement);
/// Options of the adjustment, with all its tests.
[[nodiscard]] engine::EvaluationOptions evaluation_options(const engine::RotaryTableMeasurement& measurement);

/// Evaluates a measured rotary table: adjustment, law of propagation, derived parameters, Monte Carlo, validation.
///
/// Indices and sizes in the measurement have to be right, which the reader of a job sees to.
/// \param request  its fixture covariance is replaced where a budget of the fixture gives it
/// \param threads  of Monte Carlo; 0: as many as the machine has
/// \throws InputError, NoResultError  those of apply_fixture_budget(), evaluate_jointly(), evaluate_sequentially() and
///                                    run_monte_carlo(); GC-INPUT-0238 Monte Carlo with the sequential method
/// Example: examples/api/rotary_table.cpp
[[nodiscard]] RotaryTableResult evaluate_rotary_table(RotaryTableRequest& request, unsigned threads,
                                                      const Progress& progress = {});

}  // namespace gumcert::gum
