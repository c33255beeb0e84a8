#include "gum/comparison/consensus_spread.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "gum/argument_check.h"
#include "gum/comparison/robust_statistics.h"
#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "text/counts.h"

namespace gumcert::gum {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr Index k_most_results_one_by_one = 2000;  // of more, a sum is taken from all results and corrected

/// Factors for 2, 3 … results, then the limit for many. scripts/comparison_coverage finds them again.
template <std::size_t n>
struct FactorTable {
    std::array<double, n> of_results;
    double of_many;

    [[nodiscard]] double operator()(std::size_t results) const {
        const std::size_t last = n + 1;
        if (results <= last) {
            return of_results[std::max<std::size_t>(results, 2) - 2];
        }
        // Beyond the table linear in 1/n, from the last number to the limit, without a step between the two.
        const double share = static_cast<double>(last) / static_cast<double>(results);
        return of_many + (of_results.back() - of_many) * share;
    }
};

// Median with the scale of algorithm A; many: √(π/2)/1.25.
// Simulated number by number and not smoothed: the median of an even number of results is the mean of two of them and
// scatters less than that of the odd numbers beside it (from 7 results on).
constexpr FactorTable<29> k_median{{0.7055, 0.7204, 0.7219, 0.802,  0.8366, 0.8835, 0.8718, 0.9073, 0.8923, 0.9225,
                                    0.906,  0.9373, 0.9186, 0.9477, 0.9273, 0.9508, 0.9337, 0.9593, 0.9401, 0.9617,
                                    0.9471, 0.9643, 0.9504, 0.9686, 0.9527, 0.9723, 0.9547, 0.9694, 0.9603},
                                   1.0027};
// Algorithm A; many: 1.018/1.25, the asymptotic standard deviation of Huber's location with c = 1.5.
constexpr FactorTable<29> k_algorithm_a{{0.7055, 0.7035, 0.7023, 0.7385, 0.7807, 0.793,  0.7994, 0.803,  0.8026, 0.8031,
                                         0.8041, 0.8098, 0.808,  0.8103, 0.8086, 0.8103, 0.8086, 0.8114, 0.8126, 0.8129,
                                         0.8127, 0.8103, 0.8107, 0.8129, 0.8103, 0.8123, 0.8112, 0.8113, 0.814},
                                        0.8145};
// Q method with Hampel's estimator.
constexpr FactorTable<29> k_q_hampel{{0.5098, 0.5361, 0.8777, 1.115,  0.8551, 0.9047, 0.8501, 0.8547, 0.8419, 0.8309,
                                      0.8276, 0.8192, 0.8193, 0.8174, 0.8154, 0.8156, 0.8136, 0.8131, 0.8113, 0.812,
                                      0.811,  0.812,  0.8113, 0.8107, 0.8135, 0.8113, 0.8123, 0.8129, 0.8108},
                                     0.806};
// U of the difference from a median of 3, 4 … results that the result is one of.
constexpr FactorTable<28> k_median_difference{
    {1.374, 1.155, 1.142, 1.082, 1.08,  1.055, 1.055, 1.041, 1.043, 1.029, 1.034, 1.026, 1.028, 1.021,
     1.025, 1.021, 1.024, 1.018, 1.023, 1.016, 1.02,  1.015, 1.019, 1.014, 1.018, 1.011, 1.017, 1.011},
    1.0};

double spread_factor(RobustMean kind, std::size_t results) {
    switch (kind) {
        case RobustMean::median:
            return k_median(results);
        case RobustMean::algorithm_a:
            return k_algorithm_a(results);
        case RobustMean::q_hampel:
            break;
    }
    return k_q_hampel(results);
}

/// 0 where there is none: all results, or nearly all of them, are equal.
double scale_of(RobustMean kind, std::span<const double> results) {
    try {
        return kind == RobustMean::q_hampel ? q_hampel(results).scale : algorithm_a(results).scale;
    } catch (const DiagnosedError&) {
        require_finite(median_with_made(results).location, "median");  // refuses what is no result
        return 0.0;
    }
}

void require_same_size(const VectorXd& x, const VectorXd& weights) {
    if (x.size() != weights.size()) {
        refuse("GC-GUM-0135", "weights of a mean",
               std::to_string(weights.size()) + " for " + text::count_of(x.size(), "result"),
               "every result has its weight", "Give all of them.");
    }
}

/// Σ w_j (x_j − y)²/(n − 2) of all but result i, about their mean, weights scaled to 1.
double variance_of_others(const VectorXd& x, const VectorXd& weights, Index i) {
    const double rest = weights.sum() - weights(i);
    double mean = 0.0;
    for (Index j = 0; j < x.size(); ++j) {
        // About x(0): results that share many digits would lose theirs in sums of squares.
        mean += j == i ? 0.0 : weights(j) * (x(j) - x(0));
    }
    mean /= rest;
    double squares = 0.0;
    for (Index j = 0; j < x.size(); ++j) {
        const double from_mean = x(j) - x(0) - mean;
        squares += j == i ? 0.0 : weights(j) * from_mean * from_mean;
    }
    return std::max(0.0, squares / rest / static_cast<double>(x.size() - 2));
}

}  // namespace

SpreadUncertainty robust_spread(RobustMean kind, std::span<const double> results) {
    const auto n = static_cast<double>(results.size());
    const double scale = scale_of(kind, results);
    return {.u = spread_factor(kind, results.size()) * k_robust_location_factor * scale / std::sqrt(n),
            .degrees_of_freedom = n - 1.0};
}

SpreadUncertainty weighted_spread(const VectorXd& x, const ReferenceValue& mean, double coverage_probability) {
    require_same_size(x, mean.weights);
    const Index n = x.size();
    if (n < 2) {
        refuse("GC-GUM-0131", "results", "only " + std::to_string(n), "a scatter needs at least 2",
               "Give the results of more laboratories.");
    }
    const double total = mean.weights.sum();
    const double nu = static_cast<double>(n - 1);
    double hartung_knapp = 0.0;
    double by_leverage = 0.0;
    double unweighted = 0.0;
    double sum_of_squares = 0.0;  // Σ w²: 1/n for equal weights, 1 where one result decides
    for (Index i = 0; i < n; ++i) {
        const double w = mean.weights(i) / total;
        const double e = x(i) - mean.value;
        hartung_knapp += w * e * e / nu;
        // A weight of 1 leaves no scatter to be seen.
        by_leverage += w < 1.0 ? w * w * e * e / (1.0 - w) : 0.0;
        unweighted += e * e / nu / static_cast<double>(n);
        sum_of_squares += w * w;
    }
    const double inequality = std::sqrt(std::max(0.0, 1.0 - 1.0 / (sum_of_squares * static_cast<double>(n))));
    const SpreadUncertainty by_scatter{.u = std::sqrt(std::max({hartung_knapp, by_leverage, inequality * unweighted})),
                                       .degrees_of_freedom = nu};
    const SpreadUncertainty stated{.u = mean.u};
    const auto expanded = [&](const SpreadUncertainty& spread) {
        return coverage_factor(coverage_probability, spread.degrees_of_freedom) * spread.u;
    };
    // U is compared, not u: with few degrees of freedom t_p(ν) makes the larger U of the smaller u.
    return expanded(by_scatter) < expanded(stated) ? stated : by_scatter;
}

std::vector<SpreadUncertainty> spread_of_others(const VectorXd& x, const VectorXd& weights) {
    require_same_size(x, weights);
    const Index n = x.size();
    if (n < 3) {
        return {};
    }
    const double total = weights.sum();
    // n − 1 results are left, about a mean of their own.
    const double nu = static_cast<double>(n - 2);
    const double centre = x(0);
    const double mean = ((x.array() - centre) * weights.array()).sum() / total;
    const double squares = (weights.array() * (x.array() - centre - mean).square()).sum() / total;
    std::vector<SpreadUncertainty> spreads;
    for (Index i = 0; i < n; ++i) {
        double variance = 0.0;
        // What is taken off the sum of all nearly cancels it where one result has most of the weight: one by one, as
        // long as n² terms are affordable.
        if (n <= k_most_results_one_by_one) {
            variance = variance_of_others(x, weights, i);
        } else {
            const double w = weights(i) / total;
            const double e = x(i) - centre - mean;
            variance = std::max(0.0, (squares - w * e * e / (1.0 - w)) / (nu * (1.0 - w)));
        }
        spreads.push_back({.u = std::sqrt(variance), .degrees_of_freedom = nu});
    }
    return spreads;
}

std::vector<SpreadUncertainty> robust_spread_of_others(RobustMean kind, const std::vector<double>& results) {
    if (results.size() < 3) {
        return {};
    }
    if (results.size() > k_most_results_left_out) {
        return {results.size(), robust_spread(kind, results)};
    }
    const double of_others = spread_factor(kind, results.size() - 1) * k_robust_location_factor /
                             std::sqrt(static_cast<double>(results.size() - 1));
    const double by_scale_of_all = of_others * scale_of(kind, results);
    std::vector<SpreadUncertainty> spreads;
    std::vector<double> others(results.begin() + 1, results.end());
    for (std::size_t i = 0; i < results.size(); ++i) {
        SpreadUncertainty spread = robust_spread(kind, others);
        // A scale of 0 is none, and the minimum would take it for the best one.
        if (by_scale_of_all > 0.0) {
            spread.u = std::min(spread.u, by_scale_of_all);
        }
        spreads.push_back(spread);
        if (i < others.size()) {
            others[i] = results[i];
        }
    }
    return spreads;
}

SpreadDifference spread_difference(const SpreadUncertainty& laboratory, const SpreadUncertainty& others, double of_item,
                                   double covariance, double share, double factor, double coverage_probability) {
    // u of the scatter of three results has one or two degrees of freedom, that of the laboratory often many: one ν for
    // the sum of them, by Welch and Satterthwaite. The formula is for independent parts, so the covariance counts in u
    // alone.
    const std::array<UncertaintyContribution, 3> parts{
        {{laboratory.u, laboratory.degrees_of_freedom}, {others.u, others.degrees_of_freedom}, {of_item}}};
    SpreadDifference difference;
    const double square = laboratory.u * laboratory.u + others.u * others.u + of_item * of_item - 2.0 * covariance;
    // x − y = (1 − w)(x − value of the others): the difference and its limit shrink alike when the result is part of
    // the value, and their quotient stays the same.
    difference.u = (1.0 - share) * std::sqrt(std::max(0.0, square));
    difference.degrees_of_freedom = effective_degrees_of_freedom(parts);
    difference.U = factor * coverage_factor(coverage_probability, difference.degrees_of_freedom) * difference.u;
    return difference;
}

double median_difference_factor(std::size_t results) {
    return results < 3 ? 1.0 : k_median_difference(results - 1);  // the table begins with 3 results
}

}  // namespace gumcert::gum
