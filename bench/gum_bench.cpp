// Times of the GUM engine: the gauge block of JCGM 101:2008, 9.5, by Monte Carlo and by the law of propagation, and
// sums of many inputs by the law of propagation.
//
// With --write-values FILE the program times nothing and writes what it finds for the gauge block, for gum_table.py to
// compare with what the peers find.
#include <benchmark/benchmark.h>

#include <Eigen/Core>
#include <cstddef>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "bench/gauge_block.h"
#include "gum/expression/equation_model.h"
#include "gum/monte_carlo/monte_carlo.h"
#include "gum/propagation.h"

namespace gumcert::gum {
namespace {

/// Tables of quantiles, threads and memory included: what one run costs.
void monte_carlo(benchmark::State& state) {
    const EquationModel model = gauge_block();
    MonteCarloOptions options = gauge_block_options();
    options.threads = static_cast<unsigned>(state.range(0));
    for (auto _ : state) {
        benchmark::DoNotOptimize(run_monte_carlo(model, options));
    }
}

/// Sensitivity coefficients, budget, effective degrees of freedom and expanded uncertainty.
void law_of_propagation(benchmark::State& state) {
    const EquationModel model = gauge_block();
    for (auto _ : state) {
        benchmark::DoNotOptimize(propagate(model, k_gauge_block_probability));
    }
}

/// y = x1 + … + xn as one equation, every input a row of the budget.
EquationModel sum_of(std::size_t n) {
    std::string text = "y = ";
    std::vector<InputSymbol> symbols;
    std::vector<InputGroup> groups;
    for (std::size_t i = 0; i < n; ++i) {
        const std::string name = "x" + std::to_string(i + 1);
        text += (i == 0 ? "" : " + ") + name;
        symbols.push_back({.name = name, .unit = Unit::parse("m"), .constant = {}});
        InputGroup& group = groups.emplace_back();
        group.name = name;
        group.unit = "m";
        group.value = Eigen::VectorXd::Constant(1, 1.0);
        group.covariance = Eigen::MatrixXd::Constant(1, 1, 1e-12);
        group.degrees_of_freedom = 10.0;
    }
    const std::vector<EquationText> equations{{.text = std::move(text), .where = "sum"}};
    const ExpressionLimits limits{.bytes = 16 * n, .depth = 200, .nodes = 4 * n};
    return {EquationSystem::compile(equations, symbols, {}, {}, limits), std::move(groups)};
}

void law_of_propagation_of_sum(benchmark::State& state) {
    const EquationModel model = sum_of(static_cast<std::size_t>(state.range(0)));
    for (auto _ : state) {
        benchmark::DoNotOptimize(propagate(model, 0.9545));
    }
}

BENCHMARK(monte_carlo)->Arg(1)->Arg(2)->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(law_of_propagation)->Unit(benchmark::kMicrosecond)->MeasureProcessCPUTime()->UseRealTime();
BENCHMARK(law_of_propagation_of_sum)
    ->Arg(1'000)
    ->Arg(10'000)
    ->Arg(100'000)
    ->Unit(benchmark::kMicrosecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();

/// In metres.
bool write_values(const char* name) {
    const EquationModel model = gauge_block();
    const MonteCarloOutput trials = run_monte_carlo(model, gauge_block_options()).outputs[0];
    const Propagation law = propagate(model, k_gauge_block_probability);
    std::ofstream file(name);
    file.precision(std::numeric_limits<double>::max_digits10);
    file << "{\"monte_carlo\": {\"y\": " << trials.mean << ", \"u\": " << trials.standard_uncertainty
         << ", \"low\": " << trials.shortest.low << ", \"high\": " << trials.shortest.high
         << ", \"error_of_low\": " << trials.numerical_error.shortest.low
         << ", \"error_of_high\": " << trials.numerical_error.shortest.high
         << "}, \"law_of_propagation\": {\"y\": " << law.value(0) << ", \"u\": " << law.standard_uncertainty(0)
         << ", \"degrees_of_freedom\": " << law.effective_degrees_of_freedom(0)
         << ", \"U\": " << law.expanded_uncertainty(0) << "}}\n";
    file.close();
    if (!file) {
        std::cerr << "gum: " << name << " cannot be written\n";
    }
    return static_cast<bool>(file);
}

}  // namespace
}  // namespace gumcert::gum

int main(int argc, char** argv) {
    benchmark::Initialize(&argc, argv);
    if (argc == 3 && std::string_view(argv[1]) == "--write-values") {
        return gumcert::gum::write_values(argv[2]) ? EXIT_SUCCESS : EXIT_FAILURE;
    }
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) {
        return 2;
    }
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
    return EXIT_SUCCESS;
}
