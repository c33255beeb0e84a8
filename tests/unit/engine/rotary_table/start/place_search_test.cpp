#include "engine/rotary_table/start/place_search.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(PlaceSearch, FindsEachStationOnItsOwn) {
    for (const synthetic::DeadPaths paths :
         {synthetic::DeadPaths::per_station, synthetic::DeadPaths::per_station_and_reflector}) {
        synthetic::CampaignPlan plan = synthetic::small_plan();
        plan.dead_paths = paths;
        const synthetic::Campaign campaign = simulate(plan);
        const PlaceSearch search(campaign.measurement);
        const std::vector<StationFit> fits = search.fit_each();
        ASSERT_EQ(fits.size(), 6U);
        for (std::size_t j = 0; j < 6; ++j) {
            EXPECT_LT((fits[j].position - campaign.truth.stations[j]).norm(), 2e-3) << j;
            EXPECT_TRUE(fits[j].is_settled());
            EXPECT_EQ(search.fit_of(j, true).position, fits[j].position);
            EXPECT_TRUE(search.tells_causes(j));
            EXPECT_EQ(search.deviations(j, fits[j]).each.size(), std::ssize(search.distances(j).observation));
        }
    }
}

TEST(PlaceSearch, OfTwoPlacesThatExplainTheDistancesAlikeTheStatedOneIsNearer) {
    synthetic::CampaignPlan plan = synthetic::small_plan();
    plan.tilt.setZero();
    for (Eigen::Vector3d& reflector : plan.reflectors) {
        reflector[0] = 0.1;
    }
    synthetic::Campaign campaign = simulate(plan);
    for (const double side : {0.7, -0.5}) {
        campaign.measurement.station_start[0] = Eigen::Vector3d(side, 0.5, 0.05);
        const StationFit fit = PlaceSearch(campaign.measurement).fit_of(0, true);
        EXPECT_LT((fit.position - Eigen::Vector3d(side, 0.45, 0.10)).norm(), 2e-3) << fit.position.transpose();
    }
}

TEST(PlaceSearch, ASearchThatGoesOnEndsNoWorse) {
    const synthetic::Campaign campaign = simulate(synthetic::small_plan());
    const PlaceSearch search(campaign.measurement);
    const StationFit found = search.fit_of(2, true);
    StationFit poor = found;
    poor.position += Eigen::Vector3d(0.4, 0.2, -0.3);
    poor.misfit = 0.05;
    EXPECT_LT((search.fit_from_all_sides(2, poor).position - found.position).norm(), 1e-4);
    EXPECT_LE(search.fit_from_all_sides(2, found).misfit, found.misfit);
    StationFit near = found;
    near.position += Eigen::Vector3d(0.01, 0.0, 0.01);
    EXPECT_LT((search.fit_near(2, near).position - found.position).norm(), 1e-4);
}

// Gross errors have no weight in a fit; plain least squares are moved by them.
TEST(PlaceSearch, PlainFitsLeaveNoDistanceOut) {
    synthetic::Campaign campaign = simulate(synthetic::exact_plan());
    std::size_t count = 0;
    for (LengthObservation& length : campaign.measurement.lengths) {
        length.length += length.station == 0 && ++count % 10 == 0 ? 0.02 : 0.0;
    }
    const PlaceSearch search(campaign.measurement);
    const StationFit found = search.fit_of(0, true);
    EXPECT_LT((found.position - campaign.truth.stations[0]).norm(), 1e-6);
    const std::vector<StationFit> plain = search.plain_fits(0, found);
    ASSERT_EQ(plain.size(), 7U);
    EXPECT_TRUE(std::ranges::none_of(
        plain, [&](const StationFit& fit) { return (fit.position - campaign.truth.stations[0]).norm() < 1e-5; }));
}

}  // namespace
}  // namespace gumcert::engine
