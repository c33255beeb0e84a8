// What a station sees: obstacles that turn or stand, reflectors in the way of each other, reflectors that look away.
#include "engine/rotary_table/studies/line_of_sight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "tests/support/planned_layout.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using Kind = Hindrance::Kind;

/// Three reflectors on a table that turns about z: on its face, on its rim and on a post.
RotaryTableMeasurement table() {
    synthetic::CampaignPlan plan;
    plan.axis = RotaryAxis::c;
    plan.angles_deg = {0.0, 90.0, 180.0, 270.0};
    plan.home = 0;
    plan.reflectors = {{0.2, 0.0, 0.0}, {0.0, 0.3, -0.05}, {-0.1, 0.1, 0.2}};
    RotaryTableMeasurement measurement = planned::layout_of(plan);
    for (Eigen::Index m = 0; m < 3; ++m) {  // without the errors of the measured coordinates
        measurement.fixture.row(m) = plan.reflectors[static_cast<std::size_t>(m)].transpose();
    }
    return measurement;
}

Obstacle cylinder(double radius, double low, double high) {
    Obstacle result;
    result.name = "table";
    result.radius = radius;
    result.low[2] = low;
    result.high[2] = high;
    return result;
}

Obstacle box(Eigen::Vector3d low, Eigen::Vector3d high, bool turns) {
    Obstacle result;
    result.name = "box";
    result.turns = turns;
    result.low = std::move(low);
    result.high = std::move(high);
    return result;
}

TEST(LineOfSight, NothingStatedHindersNothing) {
    const RotaryTableMeasurement measurement = table();
    EXPECT_FALSE(SightRules{}.any());
    const LineOfSight sight(measurement, {});
    for (const bool seen : seen_distances(measurement, sight)) {
        EXPECT_TRUE(seen);
    }
}

TEST(LineOfSight, ATableHidesWhatIsBehindIt) {
    const RotaryTableMeasurement measurement = table();
    SightRules rules;
    rules.obstacles = {cylinder(0.25, -0.4, 0.0)};
    const LineOfSight sight(measurement, rules);
    const Eigen::Vector3d above(1.0, 0.2, 0.8);
    const Eigen::Vector3d below(1.0, 0.2, -0.8);
    for (std::size_t angle = 0; angle < 4; ++angle) {
        EXPECT_FALSE(sight.hindrance(above, angle, 0)) << "a reflector on the face is seen from above";
        const auto hidden = sight.hindrance(below, angle, 0);
        ASSERT_TRUE(hidden) << "and not from below";
        EXPECT_EQ(hidden->kind, Kind::obstacle);
        EXPECT_EQ(hidden->which, 0U);
    }
    // Beside the rim: before the table at one angle, behind it at the opposite one.
    const Eigen::Vector3d beside(0.1, 1.0, -0.05);
    EXPECT_FALSE(sight.hindrance(beside, 0, 1));
    EXPECT_TRUE(sight.hindrance(beside, 2, 1));
}

TEST(LineOfSight, ABoxTurnsWithTheTableOrStands) {
    const RotaryTableMeasurement measurement = table();
    const Eigen::Vector3d station(1.0, 0.0, 0.1);
    const Eigen::Vector3d low(0.45, -0.1, -0.1);
    const Eigen::Vector3d high(0.55, 0.1, 0.3);
    const LineOfSight standing(measurement, {{box(low, high, false)}, 0.0, {}, {}});
    const LineOfSight turning(measurement, {{box(low, high, true)}, 0.0, {}, {}});
    for (std::size_t angle = 0; angle < 4; ++angle) {
        EXPECT_TRUE(standing.hindrance(station, angle, 0)) << angle;
        EXPECT_EQ(turning.hindrance(station, angle, 0).has_value(), angle == 0) << angle;
    }
    // A beam along a face touches it and passes.
    const LineOfSight touching(measurement, {{box({0.45, 0.0, -0.1}, high, false)}, 0.0, {}, {}});
    EXPECT_FALSE(touching.hindrance({1.0, 0.0, 0.0}, 0, 0));
}

TEST(LineOfSight, OneReflectorHidesAnother) {
    RotaryTableMeasurement measurement = table();
    measurement.fixture.row(1) = Eigen::RowVector3d(0.4, 0.0, 0.0);
    SightRules rules;
    rules.reflector_diameter = 0.04;
    const LineOfSight sight(measurement, rules);
    const auto hidden = sight.hindrance({1.0, 0.02, 0.0}, 0, 0);
    ASSERT_TRUE(hidden);
    EXPECT_EQ(hidden->kind, Kind::reflector);
    EXPECT_EQ(hidden->which, 1U);
    EXPECT_FALSE(sight.hindrance({1.0, 0.02, 0.0}, 0, 1)) << "the one before is seen";
    EXPECT_FALSE(sight.hindrance({1.0, 0.0, 0.1}, 0, 0)) << "it passes 25 mm above the centre";
    EXPECT_TRUE(sight.hindrance({1.0, 0.0, 0.05}, 0, 0)) << "it passes 12.5 mm above the centre";
}

TEST(LineOfSight, AReflectorAcceptsBeamsWithinItsAngle) {
    const RotaryTableMeasurement measurement = table();
    SightRules rules;
    rules.acceptance_angle = 30.0 * std::numbers::pi / 180.0;
    rules.facing = {Eigen::Vector3d::UnitX(), std::nullopt, Eigen::Vector3d::UnitZ()};
    const LineOfSight sight(measurement, rules);
    const auto from = [](double degrees) {  // about the reflector on the face
        const double angle = degrees * std::numbers::pi / 180.0;
        return Eigen::Vector3d(0.2 + std::cos(angle), std::sin(angle), 0.0);
    };
    EXPECT_FALSE(sight.hindrance(from(29.9), 0, 0));
    const auto away = sight.hindrance(from(30.1), 0, 0);
    ASSERT_TRUE(away);
    EXPECT_EQ(away->kind, Kind::acceptance);
    EXPECT_TRUE(sight.hindrance({1.2, 0.0, 0.0}, 2, 0)) << "it looks away after half a turn";
    EXPECT_FALSE(sight.hindrance({-1.2, 0.0, 0.0}, 2, 0));
    EXPECT_FALSE(sight.hindrance({-5.0, 3.0, -2.0}, 1, 1)) << "of which no direction is stated";
    EXPECT_FALSE(sight.hindrance({0.2, 0.1, 1.0}, 3, 2));
}

TEST(LineOfSight, AReflectorInsideAnObstacleIsNamed) {
    const RotaryTableMeasurement measurement = table();
    const auto inside = LineOfSight(measurement, {{cylinder(0.35, -0.4, -0.04)}, 0.0, {}, {}}).inside();
    ASSERT_TRUE(inside);
    EXPECT_EQ(inside->reflector, 1U);
    // A standing box that the second reflector only enters at 90°.
    const LineOfSight standing(measurement, {{box({-0.4, -0.1, -0.1}, {-0.28, 0.1, 0.1}, false)}, 0.0, {}, {}});
    ASSERT_TRUE(standing.inside());
    EXPECT_EQ(standing.inside()->reflector, 1U);
    EXPECT_EQ(standing.inside()->angle, 1U);
    EXPECT_FALSE(LineOfSight(measurement, {{cylinder(0.25, -0.4, 0.0)}, 0.0, {}, {}}).inside());
}

TEST(LineOfSight, APlanLeavesOutWhatIsNotSeen) {
    const RotaryTableMeasurement measurement = table();
    SightRules rules;
    rules.obstacles = {cylinder(0.25, -0.4, 0.0)};
    const std::vector<bool> seen = seen_distances(measurement, LineOfSight(measurement, rules));
    const RotaryTableMeasurement left = with_distances(measurement, seen);
    EXPECT_LT(left.lengths.size(), measurement.lengths.size());
    EXPECT_GT(left.lengths.size(), measurement.lengths.size() / 4);
    for (const LengthObservation& length : left.lengths) {
        EXPECT_FALSE(LineOfSight(measurement, rules)
                         .hindrance(*left.station_start[length.station], length.angle, length.reflector));
    }
}

}  // namespace
}  // namespace gumcert::engine
