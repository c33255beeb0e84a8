#include "gum/nearest_correlation.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <random>

namespace gumcert::gum {
namespace {

// N. J. Higham, IMA J. Numer. Anal. 22 (2002), 329-343: the matrix of section 4 and the nearest one.
TEST(NearestCorrelation, PublishedExample) {
    Eigen::MatrixXd A(3, 3);
    A << 1.0, 1.0, 0.0, 1.0, 1.0, 1.0, 0.0, 1.0, 1.0;
    const auto nearest = nearest_correlation(A, Eigen::MatrixXd::Constant(3, 3, 2.0));
    ASSERT_TRUE(nearest);
    EXPECT_NEAR((*nearest)(0, 1), 0.7607, 5e-5);
    EXPECT_NEAR((*nearest)(0, 2), 0.1573, 5e-5);
    EXPECT_TRUE(is_positive_semidefinite(*nearest));
    EXPECT_FALSE(is_positive_semidefinite(A));
}

// Correlations of fewer random samples than quantities are singular; rounded to some digits they are not positive any
// more, and come back within half a unit of the last digit.
TEST(NearestCorrelation, ComesBackFromRoundedDigits) {
    std::mt19937 random(7);
    int rounded_away = 0;
    for (int round = 0; round < 60; ++round) {
        const Eigen::Index n = 3 + round % 5;
        Eigen::MatrixXd x(n, n - 1);
        for (Eigen::Index i = 0; i < x.size(); ++i) {
            x(i) = static_cast<double>(random()) / 4294967296.0 - 0.5;
        }
        x.rowwise().normalize();
        const double half_unit = round % 2 == 0 ? 5e-8 : 5e-4;
        Eigen::MatrixXd R = x * x.transpose();
        R = (R / (2.0 * half_unit)).array().round().matrix() * (2.0 * half_unit);
        R.diagonal().setOnes();
        rounded_away += is_positive_semidefinite(R) ? 0 : 1;
        const auto nearest = nearest_correlation(R, Eigen::MatrixXd::Constant(n, n, half_unit));
        ASSERT_TRUE(nearest) << round;
        EXPECT_TRUE(is_positive_semidefinite(*nearest)) << round;
        EXPECT_LE((*nearest - R).cwiseAbs().maxCoeff(), half_unit * (1.0 + 1e-9)) << round;
        EXPECT_EQ((*nearest - nearest->transpose()).cwiseAbs().maxCoeff(), 0.0) << round;
    }
    EXPECT_GT(rounded_away, 10);
}

TEST(NearestCorrelation, FindsNothingWhereNothingIs) {
    Eigen::MatrixXd A(3, 3);
    A << 1.0, 0.9, 0.9, 0.9, 1.0, -0.9, 0.9, -0.9, 1.0;
    EXPECT_FALSE(nearest_correlation(A, Eigen::MatrixXd::Constant(3, 3, 5e-4)));
    EXPECT_FALSE(nearest_correlation(A, Eigen::MatrixXd::Zero(3, 3)));
}

}  // namespace
}  // namespace gumcert::gum
