#include "gum/budget/joint_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/reported_covariance.h"
#include "gum/monte_carlo/random_draws.h"
#include "gum/propagation.h"
#include "gum/quantity/dense_factors.h"
#include "tests/support/case_count.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::input;

struct Regions {
    BudgetResult result;
    Eigen::MatrixXd covariance;
    std::optional<JointRegion> region;
};

Regions regions_of(const Budget& of) {
    Regions made{.result = evaluate_budget(of, 1), .covariance = {}, .region = {}};
    made.covariance = reported_covariance(of, made.result);
    made.region = joint_region(of, made.result.points[0], made.covariance);
    return made;
}

/// Shares of draws, other ones than those of the program, in the ellipsoid and in the rectangle about what is reported.
std::pair<double, double> covered(const Regions& made, int trials = 200'000) {
    const BudgetPointResult& point = made.result.points[0];
    const InputDraws draws(point.model->inputs(), 77, point.streams);
    Eigen::MatrixXd x(trials, draws.size());
    Eigen::MatrixXd y(trials, static_cast<Eigen::Index>(point.outputs.size()));
    draws.draw(0, x);
    point.model->evaluate_trials(x, y);
    const Eigen::MatrixXd linear =
        (x.rowwise() - input_estimates(*point.model).transpose()) * point.propagation.jacobian.transpose();
    for (std::size_t i = 0; i < point.outputs.size(); ++i) {
        const auto j = static_cast<Eigen::Index>(i);
        if (point.outputs[i].by_monte_carlo) {
            y.col(j).array() -= point.outputs[i].monte_carlo->mean;
        } else {
            y.col(j) = linear.col(j);
        }
    }
    const Eigen::MatrixXd inverse = made.covariance.inverse();
    const Eigen::VectorXd u = made.covariance.diagonal().cwiseSqrt();
    int in_ellipsoid = 0;
    int in_rectangle = 0;
    for (Eigen::Index r = 0; r < y.rows(); ++r) {
        const Eigen::VectorXd d = y.row(r).transpose();
        in_ellipsoid += d.dot(inverse * d) <= std::pow(made.region->ellipsoid_factor.value_or(0.0), 2) ? 1 : 0;
        in_rectangle += d.cwiseAbs().cwiseQuotient(u).maxCoeff() <= *made.region->rectangle_factor ? 1 : 0;
    }
    return {static_cast<double>(in_ellipsoid) / trials, static_cast<double>(in_rectangle) / trials};
}

Budget at_95(Budget of) {
    of.coverage_probability = 0.95;
    return of;
}

// n = a with three readings, q = e²: factors that were counted in standard deviations of the trials, 1.7 u(n), covered
// 88 % when they were stated beside u(n).
TEST(JointRegion, OfAMixIsStatedAboutWhatIsReported) {
    const Regions made = regions_of(at_95(test::budget(
        {"n = a*1", "q = e^2"}, {input("a", state_uncertainty(1, 1, 3)), input("e", state_uncertainty(3, 1))})));
    ASSERT_TRUE(made.result.points[0].outputs[1].by_monte_carlo);
    ASSERT_FALSE(made.result.points[0].outputs[0].by_monte_carlo);
    ASSERT_TRUE(made.region);
    EXPECT_TRUE(made.region->of_trials);
    const auto [ellipsoid, rectangle] = covered(made);
    EXPECT_NEAR(ellipsoid, 0.95, 0.003);
    EXPECT_NEAR(rectangle, 0.95, 0.003);
    // All of it together cannot need less than one of them alone.
    EXPECT_GE(*made.region->rectangle_factor, *made.result.points[0].outputs[0].coverage_factor - 0.02);
}

// Sums of two means of three readings: k is taken from the convolution, 4.59; k_q is that for 0.975, not t of some ν.
TEST(JointRegion, OfTheLawIsNotSmallerThanTheSingleIntervals) {
    for (const double nu : {2.0, 3.0, 6.0}) {
        const Regions made =
            regions_of(at_95(test::budget({"y = a + b", "z = a - 2*b"}, {input("a", state_uncertainty(1, 1, nu)),
                                                                         input("b", state_uncertainty(0, 1, nu))})));
        ASSERT_TRUE(made.region->rectangle_factor) << nu;
        for (const BudgetOutputResult& output : made.result.points[0].outputs) {
            EXPECT_GT(*made.region->rectangle_factor, *output.coverage_factor) << nu;
        }
        const auto [ellipsoid, rectangle] = covered(made);
        EXPECT_NEAR(ellipsoid, 0.95, 0.003) << nu;
        EXPECT_GT(rectangle, 0.948) << nu;
        EXPECT_LT(rectangle, 0.975) << nu;
    }
}

TEST(JointRegion, OfNormalResultsHasTheFactorsOfTheDocument) {
    const Regions made = regions_of(at_95(test::budget(
        {"y = a + b", "z = a - b"}, {input("a", state_uncertainty(1, 1)), input("b", state_uncertainty(0, 1))})));
    EXPECT_NEAR(*made.region->ellipsoid_factor, 2.4477, 1e-4);  // JCGM 102:2011, 6.5.2: 2.45
    EXPECT_EQ(made.region->ellipsoid_error, 0.0);
    EXPECT_NEAR(*made.region->rectangle_factor, 2.2414, 1e-4);
}

// Four points on a line, nothing stated: one scale, ν = 2, k_p = √(2 F(2, 2)) = √38 = 6.16; three points, ν = 1.
TEST(JointRegion, OfAFitHasOneUnknownScale) {
    for (const std::vector<double>& y :
         {std::vector<double>{1.02, 2.98, 5.05, 6.93}, std::vector<double>{1.0, 3.1, 4.9}}) {
        Budget of = at_95(test::budget({"A = a*1", "B = b*1"}, {}));
        of.fits = {test::line(y)};
        const Regions made = regions_of(of);
        const double nu = static_cast<double>(y.size()) - 2.0;
        ASSERT_TRUE(made.region->ellipsoid_factor) << nu;
        EXPECT_NEAR(*made.region->ellipsoid_factor, std::sqrt(nu * (std::pow(0.05, -2.0 / nu) - 1.0)), 1e-8) << nu;
        EXPECT_EQ(made.region->degrees_of_freedom, nu);
    }
}

TEST(JointRegion, OfOneEnsembleIsThatOfWhatIsDrawn) {
    Budget of = at_95(test::budget({"y = a + b", "z = a - 2*b"},
                                   {input("a", state_uncertainty(1, 1, 6)), input("b", state_uncertainty(0, 1, 6))}));
    test::correlate(of, "a", "b", 0.3);
    const Regions made = regions_of(of);
    EXPECT_NEAR(*made.region->ellipsoid_factor, 3.207, 1e-3);  // √(2 F(2, 6))
    EXPECT_NEAR(covered(made).first, 0.95, 0.003);
}

// Readings that were taken together estimate a whole matrix: Hotelling's T², 2 · 5/4 · F(2, 4) = 17.361.
TEST(JointRegion, OfSimultaneousReadingsIsHotellings) {
    Budget of = at_95(
        test::budget({"y = a + b", "z = a - 2*b"}, {input("a", state_observations({1.0, 1.3, 0.8, 1.1, 0.9, 1.2})),
                                                    input("b", state_observations({2.0, 2.1, 1.7, 2.2, 2.0, 1.9}))}));
    test::take_together(of);
    Regions made = regions_of(of);
    EXPECT_NEAR(*made.region->ellipsoid_factor, std::sqrt(2.0 * 5.0 / 4.0 * 6.9443), 1e-3);
    of.inputs.push_back(input("c", state_uncertainty(0, 0.1)));
    of.model[0].text = "y = a + b + c";
    made = regions_of(of);
    EXPECT_FALSE(made.region->ellipsoid_factor);
    EXPECT_EQ(made.region->no_ellipsoid_because, "distribution");
    EXPECT_TRUE(made.region->rectangle_factor);
}

// The law of the regions, over generated mixes of distributions, of results of the law and of Monte Carlo: the share that
// is covered is the stated one, at least that of a rectangle of the law.
TEST(JointRegion, OfGeneratedMixesCoversWhatItStates) {
    unsigned state = 3;
    const auto next = [&state] {
        state = state * 1664525U + 1013904223U;
        return static_cast<double>(state >> 16U) / 65536.0 * 4.0 - 2.0;
    };
    const int rounds = gumcert::test::cases(4, 8);
    for (int round = 0; round < rounds; ++round) {
        const auto term = [&](const std::string& name) { return test::digits(next()) + "*" + name; };
        Budget of = at_95(test::budget(
            {"y1 = " + term("a") + " + " + term("b"), "y2 = " + term("a") + " + " + term("c") + " + " + term("d"),
             round % 2 == 0 ? "y3 = " + term("d") + "*d + " + term("b") : "y3 = " + term("c") + " + " + term("d")},
            {input("a", state_uncertainty(1, 1, 3 + round)), input("b", test::rectangular(2, 1)),
             input("c", state_uncertainty(1, 1, 5)), input("d", state_uncertainty(1, 0.7))}));
        const Regions made = regions_of(of);
        ASSERT_TRUE(made.region && made.region->rectangle_factor && made.region->ellipsoid_factor) << round;
        const auto [ellipsoid, rectangle] = covered(made);
        EXPECT_NEAR(ellipsoid, 0.95, 0.004) << round;
        if (made.region->of_trials) {
            EXPECT_NEAR(rectangle, 0.95, 0.004) << round;
        } else {
            EXPECT_GT(rectangle, 0.946) << round;
        }
    }
}

}  // namespace
}  // namespace gumcert::gum
