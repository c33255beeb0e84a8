#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gum/argument_check.h"
#include "gum/comparison/correlated_results.h"
#include "gum/comparison/reference_value.h"
#include "gum/coverage.h"
#include "gum/monte_carlo/monte_carlo_statistics.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/monte_carlo/worker_threads.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;

constexpr std::size_t k_most_kept = std::size_t{1} << 24;  // numbers: draws of some laboratories over all trials
constexpr std::size_t k_task = std::size_t{1} << 17;       // numbers: draws of all laboratories over some trials
constexpr std::size_t k_trials_of_counter = 8;  // that one random counter serves (gum/monte_carlo/random_draws.h)

void require_possible_trials(const LaboratoryResults& results, std::size_t trials) {
    const auto n = static_cast<std::size_t>(results.x.size());
    const bool correlated = results.covariance.size() != 0;
    const std::size_t most_draws = correlated ? k_most_correlated_median_draws : k_most_median_draws;
    const std::string where = "trials of the median";
    if (trials < k_fewest_median_trials || trials > k_most_median_trials) {
        refuse("GC-GUM-0136", where, std::to_string(trials),
               "from " + std::to_string(k_fewest_median_trials) + " to " + std::to_string(k_most_median_trials),
               "State another number of trials; 100000 give two digits of an uncertainty.");
    }
    if (n > most_draws / trials) {
        refuse("GC-GUM-0136", where,
               std::to_string(trials) + " for " + std::to_string(n) + (correlated ? " correlated results" : " results"),
               "results times trials may be at most " + std::to_string(most_draws),
               "State at most " + std::to_string(most_draws / n) +
                   " trials, or take the robust uncertainty of the median, which needs none.");
    }
}

/// The results as groups of inputs: with a covariance one group, else blocks of so many results that their draws of all
/// trials can be kept. Values are relative to that of the most precise result.
class Blocks {
public:
    Blocks(const LaboratoryResults& results, std::size_t trials, std::uint64_t seed, bool draw_t = false)
        : correlated_(results.covariance.size() != 0), seed_(seed), size_(results.x.size()) {
        // As many results as fit into the memory that is kept for their draws over all trials: memory must not grow
        // with their number.
        width_ = static_cast<Index>(std::max<std::size_t>(1, k_most_kept / trials));
        centre_ = results.x(most_precise(results));
        const Eigen::VectorXd x = results.x.array() - centre_;
        const Index of_group = correlated_ ? size_ : width_;
        for (Index first = 0; first < size_; first += of_group) {
            const Index count = std::min(of_group, size_ - first);
            InputGroup group;
            group.name = "results";
            group.value = x.segment(first, count);
            if (correlated_) {
                // Stated digits leave small differences between both halves, and between the diagonal and u².
                group.covariance = 0.5 * (results.covariance + results.covariance.transpose());
                group.covariance.diagonal() = results.u.array().square();
            } else {
                group.covariance = results.u.segment(first, count).array().square();
                for (Index i = first; draw_t && i < first + count; ++i) {
                    group.marginals.push_back(
                        Distribution::student_t(x(i), results.u(i), results.degrees_of_freedom(i)));
                }
            }
            groups_.push_back(std::move(group));
        }
    }

    [[nodiscard]] double centre() const { return centre_; }
    [[nodiscard]] Index width() const { return width_; }
    [[nodiscard]] Index count() const { return (size_ + width_ - 1) / width_; }

    /// Draws of all results.
    [[nodiscard]] InputDraws all(WorkerThreads& workers) const { return InputDraws(groups_, seed_, {}, &workers); }

    /// Draws that hold the results of one block from column first_column() on, the same numbers as in all().
    [[nodiscard]] InputDraws block(Index block, WorkerThreads& workers) const {
        if (correlated_) {
            return all(workers);
        }
        const auto group = static_cast<std::size_t>(block);
        const std::vector<std::uint64_t> streams{group};
        return InputDraws({groups_[group]}, seed_, streams, &workers);
    }
    [[nodiscard]] Index first_column(Index block) const { return correlated_ ? block * width_ : 0; }

private:
    bool correlated_;
    std::uint64_t seed_;
    Index size_;
    Index width_ = 0;
    double centre_ = 0.0;
    std::vector<InputGroup> groups_;
};

double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    if (values.size() % 2 == 1) {
        return *middle;
    }
    // nth_element leaves all smaller values before the middle one: the largest of them is its neighbour, no second
    // sort.
    const double below = *std::max_element(values.begin(), middle);
    return below + 0.5 * (*middle - below);
}

/// Runs work(first trial, its draws) over all trials, some of them at a time, on all workers.
template <class Work>
void draw_all_trials(const InputDraws& draws, std::size_t trials, WorkerThreads& workers, const Work& work) {
    const auto n = static_cast<std::size_t>(draws.size());
    // Tasks begin at whole counters of the random numbers, and their size does not depend on the number of threads: so
    // the bytes do not either.
    const std::size_t at_a_time = std::max<std::size_t>(1, k_task / n / k_trials_of_counter) * k_trials_of_counter;
    std::vector<Eigen::MatrixXd> buffers(workers.size());
    workers.run((trials + at_a_time - 1) / at_a_time, [&](unsigned worker, std::size_t task) {
        const std::size_t first = task * at_a_time;
        Eigen::MatrixXd& x = buffers[worker];
        x.resize(static_cast<Index>(std::min(at_a_time, trials - first)), draws.size());
        draws.draw(first, x);
        work(first, x);
    });
}

std::vector<double> medians_of_trials(const InputDraws& draws, std::size_t trials, WorkerThreads& workers) {
    std::vector<double> medians(trials);
    draw_all_trials(draws, trials, workers, [&](std::size_t first, const Eigen::MatrixXd& x) {
        std::vector<double> values(static_cast<std::size_t>(x.cols()));
        for (Index row = 0; row < x.rows(); ++row) {
            for (Index column = 0; column < x.cols(); ++column) {
                values[static_cast<std::size_t>(column)] = x(row, column);
            }
            medians[first + static_cast<std::size_t>(row)] = median_of(values);
        }
    });
    return medians;
}

/// Mean, standard deviation and shortest coverage interval of a series, which is left in another order.
struct Series {
    double mean = 0.0, u = 0.0, low = 0.0, high = 0.0;
};
Series describe(std::span<double> values, const CoverageRanks& ranks) {
    const Moments moments = moments_of(values.data(), static_cast<Index>(values.size()));
    const ShortestRange range = shortest_range(values, ranks.inside);
    return {.mean = moments.mean, .u = moments.standard_deviation(), .low = range.low.value, .high = range.high.value};
}

/// Median and differences of all trials. Values are relative to that of the most precise result, as the draws are.
MedianTrials trials_of(const Blocks& blocks, Index n, std::size_t trials, const CoverageRanks& ranks,
                       WorkerThreads& workers, std::vector<double>& medians) {
    // The medians first, then the draws once more, block by block: all draws at once may be gigabytes, and counters
    // give the same numbers again.
    medians = medians_of_trials(blocks.all(workers), trials, workers);
    MedianTrials outcome{.d = Eigen::VectorXd(n),
                         .u_d = Eigen::VectorXd(n),
                         .d_low = Eigen::VectorXd(n),
                         .d_high = Eigen::VectorXd(n),
                         .trials = trials};
    Eigen::MatrixXd kept(static_cast<Index>(trials), std::min(blocks.width(), n));
    for (Index block = 0; block < blocks.count(); ++block) {
        const Index first_result = block * blocks.width();
        const Index count = std::min(blocks.width(), n - first_result);
        const Index column = blocks.first_column(block);
        draw_all_trials(blocks.block(block, workers), trials, workers,
                        [&](std::size_t first, const Eigen::MatrixXd& x) {
                            const auto start = static_cast<Index>(first);
                            const Eigen::Map<const Eigen::VectorXd> median(medians.data() + first, x.rows());
                            kept.block(start, 0, x.rows(), count) = x.middleCols(column, count).colwise() - median;
                        });
        workers.run(static_cast<std::size_t>(count), [&](unsigned, std::size_t task) {
            const auto j = static_cast<Index>(task);
            const Series d = describe({kept.col(j).data(), trials}, ranks);
            outcome.d(first_result + j) = d.mean;
            outcome.u_d(first_result + j) = d.u;
            outcome.d_low(first_result + j) = d.low;
            outcome.d_high(first_result + j) = d.high;
        });
    }
    const Series median = describe(medians, ranks);
    outcome.median = median.mean;
    outcome.u = median.u;
    outcome.low = median.low;
    outcome.high = median.high;
    return outcome;
}

/// ν of the t distribution whose interval at a probability is `factor` standard uncertainties wide to each side; infinite
/// where the normal one is not narrower.
double degrees_of_factor(double factor, double coverage_probability) {
    constexpr double k_fewest = 0.5;
    constexpr double k_most = 1000.0;  // more cannot be told from a normal distribution by trials
    if (factor <= coverage_factor(coverage_probability, k_most)) {
        return std::numeric_limits<double>::infinity();
    }
    double low = std::log(k_fewest);
    double high = std::log(k_most);
    constexpr int k_halvings = 60;
    for (int i = 0; i < k_halvings; ++i) {
        const double middle = 0.5 * (low + high);
        (coverage_factor(coverage_probability, std::exp(middle)) > factor ? low : high) = middle;
    }
    return std::exp(high);
}

}  // namespace

MedianTrials median_trials(const LaboratoryResults& results, std::size_t trials, std::uint64_t seed,
                           double coverage_probability, unsigned threads) {
    require_results(results);
    require_probability(coverage_probability, "coverage probability");
    require_possible_trials(results, trials);
    const Index n = results.x.size();
    const CoverageRanks ranks(coverage_probability, trials);
    WorkerThreads workers(threads);
    std::vector<double> medians;
    const Blocks blocks(results, trials, seed);
    MedianTrials outcome = trials_of(blocks, n, trials, ranks, workers, medians);
    const bool has_degrees = (results.degrees_of_freedom.array() < std::numeric_limits<double>::infinity()).any();
    outcome.leaves_out_degrees = has_degrees && results.covariance.size() != 0;
    if (has_degrees && !outcome.leaves_out_degrees) {
        // The t has no standard deviation for few degrees of freedom, so that u and u(D) stay those of the stated u.
        const MedianTrials of_t = trials_of(Blocks(results, trials, seed, true), n, trials, ranks, workers, medians);
        outcome.low = of_t.low;
        outcome.high = of_t.high;
        outcome.d_low = of_t.d_low;
        outcome.d_high = of_t.d_high;
        for (double& median : medians) {
            median = std::abs(median - outcome.median);
        }
        const auto at = medians.begin() + static_cast<std::ptrdiff_t>(ranks.inside - 1);
        std::nth_element(medians.begin(), at, medians.end());
        outcome.degrees_of_freedom = degrees_of_factor(*at / outcome.u, coverage_probability);
    }
    outcome.median += blocks.centre();
    outcome.low += blocks.centre();
    outcome.high += blocks.centre();
    return outcome;
}

}  // namespace gumcert::gum
