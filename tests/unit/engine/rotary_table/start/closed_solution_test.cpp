#include "engine/rotary_table/start/closed_solution.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "engine/rotary_table/start/observed_stations.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(ClosedSolution, IsTheStationWhereDistancesAreExact) {
    const synthetic::Campaign campaign = simulate(synthetic::exact_plan());
    const ObservedStations observed(campaign.measurement, {});
    for (std::size_t j = 0; j < 6; ++j) {
        const ClosedSolution found =
            closed_solution(observed.stations()[j], observed.positions(j, Eigen::Vector4d::Zero(), false).point);
        EXPECT_TRUE(found.determined);
        EXPECT_LT((found.position - campaign.truth.stations[j]).norm(), 1e-9) << j;
    }
}

// On a full turn each reflector goes round a circle about the axis: with a dead path of its own it says nothing of the height.
TEST(ClosedSolution, ADeadPathOfEachReflectorLeavesTheCoordinateAlongTheAxisOpen) {
    synthetic::CampaignPlan plan = synthetic::exact_plan();
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    const synthetic::Campaign campaign = simulate(plan);
    const ObservedStations observed(campaign.measurement, {});
    const ClosedSolution found =
        closed_solution(observed.stations()[1], observed.positions(1, Eigen::Vector4d::Zero(), false).point);
    EXPECT_FALSE(found.determined);
    EXPECT_NEAR(std::abs(found.open.x()), 1.0, 1e-9);
    const Eigen::Vector3d off = found.position - campaign.truth.stations[1];
    EXPECT_LT(off.tail<2>().norm(), 1e-8);
    EXPECT_NEAR(found.position.x(), found.centre.x(), 1e-9);
}

}  // namespace
}  // namespace gumcert::engine
