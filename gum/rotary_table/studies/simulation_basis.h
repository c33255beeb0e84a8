#pragma once

#include <cstddef>
#include <string>

#include "engine/rotary_table/rotary_table_measurement.h"
#include "gum/quantity/progress.h"
#include "gum/rotary_table/rotary_table_request.h"
#include "gum/rotary_table/studies/plan_request.h"
#include "gum/rotary_table/studies/simulation_request.h"

namespace gumcert::gum::simulation {

/// What was simulated.
struct Basis {
    engine::RotaryTableMeasurement layout;  ///< with lengths, and a position of every station
    SimulationRequest request;
    engine::TableRepeatability table;
    bool is_measured = false;               ///< the distances of the layout are those that were seen
    SightStatement sight;                   ///< of a layout that is not measured, and of full turns
    std::string table_from, stations_from;  ///< for the document
};

/// Completes what a simulation needs: repeatability of the table and positions of the stations that nothing states are
/// those of the joint adjustment of the measured lengths; without lengths, the layout is that of a plan.
/// \param measured  its budget of the fixture is applied (apply_fixture_budget())
/// \throws InputError     GC-SIMULATE-0001 the number of runs
/// \throws NoResultError  of evaluate_jointly()
[[nodiscard]] Basis basis_of(const RotaryTableRequest& measured, const SimulationRequest& asked,
                             const PlanRequest& plan, const Progress& progress);

/// What is simulated: the layout of the basis, or its full turn, without the distances that no beam reaches.
/// \param angles  of a full turn; 0: those of the basis
/// \throws InputError  of plan::sight_of() and plan::seen_layout()
[[nodiscard]] engine::RotaryTableMeasurement simulated_layout(const Basis& basis, std::size_t angles);

}  // namespace gumcert::gum::simulation
