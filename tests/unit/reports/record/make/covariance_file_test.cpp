#include "reports/record/make/covariance_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <sstream>

#include "encoding/npy.h"

namespace gumcert::reports {
namespace {

/// Three angles of two quantities, one of no angle; in micrometres and arcseconds.
struct Sample {
    engine::AnglewiseCovariance covariance;
    std::vector<std::string> names{"a@0", "b@0", "a@1", "b@1", "a@2", "b@2", "O"};
    std::vector<double> units{1e-6, 5e-6, 1e-6, 5e-6, 1e-6, 5e-6, 1e-6};
};

Sample sample() {
    Eigen::MatrixXd shared(7, 2);
    Eigen::MatrixXd half(7, 2);
    Eigen::MatrixXd own(6, 2);
    for (Eigen::Index i = 0; i < 7; ++i) {
        const auto x = static_cast<double>(i);
        shared.row(i) << 1e-6 * (1.0 + x), -2e-6 * x;
        half.row(i) << 1e-6 * (0.5 - x), 3e-6;
    }
    for (Eigen::Index i = 0; i < 3; ++i) {
        own.middleRows<2>(2 * i) << 4e-12, 1e-13, 1e-13, 9e-12;
    }
    Sample result;
    result.covariance = engine::AnglewiseCovariance(shared, half, own);
    return result;
}

Eigen::MatrixXd expected_of(const Sample& sample) {
    Eigen::MatrixXd expected = sample.covariance.dense();
    for (Eigen::Index i = 0; i < 7; ++i) {
        for (Eigen::Index j = 0; j < 7; ++j) {
            expected(i, j) /= sample.units[static_cast<std::size_t>(i)] * sample.units[static_cast<std::size_t>(j)];
        }
    }
    return expected;
}

/// The matrix in a NumPy file, as a reader of the format takes it.
Eigen::MatrixXd matrix_in(const std::string& file, std::size_t rows, std::size_t columns) {
    const std::string header = encoding::npy_header(rows, columns);
    EXPECT_EQ(file.substr(0, header.size()), header);
    EXPECT_EQ(file.size(), header.size() + 8 * rows * columns);
    Eigen::MatrixXd result(rows, columns);
    for (std::size_t i = 0; i < rows * columns; ++i) {
        std::memcpy(&result(static_cast<Eigen::Index>(i / columns), static_cast<Eigen::Index>(i % columns)),
                    file.data() + header.size() + 8 * i, 8);
    }
    return result;
}

TEST(CovarianceFile, AllFormsHoldTheSameMatrix) {
    const Sample of = sample();
    const Eigen::MatrixXd expected = expected_of(of);
    const double tolerance = 1e-12 * expected.cwiseAbs().maxCoeff();

    const Eigen::MatrixXd npy =
        matrix_in(covariance_contents(of.covariance, of.names, of.units, CovarianceForm::npy), 7, 7);
    EXPECT_LT((npy - expected).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_EQ(npy, npy.transpose());

    // V = H Lᵀ + L Hᵀ + O, the rows of O holding the block of their angle.
    const Eigen::MatrixXd parts =
        matrix_in(covariance_contents(of.covariance, of.names, of.units, CovarianceForm::parts), 7, 6);
    Eigen::MatrixXd again = parts.leftCols(2) * parts.middleCols(2, 2).transpose();
    again += again.transpose().eval();
    for (Eigen::Index i = 0; i < 6; i += 2) {
        again.block<2, 2>(i, i) += parts.block<2, 2>(i, 4);
    }
    EXPECT_LT((again - expected).cwiseAbs().maxCoeff(), tolerance);
    EXPECT_TRUE(parts.bottomRightCorner(1, 2).isZero(0.0));

    std::istringstream csv(covariance_contents(of.covariance, of.names, of.units, CovarianceForm::csv));
    std::string line;
    std::getline(csv, line);
    EXPECT_EQ(line, "a@0,b@0,a@1,b@1,a@2,b@2,O");
    for (Eigen::Index i = 0; std::getline(csv, line); ++i) {
        std::istringstream row(line);
        std::string cell;
        for (Eigen::Index j = 0; std::getline(row, cell, ','); ++j) {
            EXPECT_EQ(std::stod(cell), npy(i, j)) << i << ' ' << j;
        }
    }
}

TEST(CovarianceFile, FormFollowsTheNumberOfQuantitiesAndTheNameTellsIt) {
    EXPECT_EQ(chosen_form(CovarianceForm::automatic, 1000), CovarianceForm::csv);
    EXPECT_EQ(chosen_form(CovarianceForm::automatic, 1001), CovarianceForm::parts);
    EXPECT_EQ(chosen_form(CovarianceForm::npy, 7), CovarianceForm::npy);
    for (const CovarianceForm form : {CovarianceForm::csv, CovarianceForm::npy, CovarianceForm::parts}) {
        EXPECT_EQ(form_of_file("covariance-0123456789ab" + covariance_ending(form)), form);
    }
    EXPECT_EQ(form_of_file(""), CovarianceForm::none);
    EXPECT_EQ(covariance_form("parts"), CovarianceForm::parts);
    EXPECT_EQ(covariance_form("auto"), CovarianceForm::automatic);
    EXPECT_FALSE(covariance_form("mtx").has_value());
}

}  // namespace
}  // namespace gumcert::reports
