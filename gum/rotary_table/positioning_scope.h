#pragma once

#include <Eigen/Core>

#include <string>

#include "engine/rotary_table/table_parameters.h"

namespace gumcert::gum {

/// True for the parameters of ISO 230-2 that rest on standard deviations of runs: R, R_up, A ….
[[nodiscard]] bool rests_on_scatter(const std::string& short_name);

/// True for the parameters of a table that are an extreme of deviations or rest on their scatter: the six ranges of the error
/// motions and all parameters of ISO 230-2 but the mean of the reversals. The deviations hold the noise of the measurement once,
/// and so does the parameter; a trial of Monte Carlo adds noise to these deviations and takes the extreme of noise and noise
/// (ADR 0015). No Monte Carlo result of such a parameter is stated or compared: the law of propagation stands.
/// \param output  among the outputs of `parameters`
[[nodiscard]] bool holds_noise_already(const engine::TableParameters& parameters, Eigen::Index output);

/// Part of the variance of the runs that may come from the measurement where R and A are stated: with 60 % a standard
/// deviation is 1.6 times that of the table, and R still within its expanded uncertainty; with more it is not.
inline constexpr double k_largest_scatter_share = 0.6;

/// Standard uncertainty of one deviation against E above which no parameter of ISO 230-2 is stated: a maximum grows with the
/// noise of the deviations, and its uncertainty does not cover that growth (ADR 0017).
inline constexpr double k_largest_u_against_E = 0.25;

/// Part of the variance of the reversals about their mean that may come from the measurement where B is stated although R and
/// A are not. It is smaller, because a spread that is large by chance belongs to a largest reversal that is too large by
/// chance: of reversals that are half noise hardly any pass.
inline constexpr double k_largest_reversal_share = 0.2;

/// Which parameters of ISO 230-2 the deviations of the runs can carry.
///
/// The deviations hold the noise of the measurement besides that of the table, and what is a maximum or rests on a
/// standard deviation grows with it: beyond the limits here, a parameter would lie outside its own uncertainty.
struct PositioningScope {
    bool stated = false;           ///< any at all
    bool scatter_stated = false;   ///< those that rest on standard deviations of runs
    bool reversal_stated = false;  ///< B; the mean of the reversals is stated all the same
    /// Of the measurement in the variance of the reversals about their mean; may exceed 1.
    double reversal_share = 0.0;
    double u_deviation = 0.0;    ///< standard uncertainty of one deviation, rms over the runs, [rad]
    double s_runs = 0.0;         ///< standard deviation of the runs at a target, rms over the targets, [rad]
    double largest_ratio = 0.0;  ///< u_deviation against E that is still accepted
    [[nodiscard]] bool states(const std::string& short_name) const {
        return stated && (scatter_stated || !rests_on_scatter(short_name)) && (reversal_stated || short_name != "B");
    }
};
[[nodiscard]] PositioningScope positioning_scope(const engine::TableParameterModel& model);

}  // namespace gumcert::gum
