#pragma once

#include <string>

#include "app/document_units.h"
#include "engine/table_parameters.h"
#include "gum/propagation.h"
#include "reports/record/evaluation_record.h"

namespace gumcert::app {

/// One output of a model in the unit of the document.
[[nodiscard]] reports::TableParameter table_parameter(const gum::UncertaintyBudget& propagation, Eigen::Index index,
                                                      const DocumentUnit& unit, const std::string& name,
                                                      const std::string& description);

/// What a record holds of the quantities derived from the error motions: ranges (ISO 230-7), the axis average line
/// in the frame of the fixture, accuracy and repeatability of positioning (ISO 230-2).
/// \param parameters  law of propagation of `model`
void fill_table_parameters(reports::RotaryTable& rotary, const engine::TableParameterModel& model,
                           const engine::RotaryTableMeasurement& measurement, const gum::UncertaintyBudget& parameters);

/// True for the parameters of ISO 230-2 that rest on standard deviations of runs: R, R_up, A …. Monte Carlo would add
/// the noise of the distances a second time to deviations that hold it already, and make them larger than they are.
[[nodiscard]] bool rests_on_scatter(const std::string& short_name);

/// Part of the variance of the runs that may come from the measurement where R and A are stated: with 60 % a standard
/// deviation is 1.6 times that of the table, and R still within its expanded uncertainty; with more it is not.
constexpr double k_largest_scatter_share = 0.6;

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

}  // namespace gumcert::app
