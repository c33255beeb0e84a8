#pragma once

#include <span>

namespace gumcert::gum {

// The distributions of sums of squared scores whose uncertainties have finite degrees of freedom.

/// λ T² with T of Student's distribution with ν degrees of freedom; normal where ν is infinite.
struct SquaredT {
    double weight = 1.0;              ///< λ ≥ 0
    double degrees_of_freedom = 1.0;  ///< ν > 0
};

/// P(Q ≤ x) of Q = Σ λ_k T_k² with T_k independent of each other: every uncertainty was estimated by itself.
///
/// T² = Z²/S with S = χ²_ν/ν, so that the Laplace transform of Q is Π E[(1 + 2 λ_k s/S)^(−1/2)]; it is inverted along a
/// hyperbola through the saddle point, as that of weighted_chi_square_lower_tail(), with steps that are halved until two
/// of them agree. A fixed path does not resolve many terms, whose relative width is √(2/n).
/// \param terms  not all of weight 0, in any order; weights that differ by less than 1e8
/// \param x      finite; 0 is returned below 0
/// \throws InputError  GC-GUM-0001 or -0002 for a weight, -0003 where all are 0, -0005 for ν, -0001 for x
/// \throws NoResultError  GC-GUM-0140 where the integral does not converge
/// Accuracy: absolute error below 1e-9 for up to 3000 terms; both tails add up to 1. k_least_tail_of_t stands for everything below it
/// (docs/accuracy.md#comparisons-and-robust-statistics).
[[nodiscard]] double squared_t_lower_tail(std::span<const SquaredT> terms, double x);
/// P(Q ≥ x).
[[nodiscard]] double squared_t_upper_tail(std::span<const SquaredT> terms, double x);
/// The x with P(Q ≤ x) = p.
/// \throws InputError  as above; GC-GUM-0004 for the probability
[[nodiscard]] double squared_t_quantile(std::span<const SquaredT> terms, double probability);
inline constexpr double k_least_tail_of_t = 1e-10;

/// P(Q ≤ x) of Q = Σ λ_k Z_k²/S, S = χ²_ν/ν the same for all of them: one estimate is behind all uncertainties, and the
/// scores have a multivariate t distribution (JCGM 102:2011, 5.3.2).
/// \param weights             λ_k as in weighted_chi_square_lower_tail()
/// \param degrees_of_freedom  ν > 0; infinite: as weighted_chi_square_lower_tail()
/// \throws InputError, NoResultError  as weighted_chi_square_lower_tail(); GC-GUM-0005 for ν
/// Accuracy: relative error below 1e-8, also far out in the tails (docs/accuracy.md#comparisons-and-robust-statistics)
[[nodiscard]] double common_t_lower_tail(std::span<const double> weights, double degrees_of_freedom, double x);
/// P(Q ≥ x).
[[nodiscard]] double common_t_upper_tail(std::span<const double> weights, double degrees_of_freedom, double x);
/// The x with P(Q ≤ x) = p.
[[nodiscard]] double common_t_quantile(std::span<const double> weights, double degrees_of_freedom, double probability);

}  // namespace gumcert::gum
