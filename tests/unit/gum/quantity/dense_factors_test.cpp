#include "gum/quantity/dense_factors.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gumcert::gum {
namespace {

// The second difference, 2 on the diagonal and −1 beside it: its eigenvalues are 2 − 2 cos(kπ/(n+1)), its Cholesky
// factor has the diagonal √((k+1)/k), and its determinant is n + 1.
Eigen::MatrixXd second_difference(Eigen::Index n) {
    Eigen::MatrixXd matrix = 2.0 * Eigen::MatrixXd::Identity(n, n);
    matrix.diagonal(1).setConstant(-1.0);
    matrix.diagonal(-1).setConstant(-1.0);
    return matrix;
}

double eigenvalue(Eigen::Index k, Eigen::Index n) {
    return 2.0 - 2.0 * std::cos(static_cast<double>(k) * std::numbers::pi / static_cast<double>(n + 1));
}

class DenseFactors : public testing::TestWithParam<Eigen::Index> {};

TEST_P(DenseFactors, OfTheSecondDifference) {
    const Eigen::Index n = GetParam();
    const Eigen::MatrixXd matrix = second_difference(n);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(matrix);
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd(matrix);
    const Eigen::LLT<Eigen::MatrixXd> cholesky(matrix);
    ASSERT_EQ(eigen.info(), Eigen::Success);
    ASSERT_EQ(cholesky.info(), Eigen::Success);
    for (Eigen::Index k = 1; k <= n; ++k) {
        EXPECT_NEAR(eigen.eigenvalues()[k - 1], eigenvalue(k, n), 1e-12) << k;  // n ε ‖A‖ is 1.2E-13 for n = 130
        EXPECT_NEAR(svd.singularValues()[n - k], eigenvalue(k, n), 1e-12) << k;
        const auto whole = static_cast<double>(k);
        EXPECT_NEAR(cholesky.matrixLLT()(k - 1, k - 1), std::sqrt((whole + 1.0) / whole), 1e-12) << k;
    }
    EXPECT_NEAR((matrix * eigen.eigenvectors() - eigen.eigenvectors() * eigen.eigenvalues().asDiagonal()).norm(), 0.0,
                1e-12);
    const Eigen::HouseholderQR<Eigen::MatrixXd> qr(matrix);
    const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivoted(matrix);
    const auto determinant = static_cast<double>(n + 1);
    EXPECT_NEAR(qr.absDeterminant() / determinant, 1.0, 1e-12);
    EXPECT_NEAR(pivoted.absDeterminant() / determinant, 1.0, 1e-12);
    EXPECT_EQ(pivoted.rank(), n);
}

INSTANTIATE_TEST_SUITE_P(Sizes, DenseFactors, testing::Values(1, 2, 6, 50, 130));

TEST(DenseFactors, SayThatAMatrixIsNotDefinite) {
    Eigen::MatrixXd matrix = second_difference(4);
    matrix(2, 2) = -1.0;
    EXPECT_EQ(Eigen::LLT<Eigen::MatrixXd>(matrix).info(), Eigen::NumericalIssue);
    EXPECT_LT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[0], 0.0);
}

}  // namespace
}  // namespace gumcert::gum
