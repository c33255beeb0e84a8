#include "engine/rotary_table/start/common_set_up.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/place_search.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(CommonSetUp, IsThatOfTheFixture) {
    synthetic::CampaignPlan plan = synthetic::small_plan();
    plan.offset = {2e-3, -1e-3};
    plan.tilt = {3e-3, 5e-3};
    const synthetic::Campaign campaign = simulate(plan);
    const PlaceSearch search(campaign.measurement);
    const CommonFit found = fit_together(search.observed(), search.fit_each());
    // What is left are error motions of micrometres and some 10 µrad.
    EXPECT_LT((found.set_up - Eigen::Vector4d(2e-3, -1e-3, 3e-3, 5e-3)).norm(), 1e-4) << found.set_up.transpose();
    for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_LT((found.stations[j].position - campaign.truth.stations[j]).norm(), 1e-3) << j;
    }
}

TEST(CommonSetUp, AStationOnTheWrongSideStandsOutAndIsLookedForAgain) {
    const synthetic::Campaign campaign = simulate(synthetic::small_plan());
    const PlaceSearch search(campaign.measurement);
    std::vector<StationFit> alone = search.fit_each();
    const std::vector<Eigen::Vector3d> points = search.observed().positions(3, Eigen::Vector4d::Zero(), false).point;
    alone[3].position = mirror_image(points, alone[3].position);
    const CommonFit found = fit_together(search.observed(), alone);
    EXPECT_LT((found.stations[3].position - campaign.truth.stations[3]).norm(), 1e-3)
        << found.stations[3].position.transpose();
}

/// \param raised  one of three reflectors, along the axis, [m]
synthetic::Campaign three_reflectors(double raised) {
    synthetic::CampaignPlan plan = synthetic::small_plan();
    plan.reflectors = {{0.05, 0.1, 0.0}, {0.05, -0.05, 0.087}, {0.05 + raised, -0.05, -0.087}};
    return simulate(plan);
}

// Their plane stands 3° off the one across the axis: a fixture that is inclined by 6° to the other side has the same distances.
TEST(CommonSetUp, ThreeReflectorsNearlyAcrossTheAxisHaveAnotherSide) {
    const synthetic::Campaign campaign = three_reflectors(0.008);
    const PlaceSearch search(campaign.measurement);
    EXPECT_TRUE(has_mirrored_table(search.observed(), Eigen::Vector4d::Zero()));
    EXPECT_TRUE(has_other_side(search.observed(), fit_within_reach(search.observed())));
}

// From the mirror image of the truth back to the truth.
TEST(CommonSetUp, OtherSideOfAFalseTableIsTheRightOne) {
    const synthetic::Campaign campaign = three_reflectors(0.008);
    const PlaceSearch search(campaign.measurement);
    const CommonFit within = fit_within_reach(search.observed());
    const CommonFit other = fit_on_other_side(search.observed(), within, true);
    const CommonFit back = fit_on_other_side(search.observed(), other, true);
    for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_GT((other.stations[j].position - within.stations[j].position).norm(), 0.1) << j;
        EXPECT_LT((back.stations[j].position - within.stations[j].position).norm(), 1e-3) << j;
    }
}

TEST(CommonSetUp, NobodyHasTheOtherSideOfAnInclinedPlaneAndAFixtureInSpaceHasNone) {
    const synthetic::Campaign inclined = three_reflectors(0.05);
    EXPECT_FALSE(has_mirrored_table(PlaceSearch(inclined.measurement).observed(), Eigen::Vector4d::Zero()));
    const synthetic::Campaign in_space = simulate(synthetic::small_plan());
    EXPECT_FALSE(has_mirrored_table(PlaceSearch(in_space.measurement).observed(), Eigen::Vector4d::Zero()));
}

// The plane stands 18° off, the axis 25° beside its coordinate: of the mirror image 12°. Neither is upright, and either may be.
TEST(CommonSetUp, OfTwoInclinedTablesNoneIsKnownBetter) {
    const synthetic::Campaign inclined = three_reflectors(0.05);
    const ObservedStations observed(inclined.measurement, {});
    EXPECT_TRUE(has_mirrored_table(observed, {0.0, 0.0, 0.3833, -0.2138}));
    EXPECT_FALSE(has_mirrored_table(observed, {0.0, 0.0, -0.3833, 0.2138})) << "of 62°";
}

}  // namespace
}  // namespace gumcert::engine
