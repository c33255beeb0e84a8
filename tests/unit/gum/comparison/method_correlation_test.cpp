#include "gum/comparison/method_correlation.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using Eigen::MatrixXd;
using test::code_of;

/// Two points with u = 1 and 0.5, whose values share so much of their uncertainty in each method.
MethodComparison methods_sharing(double covariance, double reference_covariance) {
    MethodComparison comparison;
    comparison.points.resize(2);
    comparison.covariance = (MatrixXd(2, 2) << 1.0, covariance, covariance, 1.0).finished();
    comparison.reference_covariance =
        (MatrixXd(2, 2) << 0.25, reference_covariance, reference_covariance, 0.25).finished();
    return comparison;
}

TEST(IsPossibleCovariance, JointlyPositiveSemiDefinite) {
    const MatrixXd one = MatrixXd::Identity(1, 1);
    EXPECT_TRUE(is_possible_covariance(one, one, 0.999 * one));
    EXPECT_TRUE(is_possible_covariance(one, one, -one)) << "r = -1";
    EXPECT_FALSE(is_possible_covariance(one, one, 1.01 * one));
}

TEST(StatedCorrelationOfMethods, OfEqualPointsWhereThatCanBe) {
    const StatedCorrelation stated = stated_correlation(0.6, methods_sharing(0.0, 0.0), {"", ""}, "correlation");
    EXPECT_EQ(stated.from, CorrelationFrom::each_point);
    EXPECT_DOUBLE_EQ(stated.covariance(0, 0), 0.3);
    EXPECT_EQ(stated.covariance(0, 1), 0.0);
}

TEST(StatedCorrelationOfMethods, OfAnEffectThatAllPointsShare) {
    const StatedCorrelation stated = stated_correlation(0.6, methods_sharing(1.0, 0.25), {"", ""}, "correlation");
    EXPECT_EQ(stated.from, CorrelationFrom::all_points);
    EXPECT_DOUBLE_EQ(stated.covariance(0, 1), 0.3);
}

TEST(StatedCorrelationOfMethods, ThatCannotBeIsRefused) {
    // The points of one method share everything with the same sign, those of the other with the opposite one.
    EXPECT_EQ(code_of<InputError>([] {
                  (void)stated_correlation(0.9, methods_sharing(1.0, -0.25), {"", ""}, "correlation");
              }),
              "GC-COMPARE-0204");
}

}  // namespace
}  // namespace gumcert::gum
