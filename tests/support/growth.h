#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>

namespace gumcert::test {

/// The power of n by which the processor time of some work grows from n to 4n: 1 is linear, 2 the square. Ratios of one
/// process: how fast the machine is does not matter, and the least of several times leaves out what disturbs it.
template <class Make, class Work>
double growth_of(std::size_t n, const Make& make, const Work& work) {
    const auto least_time = [&](std::size_t size) {
        const auto input = make(size);
        double least = INFINITY;
        for (int i = 0; i < 4; ++i) {
            const std::clock_t begin = std::clock();
            work(input);
            least = std::min(least, static_cast<double>(std::clock() - begin));
        }
        return std::max(least, 1.0);
    };
    const double once = least_time(n);
    const double twice = least_time(2 * n);
    const double four_times = least_time(4 * n);
    return std::max(std::log2(four_times / once) / 2.0, std::log2(four_times / twice));
}

/// What a reader of files of others may grow by: linear, with a logarithm and what is left of disturbances.
inline constexpr double k_linear = 1.45;

}  // namespace gumcert::test
