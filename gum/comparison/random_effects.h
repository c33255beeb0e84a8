#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "gum/comparison/reference_value.h"

namespace gumcert::gum {

// Reference values of results that differ more than their uncertainties explain: x_i = μ + b_i + e_i with a variance
// τ² of b_i between laboratories. All take independent results and give weights, value, u and τ.
// All throw InputError as require_results(), and GC-GUM-0139 where there is a covariance.

/// DerSimonian and Laird 1986: τ² = max(0, (Q − (n − 1)) / (Σw − Σw²/Σw)), w_i = 1/u_i²; y the mean weighted by
/// 1/(u_i² + τ²), u² = 1/Σ 1/(u_i² + τ²).
[[nodiscard]] ReferenceValue dersimonian_laird(const LaboratoryResults& results);

/// u of a random-effects mean by Hartung and Knapp (and Sidik and Jonkman): √(Σ w_i (x_i − y)² / ((n − 1) Σ w_i)),
/// w_i = 1/(u_i² + τ²), for a t distribution with n − 1 degrees of freedom. Not limited from below: results that agree
/// by chance give a value smaller than that of the weighted mean.
/// \param mean  of the same results; its value and its τ are taken
[[nodiscard]] double hartung_knapp_u(const LaboratoryResults& results, const ReferenceValue& mean);

/// Between-laboratory standard deviation by Cochran's analysis of variance with equal weights:
/// τ² = max(0, s² − Σ u_i²/n), s the standard deviation of the values.
[[nodiscard]] double cochran_between_standard_deviation(const LaboratoryResults& results);

/// Mandel and Paule 1982: τ² such that Σ (x_i − y)²/(u_i² + τ²) = n − 1; 0 where the sum is smaller without it.
/// \throws NoResultError  GC-GUM-0130 not converged
[[nodiscard]] ReferenceValue mandel_paule(const LaboratoryResults& results);

/// A laboratory that states the mean and standard deviation of n single observations.
struct ReplicatedResults {
    Eigen::VectorXd x;                      ///< n means
    Eigen::VectorXd s;                      ///< n standard deviations of single observations, > 0
    std::vector<std::size_t> observations;  ///< n, each ≥ 2
};
/// Vangel and Rukhin 1999, Biometrics 55, 129-136: maximum likelihood of x_ij = μ + b_i + e_ij with unknown variances
/// between and within laboratories. u is √(1 / Σ 1/(τ² + σ_i²/n_i)) at the maximum, w_i ∝ 1/(τ² + σ_i²/n_i).
///
/// The likelihood may have several maxima. Steps that cannot make it smaller lead from several starting points to the
/// nearest one, Newton steps close to it; the best one found is returned. τ = 0 is a possible result.
/// \throws InputError     GC-GUM-0001, -0003, -0131 fewer than 2 laboratories, -0135 sizes, -0138 fewer than 2
///                        observations of one laboratory
/// \throws NoResultError  GC-GUM-0130 not converged
[[nodiscard]] ReferenceValue vangel_rukhin(const ReplicatedResults& results);

/// Power-moderated mean (Pommé and Keightley 2015, Metrologia 52, S200-S212), as CCRI(II) uses it: Mandel-Paule
/// variance s² (0 where the reduced chi-square is at most 1), characteristic uncertainty S = √(n max(u²(arithmetic
/// mean), u²(Mandel-Paule mean))), weights ∝ (√(u_i² + s²)^α S^(2 − α))⁻¹ with α = 2 − 3/n.
/// u² = 1/Σ (√(u_i² + s²)^α S^(2 − α))⁻¹
/// \param alpha  power, 0 (arithmetic mean) … 2 (Mandel-Paule mean)
/// \throws InputError  GC-GUM-0137 for alpha
[[nodiscard]] ReferenceValue power_moderated_mean(const LaboratoryResults& results);
[[nodiscard]] ReferenceValue power_moderated_mean(const LaboratoryResults& results, double alpha);

}  // namespace gumcert::gum
