#include "gum/monte_carlo/trial_distribution.h"

#include <algorithm>
#include <boost/sort/pdqsort/pdqsort.hpp>
#include <cmath>
#include <cstddef>
#include <limits>

#include "gum/monte_carlo/random_draws.h"
#include "gum/monte_carlo/worker_threads.h"

namespace gumcert::gum {

namespace {

constexpr std::uint64_t k_values_at_once = std::uint64_t{1} << 17;  // drawn inputs of one block, near the processor

/// Trials of a block: a multiple of 8, which is what one call of the random generator serves.
std::uint64_t rows_of(const MeasurementModel& model, Eigen::Index inputs) {
    const auto width = static_cast<std::uint64_t>(inputs) + model.outputs().size();
    return std::clamp<std::uint64_t>(k_values_at_once / std::max<std::uint64_t>(width, 1) / 8 * 8, 64, 4096);
}

/// The trials of an output in the order in which they are drawn, coherent SI.
std::vector<double> drawn_trials(const TrialsOfOutput& of) {
    const MeasurementModel& model = *of.model;
    WorkerThreads workers(of.threads);
    const InputDraws draws(model.inputs(), of.seed, of.streams, &workers);
    // Of very many trials the first ones are counted: they are a sample like all of them.
    const std::uint64_t counted = std::min(of.trials, k_most_counted_trials);
    std::vector<double> values(static_cast<std::size_t>(counted));
    const std::uint64_t rows = rows_of(model, draws.size());
    const auto blocks = static_cast<std::size_t>((counted + rows - 1) / rows);
    workers.run(blocks, [&](unsigned, std::size_t block) {
        const std::uint64_t first = block * rows;
        const auto count = static_cast<Eigen::Index>(std::min(rows, counted - first));
        Eigen::MatrixXd x(count, draws.size());
        Eigen::MatrixXd y(count, static_cast<Eigen::Index>(model.outputs().size()));
        draws.draw(first, x);
        model.evaluate_trials(x, y);
        std::copy_n(y.col(of.output).data(), count, values.begin() + static_cast<std::ptrdiff_t>(first));
    });
    return values;
}

/// How large sorted trials usually are: the largest and the smallest of them may be of another order of magnitude.
double usual_size(const std::vector<double>& sorted) {
    // The hundredth from either end: one trial far out would make the rounding that is allowed for as large as itself.
    const std::size_t hundredth = sorted.size() / 100;
    return std::max(std::abs(sorted[hundredth]), std::abs(sorted[sorted.size() - 1 - hundredth]));
}

/// Values that differ by less are one: a limit has been converted to another unit, and a trial has been computed.
double rounding_at(double x, double size) {
    constexpr double k_roundings = 4.0;
    return k_roundings * std::numeric_limits<double>::epsilon() * std::max(std::abs(x), size);
}

}  // namespace

TrialDistribution count_trials(const TrialsOfOutput& of) {
    auto values = std::make_shared<std::vector<double>>(drawn_trials(of));
    boost::sort::pdqsort(values->begin(), values->end());
    const double size = usual_size(*values);
    const auto share = [values](auto end) {
        return static_cast<double>(end - values->begin()) / static_cast<double>(values->size());
    };
    return {.function =
                [values, share, size, unit = of.unit](double x) {
                    const double at = unit.to_si(x);
                    // A trial that is the limit but for rounding counts as lying on it: inside of "≤", and outside of
                    // "<".
                    return share(std::upper_bound(values->begin(), values->end(), at + rounding_at(at, size)));
                },
            .below =
                [values, share, size, unit = of.unit](double x) {
                    const double at = unit.to_si(x);
                    return share(std::lower_bound(values->begin(), values->end(), at - rounding_at(at, size)));
                },
            .counted = values->size()};
}

TailIndex tail_index(const TrialsOfOutput& of) {
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    std::vector<double> values = drawn_trials(of);
    const std::size_t tail = std::clamp<std::size_t>(values.size() / 1000, 50, 4000);
    if (values.size() < 4 * tail) {
        return {k_infinite, 0.0};  // too few to tell
    }
    // From the median, because a distribution whose tails are looked at may have no mean.
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    const double median = *middle;
    for (double& value : values) {
        value = std::abs(value - median);
    }
    const auto largest = values.end() - static_cast<std::ptrdiff_t>(tail) - 1;
    std::nth_element(values.begin(), largest, values.end());
    std::sort(largest, values.end());
    const auto from = [&](std::size_t deviations) -> TailIndex {
        const auto first = values.end() - static_cast<std::ptrdiff_t>(deviations) - 1;
        const double threshold = *first;
        // Nearly all trials are equal: there is no tail.
        if (!(threshold > 0.0)) {
            return {k_infinite, 0.0};
        }
        double sum = 0.0;
        for (auto at = first + 1; at != values.end(); ++at) {
            sum += std::log(*at / threshold);
        }
        if (!(sum > 0.0)) {
            return {k_infinite, 0.0};
        }
        // 1/√k is the relative standard error of the estimate from k deviations.
        const auto k = static_cast<double>(deviations);
        return {k / sum, k / sum / std::sqrt(k)};
    };
    // A power law has the same exponent farther out. The step from a value that most trials have, or nearly have, to the
    // few that differ looks like one of a small exponent: max(x, 0) with x = −3 ± 1 is 0 in 99.9 % of the trials. Where
    // the farther trials thin out faster, by more than their number explains, they are the tail.
    constexpr std::size_t k_fewer = 4;
    constexpr std::size_t k_least = 50;
    constexpr double k_sure = 3.0;
    TailIndex index = from(tail);
    for (std::size_t farther = tail / k_fewer; farther >= k_least && std::isfinite(index.exponent);
         farther /= k_fewer) {
        const TailIndex next = from(farther);
        if (!(next.exponent - k_sure * next.standard_error > index.exponent)) {
            continue;
        }
        index = next;
    }
    return index;
}

}  // namespace gumcert::gum
