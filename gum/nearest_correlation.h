#pragma once

#include <Eigen/Core>
#include <optional>

namespace gumcert::gum {

/// True when no eigenvalue of a symmetric matrix is negative by more than rounding may leave.
[[nodiscard]] bool is_positive_semidefinite(const Eigen::MatrixXd& correlation);

/// The correlation matrix that is nearest to a symmetric one (in the sum of squared differences), each coefficient
/// within its tolerance: projections onto the positive semi-definite matrices and onto the box of the tolerances in
/// turn, with the correction of Dykstra (Higham 2002, IMA J. Numer. Anal. 22, 329-343, has the unit diagonal in place
/// of the box).
/// \param correlation  n×n, symmetric, 1 on the diagonal
/// \param tolerance    n×n, ≥ 0; 0 for a coefficient that must stay
/// \return nothing when there is none, or the projections do not arrive
[[nodiscard]] std::optional<Eigen::MatrixXd> nearest_correlation(const Eigen::MatrixXd& correlation,
                                                                 const Eigen::MatrixXd& tolerance);

}  // namespace gumcert::gum
