// Error motions of each sense of approach of their own: against dense matrices, and against planted reversals.
#include "engine/rotary_table/sense_deviations.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/rotary_table_model.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using synthetic::Campaign;
using synthetic::CampaignPlan;

CampaignPlan both_senses() {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(8);
    plan.both_senses = true;
    plan.reversal << 1e-6, -2e-6, 1.5e-6, 8e-6, -6e-6, 7e-6;
    plan.table_linear = 0.2e-6;
    plan.table_axial = 2e-6;
    plan.table_tilt = 1e-6;
    return plan;
}

RotaryTableSolution solve(const RotaryTableMeasurement& measurement) {
    return evaluate_jointly(measurement, EvaluationOptions{});
}

const RotaryTableModel& table_model_of(const RotaryTableSolution& solution) {
    return dynamic_cast<const RotaryTableModel&>(*solution.model);
}

TEST(SenseDeviations, AreThoseOfDenseMatrices) {
    const RotaryTableSolution solution = solve(simulate(both_senses()).measurement);
    const JointAdjustment& solved = table_model_of(solution).solved();
    const NormalEquations normal = solved.adjustment().linearise();
    const auto found = sense_deviations(solved, normal, normal.bordered_covariance());
    ASSERT_EQ(found.size(), 16U);

    // All lengths one below the other, not whitened.
    const MatrixXd C = normal.covariance();
    for (const SenseDeviation& one : found) {
        std::vector<std::size_t> visits;
        Index rows = 0;
        for (std::size_t v = 0; v < solved.visits().size(); ++v) {
            if (solved.visits()[v].angle == one.angle && solved.visits()[v].approach == one.approach) {
                visits.push_back(v);
                rows += static_cast<Index>(solved.visits()[v].observations.size());
            }
        }
        MatrixXd A(rows, 6);
        MatrixXd J = MatrixXd::Zero(rows, C.rows());
        MatrixXd M = MatrixXd::Zero(rows, rows);
        VectorXd r(rows);
        Index at = 0;
        for (const std::size_t v : visits) {
            const auto n = static_cast<Index>(solved.visits()[v].observations.size());
            const LinearisedGroup& group = normal.groups()[v];
            A.middleRows(at, n) = solved.pose_jacobian(v);
            J(Eigen::seqN(at, n), group.columns) = group.cholesky * group.jacobian;
            M.block(at, at, n, n) = solved.visit_covariance(v, solution.stochastic);
            r.segment(at, n) = solved.adjustment().residual(v);
            at += n;
        }
        const MatrixXd inverse = M.inverse();
        const MatrixXd G = (A.transpose() * inverse * A).inverse() * A.transpose() * inverse;
        const MatrixXd expected = G * (M - J * C * J.transpose()) * G.transpose();
        const VectorXd u = expected.diagonal().cwiseSqrt();
        EXPECT_LT(((one.deviation - G * r).cwiseQuotient(u)).cwiseAbs().maxCoeff(), 1e-6);
        EXPECT_LT((u.cwiseInverse().asDiagonal() * (one.covariance - expected) * u.cwiseInverse().asDiagonal())
                      .cwiseAbs()
                      .maxCoeff(),
                  1e-6);
    }
}

TEST(SenseDeviations, FindAReversalThatDependsOnTheAngle) {
    // The table lags by 5 arcsec more in the positive sense at one angle: l - f of these visits follows A.
    CampaignPlan plan = both_senses();
    plan.noise = 0.05;
    RotaryTableMeasurement measurement = simulate(plan).measurement;
    measurement.table_repeatability = {RepeatabilityMode::given, 0.2e-6, 2e-6, 1e-6};
    measurement.estimate_length_noise = false;
    const RotaryTableSolution sound = solve(measurement);
    const JointAdjustment& before = table_model_of(sound).solved();
    const double planted = 5.0 * synthetic::k_arcsec;
    const std::size_t angle = 3;
    for (std::size_t v = 0; v < before.visits().size(); ++v) {
        const Visit& visit = before.visits()[v];
        if (visit.angle == angle && visit.approach == Approach::positive) {
            const VectorXd change = before.pose_jacobian(v).col(3) * planted;
            for (std::size_t i = 0; i < visit.observations.size(); ++i) {
                measurement.lengths[visit.observations[i]].length += change[static_cast<Index>(i)];
            }
        }
    }
    measurement.outliers.test = OutlierTest::none;
    const RotaryTableSolution solution = solve(measurement);
    const JointAdjustment& solved = table_model_of(solution).solved();
    const NormalEquations normal = solved.adjustment().linearise();
    VectorXd up = VectorXd::Zero(8);
    VectorXd down = VectorXd::Zero(8);
    for (const SenseDeviation& one : sense_deviations(solved, normal, normal.bordered_covariance())) {
        (one.approach == Approach::positive ? up : down)[static_cast<Index>(one.angle)] = one.deviation[3];
    }
    // One reversal for all eight angles takes up an eighth of it, the curve half of what is left.
    const VectorXd reversal = up - down;
    EXPECT_NEAR(reversal[angle], planted * 7.0 / 8.0, 0.1 * planted);
    for (Index i = 0; i < 8; ++i) {
        if (i != static_cast<Index>(angle)) {
            EXPECT_NEAR(reversal[i], -planted / 8.0, 0.1 * planted);
        }
    }
}

}  // namespace
}  // namespace gumcert::engine
