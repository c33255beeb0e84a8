#pragma once

#include <cstddef>

namespace gumcert::jobs {

// What a job may hold beside the numbers that its keys allow (docs/job_keys.md). `gumcert limits` prints these.

inline constexpr std::size_t k_most_points = 100'000;                    ///< of a budget, or of a section
inline constexpr std::size_t k_most_point_columns = 100;                 ///< of points that are no inputs
inline constexpr std::size_t k_most_fit_points = 100'000;                ///< observations of a fit
inline constexpr std::size_t k_most_tables = 100;                        ///< that a certificate shows
inline constexpr std::size_t k_most_compared_results = 25'000;           ///< what a record holds with all their scores
inline constexpr std::size_t k_most_reflectors = 500;                    ///< their covariance is dense
inline constexpr std::size_t k_most_distances = 1'000'000;               ///< of a layout, as of a file of lengths
inline constexpr std::size_t k_largest_picture = std::size_t{1} << 20U;  ///< logo or symbol, [byte]

/// Whether a stated coverage factor is one that people hardly mean (GC-WARN-0021): below 1, or above 14 with more than one degree
/// of freedom. 13.97 is that of 95.45 % with one degree of freedom; beyond it stand percentages.
[[nodiscard]] constexpr bool is_unusual_coverage_factor(double k, double degrees_of_freedom) {
    return k < 1.0 || (k > 14.0 && degrees_of_freedom > 1.0);
}

}  // namespace gumcert::jobs
