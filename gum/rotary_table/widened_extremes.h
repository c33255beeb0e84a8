#pragma once

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <functional>
#include <string>

#include "engine/rotary_table/anglewise_covariance.h"
#include "engine/rotary_table/table_parameters.h"
#include "gum/monte_carlo/extreme_uncertainty.h"
#include "gum/propagation.h"

namespace gumcert::gum {

/// Covariance of each error motion at all angles, one N×N a motion.
using MotionCovariances = std::array<Eigen::MatrixXd, 6>;
/// \param reported  of all quantities in the datum of the result
[[nodiscard]] MotionCovariances motion_covariances(const engine::AnglewiseCovariance& reported, std::size_t angles);

/// What a table shows, and how well it is known: where the extremes of its parameters are taken from.
struct TableDeviations {
    const engine::TableParameterModel& model;
    const Eigen::VectorXd& reported;      ///< values in the datum of the result: six an angle, then the set-up
    const MotionCovariances& covariance;  ///< of these
    const Eigen::VectorXd& positions;     ///< of the visits, [rad]
    double u_deviation = 0.0;             ///< standard uncertainty of one deviation, rms over the runs, [rad]
    std::size_t draws = k_draws_of_errors;
};

/// The six ranges: their u is that of all angles that may be extreme, not of the two that are in the estimate
/// (gum/monte_carlo/extreme_uncertainty.h), for the coverage probability of the budget.
/// \param parameters  of `of.model`, by the law of propagation
void widen_ranges(UncertaintyBudget& parameters, const TableDeviations& of);

/// The same for parameters of ISO 230-2: which targets are extreme, or scatter most, is not known either.
/// \param stated  whether a parameter is stated, by its short name
void widen_positioning(UncertaintyBudget& parameters, const TableDeviations& of,
                       const std::function<bool(const std::string&)>& stated);

}  // namespace gumcert::gum
