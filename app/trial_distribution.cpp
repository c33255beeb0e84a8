#include "app/trial_distribution.h"

#include <algorithm>
#include <cstddef>

#include "gum/random_draws.h"
#include "gum/worker_threads.h"

namespace gumcert::app {

namespace {

constexpr std::uint64_t k_values_at_once = std::uint64_t{1} << 17;  // drawn inputs of one block, near the processor

/// Trials of a block: a multiple of 8, which is what one call of the random generator serves.
std::uint64_t rows_of(const gum::MeasurementModel& model, Eigen::Index inputs) {
    const auto width = static_cast<std::uint64_t>(inputs) + model.outputs().size();
    return std::clamp<std::uint64_t>(k_values_at_once / std::max<std::uint64_t>(width, 1) / 8 * 8, 64, 4096);
}

}  // namespace

TrialDistribution count_trials(const TrialsOfOutput& of) {
    const gum::MeasurementModel& model = *of.model;
    gum::WorkerThreads workers(of.threads);
    const gum::InputDraws draws(model.inputs(), of.seed, of.streams, &workers);
    const std::uint64_t counted = std::min(of.trials, k_most_counted_trials);
    auto values = std::make_shared<std::vector<double>>(static_cast<std::size_t>(counted));
    const std::uint64_t rows = rows_of(model, draws.size());
    const auto blocks = static_cast<std::size_t>((counted + rows - 1) / rows);
    workers.run(blocks, [&](unsigned, std::size_t block) {
        const std::uint64_t first = block * rows;
        const auto count = static_cast<Eigen::Index>(std::min(rows, counted - first));
        Eigen::MatrixXd x(count, draws.size());
        Eigen::MatrixXd y(count, static_cast<Eigen::Index>(model.outputs().size()));
        draws.draw(first, x);
        model.evaluate_trials(x, y);
        std::copy_n(y.col(of.output).data(), count, values->begin() + static_cast<std::ptrdiff_t>(first));
    });
    std::sort(values->begin(), values->end());
    return {.function =
                [values, unit = of.unit](double x) {
                    const auto end = std::upper_bound(values->begin(), values->end(), unit.to_si(x));
                    return static_cast<double>(end - values->begin()) / static_cast<double>(values->size());
                },
            .counted = counted};
}

}  // namespace gumcert::app
