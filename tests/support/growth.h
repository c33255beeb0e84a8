#pragma once

#include <malloc.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>

namespace gumcert::test {

/// The power of n by which the processor time of some work grows from n to 4n: 1 is linear, 2 the square. Ratios of one
/// process: how fast the machine is does not matter. What disturbs a measurement makes it longer for once: the least of
/// several times counts, and the least of several growths, until one is below `enough`.
template <class Make, class Work>
double growth_of(std::size_t n, const Make& make, const Work& work, double enough) {
    // Memory that was given back to the system is cleared page by page when it is taken again: that is time of the system,
    // which large inputs have and small ones have not.
    (void)mallopt(M_MMAP_MAX, 0);
    (void)mallopt(M_TRIM_THRESHOLD, -1);
    const auto small = make(n);
    const auto large = make(4 * n);
    const auto least_time = [&](const auto& input) {
        double least = INFINITY;
        for (int i = 0; i < 4; ++i) {
            const std::clock_t begin = std::clock();
            work(input);
            least = std::min(least, static_cast<double>(std::clock() - begin));
        }
        return std::max(least, 1.0);
    };
    double growth = INFINITY;
    for (int attempt = 0; attempt < 8 && !(growth < enough); ++attempt) {
        growth = std::min(growth, std::log2(least_time(large) / least_time(small)) / 2.0);
    }
    return growth;
}

/// What a reader of files of others may grow by: linear, with a logarithm and what is left of disturbances.
inline constexpr double k_linear = 1.5;

}  // namespace gumcert::test
