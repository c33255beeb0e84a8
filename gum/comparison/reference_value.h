#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace gumcert::gum {

/// Results of n laboratories for one quantity, all in one unit.
struct LaboratoryResults {
    Eigen::VectorXd x;                ///< n, values
    Eigen::VectorXd u;                ///< n, standard uncertainties > 0
    Eigen::MatrixXd covariance = {};  ///< n×n with u² on its diagonal; empty: the results are independent of each other
    /// n, of u; empty: all are infinite. Tests of consistency alone take them into account.
    Eigen::VectorXd degrees_of_freedom = {};
};

/// Checks sizes, finite numbers, u > 0, covariance symmetric with |r| ≤ 1 and positive semi-definite.
/// \throws InputError  with every problem found: GC-GUM-0001, -0003, -0131 fewer than 2 results, -0135 sizes that do
///                     not fit, a diagonal that is not u², or numbers whose squares are no longer numbers, -0052 to
///                     -0054 for the covariance
void require_results(const LaboratoryResults& results);

/// The results with these numbers, in this order, with their part of the covariance. Nothing is checked.
[[nodiscard]] LaboratoryResults selected_results(const LaboratoryResults& results,
                                                 const std::vector<std::size_t>& members);

/// What results differ by because laboratories did not measure the same: items that are not alike, or that change. It is
/// another one in each result.
struct ItemUncertainty {
    double between = 0.0;                                                 ///< standard deviation between items
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< of it: one estimate for all results
    double drift = 0.0;                                                   ///< standard uncertainty

    [[nodiscard]] double total() const;
};
/// The results with the uncertainty of their items in each of them, and with the ν of both by Welch and Satterthwaite.
[[nodiscard]] LaboratoryResults with_items(const LaboratoryResults& results, const ItemUncertainty& items);

/// A number as the sum of two: the nearest double, and what it leaves. A mean may be known to a fraction of the last
/// binary digit of its value, where results have many digits in common and one of them nearly all of the weight.
struct SplitNumber {
    double value = 0.0, rest = 0.0;
};
/// a + b without loss.                                                       (Knuth, Dekker: the sum and its error)
[[nodiscard]] SplitNumber split_sum(double a, double b);

/// An estimate from the results of several laboratories that is linear in them: y = Σ w_i x_i, Σ w_i = 1.
struct ReferenceValue {
    double value = 0.0;
    double u = 0.0;
    Eigen::VectorXd weights = {};             ///< n; empty or all 0: the value does not depend on the results
    double between_standard_deviation = 0.0;  ///< τ of a random-effects model; 0 without one
    double rest = 0.0;                        ///< the estimate is value + rest: see SplitNumber
};

/// The same value with the weights spread over all n results: those of the members, 0 for the others.
[[nodiscard]] ReferenceValue spread_weights(ReferenceValue reference, const std::vector<std::size_t>& members,
                                            std::size_t results);

/// Weighted mean, w_i ∝ 1/u_i², u² = 1/Σ(1/u_i²); with a covariance the generalised one, w = V⁻¹1/(1ᵀV⁻¹1),
/// u² = 1/(1ᵀV⁻¹1).                     (Cox 2002, Metrologia 39, 589-595, procedure A; CIPM MRA-G-11)
/// \throws InputError     as require_results(). Weights may be negative where correlations are strong
/// \throws NoResultError  GC-GUM-0132 the covariance is singular (reciprocal condition of the correlations below 1e-12)
/// Accuracy: relative error of u and the weights below 1e-13 without a covariance, for any range of u
/// (docs/accuracy.md#comparisons-and-robust-statistics).
[[nodiscard]] ReferenceValue weighted_mean(const LaboratoryResults& results);

/// Arithmetic mean with u = s/√n of the values themselves; stated uncertainties are not used.
/// \throws InputError  GC-GUM-0001 also where the range of the values is no number any more, -0131 fewer than 2
[[nodiscard]] ReferenceValue arithmetic_mean(const Eigen::VectorXd& x);

/// Test whether results are consistent with one value and their stated uncertainties.
struct ConsistencyTest {
    double chi_square = 0.0;  ///< Σ (x_i − y)²/u_i², or (x − 1y)ᵀ V⁻¹ (x − 1y)
    std::size_t degrees_of_freedom = 0;
    double critical_value = 0.0;  ///< upper quantile of chi-square, or of the bound below
    double p_value = 0.0;
    bool consistent = true;          ///< chi_square ≤ critical_value, that is p_value ≥ α
    double birge_ratio = 0.0;        ///< √(χ²/ν); a rule of thumb, not a test of stated uncertainties
    double birge_limit = 0.0;        ///< √(1 + √(8/ν))
    bool of_finite_degrees = false;  ///< of the u of a result
};
/// About the weighted mean. The values are centred on one of them before anything is squared.
///
/// An u of few degrees of freedom is uncertain itself, and χ² of right results would be too large: 47 % of ten results
/// with ν = 3 would fail at α = 5 %. (x_i − y)/u_i is a t then, and the normal quantity with its tail stands in its
/// place, at the y that makes the sum of squares least: 4 % to 8 % fail, for any ν and n. For results that correlate no
/// exact distribution is known; the critical value is the larger one of χ² and of one estimate behind all u,
/// (n − 1) F(n − 1, ν), which objects least.
/// \param alpha  0.05 in key comparisons
/// \throws  as weighted_mean(); InputError GC-GUM-0004 for alpha
[[nodiscard]] ConsistencyTest consistency_test(const LaboratoryResults& results, double alpha = 0.05);
/// The same of results that hold the uncertainty of their items as well. Their standard deviation is one estimate that
/// all of them share: where it is a part φ of the variances, the critical value is that of (n − 1) F(n − 1, ν/φ²), if
/// that is the larger one, and p belongs to it.
[[nodiscard]] ConsistencyTest consistency_test(const LaboratoryResults& results, const ItemUncertainty& items,
                                               double alpha);

/// Largest subset of results that passes the consistency test; among several of that size the one with the smallest
/// chi-square.                                                             (Cox 2007, Metrologia 44, 187-200)
///
/// Exact. Independent results: χ² of a subset is the least value over y of Σ (x_i − y)²/u_i², and for every y the best
/// subset of a size holds the smallest terms; the best y is found by branch and bound over intervals of y, the size by
/// bisection (whenever a size has a consistent subset, so has every smaller one). With a covariance: every subset, the
/// large ones first.
///
/// Finite degrees of freedom: among the results as the test of all of them takes them, which is the subset of the
/// results themselves.
struct ConsistentSubset {
    std::vector<std::size_t> members;  ///< ascending
    ReferenceValue mean;               ///< of the members; weights over all n, 0 outside
    ConsistencyTest test;              ///< of the members
    /// No other subset of this size has the same chi-square (within 1e-9 relative). Of those that have, one is taken that
    /// does not depend on the order in which the results are listed, and nothing else speaks for it.
    bool unique = true;
    /// Ascending: results outside that another consistent subset of this size holds. The choice against them is that of
    /// the smallest chi-square, and no more. Of more than 100 results outside, those after the first 100 count as such.
    std::vector<std::size_t> in_another = {};
};
inline constexpr std::size_t k_most_results_of_subset = 2000;           ///< independent ones
inline constexpr std::size_t k_most_correlated_results_of_subset = 20;  ///< with a covariance
/// \param alpha  at most 0.3
/// \throws InputError     as require_results(); GC-GUM-0004; GC-GUM-0133 too many results for an exact search
/// \throws NoResultError  GC-GUM-0132 the covariance is singular; GC-GUM-0134 no two results are consistent
[[nodiscard]] ConsistentSubset largest_consistent_subset(const LaboratoryResults& results, double alpha = 0.05);

/// Degrees of equivalence d_i = x_i − y, unilateral, with u²(d_i) = u_i² − 2 cov(x_i, y) + u²(y) and
/// cov(x_i, y) = Σ_j w_j cov(x_i, x_j), w the weights of the reference value.
///
/// For the weighted mean of independent results that is u_i² − u²(y) for a laboratory inside the mean and u_i² + u²(y)
/// for one outside (weight 0). It is computed as (e_i − w) V (e_i − w)ᵀ plus what u²(y) has beyond wᵀ V w, without the
/// difference of two nearly equal variances.
///
/// A u(y) that is smaller than the stated u_i allow (the standard deviation of values that agree by chance) can give
/// |cov(x_i, y)| > u_i u(y). A correlation of ±1 is taken then, and u(d_i) belongs to it.
struct DegreesOfEquivalence {
    Eigen::VectorXd d, u;         ///< n
    Eigen::VectorXd correlation;  ///< n, of x_i with the reference value, −1 … 1
};
/// \param results  one or more: a single laboratory may be held against a value that does not depend on it
/// \throws InputError  as require_results(); GC-GUM-0001, -0002 or -0135 for the reference value
[[nodiscard]] DegreesOfEquivalence degrees_of_equivalence(const LaboratoryResults& results,
                                                          const ReferenceValue& reference);

/// d_ij = x_i − x_j with u²(d_ij) = u_i² + u_j² − 2 cov(x_i, x_j).
struct PairDifference {
    double d = 0.0, u = 0.0;
};
[[nodiscard]] PairDifference pair_difference(const LaboratoryResults& results, std::size_t i, std::size_t j);

/// Number of pairs of results that are not metrologically compatible, |x_i − x_j| > κ u(x_i − x_j)
/// (JCGM 200:2012, 2.47; Kacker, Kessel and Sommer 2010). Time n².
/// \param kappa  > 0
[[nodiscard]] std::size_t incompatible_pairs(const LaboratoryResults& results, double kappa = 2.0);

/// What Monte Carlo says of the median of the results (procedure B of Cox 2002).
struct MedianTrials {
    double median = 0.0;  ///< mean of the medians of the trials
    double u = 0.0;
    double low = 0.0, high = 0.0;   ///< shortest coverage interval of the median
    Eigen::VectorXd d, u_d;         ///< n, x_i − median, over the trials
    Eigen::VectorXd d_low, d_high;  ///< n, shortest coverage intervals
    std::size_t trials = 0;
    /// ν with which t_p(ν) u about the median covers the share p of the trials
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
    bool leaves_out_degrees = false;  ///< of correlated results
};
inline constexpr std::size_t k_fewest_median_trials = 1'000;
inline constexpr std::size_t k_most_median_trials = 10'000'000;
inline constexpr std::size_t k_most_median_draws = 500'000'000;            ///< results × trials
inline constexpr std::size_t k_most_correlated_median_draws = 50'000'000;  ///< the same with a covariance
/// Every trial draws all results from normal distributions (jointly, with a covariance) and takes their median. Where
/// independent results state degrees of freedom, intervals and ν come from as many trials more that draw t distributions,
/// scaled by u and shifted to the values (JCGM 101:2008, 6.4.9); those of correlated results are left out.
/// Same bytes for any number of threads. Memory: 0.15 GB and 8 bytes a trial, whatever the number of results.
/// \param trials  k_fewest_median_trials … k_most_median_trials
/// \param threads  0: as many as the machine has
/// \throws InputError  as require_results(); GC-GUM-0004; GC-GUM-0136 for the number of trials, alone or times n
[[nodiscard]] MedianTrials median_trials(const LaboratoryResults& results, std::size_t trials, std::uint64_t seed,
                                         double coverage_probability, unsigned threads = 0);

}  // namespace gumcert::gum
