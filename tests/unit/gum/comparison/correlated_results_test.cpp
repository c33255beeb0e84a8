#include "gum/comparison/correlated_results.h"

#include <gtest/gtest.h>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;
using test::message_of;

LaboratoryResults three_results() {
    LaboratoryResults results{.x = Eigen::Vector3d(10.0, 11.0, 12.0), .u = Eigen::Vector3d(2.0, 0.5, 1.0)};
    results.covariance = results.u.cwiseAbs2().asDiagonal();
    results.covariance(0, 1) = results.covariance(1, 0) = 0.6;
    results.covariance(1, 2) = results.covariance(2, 1) = -0.125;
    return results;
}

TEST(CorrelatedResults, MostPreciseHasTheSmallestUncertainty) {
    EXPECT_EQ(most_precise(three_results()), 1);
    EXPECT_EQ(most_precise({.x = Eigen::VectorXd::Zero(2), .u = Eigen::Vector2d(0.1, 0.1)}), 0)
        << "the first of equals";
}

TEST(CorrelatedResults, CorrelationsAreCovariancesByUncertainties) {
    LaboratoryResults results = three_results();
    Eigen::Matrix3d expected;
    expected << 1.0, 0.6, 0.0, 0.6, 1.0, -0.25, 0.0, -0.25, 1.0;
    EXPECT_TRUE(correlations_of(results).isApprox(expected, 1e-15)) << correlations_of(results);
    // A covariance stated with few digits: its diagonal is not u² to the last one, a correlation of 1 rounds above 1.
    results.covariance(0, 0) = 4.0000001;
    results.covariance(0, 1) = results.covariance(1, 0) = 1.0000001;
    expected(0, 1) = expected(1, 0) = 1.0;
    EXPECT_TRUE(correlations_of(results).isApprox(expected, 1e-15)) << correlations_of(results);
}

TEST(CorrelatedResults, RootTimesItsTransposeIsTheCorrelation) {
    const Eigen::MatrixXd definite = correlations_of(three_results());
    const Eigen::MatrixXd root = root_of_correlations(definite);
    EXPECT_TRUE(root.isLowerTriangular());
    EXPECT_TRUE((root * root.transpose()).isApprox(definite, 1e-14));
    // Two results that are one: no Cholesky factor.
    Eigen::Matrix3d singular;
    singular << 1.0, -1.0, 0.5, -1.0, 1.0, -0.5, 0.5, -0.5, 1.0;
    const Eigen::MatrixXd other = root_of_correlations(singular);
    EXPECT_TRUE((other * other.transpose()).isApprox(singular, 1e-14));
}

TEST(CorrelatedResults, FewestIsWhatTheCallerNeeds) {
    const LaboratoryResults one{.x = Eigen::VectorXd::Constant(1, 3.0), .u = Eigen::VectorXd::Constant(1, 0.1)};
    EXPECT_NO_THROW(require_results(one, 1));
    EXPECT_EQ(code_of<InputError>([&] { require_results(one, 2); }), "GC-GUM-0131");
    EXPECT_EQ(message_of<InputError>([] { require_results(three_results(), 4); }),
              "results — only 3 — a comparison needs at least 4 — Give the results of more laboratories.");
    EXPECT_NO_THROW(require_results(three_results(), 3));
}

TEST(CorrelatedResults, AreRefusedWithWhatDoesNotFit) {
    LaboratoryResults results = three_results();
    results.covariance.conservativeResize(2, 3);
    EXPECT_EQ(
        message_of<InputError>([&] { require_results(results, 1); }),
        "covariance of the results — 2 rows and 3 columns for 3 results — one row and one column for every result — "
        "Correct the covariance.");
    results = three_results();
    results.u.conservativeResize(2);
    EXPECT_EQ(code_of<InputError>([&] { require_results(results, 1); }), "GC-GUM-0135");
    results = three_results();
    results.u(1) = 1e-160;
    EXPECT_EQ(code_of<InputError>([&] { require_results(results, 1); }), "GC-GUM-0142");
}

}  // namespace
}  // namespace gumcert::gum
