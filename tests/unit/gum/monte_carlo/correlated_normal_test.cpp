#include "gum/monte_carlo/correlated_normal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace gumcert::gum {
namespace {

Eigen::MatrixXd three() {
    Eigen::MatrixXd R(3, 3);
    R << 1.0, 0.5, -0.3, 0.5, 1.0, 0.2, -0.3, 0.2, 1.0;
    return R;
}

TEST(SemidefiniteRoot, GivesTheMatrixBack) {
    const Eigen::MatrixXd L = semidefinite_root(three());
    EXPECT_LT((L * L.transpose() - three()).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(L(0, 1), 0.0);
    Eigen::MatrixXd singular(2, 2);
    singular << 1.0, -1.0, -1.0, 1.0;
    const Eigen::MatrixXd root = semidefinite_root(singular);
    EXPECT_EQ(root(1, 0), -1.0);
    EXPECT_EQ(root(1, 1), 0.0);
}

// Deviates G x + L e have the correlations of the whole matrix with the given ones and with each other.
TEST(ConditionalNormal, CompletesTheCorrelations) {
    const Eigen::MatrixXd R = three();
    const ConditionalNormal c = conditional_normal(R, {false, true, false});
    EXPECT_EQ(c.given, std::vector<Eigen::Index>{1});
    EXPECT_EQ(c.others, (std::vector<Eigen::Index>{0, 2}));
    EXPECT_NEAR(c.coefficients(0, 0), 0.5, 1e-15);
    EXPECT_NEAR(c.coefficients(1, 0), 0.2, 1e-15);
    const Eigen::MatrixXd own = c.coefficients * c.coefficients.transpose() + c.root * c.root.transpose();
    EXPECT_NEAR(own(0, 0), 1.0, 1e-15);
    EXPECT_NEAR(own(1, 1), 1.0, 1e-15);
    EXPECT_NEAR(own(0, 1), -0.3, 1e-15);
}

TEST(ConditionalNormal, TakesSingularMatrices) {
    const Eigen::MatrixXd R = Eigen::MatrixXd::Ones(3, 3);
    const ConditionalNormal c = conditional_normal(R, {true, true, false});
    EXPECT_NEAR(c.coefficients.sum(), 1.0, 1e-14);
    EXPECT_LT(c.root.cwiseAbs().maxCoeff(), 1e-7);
}

}  // namespace
}  // namespace gumcert::gum
