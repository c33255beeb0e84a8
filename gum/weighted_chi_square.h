#pragma once

#include <span>

namespace gumcert::gum {

// The distribution of Q = Σ λ_k Z_k² for independent standard normal Z_k: a sum of squares of normal quantities that
// are correlated with each other, where λ_k are the eigenvalues of their covariance.

/// P(Q ≤ x), by inversion of the Laplace transform Π (1 + 2 λ_k s)^(−1/2) of Q.
///
/// P = 1/(2πi) ∫ e^(sx) Π (1 + 2 λ_k s)^(−1/2) ds/s   (Imhof 1961, Biometrika 48, 419-426, integrates along the
/// imaginary axis, where the integrand oscillates). Here the path is a hyperbola through the saddle point, on which the
/// integrand falls like a bell, and the trapezoidal rule converges geometrically.
/// \param weights  λ_k ≥ 0, not all 0, in any order
/// \param x        finite; 0 is returned below 0
/// \return 0 to 1. Weights below 1e-30 of the largest are left out, which counts only where x is as small; 0 for x
///         below 1e-100 of the largest
/// \throws InputError  GC-GUM-0001 or -0002 for a weight, -0003 where all are 0, -0001 for x
/// \throws NoResultError  GC-GUM-0140 where the integral does not converge
/// Accuracy: relative error below 1e-9 as long as the result is above 1e-290, also far out in the tail
/// (docs/accuracy.md#coverage-factors-and-quantiles).
/// Example: examples/api/coverage_factor.cpp
[[nodiscard]] double weighted_chi_square_lower_tail(std::span<const double> weights, double x);

/// P(Q ≥ x), computed as a tail of its own, so that it keeps its digits when it is small.
[[nodiscard]] double weighted_chi_square_upper_tail(std::span<const double> weights, double x);

/// The x with P(Q ≤ x) = p, 0 < p < 1.
/// \throws InputError  as above; GC-GUM-0004 for the probability
/// Accuracy: the tail of the x that is returned is p within 1e-9 relative, as long as x is above 1e-100 of the largest
/// weight.
[[nodiscard]] double weighted_chi_square_quantile(std::span<const double> weights, double probability);

}  // namespace gumcert::gum
