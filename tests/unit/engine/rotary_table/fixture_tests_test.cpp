// What is wrong with the coordinates of a fixture is named: points, its size, or nothing.
#include "engine/rotary_table/fixture_tests.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace gumcert::engine {
namespace {

constexpr double k_u = 1e-6;  // of each coordinate, [m]

double tail_of_fixture(double value, double /*degrees_of_freedom*/) {
    return std::exp(-0.5 * std::max(value, 0.0));
}
const GroupTestOptions k_options{0.01, tail_of_fixture};

Eigen::MatrixX3d five_points() {
    Eigen::MatrixX3d points(5, 3);
    points << 0.03, 0.06, 0.0, 0.09, 0.062, 0.07, 0.15, 0.061, -0.08, 0.09, -0.08, 0.02, 0.02, -0.05, -0.06;
    return points;
}

/// Coordinates that distances know independently of each other, and find off by some displacements, 5×3.
FixtureMisfit misfit_of(const Eigen::MatrixX3d& off) {
    const Eigen::VectorXd in_order = off.transpose().reshaped(off.size(), 1);
    return {in_order / (k_u * k_u), Eigen::MatrixXd::Identity(off.size(), off.size()) / (k_u * k_u), 1.0};
}

TEST(FixtureTests, NameTheReflectorsThatAreDisplaced) {
    const GroupJudgement judgement(k_options);
    Eigen::MatrixX3d off = Eigen::MatrixX3d::Zero(5, 3);
    off.row(2) << 30e-6, 0.0, 40e-6;
    off.row(4) << 0.0, -20e-6, 0.0;
    const std::vector<GroupTest> tests = fixture_tests(misfit_of(off), five_points(), judgement);
    ASSERT_EQ(tests.size(), 2U);
    EXPECT_EQ(tests[0].kind, GroupKind::reflector);
    EXPECT_EQ(tests[0].reflector, 2U);
    EXPECT_NEAR(tests[0].estimate, 50e-6, 1e-12);
    EXPECT_EQ(tests[1].reflector, 4U);
    EXPECT_NEAR(tests[1].estimate, 20e-6, 1e-12);
    EXPECT_TRUE(tests[0].suspicious && tests[1].suspicious);
    EXPECT_NEAR(largest_fixture_misfit(misfit_of(off), five_points(), judgement), 2500.0, 1e-6);
}

TEST(FixtureTests, NameTheSizeOfTheFixture) {
    const GroupJudgement judgement(k_options);
    const Eigen::MatrixX3d off = 2e-4 * five_points();
    const std::vector<GroupTest> tests = fixture_tests(misfit_of(off), five_points(), judgement);
    ASSERT_FALSE(tests.empty());
    EXPECT_EQ(tests[0].kind, GroupKind::fixture_scale);
    EXPECT_NEAR(tests[0].estimate, 2e-4, 1e-12);
    for (std::size_t i = 1; i < tests.size(); ++i) {
        EXPECT_FALSE(tests[i].suspicious) << "the size is taken away before a point is tested again";
    }
}

TEST(FixtureTests, AccuseNothingOfASoundFixture) {
    const GroupJudgement judgement(k_options);
    const Eigen::MatrixX3d off = Eigen::MatrixX3d::Constant(5, 3, 0.3 * k_u);
    const std::vector<GroupTest> tests = fixture_tests(misfit_of(off), five_points(), judgement);
    ASSERT_EQ(tests.size(), 2U);
    EXPECT_EQ(tests[0].kind, GroupKind::fixture_scale);
    EXPECT_EQ(tests[1].kind, GroupKind::reflector);
    EXPECT_FALSE(tests[0].suspicious || tests[1].suspicious);
    EXPECT_EQ(largest_fixture_misfit(misfit_of(off), five_points(), judgement), 0.0);
}

TEST(FixtureTests, SayNothingOfThreePoints) {
    const GroupJudgement judgement(k_options);
    const Eigen::MatrixX3d points = five_points().topRows(3);
    Eigen::MatrixX3d off = Eigen::MatrixX3d::Zero(3, 3);
    off(0, 0) = 1e-3;
    EXPECT_TRUE(fixture_tests(misfit_of(off), points, judgement).empty());
}

}  // namespace
}  // namespace gumcert::engine
