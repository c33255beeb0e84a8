#pragma once

#include <Eigen/Core>
#include <vector>

namespace gumcert::gum {

/// L with L Lᵀ = R, lower triangular, by Cholesky steps that pass over the columns of a singular matrix: r = ±1 gives
/// the same deviate to the last bit.
/// \param correlation  n×n, positive semi-definite
[[nodiscard]] Eigen::MatrixXd semidefinite_root(const Eigen::MatrixXd& correlation);

/// Normal deviates some of which are known: those that are not are G times the known ones and a remainder.
struct ConditionalNormal {
    std::vector<Eigen::Index> given, others;  ///< positions, ascending
    Eigen::MatrixXd coefficients;             ///< G = R_og R_gg⁺, others × given
    Eigen::MatrixXd root;                     ///< L with L Lᵀ = R_oo − G R_go, others square, lower triangular
};

/// \param correlation  n×n, positive semi-definite
/// \param is_given     n
[[nodiscard]] ConditionalNormal conditional_normal(const Eigen::MatrixXd& correlation,
                                                   const std::vector<bool>& is_given);

}  // namespace gumcert::gum
