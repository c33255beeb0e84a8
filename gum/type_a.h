#pragma once

#include <cstddef>

namespace gumcert::gum {

/// Standard uncertainty of the mean of n independent observations.
///
/// u(x̄) = s / √n                                                                        (JCGM 100:2008, 4.2.3)
/// \param standard_deviation  s ≥ 0, experimental standard deviation of one observation (also a pooled one)
/// \param observations        n ≥ 1, number of observations that the mean is taken of
/// \return u, in the unit of s
/// \throws InputError  GC-GUM-0001, -0002 or -0020 for an argument out of range
/// Not valid for observations that depend on each other (drift, autocorrelation): u would be too small.
[[nodiscard]] double u_of_mean(double standard_deviation, std::size_t observations);

}  // namespace gumcert::gum
