#include "engine/rotary_table/external_reliability.h"

#include <gtest/gtest.h>

#include <cmath>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::CampaignPlan;

/// The search that leaves distances out by their bounds finds what the search over all of them finds.
TEST(ExternalReliability, IsTheLargestInfluenceOfAllDistances) {
    for (const Datum datum : {Datum::home, Datum::axis_average_line}) {
        for (unsigned seed = 1; seed <= 6; ++seed) {
            CampaignPlan plan;
            plan.seed = seed;
            plan.datum = datum;
            plan.home = seed % 3;
            plan.angles_deg = synthetic::full_turn(8 + static_cast<int>(seed));
            plan.both_senses = seed % 2 == 0;
            plan.missing_share = 0.05 * (seed % 3);
            plan.start_values = true;
            const synthetic::Campaign campaign = synthetic::simulate(plan);
            const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
            const JointAdjustment& solved = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model)->solved();
            const NormalEquations normal = solved.adjustment().linearise();
            const BorderedCovariance covariance = normal.bordered_covariance();
            const AnglewiseMap map = reported_map(solved, normal, solution.datum);
            const AnglewiseSensitivity sensitivity(map, solved, normal, covariance);
            const std::vector<ExternalReliability> found =
                external_reliability(sensitivity, solved, solution.reliability);

            std::vector<ExternalReliability> expected(static_cast<std::size_t>(map.rows()));
            for (std::size_t v = 0; v < solved.visits().size(); ++v) {
                const AnglewiseSensitivity::OfVisit of = sensitivity.of_visit(v);
                Eigen::MatrixXd influence = sensitivity.shared() * of.shared;
                influence.middleRows(6 * of.angle, 6) += of.own;
                for (std::size_t k = 0; k < solved.visits()[v].observations.size(); ++k) {
                    const std::size_t length = solved.visits()[v].observations[k];
                    const double bias = solution.reliability[length].minimal_detectable_bias;
                    for (std::size_t i = 0; i < expected.size(); ++i) {
                        const double change =
                            bias * influence(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(k));
                        if (std::abs(change) > std::abs(expected[i].influence)) {
                            expected[i] = {i, length, change};
                        }
                    }
                }
            }
            std::erase_if(expected, [](const ExternalReliability& row) { return row.influence == 0.0; });
            ASSERT_EQ(found.size(), expected.size());
            for (std::size_t i = 0; i < found.size(); ++i) {
                EXPECT_EQ(found[i].quantity, expected[i].quantity);
                EXPECT_NEAR(found[i].influence, expected[i].influence, 1e-9 * std::abs(expected[i].influence));
                EXPECT_EQ(found[i].length, expected[i].length);
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
