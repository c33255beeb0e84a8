#include "engine/median.h"

#include <algorithm>
#include <cstddef>

namespace gumcert::engine {

double upper_median(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

double median(std::vector<double>& values) {
    const double upper = upper_median(values);
    if (values.size() % 2 == 1) {
        return upper;
    }
    return 0.5 *
           (upper + *std::max_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2)));
}

}  // namespace gumcert::engine
