#include "gum/weighted_t_square.h"

#include <gtest/gtest.h>

#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "gum/quantity/diagnostic.h"
#include "gum/weighted_chi_square.h"
#include "tests/support/case_count.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::code_of;

constexpr double k_infinite = std::numeric_limits<double>::infinity();

TEST(SquaredT, OneIsFisherF) {
    for (const double nu : {1.0, 3.0, 4.5, 10.0, 100.0, 1e4, 1e7}) {
        const boost::math::fisher_f_distribution<double> F(1.0, nu);
        for (const double x : {0.01, 0.5, 1.0, 4.0, 20.0}) {
            const std::vector<SquaredT> one{{.weight = 3.0, .degrees_of_freedom = nu}};
            EXPECT_NEAR(squared_t_lower_tail(one, 3.0 * x), cdf(F, x), 1e-9) << nu << " " << x;
            EXPECT_NEAR(squared_t_upper_tail(one, 3.0 * x), cdf(complement(F, x)), 1e-9) << nu << " " << x;
        }
        EXPECT_NEAR(squared_t_quantile(std::vector<SquaredT>{{1.0, nu}}, 0.95), quantile(F, 0.95), 1e-6) << nu;
    }
}

TEST(SquaredT, InfiniteDegreesAreChiSquare) {
    const std::vector<double> weights{0.5, 1.0, 1.0, 4.0};
    std::vector<SquaredT> terms;
    for (const double weight : weights) {
        terms.push_back({weight, k_infinite});
    }
    for (const double x : {0.1, 2.0, 6.5, 30.0}) {
        EXPECT_NEAR(squared_t_lower_tail(terms, x), weighted_chi_square_lower_tail(weights, x), 1e-9) << x;
        EXPECT_NEAR(squared_t_upper_tail(terms, x), weighted_chi_square_upper_tail(weights, x), 1e-9) << x;
    }
    EXPECT_NEAR(squared_t_quantile(terms, 0.9), weighted_chi_square_quantile(weights, 0.9), 1e-7);
}

TEST(SquaredT, OfDifferentTermsByTrials) {
    const std::vector<SquaredT> terms{{1.0, 2.0}, {0.3, 5.0}, {2.0, k_infinite}, {1.5, 30.0}};
    std::mt19937_64 engine(8);
    const auto uniform = [&] { return (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53; };
    constexpr int k_trials = 200000;
    const double median = squared_t_quantile(terms, 0.5);
    const double upper = squared_t_quantile(terms, 0.95);
    int below = 0;
    int above = 0;
    for (int i = 0; i < k_trials; ++i) {
        double sum = 0.0;
        for (const SquaredT& term : terms) {  // Bailey (1994): the polar method for t
            const double nu = term.degrees_of_freedom;
            const double u = uniform();
            const double radius = std::isinf(nu) ? -2.0 * std::log(u) : nu * std::expm1(-2.0 / nu * std::log(u));
            sum += term.weight * radius * std::pow(std::cos(6.283185307179586 * uniform()), 2);
        }
        below += sum <= median ? 1 : 0;
        above += sum > upper ? 1 : 0;
    }
    EXPECT_NEAR(below, 0.5 * k_trials, 4.0 * std::sqrt(0.25 * k_trials));
    EXPECT_NEAR(above, 0.05 * k_trials, 4.0 * std::sqrt(0.0475 * k_trials));
}

/// T² of one term by Bailey's polar method (1994).
double drawn_square(std::mt19937_64& engine, double nu) {
    const auto uniform = [&] { return (static_cast<double>(engine() >> 11U) + 0.5) * 0x1p-53; };
    const double u = uniform();
    const double radius = std::isinf(nu) ? -2.0 * std::log(u) : nu * std::expm1(-2.0 / nu * std::log(u));
    return radius * std::pow(std::cos(6.283185307179586 * uniform()), 2);
}

// The relative width of n terms is √(2/n): from about 200 of them on, an integration with fixed steps gave tails that
// were wrong in their first digit, and p_low + p_high = 1 all the same.
TEST(SquaredT, OfManyTermsByTrials) {
    constexpr int k_trials = 3000;
    std::mt19937_64 engine(31);
    for (const std::size_t n : {10U, 60U, 200U, 500U, 2000U}) {
        for (const double nu : {4.0, 30.0}) {
            std::vector<SquaredT> terms;
            for (std::size_t i = 0; i < n; ++i) {  // each with digits of its own
                terms.push_back({1.0 + 0.2 * std::sin(static_cast<double>(i)), nu});
            }
            const double low = squared_t_quantile(terms, 0.1);
            const double high = squared_t_quantile(terms, 0.7);
            EXPECT_NEAR(squared_t_lower_tail(terms, low), 0.1, 1e-8) << n << " " << nu;
            EXPECT_NEAR(squared_t_lower_tail(terms, high), 0.7, 1e-8) << n << " " << nu;
            int below_low = 0;
            int below_high = 0;
            for (int trial = 0; trial < k_trials; ++trial) {
                double sum = 0.0;
                for (const SquaredT& term : terms) {
                    sum += term.weight * drawn_square(engine, term.degrees_of_freedom);
                }
                below_low += sum <= low ? 1 : 0;
                below_high += sum <= high ? 1 : 0;
            }
            EXPECT_NEAR(below_low, 0.1 * k_trials, 4.5 * std::sqrt(0.09 * k_trials)) << n << " " << nu;
            EXPECT_NEAR(below_high, 0.7 * k_trials, 4.5 * std::sqrt(0.21 * k_trials)) << n << " " << nu;
        }
    }
}

TEST(SquaredT, TailsOfAnyNumberOfTermsAreThoseOfOneDistribution) {
    for (const std::size_t n : {1U, 2U, 10U, 60U, 160U, 500U, 1000U, 2000U}) {
        for (const double nu : {3.0, 10.0, 30.0, 1e4}) {
            std::vector<SquaredT> terms;
            for (std::size_t i = 0; i < n; ++i) {
                terms.push_back({1.0 + 0.5 * std::cos(static_cast<double>(i)), nu});
            }
            double before = 0.0;
            for (double f = 0.3; f < 3.0; f *= gumcert::test::cases(1.2, 1.08)) {
                const double x = f * static_cast<double>(n);
                const double lower = squared_t_lower_tail(terms, x);
                EXPECT_NEAR(lower + squared_t_upper_tail(terms, x), 1.0, 2.0 * k_least_tail_of_t) << n << " " << nu;
                EXPECT_GE(lower, before - 1e-11) << n << " " << nu << " " << f;
                before = lower;
            }
        }
    }
}

TEST(SquaredT, ManyInfiniteDegreesAreChiSquare) {
    for (const std::size_t n : {10U, 200U, 500U, 2000U}) {
        for (const double range : {0.4, 8.0}) {  // of ln λ, of which each term has its own
            std::vector<double> weights;
            std::vector<SquaredT> terms;
            double sum = 0.0;
            for (std::size_t i = 0; i < n; ++i) {
                weights.push_back(std::exp(range * std::sin(static_cast<double>(i))));
                terms.push_back({weights.back(), k_infinite});
                sum += weights.back();
            }
            for (const double f : {0.3, 0.8, 0.95, 1.0, 1.05, 1.3}) {
                EXPECT_NEAR(squared_t_lower_tail(terms, f * sum), weighted_chi_square_lower_tail(weights, f * sum),
                            1e-9)
                    << n << " " << range << " " << f;
            }
        }
    }
}

TEST(CommonT, OfAnyNumberOfEqualWeightsIsFisherF) {
    for (const std::size_t n : {1U, 3U, 60U, 300U, 1000U, 3000U}) {
        for (const double nu : {1.0, 3.0, 10.0, 30.0, 1000.0, 1e7}) {
            const boost::math::fisher_f_distribution<double> F(static_cast<double>(n), nu);
            const std::vector<double> weights(n, 1.0);
            for (const double f : {0.1, 0.7, 0.95, 1.0, 1.1, 4.0}) {
                const double x = f * static_cast<double>(n);
                const double lower = cdf(F, f);
                const double upper = cdf(complement(F, f));
                EXPECT_NEAR(common_t_lower_tail(weights, nu, x), lower, 1e-7 * lower + 1e-280) << n << " " << nu;
                EXPECT_NEAR(common_t_upper_tail(weights, nu, x), upper, 1e-7 * upper + 1e-280) << n << " " << nu;
            }
            EXPECT_NEAR(cdf(F, common_t_quantile(weights, nu, 0.025) / static_cast<double>(n)), 0.025, 1e-7);
        }
    }
}

TEST(SquaredT, FarTailsAreStatedByTheirLimit) {
    const std::vector<SquaredT> terms(20, SquaredT{1.0, 1e4});
    EXPECT_EQ(squared_t_upper_tail(terms, 400.0), k_least_tail_of_t);
    EXPECT_EQ(squared_t_lower_tail(terms, -1.0), 0.0);
    EXPECT_EQ(squared_t_upper_tail(terms, 0.0), 1.0);
}

TEST(CommonT, EqualWeightsAreFisherF) {
    for (const double nu : {1.0, 4.0, 30.0, 1e5}) {
        const boost::math::fisher_f_distribution<double> F(20.0, nu);
        const std::vector<double> weights(20, 2.0);
        for (const double x : {0.2, 1.0, 2.12, 5.0}) {
            EXPECT_NEAR(common_t_upper_tail(weights, nu, 40.0 * x) / cdf(complement(F, x)), 1.0, 1e-7)
                << nu << " " << x;
            EXPECT_NEAR(common_t_lower_tail(weights, nu, 40.0 * x) / cdf(F, x), 1.0, 1e-7) << nu << " " << x;
        }
        EXPECT_NEAR(common_t_quantile(weights, nu, 0.975) / (40.0 * quantile(F, 0.975)), 1.0, 1e-6) << nu;
    }
    EXPECT_NEAR(common_t_upper_tail(std::vector<double>{1.0, 3.0}, k_infinite, 5.0),
                weighted_chi_square_upper_tail(std::vector<double>{1.0, 3.0}, 5.0), 1e-12);
}

TEST(SquaredT, Refusals) {
    const auto code = [](SquaredT term) {
        return code_of<InputError>([&] { (void)squared_t_lower_tail(std::vector<SquaredT>{term}, 1.0); });
    };
    EXPECT_EQ(code({-1.0, 4.0}), "GC-GUM-0002");
    EXPECT_EQ(code({0.0, 4.0}), "GC-GUM-0003");
    EXPECT_EQ(code({1.0, 0.0}), "GC-GUM-0005");
    EXPECT_EQ(code_of<InputError>([] {
                  (void)squared_t_quantile(std::vector<SquaredT>{{1.0, 4.0}}, 1.0);
              }),
              "GC-GUM-0004");
    EXPECT_EQ(code_of<InputError>([] { (void)common_t_lower_tail(std::vector<double>{1.0}, -1.0, 1.0); }),
              "GC-GUM-0005");
}

TEST(CommonT, HasNothingBelow0) {
    const std::vector<double> weights{1.0, 2.0};
    for (const double nu : {3.0, 1e7, k_infinite}) {
        for (const double x : {0.0, -1.0}) {
            EXPECT_EQ(common_t_lower_tail(weights, nu, x), 0.0) << nu;
            EXPECT_EQ(common_t_upper_tail(weights, nu, x), 1.0) << nu;
        }
    }
    EXPECT_EQ(common_t_lower_tail(weights, 1e12, 2.5), weighted_chi_square_lower_tail(weights, 2.5));
}

// More weights in one place than nodes stand for them, so near to each other that their logarithms are equal.
TEST(SquaredT, WeightsThatDifferInTheirLastBitsAreEqual) {
    std::vector<SquaredT> equal{{1.0, 5.0}};
    std::vector<SquaredT> nearly = equal;
    double weight = 1e-13;
    for (int i = 0; i < 30; ++i) {
        equal.push_back({1e-13, 5.0});
        nearly.push_back({weight, 5.0});
        weight = std::nextafter(weight, 1.0);
    }
    for (const double x : {1e-3, 0.5, 4.0}) {
        EXPECT_NEAR(squared_t_lower_tail(nearly, x), squared_t_lower_tail(equal, x), 1e-12) << x;
        EXPECT_NEAR(squared_t_lower_tail(nearly, x), squared_t_lower_tail(std::vector<SquaredT>{{1.0, 5.0}}, x), 1e-8)
            << x;
    }
}

}  // namespace
}  // namespace gumcert::gum
