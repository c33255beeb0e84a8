// Variance components are recovered from simulated campaigns within what is stated of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/rotary_table_evaluation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

/// Campaign whose components are to be estimated, from start values that say nothing of the truth.
Campaign to_estimate(const CampaignPlan& plan) {
    Campaign campaign = simulate(plan);
    campaign.measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
    campaign.measurement.estimate_length_noise = true;
    return campaign;
}

CampaignPlan real_table() {
    CampaignPlan plan;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 5e-6 / 3.0;
    return plan;
}

bool has_note(const RotaryTableSolution& solution, const char* code) {
    return std::any_of(solution.notes.begin(), solution.notes.end(),
                       [code](const gum::Diagnostic& note) { return note.code == code; });
}

TEST(VarianceComponents, AreRecoveredWithinTheirStatedUncertainty) {
    // Fisher information of the same four components by an independent program (tools/rotary_model_check.py, D4, with
    // the tilt added) at the true values.
    const std::array<double, 4> relative{0.0280, 0.0823, 0.0793, 0.0926};
    const std::array<double, 4> redundancy{719.5, 93.7, 119.7, 117.4};
    double squares = 0.0;
    constexpr int k_campaigns = 6;
    for (int k = 0; k < k_campaigns; ++k) {
        CampaignPlan plan = real_table();
        plan.axis = std::array{RotaryAxis::a, RotaryAxis::b, RotaryAxis::c}[static_cast<std::size_t>(k % 3)];
        plan.seed = 2000 + static_cast<std::uint64_t>(k);
        const RotaryTableSolution solution = evaluate_jointly(to_estimate(plan).measurement, EvaluationOptions{});
        ASSERT_EQ(solution.components.size(), 4U);
        EXPECT_FALSE(has_note(solution, "GC-VARIANCE-0001")) << "not converged";
        const std::array<double, 4> truth{plan.u_constant, plan.table_linear, plan.table_axial, plan.table_tilt};
        for (std::size_t c = 0; c < 4; ++c) {
            const VarianceComponent& component = solution.components[c];
            EXPECT_TRUE(component.estimated);
            EXPECT_EQ(component.angular, c >= 2);
            // u grows with the estimate: a low estimate states a low u, and the truth looks further off than it is.
            const double u = std::max(component.u, relative[c] * truth[c]);
            EXPECT_LT(std::abs(component.value - truth[c]), 3.0 * u) << component.name << ", seed " << plan.seed;
            // u of a standard deviation from ν degrees of freedom: s/sqrt(2ν).
            EXPECT_NEAR(component.u / component.value * std::sqrt(2.0 * component.degrees_of_freedom), 1.0, 1e-9)
                << component.name;
            squares += std::pow((component.value - truth[c]) / component.u, 2) / (4.0 * k_campaigns);
        }
        for (std::size_t c = 0; c < 4; ++c) {
            const VarianceComponent& component = solution.components[c];
            EXPECT_NEAR(component.u / component.value / relative[c], 1.0, c == 0 ? 0.1 : 0.4) << component.name;
            EXPECT_NEAR(component.redundancy / redundancy[c], 1.0, c == 0 ? 0.1 : 0.4) << component.name;
        }
        // At convergence of restricted maximum likelihood the residuals fill the degrees of freedom, up to what the CMM
        // coordinates (not estimated, 18 observations) differ from theirs.
        EXPECT_NEAR(solution.chi_square / static_cast<double>(solution.degrees_of_freedom), 1.0, 0.03);
    }
    // 24 normalised deviations, nearly independent: their rms is 1 ± 0.14.
    EXPECT_GT(std::sqrt(squares), 0.6);
    EXPECT_LT(std::sqrt(squares), 1.4);
}

TEST(VarianceComponents, ComponentsAreAFixedPoint) {
    const CampaignPlan plan = real_table();
    const Campaign campaign = to_estimate(plan);
    const RotaryTableMeasurement& measurement = campaign.measurement;
    const RotaryTableSolution solution = evaluate_jointly(measurement, EvaluationOptions{});
    JointAdjustment adjustment(measurement, std::vector<bool>(measurement.lengths.size(), true),
                               rigid_motion(solution.datum.set_up),
                               StartValues{campaign.truth.stations, solution.dead_paths}, solution.stochastic);
    ASSERT_TRUE(adjustment.adjustment().solve(SolverOptions{}).converged);
    adjustment.set_weights(solution.stochastic);
    ASSERT_TRUE(adjustment.adjustment().refine(SolverOptions{}).converged);
    const NormalEquations normal = adjustment.adjustment().linearise();
    const VarianceComponentStep step =
        estimate_variance_components(adjustment, normal, normal.covariance(), solution.stochastic, {});
    EXPECT_LT(step.relative_change, 1e-4);
    EXPECT_NEAR(step.stochastic.length_factor / solution.stochastic.length_factor, 1.0, 1e-5);
    EXPECT_NEAR(step.stochastic.variance_linear / solution.stochastic.variance_linear, 1.0, 1e-4);
    EXPECT_NEAR(step.stochastic.variance_axial / solution.stochastic.variance_axial, 1.0, 1e-4);
    EXPECT_NEAR(step.stochastic.variance_tilt / solution.stochastic.variance_tilt, 1.0, 1e-4);
    // Redundancies of the components and of the priors add to the degrees of freedom: Σ θ tr(R V_k) = tr(R V).
    double redundancy = 0.0;
    for (const VarianceComponent& component : step.components) {
        redundancy += component.redundancy;
    }
    const LinearisedGroup& prior = normal.groups()[adjustment.fixture_prior()];
    const Eigen::MatrixXd covariance = normal.covariance();
    const Eigen::MatrixXd local = covariance(prior.columns, prior.columns);
    redundancy +=
        static_cast<double>(prior.residual.size()) - (prior.jacobian * local * prior.jacobian.transpose()).trace();
    EXPECT_NEAR(redundancy, static_cast<double>(solution.degrees_of_freedom), 1e-3);
}

TEST(VarianceComponents, LengthNoiseStatedWrongIsCorrected) {
    CampaignPlan plan;
    plan.seed = 9;
    Campaign campaign = simulate(plan);
    campaign.measurement.length_uncertainty.u_constant *= 3.0;
    campaign.measurement.length_uncertainty.u_proportional *= 3.0;
    campaign.measurement.estimate_length_noise = true;
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_NEAR(solution.stochastic.length_factor, 1.0 / 9.0, 0.15 / 9.0);
    EXPECT_LT(std::abs(solution.components[0].value - plan.u_constant), 3.0 * solution.components[0].u);
    // Components that are given are not touched and rest on what was stated.
    for (std::size_t c = 1; c < 4; ++c) {
        EXPECT_FALSE(solution.components[c].estimated);
        EXPECT_EQ(solution.components[c].u, 0.0);
        EXPECT_TRUE(std::isinf(solution.components[c].degrees_of_freedom));
    }
}

TEST(VarianceComponents, PerfectTableHasNoRepeatabilityToSpeakOf) {
    for (const std::uint64_t seed : {60U, 61U, 62U, 63U}) {
        CampaignPlan plan;
        plan.seed = seed;
        const RotaryTableSolution solution = evaluate_jointly(to_estimate(plan).measurement, EvaluationOptions{});
        EXPECT_FALSE(has_note(solution, "GC-VARIANCE-0001")) << "not converged";
        EXPECT_LT(std::abs(solution.components[0].value - plan.u_constant), 3.0 * solution.components[0].u);
        for (std::size_t c = 1; c < 4; ++c) {
            const VarianceComponent& component = solution.components[c];
            EXPECT_GE(component.value, 0.0);
            EXPECT_LT(component.value, component.angular ? 0.8e-6 : 0.1e-6) << component.name << ", seed " << seed;
            EXPECT_GT(component.u, 0.0);
            EXPECT_LT(component.value, 4.0 * component.u) << component.name << ", seed " << seed;
            EXPECT_TRUE(std::isfinite(component.u));
        }
        EXPECT_TRUE(solution.covariance.allFinite());
    }
}

TEST(VarianceComponents, SingleDistanceAVisitKeepsTheLengthNoiseAsStated) {
    CampaignPlan plan = real_table();
    plan.one_reflector_a_pass = true;
    plan.dead_paths = synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.seed = 5;
    const Campaign campaign = to_estimate(plan);
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    EXPECT_EQ(solution.stochastic.length_factor, 1.0);
    EXPECT_FALSE(solution.components[0].estimated);
    EXPECT_EQ(solution.components[0].value, plan.u_constant);
    EXPECT_TRUE(std::isinf(solution.components[0].degrees_of_freedom));
    EXPECT_TRUE(has_note(solution, "GC-VARIANCE-0002"));
    const std::array<double, 4> truth{plan.u_constant, plan.table_linear, plan.table_axial, plan.table_tilt};
    for (std::size_t c = 1; c < 4; ++c) {
        EXPECT_LT(std::abs(solution.components[c].value - truth[c]), 3.0 * solution.components[c].u)
            << solution.components[c].name;
    }
    const Eigen::VectorXd truth_values = campaign.true_values(false);
    const Eigen::VectorXd normalised =
        (solution.values - truth_values).array() / solution.covariance.diagonal().array().sqrt();
    EXPECT_NEAR(std::sqrt(normalised.squaredNorm() / static_cast<double>(normalised.size())), 1.0, 0.3);
}

}  // namespace
}  // namespace gumcert::engine
