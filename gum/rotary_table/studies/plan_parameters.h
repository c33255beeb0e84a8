#pragma once

#include <Eigen/Core>

#include <optional>
#include <string>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "engine/rotary_table/table_parameters.h"
#include "gum/rotary_table/document_units.h"
#include "gum/rotary_table/studies/plan_request.h"
#include "gum/rotary_table/widened_extremes.h"

/// What a plan expects of the parameters that standards name: ranges, location of the axis, E, R and A.
namespace gumcert::gum::plan {

struct PlannedParameter {
    std::string name;  ///< "range of EXA", "axis_y", "E", "R_up"
    bool angular = false;
    /// Expanded uncertainty, [m] or [rad]; nothing where an evaluation of this layout would not state the parameter.
    std::optional<double> U;
    std::optional<double> target;  ///< [m] or [rad]

    [[nodiscard]] const DocumentUnit& unit() const { return angular ? k_arcsec : k_um; }
    [[nodiscard]] bool missed() const { return target && !(U && *U <= *target); }
};

struct ExpectedParameters {
    std::vector<PlannedParameter> all;
    double u_deviation = 0.0;         ///< standard uncertainty of the deviation of one run, rms, [rad]
    double share_of_the_noise = 0.0;  ///< of the measurement in the variance of the runs, [1]
};

/// What a table shows.
struct TableValues {
    Eigen::VectorXd reported;   ///< six error motions an angle, set-up, and the reversals where they are parameters
    Eigen::VectorXd positions;  ///< of the visits, [rad]
};

/// Standard uncertainties of the parameters of a table, in the order of its model.
struct TableUncertainties {
    Eigen::VectorXd clear;   ///< with those of ISO 230-2 by the law of propagation alone
    Eigen::VectorXd stated;  ///< as an evaluation states them
};

/// What is stated of the parameters of ISO 230-2.
struct ScopeOfPositioning {
    bool scatter_stated = false;  ///< R and A are stated
    double u_deviation = 0.0;     ///< standard uncertainty of one deviation, [rad]
    bool widened = true;          ///< for every angle that may be extreme; else `stated` is `clear`
};

/// Standard uncertainties of the parameters of a table that shows these values, as an evaluation states them: the ranges and the
/// parameters of ISO 230-2 that a plan states for every angle that may be extreme, the others by the law of propagation.
/// \param model           of the planned layout
/// \param covariance      of the error motions
/// Accuracy: a few percent where the extremes are not clear, from the number of draws.
[[nodiscard]] TableUncertainties uncertainties_of_table(const engine::TableParameterModel& model,
                                                        const MotionCovariances& covariance, const TableValues& values,
                                                        const ScopeOfPositioning& scope, double coverage_probability);

/// Tables that are drawn to see where the extremes of the parameters may lie.
constexpr int k_drawn_tables = 10;

/// U of a range, of E, R and A depends on which angles are extreme and on how the runs scatter, which is not known
/// before the measurement: it is the root mean square over drawn tables, by the functions with which `gumcert evaluate`
/// states it, for every angle that may be extreme (gum/rotary_table/widened_extremes.h). Error motions are drawn large against
/// what the measurement does not know of them, and one angle is independent of the next: of a smooth curve more angles lie near the
/// extreme, and an evaluation states up to some tenths more (ADR 0090). How much more E, R and A have than by
/// the law of propagation is found from as many of the tables as have 240 angles together, one at least. Runs scatter by the
/// repeatability of the table and the noise of one deviation. The draws are the same for every layout of as many angles.
/// \param layout  with predicted lengths
/// Accuracy: a few percent of U where the extremes are not clear, from the number of draws; seven percent of R and A of 360 angles.
[[nodiscard]] ExpectedParameters expected_parameters(const engine::RotaryTableMeasurement& layout,
                                                     const engine::StochasticModel& stochastic,
                                                     const ParameterTargets& targets, double k,
                                                     double coverage_probability);

}  // namespace gumcert::gum::plan
