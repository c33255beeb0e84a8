#include "gum/monte_carlo/monte_carlo_histogram.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace gumcert::gum {
namespace {

constexpr std::size_t k_histogram_cells = 60;
constexpr double k_standard_deviations = 4.0;

}  // namespace

Histogram empty_histogram(const Moments& moments) {
    // A heavy tail would press all other trials into one cell.
    const double reach = k_standard_deviations * moments.standard_deviation();
    Histogram result;
    // Where the sums of squares leave the range of double, `reach` is not finite, and the extremes remain.
    result.low = std::max(moments.smallest, moments.mean - reach);
    result.high = std::min(moments.largest, moments.mean + reach);
    const double cells_a_unit = static_cast<double>(k_histogram_cells) / (result.high - result.low);
    if (result.low < result.high && std::isfinite(cells_a_unit) && cells_a_unit > 0.0) {
        result.counts.assign(k_histogram_cells, 0);
    } else {
        result.low = result.high = 0.0;
    }
    return result;
}

void count_values(const double* values, Eigen::Index count, Histogram& histogram) {
    if (histogram.counts.empty()) {
        return;
    }
    const double low = histogram.low;
    const double high = histogram.high;
    const double cells_a_unit = static_cast<double>(histogram.counts.size()) / (high - low);
    const auto last = static_cast<std::int32_t>(histogram.counts.size() - 1);
    for (Eigen::Index i = 0; i < count; ++i) {
        const double y = values[i];
        if (y >= low && y <= high) {
            // A value on the upper end counts for the last cell.
            const auto cell = std::min(static_cast<std::int32_t>((y - low) * cells_a_unit), last);
            ++histogram.counts[static_cast<std::size_t>(cell)];
        }
    }
}

}  // namespace gumcert::gum
