// What the observations do not determine is refused by name and with a cure; what is merely weak is solved.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "gum/quantity/diagnostic.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

/// The diagnostic with which a measurement is refused; an empty one when it is not.
gum::Diagnostic rank_refusal(const RotaryTableMeasurement& measurement) {
    try {
        (void)evaluate_jointly(measurement, EvaluationOptions{});
    } catch (const gum::NoResultError& error) {
        EXPECT_EQ(error.diagnostics().size(), 1U);
        return error.diagnostics().front();
    }
    return {};
}

bool mentions(const gum::Diagnostic& diagnostic, const std::string& text) {
    return gum::message(diagnostic).find(text) != std::string::npos;
}

/// Six reflectors on a ring about the rotary axis, alternate ones raised; station P3 on the axis.
CampaignPlan ring_of_stations(double raised) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    plan.offset.setZero();
    plan.tilt.setZero();
    plan.error_factor = 0.0;
    for (std::size_t m = 0; m < 6; ++m) {
        const double angle = std::numbers::pi / 3.0 * static_cast<double>(m);
        plan.reflectors[m] = {0.1 + (m % 2 == 0 ? raised : 0.0), 0.12 * std::cos(angle), 0.12 * std::sin(angle)};
    }
    plan.stations[2] = {1.0, 0.0, 0.0};
    plan.noise = 0.0;
    return plan;
}

TEST(Rank, RingOfReflectorsSeenFromTheAxisIsRefused) {
    for (const RotaryAxis axis : {RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}) {
        CampaignPlan plan = ring_of_stations(0.0);
        plan.axis = axis;
        plan.start_values = true;
        Campaign campaign = simulate(plan);
        campaign.measurement.station_start[2].reset();
        const gum::Diagnostic diagnostic = rank_refusal(campaign.measurement);
        EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
        EXPECT_TRUE(mentions(diagnostic, "station P3")) << gum::message(diagnostic);
        EXPECT_TRUE(mentions(diagnostic, "dead path")) << gum::message(diagnostic);
        EXPECT_TRUE(mentions(diagnostic, "cone")) << gum::message(diagnostic);
        EXPECT_TRUE(mentions(diagnostic, "move the station off the rotary axis")) << gum::message(diagnostic);
        EXPECT_FALSE(mentions(diagnostic, "station P1")) << gum::message(diagnostic);
    }
}

TEST(Rank, RingWithoutAnyStartValuesIsRefused) {
    // A flat ring leaves the side of every station open (mirror image): no result from distances alone.
    EXPECT_EQ(rank_refusal(simulate(ring_of_stations(0.0)).measurement).code, "GC-RANK-0001");
}

TEST(Rank, NoisyRingIsRefusedOrHonest) {
    // Noise and set-up take a real ring off the exact cone: whatever comes out must not claim more than it knows.
    for (const double raised : {0.0, 1e-3, 1e-2}) {
        for (const bool start_values : {false, true}) {
            for (const bool set_up : {false, true}) {
                CampaignPlan plan = ring_of_stations(raised);
                plan.noise = 1.0;
                plan.start_values = start_values;
                if (set_up) {
                    plan.offset = CampaignPlan{}.offset;
                    plan.tilt = CampaignPlan{}.tilt;
                    plan.error_factor = 1.0;
                }
                const Campaign campaign = simulate(plan);
                try {
                    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
                    const Eigen::VectorXd normalised = (solution.values - campaign.true_values(false)).array() /
                                                       solution.covariance.diagonal().array().sqrt();
                    EXPECT_LT(std::sqrt(normalised.squaredNorm() / static_cast<double>(normalised.size())), 1.3);
                    for (std::size_t j = 0; j < 6; ++j) {
                        const Eigen::Vector3d error = solution.stations[j].position - campaign.truth.stations[j];
                        EXPECT_LT((error.array() / solution.stations[j].u.array()).abs().maxCoeff(), 4.0)
                            << "station " << j << ", raised " << raised;
                    }
                } catch (const gum::NoResultError& error) {
                    const std::string& code = error.diagnostics().front().code;
                    EXPECT_TRUE(code == "GC-RANK-0001" || code == "GC-ADJUST-0005") << error.what();
                    EXPECT_EQ(raised, 0.0) << error.what();
                }
            }
        }
    }
}

TEST(Rank, RingOfReflectorsIsRefusedWithStartValuesToo) {
    CampaignPlan plan = ring_of_stations(0.0);
    plan.start_values = true;
    const Campaign campaign = simulate(plan);
    const gum::Diagnostic diagnostic = rank_refusal(campaign.measurement);
    EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
    EXPECT_TRUE(mentions(diagnostic, "station P3")) << gum::message(diagnostic);
    EXPECT_TRUE(mentions(diagnostic, "dead path P3")) << gum::message(diagnostic);
    EXPECT_TRUE(mentions(diagnostic, "cone")) << gum::message(diagnostic);
    EXPECT_TRUE(mentions(diagnostic, "move the station off the rotary axis")) << gum::message(diagnostic);
    EXPECT_FALSE(mentions(diagnostic, "station P1")) << gum::message(diagnostic);
}

TEST(Rank, RaisedHoldersCureTheRing) {
    CampaignPlan plan = ring_of_stations(0.05);
    plan.start_values = true;
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_LT((solution.values - campaign.true_values(false)).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(Rank, PoseWithTooFewDistancesIsRefusedByName) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    std::size_t kept = 0;
    std::erase_if(campaign.measurement.lengths,
                  [&kept](const LengthObservation& length) { return length.angle == 4 && ++kept > 5; });
    const gum::Diagnostic diagnostic = rank_refusal(campaign.measurement);
    EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
    EXPECT_TRUE(mentions(diagnostic, "at angle number 5")) << gum::message(diagnostic);
    EXPECT_FALSE(mentions(diagnostic, "at angle number 6")) << gum::message(diagnostic);
    EXPECT_TRUE(mentions(diagnostic, "six")) << gum::message(diagnostic);
    EXPECT_TRUE(mentions(diagnostic, "measure that angle from more stations")) << gum::message(diagnostic);
}

TEST(Rank, PoseSeenThroughOneReflectorIsRefused) {
    // Six distances, but to one point: its three coordinates, and nothing of the rotation.
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    std::erase_if(campaign.measurement.lengths,
                  [](const LengthObservation& length) { return length.angle == 7 && length.reflector != 2; });
    const gum::Diagnostic diagnostic = rank_refusal(campaign.measurement);
    EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
    EXPECT_TRUE(mentions(diagnostic, "at angle number 8")) << gum::message(diagnostic);
}

TEST(Rank, PoseThatWasNotMeasuredIsRefused) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(12);
    Campaign campaign = simulate(plan);
    std::erase_if(campaign.measurement.lengths, [](const LengthObservation& length) { return length.angle == 3; });
    const gum::Diagnostic diagnostic = rank_refusal(campaign.measurement);
    EXPECT_EQ(diagnostic.code, "GC-RANK-0001");
    EXPECT_TRUE(mentions(diagnostic, "at angle number 4")) << gum::message(diagnostic);
}

TEST(Rank, CoplanarReflectorsStillSolve) {
    for (int coordinate = 0; coordinate < 3; ++coordinate) {
        CampaignPlan plan;
        plan.noise = 0.0;
        // In a plane across the axis a station and its mirror image see the same distances: the side must be given.
        plan.start_values = coordinate == 0;
        for (Eigen::Vector3d& reflector : plan.reflectors) {
            reflector[coordinate] = 0.1;
        }
        const Campaign campaign = simulate(plan);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        EXPECT_LT((solution.values - campaign.true_values(false)).cwiseAbs().maxCoeff(), 1e-9)
            << "coordinate " << coordinate;
    }
}

TEST(Rank, StationsInANarrowConeStillSolveWithTheLossOfTheNote) {
    // rotary-table.md, 4c: stations in a cone of 9° make d_y, d_z six times worse.
    CampaignPlan plan;
    plan.noise = 0.0;
    const RotaryTableSolution wide = evaluate_jointly(simulate(plan).measurement, EvaluationOptions{});
    Eigen::Vector3d centre = Eigen::Vector3d::Zero();
    for (const Eigen::Vector3d& reflector : plan.reflectors) {
        centre += reflector / 6.0;
    }
    for (Eigen::Vector3d& station : plan.stations) {
        const double distance = (station - centre).norm();
        const Eigen::Vector3d direction = Eigen::Vector3d::UnitX() + 0.15 * (station - centre) / distance;
        station = centre + distance * direction.normalized();
    }
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution narrow = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_LT((narrow.values - campaign.true_values(false)).cwiseAbs().maxCoeff(), 1e-8);
    const auto u = [](const RotaryTableSolution& solution) {
        return synthetic::rms_over_angles(solution.covariance.diagonal().cwiseSqrt(), 36);
    };
    const synthetic::Vector6 ratio = u(narrow).cwiseQuotient(u(wide));
    EXPECT_NEAR(ratio[1], 0.575 / 0.103, 0.6);
    EXPECT_NEAR(ratio[2], 0.691 / 0.120, 0.6);
    EXPECT_NEAR(ratio[3], 5.8 / 0.77, 0.8);
}

TEST(Rank, FewestStationsAndReflectorsStillSolve) {
    CampaignPlan plan;
    plan.noise = 0.0;
    plan.stations.resize(4);
    plan.reflectors = {plan.reflectors[0], plan.reflectors[2], plan.reflectors[3], plan.reflectors[4]};
    const Campaign campaign = simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_LT((solution.values - campaign.true_values(false)).cwiseAbs().maxCoeff(), 1e-9);
}

}  // namespace
}  // namespace gumcert::engine
