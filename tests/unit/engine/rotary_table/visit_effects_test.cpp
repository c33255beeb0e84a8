// Effects on the distances of visits against dense matrices of all observations.
#include "engine/rotary_table/visit_effects.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cstddef>
#include <memory>
#include <vector>

#include "engine/rotary_table/joint_adjustment.h"
#include "tests/support/small_campaign.h"

namespace gumcert::engine {
namespace {

/// A small adjustment at its truth, and M of all its visits at once.
struct DenseVisits {
    DenseVisits() {
        synthetic::CampaignPlan plan = synthetic::small_plan();
        plan.angles_deg = synthetic::full_turn(5);
        plan.both_senses = false;
        plan.stations.resize(4);
        campaign = simulate(plan);
        StartValues start;
        start.stations = campaign.truth.stations;
        start.dead_paths = campaign.truth.dead_paths;
        joint = std::make_unique<JointAdjustment>(campaign.measurement,
                                                  std::vector<bool>(campaign.measurement.lengths.size(), true),
                                                  rigid_motion(campaign.truth.set_up), start, StochasticModel{});
        joint->set_weights(StochasticModel{});
        normal = std::make_unique<NormalEquations>(joint->adjustment().linearise());
        covariance = std::make_unique<BorderedCovariance>(normal->bordered_covariance());
        const Eigen::MatrixXd Q = covariance->dense();
        Eigen::Index rows = 0;
        for (std::size_t g = 0; g < joint->visits().size(); ++g) {
            first.push_back(rows);
            rows += normal->groups()[g].residual.size();
        }
        weighted.resize(rows);
        Eigen::MatrixXd pull(Q.rows(), rows);  // Jᵀ V⁻¹
        pull.setZero();
        M = Eigen::MatrixXd::Zero(rows, rows);
        for (std::size_t g = 0; g < first.size(); ++g) {
            const LinearisedGroup& group = normal->groups()[g];
            const Eigen::Index n = group.residual.size();
            Eigen::MatrixXd whitening = Eigen::MatrixXd::Identity(n, n);
            group.cholesky.triangularView<Eigen::Lower>().solveInPlace(whitening);
            weighted.segment(first[g], n) = whitening.transpose() * group.residual;
            M.block(first[g], first[g], n, n) = whitening.transpose() * whitening;
            const Eigen::MatrixXd of_group = group.jacobian.transpose() * whitening;
            for (std::size_t c = 0; c < group.columns.size(); ++c) {
                pull.block(group.columns[c], first[g], 1, n) = of_group.row(static_cast<Eigen::Index>(c));
            }
        }
        M -= pull.transpose() * Q * pull;
        gain = Q * pull;
    }
    /// Estimates an error of the columns C, rows×q.
    void take_away(const Eigen::MatrixXd& C) {
        const Eigen::MatrixXd inverse = pseudo_inverse(C.transpose() * M * C, 1e-9 * M.diagonal().maxCoeff()).inverse;
        weighted -= M * C * (inverse * (C.transpose() * weighted)).eval();
        M -= (M * C * inverse * C.transpose() * M).eval();
    }
    [[nodiscard]] Eigen::MatrixXd dense(const VisitEffects::Effect& effect, Eigen::Index q) const {
        Eigen::MatrixXd C = Eigen::MatrixXd::Zero(M.rows(), q);
        for (std::size_t g = 0; g < effect.size(); ++g) {
            if (effect[g].size() > 0) {
                C.middleRows(first[g], effect[g].rows()) = effect[g];
            }
        }
        return C;
    }
    void expect_alike(const VisitEffects& visits, const VisitEffects::Effect& effect, Eigen::Index q) const {
        const Eigen::MatrixXd C = dense(effect, q);
        const VisitEffects::Projection found = visits.projection(effect, q);
        const Eigen::VectorXd pulled = C.transpose() * weighted;
        const Eigen::MatrixXd spread = C.transpose() * M * C;
        EXPECT_LT((found.weighted - pulled).norm(), 1e-9 * pulled.norm());
        EXPECT_LT((found.spread - spread).norm(), 1e-9 * spread.norm());
        EXPECT_NEAR(visits.weighted(effect) / pulled[0], 1.0, 1e-9);
        const Eigen::MatrixXd shift = gain * C;
        EXPECT_LT((visits.shift_of_parameters(effect, q) - shift).norm(), 1e-9 * shift.norm());
    }

    synthetic::Campaign campaign;
    std::unique_ptr<JointAdjustment> joint;
    std::unique_ptr<NormalEquations> normal;
    std::unique_ptr<BorderedCovariance> covariance;
    std::vector<Eigen::Index> first;  // row of each visit
    Eigen::VectorXd weighted;         // V⁻¹v
    Eigen::MatrixXd M;
    Eigen::MatrixXd gain;  // of the parameters by the distances
};

/// Three columns at the distances of every other visit.
VisitEffects::Effect effect_of_three(std::size_t visits) {
    synthetic::Noise draw(5);
    VisitEffects::Effect effect(visits);
    for (std::size_t g = 1; g < visits; g += 2) {
        effect[g] = Eigen::MatrixXd::NullaryExpr(6, 3, [&] { return draw.normal(); });
    }
    return effect;
}

TEST(VisitEffects, AreThoseOfAllObservationsAtOnce) {
    DenseVisits all;
    VisitEffects visits(*all.joint, *all.normal, *all.covariance);
    const VisitEffects::Effect effect = effect_of_three(visits.size());
    all.expect_alike(visits, effect, 3);
    const Eigen::Index n = visits.own(3).rows();
    EXPECT_LT((visits.own(3) - all.M.block(all.first[3], all.first[3], n, n)).norm(), 1e-9 * visits.own(3).norm());

    // A visit, and one error of two others, are left out one after the other.
    visits.leave_out(3);
    EXPECT_TRUE(visits.is_out(3));
    VisitEffects::Effect identity(visits.size());
    identity[3] = Eigen::MatrixXd::Identity(n, n);
    all.take_away(all.dense(identity, n));
    all.expect_alike(visits, effect, 3);
    EXPECT_LT(visits.weighted(3).norm(), 1e-6 * visits.weighted(4).norm());

    const std::vector<VisitEffects::Column> columns{{{1, 1.0}, {7, -0.5}}};
    visits.take_away(columns);
    VisitEffects::Effect one(visits.size());
    one[1] = Eigen::MatrixXd::Constant(n, 1, 1.0);
    one[7] = Eigen::MatrixXd::Constant(n, 1, -0.5);
    const Eigen::MatrixXd before = all.dense(effect, 3).transpose() * all.M * all.dense(effect, 3);
    all.take_away(all.dense(one, 1));
    all.expect_alike(visits, effect, 3);
    const Eigen::MatrixXd taken = before - all.dense(effect, 3).transpose() * all.M * all.dense(effect, 3);
    EXPECT_EQ(visits.left_out_count(), 2U);
    EXPECT_LT((visits.taken_from(effect, 3, 1) - taken).norm(), 1e-8 * taken.norm());
    // What was taken away has nothing left, and is not taken away again.
    const Eigen::VectorXd still = visits.weighted(4);
    visits.take_away(columns);
    EXPECT_LT((visits.weighted(4) - still).norm(), 1e-9 * still.norm());
}

TEST(VisitEffects, SumsThatGrowAreThoseOfAllTheirVisits) {
    const DenseVisits all;
    VisitEffects visits(*all.joint, *all.normal, *all.covariance);
    visits.leave_out(2);
    visits.prepare_sums({});
    VisitEffects::GrowingSum growing(visits, all.campaign.measurement.angles.size());
    const VisitEffects::Effect effect = effect_of_three(visits.size());
    VisitEffects::Effect part(visits.size());
    VisitEffects::Sum before;
    for (std::size_t g = 1; g < visits.size(); g += 2) {
        VisitEffects::Seen seen{g, {1, 4}};  // two of its six distances
        growing.add(seen, all.joint->visits()[g].angle, effect[g]);
        part[g] = Eigen::MatrixXd::Zero(6, 3);
        for (const Eigen::Index i : seen.rows) {
            part[g].row(i) = effect[g].row(i);
        }
        const VisitEffects::Projection found = visits.projection(part, 3);
        const VisitEffects::Sum& sum = growing.sum();
        EXPECT_LT((sum.weighted - found.weighted).norm(), 1e-9 * found.weighted.norm());
        const Eigen::Matrix3d spread = sum.weight - sum.of_poses - sum.carried.transpose() * sum.carried;
        EXPECT_LT((spread - found.spread).norm(), 1e-8 * found.spread.norm()) << g;
        EXPECT_EQ(sum.distances, g + 1);
        if (g == 5) {
            before = sum;
        }
    }
    const VisitEffects::Sum rest = growing.sum() - before;
    EXPECT_EQ(rest.distances, growing.sum().distances - before.distances);
    EXPECT_LT((rest.weighted - (growing.sum().weighted - before.weighted)).norm(), 1e-9 * rest.weighted.norm());
    EXPECT_GT(growing.sum().chi_square(), 0.0);
}

TEST(VisitEffects, WhatNothingControlsHasNoInverse) {
    Eigen::Matrix3d matrix = Eigen::Vector3d(4.0, 2.0, 1e-12).asDiagonal();
    const Inverted inverted = pseudo_inverse(matrix, 1e-9);
    EXPECT_EQ(inverted.rank, 2);
    EXPECT_LT((inverted.inverse - Eigen::Matrix3d(Eigen::Vector3d(0.25, 0.5, 0.0).asDiagonal())).norm(), 1e-15);
    EXPECT_EQ(pseudo_inverse(matrix, 1e-13).rank, 3);
}

}  // namespace
}  // namespace gumcert::engine
