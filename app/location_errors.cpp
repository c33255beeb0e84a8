#include "app/location_errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "app/document_units.h"
#include "app/record_parts.h"
#include "app/table_parameter_record.h"
#include "engine/job/rotary_table_words.h"
#include "gum/coverage.h"
#include "gum/quantity/units.h"
#include "text/numbers.h"

namespace gumcert::app {

namespace {

using engine::MachineFrame;
using engine::MachineFramePoints;

constexpr double k_refuted = 0.001;                       // p of chi square
constexpr double k_largest_angle = 10.0 * gum::k_degree;  // between the axis and the machine axis of its letter

Eigen::MatrixXd stations_in_table(const MachineFrame& frame, const engine::RotaryTableSolution& solution) {
    Eigen::MatrixXd points(static_cast<Eigen::Index>(frame.points.size()), 3);
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        points.row(static_cast<Eigen::Index>(i)) = solution.stations[frame.points[i]].position.transpose();
    }
    return points;
}

engine::MachineFrameFit fit_of(const engine::RotaryTableJob& job, const engine::RotaryTableSolution& solution) {
    const MachineFrame& frame = *job.machine_frame;
    const engine::RotaryTableMeasurement& measurement = job.measurement;
    std::vector<Eigen::Index> rows;
    std::vector<Eigen::Index> coordinates;
    for (const std::size_t point : frame.points) {
        rows.push_back(static_cast<Eigen::Index>(point));
        for (Eigen::Index c = 0; c < 3; ++c) {
            coordinates.push_back(3 * static_cast<Eigen::Index>(point) + c);
        }
    }
    if (frame.by == MachineFramePoints::stations) {
        return fit_machine_frame(stations_in_table(frame, solution),
                                 solution.station_covariance(coordinates, coordinates), frame);
    }
    const Eigen::MatrixXd points = measurement.fixture(rows, Eigen::all);
    const Eigen::MatrixXd covariance = measurement.fixture_covariance(coordinates, coordinates);
    return fit_machine_frame(points, covariance, frame);
}

engine::LocationErrorModel model_of(const engine::RotaryTableJob& job, const engine::MachineFrameFit& fit,
                                    const engine::RotaryTableSolution& solution, const gum::UncertaintyBudget& budget,
                                    const engine::AnglewiseCovariance& covariance) {
    const engine::RotaryTableMeasurement& measurement = job.measurement;
    if (job.machine_frame->by == MachineFramePoints::stations) {
        return {measurement.axis, *job.machine_frame, fit};
    }
    std::vector<Eigen::Index> quantities;  // error motions at home, then O, O, S, S
    for (Eigen::Index c = 0; c < 6; ++c) {
        quantities.push_back(6 * static_cast<Eigen::Index>(measurement.home) + c);
    }
    for (Eigen::Index c = 0; c < 4; ++c) {
        quantities.push_back(solution.quantities.set_up + c);
    }
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  // the least of them
    for (const Eigen::Index quantity : quantities) {
        degrees_of_freedom = std::fmin(degrees_of_freedom, budget.effective_degrees_of_freedom[quantity]);
    }
    return {measurement.axis,         *job.machine_frame,        fit,
            budget.value(quantities), covariance.of(quantities), degrees_of_freedom};
}

gum::Diagnostic not_stated(const char* code, std::string what, const char* rule, const char* action) {
    return {code, "machine frame", std::move(what), rule, action, gum::Severity::warning};
}

}  // namespace

LocationErrors evaluate_location_errors(const engine::RotaryTableJob& job, const engine::RotaryTableSolution& solution,
                                        const gum::UncertaintyBudget& budget,
                                        const engine::AnglewiseCovariance& covariance) {
    LocationErrors result;
    result.fit = fit_of(job, solution);
    if (result.fit.degrees_of_freedom > 0.0) {
        result.p_value = gum::chi_square_upper_tail(result.fit.chi_square, result.fit.degrees_of_freedom);
    }
    const double rms = std::sqrt(result.fit.residuals.squaredNorm() / static_cast<double>(result.fit.residuals.size()));
    if (result.p_value < k_refuted) {
        result.notes.push_back(not_stated(
            "GC-FRAME-0002",
            "the points do not carry the frame of the machine: their residuals of " +
                text::significant(rms / gum::k_micrometre, 2) +
                " µm (rms) have p = " + text::significant(result.p_value, 2) + "; no location errors are stated",
            "location errors are stated in a frame whose points agree within their uncertainties",
            "Look for a wrong point, or state larger uncertainties, with a reason"));
        return result;
    }
    const engine::LocationErrorModel model = model_of(job, result.fit, solution, budget, covariance);
    if (const double angle = model.angle_to_machine_axis(); !(angle <= k_largest_angle)) {
        result.notes.push_back(
            not_stated("GC-FRAME-0003",
                       "the axis stands at " + text::fixed(angle / gum::k_degree, 1) +
                           "° to the machine axis of its letter; no location errors are stated",
                       "location errors are small deviations from a coordinate axis of the machine",
                       "Check the frame of the coordinates, their order, and the letter of the axis"));
        return result;
    }
    result.budget = gum::propagate(model, job.coverage_probability);
    return result;
}

void fill_location_errors(reports::RotaryTable& rotary, const engine::RotaryTableJob& job,
                          const LocationErrors& errors) {
    const MachineFrame& frame = *job.machine_frame;
    const bool stations = frame.by == MachineFramePoints::stations;
    reports::MachineFrame& record = rotary.machine_frame.emplace();
    record.by = engine::word_of(engine::k_machine_points, frame.by);
    record.source = frame.source;
    for (int c = 0; c < 3; ++c) {
        record.nominal_point_mm[static_cast<std::size_t>(c)] = frame.nominal_point[c] / gum::k_millimetre;
    }
    for (std::size_t i = 0; i < frame.points.size(); ++i) {
        const auto row = static_cast<Eigen::Index>(i);
        const std::size_t point = frame.points[i];
        reports::MachinePoint entry;
        entry.name = stations ? job.measurement.stations[point] : job.measurement.reflectors[point];
        entry.u_um = frame.u[row] / gum::k_micrometre;
        for (int c = 0; c < 3; ++c) {
            entry.residual_um[static_cast<std::size_t>(c)] = errors.fit.residuals(row, c) / gum::k_micrometre;
        }
        record.points.push_back(std::move(entry));
    }
    record.chi_square = errors.fit.chi_square;
    record.degrees_of_freedom = errors.fit.degrees_of_freedom;
    record.p_value = errors.p_value;
    record.printed_p = text::significant(errors.p_value, 2);
    record.printed_residual = text::significant(
        std::sqrt(errors.fit.residuals.squaredNorm() / static_cast<double>(errors.fit.residuals.size())) /
            gum::k_micrometre,
        2);
    if (!errors.budget) {
        return;
    }
    const auto names = engine::location_error_names(job.measurement.axis);
    for (std::size_t i = 0; i < names.size(); ++i) {
        const char coordinate = static_cast<char>(std::tolower(names[i][1]));
        const DocumentUnit& unit = i < 2 ? k_um : k_arcsec;
        const std::string letter(1, i < 2 ? coordinate : static_cast<char>(coordinate - 'a' + 'x'));
        rotary.location_errors.push_back(
            table_parameter(*errors.budget, static_cast<Eigen::Index>(i), unit, names[i],
                            (i < 2 ? "position of the axis along " : "tilt of the axis about ") + letter +
                                " in the frame of the machine"));
    }
}

}  // namespace gumcert::app
