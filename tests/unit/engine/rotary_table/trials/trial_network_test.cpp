#include "engine/rotary_table/trials/trial_network.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <set>
#include <vector>

#include "tests/support/solved_network.h"

namespace gumcert::engine {
namespace {

using synthetic::SolvedNetwork;

TEST(TrialNetwork, HoldsTheSolution) {
    const SolvedNetwork solved(synthetic::network_plan(RotaryAxis::b));
    const TrialNetwork& network = *solved.network;
    const JointAdjustment& joint = *solved.joint;
    const RotaryTableMeasurement& measurement = solved.campaign.measurement;
    EXPECT_EQ(network.stations, 6);
    EXPECT_EQ(network.reflectors, 6);
    EXPECT_EQ(network.angles, 6);
    for (Eigen::Index j = 0; j < 6; ++j) {
        const Eigen::VectorXd station = joint.adjustment().parameters(joint.station_block(static_cast<std::size_t>(j)));
        EXPECT_EQ(network.nominal_point(TrialNetwork::station_slot(j, 0)), station.head<3>());
        EXPECT_EQ(network.nominal_at(TrialNetwork::station_slot(j, TrialNetwork::k_scale)), station[3]);
        EXPECT_DOUBLE_EQ(network.nominal_at(TrialNetwork::station_slot(j, TrialNetwork::k_stretch)),
                         measurement.expansion * station[4])
            << "the stretch in the place of the temperature";
    }
    for (Eigen::Index i = 0; i < 6; ++i) {
        for (Eigen::Index c = 0; c < 6; ++c) {
            EXPECT_EQ(network.nominal_at(network.poses + 6 * i + c), joint.poses()(c, i));
        }
    }
    EXPECT_EQ(network.reversal_of(3), network.reversal) << "one of all angles";
    EXPECT_EQ(network.nominal_point(network.reversal), joint.reversal(0).head<3>());
}

TEST(TrialNetwork, HasEveryDistanceOnceWithItsResidualAndWeight) {
    const SolvedNetwork solved(synthetic::network_plan(RotaryAxis::a));
    const TrialNetwork& network = *solved.network;
    const RotaryTableMeasurement& measurement = solved.campaign.measurement;
    EXPECT_EQ(network.lengths.size(), measurement.lengths.size());
    std::set<std::size_t> seen;
    Eigen::Index next = 0;
    for (const TrialNetwork::VisitPlan& plan : network.visits) {
        const Visit& visit = solved.joint->visits()[plan.number];
        EXPECT_TRUE(seen.insert(plan.number).second);
        EXPECT_EQ(plan.first, next);
        ASSERT_EQ(static_cast<std::size_t>(plan.count), visit.observations.size());
        next += plan.count;
        const Eigen::VectorXd residual = solved.joint->adjustment().residual(plan.number);
        const Eigen::MatrixXd weights =
            solved.joint->visit_covariance(plan.number, solved.stochastic).inverse() * 1e-14;
        for (Eigen::Index k = 0; k < plan.count; ++k) {
            const auto at = static_cast<std::size_t>(plan.first + k);
            const TrialNetwork::Length& length = network.lengths[at];
            EXPECT_NEAR(network.length_residual[at], residual[k], 1e-15);
            EXPECT_NEAR(length.inverse * length.distance, 1.0, 1e-15);
            EXPECT_NEAR(Eigen::Vector3d(length.difference[0], length.difference[1], length.difference[2]).norm(),
                        length.distance, 1e-15);
            EXPECT_EQ(static_cast<std::size_t>(length.reflector),
                      measurement.lengths[visit.observations[static_cast<std::size_t>(k)]].reflector);
            for (Eigen::Index l = 0; l < plan.count; ++l) {
                EXPECT_NEAR(1e-14 * network.weights[plan.weights + static_cast<std::size_t>(k * plan.count + l)],
                            weights(k, l), 1e-5 * weights.cwiseAbs().maxCoeff());
            }
        }
    }
    EXPECT_EQ(seen.size(), solved.joint->visits().size());
}

TEST(TrialNetwork, FactorsTheNormalEquationsOfTheAdjustment) {
    const SolvedNetwork solved(synthetic::network_plan(RotaryAxis::c));
    const TrialNetwork& network = *solved.network;
    const NormalEquations normal = solved.joint->adjustment().linearise();
    const Eigen::MatrixXd covariance = normal.covariance();
    ASSERT_EQ(network.free_slots.size(), static_cast<std::size_t>(normal.parameter_count()));
    for (std::size_t b = 0; b < network.border.size(); ++b) {
        const FreeParameter& parameter = network.free_parameters[b];
        const Eigen::Index column = normal.column(parameter.block, parameter.component);
        const auto at = static_cast<Eigen::Index>(b);
        EXPECT_EQ(network.border[b], network.free_slots[b]);
        EXPECT_NEAR(network.border_covariance(at, at) / covariance(column, column), 1.0, 1e-6) << parameter.name;
    }
    for (const TrialNetwork::Reported& reported : network.reported) {
        std::size_t i = 0;
        while (network.free_slots[i] != reported.slot) {
            ASSERT_LT(++i, network.free_slots.size());
        }
        const FreeParameter& parameter = network.free_parameters[i];
        const Eigen::Index column = normal.column(parameter.block, parameter.component);
        EXPECT_NEAR(reported.inverse_u * std::sqrt(covariance(column, column)), 1.0, 1e-6) << parameter.name;
    }
    EXPECT_FALSE(network.thermal.is_uncertain) << "expansion and temperatures are known";
}

}  // namespace
}  // namespace gumcert::engine
