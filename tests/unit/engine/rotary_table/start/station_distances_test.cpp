#include "engine/rotary_table/start/station_distances.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

/// Distances of one station on paths of these sizes, with nothing else.
StationDistances on_paths(const std::vector<std::size_t>& sizes) {
    StationDistances data;
    Eigen::Index next = 0;
    for (const std::size_t size : sizes) {
        data.members.emplace_back();
        for (std::size_t k = 0; k < size; ++k) {
            data.members.back().push_back(next++);
        }
    }
    data.length = Eigen::VectorXd::Zero(next);
    return data;
}

TEST(StationDistances, AreSortedByStationAndPathAndStretchedByTemperature) {
    synthetic::CampaignPlan plan = synthetic::exact_plan();
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.expansion = 2e-5;
    plan.temperature_difference = 10.0;
    const RotaryTableMeasurement measurement = simulate(plan).measurement;
    std::vector<bool> active(measurement.lengths.size(), true);
    const auto first = std::ranges::find(measurement.lengths, std::size_t{2}, &LengthObservation::station);
    active[static_cast<std::size_t>(first - measurement.lengths.begin())] = false;
    const std::vector<StationDistances> stations = distances_by_station(measurement, active);
    ASSERT_EQ(stations.size(), 6U);
    const StationDistances& data = stations[2];
    ASSERT_EQ(data.observation.size(), 12U * 2U * 6U - 1U);
    EXPECT_EQ(distances_by_station(measurement, {})[2].observation.size(), 12U * 2U * 6U);
    EXPECT_EQ(data.members.size(), 6U);
    for (std::size_t k = 0; k < data.observation.size(); ++k) {
        const LengthObservation& length = measurement.lengths[data.observation[k]];
        EXPECT_EQ(length.station, 2U);
        EXPECT_EQ(data.path_name[data.path[k]], length.dead_path);
        EXPECT_EQ(data.length[static_cast<Eigen::Index>(k)], length.length);
        const Eigen::Vector3d point = measurement.fixture.row(static_cast<Eigen::Index>(length.reflector)).transpose();
        EXPECT_LT((data.point[k] - (1.0 + 2e-5 * 10.2) * point).norm(), 1e-15);  // 0.1 K more a station
    }
}

TEST(StationDistances, DeviationsAreTakenFromTheMedianOfTheirPath) {
    StationDistances data = on_paths({3, 2});
    data.length << 1.0, 2.0, 3.5, 1.0, 1.0;
    const std::vector<Eigen::Vector3d> points{{1.1, 0, 0}, {2.1, 0, 0}, {3.4, 0, 0}, {0, 0.5, 0}, {0, 0.7, 0}};
    const Deviations found = deviations_from(data, points, Eigen::Vector3d::Zero());
    const Eigen::VectorXd each = (Eigen::VectorXd(5) << 0.0, 0.0, -0.2, -0.1, 0.1).finished();
    EXPECT_LT((found.each - each).norm(), 1e-15) << found.each.transpose();
    EXPECT_LT((found.dead_paths - Eigen::Vector2d(0.1, -0.4)).norm(), 1e-15) << found.dead_paths.transpose();
}

TEST(StationDistances, TheMisfitLooksAtTheSmallerDeviationsOfPathsWithTwoDistances) {
    const StationDistances data = on_paths({9, 1, 1, 1, 1, 1});
    Eigen::VectorXd deviation = Eigen::VectorXd::Constant(14, 100.0);
    deviation.head(8) << 3.0, -3.0, 3.0, -3.0, 3.0, -3.0, 3.0, -3.0;
    // 85 % of nine are eight; what is alone on its path is not looked at.
    EXPECT_DOUBLE_EQ(misfit_of(data, deviation), 3.0);
    deviation[7] = 100.0;
    EXPECT_GT(misfit_of(data, deviation), 30.0);
    EXPECT_EQ(misfit_of(on_paths({1, 1}), Eigen::Vector2d(1.0, 2.0)), 0.0);
    std::vector<double> sizes;
    collect_sizes(on_paths({2, 1}), Eigen::Vector3d(-1.0, 2.0, 5.0), sizes);
    EXPECT_EQ(sizes, (std::vector<double>{1.0, 2.0}));
    EXPECT_EQ(median_size(Eigen::Vector4d(-4.0, 1.0, 2.0, 3.0)), 2.5);
}

TEST(StationDistances, SixDistancesBeyondTheUnknownsTellACause) {
    EXPECT_TRUE(tells_causes(on_paths({14})));  // place, set-up and a dead path are eight
    EXPECT_FALSE(tells_causes(on_paths({13})));
    EXPECT_FALSE(tells_causes(on_paths({13, 1})));  // which tells its dead path only
    EXPECT_TRUE(tells_causes(on_paths({13, 2})));
}

}  // namespace
}  // namespace gumcert::engine
