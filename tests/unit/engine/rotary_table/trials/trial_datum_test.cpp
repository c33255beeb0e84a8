#include "engine/rotary_table/trials/trial_datum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <tuple>

#include "engine/rotary_table/datum.h"
#include "tests/support/solved_network.h"

namespace gumcert::engine {
namespace {

class TrialsInDatum : public testing::TestWithParam<std::tuple<RotaryAxis, Datum>> {};

TEST_P(TrialsInDatum, AreThoseOfOneSolution) {
    synthetic::CampaignPlan plan = synthetic::network_plan(std::get<0>(GetParam()));
    plan.datum = std::get<1>(GetParam());
    const synthetic::SolvedNetwork solved(plan);
    const TrialNetwork& network = *solved.network;
    const TrialDatum datum(*solved.joint);
    TrialBatch batch(network);
    batch.delta = solved.deviations(5.0, 9);
    transform_to_datum(network, datum, batch);
    for (int lane = 0; lane < k_lanes; ++lane) {
        Eigen::MatrixXd poses = solved.joint->poses();
        for (Eigen::Index i = 0; i < poses.size(); ++i) {
            poses.reshaped()[i] += batch.delta[static_cast<std::size_t>(network.poses + i)][lane];
        }
        const DatumSolution expected =
            transform_to_datum(solved.campaign.measurement, poses, solved.joint->set_up(), plan.datum);
        for (Eigen::Index i = 0; i < poses.size(); ++i) {
            EXPECT_NEAR(batch.errors[static_cast<std::size_t>(i)][lane], expected.errors.reshaped()[i], 2e-15)
                << "lane " << lane << ", component " << i;
        }
        for (std::size_t c = 0; c < 6; ++c) {
            EXPECT_NEAR(batch.set_up[c][lane], expected.set_up[static_cast<Eigen::Index>(c)], 2e-15);
            EXPECT_NEAR(batch.world[c][lane], motion_parameters(expected.world)[static_cast<Eigen::Index>(c)], 2e-15);
        }
    }
    if (plan.datum == Datum::home) {
        EXPECT_EQ(batch.errors[6 * plan.home][3], 0.0) << "by definition";
    }
}

INSTANTIATE_TEST_SUITE_P(Axes, TrialsInDatum,
                         testing::Combine(testing::Values(RotaryAxis::a, RotaryAxis::b, RotaryAxis::c),
                                          testing::Values(Datum::axis_average_line, Datum::home)),
                         [](const auto& tested) {
                             return std::string(1, "ABC"[axial_coordinate(std::get<0>(tested.param))]) +
                                    (std::get<1>(tested.param) == Datum::home ? "Home" : "AverageLine");
                         });

}  // namespace
}  // namespace gumcert::engine
