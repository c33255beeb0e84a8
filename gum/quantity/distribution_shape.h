#pragma once

#include "gum/quantity/distribution.h"

#include <limits>

namespace gumcert::gum {

/// μ₃/σ³ and μ₄/σ⁴ of the distribution, [1]: third and fourth central moments over powers of the standard deviation.
/// 0 and 3 of a constant. Infinite or NaN where none exists (t with ν ≤ 3 and ν ≤ 4).
[[nodiscard]] double skewness(const Distribution& distribution);
[[nodiscard]] double kurtosis(const Distribution& distribution);

/// Smallest and largest value of the distribution, [unit of location]; infinite where there is none.
struct Support {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
};
[[nodiscard]] Support support(const Distribution& distribution);

}  // namespace gumcert::gum
