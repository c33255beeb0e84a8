#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "gum/monte_carlo/monte_carlo_histogram.h"
#include "gum/quantity/measurement_model.h"

namespace gumcert::gum {

/// Two ends of a coverage interval, [unit of y].
struct CoverageInterval {
    double low = 0.0;
    double high = 0.0;

    friend bool operator==(const CoverageInterval&, const CoverageInterval&) = default;
};

/// Adaptive number of trials (JCGM 101:2008, 7.9; several outputs: JCGM 102:2011, 7.8).
struct AdaptiveTrials {
    int digits = 2;                             ///< significant digits of u regarded as meaningful, 1 or 2
    std::uint64_t most_trials = 1'000'000'000;  ///< stops here, not stabilised
    double tolerance_divisor = 1.0;             ///< 5 where the law of propagation is validated (JCGM 101:2008, 8.2)
};

/// What Monte Carlo may keep in memory. Results depend on it only where `collected_values` is too small for exact ends
/// of intervals; what is then not known goes into the numerical error.
struct MonteCarloMemory {
    std::uint64_t kept_trials = std::uint64_t{1} << 20;       ///< with more, trials are drawn again instead of kept
    std::uint64_t kept_values = std::uint64_t{1} << 25;       ///< trials times outputs, likewise
    std::uint64_t collected_values = std::uint64_t{1} << 24;  ///< of all outputs together, near the ends of intervals
};

struct MonteCarloOptions {
    std::uint64_t trials = 1'000'000;  ///< used unless `adaptive` is given; 1 … 10^10
    std::optional<AdaptiveTrials> adaptive;
    std::uint64_t seed = 1;
    /// Number of the random stream of each input group; empty: the index of the group. Runs with the same seed draw the
    /// same values for inputs of the same stream and shape: so test points of a table share their common inputs.
    std::vector<std::uint64_t> streams;
    double coverage_probability = 0.9545;
    /// Adaptive: whether an output certainly has no variance, from a number of its first trials. Asked where u or the mean
    /// alone do not settle; empty: all have one. Of an output without, only the ends of its interval are tested.
    std::function<bool(Eigen::Index output, std::uint64_t trials)> has_no_variance;
    unsigned threads = 0;                  ///< 0: as many as the machine has; results do not depend on it
    bool regions = true;                   ///< coverage regions, where there are two or more outputs
    bool histogram = true;                 ///< MonteCarloOutput::histogram
    std::function<void(double)> progress;  ///< called from the calling thread with the fraction done; may be empty.
                                           ///< What it throws ends the run and reaches the caller.
    MonteCarloMemory memory;
};

/// Standard uncertainty of each number that Monte Carlo gives, from its finite number of trials M.
///
/// Mean: u/√M. Standard uncertainty: by the fourth moment (gum/monte_carlo/monte_carlo_statistics.h), never above u.
///
/// Ends of the symmetric interval: half the distance between the order statistics √(M π(1-π)) ranks below and above the
/// end, π = rank/M: the rank of a quantile scatters binomially, and no density is needed.
///
/// Ends of the shortest interval: its position is where a flat function has its minimum, which the order statistics of
/// the ends do not describe and which settles only as M^(-1/3). Taken from 16 batches of the first trials, of b = M/16
/// but at most 8192 each: their standard deviation times (b/M)^(1/3). This is too large by at most (M/b)^(1/6) where an
/// end settles faster, as at the limit of a distribution. Fewer than 20 trials a batch: u.
struct NumericalError {
    double mean = 0.0;
    double standard_uncertainty = 0.0;
    CoverageInterval symmetric;  ///< of each end
    CoverageInterval shortest;   ///< of each end
};

/// What Monte Carlo says of one output quantity.
struct MonteCarloOutput {
    double mean = 0.0;                  ///< average of the trials (JCGM 101:2008, 7.6)
    double standard_uncertainty = 0.0;  ///< standard deviation of the trials, divisor M - 1 (JCGM 101:2008, 7.6)
    CoverageInterval symmetric;         ///< probabilistically symmetric, by order statistics (JCGM 101:2008, 7.7)
    CoverageInterval shortest;          ///< likewise the shortest; the lowest, where several are equally short
    NumericalError numerical_error;
    /// Adaptive: its own numbers are within the tolerance (JCGM 101:2008, 7.9.4), whatever those of other outputs are.
    bool stabilised = true;
    bool without_variance =
        false;  ///< MonteCarloOptions::has_no_variance said so, and `stabilised` is of the ends alone
    /// Share of the largest single deviation in the sum of all squared deviations from the mean. It falls with the
    /// number of trials unless the distribution has no variance.
    double largest_share = 0.0;
    Histogram histogram;  ///< no cells unless MonteCarloOptions::histogram, or where the trials do not vary
};

/// Coverage regions of several outputs (JCGM 102:2011, 7.7).
struct MonteCarloRegions {
    /// k_p: (η − y)ᵀ V⁻¹ (η − y) ≤ k_p² holds for the fraction p of the trials, V their covariance. None if V is
    /// singular.
    std::optional<double> ellipsoid_factor;
    std::string no_ellipsoid_because;    ///< a sentence for people; empty where there is one
    double parallelepiped_factor = 0.0;  ///< k_q: |η_j − y_j| ≤ k_q u(y_j) for all j holds for the fraction p
    /// Smallest region made of cells of a grid that spans the trials from smallest to largest (JCGM 102:2011, 7.7.4),
    /// for two and three outputs; empty grid: none. With heavy tails the cells are coarse and the region is too large.
    std::vector<int> cells_per_axis;
    double smallest_volume = 0.0;       ///< [product of the units]
    std::uint64_t smallest_cells = 0;   ///< how many cells it has
    double smallest_probability = 0.0;  ///< fraction of the trials in it, ≥ p
};

struct MonteCarloResult {
    std::uint64_t trials = 0;
    std::uint64_t seed = 0;
    double coverage_probability = 0.0;
    /// False: adaptive, and most_trials was reached before all outputs, and what is asked of them together, were stable.
    bool stabilised = true;
    std::vector<double> tolerance;  ///< adaptive: δ of each output (JCGM 101:2008, 7.9.2); else empty
    std::vector<MonteCarloOutput> outputs;
    Eigen::MatrixXd covariance;  ///< m×m, of the trials, divisor M - 1
    std::optional<MonteCarloRegions> regions;
};

/// Numerical tolerance δ of an uncertainty with a number of significant digits: u = c 10^ℓ with c an integer of
/// `digits` digits gives δ = ½ 10^ℓ                                                     (JCGM 101:2008, 7.9.2)
/// \param u > 0
[[nodiscard]] double numerical_tolerance(double u, int digits);

/// Propagation of distributions by Monte Carlo (JCGM 101:2008, clause 7; JCGM 102:2011, clause 7).
///
/// Trial r draws from the counter r of Philox 4x64-10 with seed and stream as key (gum/monte_carlo/random_draws.h), so any trial
/// can be drawn again alone. Trials are taken in blocks of 4096 and added up in the order of the blocks: the same job
/// gives the same bytes for any number of threads. The memory used does not grow with the number of trials: above
/// MonteCarloMemory::kept_trials they are drawn again, and ends of intervals are still exact order statistics.
///
/// Adaptive: sequences of max(J, 10^4) trials, J the smallest integer not below 100/(1 − p); after h ≥ 2 of them stops
/// when twice the standard deviations of the averages of y, u(y) and both ends of the *symmetric* interval are at most
/// the numerical tolerance of u(y), for every output (JCGM 101:2008, 7.9.4), and the numerical error of none of them is
/// above it: two sequences may agree by chance. With several outputs and `regions` also
/// those of the largest eigenvalue of the correlation matrix and of the factors k_p and k_q, with the tolerances of
/// these numbers (JCGM 102:2011, 7.8). The result is then the same as with that number of trials given. An output without
/// a variance (MonteCarloOptions::has_no_variance) has no u that could settle: the ends of its interval are tested, with
/// the tolerance of a quarter of its width in place of u, and nothing that outputs have together.
///
/// \throws InputError     GC-GUM-0121 trials outside 1 … 10^10, GC-GUM-0126 digits or most_trials, GC-GUM-0004
///                        coverage probability; groups as refused by gum/monte_carlo/random_draws.h
/// \throws NoResultError  GC-GUM-0120 a trial without a finite value: how many there were up to the end of the first
/// block
///                        that has one, the number of the first such trial and its inputs
/// Fewer than 10^4/(1 − p) trials are done as asked; the caller warns (JCGM 101:2008, 7.2).
/// Accuracy: that of the number of trials, stated with every number (NumericalError); docs/accuracy.md#monte-carlo.
/// Example: examples/api/monte_carlo.cpp
[[nodiscard]] MonteCarloResult run_monte_carlo(const MeasurementModel& model, const MonteCarloOptions& options);

/// The inputs of one trial, n values: "why did trial 731 204 give this value?".
/// \param streams  as MonteCarloOptions::streams
/// \throws InputError  as run_monte_carlo
[[nodiscard]] Eigen::VectorXd monte_carlo_trial(const MeasurementModel& model, std::uint64_t seed, std::uint64_t trial,
                                                const std::vector<std::uint64_t>& streams = {});

/// Comparison of the law of propagation with Monte Carlo (JCGM 101:2008, clause 8).
struct Validation {
    double tolerance = 0.0;        ///< δ of u(y) from the law of propagation
    double distance_low = 0.0;     ///< |y − U − y_low|
    double distance_high = 0.0;    ///< |y + U − y_high|
    bool validated = false;        ///< both ≤ δ
    double numerical_limit = 0.0;  ///< δ/5: what the numerical error of each end must stay below (8.2)
    bool precise_enough =
        false;  ///< it does, or an end is off by more than 5 of its errors; without that `validated` says little
};

/// \param value, standard_uncertainty, expanded_uncertainty  of the law of propagation
/// \param interval        Monte Carlo interval of the same probability
/// \param interval_error  numerical standard uncertainty of its ends
/// \param digits          significant digits of u regarded as meaningful, 1 or 2
/// \throws InputError  for an argument that is not finite, u ≤ 0, or digits out of range
[[nodiscard]] Validation validate(double value, double standard_uncertainty, double expanded_uncertainty,
                                  const CoverageInterval& interval, const CoverageInterval& interval_error, int digits);

}  // namespace gumcert::gum
