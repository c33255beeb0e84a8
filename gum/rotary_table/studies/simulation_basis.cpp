#include "gum/rotary_table/studies/simulation_basis.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/studies/campaign_layout.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "gum/rotary_table/studies/stated_sight.h"

namespace gumcert::gum::simulation {

namespace {

using engine::RotaryTableMeasurement;

constexpr std::size_t k_most_runs = 1'000'000;

bool all_stations_known(const RotaryTableMeasurement& measurement) {
    return std::all_of(measurement.station_start.begin(), measurement.station_start.end(),
                       [](const auto& start) { return start.has_value(); });
}

}  // namespace

Basis basis_of(const RotaryTableRequest& measured, const SimulationRequest& asked, const PlanRequest& plan,
               const Progress& progress) {
    Basis basis;
    basis.layout = measured.measurement;
    basis.layout.reversal = engine::ReversalModel::constant;  // as it is simulated
    basis.request = asked;
    if (basis.request.runs < 1 || basis.request.runs > k_most_runs) {
        throw InputError(Diagnostic{"GC-SIMULATE-0001", "runs", std::to_string(basis.request.runs),
                                    "a study has 1 to 1000000 campaigns", "state another number of runs",
                                    Severity::error});
    }
    RotaryTableMeasurement& layout = basis.layout;
    basis.table = basis.request.table_repeatability.value_or(layout.table_repeatability);
    const bool table_unknown = !basis.request.table_repeatability &&
                               basis.table.mode == engine::RepeatabilityMode::estimate && basis.table.u_linear <= 0.0 &&
                               basis.table.u_axial <= 0.0 && basis.table.u_tilt <= 0.0;
    if (basis.table.mode == engine::RepeatabilityMode::none) {
        basis.table.u_linear = basis.table.u_axial = basis.table.u_tilt = 0.0;
    }
    basis.table_from = basis.request.table_repeatability ? "stated for the simulation" : "stated by the job";
    basis.stations_from = "stations file";
    const bool has_lengths = !layout.lengths.empty();
    if (has_lengths && (table_unknown || !all_stations_known(layout))) {
        if (progress) {
            progress("joint adjustment of the measured lengths");
        }
        RotaryTableMeasurement measurement = layout;
        measurement.method = engine::AdjustmentMethod::joint;
        measurement.reversal = measured.measurement.reversal;
        const engine::RotaryTableSolution solution =
            engine::evaluate_jointly(measurement, evaluation_options(measurement));
        if (table_unknown) {
            basis.table.u_linear = std::sqrt(solution.stochastic.variance_linear);
            basis.table.u_axial = std::sqrt(solution.stochastic.variance_axial);
            basis.table.u_tilt = std::sqrt(solution.stochastic.variance_tilt);
            basis.table_from = "estimated from the measured lengths";
        }
        if (!all_stations_known(layout)) {
            for (std::size_t j = 0; j < layout.stations.size(); ++j) {
                layout.station_start[j] = solution.stations[j].position;
            }
            basis.stations_from = "joint adjustment of the measured lengths";
        }
    } else if (table_unknown) {
        basis.table_from = "a perfect table, because the job states none";
    }
    if (!has_lengths) {
        if (layout.angles.empty() && !plan.angles_deg.empty()) {
            layout.angles_deg = plan.angles_deg;
            for (const double angle : plan.angles_deg) {
                layout.angles.push_back(angle * k_degree);
            }
        }
        if (layout.angles.empty() && !basis.request.angle_counts.empty()) {
            layout = engine::with_full_turn(layout, basis.request.angle_counts.front());
        }
        engine::lay_out(layout, plan.both_senses, plan.dead_path_per_reflector);
    }
    basis.sight = plan.sight;
    basis.is_measured = has_lengths;
    return basis;
}

RotaryTableMeasurement simulated_layout(const Basis& basis, std::size_t angles) {
    RotaryTableMeasurement whole = angles == 0 ? basis.layout : engine::with_full_turn(basis.layout, angles);
    if (angles == 0 && basis.is_measured) {
        return whole;  // measured is what was seen
    }
    const std::optional<engine::LineOfSight> sight = plan::sight_of(basis.sight, whole);
    return sight ? plan::seen_layout(whole, *sight) : whole;
}

}  // namespace gumcert::gum::simulation
