#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <string>

#include "engine/rotary_table/machine_frame.h"
#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/budget/budget.h"
#include "gum/monte_carlo/monte_carlo_request.h"

namespace gumcert::gum {

/// A measured rotary table to be evaluated (gum/rotary_table/evaluate_rotary_table.h): the measurement in coherent SI, and
/// what is asked for.
struct RotaryTableRequest {
    double coverage_probability = 0.9545;  ///< [1]
    engine::RotaryTableMeasurement measurement;
    /// Where the displacement of a point of the table is to be compared with a reference method.
    std::optional<engine::ReferenceMethod> reference;
    std::optional<MonteCarloRequest> monte_carlo;  ///< of the joint method only
    /// Budget of the fixture coordinates with one output, a length, and a point "<reflector>.x", "<reflector>.y",
    /// "<reflector>.z" for each coordinate. Its results take the place of the fixture covariance.
    std::shared_ptr<const Budget> fixture_budget;
    std::string fixture_budget_file;  ///< for messages
    /// Standard uncertainties of the coordinates that are stated and not used, because the covariance comes from
    /// elsewhere: 3n, order x1 y1 z1 …, [m]; 0 where nothing is stated, empty where nothing is stated at all.
    Eigen::VectorXd stated_fixture_u;
    std::optional<engine::MachineFrame> machine_frame;  ///< where the location errors of the axis are asked for
    std::string where;                                  ///< of the request, for messages: the name of the job
};

}  // namespace gumcert::gum
