#include "engine/rotary_table/start/observed_stations.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Vector6;

TEST(ObservedStations, PointsStandWhereTheKinematicsPutThem) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        synthetic::CampaignPlan plan = synthetic::exact_plan();
        plan.axis = axis;
        plan.home = 2;
        const RotaryTableMeasurement measurement = simulate(plan).measurement;
        const ObservedStations observed(measurement, {});
        const Eigen::Vector4d set_up(1e-3, -2e-3, 0.02, -0.03);
        const int a = axial_coordinate(axis);
        Vector6 parameters = Vector6::Zero();
        for (int c = 0; c < 2; ++c) {
            parameters[(a + 1 + c) % 3] = set_up[c];
            parameters[3 + (a + 1 + c) % 3] = set_up[2 + c];
        }
        const PointPositions positions = observed.positions(1, set_up, false);
        EXPECT_TRUE(positions.by_set_up.empty());
        const StationDistances& data = observed.stations()[1];
        for (std::size_t k = 0; k < data.point.size(); ++k) {
            const double from_home = measurement.angles[data.angle[k]] - measurement.angles[2];
            EXPECT_LT((positions.point[k] -
                       synthetic::point_in_table(axis, from_home, Vector6::Zero(), parameters, data.point[k]))
                          .norm(),
                      1e-14);
        }
        const Eigen::Vector3d point(0.1, 0.2, 0.3);
        EXPECT_LT((observed.set_up_motion(set_up) * point - synthetic::moved(parameters, point)).norm(), 1e-15);
    }
}

TEST(ObservedStations, DerivativesAreThoseOfDifferences) {
    const RotaryTableMeasurement measurement = simulate(synthetic::exact_plan()).measurement;
    const ObservedStations observed(measurement, {});
    constexpr double k_step = 1e-5;
    const Eigen::Vector4d set_up(1e-3, -2e-3, 0.2, -0.3);
    const PointPositions at = observed.positions(3, set_up, true);
    for (int c = 0; c < 4; ++c) {
        const PointPositions after = observed.positions(3, set_up + k_step * Eigen::Vector4d::Unit(c), false);
        const PointPositions before = observed.positions(3, set_up - k_step * Eigen::Vector4d::Unit(c), false);
        for (std::size_t k = 0; k < at.point.size(); ++k) {
            const Eigen::Vector3d difference = (after.point[k] - before.point[k]) / (2.0 * k_step);
            EXPECT_LT((at.by_set_up[k].col(c) - difference).norm(), 1e-9) << c << ", " << k;
        }
    }
}

TEST(ObservedStations, ExactDistancesDeviateByTheirDeadPathOnly) {
    const synthetic::Campaign campaign = simulate(synthetic::exact_plan());
    const ObservedStations observed(campaign.measurement, {});
    for (std::size_t j = 0; j < 6; ++j) {
        const Deviations found = observed.deviations(j, Eigen::Vector4d::Zero(), campaign.truth.stations[j]);
        EXPECT_LT(found.each.cwiseAbs().maxCoeff(), 1e-14);
        ASSERT_EQ(found.dead_paths.size(), 1);
        EXPECT_NEAR(found.dead_paths[0], campaign.truth.dead_paths[static_cast<Eigen::Index>(j)], 1e-14);
    }
}

}  // namespace
}  // namespace gumcert::engine
