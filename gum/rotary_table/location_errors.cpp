#include "gum/rotary_table/location_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "gum/coverage.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::gum {

namespace {

using engine::MachineFrame;
using engine::MachineFramePoints;

constexpr double k_refuted = 0.001;                  // p of chi square
constexpr double k_largest_angle = 10.0 * k_degree;  // between the axis and the machine axis of its letter

Eigen::MatrixXd stations_in_table(const MachineFrame& frame, const engine::RotaryTableSolution& solution) {
    Eigen::MatrixXd points(static_cast<Eigen::Index>(frame.points.size()), 3);
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        points.row(static_cast<Eigen::Index>(i)) = solution.stations[frame.points[i]].position.transpose();
    }
    return points;
}

engine::MachineFrameFit fit_of(const RotaryTableRequest& request, const engine::RotaryTableSolution& solution) {
    const MachineFrame& frame = *request.machine_frame;
    const engine::RotaryTableMeasurement& measurement = request.measurement;
    std::vector<Eigen::Index> rows;
    std::vector<Eigen::Index> coordinates;
    for (const std::size_t point : frame.points) {
        rows.push_back(static_cast<Eigen::Index>(point));
        for (Eigen::Index c = 0; c < 3; ++c) {
            coordinates.push_back(3 * static_cast<Eigen::Index>(point) + c);
        }
    }
    // Stations stand in the world, where the axis is nominal; reflectors turn with the table, and the pose at home
    // comes in.
    if (frame.by == MachineFramePoints::stations) {
        return fit_machine_frame(stations_in_table(frame, solution),
                                 solution.station_covariance(coordinates, coordinates), frame);
    }
    const Eigen::MatrixXd points = measurement.fixture(rows, Eigen::all);
    const Eigen::MatrixXd covariance = measurement.fixture_covariance(coordinates, coordinates);
    return fit_machine_frame(points, covariance, frame);
}

engine::LocationErrorModel model_of(const RotaryTableRequest& request, const engine::MachineFrameFit& fit,
                                    const engine::RotaryTableSolution& solution, const UncertaintyBudget& budget,
                                    const engine::AnglewiseCovariance& covariance) {
    const engine::RotaryTableMeasurement& measurement = request.measurement;
    if (request.machine_frame->by == MachineFramePoints::stations) {
        return {measurement.axis, *request.machine_frame, fit};
    }
    // The reflectors stand in the table by P = E(home) T_s p (ADR 0034): what the table errs by at its home angle
    // belongs to the fit.
    std::vector<Eigen::Index> quantities;  // error motions at home, then O, O, S, S
    for (Eigen::Index c = 0; c < 6; ++c) {
        quantities.push_back(6 * static_cast<Eigen::Index>(measurement.home) + c);
    }
    for (Eigen::Index c = 0; c < 4; ++c) {
        quantities.push_back(solution.quantities.set_up + c);
    }
    // One number for inputs that are correlated: the least of them does not promise too much.
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  // the least of them
    for (const Eigen::Index quantity : quantities) {
        degrees_of_freedom = std::fmin(degrees_of_freedom, budget.effective_degrees_of_freedom[quantity]);
    }
    return {measurement.axis,         *request.machine_frame,    fit,
            budget.value(quantities), covariance.of(quantities), degrees_of_freedom};
}

Diagnostic not_stated(const char* code, std::string what, const char* rule, const char* action) {
    return {code, "machine frame", std::move(what), rule, action, Severity::warning};
}

}  // namespace

LocationErrors evaluate_location_errors(const RotaryTableRequest& request, const engine::RotaryTableSolution& solution,
                                        const UncertaintyBudget& budget,
                                        const engine::AnglewiseCovariance& covariance) {
    LocationErrors result;
    result.fit = fit_of(request, solution);
    // As many points as unknowns leave no residuals that could refute the frame.
    if (result.fit.degrees_of_freedom > 0.0) {
        result.p_value = chi_square_upper_tail(result.fit.chi_square, result.fit.degrees_of_freedom);
    }
    const double rms = std::sqrt(result.fit.residuals.squaredNorm() / static_cast<double>(result.fit.residuals.size()));
    if (result.p_value < k_refuted) {
        result.notes.push_back(not_stated(
            "GC-FRAME-0002",
            "the points do not carry the frame of the machine: their residuals of " +
                text::significant(rms / k_micrometre, 2) +
                " µm (rms) have p = " + text::significant(result.p_value, 2) + "; no location errors are stated",
            "location errors are stated in a frame whose points agree within their uncertainties",
            "Look for a wrong point, or state larger uncertainties, with a reason"));
        return result;
    }
    const engine::LocationErrorModel model = model_of(request, result.fit, solution, budget, covariance);
    // An axis at a large angle is not the axis of this letter, or the coordinates are in another order: no small angles
    // then, and numbers without meaning (ADR 0034).
    if (const double angle = model.angle_to_machine_axis(); !(angle <= k_largest_angle)) {
        result.notes.push_back(
            not_stated("GC-FRAME-0003",
                       "the axis stands at " + text::fixed(angle / k_degree, 1) +
                           "° to the machine axis of its letter; no location errors are stated",
                       "location errors are small deviations from a coordinate axis of the machine",
                       "Check the frame of the coordinates, their order, and the letter of the axis"));
        return result;
    }
    result.budget = propagate(model, request.coverage_probability);
    return result;
}

}  // namespace gumcert::gum
