#include "engine/rotary_table/station_covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>

#include <algorithm>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/rotation.h"
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

TEST(StationCovariance, ShareIsWhatAnExactStationTakesOffTheVariances) {
    synthetic::CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.start_values = true;
    const synthetic::Campaign campaign = synthetic::simulate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const JointAdjustment& solved = std::dynamic_pointer_cast<const RotaryTableModel>(solution.model)->solved();
    const NormalEquations normal = solved.adjustment().linearise();
    const BorderedCovariance covariance = normal.bordered_covariance();
    const AnglewiseMap map = reported_map(solved, normal, solution.datum);
    const Eigen::MatrixXd by_parameter =
        map.combined(Eigen::MatrixXd::Identity(map.rows(), map.rows()), solved, normal);  // m×p
    const Eigen::MatrixXd dense = normal.covariance();
    const Eigen::VectorXd variances = (by_parameter * dense * by_parameter.transpose()).diagonal();
    for (std::size_t j = 0; j < campaign.measurement.stations.size(); ++j) {
        // Known along its worst line to a thousandth of what it was: the covariance with one more observation.
        const Eigen::Matrix3d own = station_covariance(solved, normal, covariance, solution.datum, j);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> eigen(own);
        const auto block = solved.station_block(j);
        const Eigen::Vector3d position = solved.adjustment().parameters(block).head<3>();
        const Eigen::MatrixXd by_pose = point_displacement(position) * solution.datum.world_map;
        Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(3, normal.parameter_count());
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
        const Eigen::RowVectorXd along = eigen.eigenvectors().col(2).transpose() * rows;
        const Eigen::MatrixXd known =
            dense - dense * along.transpose() * along * dense / (eigen.eigenvalues()[2] * (1.0 + 1e-6));
        const Eigen::VectorXd left = (by_parameter * known * by_parameter.transpose()).diagonal();
        double expected = 0.0;
        for (Eigen::Index i = 0; i < left.size(); ++i) {
            expected = variances[i] > 0.0 ? std::max(expected, 1.0 - left[i] / variances[i]) : expected;
        }
        EXPECT_NEAR(largest_share_of_station(solved, normal, covariance, solution.datum, map, variances, j), expected,
                    1e-5);
        EXPECT_GT(expected, 1e-4) << "nothing was compared";
    }
}

}  // namespace
}  // namespace gumcert::engine
