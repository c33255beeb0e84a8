#pragma once

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/fixture_budget.h"
#include "app/location_errors.h"
#include "engine/anglewise_covariance.h"
#include "engine/job/rotary_table_job.h"
#include "engine/rotary_table_evaluation.h"
#include "engine/table_parameters.h"
#include "gum/monte_carlo.h"
#include "gum/propagation.h"
#include "gum/quantity/progress.h"

namespace gumcert::app {

/// Monte Carlo of the whole measurement, and what it says of the law of propagation.
struct RotaryTableMonteCarlo {
    gum::MonteCarloResult result;  ///< outputs: the reported quantities, then the table parameters
    /// One an output, in the unit of documents; none where the law of propagation states no uncertainty.
    std::vector<std::optional<gum::Validation>> validations;
    std::int64_t most_steps = 0;  ///< of one trial until it converged
    double mean_steps = 0.0;
};

/// What the law of propagation states of quantities that stand angle by angle.
struct QuantityUncertainty {
    gum::UncertaintyBudget budget;
    engine::AnglewiseCovariance covariance;
    std::vector<Eigen::VectorXd> sensitivity;  ///< ∂y/∂x of a group of one input; empty for others
};

/// Everything computed for a rotary-table job, coherent SI.
struct RotaryTableResult {
    engine::EvaluationOptions options;
    engine::RotaryTableSolution solution;
    QuantityUncertainty reported;  ///< of the reported quantities
    std::shared_ptr<const engine::TableParameterModel> parameter_model;
    gum::UncertaintyBudget parameters;                 ///< ranges, axis average line, positioning (ISO 230-2)
    std::optional<LocationErrors> location_errors;     ///< where the job knows the frame of the machine
    std::optional<QuantityUncertainty> contact_point;  ///< of the comparison: x, y, z at every angle
    std::optional<RotaryTableMonteCarlo> monte_carlo;
    FixtureUncertainty fixture;      ///< where the covariance of the fixture comes from
    bool validation_failed = false;  ///< validation was demanded, and a quantity is not validated
};

/// Options of an adjustment that tests single distances: critical values and non-centrality. What does not change a result,
/// tests of groups and of the fixture, is left out.
[[nodiscard]] engine::EvaluationOptions single_test_options(const engine::RotaryTableMeasurement& measurement);
/// Options of the adjustment for a job, with all its tests.
[[nodiscard]] engine::EvaluationOptions evaluation_options(const engine::RotaryTableMeasurement& measurement);

/// Evaluates a rotary-table job: adjustment, law of propagation, derived parameters, Monte Carlo, validation.
/// \param job      its fixture covariance is replaced where a budget of the fixture gives it
/// \param threads  of Monte Carlo; 0: as many as the machine has
/// \throws InputError, NoResultError
[[nodiscard]] RotaryTableResult evaluate_rotary_table(engine::RotaryTableJob& job, unsigned threads,
                                                      const gum::Progress& progress = {});

}  // namespace gumcert::app
