#include "gum/weighted_chi_square.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "gum/coverage.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;

TEST(WeightedChiSquare, EqualWeightsAreChiSquare) {
    for (const int m : {1, 2, 3, 5, 10, 30, 100, 500, 1500}) {
        const std::vector<double> weights(static_cast<std::size_t>(m), 2.5);
        for (const double ratio : {1e-6, 1e-3, 0.01, 0.1, 0.3, 0.5, 0.8, 0.95, 1.0, 1.05, 1.2, 1.5, 2.0, 5.0, 10.0}) {
            const double lower = chi_square_lower_tail(ratio * m, m);
            const double upper = chi_square_upper_tail(ratio * m, m);
            const double x = ratio * m * 2.5;
            EXPECT_NEAR(weighted_chi_square_lower_tail(weights, x), lower, 1e-9) << m << " " << ratio;
            EXPECT_NEAR(weighted_chi_square_upper_tail(weights, x), upper, 1e-9) << m << " " << ratio;
            if (lower > 1e-290) {
                EXPECT_TRUE(agrees(weighted_chi_square_lower_tail(weights, x), lower, 1e-9)) << m << " " << ratio;
            }
            if (upper > 1e-290) {
                EXPECT_TRUE(agrees(weighted_chi_square_upper_tail(weights, x), upper, 1e-9)) << m << " " << ratio;
            }
        }
    }
}

TEST(WeightedChiSquare, TwoWeightsAgreeWithTheirConvolution) {
    // P(Z1² + 0.2 Z2² <= x) as the integral of erf over the density of Z2, by adaptive quadrature
    // (scipy.integrate.quad, relative tolerance 1e-13), both tails on their own.
    struct Row {
        double x, lower, upper;
    };
    const std::array<double, 2> weights{1.0, 0.2};
    for (const Row& row : {Row{1e-12, 1.1180339887490562e-12, 0.999999999998882},
                           {1e-3, 0.0011171959754286516, 0.9988828040245713},
                           {0.3, 0.2719038802655735, 0.7280961197344266},
                           {1.2, 0.6688314548715021, 0.33116854512849797},
                           {5.0, 0.9710469436508955, 0.028953056349104535},
                           {20.0, 0.999991290633667, 8.709366332945909e-06},
                           {60.0, 0.9999999999999896, 1.0626987975558736e-14}}) {
        EXPECT_TRUE(agrees(weighted_chi_square_lower_tail(weights, row.x), row.lower, 1e-10)) << row.x;
        EXPECT_TRUE(agrees(weighted_chi_square_upper_tail(weights, row.x), row.upper, 1e-10)) << row.x;
    }
}

TEST(WeightedChiSquare, PairsOfWeightsAreSumsOfExponentials) {
    // Weights 1, 1, ½, ½, 0.2, 0.2: a sum of three exponential variables, whose upper tail is elementary.
    const std::array<double, 6> weights{0.2, 1.0, 0.5, 0.2, 0.5, 1.0};
    const std::array<double, 3> rate{0.5, 1.0, 2.5};
    for (const double x : {0.1, 1.0, 3.4, 10.0, 40.0, 60.0}) {
        double upper = 0.0;
        for (std::size_t i = 0; i < rate.size(); ++i) {
            double term = std::exp(-rate[i] * x);
            for (std::size_t j = 0; j < rate.size(); ++j) {
                term *= j == i ? 1.0 : rate[j] / (rate[j] - rate[i]);
            }
            upper += term;
        }
        EXPECT_TRUE(agrees(weighted_chi_square_upper_tail(weights, x), upper, 1e-9)) << x;
        EXPECT_NEAR(weighted_chi_square_lower_tail(weights, x), 1.0 - upper, 1e-10) << x;
    }
}

TEST(WeightedChiSquare, WeightsOf0AndTheOrderChangeNothing) {
    const std::vector<double> plain{3.0, 0.7, 0.1};
    const std::vector<double> padded{0.0, 0.1, 3.0, 0.0, 0.7, 0.0};
    for (const double x : {0.01, 1.0, 10.0, 40.0}) {
        EXPECT_EQ(weighted_chi_square_lower_tail(plain, x), weighted_chi_square_lower_tail(padded, x));
        EXPECT_EQ(weighted_chi_square_upper_tail(plain, x), weighted_chi_square_upper_tail(padded, x));
    }
    EXPECT_EQ(weighted_chi_square_quantile(plain, 0.3), weighted_chi_square_quantile(padded, 0.3));
}

TEST(WeightedChiSquare, WeightsOfVeryDifferentSize) {
    // The smallest ones are a constant beside the largest: P(Q <= x) near the chi-square of one degree of freedom.
    std::vector<double> weights{1.0};
    for (int i = 1; i <= 15; ++i) {
        weights.push_back(std::pow(10.0, -i - 5));
    }
    for (const double x : {0.5, 2.0, 8.0}) {
        EXPECT_NEAR(weighted_chi_square_lower_tail(weights, x), chi_square_lower_tail(x, 1.0), 2e-6);
    }
    double before = 0.0;
    for (double x = 1e-20; x < 1e3; x *= 10.0) {
        const double now = weighted_chi_square_lower_tail(weights, x);
        EXPECT_GE(now, before) << x;
        EXPECT_NEAR(now + weighted_chi_square_upper_tail(weights, x), 1.0, 1e-12) << x;
        before = now;
    }
}

TEST(WeightedChiSquare, OneLargeWeightAmongManySmallOnes) {
    // A common effect and 1999 small ones: chi-square of one degree of freedom behind a sharp edge at 0.5. A path of
    // integration that bends too far to the left does not converge here. Expected: the integral of erf over the density
    // of chi-square with 1999 degrees of freedom (scipy.integrate.quad).
    std::vector<double> weights(2000, 2.5e-4);
    weights.front() = 1.0;
    EXPECT_NEAR(weighted_chi_square_lower_tail(weights, 0.45), 2.5905068484125e-05, 1e-9);
    EXPECT_NEAR(weighted_chi_square_lower_tail(weights, 0.5), 0.04203947164964049, 1e-9);
    EXPECT_NEAR(weighted_chi_square_lower_tail(weights, 0.579), 0.22046837482645207, 1e-9);
    EXPECT_NEAR(weighted_chi_square_lower_tail(weights, 1.0), 0.5205272705914367, 1e-9);
    EXPECT_NEAR(weighted_chi_square_lower_tail(weights, 3.0), 0.8861654497758696, 1e-9);
}

TEST(WeightedChiSquare, StaysWithin0And1InTheFarTails) {
    std::vector<double> many;
    for (int i = 1; i <= 300; ++i) {
        many.push_back(1.0 / i);
    }
    for (const std::vector<double>& weights : {std::vector<double>{1.0}, {5.0, 1e-9}, many}) {
        for (const double x : {-1.0, 0.0, 5e-324, 1e-300, 1e-100, 1e-12, 1e3, 1e6, 1e100, 1e300}) {
            const double lower = weighted_chi_square_lower_tail(weights, x);
            const double upper = weighted_chi_square_upper_tail(weights, x);
            EXPECT_TRUE(lower >= 0.0 && lower <= 1.0) << x << " " << lower;
            EXPECT_TRUE(upper >= 0.0 && upper <= 1.0) << x << " " << upper;
            EXPECT_NEAR(lower + upper, 1.0, 1e-12) << x;
            EXPECT_NEAR(lower, x > 100.0 ? 1.0 : 0.0, 1e-5) << x;
        }
    }
}

TEST(WeightedChiSquare, ScalesWithItsUnit) {
    const std::array<double, 3> weights{3.0, 0.7, 0.1};
    const std::array<double, 3> smaller{3e-18, 0.7e-18, 0.1e-18};
    EXPECT_TRUE(
        agrees(weighted_chi_square_lower_tail(smaller, 2e-18), weighted_chi_square_lower_tail(weights, 2.0), 1e-12));
    EXPECT_TRUE(
        agrees(weighted_chi_square_quantile(smaller, 0.2), 1e-18 * weighted_chi_square_quantile(weights, 0.2), 1e-11));
}

TEST(WeightedChiSquareQuantile, InvertsTheTails) {
    std::vector<double> spread{1.0, 0.5, 0.2, 0.01, 1e-6};
    for (const double p : {1e-12, 1e-6, 0.025, 0.3, 0.5, 0.7, 0.975}) {
        const double x = weighted_chi_square_quantile(spread, p);
        EXPECT_TRUE(agrees(weighted_chi_square_lower_tail(spread, x), p, 1e-9)) << p;
        EXPECT_TRUE(agrees(weighted_chi_square_upper_tail(spread, weighted_chi_square_quantile(spread, 1.0 - p)),
                           1.0 - (1.0 - p), 1e-9))
            << p;
    }
    EXPECT_TRUE(agrees(weighted_chi_square_quantile(std::vector<double>(10, 1.0), 0.025), 3.2469727802368435,
                       1e-9));  // chi-square of 10 degrees of freedom, scipy.stats
}

TEST(WeightedChiSquare, TailsWhereTwoStepsOfIntegrationAgreeByChance) {
    // Ruben's series in 120 digits (mpmath), both tails. Halving the step changes the integral by less than 1e-7 while
    // it is still off by 2.6e-9.
    const std::vector weights{0.37085653462296136, 0.5578206109367435,  0.8462154423954876,
                              0.165402269477973,   0.10075648928631767, 0.8362998010466539,
                              0.10306477918599072, 0.7523563387714265,  0.13058400054699493};
    EXPECT_TRUE(agrees(weighted_chi_square_upper_tail(weights, 7.726712532541098), 0.062607998298512483, 1e-12));
    EXPECT_TRUE(agrees(weighted_chi_square_lower_tail(weights, 7.726712532541098), 0.937392001701487517, 1e-12));
}

TEST(WeightedChiSquare, FarBelowEveryWeight) {
    // P(Z² ≤ x) = √(2x/π) for small x.
    EXPECT_TRUE(
        agrees(weighted_chi_square_lower_tail(std::vector{1.0}, 1e-99), std::sqrt(2e-99 / 3.14159265358979324), 1e-12));
    EXPECT_EQ(weighted_chi_square_lower_tail(std::vector{1.0}, 1e-101), 0.0);
    EXPECT_EQ(weighted_chi_square_upper_tail(std::vector{1.0}, 1e-101), 1.0);
}

TEST(WeightedChiSquare, Refusals) {
    const double nan = std::nan("");
    EXPECT_EQ(code_of<InputError>([&] { (void)weighted_chi_square_lower_tail(std::vector<double>{}, 1.0); }),
              "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)weighted_chi_square_lower_tail(std::vector{0.0, 0.0}, 1.0);
              }),
              "GC-GUM-0003");
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)weighted_chi_square_lower_tail(std::vector{1.0, -1.0}, 1.0);
              }),
              "GC-GUM-0002");
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)weighted_chi_square_upper_tail(std::vector{1.0, nan}, 1.0);
              }),
              "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { (void)weighted_chi_square_upper_tail(std::vector{1.0}, nan); }), "GC-GUM-0001");
    EXPECT_EQ(code_of<InputError>([&] { (void)weighted_chi_square_quantile(std::vector{1.0}, 1.0); }), "GC-GUM-0004");
}

}  // namespace
}  // namespace gumcert::gum
