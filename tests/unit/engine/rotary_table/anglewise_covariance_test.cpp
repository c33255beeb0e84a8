#include "engine/rotary_table/anglewise_covariance.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/support/synthetic_campaign.h"

namespace gumcert::engine {
namespace {

Eigen::MatrixXd random(Eigen::Index rows, Eigen::Index columns, synthetic::Noise& noise) {
    Eigen::MatrixXd result(rows, columns);
    for (double& value : result.reshaped()) {
        value = noise.normal();
    }
    return result;
}

/// All ways to an element give the same number, for any numbers of angles, quantities of an angle, and columns.
TEST(AnglewiseCovariance, ElementsRowsAnglesAndTheWholeAgree) {
    synthetic::Noise noise(11);
    for (int repeat = 0; repeat < 50; ++repeat) {
        const Eigen::Index angles = 1 + repeat % 7;
        const Eigen::Index q = 1 + repeat % 6;
        const Eigen::Index others = repeat % 5;
        const Eigen::Index columns = 1 + repeat % 4;
        const Eigen::Index rows = q * angles + others;
        const Eigen::MatrixXd shared = random(rows, columns, noise);
        const Eigen::MatrixXd half = random(rows, columns, noise);
        Eigen::MatrixXd own = random(q * angles, q, noise);
        Eigen::MatrixXd expected = shared * half.transpose() + half * shared.transpose();
        for (Eigen::Index i = 0; i < angles; ++i) {
            const Eigen::MatrixXd block = own.middleRows(q * i, q) + own.middleRows(q * i, q).transpose();
            own.middleRows(q * i, q) = block;
            expected.block(q * i, q * i, q, q) += block;
        }
        const AnglewiseCovariance covariance(shared, half, own);
        const double tolerance = 1e-13 * expected.cwiseAbs().maxCoeff();
        ASSERT_EQ(covariance.rows(), rows);
        EXPECT_LT((covariance.dense() - expected).cwiseAbs().maxCoeff(), tolerance);
        EXPECT_EQ(covariance.dense(), covariance.dense().transpose());
        EXPECT_LT((covariance.diagonal() - expected.diagonal()).cwiseAbs().maxCoeff(), tolerance);
        const Eigen::MatrixXd combinations = random(3, rows, noise);
        const Eigen::MatrixXd combined = combinations * expected * combinations.transpose();
        EXPECT_LT((covariance.of_combinations(combinations) - combined).cwiseAbs().maxCoeff(),
                  1e-12 * combined.cwiseAbs().maxCoeff());
        for (Eigen::Index i = 0; i < rows; ++i) {
            EXPECT_LT((covariance.row(i) - expected.row(i)).cwiseAbs().maxCoeff(), tolerance);
            for (Eigen::Index j = 0; j < rows; ++j) {
                EXPECT_NEAR(covariance(i, j), expected(i, j), tolerance);
            }
        }
        const std::vector<Eigen::Index> some{rows - 1, 0, std::min<Eigen::Index>(5, rows - 1)};
        EXPECT_LT((covariance.of(some) - expected(some, some)).cwiseAbs().maxCoeff(), tolerance);
        for (Eigen::Index i = 0; i < angles; ++i) {
            EXPECT_LT((covariance.of_angle(i) - expected.block(q * i, q * i, q, q)).cwiseAbs().maxCoeff(), tolerance);
        }
    }
}

TEST(AnglewiseCovariance, OfADenseMatrixIsThatMatrix) {
    synthetic::Noise noise(12);
    const Eigen::MatrixXd root = random(9, 9, noise);
    const Eigen::MatrixXd dense = root * root.transpose();
    const AnglewiseCovariance covariance(dense);
    EXPECT_EQ(covariance.rows(), 9);
    EXPECT_LT((covariance.dense() - dense).cwiseAbs().maxCoeff(), 1e-14 * dense.cwiseAbs().maxCoeff());
    EXPECT_LT((covariance.diagonal() - dense.diagonal()).cwiseAbs().maxCoeff(), 1e-14 * dense.cwiseAbs().maxCoeff());
}

TEST(AnglewiseCovariance, OfNothingHasNoRows) {
    EXPECT_EQ(AnglewiseCovariance().rows(), 0);
}

}  // namespace
}  // namespace gumcert::engine
