#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "gum/comparison/reference_value.h"

namespace gumcert::gum {

// What the scatter of results says of the uncertainty of a value that is made of them. Laboratories often differ by
// more than their stated uncertainties explain; an expanded uncertainty that is to cover what it claims then has to
// come from the scatter, with few degrees of freedom where there are few results. How well all of this covers is
// measured in docs/studies/comparison_coverage.md.

/// Standard uncertainty from the scatter of results, with its degrees of freedom: U = t_p(ν) u.
struct SpreadUncertainty {
    double u = 0.0;
    double degrees_of_freedom = std::numeric_limits<double>::infinity();
};

enum class RobustMean { median, algorithm_a, q_hampel };

/// Uncertainty of a robust mean of n results: u = a_n 1.25 s*/√n with ν = n − 1, where s* is the scale of the method
/// and of algorithm A for the median.
///
/// 1.25 s*/√n (ISO 13528:2022, clause 7) holds for a median of many results. a_n makes ± t_0.95(n − 1) u cover 95 % for
/// n results from one normal distribution; it was found by simulation and is 0.51 to 1.12.
/// \throws InputError  GC-GUM-0101 fewer than 2 results; -0001 for a result
/// \return u = 0 where the results have no scale
[[nodiscard]] SpreadUncertainty robust_spread(RobustMean kind, std::span<const double> results);

/// Uncertainty of a mean with weights that have a variance between laboratories in them, about the mean itself:
/// u² = max(Σ w e²/(n − 1), Σ w² e²/(1 − w), √(1 − n_eff/n) Σ e²/(n (n − 1))) with w the weights, e = x − y, ν = n − 1,
/// n_eff = 1/Σ w².
///
/// The first is that of Hartung and Knapp, exact for equal uncertainties; the second does not rest on the weights being
/// right. The third is for weights that differ much: a laboratory with a small uncertainty decides the value, a
/// variance between laboratories that is as large as the uncertainties of the others is often estimated as 0, and then
/// only the plain scatter of all results shows how far off that one laboratory may be. Where k_p u(y) is larger than
/// t_p(ν) u, it is u(y) with ν = ∞: results that agree by chance, or by the rounding of their last digit, take nothing
/// away from what the stated uncertainties leave open.
/// \param mean  linear in the results, Σ w = 1, its u by the weights
/// \throws InputError  GC-GUM-0131 fewer than 2 results, -0135 sizes that do not fit
[[nodiscard]] SpreadUncertainty weighted_spread(const Eigen::VectorXd& x, const ReferenceValue& mean,
                                                double coverage_probability);

/// Σ w e²/(n − 2) for each result apart, from all others alone: y without result i, its weights scaled to 1, ν = n − 2.
/// A result far away does not widen the limit that it is held against.
/// \return one a result; empty for fewer than 3 results
[[nodiscard]] std::vector<SpreadUncertainty> spread_of_others(const Eigen::VectorXd& x, const Eigen::VectorXd& weights);

/// The same for robust means, up to k_most_results_left_out results. Of more, one hardly moves the scale, and all of
/// them get that of all. The scale is the smaller one of that of the others and of that of all results: without a good
/// one, a single gross outlier can be a quarter of what is left, which no robust scale withstands.
[[nodiscard]] std::vector<SpreadUncertainty> robust_spread_of_others(RobustMean kind,
                                                                     const std::vector<double>& results);
inline constexpr std::size_t k_most_results_left_out = 200;

/// Difference of one result and a value, with U_D = f t_p(ν) u_D.
struct SpreadDifference {
    double u = 0.0, U = 0.0;
    double degrees_of_freedom = 0.0;  ///< by Welch and Satterthwaite (JCGM 100:2008, G.4.1)
};
/// \param laboratory  u and ν as stated by the laboratory
/// \param others      what the others say of the value
/// \param of_item     standard uncertainty of homogeneity and stability of the item
/// \param covariance  of the result and the value of the others
/// \param share       of the result in the value: its weight, 0 outside. D = (1 − share)(x − value of the others)
/// \param factor      f, see median_difference_factor()
[[nodiscard]] SpreadDifference spread_difference(const SpreadUncertainty& laboratory, const SpreadUncertainty& others,
                                                 double of_item, double covariance, double share, double factor,
                                                 double coverage_probability);

/// The difference from a median of n results that it is one of is 0 for one of them, and farther out than a normal one
/// for the others: f by which U_D is larger so that |D| > U_D as often as for a normal one; found by simulation.
[[nodiscard]] double median_difference_factor(std::size_t results);

}  // namespace gumcert::gum
