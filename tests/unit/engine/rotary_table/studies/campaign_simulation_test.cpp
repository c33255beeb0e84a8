#include "engine/rotary_table/studies/campaign_simulation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
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
    RotaryTableMeasurement layout = campaign.measurement;
    layout.table_repeatability.axial_position.reset();  // given of the error motions, at their origin
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

}  // namespace
}  // namespace gumcert::engine
