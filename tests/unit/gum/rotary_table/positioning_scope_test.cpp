#include "gum/rotary_table/positioning_scope.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "engine/rotary_table/positioning_accuracy.h"
#include "gum/rotary_table/evaluate_rotary_table.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::gum {
namespace {

/// Repeated runs of a table that scatters by `u_axial` about its axis and errs by `error_factor` times its motions.
engine::TableParameterModel repeated_runs(std::size_t runs, double u_axial, double error_factor,
                                          bool both_senses = false, int angles = 6, std::uint64_t seed = 1) {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(angles);
    plan.both_senses = both_senses;
    plan.seed = seed;
    plan.start_values = true;
    plan.runs = runs;
    plan.table_axial = u_axial;
    plan.error_factor = error_factor;
    RotaryTableRequest request;
    request.measurement = engine::synthetic::simulate(plan).measurement;
    return *evaluate_rotary_table(request, 1).parameter_model;
}

/// Standard deviation of the runs, pooled over the targets: all have as many runs.
double pooled_deviation(const engine::TableParameterModel& model) {
    double squares = 0.0;
    double degrees = 0.0;
    for (const std::vector<Eigen::Index>& target : model.parameters()->runs().up) {
        const Eigen::VectorXd x = model.nominal_positions()(target);
        squares += (x.array() - x.mean()).square().sum();
        degrees += static_cast<double>(x.size() - 1);
    }
    return std::sqrt(squares / degrees);
}

TEST(PositioningScope, ParametersThatRestOnScatterAreThoseThatNeedTwoRuns) {
    const engine::PositioningRuns one{{{0}, {1}}, {{2}, {3}}};
    const engine::PositioningRuns two{{{0, 4}, {1, 5}}, {{2, 6}, {3, 7}}};
    const auto of_one = engine::allowed_parameters(one);
    const auto of_two = engine::allowed_parameters(two);
    int resting = 0;
    for (std::size_t i = 0; i < engine::k_positioning_parameters; ++i) {
        const std::string name(engine::positioning_parameter_names()[i]);
        EXPECT_TRUE(of_two[i]) << name;
        EXPECT_EQ(rests_on_scatter(name), !of_one[i]) << name;
        resting += rests_on_scatter(name) ? 1 : 0;
    }
    EXPECT_EQ(resting, 6);
    EXPECT_FALSE(rests_on_scatter("EAA"));
    EXPECT_FALSE(rests_on_scatter("axis_b"));
    EXPECT_FALSE(rests_on_scatter(""));
}

/// What holds noise already is what is not a mean of deviations: it grows, on average, where noise is added to exact
/// deviations; a mean does not. Over all parameters of a table.
TEST(PositioningScope, WhatHoldsNoiseAlreadyGrowsWithNoise) {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(6);
    plan.both_senses = true;
    plan.start_values = true;
    plan.runs = 2;
    plan.noise = 0.0;
    plan.error_factor = 0.0;
    RotaryTableRequest request;
    request.measurement = engine::synthetic::simulate(plan).measurement;
    const RotaryTableResult result = evaluate_rotary_table(request, 1);
    const engine::TableParameters& parameters = *result.parameter_model->parameters();
    const Eigen::VectorXd& nominal = result.reported.budget.value;
    const Eigen::VectorXd positions = Eigen::VectorXd::Zero(result.parameter_model->nominal_positions().size());
    const auto count = static_cast<Eigen::Index>(parameters.outputs().size());
    constexpr int k_trials = 200;
    Eigen::MatrixXd change(count, k_trials);
    Eigen::VectorXd exact(count);
    parameters.values(nominal, positions, exact);
    std::mt19937_64 generator(7);
    std::normal_distribution<double> normal(0.0, 1e-6);
    for (Eigen::Index t = 0; t < k_trials; ++t) {
        const auto noisy = [&](const Eigen::VectorXd& of) {
            return Eigen::VectorXd(of + Eigen::VectorXd::NullaryExpr(of.size(), [&] { return normal(generator); }));
        };
        Eigen::VectorXd value(count);
        parameters.values(noisy(nominal), noisy(positions), value);
        change.col(t) = value - exact;
    }
    int holding = 0;
    for (Eigen::Index i = 0; i < count; ++i) {
        const double mean = change.row(i).mean();
        const double spread = std::sqrt((change.row(i).array() - mean).square().sum() / (k_trials - 1.0));
        const bool grows = mean > 5.0 * spread / std::sqrt(static_cast<double>(k_trials));
        EXPECT_EQ(holds_noise_already(parameters, i), grows) << parameters.outputs()[static_cast<std::size_t>(i)].name;
        holding += holds_noise_already(parameters, i) ? 1 : 0;
    }
    EXPECT_EQ(holding, 6 + 11);
}

TEST(PositioningScope, StatesScatterOnlyWhereItStatesAnything) {
    PositioningScope scope;
    EXPECT_FALSE(scope.states("E"));
    scope.scatter_stated = true;
    EXPECT_FALSE(scope.states("E"));
    EXPECT_FALSE(scope.states("R"));
    scope.stated = true;
    EXPECT_TRUE(scope.states("E"));
    EXPECT_TRUE(scope.states("R_up"));
    EXPECT_FALSE(scope.states("B"));
    scope.scatter_stated = false;
    scope.reversal_stated = true;
    EXPECT_TRUE(scope.states("B"));
    EXPECT_FALSE(scope.states("A_down"));
    scope.reversal_stated = false;
    EXPECT_FALSE(scope.states("B"));
    EXPECT_TRUE(scope.states("B_mean"));
    EXPECT_TRUE(scope.states("E"));
}

TEST(PositioningScope, ATableThatScattersMoreThanItsMeasurementHasAllParameters) {
    const engine::TableParameterModel model = repeated_runs(2, 10e-6, 5.0);
    const PositioningScope scope = positioning_scope(model);
    EXPECT_DOUBLE_EQ(scope.largest_ratio, 0.25);
    EXPECT_DOUBLE_EQ(scope.u_deviation, model.rms_position_uncertainty());
    EXPECT_NEAR(scope.s_runs, pooled_deviation(model), 1e-12 * scope.s_runs);
    EXPECT_GT(scope.s_runs, 2.0 * scope.u_deviation);
    EXPECT_TRUE(scope.stated);
    EXPECT_TRUE(scope.scatter_stated);
}

TEST(PositioningScope, RunsThatScatterByTheirMeasurementHaveNoRepeatability) {
    const engine::TableParameterModel model = repeated_runs(2, 1e-9, 5.0);
    const PositioningScope scope = positioning_scope(model);
    EXPECT_NEAR(scope.s_runs, pooled_deviation(model), 1e-12 * scope.s_runs);
    EXPECT_TRUE(scope.stated);
    EXPECT_FALSE(scope.scatter_stated);
    EXPECT_TRUE(scope.states("E_up"));
    EXPECT_FALSE(scope.states("R_up"));
}

/// The largest of many uncertain reversals is too large by more than its uncertainty; their mean is not.
TEST(PositioningScope, ReversalsThatDifferByTheirMeasurementHaveNoLargest) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        const PositioningScope noise = positioning_scope(repeated_runs(1, 1e-9, 5.0, true, 12, seed));
        EXPECT_TRUE(noise.stated);
        EXPECT_GT(noise.reversal_share, 0.4) << seed;
        EXPECT_FALSE(noise.states("B")) << seed;
        EXPECT_TRUE(noise.states("B_mean")) << seed;
        const PositioningScope table = positioning_scope(repeated_runs(1, 10e-6, 5.0, true, 12, seed));
        EXPECT_LT(table.reversal_share, 0.3) << seed;
        EXPECT_TRUE(table.states("B")) << seed;
        for (const double u_axial : {0.3e-6, 1e-6, 3e-6}) {
            const PositioningScope scope = positioning_scope(repeated_runs(1, u_axial, 5.0, true, 12, seed));
            EXPECT_EQ(scope.states("B"),
                      scope.states("R") || (scope.stated && scope.reversal_share <= k_largest_reversal_share))
                << seed << ", " << u_axial;
        }
    }
}

/// The share is that of the differences of means of runs, by a second path.
TEST(PositioningScope, TheShareOfReversalsIsThatOfTheirMeans) {
    const engine::TableParameterModel model = repeated_runs(2, 2e-6, 5.0, true);
    const PositioningScope scope = positioning_scope(model);
    const engine::PositioningRuns& runs = model.parameters()->runs();
    Eigen::VectorXd reversals(static_cast<Eigen::Index>(runs.up.size()));
    double noise = 0.0;
    for (std::size_t i = 0; i < runs.up.size(); ++i) {
        const Eigen::VectorXd up = model.nominal_positions()(runs.up[i]);
        const Eigen::VectorXd down = model.nominal_positions()(runs.down[i]);
        reversals[static_cast<Eigen::Index>(i)] = up.mean() - down.mean();
        noise += std::pow(scope.u_deviation, 2) *
                 (1.0 / static_cast<double>(up.size()) + 1.0 / static_cast<double>(down.size()));
    }
    const double variance =
        (reversals.array() - reversals.mean()).square().sum() / static_cast<double>(reversals.size() - 1);
    EXPECT_NEAR(scope.reversal_share, noise / static_cast<double>(runs.up.size()) / variance,
                1e-9 * scope.reversal_share);
}

TEST(PositioningScope, AnIdealTableHasNoParameters) {
    const engine::TableParameterModel model = repeated_runs(1, 1e-9, 0.0);
    const PositioningScope scope = positioning_scope(model);
    const double range = *model.positioning()[engine::PositioningParameter::systematic_up];
    EXPECT_GT(range, 0.0);
    EXPECT_GT(scope.u_deviation, 0.25 * range) << "what it seems to err by is noise";
    EXPECT_FALSE(scope.stated);
    EXPECT_FALSE(scope.states("E_up"));
    EXPECT_FALSE(scope.states("R_up"));
}

}  // namespace
}  // namespace gumcert::gum
