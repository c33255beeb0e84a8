#pragma once

#include <string>

#include "engine/rotary_table/table_parameters.h"

namespace gumcert::gum {

/// True for the parameters of ISO 230-2 that rest on standard deviations of runs: R, R_up, A …. Monte Carlo would add
/// the noise of the distances a second time to deviations that hold it already, and make them larger than they are.
[[nodiscard]] bool rests_on_scatter(const std::string& short_name);

/// Part of the variance of the runs that may come from the measurement where R and A are stated: with 60 % a standard
/// deviation is 1.6 times that of the table, and R still within its expanded uncertainty; with more it is not.
inline constexpr double k_largest_scatter_share = 0.6;

/// Which parameters of ISO 230-2 the deviations of the runs can carry.
///
/// The deviations hold the noise of the measurement besides that of the table, and what is a maximum or rests on a
/// standard deviation grows with it: beyond the limits here, a parameter would lie outside its own uncertainty.
struct PositioningScope {
    bool stated = false;          ///< any at all
    bool scatter_stated = false;  ///< those that rest on standard deviations of runs
    double u_deviation = 0.0;     ///< standard uncertainty of one deviation, rms over the runs, [rad]
    double s_runs = 0.0;          ///< standard deviation of the runs at a target, rms over the targets, [rad]
    double largest_ratio = 0.0;   ///< u_deviation against E that is still accepted
    [[nodiscard]] bool states(const std::string& short_name) const {
        return stated && (scatter_stated || !rests_on_scatter(short_name));
    }
};
[[nodiscard]] PositioningScope positioning_scope(const engine::TableParameterModel& model);

}  // namespace gumcert::gum
