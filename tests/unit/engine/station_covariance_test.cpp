#include "engine/station_covariance.h"

#include <gtest/gtest.h>

#include "engine/rotary_table_evaluation.h"
#include "engine/rotation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

TEST(StationCovariance, IsThatOfThePositionMovedByTheWorldOfTheDatum) {
    // In full matrices: the position q of the solver moves by the motion of the world that all poses together make.
    for (const Datum datum : {Datum::home, Datum::axis_average_line}) {
        synthetic::CampaignPlan plan;
        plan.datum = datum;
        plan.angles_deg = synthetic::full_turn(8);
        plan.start_values = true;
        const synthetic::Campaign campaign = synthetic::simulate(plan);
        const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
        const JointAdjustment& solved = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model)->solved();
        const NormalEquations normal = solved.adjustment().linearise();
        const Eigen::MatrixXd dense = normal.covariance();
        const auto count = static_cast<Eigen::Index>(campaign.measurement.stations.size());
        const Eigen::MatrixXd all =
            covariance_of_stations(solved, normal, normal.bordered_covariance(), solution.datum);
        ASSERT_EQ(all.rows(), 3 * count);
        Eigen::MatrixXd all_rows(3 * count, normal.parameter_count());
        for (std::size_t j = 0; j < campaign.measurement.stations.size(); ++j) {
            const auto block = solved.station_block(j);
            const Eigen::Vector3d position = solved.adjustment().parameters(block).head<3>();
            Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, normal.parameter_count());
            const Eigen::MatrixXd by_pose = point_displacement(position) * solution.datum.world_map;
            for (Eigen::Index i = 0; i < by_pose.cols(); ++i) {
                const Eigen::Index column =
                    normal.column(solved.pose_block(static_cast<std::size_t>(i / 6)), static_cast<int>(i % 6));
                if (column >= 0) {
                    rows.col(column) = by_pose.col(i);
                }
            }
            for (int c = 0; c < 3; ++c) {
                rows(c, normal.column(block, c)) += 1.0;
            }
            all_rows.middleRows<3>(3 * static_cast<Eigen::Index>(j)) = rows;
            const Eigen::Matrix3d expected = rows * dense * rows.transpose();
            const Eigen::Matrix3d found =
                station_covariance(solved, normal, normal.bordered_covariance(), solution.datum, j);
            EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff()) << j;
        }
        const Eigen::MatrixXd expected = all_rows * dense * all_rows.transpose();
        EXPECT_LT((all - expected).cwiseAbs().maxCoeff(), 1e-9 * expected.cwiseAbs().maxCoeff());
    }
}

}  // namespace
}  // namespace gumcert::engine
