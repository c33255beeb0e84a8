#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

namespace gumcert::gum {

/// Standard uncertainty of the mean of n independent observations.
///
/// u(x̄) = s / √n                                                                        (JCGM 100:2008, 4.2.3)
/// \param standard_deviation  s ≥ 0, experimental standard deviation of one observation (also a pooled one)
/// \param observations        n ≥ 1, number of observations that the mean is taken of
/// \return u, in the unit of s
/// \throws InputError  GC-GUM-0001, -0002 or -0020 for an argument out of range
/// Not valid for observations that depend on each other (drift, autocorrelation): u would be too small.
[[nodiscard]] double u_of_mean(double standard_deviation, std::size_t observations);

/// What n observations of one quantity say, in the unit of the observations.
struct ObservationSummary {
    std::size_t observations = 0;             ///< n
    double mean = 0.0;                        ///< x̄
    double standard_deviation = 0.0;          ///< s, of one observation
    double standard_deviation_of_mean = 0.0;  ///< s / √n: the Type A standard uncertainty of the mean
    double degrees_of_freedom = 0.0;          ///< n − 1
};

/// Mean, experimental standard deviation and standard deviation of the mean.
///
/// x̄ = Σ x_k / n, s² = Σ (x_k − x̄)² / (n − 1), s(x̄) = s / √n              (JCGM 100:2008, 4.2.1 to 4.2.3, eq. 3 to 5)
/// \param observations  x_k, n ≥ 2, independent of each other (see autocorrelation_check)
/// \throws InputError  GC-GUM-0001 not finite, GC-GUM-0021 fewer than two observations
/// \throws NoResultError  GC-GUM-0027 observations so large that their squares leave the range of numbers
/// Accuracy: two passes in long double; what is lost is the rounding of the observations themselves to double
/// (docs/accuracy.md#type-a-evaluation).
/// Example: examples/api/observations.cpp
[[nodiscard]] ObservationSummary evaluate_type_a(std::span<const double> observations);

/// Autocorrelation coefficients r_0 … r_m of a series.
///
/// r_h = Σ_{k=1}^{n−h} (x_k − x̄)(x_{k+h} − x̄) / Σ_{k=1}^{n} (x_k − x̄)²   (NIST/SEMATECH e-Handbook, 1.3.5.12)
/// \param observations  in the order in which they were made, at equal intervals
/// \param largest_lag   m < n
/// \return r_0 = 1, r_1, …, r_m
/// \throws InputError  GC-GUM-0001, -0021; GC-GUM-0022 lag not below n, GC-GUM-0023 all observations equal
[[nodiscard]] std::vector<double> autocorrelation(std::span<const double> observations, std::size_t largest_lag);

/// Whether observations look independent of their neighbours.
struct AutocorrelationCheck {
    double lag_one = 0.0;     ///< r_1
    double limit = 0.0;       ///< 2 / √n: about 95 % of independent series stay within ±limit
    bool independent = true;  ///< |r_1| ≤ limit
};

/// Lag-one autocorrelation against ±2/√n.
///
/// Where r_1 > limit, s/√n understates the uncertainty of the mean; where r_1 < −limit, it overstates it. Nothing else
/// is computed then: what the uncertainty of the mean would be depends on a model of the series (JCGM 100:2008, 4.2.7
/// asks for statistical methods made for such data). Find the cause, observe at longer intervals, or use the means of
/// groups of observations that are long against the correlation. A series of fewer than about 10 observations shows
/// little.
/// \throws InputError  as autocorrelation()
[[nodiscard]] AutocorrelationCheck autocorrelation_check(std::span<const double> observations);

/// Standard deviation with its degrees of freedom.
struct StandardDeviation {
    double value = 0.0;               ///< s ≥ 0
    double degrees_of_freedom = 0.0;  ///< ν > 0
};

/// Pooled standard deviation of series of the same dispersion.
///
/// s_p² = Σ ν_i s_i² / Σ ν_i, with Σ ν_i degrees of freedom              (its use: JCGM 100:2008, 4.2.4)
/// \param series  s_i with ν_i, at least one, all in the same unit
/// \throws InputError  GC-GUM-0001, -0002, -0003, GC-GUM-0024 no series
/// Valid where the series have one dispersion in common. The standard uncertainty of a mean of n new observations of
/// that dispersion is s_p/√n, with the degrees of freedom of s_p.
[[nodiscard]] StandardDeviation pooled_standard_deviation(std::span<const StandardDeviation> series);

/// Relative standard deviation of an experimental standard deviation of n normally distributed observations.
///
/// σ[s] / E[s] = √(1 − c₄²) / c₄, with c₄ = √(2/(n − 1)) Γ(n/2) / Γ((n − 1)/2)         (values of JCGM 100:2008, table
/// E.1)
/// \param observations  n ≥ 2
/// \return ratio, 0.76 for n = 2, about 1/√(2(n − 1)) for large n
/// \throws InputError GC-GUM-0021
/// Accuracy: relative error below 1e-10 (docs/accuracy.md#type-a-evaluation).
[[nodiscard]] double relative_standard_deviation_of_s(std::size_t observations);

/// Degrees of freedom of a Type B standard uncertainty that is thought to be known to a relative part r.
///
/// ν = 1 / (2 r²)                                                                  (JCGM 100:2008, G.4.2, eq. G.3)
/// \param relative_uncertainty  r = Δu/u > 0, e.g. 0.25 for "about 25 %"
/// \throws InputError  GC-GUM-0001 or -0003
[[nodiscard]] double degrees_of_freedom_from_reliability(double relative_uncertainty);

/// Means of q quantities that were observed together n times.
struct SimultaneousMeans {
    Eigen::VectorXd means;            ///< q
    Eigen::MatrixXd covariance;       ///< q×q, of the means
    Eigen::MatrixXd correlation;      ///< q×q; 0 beside a quantity that did not vary
    double degrees_of_freedom = 0.0;  ///< n − 1
};

/// Means of simultaneous observations with their covariance.
///
/// s(q̄, r̄) = Σ_k (q_k − q̄)(r_k − r̄) / (n (n − 1))                                (JCGM 100:2008, 5.2.3, eq. 17)
/// \param observations  n×q, row k = one set of simultaneous observations, n ≥ 2
/// \throws InputError  GC-GUM-0001, GC-GUM-0021 fewer than two rows, GC-GUM-0025 no column
/// With n − 1 < q the covariance matrix is singular: the sets are too few to tell all quantities apart.
[[nodiscard]] SimultaneousMeans evaluate_simultaneous(const Eigen::MatrixXd& observations);

}  // namespace gumcert::gum
