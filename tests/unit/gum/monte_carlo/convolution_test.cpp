#include "gum/monte_carlo/convolution.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <random>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/distribution_quantile.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::agrees;
using test::code_of;
using test::prints_as;

const double k_root_3 = std::sqrt(3.0);

TEST(ConvolutionHalfWidth, RectangularAndNormal) {
    // Factors k(95.45 %) against the ratio of normal to rectangular standard uncertainty, computed by Simpson
    // integration of the closed-form distribution function in an independent program.
    struct Case {
        double ratio;
        const char* k;
    };
    for (const Case& c : std::vector<Case>{{0.05, "1.652"},
                                           {0.1, "1.661"},
                                           {0.2, "1.700"},
                                           {0.3, "1.748"},
                                           {0.4, "1.795"},
                                           {0.5, "1.836"},
                                           {0.7, "1.899"},
                                           {1.0, "1.952"},
                                           {2.0, "1.995"}}) {
        const std::vector<ConvolutionTerm> terms{{1.0, Distribution::uniform(5.0, k_root_3)},
                                                 {-2.0, Distribution::normal(1.0, 0.5 * c.ratio)}};
        EXPECT_TRUE(prints_as(convolution_half_width(terms, 0.9545) / std::hypot(1.0, c.ratio), c.k)) << c.ratio;
    }
}

TEST(ConvolutionHalfWidth, SingleDistributions) {
    const auto k = [](const Distribution& distribution, double p) {
        return convolution_half_width(std::vector<ConvolutionTerm>{{1.0, distribution}}, p) /
               standard_deviation(distribution);
    };
    const Distribution rectangular = Distribution::uniform(0.0, 1e-9);
    EXPECT_TRUE(prints_as(k(rectangular, 0.9545), "1.6532"));
    EXPECT_TRUE(prints_as(k(rectangular, 0.95), "1.6454"));
    const Distribution triangular{.kind = DistributionKind::triangular, .location = 3.0, .scale = 2.0};
    EXPECT_TRUE(prints_as(k(triangular, 0.9545), "1.927"));
    EXPECT_TRUE(prints_as(k(triangular, 0.95), "1.902"));
    const Distribution arcsine{.kind = DistributionKind::arcsine, .location = 3.0, .scale = 2.0};
    EXPECT_TRUE(prints_as(k(arcsine, 0.9545), "1.411"));
    EXPECT_TRUE(agrees(k(Distribution::normal(0.0, 1.0), 0.95), 1.959963984540054, 1e-6));
    const Distribution student = Distribution::student_t(0.0, 1.0, 5.0);
    EXPECT_TRUE(agrees(convolution_half_width(std::vector<ConvolutionTerm>{{1.0, student}}, 0.95),
                       coverage_factor(0.95, 5.0), 2e-6));
    // Symmetric trapezoid, EA-4/02 M, S10.13: k = (1 − √((1 − p)(1 − β²))) / √((1 + β²)/6).
    for (const double beta : {0.0, 1.0 / 3.0, 0.7}) {
        const Distribution trapezoid{
            .kind = DistributionKind::trapezoidal, .location = 0.0, .scale = 1.0, .shape = beta};
        const double expected = (1.0 - std::sqrt(0.05 * (1.0 - beta * beta))) / std::sqrt((1.0 + beta * beta) / 6.0);
        EXPECT_TRUE(agrees(k(trapezoid, 0.95), expected, 2e-6)) << beta;
    }
    const Distribution beta{
        .kind = DistributionKind::beta, .location = 7.0, .scale = 2.0, .shape = 1.0, .second_shape = 1.0};
    EXPECT_TRUE(agrees(k(beta, 0.95), 0.95 * k_root_3, 2e-6));
}

TEST(ConvolutionHalfWidth, SumsOfBoundedDistributions) {
    // Two rectangular ones of equal width make a triangle; of unequal width a trapezoid.
    const std::vector<ConvolutionTerm> equal{{1.0, Distribution::uniform(0.0, 1.0)},
                                             {1.0, Distribution::uniform(0.0, 1.0)}};
    EXPECT_TRUE(agrees(convolution_half_width(equal, 0.95), 2.0 * (1.0 - std::sqrt(0.05)), 2e-6));
    const std::vector<ConvolutionTerm> unequal{{1.0, Distribution::uniform(0.0, 2.0)},
                                               {1.0, Distribution::uniform(0.0, 1.0)}};
    const double beta = 1.0 / 3.0;
    EXPECT_TRUE(
        agrees(convolution_half_width(unequal, 0.95), 3.0 * (1.0 - std::sqrt(0.05 * (1.0 - beta * beta))), 2e-6));
    // JCGM 101:2008, 9.2.3: four rectangular ones of unit standard deviation, 95 % interval ±3.88.
    const std::vector<ConvolutionTerm> four(4, {1.0, Distribution::uniform(0.0, k_root_3)});
    EXPECT_TRUE(prints_as(convolution_half_width(four, 0.95), "3.88"));
}

TEST(ConvolutionHalfWidth, RefusesWhatItCannotAdd) {
    const Distribution bad{.kind = DistributionKind::trapezoidal, .location = 0.0, .scale = 1.0, .shape = 2.0};
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)convolution_half_width(std::vector<ConvolutionTerm>{{1.0, bad}}, 0.95);
              }),
              "GC-GUM-0060");
    EXPECT_EQ(code_of<InputError>([] { (void)convolution_half_width({}, 0.95); }), "GC-GUM-0060");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)convolution_half_width(std::vector<ConvolutionTerm>{{1.0, Distribution::uniform(0, 1)}}, 1.5);
              }),
              "GC-GUM-0004");
}

double normal_cdf(double z) {
    return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

TEST(ConvolutionDistribution, RectangularAndNormal) {
    // F(x) = s/(2a) [g((x + a)/s) − g((x − a)/s)], g(z) = z Φ(z) + φ(z); the ratios include ones below a cell of a
    // grid.
    const double a = 0.7;
    const auto g = [](double z) {
        return z * normal_cdf(z) + std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::acos(-1.0));
    };
    for (const double s : {1e-7, 1e-5, 1e-3, 0.05, 0.3, 0.7, 2.0, 30.0}) {
        const ConvolutionDistribution distribution(std::vector<ConvolutionTerm>{
            {-1.0, Distribution::uniform(3.0, a)}, {0.5, Distribution::normal(1.0, 2.0 * s)}});
        for (double x = -1.5 * a - 5.0 * s; x < 1.5 * a + 5.0 * s; x += (a + s) / 9.0) {
            EXPECT_NEAR(distribution(x), s / (2.0 * a) * (g((x + a) / s) - g((x - a) / s)), 1e-6) << s << ' ' << x;
        }
        EXPECT_NEAR(distribution(a), s / (2.0 * a) * (g(2.0 * a / s) - g(0.0)), 1e-6) << s;
        EXPECT_NEAR(distribution(0.0), 0.5, 1e-9) << s;
    }
}

TEST(ConvolutionDistribution, KnownSums) {
    // Two rectangular ones: a symmetric trapezoid; four of them: the cubic spline of Irwin and Hall.
    const ConvolutionDistribution two(
        std::vector<ConvolutionTerm>{{1.0, Distribution::uniform(0.0, 2.0)}, {1.0, Distribution::uniform(0.0, 1.0)}});
    EXPECT_NEAR(two(-2.0), 1.0 / 16.0, 1e-6);
    EXPECT_NEAR(two(-1.0), 0.25, 1e-6);
    EXPECT_NEAR(two(2.0), 15.0 / 16.0, 1e-6);
    EXPECT_EQ(two(-3.1), 0.0);
    EXPECT_NEAR(two(3.1), 1.0, 1e-15);
    const ConvolutionDistribution four(std::vector<ConvolutionTerm>(4, {1.0, Distribution::uniform(9.0, 0.5)}));
    EXPECT_NEAR(four(-1.0), 1.0 / 24.0, 1e-6);
    EXPECT_NEAR(four(1.5), 1.0 - 0.0625 / 24.0, 1e-6);
    // A single term, and normal ones: exactly.
    EXPECT_TRUE(agrees(convolution_distribution(std::vector<ConvolutionTerm>{{3.0, Distribution::normal(0.0, 1.0)},
                                                                             {2.0, Distribution::normal(0.0, 2.0)}},
                                                -15.0),
                       normal_cdf(-3.0), 1e-13));
    const Distribution arcsine{.kind = DistributionKind::arcsine, .location = 3.0, .scale = 2.0};
    EXPECT_NEAR(convolution_distribution(std::vector<ConvolutionTerm>{{1.0, arcsine}}, 1.0), 2.0 / 3.0, 1e-14);
}

TEST(ConvolutionDistribution, AgreesWithTheHalfWidth) {
    const Distribution triangular{.kind = DistributionKind::triangular, .location = 3.0, .scale = 2.0};
    const Distribution arcsine{.kind = DistributionKind::arcsine, .location = 0.0, .scale = 1.0};
    const std::vector<ConvolutionTerm> terms{{1.0, triangular},
                                             {2.0, arcsine},
                                             {1.0, Distribution::student_t(0.0, 0.3, 6.0)},
                                             {-0.5, Distribution::uniform(0.0, 2.0)}};
    const ConvolutionDistribution distribution(terms);
    for (const double p : {0.5, 0.9, 0.9545, 0.999}) {
        const double U = convolution_half_width(terms, p);
        EXPECT_NEAR(distribution(U) - distribution(-U), p, 2e-6) << p;
    }
    double last = 0.0;
    for (double x = -8.0; x < 8.0; x += 0.5) {
        EXPECT_GE(distribution(x), last) << x;
        EXPECT_NEAR(distribution(x) + distribution(-x), 1.0, 1e-8) << x;
        last = distribution(x);
    }
}

TEST(ConvolutionDistribution, OfWideStudentTerms) {
    const std::vector<ConvolutionTerm> terms{{1.0, Distribution::student_t(0.0, 2.0, 5.0)},
                                             {1.0, Distribution::uniform(0.0, 1.0)}};
    const ConvolutionDistribution distribution(terms);
    for (const double p : {0.5, 0.9545, 0.99}) {
        const double U = convolution_half_width(terms, p);
        EXPECT_NEAR(distribution(U), 0.5 + 0.5 * p, 2e-6);
        EXPECT_NEAR(distribution(-U), 0.5 - 0.5 * p, 2e-6);
    }
    EXPECT_NEAR(distribution(0.0), 0.5, 1e-9);
    EXPECT_EQ(distribution(-1e9), 0.0);
    EXPECT_EQ(distribution(1e9), 1.0);
}

// A Cauchy distribution beside a little of something else: ends far out, where only the tail of the first counts.
TEST(ConvolutionInterval, ReachesFarIntoTailsWithoutLimits) {
    const Distribution cauchy = Distribution::student_t(0.0, 1.0, 1.0);
    const Distribution small{.kind = DistributionKind::exponential, .location = 0.0, .scale = 0.1};
    for (const double p : {0.9545, 0.9973, 0.9999}) {
        const double exact = std::tan(0.5 * std::numbers::pi * p);
        EXPECT_TRUE(agrees(convolution_half_width(std::vector<ConvolutionTerm>{{1.0, cauchy}, {1.0, small}}, p), exact,
                           p > 0.99 ? 1e-4 : 2e-3))
            << p;
        EXPECT_TRUE(agrees(convolution_half_width(std::vector<ConvolutionTerm>{{1.0, cauchy}, {2.0, cauchy}}, p),
                           3.0 * exact, 1e-3))
            << p;
    }
    const Distribution half = Distribution::student_t(0.0, 1.0, 0.5);
    EXPECT_TRUE(agrees(
        convolution_half_width(std::vector<ConvolutionTerm>{{1.0, half}, {0.1, Distribution::normal(0.0, 1.0)}}, 0.95),
        upper_quantile(half, 0.025), 1e-3));
}

TEST(ConvolutionDistribution, ReachesFarIntoTailsWithoutLimits) {
    const Distribution cauchy = Distribution::student_t(0.0, 1.0, 1.0);
    const ConvolutionDistribution two(std::vector<ConvolutionTerm>{{1.0, cauchy}, {2.0, cauchy}});
    const Distribution small{.kind = DistributionKind::exponential, .location = 0.0, .scale = 0.001};
    const ConvolutionDistribution skewed(std::vector<ConvolutionTerm>{{3.0, cauchy}, {1.0, small}});
    for (const double x : {1.0, 10.0, 100.0, 1e3, 1e4, 1e5}) {
        const double beyond = 0.5 - std::atan(x / 3.0) / std::numbers::pi;
        EXPECT_TRUE(agrees(1.0 - two(x), beyond, 5e-3)) << x;
        EXPECT_TRUE(agrees(two(-x), beyond, 5e-3)) << x;
        EXPECT_TRUE(agrees(1.0 - skewed(x), beyond, 2e-2)) << x;
        EXPECT_TRUE(agrees(skewed(-x), beyond, 2e-2)) << x;
    }
}

/// ∫∫ (F − 1/2) of a t-distribution of scale 1, F its distribution function, from 0 on twice.
double second_integral_of_student(double x, double nu) {
    const Distribution t = Distribution::student_t(0.0, 1.0, nu);
    const double f = probability_density(t, x);
    const double half = std::copysign(0.5 - upper_tail_probability(t, std::abs(x)), x);
    // ∫ z² f dz from 0 to x.
    const double second = nu == 2.0 ? std::asinh(x / std::sqrt(2.0)) - x / std::sqrt(2.0 + x * x)
                                    : (nu * half - x * (nu + x * x) * f) / (nu - 2.0);
    return (0.5 * x * x + nu / (nu - 1.0)) * half - (nu - 3.0) / (2.0 * (nu - 1.0)) * second;
}

// Few readings, a resolution and the accuracy of a standard, the budget of everyday: a t-distribution of few degrees of
// freedom and two rectangular ones, in closed form.
TEST(ConvolutionDistribution, OfFewReadingsAndRectangularTerms) {
    const double a = 1.0;
    for (const double nu : {1.5, 2.0, 3.0, 4.0}) {
        for (const double s : {0.01, 0.15, 1.0, 8.0}) {
            for (const double b : {0.05, 0.9}) {
                const std::vector<ConvolutionTerm> terms{{s, Distribution::student_t(3.0, 1.0, nu)},
                                                         {-1.0, Distribution::uniform(0.0, a)},
                                                         {b, Distribution::uniform(1.0, 1.0)}};
                const auto exact = [&](double x) {
                    const auto g = [&](double at) { return second_integral_of_student(at / s, nu); };
                    return 0.5 + s * s / (4.0 * a * b) * (g(x + a + b) - g(x + a - b) - g(x - a + b) + g(x - a - b));
                };
                const ConvolutionDistribution distribution(terms);
                for (const double x :
                     {0.0, 0.5, 0.99, 1.0, 1.0 + b, 1.0 + s, 1.0 + 3.0 * s, 3.0 + 10.0 * s, 9.0 + 40.0 * s}) {
                    EXPECT_NEAR(distribution(x), exact(x), 5e-8) << nu << ' ' << s << ' ' << b << ' ' << x;
                    EXPECT_NEAR(distribution(-x), 1.0 - exact(x), 5e-8) << nu << ' ' << s << ' ' << b << ' ' << x;
                }
                for (const double p : {0.9545, 0.99}) {
                    const double U = convolution_half_width(terms, p);
                    EXPECT_NEAR(2.0 * exact(U) - 1.0, p, 5e-7) << nu << ' ' << s << ' ' << b;
                }
            }
        }
    }
}

// Far out only the long tail counts, and keeps its digits.
TEST(ConvolutionDistribution, KeepsTheDigitsOfALongTail) {
    const Distribution cauchy = Distribution::student_t(0.0, 1.0, 1.0);
    const ConvolutionDistribution sum(std::vector<ConvolutionTerm>{
        {1.0, cauchy}, {2.0, Distribution::normal(0.0, 1.0)}, {1.0, Distribution::student_t(0.0, 1.0, 30.0)}});
    for (const double x : {100.0, 1e3, 1e5, 1e7}) {
        const double beyond = std::atan(1.0 / x) / std::numbers::pi;
        EXPECT_TRUE(agrees(sum(-x), beyond, 10.0 / (x * x) + 1e-8)) << x;
    }
}

// A term that is much wider than the t-distribution beside it: beyond its edge only the tail counts, however far away that
// is in widths of the sum. The exact values by the mean of the tail over the rectangle.
TEST(ConvolutionDistribution, HasTheTailBeyondAWideRectangle) {
    for (const double nu : {1.5, 2.0}) {
        const auto g = [&](double x) { return second_integral_of_student(x, nu); };
        // First integral of F − 1/2 by a difference of the second one.
        const auto first = [&](double x) { return (g(x + 0.01) - g(x - 0.01)) / 0.02; };
        for (const double a : {200.0, 400.0, 1000.0}) {
            const ConvolutionDistribution sum(std::vector<ConvolutionTerm>{{1.0, Distribution::student_t(0.0, 1.0, nu)},
                                                                           {1.0, Distribution::uniform(0.0, a)}});
            for (const double beyond : {1.0, 3.0, 30.0}) {
                const double x = a + beyond;
                EXPECT_NEAR(sum(x), 0.5 + (first(x + a) - first(x - a)) / (2.0 * a), 2e-7) << nu << ' ' << x;
            }
        }
    }
    // ∫ arctan is known: for one degree of freedom in closed form.
    const auto antiderivative = [](double x) { return x * std::atan(x) - 0.5 * std::log1p(x * x); };
    for (const double a : {100.0, 500.0, 5000.0}) {
        const ConvolutionDistribution sum(std::vector<ConvolutionTerm>{{1.0, Distribution::student_t(0.0, 1.0, 1.0)},
                                                                       {1.0, Distribution::uniform(0.0, a)}});
        for (const double beyond : {-1.0, 3.0, 0.5 * a, 70.0 * a}) {
            const double x = a + beyond;
            const double outside = 0.5 - (antiderivative(x + a) - antiderivative(x - a)) / (2.0 * a * std::numbers::pi);
            EXPECT_NEAR(sum(-x), outside, 5e-7) << a << ' ' << x;
        }
    }
    const ConvolutionDistribution two_readings(std::vector<ConvolutionTerm>{
        {1.0, Distribution::student_t(0.0, 1.0, 1.0)}, {1.0, Distribution::uniform(0.0, 100.0)}});
    EXPECT_NEAR(two_readings(-103.0), 0.0066792, 1e-7);
    const ConvolutionDistribution three_readings(std::vector<ConvolutionTerm>{
        {1.0, Distribution::student_t(0.0, 1.0, 2.0)}, {1.0, Distribution::uniform(0.0, 400.0)}});
    EXPECT_NEAR(three_readings(-403.0), 1.97112e-4, 1e-9);
}

// Few readings of the item and of the standard: two long tails. The sum of Cauchy distributions is one; the others are by
// integration of the characteristic function in an independent program.
TEST(ConvolutionDistribution, HasTheTailsOfSeveralFewReadings) {
    const auto antiderivative = [](double x) { return x * std::atan(x) - 0.5 * std::log1p(x * x); };
    const Distribution cauchy = Distribution::student_t(0.0, 1.0, 1.0);
    for (const double a : {3.0, 20.0, 200.0}) {
        const ConvolutionDistribution sum(
            std::vector<ConvolutionTerm>{{0.7, cauchy}, {0.3, cauchy}, {1.0, Distribution::uniform(0.0, a)}});
        for (const double x : {0.5 * a, a + 1.0, a + 60.0, 100.0 * a, 1e5 * a}) {
            const double outside = 0.5 - (antiderivative(x + a) - antiderivative(x - a)) / (2.0 * a * std::numbers::pi);
            EXPECT_NEAR(sum(-x), outside, 5e-5) << a << ' ' << x;
            EXPECT_NEAR(sum(x), 1.0 - outside, 5e-5) << a << ' ' << x;
        }
    }
    const Distribution t = Distribution::student_t(0.0, 1.0, 2.0);
    const auto outside = [&](double a, double x) {
        return convolution_distribution(
            std::vector<ConvolutionTerm>{{1.0, t}, {1.0, t}, {1.0, Distribution::uniform(0.0, a)}}, -x);
    };
    EXPECT_NEAR(outside(30.0, 85.0), 0.00015863925, 2e-7);
    EXPECT_NEAR(outside(30.0, 100.0), 0.00011015467, 2e-7);
    EXPECT_NEAR(outside(5.0, 85.0), 0.00013926051, 2e-7);
    // Tails beyond all numbers of a double.
    EXPECT_NEAR(convolution_distribution(std::vector<ConvolutionTerm>{{1.0, Distribution::student_t(0.0, 1.0, 1e-3)},
                                                                      {1.0, Distribution::normal(0.0, 5.0)}},
                                         0.0),
                0.5, 1e-6);
}

// A guard band for a risk of 1e-7 is as right as one for 5 %, or it is said that it cannot be known. P(T + B > z) as the mean of
// the tail of T over the distribution of a rectangular and a normal term, by the trapezoidal rule, which is exact for what
// falls off like a normal distribution.
TEST(ConvolutionDistribution, HasItsTailsDownToTheProbabilityThatItNames) {
    std::mt19937_64 random(20261130);
    std::uniform_real_distribution<double> log_of_width(-1.5, 0.5);
    for (const double nu : {1.0, 2.0, 3.0, 5.0, 9.0, 30.0, 1e3}) {
        for (int i = 0; i < 4; ++i) {
            const double a = std::pow(10.0, log_of_width(random));
            const double s = std::pow(10.0, log_of_width(random));
            const Distribution normal = Distribution::normal(0.0, 0.5);
            const Distribution student = Distribution::student_t(0.0, s, nu);
            const ConvolutionDistribution sum(std::vector<ConvolutionTerm>{
                {1.0, normal}, {-0.5, Distribution::uniform(0.0, 2.0 * a)}, {1.0, student}});
            EXPECT_LE(sum.least_probability(), 1e-7);
            const double step = 0.1 * std::min(0.5, s);
            const auto beyond = [&](double z) {
                double total = 0.0;
                for (double b = -a - 6.0; b <= a + 6.0; b += step) {
                    const double density =
                        (upper_tail_probability(normal, b - a) - upper_tail_probability(normal, b + a)) / (2.0 * a);
                    total += step * density * upper_tail_probability(student, z - b);
                }
                return total;
            };
            for (double z = 0.5;; z *= 1.3) {
                const double exact = beyond(z);
                if (exact < sum.least_probability()) {
                    break;
                }
                EXPECT_TRUE(agrees(sum(-z), exact, 0.01)) << nu << ' ' << a << ' ' << s << ' ' << z;
            }
        }
    }
    const auto antiderivative = [](double x) { return x * std::atan(x) - 0.5 * std::log1p(x * x); };
    const Distribution cauchy = Distribution::student_t(0.0, 1.0, 1.0);
    for (const double a : {0.5, 20.0}) {
        const ConvolutionDistribution sum(
            std::vector<ConvolutionTerm>{{0.7, cauchy}, {0.3, cauchy}, {1.0, Distribution::uniform(0.0, a)}});
        for (double x = a; x < 1e4; x *= 3.0) {
            const double outside = 0.5 - (antiderivative(x + a) - antiderivative(x - a)) / (2.0 * a * std::numbers::pi);
            EXPECT_GE(outside, sum.least_probability());
            EXPECT_TRUE(agrees(sum(-x), outside, 0.01)) << a << ' ' << x;
        }
    }
    EXPECT_EQ(ConvolutionDistribution(std::vector<ConvolutionTerm>{{1.0, cauchy}}).least_probability(), 0.0);
    const Distribution endless = Distribution::student_t(0.0, 1.0, 0.3);
    EXPECT_GT(ConvolutionDistribution(std::vector<ConvolutionTerm>{{1.0, endless}, {1.0, cauchy}}).least_probability(),
              0.01);
    const auto samples = std::make_shared<std::vector<double>>(std::vector<double>{-2.0, 0.0, 0.0, 2.0});
    const Distribution four{.kind = DistributionKind::empirical, .location = 0.0, .scale = 1.0, .samples = samples};
    EXPECT_EQ(ConvolutionDistribution(std::vector<ConvolutionTerm>{{1.0, four}, {1.0, cauchy}}).least_probability(),
              0.25);
}

TEST(IsNormalOrStudent, HoldsForOneOfThemAlone) {
    const Distribution normal = Distribution::normal(0.0, 0.5);
    const Distribution student = Distribution::student_t(0.0, 1.0, 4.0);
    const Distribution uniform = Distribution::uniform(0.0, 1.0);
    using Terms = std::vector<ConvolutionTerm>;
    EXPECT_TRUE(is_normal_or_student(Terms{{1.0, normal}, {2.0, normal}}));
    EXPECT_TRUE(is_normal_or_student(Terms{{1.0, student}, {0.0, uniform}}));
    EXPECT_FALSE(is_normal_or_student(Terms{{1.0, student}, {1.0, normal}}));
    EXPECT_FALSE(is_normal_or_student(Terms{{1.0, student}, {1.0, student}}));
    EXPECT_FALSE(is_normal_or_student(Terms{{1.0, uniform}}));
}

// Samples alone: each possible value has a probability of its own.
TEST(ConvolutionDistribution, CountsSamples) {
    const auto samples = std::make_shared<std::vector<double>>(std::vector<double>{-2.0, 0.0, 0.0, 2.0});
    const Distribution d{.kind = DistributionKind::empirical, .location = 0.0, .scale = 1.0, .samples = samples};
    const ConvolutionDistribution one(std::vector<ConvolutionTerm>{{1.0, d}});
    EXPECT_EQ(one(-2.0), 0.25);
    EXPECT_EQ(one.below(-2.0), 0.0);
    EXPECT_EQ(one.below(0.0), 0.25);
    EXPECT_EQ(one(0.0), 0.75);
    const ConvolutionDistribution two(std::vector<ConvolutionTerm>{{1.0, d}, {-1.0, d}});
    EXPECT_EQ(two.below(-4.0), 0.0);
    EXPECT_EQ(two(-4.0), 1.0 / 16.0);
    EXPECT_EQ(two(0.0) - two.below(0.0), 6.0 / 16.0);
}

TEST(ConvolutionDistribution, RefusesWhatItCannotAdd) {
    EXPECT_EQ(code_of<InputError>([] { (void)convolution_distribution({}, 0.0); }), "GC-GUM-0060");
    const Distribution bad{.kind = DistributionKind::trapezoidal, .location = 0.0, .scale = 1.0, .shape = 2.0};
    EXPECT_EQ(code_of<InputError>([&] {
                  (void)convolution_distribution(std::vector<ConvolutionTerm>{{1.0, bad}}, 0.0);
              }),
              "GC-GUM-0060");
}

// Sums of two exponential quantities, and their difference, in closed form.
TEST(ConvolutionInterval, HoldsForDistributionsThatAreNotSymmetric) {
    const Distribution exponential{.kind = DistributionKind::exponential, .location = 7.0, .scale = 1.0};
    const double p = 0.95;
    const ConvolutionInterval sum =
        convolution_interval(std::vector<ConvolutionTerm>{{1.0, exponential}, {1.0, exponential}}, p);
    const auto below = [](double x) { return 1.0 - std::exp(-(x + 2.0)) * (1.0 + x + 2.0); };  // gamma, shape 2
    EXPECT_NEAR(below(sum.low), 0.025, 1e-5);
    EXPECT_NEAR(below(sum.high), 0.975, 1e-5);
    const ConvolutionInterval mirrored =
        convolution_interval(std::vector<ConvolutionTerm>{{-1.0, exponential}, {-1.0, exponential}}, p);
    EXPECT_NEAR(mirrored.low, -sum.high, 1e-3);
    EXPECT_NEAR(mirrored.high, -sum.low, 1e-3);
    const ConvolutionInterval laplace =
        convolution_interval(std::vector<ConvolutionTerm>{{1.0, exponential}, {-1.0, exponential}}, p);
    EXPECT_NEAR(laplace.high, -std::log(0.05), 1e-3);
    EXPECT_NEAR(laplace.low, std::log(0.05), 1e-3);
    const ConvolutionDistribution distribution(std::vector<ConvolutionTerm>{{1.0, exponential}, {-1.0, exponential}});
    EXPECT_NEAR(distribution(1.0), 1.0 - 0.5 * std::exp(-1.0), 1e-4);
    EXPECT_NEAR(distribution(-1.0), 0.5 * std::exp(-1.0), 1e-4);
}

/// y = Σ x_i with one group an input. As in the law of propagation, t-distributions have their scale as u.
class SumModel final : public MeasurementModel {
public:
    explicit SumModel(const std::vector<Distribution>& distributions) {
        for (const Distribution& distribution : distributions) {
            const bool is_t = distribution.kind == DistributionKind::student_t;
            const double u = is_t ? distribution.scale : standard_deviation(distribution);
            InputGroup group;
            group.name = "x" + std::to_string(groups_.size() + 1);
            group.value = Eigen::VectorXd::Constant(1, distribution.location);
            group.covariance = Eigen::MatrixXd::Constant(1, 1, u * u);
            group.marginals = {distribution};
            if (is_t) {
                group.degrees_of_freedom = distribution.shape;
            }
            groups_.push_back(group);
        }
    }
    [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
    [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
    [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
        return Eigen::VectorXd::Constant(1, x.sum());
    }
    [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
        return Eigen::MatrixXd::Ones(1, x.size());
    }

private:
    std::vector<InputGroup> groups_;
    std::vector<OutputQuantity> outputs_{{"y", "1"}};
};

double sinc(double z) {
    return std::abs(z) < 1e-9 ? 1.0 : std::sin(z) / z;
}

/// Characteristic function of a centred distribution, from the functions of the standard library.
double characteristic(const Distribution& d, double t) {
    const double at = d.scale * t;
    switch (d.kind) {
        case DistributionKind::normal:
            return std::exp(-0.5 * at * at);
        case DistributionKind::uniform:
            return sinc(at);
        case DistributionKind::triangular:
            return std::pow(sinc(0.5 * at), 2);
        case DistributionKind::arcsine:
            return std::cyl_bessel_j(0.0, at);
        case DistributionKind::trapezoidal:
            return sinc(0.5 * (1.0 + d.shape) * at) * sinc(0.5 * (1.0 - d.shape) * at);
        case DistributionKind::curvilinear_trapezoid: {  // the mean over half-widths, by Simpson
            constexpr int k_steps = 64;
            double sum = 0.0;
            for (int i = 0; i <= k_steps; ++i) {
                const double w = 1.0 + d.shape * (2.0 * i / k_steps - 1.0);
                sum += (i == 0 || i == k_steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * sinc(w * at);
            }
            return sum / (3.0 * k_steps);
        }
        default: {
            const double mu = 0.5 * d.shape;
            const double z = std::sqrt(d.shape) * at;
            return z < 1e-9    ? 1.0
                   : z > 700.0 ? 0.0
                               : std::exp(std::log(std::cyl_bessel_k(mu, z)) + mu * std::log(z) -
                                          (mu - 1.0) * std::log(2.0) - std::lgamma(mu));
        }
    }
}

/// P(|Y| ≤ U) = (2/π) ∫ φ(t) sin(U t)/t dt (Gil-Pelaez), by Simpson; one term at least must be normal.
double probability_inside(const std::vector<Distribution>& distributions, double U) {
    double normal = 0.0;
    double all = 0.0;
    for (const Distribution& d : distributions) {
        normal += d.kind == DistributionKind::normal ? d.scale * d.scale : 0.0;
        all += d.scale * d.scale;
    }
    const double last = 7.0 / std::sqrt(normal);
    const int steps = 2 * static_cast<int>(last * std::max(U, std::sqrt(all)) * 20.0 + 200.0);
    const double h = last / steps;
    double sum = U;
    for (int i = 1; i <= steps; ++i) {
        double phi = 1.0;
        for (const Distribution& d : distributions) {
            phi *= characteristic(d, i * h);
        }
        sum += (i == steps ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) * phi * std::sin(U * i * h) / (i * h);
    }
    return 2.0 / std::acos(-1.0) * sum * h / 3.0;
}

std::vector<Distribution> random_budget(std::mt19937& random) {
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * static_cast<double>(random()) / 4294967296.0;
    };
    std::vector<Distribution> budget{Distribution::normal(0.0, uniform(0.1, 1.5))};
    const std::size_t others = 1 + random() % 5;
    while (budget.size() <= others) {
        const double scale = std::exp(uniform(-2.0, 1.0));
        switch (random() % 6) {
            case 0:
                budget.push_back(Distribution::uniform(0.0, scale));
                break;
            case 1:
                budget.push_back({.kind = DistributionKind::triangular, .scale = scale});
                break;
            case 2:
                budget.push_back({.kind = DistributionKind::arcsine, .scale = scale});
                break;
            case 3:
                budget.push_back({.kind = DistributionKind::trapezoidal, .scale = scale, .shape = uniform(0.0, 1.0)});
                break;
            case 4:
                budget.push_back(
                    {.kind = DistributionKind::curvilinear_trapezoid, .scale = scale, .shape = uniform(0.05, 1.0)});
                break;
            default:
                budget.push_back(Distribution::student_t(0.0, 0.7 * scale, std::exp(uniform(0.7, 5.0))));
                break;
        }
    }
    return budget;
}

// A law over generated budgets: half-widths are those of the characteristic functions, and where the bound says that
// the convolution changes little, it does.
TEST(ExpandByConvolution, AgreesWithCharacteristicFunctionsAndItsBound) {
    std::mt19937 random(1);
    std::size_t left_out = 0;
    for (int i = 0; i < 400; ++i) {
        const std::vector<Distribution> budget = random_budget(random);
        const double p = std::vector<double>{0.68, 0.9, 0.95, 0.9545, 0.99}[random() % 5];
        const SumModel model(budget);
        const Propagation propagation = propagate(model, p);
        const auto convolved = expand_by_convolution(model, propagation, 0);
        ASSERT_TRUE(convolved);
        EXPECT_EQ(convolved->asymmetry, 0.0);
        if (i < 60) {
            EXPECT_NEAR(probability_inside(budget, convolved->expanded_uncertainty), p, 2e-6) << i;
        }
        if (convolution_changes_little(model, propagation, 0)) {
            ++left_out;
            EXPECT_NEAR(propagation.coverage_factor(0) / convolved->coverage_factor, 1.0, 0.01) << i;
        }
    }
    EXPECT_GT(left_out, 20U);
}

// A law over generated budgets: probabilities come of characteristic functions that polynomials and rotations stand for, factors of the
// functions themselves. Few readings make series of thousands of terms.
TEST(ConvolutionDistribution, HasTheProbabilityOfTheInterval) {
    std::mt19937 random(2);
    for (int i = 0; i < 400; ++i) {
        std::vector<Distribution> budget = random_budget(random);
        for (std::size_t few = random() % 3; few > 0; --few) {
            budget.push_back(Distribution::student_t(0.0, 0.3, 2.0 + static_cast<double>(random() % 100) / 20.0));
        }
        std::vector<ConvolutionTerm> terms;
        for (const Distribution& d : budget) {
            terms.push_back({1.0, d});
        }
        const double p = std::vector<double>{0.68, 0.95, 0.9545, 0.99}[random() % 4];
        const double U = convolution_half_width(terms, p);
        const ConvolutionDistribution distribution(terms);
        EXPECT_NEAR(distribution(U) - distribution(-U), p, 1e-6) << i;
    }
}

TEST(ExpandByConvolution, KnownFactors) {
    const auto k = [](const std::vector<Distribution>& distributions, double p) {
        const SumModel model(distributions);
        return expand_by_convolution(model, propagate(model, p), 0)->coverage_factor;
    };
    const Distribution rectangular = Distribution::uniform(0.0, k_root_3);
    EXPECT_TRUE(prints_as(k({Distribution::normal(0.0, 0.3), rectangular}, 0.9545), "1.748"));
    EXPECT_TRUE(prints_as(k({rectangular, rectangular, rectangular}, 0.99), "2.379"));
    EXPECT_TRUE(agrees(k({Distribution::student_t(0.0, 1.0, 4.0)}, 0.95), coverage_factor(0.95, 4.0), 1e-12));
    // Widths of Cauchy distributions add up.
    EXPECT_TRUE(agrees(k({Distribution::student_t(0.0, 3.0, 1.0), Distribution::student_t(0.0, 4.0, 1.0)}, 0.95),
                       7.0 / 5.0 * coverage_factor(0.95, 1.0), 5e-3));
    const SumModel constant({Distribution::constant(3.0)});
    EXPECT_FALSE(expand_by_convolution(constant, propagate(constant, 0.95), 0));
    EXPECT_TRUE(convolution_changes_little(constant, propagate(constant, 0.95), 0));
}

// Two uniform quantities with r = 1 are one; with r = 0 their sum is triangular. Samples keep their own steps.
TEST(ExpandByConvolution, TakesGroupsThatAreDrawnTogetherAsTheyAre) {
    class Group final : public MeasurementModel {
    public:
        explicit Group(InputGroup group) : groups_{std::move(group)} {}
        [[nodiscard]] const std::vector<InputGroup>& inputs() const override { return groups_; }
        [[nodiscard]] const std::vector<OutputQuantity>& outputs() const override { return outputs_; }
        [[nodiscard]] Eigen::VectorXd evaluate(const Eigen::VectorXd& x) const override {
            return Eigen::VectorXd::Constant(1, x.sum());
        }
        [[nodiscard]] Eigen::MatrixXd jacobian(const Eigen::VectorXd& x) const override {
            return Eigen::MatrixXd::Ones(1, x.size());
        }

    private:
        std::vector<InputGroup> groups_;
        std::vector<OutputQuantity> outputs_{{"y", "1"}};
    };
    InputGroup group;
    group.name = "a, b";
    group.value = Eigen::VectorXd::Zero(2);
    group.covariance = Eigen::MatrixXd::Constant(2, 2, 1.0);
    group.marginals = {Distribution::uniform(0.0, k_root_3), Distribution::uniform(0.0, k_root_3)};
    group.dependence = Dependence::gaussian_copula;
    const Group one(group);
    EXPECT_FALSE(convolution_changes_little(one, propagate(one, 0.95), 0));
    EXPECT_NEAR(expand_by_convolution(one, propagate(one, 0.95), 0)->coverage_factor, 0.95 * k_root_3, 0.005);
    group.covariance << 1.0, 1e-9, 1e-9, 1.0;
    const Group two(group);
    EXPECT_NEAR(expand_by_convolution(two, propagate(two, 0.95), 0)->coverage_factor, 1.902, 0.01);
    group.dependence = Dependence::joint_samples;
    group.covariance = Eigen::MatrixXd::Constant(2, 2, 1.0);
    Eigen::MatrixXd rows(1000, 2);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
        rows.row(i).setConstant(k_root_3 * (2.0 * (static_cast<double>(i) + 0.5) / 1000.0 - 1.0));
    }
    group.samples = std::make_shared<const Eigen::MatrixXd>(rows);
    const Group sampled(group);
    EXPECT_NEAR(expand_by_convolution(sampled, propagate(sampled, 0.95), 0)->coverage_factor, 0.95 * k_root_3, 0.005);
}

}  // namespace
}  // namespace gumcert::gum
