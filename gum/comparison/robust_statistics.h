#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace gumcert::gum {

/// Location and scale of results, and the standard uncertainty of the location, all in the unit of the results.
struct RobustEstimate {
    double location = 0.0;
    double scale = 0.0;  ///< robust standard deviation s*
    double u = 0.0;      ///< standard uncertainty of the location
    double rest = 0.0;   ///< the location is location + rest: what the nearest double leaves
};

/// u(x*) = 1.25 s*/√p of p results (ISO 13528:2022, clause 7); √(π/2) ≈ 1.2533 for a median.
inline constexpr double k_robust_location_factor = 1.25;

// All estimates are the same, to the last bit, for any order of the results.

/// Middle value; the mean of the two middle ones for an even number of results.
/// \throws InputError  GC-GUM-0001 not finite, GC-GUM-0100 no results
[[nodiscard]] double median(std::span<const double> results);

/// Median with the scaled median absolute deviation MADe = 1.483 med|x − med x| as scale, u = 1.25 s / √p.
/// (ISO 13528:2022, annex C) A scale of 0 is returned as it is: more than half of the results are equal.
/// \throws InputError  GC-GUM-0001, -0101 fewer than 2 results
[[nodiscard]] RobustEstimate median_with_made(std::span<const double> results);

/// Normalised interquartile range 0.7413 (Q3 − Q1), quartiles by linear interpolation between order statistics
/// (type 7 of Hyndman and Fan).
/// \throws InputError  GC-GUM-0001, -0101 fewer than 2 results
[[nodiscard]] double normalised_interquartile_range(std::span<const double> results);

/// Constants of algorithm A: those that ISO 13528 prints (1.483 and 1.134), or the exact consistency factors of the
/// normal distribution (Huber's proposal 2 with c = 1.5).
enum class AlgorithmAConstants { published, exact };

/// Algorithm A: results are drawn in to x* ± 1.5 s*, x* is their mean and s* = 1.134 times their standard deviation,
/// from x* = median, s* = MADe on until both stand still (1e-16 of s*).              (ISO 13528:2022, annex C)
/// Where MADe is 0, because more than half of the results are equal, it begins with their standard deviation.
/// u = 1.25 s* / √p
/// Accuracy: relative error below 1e-10, of most results 1e-12 (docs/accuracy.md#comparisons-and-robust-statistics).
/// Example: examples/api/proficiency_test.cpp
/// \throws InputError  GC-GUM-0001; GC-GUM-0101 fewer than 2 results; GC-GUM-0102 s* comes out as 0: all results are
///                     equal, or so many of them that the others are drawn in to them. Report the median, or use
///                     Q/Hampel, or more digits
/// \throws NoResultError  GC-GUM-0103 not converged after 10 000 steps
[[nodiscard]] RobustEstimate algorithm_a(std::span<const double> results,
                                         AlgorithmAConstants constants = AlgorithmAConstants::published);

/// Limit factor η and adjustment factor ξ of algorithm S for ν degrees of freedom of each standard deviation, computed
/// from the chi-square distribution (agrees with the published factors to 0.001).
struct AlgorithmSFactors {
    double limit = 0.0, adjustment = 0.0;
};
/// η² ν is the 0.9 quantile of χ²(ν); 1/ξ² = P(χ²(ν + 2) ≤ η² ν) + 0.1 η².
/// \param degrees_of_freedom  0 < ν ≤ 1e10.
/// \throws InputError  GC-GUM-0001 also for ν so small that ξ is no number, GC-GUM-0003, GC-GUM-0005 for ν > 1e10
[[nodiscard]] AlgorithmSFactors algorithm_s_factors(double degrees_of_freedom);

/// Algorithm S: robust pooled standard deviation w* of standard deviations (or ranges) with ν degrees of freedom each.
/// Those above η w* are drawn in to it, w* = ξ √(Σ w²/p).                             (ISO 13528:2022, annex C)
/// Where the steps of the algorithm lead, without steps: with η ξ > 1 only one w* > 0 stays as it is.
/// \return w* > 0.
/// \throws InputError  GC-GUM-0001, -0002 for a standard deviation, GC-GUM-0100 none at all, GC-GUM-0102 the median is
///     0, or w* is
[[nodiscard]] double algorithm_s(std::span<const double> standard_deviations, double degrees_of_freedom);
/// With stated factors, for instance as printed: both > 0, η ξ > 1.
/// \throws InputError  GC-GUM-0003 also for the factors
[[nodiscard]] double algorithm_s(std::span<const double> standard_deviations, const AlgorithmSFactors& factors);

/// Q method for the scale (pairwise differences) and Hampel's estimator for the location, both exact without
/// iteration.                                                                          (ISO 13528:2022, annex C)
/// u = 1.25 s* / √p; time n log n, not n².
/// The scale is a quantile of the differences |x_i − x_j|, between whose distinct values it is interpolated:
/// differences that are apart by no more than the rounding of the numbers (2.5 units in the last place of max|x|, where
/// no more than 100 times med|x| count: a result in a wrong unit does not blur the others) are one value. The location
/// is the root of Σ ψ((x_i − x*)/s*) between the smallest and the largest result that is nearest the median, and the
/// median itself where two are; ψ has the corners 1.5, 3 and 4.5.
/// \throws InputError  GC-GUM-0001; GC-GUM-0101 fewer than 2 results; GC-GUM-0102 all results are equal
[[nodiscard]] RobustEstimate q_hampel(std::span<const double> results);
/// The same where at least half of the results lie within 4.5 s* of the location, so that ψ lets them speak for it. Of two
/// groups of equal size far apart every ψ is 0 at the median between them: that solves the equation and is the value of
/// nobody.
/// \throws NoResultError  GC-GUM-0144 for others
[[nodiscard]] RobustEstimate supported_q_hampel(std::span<const double> results);

/// Greatest mode of a Gaussian kernel density of the results; the lowest one where several are equally high.
/// (ISO 13528:2022, annex D)
/// \param bandwidth  standard deviation of the kernel, > 0
/// \throws InputError  GC-GUM-0001, GC-GUM-0003 for the bandwidth, GC-GUM-0100 no results
[[nodiscard]] double kernel_density_mode(std::span<const double> results, double bandwidth);

}  // namespace gumcert::gum
