#include "gum/rotary_table/studies/difference_tally.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gumcert::gum {
namespace {

TEST(DifferenceTally, SeparatesDatumFromMeasurement) {
    // One angle and the set-up; of the first error motion the datum takes 2, the measurement 1.
    Eigen::VectorXd value = Eigen::VectorXd::Zero(10);
    const Eigen::VectorXd assumed = Eigen::VectorXd::Zero(10);
    Eigen::VectorXd in_datum = Eigen::VectorXd::Zero(10);
    const Eigen::VectorXd u = Eigen::VectorXd::Constant(10, 0.4);
    const Eigen::VectorXd k = Eigen::VectorXd::Constant(10, 2.0);
    value(0) = 3.0;
    in_datum(0) = 2.0;
    const Tallies tallies = tally_of_campaign(value, assumed, in_datum, u, k, 6);
    EXPECT_DOUBLE_EQ(tallies[0].rms(), 3.0);
    EXPECT_DOUBLE_EQ(tallies[0].datum_rms(), 2.0);
    EXPECT_DOUBLE_EQ(tallies[0].measurement_rms(), 1.0);
    EXPECT_DOUBLE_EQ(tallies[0].normalised_rms(), 2.5);
    EXPECT_EQ(tallies[0].covered, 0U);  // 1 > 2 · 0.4
    EXPECT_EQ(tallies[k_linear_tally].count, 3U);
    EXPECT_DOUBLE_EQ(tallies[k_linear_tally].mean_absolute(), 1.0);
    EXPECT_NEAR(tallies[k_linear_tally].coverage(), 2.0 / 3.0, 1e-15);
    EXPECT_EQ(tallies[k_angular_tally].count, 3U);
    EXPECT_EQ(tallies[k_offset_tally].count, 2U);
    EXPECT_EQ(tallies[k_tilt_tally].count, 2U);
    EXPECT_EQ(tallies[k_all_tally].count, 10U);
}

TEST(DifferenceTally, StandardErrorOfACoverageIsThatOfItsCampaigns) {
    const Eigen::VectorXd zero = Eigen::VectorXd::Zero(10);
    const Eigen::VectorXd one = Eigen::VectorXd::Ones(10);
    Tallies sum = tally_of_campaign(zero, zero, zero, one, one, 6);   // all covered
    add(sum, tally_of_campaign(5.0 * one, zero, zero, one, one, 6));  // none covered
    EXPECT_DOUBLE_EQ(sum[k_all_tally].coverage(), 0.5);
    EXPECT_DOUBLE_EQ(sum[k_all_tally].coverage_standard_error(), 0.5);  // s of 1 and 0 is sqrt(1/2); divided by sqrt(2)
    EXPECT_DOUBLE_EQ(sum[k_all_tally].mean_largest(), 2.5);
    EXPECT_DOUBLE_EQ(Tallies{}[0].coverage_standard_error(), 0.0);
}

}  // namespace
}  // namespace gumcert::gum
