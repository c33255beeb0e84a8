#include "engine/rotary_table/start/candidate_places.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <vector>

#include "engine/rotary_table/start/observed_stations.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

const std::vector<Eigen::Vector3d>& flat_points() {
    static const std::vector<Eigen::Vector3d> points{{0.1, 1, 0}, {0.1, -1, 0}, {0.1, 0, 2}, {0.1, 0, -2}};
    return points;
}

TEST(CandidatePlaces, AMirrorImageIsThatInThePlaneOfThePoints) {
    const Eigen::Vector3d image = mirror_image(flat_points(), {0.7, 0.4, -0.3});
    EXPECT_LT((image - Eigen::Vector3d(-0.5, 0.4, -0.3)).norm(), 1e-15) << image.transpose();
}

TEST(CandidatePlaces, AllSidesAreAMetreOff) {
    const Eigen::Vector3d centre(1.0, 2.0, 3.0);
    const std::vector<Eigen::Vector3d> sides = all_sides(centre);
    ASSERT_EQ(sides.size(), 6U);
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& side : sides) {
        EXPECT_NEAR((side - centre).norm(), 1.0, 1e-15);
        sum += side - centre;
    }
    EXPECT_LT(sum.norm(), 1e-14);
}

TEST(CandidatePlaces, TheGridHasADirectionNearAnyOther) {
    const std::vector<Eigen::Vector3d> grid = sphere_grid(Eigen::Vector3d::Zero());
    synthetic::Noise draw(3);
    for (int n = 0; n < 200; ++n) {
        const Eigen::Vector3d direction = Eigen::Vector3d(draw.normal(), draw.normal(), draw.normal()).normalized();
        double nearest = -1.0;
        for (const Eigen::Vector3d& place : grid) {
            nearest = std::max(nearest, place.normalized().dot(direction));
        }
        EXPECT_GT(nearest, std::cos(0.35)) << direction.transpose();
    }
}

TEST(CandidatePlaces, TheOpenLineGoesThroughTheMiddleOfThePointsInItsDirection) {
    ClosedSolution closed;
    closed.position = {5.0, 0.4, 0.2};
    closed.centre = {1.0, 0.0, 0.0};
    const std::vector<Eigen::Vector3d> line = open_line(closed);
    ASSERT_EQ(line.size(), 49U);
    EXPECT_LT((line.front() - Eigen::Vector3d(-2.0, 0.4, 0.2)).norm(), 1e-14) << line.front().transpose();
    EXPECT_LT((line.back() - Eigen::Vector3d(4.0, 0.4, 0.2)).norm(), 1e-14) << line.back().transpose();
}

TEST(CandidatePlaces, TheBestOfAGridComesFirstAndItsNeighboursDoNot) {
    const synthetic::Campaign campaign = simulate(synthetic::exact_plan());
    const ObservedStations observed(campaign.measurement, {});
    const StationDistances& data = observed.stations()[0];
    const std::vector<Eigen::Vector3d> points = observed.positions(0, Eigen::Vector4d::Zero(), false).point;
    const Eigen::Vector3d& truth = campaign.truth.stations[0];
    const std::vector<Eigen::Vector3d> grid{truth + Eigen::Vector3d(0.5, 0, 0), truth + Eigen::Vector3d(0.1, 0, 0),
                                            truth, truth + Eigen::Vector3d(0, 1, 0)};
    const std::vector<Eigen::Vector3d> best = best_of(data, points, grid, 2);
    ASSERT_EQ(best.size(), 2U);
    EXPECT_EQ(best[0], truth);
    EXPECT_NE(best[1], grid[1]);  // a tenth of a metre off the best
    EXPECT_FALSE(is_hopeless(data, points, truth, 0.0));
    EXPECT_FALSE(is_hopeless(data, points, truth + Eigen::Vector3d(1e-3, 0, 0), 0.0));
    EXPECT_TRUE(is_hopeless(data, points, truth + Eigen::Vector3d(0.1, 0, 0), 0.0));
    EXPECT_FALSE(is_hopeless(data, points, truth + Eigen::Vector3d(0.1, 0, 0), 0.1));
}

}  // namespace
}  // namespace gumcert::engine
