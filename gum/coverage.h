#pragma once

#include <cstddef>
#include <limits>
#include <span>

namespace gumcert::gum {

/// Two-sided coverage factor k with P(−k ≤ t ≤ k) = p for Student's t with ν degrees of freedom.
///
/// k = t_p(ν)                                                                  (JCGM 100:2008, G.6.4 and table G.2)
/// \param coverage_probability  p, 0 < p < 1, e.g. 0.9545
/// \param degrees_of_freedom    ν > 0, not necessarily whole; infinity stands for the normal distribution
/// \return k, greater than 0
/// \throws InputError     GC-GUM-0004 or GC-GUM-0005 for an argument out of range
/// \throws NoResultError  GC-GUM-0010 if k is too large to be represented (ν far below 1)
/// A ν that is not whole is used as it is. Annex G of the GUM cuts it to the next lower integer only to enter its
/// table; the quantile exists for every real ν, so cutting would add nothing but a little uncertainty.
/// Accuracy: relative error below 1e-12 (docs/accuracy.md#coverage-factors-and-quantiles).
/// Example: examples/api/coverage_factor.cpp
[[nodiscard]] double coverage_factor(double coverage_probability, double degrees_of_freedom);

/// What a finite number of degrees of freedom of a covariance matrix V belongs to.
enum class EstimatedSpread {
    matrix,  ///< all of V was estimated, from readings of all quantities that were taken together (Wishart)
    scale,   ///< V is known up to one factor, as that of the parameters of a fit, scaled by its residuals
};

/// Factor k_p of the hyper-ellipsoid (η − y)ᵀ V⁻¹ (η − y) = k_p² that has the coverage probability p for m outputs.
///
/// k_p² = quantile of χ² with m degrees of freedom                               (JCGM 102:2011, 6.5.2.3)
/// k_p² = m ν/(ν + 1 − m) F_p(m, ν + 1 − m) of an estimated matrix                 (Willink and Hall 2002, Hotelling's
/// T²)
/// k_p² = m F_p(m, ν) of an estimated scale: that of the multivariate t-distribution
/// \param outputs             m ≥ 1
/// \param degrees_of_freedom  ν of the covariance matrix, infinite allowed
/// \throws InputError     GC-GUM-0003, -0004 or -0005 for an argument out of range
/// \throws NoResultError  GC-GUM-0011 where ν ≤ m − 1 of an estimated matrix, -0010 where the factor is too large to be
///                        represented
[[nodiscard]] double ellipsoid_coverage_factor(double coverage_probability, std::size_t outputs,
                                               double degrees_of_freedom,
                                               EstimatedSpread estimated = EstimatedSpread::matrix);

/// Uncertainty contribution |c_i| u(x_i) with its degrees of freedom ν_i.
struct UncertaintyContribution {
    double uncertainty = 0.0;  ///< standard uncertainty, ≥ 0, all contributions in the same unit
    double degrees_of_freedom = std::numeric_limits<double>::infinity();  ///< ν_i > 0 or infinite
};

/// Effective degrees of freedom of a combined standard uncertainty by the Welch–Satterthwaite formula.
///
/// ν_eff = u_c⁴ / Σ (u_i⁴ / ν_i), with u_c² = Σ u_i²                           (JCGM 100:2008, G.4.1, eq. G.2b)
/// \return ν_eff, not cut to an integer; infinite when no contribution other than 0 has finite ν_i
/// \throws InputError  GC-GUM-0001, -0002 or -0005 for a contribution out of range
/// Valid for contributions that are independent of each other; correlated quantities must enter as one contribution.
/// Accuracy: relative error below 1e-12, in any unit.
/// Example: examples/api/coverage_factor.cpp
[[nodiscard]] double effective_degrees_of_freedom(std::span<const UncertaintyContribution> contributions);

/// P(χ²_ν ≤ x). Called p_low where x is a sum of squared scores: a small value says that uncertainties are too large.
/// \param chi_square          x ≥ 0
/// \param degrees_of_freedom  ν > 0, finite
/// \throws InputError  for an argument out of range
[[nodiscard]] double chi_square_lower_tail(double chi_square, double degrees_of_freedom);

/// P(χ²_ν ≥ x), the p-value of a global test. Called p_high where x is a sum of squared scores: a small value says that
/// uncertainties are too small. Computed as a tail of its own, so that it keeps its digits when it is small.
/// \param chi_square          x ≥ 0
/// \param degrees_of_freedom  ν > 0, finite
/// \throws InputError  for an argument out of range
[[nodiscard]] double chi_square_upper_tail(double chi_square, double degrees_of_freedom);

/// P(|T| > t) for T of Student's distribution; the normal distribution where the degrees of freedom are infinite.
/// \throws InputError  GC-GUM-0001, -0002 for t, -0005 for the degrees of freedom
[[nodiscard]] double two_sided_tail_of_t(double t, double degrees_of_freedom);

/// Quantile z of the standard normal distribution, P(Z ≤ z) = p.
/// \param probability  p, 0 < p < 1
/// \throws InputError  GC-GUM-0004
[[nodiscard]] double standard_normal_quantile(double probability);

/// Critical value c of a two-sided test with a standard normal statistic, P(|Z| > c) = α.
/// \param alpha  probability of rejecting a good value, 0 < α < 1
/// \throws InputError  GC-GUM-0004
[[nodiscard]] double two_sided_normal_critical_value(double alpha);

}  // namespace gumcert::gum
