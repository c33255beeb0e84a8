// Times of the calibration of a rotary table: 6 stations, 6 reflectors, 36 angles, 1296 distances.
//
// With --write-campaign FILE the program times nothing and writes the simulated campaign, its start values and its
// solution, for scipy_rotary_table.py to solve the same and compare.
#include <benchmark/benchmark.h>

#include <Eigen/Core>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <string_view>

#include "engine/rotary_table/anglewise_map.h"
#include "engine/rotary_table/evaluation/rotary_table_evaluation.h"
#include "engine/rotary_table/start/start_values.h"
#include "engine/rotary_table/trials/rotary_table_trials.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/propagation.h"
#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

using synthetic::Campaign;
using synthetic::CampaignPlan;

/// Perfect table and known weights: what the peer can solve, too.
const Campaign& stated_weights() {
    static const Campaign campaign = simulate(CampaignPlan{});
    return campaign;
}

/// A commercial table whose repeatability is estimated, with outlying distances to be found: the usual job.
const Campaign& estimated_weights() {
    static const Campaign campaign = [] {
        CampaignPlan plan;
        plan.table_linear = 0.3e-6;
        plan.table_axial = 5e-6;
        plan.table_tilt = 1.7e-6;
        plan.outliers = 3;
        plan.outlier_size = 10.0 * synthetic::k_um;
        Campaign simulated = simulate(plan);
        RotaryTableMeasurement& measurement = simulated.measurement;
        measurement.table_repeatability = {RepeatabilityMode::estimate, 0.0, 0.0, 0.0};
        measurement.estimate_length_noise = true;
        measurement.outliers.test = OutlierTest::data_snooping;
        return simulated;
    }();
    return campaign;
}

StochasticModel weights_of(const RotaryTableMeasurement& measurement) {
    const TableRepeatability& table = measurement.table_repeatability;
    return {1.0, table.u_linear * table.u_linear, table.u_axial * table.u_axial, table.u_tilt * table.u_tilt};
}

/// At its start values, with T_s the identity as in the first adjustment of an evaluation.
JointAdjustment at_start(const Campaign& campaign) {
    const RotaryTableMeasurement& measurement = campaign.measurement;
    return {measurement, std::vector<bool>(measurement.lengths.size(), true), RigidMotion{},
            find_start_values(measurement), weights_of(measurement)};
}

JointAdjustment solved(const Campaign& campaign) {
    JointAdjustment adjustment = at_start(campaign);
    if (!adjustment.adjustment().solve(SolverOptions{}).converged) {
        std::cerr << "rotary_table: the adjustment did not converge\n";
        std::exit(EXIT_FAILURE);
    }
    return adjustment;
}

/// Covariance of the error motions at all angles and of the set-up errors, 220×220.
Eigen::MatrixXd reported_covariance(const JointAdjustment& adjustment) {
    const NormalEquations normal = adjustment.adjustment().linearise();
    const DatumSolution datum = transform_to_datum(adjustment.measurement(), adjustment.poses(), adjustment.set_up(),
                                                   adjustment.measurement().datum);
    return covariance_of(reported_map(adjustment, normal, datum), adjustment, normal, normal.bordered_covariance())
        .dense();
}

void start_values(benchmark::State& state) {
    const Campaign& campaign = stated_weights();
    for (auto _ : state) {
        benchmark::DoNotOptimize(find_start_values(campaign.measurement));
    }
}

void solve(benchmark::State& state) {
    const JointAdjustment prepared = at_start(stated_weights());
    for (auto _ : state) {
        state.PauseTiming();
        JointAdjustment adjustment = prepared;
        state.ResumeTiming();
        const SolveSummary summary = adjustment.adjustment().solve(SolverOptions{});
        if (!summary.converged) {
            state.SkipWithError("not converged");
            break;
        }
    }
}

void covariance_of_parameters(benchmark::State& state) {
    const JointAdjustment adjustment = solved(stated_weights());
    for (auto _ : state) {
        benchmark::DoNotOptimize(adjustment.adjustment().linearise().covariance());
    }
}

void covariance_of_errors(benchmark::State& state) {
    const JointAdjustment adjustment = solved(stated_weights());
    for (auto _ : state) {
        benchmark::DoNotOptimize(reported_covariance(adjustment));
    }
}

void variance_component_step(benchmark::State& state) {
    const JointAdjustment adjustment = solved(stated_weights());
    const NormalEquations normal = adjustment.adjustment().linearise();
    const BorderedCovariance covariance = normal.bordered_covariance();
    const StochasticModel present = weights_of(stated_weights().measurement);
    for (auto _ : state) {
        benchmark::DoNotOptimize(estimate_variance_components(adjustment, normal, covariance, present, {true, true}));
    }
}

void evaluate_stated_weights(benchmark::State& state) {
    const Campaign& campaign = stated_weights();
    for (auto _ : state) {
        benchmark::DoNotOptimize(evaluate_jointly(campaign.measurement, EvaluationOptions{}));
    }
}

void evaluate_estimated_weights(benchmark::State& state) {
    const Campaign& campaign = estimated_weights();
    for (auto _ : state) {
        benchmark::DoNotOptimize(evaluate_jointly(campaign.measurement, EvaluationOptions{}));
    }
}

void propagate(benchmark::State& state) {
    const RotaryTableSolution solution = evaluate_jointly(stated_weights().measurement, EvaluationOptions{});
    for (auto _ : state) {
        benchmark::DoNotOptimize(gum::propagate(*solution.model, 0.9545));
    }
}

/// Table with repeatability, so that every visit has deviations of its own to draw: the largest number of inputs.
Campaign with_repeatability(int angles) {
    CampaignPlan plan;
    plan.angles_deg = synthetic::full_turn(angles);
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    return simulate(plan);
}

/// Both senses of approach, scale with a prior, uncertain expansion and temperatures: as many unknowns as in a real
/// job.
Campaign with_temperatures() {
    CampaignPlan plan;
    plan.table_linear = 0.3e-6;
    plan.table_axial = 5e-6;
    plan.table_tilt = 1.7e-6;
    plan.both_senses = true;
    plan.scale_model = ScaleModel::prior;
    plan.u_scale = 1.5e-7;
    plan.temperature_difference = 1.2;
    plan.u_temperature = 0.05;
    plan.expansion = 11.5e-6;
    plan.u_expansion = 0.5e-6;
    return simulate(plan);
}

/// The Monte Carlo method with all its statistics: every trial solves the whole adjustment again.
void run_trials(benchmark::State& state, const Campaign& campaign) {
    const RotaryTableSolution solution = evaluate_jointly(campaign.measurement, EvaluationOptions{});
    const RotaryTableTrials trials(dynamic_cast<const RotaryTableModel&>(*solution.model));
    gum::MonteCarloOptions options;
    options.trials = 100'000;
    options.threads = static_cast<unsigned>(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(gum::run_monte_carlo(trials, options));
    }
    const auto done = static_cast<double>(options.trials) * static_cast<double>(state.iterations());
    state.counters["trials/s"] = benchmark::Counter(done, benchmark::Counter::kIsRate);
    state.counters["steps"] = trials.steps().mean();
}

void monte_carlo(benchmark::State& state) {
    run_trials(state, with_repeatability(36));
}

void monte_carlo_with_temperatures(benchmark::State& state) {
    run_trials(state, with_temperatures());
}

/// Standard uncertainties of the same and the 6×6 covariance of every angle, without a matrix of all quantities.
double reported_uncertainties(const JointAdjustment& adjustment) {
    const NormalEquations normal = adjustment.adjustment().linearise();
    const DatumSolution datum = transform_to_datum(adjustment.measurement(), adjustment.poses(), adjustment.set_up(),
                                                   adjustment.measurement().datum);
    const AnglewiseCovariance covariance =
        covariance_of(reported_map(adjustment, normal, datum), adjustment, normal, normal.bordered_covariance());
    double sum = covariance.diagonal().cwiseSqrt().sum();
    for (std::size_t i = 0; i < adjustment.measurement().angles.size(); ++i) {
        sum += covariance.of_angle(static_cast<Eigen::Index>(i)).sum();
    }
    return sum;
}

// Growth with the number of angles. Everything but the covariance of all reported quantities grows in proportion: that
// one has (6N)² elements, and its time grows with their number.

void growth_solve(benchmark::State& state) {
    const Campaign campaign = with_repeatability(static_cast<int>(state.range(0)));
    const JointAdjustment prepared = at_start(campaign);
    for (auto _ : state) {
        state.PauseTiming();
        JointAdjustment adjustment = prepared;
        state.ResumeTiming();
        if (!adjustment.adjustment().solve(SolverOptions{}).converged) {
            state.SkipWithError("not converged");
            break;
        }
    }
    state.counters["s/angle"] = benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void growth_uncertainties(benchmark::State& state) {
    const Campaign campaign = with_repeatability(static_cast<int>(state.range(0)));
    const JointAdjustment adjustment = solved(campaign);
    for (auto _ : state) {
        benchmark::DoNotOptimize(reported_uncertainties(adjustment));
    }
    state.counters["s/angle"] = benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void growth_covariance(benchmark::State& state) {
    const Campaign campaign = with_repeatability(static_cast<int>(state.range(0)));
    const JointAdjustment adjustment = solved(campaign);
    for (auto _ : state) {
        benchmark::DoNotOptimize(reported_covariance(adjustment));
    }
    state.counters["s/angle"] = benchmark::Counter(static_cast<double>(state.iterations() * state.range(0)),
                                                   benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void growth_trials(benchmark::State& state) {
    const Campaign campaign = with_repeatability(static_cast<int>(state.range(0)));
    constexpr double k_infinity = std::numeric_limits<double>::infinity();
    const RotaryTableTrials trials(solved(campaign), weights_of(campaign.measurement),
                                   {k_infinity, k_infinity, k_infinity, k_infinity});
    // Drawn as the Monte Carlo method does, 64 trials at a time.
    const gum::InputDraws draws(trials.inputs(), 1, {});
    Eigen::MatrixXd x(64, draws.size());
    Eigen::MatrixXd y(64, static_cast<Eigen::Index>(trials.outputs().size()));
    std::uint64_t first = 0;
    for (auto _ : state) {
        draws.draw(first, x);
        trials.evaluate_trials(x, y);
        benchmark::DoNotOptimize(y.data());
        first += 64;
    }
    state.counters["s/trial/angle"] = benchmark::Counter(static_cast<double>(64 * state.iterations() * state.range(0)),
                                                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK(start_values)->Unit(benchmark::kMillisecond);
BENCHMARK(solve)->Unit(benchmark::kMillisecond);
BENCHMARK(covariance_of_parameters)->Unit(benchmark::kMillisecond);
BENCHMARK(covariance_of_errors)->Unit(benchmark::kMillisecond);
BENCHMARK(variance_component_step)->Unit(benchmark::kMillisecond);
BENCHMARK(evaluate_stated_weights)->Unit(benchmark::kMillisecond);
BENCHMARK(evaluate_estimated_weights)->Unit(benchmark::kMillisecond);
BENCHMARK(propagate)->Unit(benchmark::kMillisecond);
BENCHMARK(monte_carlo)->Arg(1)->Arg(2)->MeasureProcessCPUTime()->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(monte_carlo_with_temperatures)
    ->Arg(1)
    ->Arg(2)
    ->MeasureProcessCPUTime()
    ->UseRealTime()
    ->Unit(benchmark::kMillisecond);
BENCHMARK(growth_solve)->Arg(36)->Arg(360)->Arg(3600)->Unit(benchmark::kMillisecond);
BENCHMARK(growth_uncertainties)->Arg(36)->Arg(360)->Arg(3600)->Unit(benchmark::kMillisecond);
BENCHMARK(growth_covariance)->Arg(36)->Arg(360)->Arg(720)->Unit(benchmark::kMillisecond);
BENCHMARK(growth_trials)->Arg(36)->Arg(360)->Arg(3600)->Unit(benchmark::kMillisecond);

/// One number of the campaign, by what it is and where: i, j and k are explained in scipy_rotary_table.py.
void write(std::ostream& file, std::string_view kind, std::array<Eigen::Index, 3> where, double value, double u = 0.0) {
    const auto text = [](double number) {
        std::array<char, 32> buffer{};
        const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), number).ptr;
        return std::string(buffer.data(), end);
    };
    file << kind << ',' << where[0] << ',' << where[1] << ',' << where[2] << ',' << text(value) << ',' << text(u)
         << '\n';
}

bool write_campaign(const std::string& name) {
    const Campaign& campaign = stated_weights();
    const RotaryTableMeasurement& measurement = campaign.measurement;
    const JointAdjustment start = at_start(campaign);
    const JointAdjustment adjustment = solved(campaign);
    const NormalEquations normal = adjustment.adjustment().linearise();
    const Eigen::VectorXd u = normal.covariance().diagonal().cwiseSqrt();
    const Eigen::VectorXd u_reported = reported_covariance(adjustment).diagonal().cwiseSqrt();

    std::ofstream file(name);
    file << "kind,i,j,k,value,u\n";
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        write(file, "angle", {static_cast<Eigen::Index>(i), 0, 0}, measurement.angles[i]);
    }
    for (Eigen::Index m = 0; m < measurement.fixture.rows(); ++m) {
        for (Eigen::Index c = 0; c < 3; ++c) {
            write(file, "fixture", {m, c, 0}, measurement.fixture(m, c),
                  std::sqrt(measurement.fixture_covariance(3 * m + c, 3 * m + c)));
        }
    }
    // The weights of the adjustment are those of its start values.
    for (std::size_t v = 0; v < start.visits().size(); ++v) {
        const Visit& visit = start.visits()[v];
        const Eigen::VectorXd variance = start.stated_variance(v);
        for (std::size_t k = 0; k < visit.observations.size(); ++k) {
            const LengthObservation& length = measurement.lengths[visit.observations[k]];
            write(file, "length",
                  {static_cast<Eigen::Index>(length.angle), static_cast<Eigen::Index>(length.reflector),
                   static_cast<Eigen::Index>(length.station)},
                  length.length, std::sqrt(variance[static_cast<Eigen::Index>(k)]));
        }
    }
    const auto write_block = [&](std::string_view kind, Eigen::Index index, Adjustment::BlockId block, int size) {
        for (int c = 0; c < size; ++c) {
            const Eigen::Index column = normal.column(block, c);
            write(file, kind, {index, c, 0}, adjustment.adjustment().parameters(block)[c],
                  column < 0 ? 0.0 : u[column]);
        }
    };
    for (std::size_t j = 0; j < measurement.stations.size(); ++j) {
        const auto at = static_cast<Eigen::Index>(j);
        for (int c = 0; c < 3; ++c) {
            write(file, "start_station", {at, c, 0}, start.adjustment().parameters(start.station_block(j))[c]);
        }
        write(file, "start_dead_path", {at, 0, 0}, start.adjustment().parameters(start.dead_path_block(j))[0]);
        write_block("solved_station", at, adjustment.station_block(j), 3);
        write_block("solved_dead_path", at, adjustment.dead_path_block(j), 1);
    }
    for (Eigen::Index c = 0; c < 3 * measurement.fixture.rows(); ++c) {
        write(file, "solved_fixture", {c / 3, c % 3, 0},
              adjustment.adjustment().parameters(adjustment.fixture_block())[c],
              u[normal.column(adjustment.fixture_block(), static_cast<int>(c))]);
    }
    for (std::size_t i = 0; i < measurement.angles.size(); ++i) {
        write_block("solved_pose", static_cast<Eigen::Index>(i), adjustment.pose_block(i), 6);
    }
    for (Eigen::Index i = 0; i < u_reported.size(); ++i) {
        write(file, "reported", {i, 0, 0}, 0.0, u_reported[i]);
    }
    file.close();
    if (!file) {
        std::cerr << "rotary_table: " << name << " cannot be written\n";
    }
    return static_cast<bool>(file);
}

}  // namespace
}  // namespace gumcert::engine

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (argc == 3 && std::string_view(argv[1]) == "--write-campaign") {
        return gumcert::engine::write_campaign(argv[2]) ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return EXIT_SUCCESS;
}
