#include "engine/rotary_table/start/rival_places.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "engine/rotary_table/start/candidate_places.h"
#include "engine/rotary_table/start/place_search.h"
#include "tests/support/few_reflectors.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

/// Of known places and set-up, where a search would not come.
CommonFit truth_of(const synthetic::Campaign& campaign, const ObservedStations& observed) {
    CommonFit truth;
    for (Eigen::Index c = 0; c < 2; ++c) {
        const int across = observed.across()[static_cast<std::size_t>(c)];
        truth.set_up[c] = campaign.truth.set_up[across];
        truth.set_up[2 + c] = campaign.truth.set_up[3 + across];
    }
    for (std::size_t j = 0; j < campaign.truth.stations.size(); ++j) {
        StationFit fit;
        fit.position = campaign.truth.stations[j];
        fit.misfit = misfit_of(observed.stations()[j], observed.deviations(j, truth.set_up, fit.position).each);
        truth.stations.push_back(fit);
    }
    return truth;
}

TEST(RivalPlaces, MirroredTableOfAPlaneHasTheSameDistances) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        synthetic::CampaignPlan plan = synthetic::small_plan();
        plan.axis = axis;
        plan.reflectors = {{0.05, 0.1, 0.0}, {0.05, -0.05, 0.087}, {0.07, -0.05, -0.087}};
        plan.offset = {4e-3, -7e-3};
        plan.tilt = {0.03, -0.02};
        const synthetic::Campaign campaign = simulate(plan);
        const ObservedStations observed(campaign.measurement, {});
        const CommonFit truth = truth_of(campaign, observed);
        const std::optional<CommonFit> mirrored = mirrored_table(observed, truth);
        ASSERT_TRUE(mirrored);
        EXPECT_GT((mirrored->set_up - truth.set_up).tail<2>().norm(), 0.05);
        for (std::size_t j = 0; j < 6; ++j) {
            EXPECT_GT((mirrored->stations[j].position - truth.stations[j].position).norm(), 0.1) << j;
            const Eigen::VectorXd there = observed.deviations(j, mirrored->set_up, mirrored->stations[j].position).each;
            const Eigen::VectorXd here = observed.deviations(j, truth.set_up, truth.stations[j].position).each;
            EXPECT_LT((there - here).cwiseAbs().maxCoeff(), 1e-12) << j;
        }
        // Twice is where it was.
        const std::optional<CommonFit> back = mirrored_table(observed, *mirrored);
        ASSERT_TRUE(back);
        EXPECT_LT((back->set_up - truth.set_up).norm(), 1e-12);
        for (std::size_t j = 0; j < 6; ++j) {
            EXPECT_LT((back->stations[j].position - truth.stations[j].position).norm(), 1e-12) << j;
        }
    }
}

TEST(RivalPlaces, AFixtureInSpaceHasNoMirroredTable) {
    const synthetic::Campaign campaign = simulate(synthetic::small_plan());
    const ObservedStations observed(campaign.measurement, {});
    EXPECT_FALSE(mirrored_table(observed, truth_of(campaign, observed)));
}

TEST(RivalPlaces, AStationOnTheFalseSideIsTurnedBackThoughTheSetUpIsDrawnWithIt) {
    constexpr std::uint64_t k_campaigns = 12;
    std::size_t misled = 0;
    std::size_t found_right = 0;
    for (std::uint64_t seed = 1; seed <= k_campaigns; ++seed) {
        synthetic::CampaignPlan plan = synthetic::ring_of_few(seed, 3, {0.02, 0.16}, 120.0, 0.01);
        plan.stations = {{0.6, 1.1, 0.5}, {0.8, 0.9, -0.7}, {1.1, 1.2, 0.1}, {0.4, 0.7, 0.9}, {0.9, 0.3, 1.1}};
        const synthetic::Campaign campaign = simulate(plan);
        const ObservedStations observed(campaign.measurement, {});
        const CommonFit truth = truth_of(campaign, observed);
        const auto is_right = [&](const CommonFit& fit) {
            return (fit.stations[3].position - truth.stations[3].position).norm() < 0.05;
        };
        CommonFit from = truth;
        from.stations[3].position =
            mirror_image(observed.positions(3, truth.set_up, false).point, truth.stations[3].position);
        descend(observed, {0, 1, 2, 3, 4}, from.set_up, from.stations, true);
        if (!is_right(from)) {
            ++misled;
            found_right += is_right(fit_by_turns(observed, from)) ? 1U : 0U;
        }
        EXPECT_TRUE(is_right(fit_by_turns(observed, truth))) << seed << ": what is right stays";
    }
    EXPECT_GE(misled, 6U) << "nothing is tested";
    EXPECT_GE(found_right, misled / 2 + 1) << "of " << misled;
}

TEST(RivalPlaces, StandElsewhereFromACentimetreOn) {
    const std::vector<Eigen::Vector3d> here{{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    std::vector<Eigen::Vector3d> there = here;
    there[1][2] = 0.009;
    EXPECT_FALSE(stands_elsewhere(here, there));
    there[1][2] = 0.011;
    EXPECT_TRUE(stands_elsewhere(here, there));
}

}  // namespace
}  // namespace gumcert::engine
