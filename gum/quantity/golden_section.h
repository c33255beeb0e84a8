#pragma once

namespace gumcert::gum {

/// Where a function is least between two arguments, by the golden section: each step leaves 0.618 of the way. Of a function with
/// several minima it is one of them; of equal values the lower arguments are kept.
/// \param function  is asked `steps` + 2 times, in the same order for the same values
/// \param low,high  low <= high; there is no step where they are equal
template <class Function>
[[nodiscard]] double least_by_golden_section(const Function& function, double low, double high, int steps) {
    constexpr double k_golden = 0.6180339887498949;
    double inner_low = high - k_golden * (high - low);
    double inner_high = low + k_golden * (high - low);
    double at_low = function(inner_low);
    double at_high = function(inner_high);
    for (int i = 0; i < steps && low < high; ++i) {
        if (at_low <= at_high) {
            high = inner_high;
            inner_high = inner_low;
            at_high = at_low;
            inner_low = high - k_golden * (high - low);
            at_low = function(inner_low);
        } else {
            low = inner_low;
            inner_low = inner_high;
            at_low = at_high;
            inner_high = low + k_golden * (high - low);
            at_high = function(inner_high);
        }
    }
    return 0.5 * (low + high);
}

}  // namespace gumcert::gum
