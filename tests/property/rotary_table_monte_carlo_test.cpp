// Monte Carlo over the whole adjustment of a rotary table against the law of propagation.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/trials/rotary_table_trials.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert {
namespace {

using engine::JointAdjustment;
using engine::RotaryTableMeasurement;
using engine::RotaryTableModel;
using engine::RotaryTableSolution;
using engine::RotaryTableTrials;
using engine::SourceDegreesOfFreedom;
using engine::synthetic::CampaignPlan;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

CampaignPlan small_plan() {
    CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(12);
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    return plan;
}

CampaignPlan full_plan() {
    CampaignPlan plan = small_plan();
    plan.axis = engine::RotaryAxis::c;
    plan.datum = engine::Datum::home;
    plan.angles_deg = engine::synthetic::full_turn(8);
    plan.both_senses = true;
    plan.dead_paths = engine::synthetic::DeadPaths::per_station_and_reflector;
    plan.start_values = true;
    plan.scale_model = engine::ScaleModel::prior;
    plan.u_scale = 1e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.05;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 1e-6;
    plan.missing_share = 0.05;
    return plan;
}

RotaryTableSolution solve(const RotaryTableMeasurement& measurement) {
    return evaluate_jointly(measurement, engine::EvaluationOptions{});
}

/// Trials from the solution, with degrees of freedom that a test chooses.
std::unique_ptr<RotaryTableTrials> trials_of(const RotaryTableSolution& solution, const SourceDegreesOfFreedom& nu) {
    const auto& model = dynamic_cast<const RotaryTableModel&>(*solution.model);
    JointAdjustment joint(model.measurement(), model.solved().active(), model.solved().set_up(),
                          model.solved().present_values(), solution.stochastic);
    joint.copy_parameters_from(model.solved());
    joint.set_weights(solution.stochastic);
    return std::make_unique<RotaryTableTrials>(joint, solution.stochastic, nu);
}

gum::MonteCarloOptions options(std::uint64_t trials) {
    gum::MonteCarloOptions chosen;
    chosen.trials = trials;
    chosen.seed = 2024;
    chosen.regions = false;
    chosen.histogram = false;
    return chosen;
}

TEST(RotaryTableMonteCarlo, CovarianceIsThatOfTheNormalEquations) {
    CampaignPlan by_angle = full_plan();
    by_angle.reversal_model = engine::ReversalModel::by_angle;
    for (const CampaignPlan& plan : {small_plan(), full_plan(), by_angle}) {
        const auto campaign = simulate(plan);
        const RotaryTableSolution solution = solve(campaign.measurement);
        const RotaryTableTrials trials(dynamic_cast<const RotaryTableModel&>(*solution.model));
        const gum::MonteCarloResult result = run_monte_carlo(trials, options(20000));
        EXPECT_EQ(trials.steps().not_converged, 0U);
        EXPECT_LT(trials.steps().mean(), 3.5);
        for (Eigen::Index i = 0; i < solution.values.size(); ++i) {
            const gum::MonteCarloOutput& output = result.outputs[static_cast<std::size_t>(i)];
            const double u = std::sqrt(solution.covariance(i, i));
            const std::string& name = solution.quantities.outputs[static_cast<std::size_t>(i)].name;
            if (u < 1e-15) {  // zero at home in the home datum
                EXPECT_EQ(output.standard_uncertainty, 0.0) << name;
                continue;
            }
            EXPECT_NEAR(output.standard_uncertainty, u, 5.0 * output.numerical_error.standard_uncertainty) << name;
            EXPECT_NEAR(output.mean, solution.values[i], 5.0 * output.numerical_error.mean) << name;
            for (Eigen::Index k = 0; k < i; ++k) {
                const double u_k = std::sqrt(solution.covariance(k, k));
                if (u_k > 1e-15) {
                    // The standard deviation of a correlation coefficient is below 1/√M.
                    EXPECT_NEAR(result.covariance(i, k) / (u * u_k), solution.covariance(i, k) / (u * u_k),
                                6.0 / std::sqrt(20000.0) * 1.5)
                        << name;
                }
            }
        }
    }
}

TEST(RotaryTableMonteCarlo, SameBytesForAnyNumberOfThreads) {
    const auto campaign = simulate(full_plan());
    const RotaryTableSolution solution = solve(campaign.measurement);
    gum::MonteCarloResult first;
    engine::TrialSteps steps;
    for (const unsigned threads : {1U, 2U, 3U}) {
        const auto trials = trials_of(solution, {9.0, 8.0, 7.0, 6.0});
        gum::MonteCarloOptions chosen = options(5000);
        chosen.threads = threads;
        const gum::MonteCarloResult result = run_monte_carlo(*trials, chosen);
        if (threads == 1) {
            first = result;
            steps = trials->steps();
            continue;
        }
        EXPECT_EQ((result.covariance - first.covariance).cwiseAbs().maxCoeff(), 0.0) << threads;
        for (std::size_t i = 0; i < first.outputs.size(); ++i) {
            EXPECT_EQ(result.outputs[i].mean, first.outputs[i].mean) << threads;
            EXPECT_EQ(result.outputs[i].standard_uncertainty, first.outputs[i].standard_uncertainty) << threads;
            EXPECT_EQ(result.outputs[i].symmetric, first.outputs[i].symmetric) << threads;
            EXPECT_EQ(result.outputs[i].shortest, first.outputs[i].shortest) << threads;
        }
        EXPECT_EQ(trials->steps().trials, steps.trials) << threads;
        EXPECT_EQ(trials->steps().steps, steps.steps) << threads;
        EXPECT_EQ(trials->steps().most, steps.most) << threads;
    }
}

TEST(RotaryTableMonteCarlo, EstimatedVarianceIsSharedByTheWholeComponent) {
    // Perfect table: the error motions come from the length noise alone. With ν = 5 their variance is ν/(ν-2) times as
    // large, and as all lengths share the estimate of the variance, each error motion is t distributed itself. With an
    // estimate for each length they would be almost normal: the quantile for 99.73 % says 5.51 s (t) or 3.87 s (normal
    // with the larger variance).
    CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(12);
    const auto campaign = simulate(plan);
    const RotaryTableSolution solution = solve(campaign.measurement);
    const auto trials = trials_of(solution, {5.0, k_infinity, k_infinity, k_infinity});
    gum::MonteCarloOptions chosen = options(100000);
    chosen.coverage_probability = 0.9973002;
    const gum::MonteCarloResult result = run_monte_carlo(*trials, chosen);
    // The variance of a variance needs the fourth moment, which settles slowly with ν = 5: 2 % at 100 000 trials, and
    // all outputs of a trial share the same factor.
    const double expected = std::sqrt(5.0 / 3.0);
    for (Eigen::Index i = 0; i < solution.quantities.set_up; ++i) {
        const gum::MonteCarloOutput& output = result.outputs[static_cast<std::size_t>(i)];
        const double u = std::sqrt(solution.covariance(i, i));
        const std::string& name = solution.quantities.outputs[static_cast<std::size_t>(i)].name;
        EXPECT_NEAR(output.standard_uncertainty / u, expected, 0.05) << name;
        const double half_width = 0.5 * (output.symmetric.high - output.symmetric.low);
        EXPECT_NEAR(half_width / u, 5.507, 0.5) << name;
    }
}

TEST(RotaryTableMonteCarlo, UniformCoordinatesStayWithinTheirBounds) {
    auto campaign = simulate(small_plan());
    campaign.measurement.fixture_shape = engine::InputShape::uniform;
    const RotaryTableSolution solution = solve(campaign.measurement);
    const RotaryTableTrials trials(dynamic_cast<const RotaryTableModel&>(*solution.model));
    Eigen::Index first = 0;
    const gum::InputGroup* fixture = nullptr;
    for (const gum::InputGroup& group : trials.inputs()) {
        if (group.source == "fixture CMM") {
            fixture = &group;
            break;
        }
        first += group.size();
    }
    ASSERT_NE(fixture, nullptr);
    EXPECT_EQ(fixture->distribution, "uniform");
    const Eigen::VectorXd half_width = (3.0 * campaign.measurement.fixture_covariance.diagonal()).cwiseSqrt();
    double largest = 0.0;
    for (std::uint64_t trial = 0; trial < 500; ++trial) {
        const Eigen::VectorXd x = monte_carlo_trial(trials, 2024, trial);
        const Eigen::VectorXd deviation = (x.segment(first, fixture->size()) - fixture->value).cwiseAbs();
        EXPECT_LE((deviation - half_width).maxCoeff(), 1e-18);
        largest = std::max(largest, deviation.cwiseQuotient(half_width).maxCoeff());
    }
    EXPECT_GT(largest, 0.999);
    // O and S come from the coordinates alone: their standard uncertainty is that of the law of propagation.
    const gum::MonteCarloResult result = run_monte_carlo(trials, options(20000));
    for (Eigen::Index i = solution.quantities.set_up; i < solution.values.size(); ++i) {
        const gum::MonteCarloOutput& output = result.outputs[static_cast<std::size_t>(i)];
        EXPECT_NEAR(output.standard_uncertainty, std::sqrt(solution.covariance(i, i)),
                    5.0 * output.numerical_error.standard_uncertainty)
            << solution.quantities.outputs[static_cast<std::size_t>(i)].name;
    }
}

}  // namespace
}  // namespace gumcert
