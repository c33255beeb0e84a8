#pragma once

#include <string>

#include "gum/quantity/distribution.h"

namespace gumcert::gum {

/// Why a distribution cannot be used, as a phrase for a message ("shape 0; must be greater than 0"); "" when it can.
///
/// Location, scale and shapes must be finite, a scale greater than 0 (a constant has none), a shape inside the range of
/// DistributionKind, the values of an empirical distribution finite and in ascending order.
[[nodiscard]] std::string distribution_problem(const Distribution& distribution);

/// P(X ≤ x), computed as a tail of its own, so that it keeps its digits when it is small.
/// \param distribution  one without a problem (distribution_problem)
/// \param x             [unit of location]; infinite is allowed
/// \throws InputError  GC-GUM-0124 for a distribution with a problem, GC-GUM-0125 if x is NaN
/// Accuracy: relative error below 1e-9, and 1e-12 where there is a closed form, given the rounding of
/// (x - location)/scale (docs/accuracy.md#coverage-factors-and-quantiles).
[[nodiscard]] double lower_tail_probability(const Distribution& distribution, double x);

/// P(X > x); as lower_tail_probability. Both tails of a value add up to 1.
[[nodiscard]] double upper_tail_probability(const Distribution& distribution, double x);

/// Probability density of the distribution at x, [1 / unit of location]; infinite where it is (arcsine at its limits).
/// The density of a constant and of an empirical distribution does not exist: NaN.
/// \throws InputError  as lower_tail_probability
[[nodiscard]] double probability_density(const Distribution& distribution, double x);

/// Smallest x with P(X ≤ x) ≥ p, [unit of location]. For p = 0 and p = 1 the limits of the distribution, perhaps
/// infinite.
///
/// Curvilinear trapezoid: the distribution function of the density of JCGM 101:2008, 6.4.3.3 integrates to logarithms
/// and is inverted by Newton steps. Student's t, gamma and beta: Boost.Math. The others have closed forms.
/// \param p  0 … 1
/// \throws InputError  GC-GUM-0124 for a distribution with a problem, GC-GUM-0125 if p is not from 0 to 1
/// Accuracy: the tail probability of the x that is returned is p within 1e-9 relative, from p = 1e-12 on
/// (docs/accuracy.md#coverage-factors-and-quantiles).
/// Example: examples/api/coverage_factor.cpp
[[nodiscard]] double quantile(const Distribution& distribution, double p);

/// The x with P(X > x) = q, for upper tails too small to be written as 1 - q; else as quantile(1 - q).
[[nodiscard]] double upper_quantile(const Distribution& distribution, double q);

}  // namespace gumcert::gum
