#include "gum/comparison/shared_sources.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace gumcert::gum {
namespace {

using testing::IsEmpty;

using Sources = std::vector<UncertaintySource>;

TEST(SharedCovariance, OneContributionOnEachSideIsPairedWithItsSign) {
    const std::vector<SourceCovariance> found =
        shared_covariance({{"laser", "l", 0.3}}, {{"laser", "x", -0.2}, {"sensor", "t", 0.5}}, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].source, "laser");
    EXPECT_DOUBLE_EQ(found[0].covariance, -0.06);
    EXPECT_FALSE(found[0].ambiguous);
}

TEST(SharedCovariance, ContributionsArePairedByTheNameOfTheirInput) {
    const std::vector<SourceCovariance> found =
        shared_covariance({{"laser", "wavelength", 0.3}, {"laser", "dead path", 0.1}},
                          {{"laser", "dead path", -0.4}, {"laser", "wavelength", 0.2}}, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_DOUBLE_EQ(found[0].covariance, 0.3 * 0.2 - 0.1 * 0.4);
    EXPECT_FALSE(found[0].ambiguous);
}

TEST(SharedCovariance, WhatCannotBePairedIsTakenAtItsLargest) {
    const std::vector<SourceCovariance> found =
        shared_covariance({{"laser", "a", 0.3}, {"laser", "b", -0.4}}, {{"laser", "c", -0.2}}, {});
    ASSERT_EQ(found.size(), 1U);
    EXPECT_DOUBLE_EQ(found[0].covariance, 0.5 * 0.2);
    EXPECT_TRUE(found[0].ambiguous);
    // The input that both have is paired, the others are not.
    const std::vector<SourceCovariance> partly =
        shared_covariance({{"laser", "a", 0.3}, {"laser", "b", -0.4}}, {{"laser", "a", -1.0}, {"laser", "c", 0.2}}, {});
    EXPECT_DOUBLE_EQ(partly[0].covariance, -0.3 + 0.08);
    EXPECT_TRUE(partly[0].ambiguous);
    // Nothing is left on one side: nothing to be unsure of.
    EXPECT_FALSE(shared_covariance({{"laser", "a", 0.3}, {"laser", "b", 0.4}}, {{"laser", "a", 1.0}}, {})[0].ambiguous);
}

TEST(SharedCovariance, IndependentAndUnnamedSourcesAreNotShared) {
    const Sources first{{"laser", "l", 0.3}, {"", "x", 1.0}};
    const Sources second{{"laser", "l", 0.2}, {"", "x", 1.0}};
    EXPECT_THAT(shared_covariance(first, second, {"laser"}), IsEmpty());
    EXPECT_EQ(shared_covariance(first, second, {"sensor"}).size(), 1U);
    EXPECT_THAT(shared_covariance({}, second, {}), IsEmpty());
}

TEST(SharedCovariance, PartsThatParticipantsStateThemselvesHaveNoInput) {
    EXPECT_DOUBLE_EQ(shared_covariance({{"NMI", "", 0.3}}, {{"NMI", "", 0.2}}, {})[0].covariance, 0.06);
}

TEST(CrossCovariance, InputsOfOnePointCorrelateEqualPointsOnly) {
    const PointSources method{
        .all = {{{"laser", "l", 0.3}, {"chart", "r", 0.1}}, {{"laser", "l", 0.6}, {"chart", "r", 0.1}}},
        .common = {{{"laser", "l", 0.3}}, {{"laser", "l", 0.6}}}};
    const PointSources reference{
        .all = {{{"laser", "l", 0.2}, {"chart", "r", 0.5}}, {{"laser", "l", -0.2}, {"chart", "r", 0.5}}},
        .common = {{{"laser", "l", 0.2}}, {{"laser", "l", -0.2}}}};
    const Eigen::MatrixXd C = cross_covariance_of_sources(method, reference, {});
    EXPECT_NEAR(C(0, 0), 0.06 + 0.05, 1e-15);
    EXPECT_NEAR(C(0, 1), -0.06, 1e-15);
    EXPECT_NEAR(C(1, 0), 0.12, 1e-15);
    EXPECT_NEAR(C(1, 1), -0.12 + 0.05, 1e-15);
    EXPECT_NEAR(cross_covariance_of_sources(method, reference, {"laser"})(0, 1), 0.0, 1e-15);
}

}  // namespace
}  // namespace gumcert::gum
