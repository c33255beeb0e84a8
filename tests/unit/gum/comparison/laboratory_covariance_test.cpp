#include "gum/comparison/laboratory_covariance.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/comparison/stated_comparison.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;

TEST(LaboratoryCovariance, OfSourcesThatTwoResultsName) {
    test::StatedComparison stated = test::key_comparison();
    stated.results[0].sources = {{"laser 7", "", 0.08}};
    stated.results[1].sources = {{"laser 7", "", 0.08}};
    stated.results[2].sources = {{"laser 7", "", -0.05}, {"thermometer", "", 0.1}};
    stated.results[3].sources = {{"thermometer", "", 0.1}};
    stated.scheme.independent_sources = {"thermometer"};
    LaboratoryData data = laboratory_data(stated.scheme, stated.results).front();
    std::vector<SharedSource> shared;
    std::set<std::string> ambiguous;
    const Eigen::MatrixXd covariance = laboratory_covariance(stated.scheme, data, shared, ambiguous);
    ASSERT_EQ(covariance.rows(), 6);
    EXPECT_DOUBLE_EQ(covariance(0, 1), 0.0064);
    EXPECT_DOUBLE_EQ(covariance(2, 0), -0.004);
    EXPECT_EQ(covariance(2, 3), 0.0);
    EXPECT_DOUBLE_EQ(covariance(5, 5), 0.09);
    ASSERT_EQ(shared.size(), 3U);
    EXPECT_EQ(shared[0].source, "laser 7");
    EXPECT_DOUBLE_EQ(shared[0].correlation, 0.0064 / (0.10 * 0.15));
    EXPECT_TRUE(ambiguous.empty());
}

TEST(LaboratoryCovariance, APairTakesThePlaceOfItsGroup) {
    test::StatedComparison stated = test::key_comparison();
    stated.scheme.participants[0].group = stated.scheme.participants[1].group = "NMI-X";
    stated.scheme.group_correlation = {{"NMI-X", 0.1}};
    EXPECT_DOUBLE_EQ(stated.data().covariance(0, 1), 0.1 * 0.10 * 0.15);
    stated.scheme.correlations = {{1, 0, 0.6}};
    EXPECT_DOUBLE_EQ(stated.data().covariance(0, 1), 0.6 * 0.10 * 0.15);
}

TEST(LaboratoryCovariance, TooManyCorrelatedResultsAreRefused) {
    const std::vector<double> same(k_most_correlated_laboratories + 1, 1.0);
    test::StatedComparison stated = test::comparison_of(same, same);
    for (ComparisonParticipant& participant : stated.scheme.participants) {
        participant.group = "G";
    }
    stated.scheme.group_correlation = {{"G", 0.1}};
    EXPECT_EQ(code_of<InputError>([&] { (void)stated.data(); }), "GC-COMPARE-0103");
}

TEST(UnknownGroup, TheLeastVarianceOfADifferenceThatTwoMayShare) {
    // Two equal members of a group in a mean of three: with all in common, cov = u², u²(d_1) loses
    // 2 (1 − 1/3) u²/3 − ... = wᵀVw − 2 (Vw)_1 = 2 u²/9 − 2 u²/3.
    test::StatedComparison stated = test::comparison_of({1.0, 1.1, 1.2}, {0.3, 0.3, 0.3});
    stated.scheme.participants[0].group = stated.scheme.participants[1].group = "G";
    const std::vector<std::optional<double>> change =
        least_variance_of_unknown_groups(stated.scheme, stated.data(), Eigen::VectorXd::Constant(3, 1.0 / 3.0));
    EXPECT_NEAR(change[0].value(), (2.0 / 9.0 - 2.0 / 3.0) * 0.09, 1e-15);
    EXPECT_NEAR(change[1].value(), change[0].value(), 1e-15);
    EXPECT_FALSE(change[2]);
}

}  // namespace
}  // namespace gumcert::gum
