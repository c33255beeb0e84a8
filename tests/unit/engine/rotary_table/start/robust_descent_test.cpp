#include "engine/rotary_table/start/robust_descent.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

TEST(RobustDescent, AFixtureThatIsTurnedOverIsNoFit) {
    StationFit fit;
    EXPECT_FALSE(fit.is_settled());
    fit.misfit = 1e-5;
    EXPECT_TRUE(fit.is_settled());
    EXPECT_EQ(fit.upright_misfit(), 1e-5);
    fit.set_up[2] = 3.1;
    EXPECT_FALSE(fit.is_settled());
    EXPECT_EQ(fit.upright_misfit(), 1.0);
    fit.set_up[2] = 0.0;
    fit.misfit = 2e-4;
    EXPECT_FALSE(fit.is_settled());
}

TEST(RobustDescent, FindsAStationFromDecimetresOffWhateverSomeDistancesSay) {
    synthetic::Campaign campaign = simulate(synthetic::exact_plan());
    for (std::size_t i = 0; i < campaign.measurement.lengths.size(); i += 15) {
        campaign.measurement.lengths[i].length += 0.05;
    }
    const ObservedStations observed(campaign.measurement, {});
    for (std::size_t j = 0; j < 6; ++j) {
        const StationFit fit = refined(observed, j, campaign.truth.stations[j] + Eigen::Vector3d(0.1, -0.08, 0.05),
                                       Eigen::Vector4d::Zero(), true);
        EXPECT_LT((fit.position - campaign.truth.stations[j]).norm(), 1e-7) << j;
        EXPECT_LT(fit.misfit, 1e-8);
        EXPECT_LT(fit.set_up.norm(), 1e-7);
    }
}

TEST(RobustDescent, PlainLeastSquaresFindItFromAnySideAndAHeldSetUpStays) {
    const synthetic::Campaign campaign = simulate(synthetic::exact_plan());
    const ObservedStations observed(campaign.measurement, {});
    const StationFit fit =
        refined(observed, 0, Eigen::Vector3d(0.1, -1.0, 0.0), Eigen::Vector4d::Zero(), false, Pull::of_all);
    EXPECT_LT((fit.position - campaign.truth.stations[0]).norm(), 1e-7) << fit.position.transpose();
    EXPECT_EQ(fit.set_up, Eigen::Vector4d(Eigen::Vector4d::Zero()));
}

TEST(RobustDescent, AllStationsFindTheSetUpThatTheyShare) {
    synthetic::CampaignPlan plan = synthetic::exact_plan();
    plan.offset = {3e-3, -2e-3};
    plan.tilt = {4e-3, 6e-3};
    const synthetic::Campaign campaign = simulate(plan);
    const ObservedStations observed(campaign.measurement, {});
    std::vector<StationFit> fits(6);
    for (std::size_t j = 0; j < 5; ++j) {
        fits[j].position = campaign.truth.stations[j] + Eigen::Vector3d(0.02, 0.01, -0.03);
    }
    Eigen::Vector4d set_up = Eigen::Vector4d::Zero();
    descend(observed, {0, 1, 2, 3, 4}, set_up, fits, true);
    // The prior of the set-up, 5 mm and 1°, is weighed against a micrometre.
    EXPECT_LT((set_up - Eigen::Vector4d(3e-3, -2e-3, 4e-3, 6e-3)).norm(), 1e-6) << set_up.transpose();
    for (std::size_t j = 0; j < 5; ++j) {
        EXPECT_LT((fits[j].position - campaign.truth.stations[j]).norm(), 1e-6) << j;
    }
    EXPECT_EQ(fits[5].position, Eigen::Vector3d(Eigen::Vector3d::Zero()));  // it was not asked for
    EXPECT_FALSE(fits[5].misfit < 1.0);
}

}  // namespace
}  // namespace gumcert::engine
