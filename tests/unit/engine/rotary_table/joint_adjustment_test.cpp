// The joint adjustment gives back what was simulated, with the uncertainty that the simulation shows.
#include <gtest/gtest.h>

#include <Eigen/LU>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/evaluation/sequential_evaluation.h"
#include "gum/quantity/diagnostic.h"
#include "gum/quantity/units.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;
using synthetic::k_um;
using synthetic::rms_over_angles;
using synthetic::Vector6;

RotaryTableSolution evaluate(const Campaign& campaign) {
    return evaluate_jointly(campaign.measurement, EvaluationOptions{});
}

/// Reported quantities, stations, dead paths and fixture of exact data.
void expect_truth(const Campaign& campaign, const RotaryTableSolution& solution) {
    const Eigen::VectorXd truth = campaign.true_values(solution.quantities.has_reversal);
    ASSERT_EQ(solution.values.size(), truth.size());
    for (Eigen::Index i = 0; i < truth.size(); ++i) {
        const auto& output = solution.quantities.outputs[static_cast<std::size_t>(i)];
        EXPECT_NEAR(solution.values[i], truth[i], output.unit == "m" ? 1e-10 : 1e-9) << output.name;
    }
    for (std::size_t j = 0; j < campaign.truth.stations.size(); ++j) {
        EXPECT_LT((solution.stations[j].position - campaign.truth.stations[j]).norm(), 1e-8)
            << campaign.measurement.stations[j];
    }
    EXPECT_LT((solution.dead_paths - campaign.truth.dead_paths).cwiseAbs().maxCoeff(), 1e-8);
    EXPECT_LT((solution.fixture - campaign.truth.fixture).cwiseAbs().maxCoeff(), 1e-10);
    EXPECT_LT(solution.chi_square, 1e-4);
}

class ExactData : public testing::TestWithParam<std::tuple<RotaryAxis, Datum>> {};

TEST_P(ExactData, GiveTheTruthBackWithoutStartValues) {
    CampaignPlan plan;
    plan.axis = std::get<0>(GetParam());
    plan.datum = std::get<1>(GetParam());
    plan.noise = 0.0;
    const Campaign campaign = simulate(plan);
    expect_truth(campaign, evaluate(campaign));
}

TEST_P(ExactData, GiveTheTruthBackWithReversalTemperatureAndPairedDeadPaths) {
    CampaignPlan plan;
    plan.axis = std::get<0>(GetParam());
    plan.datum = std::get<1>(GetParam());
    plan.angles_deg = synthetic::full_turn(12);
    plan.home = 4;
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.05;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 0.5e-6;
    plan.missing_share = 0.1;
    plan.noise = 0.0;
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate(campaign);
    ASSERT_TRUE(solution.quantities.has_reversal);
    expect_truth(campaign, solution);
}

INSTANTIATE_TEST_SUITE_P(AxesAndData, ExactData,
                         testing::Combine(testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                                          testing::Values(Datum::axis_average_line, Datum::home)),
                         [](const auto& tested) {
                             return std::string(1, "ABC"[axial_coordinate(std::get<0>(tested.param))]) +
                                    (std::get<1>(tested.param) == Datum::home ? "Home" : "AxisAverageLine");
                         });

TEST(JointAdjustment, PartialTurnGivesTheTruthBack) {
    for (const Datum datum : {Datum::axis_average_line, Datum::home}) {
        CampaignPlan plan;
        plan.datum = datum;
        plan.angles_deg = synthetic::partial_turn(90.0, 10);
        plan.noise = 0.0;
        const Campaign campaign = simulate(plan);
        expect_truth(campaign, evaluate(campaign));
    }
}

TEST(JointAdjustment, CoarseSetUpIsExactNotLinear) {
    // 1 mm and 600″: the second-order remainder of the linear rows would be 10.6 µm (rotary-table.md, 1).
    for (const Datum datum : {Datum::axis_average_line, Datum::home}) {
        CampaignPlan plan;
        plan.datum = datum;
        plan.offset = {1e-3, -1e-3};
        plan.tilt = {600.0 * synthetic::k_arcsec, -600.0 * synthetic::k_arcsec};
        plan.noise = 0.0;
        const Campaign campaign = simulate(plan);
        expect_truth(campaign, evaluate(campaign));
    }
}

// A fixture that stands centimetres and degrees off the axis has error motions as large about the one that is held.
TEST(JointAdjustment, BeginsAtTheAxisOfItsStartValues) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        CampaignPlan plan;
        plan.axis = axis;
        plan.angles_deg = synthetic::full_turn(8);
        plan.home = 3;
        plan.offset = {20e-3, -15e-3};
        plan.tilt = {0.05, -0.03};
        plan.noise = 0.0;
        plan.error_factor = 0.0;
        const Campaign campaign = simulate(plan);
        const RigidMotion set_up = rigid_motion(campaign.truth.set_up);
        Vector6 other;
        other << 1e-3, -2e-3, 3e-3, 0.01, -0.02, 0.03;
        for (const RigidMotion& held : {RigidMotion{}, set_up, rigid_motion(other)}) {
            StartValues start{campaign.truth.stations, campaign.truth.dead_paths, set_up};
            for (Eigen::Vector3d& station : start.stations) {
                station = held * (set_up.inverse() * station);
            }
            JointAdjustment adjustment(campaign.measurement,
                                       std::vector<bool>(campaign.measurement.lengths.size(), true), held, start,
                                       StochasticModel{});
            adjustment.turn_about(set_up);
            EXPECT_LT(adjustment.adjustment().linearise().chi_square(), 1e-6);
        }
    }
}

TEST(JointAdjustment, GivenStartValuesLeadToTheSameSolution) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    const Campaign found = simulate(plan);
    Campaign given = found;
    for (std::size_t j = 0; j < given.truth.stations.size(); ++j) {
        given.measurement.station_start[j] =
            given.truth.stations[j] + Eigen::Vector3d(0.05, -0.05, 0.05);  // a tape measure would do better
    }
    const RotaryTableSolution a = evaluate(found);
    const RotaryTableSolution b = evaluate(given);
    const Eigen::VectorXd u = a.covariance.diagonal().cwiseSqrt();
    EXPECT_LT(((a.values - b.values).array() / u.array()).abs().maxCoeff(), 1e-5);
}

/// Exact data with the weights of the note, 4d: u does not depend on the noise, so one solution tells it.
RotaryTableSolution note_case(Datum datum) {
    CampaignPlan plan;
    plan.datum = datum;
    plan.noise = 0.0;
    return evaluate(simulate(plan));
}

TEST(JointAdjustment, StandardUncertaintiesOfThePerfectTableAreThoseOfTheNote) {
    // rotary-table.md, 4d, table and sensitivity line: tracer 0.1 µm + 0.15 µm/m, CMM by the paper's eq. (11). The note
    // adds the two parts of the tracer linearly; ours, in squares, agrees with it within 3 % over 0.6 … 1.5 m.
    const RotaryTableSolution home = note_case(Datum::home);
    const RotaryTableSolution average = note_case(Datum::axis_average_line);
    const Vector6 u_home = rms_over_angles(home.covariance.diagonal().cwiseSqrt(), 36);
    const Vector6 u_average = rms_over_angles(average.covariance.diagonal().cwiseSqrt(), 36);
    Vector6 note_home, note_average, note_ratio;
    note_home << 0.084, 0.128, 0.144, 1.10, 0.81, 0.74;
    note_average << 0.058, 0.103, 0.120, 0.77, 0.65, 0.60;
    note_ratio << 1.42, 1.26, 1.23, 1.43, 1.23, 1.26;
    for (int c = 0; c < 6; ++c) {
        EXPECT_NEAR(u_home[c] / (1e-6 * note_home[c]), 1.0, 0.05) << "component " << c << ", home";
        EXPECT_NEAR(u_average[c] / (1e-6 * note_average[c]), 1.0, 0.05) << "component " << c << ", average line";
        EXPECT_NEAR(u_home[c] / u_average[c] / note_ratio[c], 1.0, 0.03) << "component " << c << ", ratio";
    }
    // Set-up (home): O_y 0.26, O_z 0.24 µm, S_y 1.7, S_z 1.8 µrad, from 200 simulations (5 %).
    const Eigen::Vector4d u_set_up = home.covariance.diagonal().segment<4>(home.quantities.set_up).cwiseSqrt();
    EXPECT_NEAR(u_set_up[0], 0.26e-6, 0.03e-6);
    EXPECT_NEAR(u_set_up[1], 0.24e-6, 0.03e-6);
    EXPECT_NEAR(u_set_up[2], 1.7e-6, 0.2e-6);
    EXPECT_NEAR(u_set_up[3], 1.8e-6, 0.2e-6);
    // Exactly zero at home, and no other pose without uncertainty.
    EXPECT_LT(home.covariance.diagonal().head<6>().cwiseAbs().maxCoeff(), 1e-30);
    EXPECT_GT(home.covariance.diagonal().segment(6, 6 * 35).minCoeff(), 1e-16);
    // Stations: 12 µm rms of the length of the vector.
    double squares = 0.0;
    for (const StationEstimate& station : home.stations) {
        squares += station.u.squaredNorm();
    }
    EXPECT_NEAR(std::sqrt(squares / 6.0), 12e-6, 1.5e-6);
    // Counts of the note: 252 unknowns, 1314 observations, 1062 degrees of freedom; condition number about 2.9e3.
    EXPECT_EQ(home.parameters, 252);
    EXPECT_EQ(home.observations, 1314);
    EXPECT_EQ(home.degrees_of_freedom, 1062);
    EXPECT_NEAR(home.condition_number, 2.91e3, 0.3e3);
}

TEST(JointAdjustment, PosesAtTwoAnglesAreCorrelatedThroughHome) {
    // The noise of the home pose enters every other pose: 0.45 … 0.50 (rotary-table.md, 4c).
    CampaignPlan plan;
    plan.noise = 0.0;
    const Campaign campaign = simulate(plan);
    const JointAdjustment adjustment(campaign.measurement, std::vector<bool>(campaign.measurement.lengths.size(), true),
                                     RigidMotion{}, StartValues{campaign.truth.stations, campaign.truth.dead_paths},
                                     StochasticModel{});
    const NormalEquations normal = adjustment.adjustment().linearise();
    EXPECT_EQ(normal.first_column(adjustment.pose_block(campaign.measurement.home)), -1);
    EXPECT_EQ(normal.first_column(adjustment.pose_block(1)), normal.column(adjustment.pose_block(1), 0));
    const Eigen::MatrixXd covariance = normal.covariance();
    for (int c = 0; c < 6; ++c) {
        double sum = 0.0;
        double count = 0.0;
        for (std::size_t i = 1; i < 36; ++i) {
            for (std::size_t k = 1; k < i; ++k) {
                const Eigen::Index a = normal.column(adjustment.pose_block(i), c);
                const Eigen::Index b = normal.column(adjustment.pose_block(k), c);
                sum += covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
                count += 1.0;
            }
        }
        EXPECT_GT(sum / count, 0.43) << "component " << c;
        EXPECT_LT(sum / count, 0.52) << "component " << c;
    }
}

TEST(JointAdjustment, ScaleModelLeavesTheErrorCurvesUnchanged) {
    // rotary-table.md, 4c: results in E do not change between scale fixed, prior 0.1 ppm and free.
    CampaignPlan plan;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1e-7;
    Campaign campaign = simulate(plan);
    const RotaryTableSolution prior = evaluate(campaign);
    campaign.measurement.length_uncertainty.scale_model = ScaleModel::fixed;
    const RotaryTableSolution fixed = evaluate(campaign);
    campaign.measurement.length_uncertainty.scale_model = ScaleModel::free;
    const RotaryTableSolution free = evaluate(campaign);
    const Eigen::Index errors = prior.quantities.set_up;
    const Eigen::VectorXd u = prior.covariance.diagonal().head(errors).cwiseSqrt();
    EXPECT_LT(((fixed.values - prior.values).head(errors).array() / u.array()).abs().maxCoeff(), 0.1);
    EXPECT_LT(((free.values - prior.values).head(errors).array() / u.array()).abs().maxCoeff(), 0.2);
    const auto ratio = [&](const RotaryTableSolution& other) {
        return (other.covariance.diagonal().head(errors).cwiseSqrt().array() / u.array() - 1.0).abs().maxCoeff();
    };
    EXPECT_LT(ratio(fixed), 0.01);
    EXPECT_LT(ratio(free), 0.03);
    // The scale itself: held, known to the prior, and 1.3 … 1.6 ppm from the CMM fixture.
    for (std::size_t j = 0; j < 6; ++j) {
        EXPECT_EQ(fixed.stations[j].u_scale, 0.0);
        EXPECT_LT(prior.stations[j].u_scale, 1e-7);
        EXPECT_GT(prior.stations[j].u_scale, 0.9e-7);
        EXPECT_GT(free.stations[j].u_scale, 1.1e-6);
        EXPECT_LT(free.stations[j].u_scale, 1.8e-6);
    }
}

TEST(JointAdjustment, DeadPathPerPairCostsLittleOnAFullTurn) {
    // rotary-table.md, 4c: e_a 0.789 against 0.768 µrad, the rest unchanged; a 90° range makes e_a 1.7 times worse.
    const auto u_axial = [](synthetic::DeadPaths paths, std::vector<double> angles) {
        CampaignPlan plan;
        plan.noise = 0.0;
        plan.dead_paths = paths;
        plan.start_values = true;
        plan.angles_deg = std::move(angles);
        const RotaryTableSolution solution = evaluate(simulate(plan));
        return rms_over_angles(solution.covariance.diagonal().cwiseSqrt(),
                               static_cast<Eigen::Index>(plan.angles_deg.size()))[3];
    };
    using synthetic::DeadPaths;
    const double full = u_axial(DeadPaths::per_station_and_reflector, synthetic::full_turn(36)) /
                        u_axial(DeadPaths::per_station, synthetic::full_turn(36));
    EXPECT_NEAR(full, 0.789 / 0.768, 0.02);
    const double quarter = u_axial(DeadPaths::per_station_and_reflector, synthetic::partial_turn(90.0, 12)) /
                           u_axial(DeadPaths::per_station, synthetic::partial_turn(90.0, 12));
    EXPECT_NEAR(quarter, 1.7, 0.2);
}

/// Root mean square of (estimate - truth)/u over some campaigns, by component.
struct Honesty {
    Vector6 rms = Vector6::Zero();
    double overall = 0.0;
    double chi_square_per_degree = 0.0;
};

Honesty honesty(CampaignPlan plan, RepeatabilityMode mode, int campaigns) {
    Honesty result;
    Vector6 squares = Vector6::Zero();
    const auto angles = static_cast<Eigen::Index>(plan.angles_deg.size());
    for (int k = 0; k < campaigns; ++k) {
        plan.seed = 100 + static_cast<std::uint64_t>(k);
        Campaign campaign = simulate(plan);
        campaign.measurement.table_repeatability.mode = mode;
        const RotaryTableSolution solution = evaluate(campaign);
        const Eigen::VectorXd difference = solution.values - campaign.true_values(solution.quantities.has_reversal);
        const Eigen::VectorXd normalised =
            difference.head(6 * angles).array() / solution.covariance.diagonal().head(6 * angles).array().sqrt();
        squares += normalised.reshaped(6, angles).rowwise().squaredNorm() / static_cast<double>(angles);
        result.chi_square_per_degree +=
            solution.chi_square / static_cast<double>(solution.degrees_of_freedom) / campaigns;
    }
    result.rms = (squares / campaigns).cwiseSqrt();
    result.overall = std::sqrt(squares.sum() / 6.0 / campaigns);
    return result;
}

TEST(JointAdjustment, StatedUncertaintyOfAPerfectTableIsHonest) {
    const Honesty perfect = honesty(CampaignPlan{}, RepeatabilityMode::none, 12);
    EXPECT_GT(perfect.overall, 0.95);
    EXPECT_LT(perfect.overall, 1.05);
    EXPECT_GT(perfect.rms.minCoeff(), 0.85);
    EXPECT_LT(perfect.rms.maxCoeff(), 1.15);
    EXPECT_NEAR(perfect.chi_square_per_degree, 1.0, 0.05);
}

/// What is estimated acts where the reflectors are, what is given where the error motions are, both where it is stated.
TEST(JointAdjustment, RepeatabilityActsAtAPoint) {
    CampaignPlan plan;
    RotaryTableMeasurement measurement = simulate(plan).measurement;
    const int axial = axial_coordinate(measurement.axis);
    const double centroid = measurement.fixture.col(axial).mean();
    const auto acts_at = [&](RepeatabilityMode mode, std::optional<double> position) {
        measurement.table_repeatability.mode = mode;
        measurement.table_repeatability.axial_position = position;
        const Eigen::Vector3d point = repeatability_point(measurement, RigidMotion{});
        EXPECT_EQ(point[(axial + 1) % 3], 0.0);
        EXPECT_EQ(point[(axial + 2) % 3], 0.0);
        return point[axial];
    };
    EXPECT_DOUBLE_EQ(acts_at(RepeatabilityMode::estimate, std::nullopt), centroid);
    EXPECT_DOUBLE_EQ(acts_at(RepeatabilityMode::given, std::nullopt), 0.0);
    EXPECT_DOUBLE_EQ(acts_at(RepeatabilityMode::estimate, -0.4), -0.4);
    EXPECT_DOUBLE_EQ(acts_at(RepeatabilityMode::given, -0.4), -0.4);
}

TEST(JointAdjustment, RepeatabilityIgnoredIsUncertaintyUnderstated) {
    // rotary-table.md, D3, second row: 0.3 µm, 5 µrad, tilt 5/3 µrad.
    CampaignPlan plan;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 5e-6 / 3.0;
    plan.repeatability_off = -0.68 / 6.0;  // the note lets it act at the origin, and not at the centroid
    const Honesty ignored = honesty(plan, RepeatabilityMode::none, 12);
    Vector6 note;
    note << 3.5, 2.8, 2.9, 3.3, 2.2, 2.1;
    for (int c = 0; c < 6; ++c) {
        EXPECT_NEAR(ignored.rms[c] / note[c], 1.0, 0.15) << "component " << c;
    }
    EXPECT_GT(ignored.chi_square_per_degree, 2.0);

    plan.repeatability_off = 0.0;
    const Honesty given = honesty(plan, RepeatabilityMode::given, 12);
    EXPECT_GT(given.overall, 0.95);
    EXPECT_LT(given.overall, 1.05);
    EXPECT_GT(given.rms.minCoeff(), 0.9);
    EXPECT_LT(given.rms.maxCoeff(), 1.1);
    EXPECT_NEAR(given.chi_square_per_degree, 1.0, 0.05);
}

TEST(JointAdjustment, EverythingAtOnceIsHonest) {
    CampaignPlan plan;
    plan.axis = RotaryAxis::c;
    plan.datum = Datum::axis_average_line;
    plan.angles_deg = synthetic::full_turn(18);
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.2;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 1e-6;
    plan.missing_share = 0.05;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 5e-6 / 3.0;
    double squares = 0.0;
    double set_up = 0.0;
    double reversal = 0.0;
    double stations = 0.0;
    constexpr int k_campaigns = 12;
    for (int k = 0; k < k_campaigns; ++k) {
        plan.seed = 500 + static_cast<std::uint64_t>(k);
        const Campaign campaign = simulate(plan);
        const RotaryTableSolution solution = evaluate(campaign);
        const Eigen::VectorXd normalised =
            (solution.values - campaign.true_values(true)).array() / solution.covariance.diagonal().array().sqrt();
        squares += normalised.head(6 * 18).squaredNorm() / (6.0 * 18.0) / k_campaigns;
        set_up += normalised.segment<4>(6 * 18).squaredNorm() / 4.0 / k_campaigns;
        reversal += normalised.tail<6>().squaredNorm() / 6.0 / k_campaigns;
        for (std::size_t j = 0; j < 6; ++j) {
            const Eigen::Vector3d error = solution.stations[j].position - campaign.truth.stations[j];
            stations += (error.array() / solution.stations[j].u.array()).square().sum() / 18.0 / k_campaigns;
        }
    }
    EXPECT_NEAR(std::sqrt(squares), 1.0, 0.1);
    EXPECT_NEAR(std::sqrt(set_up), 1.0, 0.25);  // 48 values, correlated
    EXPECT_NEAR(std::sqrt(reversal), 1.0, 0.25);
    EXPECT_NEAR(std::sqrt(stations), 1.0, 0.2);
}

TEST(JointAdjustment, VisitsShareAPassAndAnAngle) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(5);
    plan.both_senses = true;
    plan.runs = 2;
    const Campaign campaign = simulate(plan);
    const RotaryTableMeasurement& measurement = campaign.measurement;
    const std::vector<Visit> visits = visits_of(measurement, std::vector<bool>(measurement.lengths.size(), true));
    EXPECT_EQ(visits.size(), 6U * 4U * 5U);
    for (const Visit& visit : visits) {
        EXPECT_EQ(visit.observations.size(), 6U);
        for (const std::size_t i : visit.observations) {
            EXPECT_EQ(measurement.lengths[i].pass, visit.pass);
            EXPECT_EQ(measurement.lengths[i].angle, visit.angle);
            EXPECT_EQ(measurement.lengths[i].station, visit.station);
            EXPECT_EQ(measurement.lengths[i].approach, visit.approach);
        }
    }
}

TEST(JointAdjustment, OrderOfTheLengthsChangesNothing) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    Campaign campaign = simulate(plan);
    const RotaryTableSolution forward = evaluate(campaign);
    std::reverse(campaign.measurement.lengths.begin(), campaign.measurement.lengths.end());
    const RotaryTableSolution backward = evaluate(campaign);
    const Eigen::VectorXd u = forward.covariance.diagonal().cwiseSqrt();
    EXPECT_LT(((forward.values - backward.values).array() / u.array()).abs().maxCoeff(), 1e-6);
    const Eigen::MatrixXd covariance = forward.covariance.dense();
    EXPECT_LT((covariance - backward.covariance.dense()).cwiseAbs().maxCoeff(),
              1e-8 * covariance.cwiseAbs().maxCoeff());
}

TEST(JointAdjustment, ScalingEveryUncertaintyScalesTheResult) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    const RotaryTableSolution one = evaluate(campaign);
    campaign.measurement.length_uncertainty.u_constant *= 2.0;
    campaign.measurement.length_uncertainty.u_proportional *= 2.0;
    campaign.measurement.fixture_covariance *= 4.0;
    const RotaryTableSolution two = evaluate(campaign);
    const Eigen::VectorXd u = one.covariance.diagonal().cwiseSqrt();
    EXPECT_LT(((one.values - two.values).array() / u.array()).abs().maxCoeff(), 1e-5);
    const Eigen::MatrixXd covariance = one.covariance.dense();
    EXPECT_LT((two.covariance.dense() - 4.0 * covariance).cwiseAbs().maxCoeff(),
              1e-6 * covariance.cwiseAbs().maxCoeff());
    EXPECT_NEAR(two.chi_square / one.chi_square, 0.25, 1e-6);
}

TEST(JointAdjustment, ReversalIsNotReportedWhenOneStationSawOneSense) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.both_senses = true;
    Campaign campaign = simulate(plan);
    std::erase_if(campaign.measurement.lengths, [](const LengthObservation& length) {
        return length.station == 2 && length.approach == Approach::negative;
    });
    const RotaryTableSolution solution = evaluate(campaign);
    EXPECT_FALSE(solution.quantities.has_reversal);
    EXPECT_EQ(solution.values.size(), 6 * 12 + 4);
    EXPECT_TRUE(std::any_of(solution.notes.begin(), solution.notes.end(),
                            [](const gum::Diagnostic& note) { return note.code == "GC-REVERSAL-0001"; }));
}

TEST(JointAdjustment, StationsAndFixtureComeWithTheirCovariances) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::c}) {
        CampaignPlan plan;
        plan.axis = axis;
        plan.home = 5;
        plan.noise = 0.0;
        plan.angles_deg = synthetic::full_turn(12);
        const Campaign campaign = simulate(plan);
        const RotaryTableSolution solution = evaluate(campaign);
        for (const StationEstimate& station : solution.stations) {
            EXPECT_EQ(station.u, station.covariance.diagonal().cwiseSqrt());
            EXPECT_GT(station.covariance.determinant(), 0.0);
            // Radially far less certain than across (rotary-table.md, 4c).
            const Eigen::Vector3d radial = station.position.normalized();
            EXPECT_GT(radial.dot(station.covariance * radial), 0.8 * station.covariance.trace());
        }
        ASSERT_EQ(solution.fixture_position_covariance.size(), 6U);
        for (Eigen::Index m = 0; m < 6; ++m) {
            EXPECT_EQ(solution.fixture_position_covariance[static_cast<std::size_t>(m)].diagonal().cwiseSqrt(),
                      solution.u_fixture.row(m).transpose());
            const Eigen::Vector3d at_home =
                synthetic::moved(campaign.truth.errors.col(5),
                                 synthetic::moved(campaign.truth.set_up, campaign.truth.fixture.row(m).transpose()));
            EXPECT_LT((solution.fixture_at_home.row(m).transpose() - at_home).norm(), 1e-9);
        }
    }
}

TEST(JointAdjustment, ResolutionReachesTheResultsOfBothMethods) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.dead_paths = synthetic::DeadPaths::per_station;
    Campaign campaign = simulate(plan);
    for (const auto method : {evaluate_jointly, evaluate_sequentially}) {
        campaign.measurement.length_uncertainty.resolution = 0.0;
        const RotaryTableSolution fine = method(campaign.measurement, EvaluationOptions{}, {});
        campaign.measurement.length_uncertainty.resolution = 1e-6;
        const RotaryTableSolution coarse = method(campaign.measurement, EvaluationOptions{}, {});
        // Variance of one length at a metre: 0.0625 µm² of noise, 0.0833 µm² of the step of one micrometre.
        const double ratio = coarse.covariance.diagonal().head(72).sum() / fine.covariance.diagonal().head(72).sum();
        EXPECT_GT(ratio, 1.8);
        EXPECT_LT(ratio, 3.6);
        // The model for the budget has the same covariance.
        Eigen::Index size = 0;
        for (const gum::InputGroup& group : coarse.model->inputs()) {
            size += group.size();
        }
        Eigen::VectorXd x(size);
        size = 0;
        for (const gum::InputGroup& group : coarse.model->inputs()) {
            x.segment(size, group.size()) = group.value;
            size += group.size();
        }
        const Eigen::MatrixXd jacobian = coarse.model->jacobian(x);
        Eigen::VectorXd variance = Eigen::VectorXd::Zero(jacobian.rows());
        size = 0;
        for (const gum::InputGroup& group : coarse.model->inputs()) {
            const Eigen::MatrixXd part = jacobian.middleCols(size, group.size());
            variance += group.is_diagonal() ? Eigen::VectorXd(part.cwiseAbs2() * group.covariance.col(0))
                                            : Eigen::VectorXd((part * group.covariance * part.transpose()).diagonal());
            size += group.size();
        }
        EXPECT_LT((variance.array() / coarse.covariance.diagonal().array() - 1.0).abs().maxCoeff(), 1e-6);
        // External reliability of either method is by its own gain.
        EXPECT_EQ(coarse.external_reliability.size(), static_cast<std::size_t>(coarse.values.size()));
    }
}

/// Layouts beyond the standard one, each with noise: normalised errors of all reported quantities over some campaigns.
struct Layout {
    const char* name;
    void (*change)(CampaignPlan&);
    bool correlated_fixture;
};

class HonestLayout : public testing::TestWithParam<Layout> {};

TEST_P(HonestLayout, NormalisedErrorsHaveUnitSpread) {
    double squares = 0.0;
    double set_up = 0.0;
    double coordinates = 0.0;
    double variance_factor = 0.0;
    constexpr int k_campaigns = 10;
    for (int k = 0; k < k_campaigns; ++k) {
        CampaignPlan plan;
        plan.table_linear = 0.3e-6;
        plan.table_axial = 5e-6;
        plan.table_tilt = 5e-6 / 3.0;
        plan.angles_deg = synthetic::full_turn(18);
        plan.seed = 4000 + static_cast<std::uint64_t>(k);
        GetParam().change(plan);
        Campaign campaign = simulate(plan);
        RotaryTableMeasurement& measurement = campaign.measurement;
        if (GetParam().correlated_fixture) {
            // A CMM whose scale and squareness are common to all coordinates, on top of its point noise.
            const Eigen::Index n = measurement.fixture_covariance.rows();
            Eigen::MatrixXd common(n, 2);
            for (Eigen::Index m = 0; m < n / 3; ++m) {
                const Eigen::Vector3d p = campaign.truth.fixture.row(m).transpose();
                common.middleRows<3>(3 * m) << 10e-6 * p, Eigen::Vector3d(10e-6 * p[1], 0.0, 0.0);
            }
            synthetic::Noise noise(plan.seed + 77);
            const Eigen::Vector2d drawn(noise.normal(), noise.normal());
            const Eigen::VectorXd shift = common * drawn;
            for (Eigen::Index i = 0; i < n; ++i) {
                measurement.fixture(i / 3, i % 3) += shift[i];
            }
            measurement.fixture_covariance += common * common.transpose();
        }
        const RotaryTableSolution solution = evaluate(campaign);
        const Eigen::VectorXd difference = solution.values - campaign.true_values(solution.quantities.has_reversal);
        const Eigen::ArrayXd u = solution.covariance.diagonal().cwiseSqrt();
        const Eigen::VectorXd normalised = (u > 0.0).select(difference.array() / u, 0.0);  // zero at home by its datum
        const Eigen::Index errors = solution.quantities.set_up;
        squares +=
            normalised.head(errors).squaredNorm() / static_cast<double>((u.head(errors) > 0.0).count()) / k_campaigns;
        set_up += normalised.segment<4>(errors).squaredNorm() / 4.0 / k_campaigns;
        coordinates +=
            ((solution.fixture - campaign.truth.fixture).array() / solution.u_fixture.array()).square().mean() /
            k_campaigns;
        variance_factor += solution.variance_factor / k_campaigns;
    }
    EXPECT_NEAR(std::sqrt(squares), 1.0, 0.12);
    EXPECT_NEAR(std::sqrt(set_up), 1.0, 0.35);  // forty numbers, of which those of one campaign hang together
    EXPECT_NEAR(std::sqrt(coordinates), 1.0, 0.25);
    EXPECT_NEAR(variance_factor, 1.0, 0.08);
}

INSTANTIATE_TEST_SUITE_P(
    Layouts, HonestLayout,
    testing::Values(
        Layout{"QuarterTurn", [](CampaignPlan& plan) { plan.angles_deg = synthetic::partial_turn(90.0, 12); }, false},
        Layout{"DeadPathPerPair",
               [](CampaignPlan& plan) { plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector; }, false},
        Layout{"QuarterTurnWithDeadPathPerPair",
               [](CampaignPlan& plan) {
                   plan.angles_deg = synthetic::partial_turn(90.0, 12);
                   plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
                   plan.start_values = true;
               },
               false},
        Layout{"FreeScale",
               [](CampaignPlan& plan) {
                   plan.scale_model = ScaleModel::free;
                   plan.u_scale = 2e-6;  // of the simulation; the adjustment is told nothing of it
               },
               false},
        Layout{"CorrelatedFixture", [](CampaignPlan&) {}, true},
        Layout{"AxisBWithHomeWithin",
               [](CampaignPlan& plan) {
                   plan.axis = RotaryAxis::b;
                   plan.home = 7;
                   plan.datum = Datum::home;
               },
               false},
        Layout{"AxisCBothSensesThreeRunsWithGaps",
               [](CampaignPlan& plan) {
                   plan.axis = RotaryAxis::c;
                   plan.angles_deg = synthetic::full_turn(8);
                   plan.home = 3;
                   plan.both_senses = true;
                   plan.runs = 3;
                   plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
                   plan.missing_share = 0.15;
               },
               false}),
    [](const auto& layout) { return std::string(layout.param.name); });

// A fixture whose coordinates are in a frame far from the axis: the same results as of any other, and a warning.
TEST(InclinedFixture, ErrorsAreAsLargeAsTheirUncertainties) {
    double squares = 0.0;
    double count = 0.0;
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        CampaignPlan plan;
        plan.axis = std::array{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}[seed % 3];
        plan.angles_deg = synthetic::full_turn(8);
        plan.tilt = 0.12 * static_cast<double>(seed) *
                    Eigen::Vector2d(std::cos(static_cast<double>(seed)), std::sin(static_cast<double>(seed)));
        plan.seed = seed;
        const Campaign campaign = simulate(plan);
        RotaryTableMeasurement measurement = campaign.measurement;
        measurement.table_repeatability = {RepeatabilityMode::given, 0.0, 0.0, 0.0};
        const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
        const bool told = std::ranges::any_of(solution.notes, [](const gum::Diagnostic& note) {
            return note.code == "GC-GEOMETRY-0006" && note.severity == gum::Severity::warning;
        });
        EXPECT_EQ(told, plan.tilt.norm() > 10.0 * gum::k_degree) << seed;
        const Eigen::VectorXd difference = solution.values - campaign.true_values(false);
        const Eigen::VectorXd normalised = difference.cwiseQuotient(solution.covariance.diagonal().cwiseSqrt());
        EXPECT_LT(normalised.cwiseAbs().maxCoeff(), 4.5) << seed;
        squares += normalised.squaredNorm();
        count += static_cast<double>(normalised.size());
    }
    EXPECT_NEAR(std::sqrt(squares / count), 1.0, 0.2);
}

TEST(InclinedFixture, IsRefusedWhereAnotherCoordinateMayBeNearer) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.tilt = {0.01, 1.3};
    try {
        (void)evaluate_jointly(simulate(plan).measurement, EvaluationOptions{});
        FAIL() << "no failure";
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-GEOMETRY-0007") << error.what();
        EXPECT_NE(std::string(error.what()).find("nearest to their"), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace gumcert::engine
