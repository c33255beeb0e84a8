// Prints every digit of some Monte Carlo trials of a rotary table. The test runs it built for each width of registers.

#include <cstdio>
#include <memory>

#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/trials/rotary_table_trials.h"
#include "gum/monte_carlo/random_draws.h"
#include "tests/support/synthetic_campaign.h"

#ifndef GUMCERT_REGISTERS
#define GUMCERT_REGISTERS "sse2"
#endif

namespace {

using namespace gumcert;

constexpr int k_skipped = 77;

/// Both senses, a scale with a prior and uncertain temperatures: every kernel has work.
engine::RotaryTableMeasurement measurement() {
    engine::synthetic::CampaignPlan plan;
    plan.angles_deg = engine::synthetic::full_turn(12);
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    plan.both_senses = true;
    plan.scale_model = engine::ScaleModel::prior;
    plan.u_scale = 1.5e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.05;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 0.5e-6;
    return engine::synthetic::simulate(plan).measurement;
}

void print_trials() {
    const engine::RotaryTableSolution solution = engine::evaluate_jointly(measurement(), engine::EvaluationOptions{});
    const engine::RotaryTableTrials trials(dynamic_cast<const engine::RotaryTableModel&>(*solution.model));
    const gum::InputDraws draws(trials.inputs(), 1, {});
    constexpr Eigen::Index k_trials = 100;  // no multiple of the trials that are computed side by side
    Eigen::MatrixXd x(k_trials, draws.size());
    Eigen::MatrixXd y(k_trials, static_cast<Eigen::Index>(trials.outputs().size()));
    draws.draw(0, x);
    trials.evaluate_trials(x, y);
    for (const double value : y.reshaped()) {
        std::printf("%a\n", value);
    }
}

}  // namespace

int main() {
    if (__builtin_cpu_supports(GUMCERT_REGISTERS) == 0) {
        std::printf("this machine has no %s registers\n", GUMCERT_REGISTERS);
        return k_skipped;
    }
    print_trials();
    return 0;
}
