#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "gum/monte_carlo/monte_carlo_statistics.h"

namespace gumcert::gum {

/// How many trials fall into cells of equal width from `low` to `high`, for the figures of documents.
struct Histogram {
    double low = 0.0;   ///< [unit of y]
    double high = 0.0;  ///< [unit of y], > low where there are cells
    /// One a cell, in ascending order; empty: none, because the values do not vary. A value on the limit of two cells
    /// counts for the upper one, and `high` for the last cell. Values outside low … high are not counted.
    std::vector<std::uint64_t> counts;
};

/// Sixty empty cells over mean ± 4 standard deviations, but from the smallest to the largest value at most: a heavy
/// tail is cut, so that the middle can be seen.
/// \param moments  of all values that will be counted, finite
/// \return no cells where the values do not vary, or lie too close together or too far apart for 60 cells in double
[[nodiscard]] Histogram empty_histogram(const Moments& moments);

/// Counts values into the cells. The order of the values makes no difference.
void count_values(const double* values, Eigen::Index count, Histogram& histogram);

}  // namespace gumcert::gum
