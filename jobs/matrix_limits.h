#pragma once

#include <cstddef>

namespace gumcert::jobs {

/// Rows of a covariance or correlation matrix of a job: it is dense, and its eigenvalues are looked at.
inline constexpr std::size_t k_most_in_matrix = 2000;
/// Relative difference that two numbers of matrices may have which another program wrote with fewer digits.
inline constexpr double k_same_number = 1e-9;

}  // namespace gumcert::jobs
