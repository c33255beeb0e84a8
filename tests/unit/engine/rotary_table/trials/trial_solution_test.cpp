#include "engine/rotary_table/trials/trial_solution.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "tests/support/solved_network.h"

namespace gumcert::engine {
namespace {

using synthetic::SolvedNetwork;

class TrialSolution : public testing::Test {
protected:
    TrialSolution() : solved_(synthetic::network_plan(RotaryAxis::b)), batch_(*solved_.network) {
        synthetic::Noise noise(17);
        const TrialNetwork& network = *solved_.network;
        for (std::size_t k = 0; k < network.lengths.size(); ++k) {
            for (int lane = 0; lane < k_lanes; ++lane) {
                batch_.residual_start[k][lane] = network.length_residual[k] + 2e-7 * noise.normal();
            }
        }
        for (std::size_t k = 0; k < network.prior_residual.size(); ++k) {
            fill(batch_.prior_observed[k], network.prior_residual[k]);
        }
    }

    /// Largest difference of a trial from the adjustment of the same lengths, in parts of the standard uncertainties.
    [[nodiscard]] double difference_from_adjustment(int lane) const {
        const TrialNetwork& network = *solved_.network;
        Adjustment again = solved_.joint->adjustment();
        for (const TrialNetwork::VisitPlan& visit : network.visits) {
            const std::vector<std::size_t>& lengths = solved_.joint->visits()[visit.number].observations;
            Eigen::VectorXd observed(visit.count);
            for (Eigen::Index k = 0; k < visit.count; ++k) {
                const auto at = static_cast<std::size_t>(visit.first + k);
                observed[k] = solved_.campaign.measurement.lengths[lengths[static_cast<std::size_t>(k)]].length +
                              (batch_.residual_start[at][lane] - network.length_residual[at]);
            }
            again.set_observed(visit.number, observed);
        }
        EXPECT_TRUE(again.refine(SolverOptions{}).converged);
        const NormalEquations normal = again.linearise();
        const Eigen::MatrixXd covariance = normal.covariance();
        double largest = 0.0;
        for (std::size_t i = 0; i < network.free_slots.size(); ++i) {
            const FreeParameter& parameter = network.free_parameters[i];
            const auto slot = static_cast<std::size_t>(network.free_slots[i]);
            const Eigen::Index column = normal.column(parameter.block, parameter.component);
            const double difference = network.nominal[slot] + batch_.delta[slot][lane] -
                                      again.parameters(parameter.block)[parameter.component];
            largest = std::max(largest, std::abs(difference) / std::sqrt(covariance(column, column)));
        }
        return largest;
    }

    SolvedNetwork solved_;
    TrialBatch batch_;
};

TEST_F(TrialSolution, IsTheAdjustmentOfTheSameLengths) {
    const std::array<TrialEnd, k_lanes> ends = solve(*solved_.network, {}, k_lanes, batch_);
    for (const TrialEnd& end : ends) {
        EXPECT_TRUE(end.converged);
        EXPECT_FALSE(end.alone);
        EXPECT_GE(end.steps, 2);
    }
    for (const int lane : {0, 5, k_lanes - 1}) {
        EXPECT_LT(difference_from_adjustment(lane), 1e-5) << lane;
    }
}

TEST_F(TrialSolution, OfWhatIsNotWantedIsLeftAlone) {
    const std::array<TrialEnd, k_lanes> ends = solve(*solved_.network, {}, 3, batch_);
    EXPECT_TRUE(ends[2].converged);
    EXPECT_EQ(ends[3].steps, 0);
    EXPECT_FALSE(ends[3].converged);
    for (const Lanes& delta : batch_.delta) {
        EXPECT_EQ(delta[3], 0.0);
    }
}

TEST_F(TrialSolution, ThatNeedsMoreStepsGetsItsOwnNormalEquations) {
    TrialOptions options;
    options.most_steps = 1;
    const std::array<TrialEnd, k_lanes> ends = solve(*solved_.network, options, 2, batch_);
    EXPECT_TRUE(ends[1].converged);
    EXPECT_TRUE(ends[1].alone);
    EXPECT_GT(ends[1].steps, 1) << "its own come on top";
    EXPECT_LT(difference_from_adjustment(1), 1e-5);
}

TEST_F(TrialSolution, WithoutAValueIsNotFound) {
    batch_.residual_start[3][0] = std::nan("");
    const std::array<TrialEnd, k_lanes> ends = solve(*solved_.network, {}, 2, batch_);
    EXPECT_FALSE(ends[0].converged);
    EXPECT_TRUE(ends[1].converged) << "its neighbour is";
}

}  // namespace
}  // namespace gumcert::engine
