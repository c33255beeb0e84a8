#include "engine/rotary_table/studies/campaign_layout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::CampaignPlan;

RotaryTableMeasurement bare_layout() {
    RotaryTableMeasurement measurement = synthetic::simulate(CampaignPlan{}).measurement;
    const CampaignPlan plan;
    for (std::size_t j = 0; j < plan.stations.size(); ++j) {
        measurement.station_start[j] = plan.stations[j];
    }
    measurement.lengths.clear();
    measurement.passes.clear();
    measurement.dead_paths.clear();
    measurement.angles_deg = {10.0, 130.0, 250.0};
    measurement.angles.clear();
    for (const double angle : measurement.angles_deg) {
        measurement.angles.push_back(angle * std::numbers::pi / 180.0);
    }
    measurement.home = 0;
    return measurement;
}

TEST(LayOut, PlansEveryDistance) {
    RotaryTableMeasurement measurement = bare_layout();
    lay_out(measurement, false, false);
    EXPECT_EQ(measurement.lengths.size(), 6U * 3U * 6U);
    EXPECT_EQ(measurement.passes.front(), "P1-1");
    EXPECT_EQ(measurement.passes.size(), 6U);
    EXPECT_EQ(measurement.dead_paths, measurement.stations);
    // At home a length is the distance from the station to the reflector as the CMM measured it.
    const LengthObservation& first = measurement.lengths.front();
    EXPECT_EQ(first.angle, measurement.home);
    EXPECT_NEAR(first.length, (measurement.fixture.row(0).transpose() - *measurement.station_start[0]).norm(), 1e-15);
    // 120° about x: y' = -y/2 - √3/2 z.
    const Eigen::Vector3d p = measurement.fixture.row(1).transpose();
    const double c = -0.5;
    const double s = std::sqrt(0.75);
    const Eigen::Vector3d turned(p[0], c * p[1] - s * p[2], s * p[1] + c * p[2]);
    EXPECT_NEAR(measurement.lengths[7].length, (turned - *measurement.station_start[0]).norm(), 1e-15);
    EXPECT_EQ(measurement.lengths[7].reflector, 1U);

    lay_out(measurement, true, true);
    EXPECT_EQ(measurement.lengths.size(), 2U * 6U * 3U * 6U);
    EXPECT_EQ(measurement.passes[1], "P1-2");
    EXPECT_EQ(measurement.dead_paths.size(), 36U);
    EXPECT_EQ(measurement.dead_paths[7], "P2-R2");
    const auto down = std::find_if(measurement.lengths.begin(), measurement.lengths.end(),
                                   [](const LengthObservation& l) { return l.approach == Approach::negative; });
    EXPECT_EQ(down->angle, 2U);  // downwards the last angle comes first
    EXPECT_EQ(measurement.passes[down->pass], "P1-2");
}

TEST(LayOut, RefusesWhatItCannotPlan) {
    const auto code_of = [](RotaryTableMeasurement measurement) -> std::string {
        try {
            lay_out(measurement, false, false);
        } catch (const gum::InputError& error) {
            return error.diagnostics().front().code;
        }
        return "";
    };
    RotaryTableMeasurement measurement = bare_layout();
    measurement.station_start[2].reset();
    EXPECT_EQ(code_of(measurement), "GC-LAYOUT-0001");
    measurement = bare_layout();
    measurement.angles.clear();
    EXPECT_EQ(code_of(measurement), "GC-LAYOUT-0002");
    measurement = bare_layout();
    measurement.station_start[0] = measurement.fixture.row(0).transpose();
    EXPECT_EQ(code_of(measurement), "GC-LAYOUT-0003");
}

TEST(WithFullTurn, KeepsPassesReflectorsAndFirstDeadPaths) {
    RotaryTableMeasurement measurement = bare_layout();
    lay_out(measurement, true, false);
    // Lost distances and a dead path that began in mid-turn.
    measurement.dead_paths.push_back("P1 locked again");
    for (LengthObservation& length : measurement.lengths) {
        if (length.station == 0 && length.angle == 2) {
            length.dead_path = measurement.dead_paths.size() - 1;
        }
    }
    std::erase_if(measurement.lengths,
                  [](const LengthObservation& l) { return l.angle == 1 && l.reflector == 3 && l.station == 1; });
    const RotaryTableMeasurement turn = with_full_turn(measurement, 5);
    EXPECT_EQ(turn.angles.size(), 5U);
    EXPECT_EQ(turn.home, 0U);
    EXPECT_NEAR(turn.angles_deg[4], 10.0 + 288.0, 1e-12);
    EXPECT_NEAR(turn.angles[4], turn.angles_deg[4] * std::numbers::pi / 180.0, 1e-15);
    EXPECT_EQ(turn.lengths.size(), 2U * 6U * 5U * 6U);
    EXPECT_EQ(turn.passes, measurement.passes);
    // Every dead path that is left has distances: downwards P1 began with the new one.
    std::set<std::size_t> used;
    for (const LengthObservation& length : turn.lengths) {
        used.insert(length.dead_path);
        EXPECT_GT(length.length, 0.1);
    }
    EXPECT_EQ(used.size(), turn.dead_paths.size());
    EXPECT_EQ(turn.dead_paths.size(), 7U);
}

// The first angle measured again at the end of a run was a run of its own: twice the distances.
TEST(WithFullTurn, KeepsAPassThatClosesARunOneVisit) {
    RotaryTableMeasurement measurement = bare_layout();
    lay_out(measurement, false, false);
    const std::size_t of_runs = measurement.lengths.size();
    for (const std::size_t angle : {0U, 2U}) {  // home, and 240 degrees from it
        measurement.passes.push_back("P1 again " + std::to_string(angle));
        for (std::size_t i = 0; i < of_runs; ++i) {
            LengthObservation length = measurement.lengths[i];
            if (length.station == 0 && length.angle == angle) {
                length.pass = measurement.passes.size() - 1;
                measurement.lengths.push_back(length);
            }
        }
    }
    const RotaryTableMeasurement turn = with_full_turn(measurement, 12);
    EXPECT_EQ(turn.lengths.size(), 12U * 6U * 6U + 2U * 6U);
    for (const LengthObservation& length : turn.lengths) {
        if (length.pass >= 6) {
            EXPECT_EQ(length.angle, length.pass == 6 ? 0U : 8U);
        }
    }
    // Where a station has no run at all, every pass is one.
    std::erase_if(measurement.lengths, [](const LengthObservation& l) { return l.station == 0 && l.pass < 6; });
    EXPECT_EQ(with_full_turn(measurement, 12).lengths.size(), 12U * 7U * 6U);
}

TEST(IdealDistance, StretchesTheFixtureBeforeItTurns) {
    RotaryTableMeasurement measurement = bare_layout();
    measurement.expansion = 1e-3;
    measurement.temperature_difference = Eigen::VectorXd::Constant(6, 5.0);
    const Eigen::Matrix3d rotation = synthetic::turn(1, 0.7);
    const Eigen::Vector3d point = 1.005 * (rotation * measurement.fixture.row(2).transpose());
    EXPECT_NEAR(ideal_distance(measurement, rotation, 4, 2), (point - *measurement.station_start[4]).norm(), 1e-15);
}

}  // namespace
}  // namespace gumcert::engine
