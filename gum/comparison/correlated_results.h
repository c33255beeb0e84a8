#pragma once

#include <Eigen/Core>
#include <cstddef>

#include "gum/comparison/reference_value.h"

namespace gumcert::gum {

/// Number of the result with the smallest standard uncertainty: what values are centred on before they are squared, so
/// that the digits which all values share are gone. It is the one that a weighted mean lies closest to.
[[nodiscard]] Eigen::Index most_precise(const LaboratoryResults& results);

/// Correlation matrix of the results; the diagonal of the covariance need not be exactly u².
/// \param results  with a covariance, of fitting size
[[nodiscard]] Eigen::MatrixXd correlations_of(const LaboratoryResults& results);

/// A matrix L with L Lᵀ = R, the correlation matrix, for R positive semi-definite.
/// \return n×n; lower triangular where R is positive definite
[[nodiscard]] Eigen::MatrixXd root_of_correlations(const Eigen::MatrixXd& correlations);

/// The results as tests of consistency take them: those of finite degrees of freedom with the u that makes
/// (x_i − y)/u_i the normal quantity which has the tail of this t. y is the value with the least sum of squares of
/// these. Results that correlate keep their u, and get one number of degrees of freedom for all; normal ones are left.
[[nodiscard]] LaboratoryResults as_normal_results(const LaboratoryResults& results);

/// The chi-square that a set of so many results exceeds with the probability alpha.
/// \param degrees_of_freedom  of one estimate behind all u of results that correlate; infinite without
[[nodiscard]] double critical_chi_square(std::size_t results, double alpha, double degrees_of_freedom);

/// require_results() for a number of results that may be 1.
void require_results(const LaboratoryResults& results, std::size_t fewest);

}  // namespace gumcert::gum
