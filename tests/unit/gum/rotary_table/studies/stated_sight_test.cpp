// Plans and simulations leave out the same distances.
#include "gum/rotary_table/studies/stated_sight.h"

#include <gtest/gtest.h>

#include <string>

#include "gum/quantity/diagnostic.h"
#include "gum/rotary_table/studies/simulation_basis.h"
#include "tests/support/planned_layout.h"

namespace gumcert::gum::plan {
namespace {

engine::RotaryTableMeasurement sight_layout() {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(4);
    return engine::planned::layout_of(plan);
}

/// A wall between the stations and the table.
SightStatement wall() {
    engine::Obstacle obstacle;
    obstacle.name = "wall";
    obstacle.low = Eigen::Vector3d(0.25, -3.0, -3.0);
    obstacle.high = Eigen::Vector3d(0.3, 3.0, 3.0);
    obstacle.turns = false;
    SightStatement stated;
    stated.obstacles.push_back(obstacle);
    stated.obstacles_where.emplace_back("wall");
    return stated;
}

/// Reflectors so large that some hide others.
SightStatement large_reflectors() {
    SightStatement stated;
    stated.reflector_diameter = 0.08;
    return stated;
}

TEST(StatedSight, IsNothingWhereNothingIsStated) {
    EXPECT_FALSE(sight_of({}, sight_layout()));
}

TEST(StatedSight, LeavesOutWhatIsHidden) {
    const engine::RotaryTableMeasurement whole = sight_layout();
    const auto sight = sight_of(large_reflectors(), whole);
    ASSERT_TRUE(sight);
    std::size_t seen = 0;
    for (const bool is_seen : engine::seen_distances(whole, *sight)) {
        seen += is_seen ? 1U : 0U;
    }
    ASSERT_GT(seen, 0U);
    ASSERT_LT(seen, whole.lengths.size());
    EXPECT_EQ(seen_layout(whole, *sight).lengths.size(), seen);
}

/// What was measured was seen. Full turns of other angles were not measured.
TEST(StatedSight, IsAskedOfFullTurnsBesideMeasuredLengths) {
    simulation::Basis basis;
    basis.layout = sight_layout();
    basis.sight = large_reflectors();
    basis.is_measured = true;
    EXPECT_EQ(simulation::simulated_layout(basis, 0).lengths.size(), basis.layout.lengths.size());
    simulation::Basis nothing_hidden = basis;
    nothing_hidden.sight = {};
    EXPECT_LT(simulation::simulated_layout(basis, 4).lengths.size(),
              simulation::simulated_layout(nothing_hidden, 4).lengths.size());
}

TEST(StatedSight, RefusesAStationThatSeesNothing) {
    const engine::RotaryTableMeasurement whole = sight_layout();
    const auto sight = sight_of(wall(), whole);
    ASSERT_TRUE(sight);
    try {
        (void)seen_layout(whole, *sight);
        FAIL() << "a wall before all stations";
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-PLAN-0004");
        EXPECT_EQ(error.diagnostics().front().what, "sees none of its 24 distances");
    }
}

// A full turn of other angles has hidden distances of its own.
TEST(StatedSight, HoldsForASimulationOfALayout) {
    RotaryTableRequest request;
    request.measurement = sight_layout();
    request.measurement.lengths.clear();
    request.measurement.passes.clear();
    request.measurement.dead_paths.clear();
    PlanRequest asked;
    asked.angles_deg = request.measurement.angles_deg;
    asked.sight = large_reflectors();
    const simulation::Basis basis = simulation::basis_of(request, {}, asked, {});
    const engine::RotaryTableMeasurement& whole = basis.layout;
    EXPECT_EQ(simulation::simulated_layout(basis, 0).lengths.size(),
              seen_layout(whole, *sight_of(asked.sight, whole)).lengths.size());
    const std::size_t of_turn = simulation::simulated_layout(basis, 7).lengths.size();
    EXPECT_LT(of_turn, 7U * whole.stations.size() * whole.reflectors.size());
    EXPECT_GT(of_turn, 0U);
}

}  // namespace
}  // namespace gumcert::gum::plan
