#include "engine/rotary_table/trials/trial_kinematics.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "tests/support/solved_network.h"

namespace gumcert::engine {
namespace {

using synthetic::SolvedNetwork;

class TrialKinematics : public testing::TestWithParam<RotaryAxis> {
protected:
    TrialKinematics() : solved_(synthetic::network_plan(GetParam())), batch_(*solved_.network) {
        const TrialNetwork& network = *solved_.network;
        batch_.delta = solved_.deviations(5.0, 3);
        for (std::size_t k = 0; k < network.lengths.size(); ++k) {
            fill(batch_.residual_start[k], network.length_residual[k]);
        }
        for (std::size_t k = 0; k < network.prior_residual.size(); ++k) {
            fill(batch_.prior_observed[k], network.prior_residual[k]);
        }
    }

    SolvedNetwork solved_;
    TrialBatch batch_;
};

TEST_P(TrialKinematics, ResidualsAreThoseOfTheAdjustment) {
    const TrialNetwork& network = *solved_.network;
    find_residuals(network, batch_);
    for (const int lane : {0, 7, k_lanes - 1}) {
        const Adjustment expected = solved_.at(batch_.delta, lane);
        double largest = 0.0;
        for (const TrialNetwork::VisitPlan& visit : network.visits) {
            const Eigen::VectorXd residual = expected.residual(visit.number);
            largest = std::max(largest, residual.cwiseAbs().maxCoeff());
            for (Eigen::Index k = 0; k < visit.count; ++k) {
                EXPECT_NEAR(batch_.residual[static_cast<std::size_t>(visit.first + k)][lane], residual[k], 1e-15);
            }
        }
        EXPECT_GT(largest, 1e-6) << "the trial is somewhere else than the solution";
    }
}

TEST_P(TrialKinematics, GradientIsThatOfTheAdjustment) {
    const TrialNetwork& network = *solved_.network;
    find_gradient(network, batch_);
    for (const int lane : {0, 7, k_lanes - 1}) {
        const NormalEquations normal = solved_.at(batch_.delta, lane).linearise();
        Eigen::VectorXd gradient = Eigen::VectorXd::Zero(normal.parameter_count());
        Eigen::VectorXd scale = Eigen::VectorXd::Zero(normal.parameter_count());
        for (const LinearisedGroup& group : normal.groups()) {
            gradient(group.columns) += group.jacobian.transpose() * group.residual;
            scale(group.columns) += group.jacobian.colwise().squaredNorm().transpose();
        }
        for (std::size_t i = 0; i < network.free_slots.size(); ++i) {
            const FreeParameter& parameter = network.free_parameters[i];
            const Eigen::Index column = normal.column(parameter.block, parameter.component);
            // In parts of the uncertainty that the observations alone would leave to the parameter.
            EXPECT_NEAR(
                batch_.gradient[static_cast<std::size_t>(network.free_slots[i])][lane] / std::sqrt(scale[column]),
                gradient[column] / std::sqrt(scale[column]), 1e-6)
                << parameter.name;
        }
    }
}

TEST_P(TrialKinematics, NoTrialDependsOnItsNeighbours) {
    const TrialNetwork& network = *solved_.network;
    find_residuals(network, batch_);
    const std::vector<Lanes> together = batch_.residual;
    for (Lanes& delta : batch_.delta) {
        const double kept = delta[4];
        fill(delta, 0.0);
        delta[4] = kept;
    }
    find_residuals(network, batch_);
    for (std::size_t k = 0; k < together.size(); ++k) {
        EXPECT_EQ(batch_.residual[k][4], together[k][4]);
        EXPECT_NEAR(batch_.residual[k][5], network.length_residual[k], 1e-15) << "at the solution";
    }
}

INSTANTIATE_TEST_SUITE_P(Axes, TrialKinematics, testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                         [](const auto& axis) { return std::string(1, "ABC"[axial_coordinate(axis.param)]); });

}  // namespace
}  // namespace gumcert::engine
