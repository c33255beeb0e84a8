#include "engine/campaign_simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "engine/campaign_layout.h"
#include "engine/rotary_table_evaluation.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::CampaignPlan;

/// The truth of a campaign of the test simulator as the engine's simulator wants it.
CampaignTruth truth_of(const synthetic::Campaign& campaign, const CampaignPlan& plan) {
    CampaignTruth truth;
    truth.errors = campaign.truth.errors;
    truth.set_up = campaign.truth.set_up;
    truth.reversal = campaign.truth.reversal;
    truth.stations = campaign.truth.stations;
    truth.scale_deviation = campaign.truth.scale_deviation;
    truth.dead_paths = campaign.truth.dead_paths;
    truth.fixture = campaign.truth.fixture;
    truth.temperature_difference = campaign.measurement.temperature_difference;
    truth.expansion = plan.expansion;
    return truth;
}

/// Exact data with everything that the model knows: scale, temperature, reversal, missing distances.
CampaignPlan full_plan(RotaryAxis axis) {
    CampaignPlan plan;
    plan.axis = axis;
    plan.angles_deg = synthetic::full_turn(8);
    plan.home = 2;
    plan.both_senses = true;
    plan.reversal << 4e-7, -3e-7, 2e-7, 6e-6, 1e-6, -1.5e-6;
    plan.temperature_difference = 1.5;
    plan.expansion = 11.5e-6;
    plan.missing_share = 0.1;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.noise = 0.0;
    return plan;
}

class SimulatedLengths : public testing::TestWithParam<RotaryAxis> {};

// The simulator of the tests has its own kinematics (Eigen's rotations, point by point).
TEST_P(SimulatedLengths, AgreeWithAnIndependentKinematics) {
    const CampaignPlan plan = full_plan(GetParam());
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    CampaignTruth truth = truth_of(campaign, plan);
    const RotaryTableMeasurement simulated = simulate_campaign(campaign.measurement, truth, {});
    ASSERT_EQ(simulated.lengths.size(), campaign.measurement.lengths.size());
    for (std::size_t i = 0; i < simulated.lengths.size(); ++i) {
        EXPECT_NEAR(simulated.lengths[i].length, campaign.measurement.lengths[i].length, 4e-15) << i;
    }
    // A scale acts on the geometric distance, not on the dead path.
    truth.scale_deviation.setConstant(1e-3);
    const RotaryTableMeasurement scaled = simulate_campaign(campaign.measurement, truth, {});
    const LengthObservation& one = simulated.lengths.front();
    const double distance = one.length + truth.dead_paths[static_cast<Eigen::Index>(one.dead_path)];
    EXPECT_NEAR(scaled.lengths.front().length - one.length, 1e-3 * distance, 1e-15);
}

TEST_P(SimulatedLengths, FollowTheTableTheNoiseAndTheOutliers) {
    const CampaignPlan plan = full_plan(GetParam());
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    const RotaryTableMeasurement& layout = campaign.measurement;
    const CampaignTruth truth = truth_of(campaign, plan);
    const std::vector<Visit> visits = visits_of(layout, std::vector<bool>(layout.lengths.size(), true));
    CampaignNoise noise;
    noise.table = Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(visits.size()));
    noise.table.col(3) << 1e-6, -2e-6, 3e-6, 4e-6, -5e-6, 6e-6;
    noise.lengths = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(layout.lengths.size()));
    noise.lengths[7] = 2e-7;
    noise.outliers = {{11, -3e-6}};
    const RotaryTableMeasurement still = simulate_campaign(layout, truth, {});
    const RotaryTableMeasurement moved = simulate_campaign(layout, truth, noise);
    const std::set<std::size_t> of_visit(visits[3].observations.begin(), visits[3].observations.end());
    // The visit whose table deviates is the one that the same deviation of its pose gives.
    CampaignTruth turned = truth;
    turned.errors.col(static_cast<Eigen::Index>(visits[3].angle)) += noise.table.col(3);
    const RotaryTableMeasurement as_pose = simulate_campaign(layout, turned, {});
    for (std::size_t i = 0; i < layout.lengths.size(); ++i) {
        const double expected = (of_visit.contains(i) ? as_pose : still).lengths[i].length + (i == 7 ? 2e-7 : 0.0) +
                                (i == 11 ? -3e-6 : 0.0);
        EXPECT_DOUBLE_EQ(moved.lengths[i].length, expected) << i;
    }
}

// Exact lengths: the adjustment gives back the truth in its datum, whatever the truth was assumed to be.
TEST_P(SimulatedLengths, AreSolvedToTheTruthInTheDatum) {
    CampaignPlan plan = full_plan(GetParam());
    plan.missing_share = 0.0;
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    CampaignTruth truth = truth_of(campaign, plan);
    // Constants and parts that turn with the table, which no datum leaves where they are.
    truth.errors.colwise() += Eigen::Matrix<double, 6, 1>(3e-6, -2e-6, 1e-6, 5e-6, -4e-6, 2e-6);
    RotaryTableMeasurement measurement = simulate_campaign(campaign.measurement, truth, {});
    for (const Datum datum : {Datum::axis_average_line, Datum::home}) {
        measurement.datum = datum;
        const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
        const Eigen::VectorXd expected = truth_in_datum(measurement, truth, datum, solution.quantities.has_reversal);
        ASSERT_EQ(solution.values.size(), expected.size());
        for (Eigen::Index i = 0; i < expected.size(); ++i) {
            // The reversal is second order in a change of datum: it is the truth's in the assumed frame.
            const double tolerance = i < solution.quantities.reversal ? 2e-11 : 1e-9;
            EXPECT_NEAR(solution.values[i], expected[i], tolerance) << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Axes, SimulatedLengths, testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                         [](const auto& axis) { return std::string(1, "ABC"[axial_coordinate(axis.param)]); });

TEST(SeenInDatum, IsTheEvaluationInThatDatum) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(10);
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    RotaryTableMeasurement measurement = campaign.measurement;
    const RotaryTableSolution average = evaluate_jointly(measurement, EvaluationOptions{});
    measurement.datum = Datum::home;
    const RotaryTableSolution home = evaluate_jointly(measurement, EvaluationOptions{});
    const DatumView seen = seen_in_datum(measurement, average.values, average.covariance.dense(), Datum::home);
    for (Eigen::Index i = 0; i < seen.values.size(); ++i) {
        const double u = std::sqrt(home.covariance(i, i));
        EXPECT_NEAR(seen.values[i], home.values[i], 1e-3 * u + 1e-16) << i;
        EXPECT_NEAR(std::sqrt(seen.covariance(i, i)), u, 1e-3 * u) << i;
    }
    // And back again.
    const DatumView back = seen_in_datum(measurement, seen.values, seen.covariance, Datum::axis_average_line);
    for (Eigen::Index i = 0; i < back.values.size(); ++i) {
        const double u = std::sqrt(average.covariance(i, i));
        EXPECT_NEAR(back.values[i], average.values[i], 1e-3 * u) << i;
        EXPECT_NEAR(std::sqrt(back.covariance(i, i)), u, 1e-3 * u) << i;
    }
}

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

}  // namespace
}  // namespace gumcert::engine
