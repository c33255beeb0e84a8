// A simulated rotary table, adjusted and laid out for its trials, for tests.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "engine/rotary_table/start/start_values.h"
#include "engine/rotary_table/trials/trial_lanes.h"
#include "engine/rotary_table/trials/trial_network.h"
#include "engine/rotary_table/variance_components.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine::synthetic {

/// Both senses, scales with a prior, a dead path of each pair, a fixture off its temperature; a third of the distances
/// lost. Expansion and temperatures are known unless `plan` is given another u.
inline CampaignPlan network_plan(RotaryAxis axis) {
    CampaignPlan plan;
    plan.axis = axis;
    plan.angles_deg = full_turn(6);
    plan.home = 2;
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 4e-6, -3e-6, 2e-6;
    plan.reversal_model = ReversalModel::constant;
    plan.dead_paths = DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    plan.temperature_difference = 1.2;
    plan.expansion = 11.5e-6;
    plan.missing_share = 0.1;
    return plan;
}

struct SolvedNetwork {
    explicit SolvedNetwork(const CampaignPlan& plan) : campaign(simulate(plan)) {
        const RotaryTableMeasurement& measurement = campaign.measurement;
        stochastic = start_variances(measurement.table_repeatability);
        joint = std::make_unique<JointAdjustment>(measurement, std::vector<bool>(measurement.lengths.size(), true),
                                                  rigid_motion(campaign.truth.set_up), find_start_values(measurement),
                                                  stochastic);
        EXPECT_TRUE(joint->adjustment().solve(SolverOptions{}).converged);
        joint->set_weights(stochastic);
        EXPECT_TRUE(joint->adjustment().refine(SolverOptions{}).converged);
        network = std::make_unique<TrialNetwork>(*joint, stochastic, false);
    }
    SolvedNetwork(const SolvedNetwork&) = delete;
    SolvedNetwork& operator=(const SolvedNetwork&) = delete;

    /// Deviations of the free parameters from the solution, in parts of their standard uncertainty times `spread`.
    [[nodiscard]] std::vector<Lanes> deviations(double spread, std::uint64_t seed) const {
        Noise noise(seed);
        const NormalEquations normal = joint->adjustment().linearise();
        const Eigen::VectorXd u = normal.covariance().diagonal().cwiseSqrt();
        std::vector<Lanes> delta(network->nominal.size(), Lanes{});
        for (std::size_t i = 0; i < network->free_slots.size(); ++i) {
            const FreeParameter& parameter = network->free_parameters[i];
            const double scale = spread * u[normal.column(parameter.block, parameter.component)];
            for (int lane = 0; lane < k_lanes; ++lane) {
                delta[static_cast<std::size_t>(network->free_slots[i])][lane] = scale * noise.normal();
            }
        }
        return delta;
    }

    /// The adjustment with the parameters of one trial.
    [[nodiscard]] Adjustment at(const std::vector<Lanes>& delta, int lane) const {
        Adjustment moved = joint->adjustment();
        for (std::size_t i = 0; i < network->free_slots.size(); ++i) {
            const FreeParameter& parameter = network->free_parameters[i];
            Eigen::VectorXd value = moved.parameters(parameter.block);
            value[parameter.component] += delta[static_cast<std::size_t>(network->free_slots[i])][lane];
            moved.set_parameters(parameter.block, value);
        }
        return moved;
    }

    Campaign campaign;
    StochasticModel stochastic;
    std::unique_ptr<JointAdjustment> joint;
    std::unique_ptr<TrialNetwork> network;
};

}  // namespace gumcert::engine::synthetic
