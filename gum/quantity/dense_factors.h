#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>
#include <Eigen/SVD>

// Factors of dense matrices, compiled once: each of them takes the compiler 5 to 8 seconds, and some twenty sources need
// one. They are compiled once only where what is factored is a matrix itself, not an expression:
// SelfAdjointEigenSolver<MatrixXd>(MatrixXd(a * b)). Fixed sizes and those of run time differ in the last bits.
//
// Other sources include this header in place of Eigen's own; tests/lint/check_includes.py demands it.

namespace Eigen {

extern template class SelfAdjointEigenSolver<MatrixXd>;
extern template SelfAdjointEigenSolver<MatrixXd>& SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd>&,
                                                                                            int);
extern template class SelfAdjointEigenSolver<Matrix<double, 6, 6>>;
extern template SelfAdjointEigenSolver<Matrix<double, 6, 6>>& SelfAdjointEigenSolver<Matrix<double, 6, 6>>::compute(
    const EigenBase<Matrix<double, 6, 6>>&, int);
extern template class JacobiSVD<MatrixXd>;
extern template class HouseholderQR<MatrixXd>;
extern template class ColPivHouseholderQR<MatrixXd>;
extern template class LLT<MatrixXd>;
extern template LLT<MatrixXd>& LLT<MatrixXd>::compute(const EigenBase<MatrixXd>&);

}  // namespace Eigen
