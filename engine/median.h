#pragma once

#include <vector>

namespace gumcert::engine {

/// The middle one of some values; of an even number the upper one of the two in the middle.
/// \param values  n ≥ 1; reordered
[[nodiscard]] double upper_median(std::vector<double>& values);

/// The median: of an even number the mean of the two in the middle.
/// \param values  n ≥ 1; reordered
[[nodiscard]] double median(std::vector<double>& values);

}  // namespace gumcert::engine
