#include "gum/budget/budget_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gum/coverage.h"
#include "gum/monte_carlo/convolution.h"
#include "gum/monte_carlo/trial_distribution.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::correlate;
using test::input;
using test::rectangular;
using test::samples;
using test::shaped;
using test::sum_of;
using testing::HasSubstr;

BudgetOutputResult evaluated(const std::string& model, std::vector<BudgetInput> inputs) {
    return test::first_result(test::budget({"y = " + model}, std::move(inputs)));
}

BudgetOutputResult correlated(const std::string& model, std::vector<BudgetInput> inputs, double r) {
    Budget of = test::budget({"y = " + model}, std::move(inputs));
    correlate(of, "a", "b", r);
    return test::first_result(of);
}

BudgetInput unit_rectangle(const std::string& name) {
    return input(name, rectangular(0, 1));
}

TEST(ExpandByPropagation, TakesTheConvolutionWhereItMovesTheFactor) {
    Budget of = test::budget({"y = a + b + c"}, {unit_rectangle("a"), unit_rectangle("b"), unit_rectangle("c")});
    of.coverage_probability = 0.99;
    const BudgetOutputResult three = test::first_result(of);
    EXPECT_EQ(three.coverage, "convolution");
    EXPECT_NEAR(*three.coverage_factor, 2.379, 5e-4);
    EXPECT_THAT(three.coverage_note, HasSubstr("would be 2.58"));
    // No step where a criterion of domination begins: the factor goes on, until it is within 1 % of the normal one.
    double last = 1.6;
    bool normal = false;
    for (double u = 0.05; u < 2.0; u += 0.05) {
        const BudgetOutputResult one = evaluated("a + b", {unit_rectangle("a"), input("b", state_uncertainty(0, u))});
        EXPECT_GT(*one.coverage_factor, last - 1e-9) << u;
        EXPECT_LT(*one.coverage_factor - last, 0.07) << u;
        EXPECT_TRUE(!normal || one.coverage == "normal") << u;
        normal = one.coverage == "normal";
        last = *one.coverage_factor;
    }
    EXPECT_TRUE(normal);
    EXPECT_NEAR(last, 2.0, 1e-4);
}

TEST(ExpandByPropagation, TakesTypeAWithItsDistribution) {
    const BudgetOutputResult alone = evaluated("a", {input("a", state_uncertainty(1, 1, 4))});
    EXPECT_EQ(alone.coverage, "student_t");
    EXPECT_NEAR(*alone.coverage_factor, coverage_factor(0.9545, 4.0), 1e-12);
    // Half of the variance with 4 degrees of freedom: Welch and Satterthwaite have 16, the sum is wider than that.
    const BudgetOutputResult half =
        evaluated("a + b", {input("a", state_uncertainty(1, 1, 4)), input("b", state_uncertainty(1, 1))});
    EXPECT_EQ(half.coverage, "convolution");
    EXPECT_NEAR(half.degrees_of_freedom, 16.0, 1e-9);
    EXPECT_NEAR(*half.coverage_factor, 2.4406, 5e-5);
    EXPECT_GT(*half.coverage_factor, coverage_factor(0.9545, 16.0));
}

TEST(ExpandByPropagation, HonoursTheReliabilityOfLimits) {
    // Half-widths from 0.5 to 1.5, all equally probable: P(|X| ≤ U) = 1 − (1.5 − U)/2 … by the curvilinear trapezoid.
    StatedQuantity inexact_limits = shaped(DistributionKind::curvilinear_trapezoid, 0, 1, 0.5);
    inexact_limits.u = 1.0 / std::sqrt(3.0);
    inexact_limits.degrees_of_freedom = degrees_of_freedom_from_reliability(0.5);
    Budget of = test::budget({"y = x"}, {input("x", inexact_limits)});
    const BudgetOutputResult inexact = test::first_result(of);
    EXPECT_EQ(inexact.coverage, "convolution");
    const double U = *inexact.expanded_uncertainty;
    EXPECT_NEAR(1.5 - U + U * std::log(U / 1.5), 1.0 - 0.9545, 1e-6);  // P(|X| > U)
    EXPECT_GT(U, *evaluated("x", {unit_rectangle("x")}).expanded_uncertainty);
    // Monte Carlo draws the same.
    of.monte_carlo.emplace().trials = 100000;
    EXPECT_NEAR(test::first_result(of).monte_carlo->symmetric.high, U, 0.01);
}

TEST(ExpandByPropagation, TakesTheLeastDegreesOfFreedomOfCorrelatedInputsForThoseOfTheResult) {
    const BudgetOutputResult small =
        correlated("a + b + c",
                   {input("a", state_uncertainty(1, 0.001, 1000)), input("b", state_uncertainty(1, 0.001, 1001)),
                    input("c", state_uncertainty(5, 1))},
                   0.1);
    EXPECT_EQ(small.coverage, "student_t");
    EXPECT_NEAR(*small.coverage_factor, 2.0, 1e-3);
    const BudgetOutputResult large =
        correlated("a + b", {input("a", state_uncertainty(1, 1, 5)), input("b", state_uncertainty(1, 1))}, 0.5);
    EXPECT_NEAR(large.degrees_of_freedom, 5.0, 1e-12);
    // t with 5 degrees of freedom would have 4.59; four million draws of another program have 4.031.
    EXPECT_EQ(large.coverage, "convolution");
    EXPECT_NEAR(*large.expanded_uncertainty, 4.031, 0.02);
}

TEST(ExpandByPropagation, KeepsTheShapeOfCorrelatedComponents) {
    const BudgetOutputResult result = correlated(
        "a + b", {sum_of("a", {rectangular(0, 100), state_uncertainty(0, 1)}), input("b", state_uncertainty(0, 1))},
        0.1);
    EXPECT_EQ(result.coverage, "convolution");
    EXPECT_NEAR(*result.expanded_uncertainty, 95.6, 0.6);
}

// ν that k is taken for is the one that is reported and decided with.
TEST(ExpandByPropagation, TruncatesDegreesOfFreedomEverywhere) {
    Budget of = test::budget({"y = x"}, {input("x", state_uncertainty(0, 1, 2.9))});
    of.truncate_degrees_of_freedom = true;
    const BudgetOutputResult result = test::first_result(of);
    EXPECT_EQ(result.coverage, "student_t");
    EXPECT_EQ(result.degrees_of_freedom, 2.0);
    EXPECT_EQ(*result.coverage_factor, coverage_factor(0.9545, 2.0));
}

TEST(ExpandByPropagation, SeesTheAsymmetryOfCorrelatedInputs) {
    const StatedQuantity waiting = shaped(DistributionKind::exponential, 0, 1);
    const BudgetOutputResult together = correlated("a + b", {input("a", waiting), input("b", waiting)}, 0.5);
    EXPECT_GT(together.asymmetry.value(), 0.3);
    EXPECT_TRUE(together.by_monte_carlo);
    EXPECT_EQ(together.because, "asymmetric");
    // No skewness, and ends that are not equally far away: P(−1) = 1/4, P(0) = 5/8, P(2) = 1/8.
    std::vector<double> values;
    for (int i = 0; i < 16; ++i) {
        values.insert(values.end(), {-1, -1, 0, 0, 0, 0, 0, 2});
    }
    const BudgetOutputResult counted = evaluated("a", {input("a", samples(values))});
    EXPECT_GT(std::abs(counted.asymmetry.value()), 0.1);
    EXPECT_TRUE(counted.by_monte_carlo);
}

// k follows from what the inputs are, not from their order; one without an effect changes nothing.
TEST(ExpandByPropagation, DoesNotDependOnTheOrderOfCorrelatedInputs) {
    const BudgetInput a = unit_rectangle("a");
    const BudgetInput b = unit_rectangle("b");
    const BudgetInput c = input("c", shaped(DistributionKind::triangular, 0, 1.2));
    const auto factor = [](const std::string& model, std::vector<BudgetInput> inputs) {
        Budget of = test::budget({"y = " + model}, std::move(inputs));
        correlate(of, "a", "c", 0.5);
        correlate(of, "b", "c", 0.3);
        return test::first_result(of).coverage_factor.value();
    };
    for (const char* model : {"a + b + c", "a - b + c", "c - b"}) {
        // But for the last bit, in which sums of another order differ.
        EXPECT_NEAR(factor(model, {a, b, c}), factor(model, {b, a, c}), 1e-13) << model;
        EXPECT_NEAR(factor(model, {a, b, c}), factor(model, {c, b, a}), 1e-13) << model;
    }
    EXPECT_EQ(factor("c", {a, b, c}), evaluated("c", {c}).coverage_factor.value());
}

TEST(ExpandByPropagation, TellsWhereTheResultIsNotSymmetric) {
    const BudgetOutputResult skewed = evaluated(
        "x + b", {input("x", shaped(DistributionKind::exponential, 0, 1)), input("b", state_uncertainty(0, 1))});
    EXPECT_EQ(skewed.coverage, "convolution");
    EXPECT_GT(skewed.asymmetry.value(), 0.1);
    EXPECT_EQ(evaluated("a", {unit_rectangle("a")}).asymmetry.value(), 0.0);
}

// What is stated as the error of k is what other draws would change it by.
TEST(ExpandByPropagation, StatesTheErrorOfADrawnFactor) {
    Budget pair = test::budget({"y = a + b"}, {unit_rectangle("a"), unit_rectangle("b")});
    EXPECT_FALSE(test::first_result(pair).k_numerical_error.has_value());  // nothing is drawn of independent inputs
    correlate(pair, "a", "b", 0.5);
    const BudgetOutputResult drawn = test::first_result(pair);
    ASSERT_EQ(drawn.coverage, "convolution");
    ASSERT_TRUE(drawn.k_numerical_error.has_value());
    EXPECT_THAT(drawn.coverage_note,
                HasSubstr("; the numerical error of k from 65536 draws of correlated inputs is 0.00"));
    EXPECT_GT(*drawn.k_numerical_error, 0.0005);
    EXPECT_LT(*drawn.k_numerical_error, 0.01);
    pair.monte_carlo.emplace().trials = 2000000;
    const MonteCarloOutput trials = *test::first_result(pair).monte_carlo;
    EXPECT_NEAR(0.5 * (trials.symmetric.high - trials.symmetric.low) / drawn.standard_uncertainty,
                *drawn.coverage_factor, 5.0 * *drawn.k_numerical_error);
}

// Samples are values with probabilities of their own: U is one of their differences, not the edge of a cell.
TEST(ExpandByPropagation, TakesTheQuantileOfDiscreteSamples) {
    std::vector<double> values;
    for (int i = 0; i < 120; ++i) {
        values.push_back(i % 12 == 0 ? 1.3 : i % 12 == 1 ? 0.7 : i % 2 == 0 ? 1.1 : 0.9);
    }
    const BudgetOutputResult one = evaluated("x", {input("x", samples(values))});
    ASSERT_EQ(one.coverage, "convolution");
    EXPECT_NEAR(*one.expanded_uncertainty, 0.3, 1e-12);
    const BudgetOutputResult two = evaluated("x + 2*z", {input("x", samples(values)), input("z", samples(values))});
    const double tenths = *two.expanded_uncertainty * 10.0;
    EXPECT_NEAR(tenths, std::round(tenths), 1e-9);
    // Trials have the same values, however many they are.
    for (const std::uint64_t trials : {200'000U, 3'000'000U}) {
        Budget of = test::budget({"y = x"}, {input("x", samples(values))});
        of.monte_carlo.emplace().trials = trials;
        const BudgetOutputResult drawn = test::first_result(of);
        EXPECT_NEAR(drawn.monte_carlo->symmetric.high, 1.3, 1e-12) << trials;
        EXPECT_NEAR(drawn.monte_carlo->symmetric.low, 0.7, 1e-12) << trials;
    }
}

TEST(ConvolutionNote, NamesTheDistributionThatItReplaces) {
    EXPECT_THAT(convolution_note(16.0, 2.169), HasSubstr("t-distribution would be 2.17"));
    EXPECT_THAT(convolution_note(INFINITY, 2.0), HasSubstr("normal distribution would be 2.00"));
    EXPECT_FALSE(is_noticed_change(2.019, 2.0));
    EXPECT_TRUE(is_noticed_change(2.021, 2.0));
}

// k = 0 and U = 0 say that nothing is uncertain: 96 of 100 readings are 0, the others ±1.
TEST(ExpandByPropagation, StatesNoUWhereTheIntervalHasNoWidth) {
    for (const std::vector<double>& others : {std::vector<double>{1, -1, 1, -1}, std::vector<double>{1, 1, 1, 1}}) {
        std::vector<double> values(96, 0.0);
        values.insert(values.end(), others.begin(), others.end());
        Budget of = test::budget({"y = a"}, {input("a", samples(values))});
        of.coverage_probability = 0.9;
        of.coverage = CoverageChoice::law_of_propagation;
        const BudgetOutputResult y = test::first_result(of);
        EXPECT_GT(y.standard_uncertainty, 0.1);
        EXPECT_FALSE(y.expanded_uncertainty || y.coverage_factor);
        EXPECT_EQ(y.coverage, "none");
        EXPECT_THAT(y.coverage_note, HasSubstr("has no width"));
    }
}

/// Inputs a, b and perhaps c with the degrees of freedom of a list, correlated where that list of pairs says so.
struct MadeCopula {
    std::vector<double> nu;
    double r_ab = 0.0, r_bc = 0.0;
    int sign_b = 1;
    double u_b = 1.0;
    double p = 0.95;

    [[nodiscard]] Budget budget() const {
        Budget of =
            test::budget({std::string("y = a ") + (sign_b > 0 ? "+ b" : "- b") + (nu.size() > 2 ? " + c" : "")},
                         {input("a", state_uncertainty(0, 1, nu[0])), input("b", state_uncertainty(0, u_b, nu[1]))});
        if (nu.size() > 2) {
            of.inputs.push_back(input("c", state_uncertainty(0, 0.7, nu[2])));
        }
        correlate(of, "a", "b", r_ab);
        if (r_bc != 0.0) {
            correlate(of, "b", "c", r_bc);
        }
        of.coverage_probability = p;
        return of;
    }
};

MadeCopula made_copula(std::mt19937& random) {
    const auto one_of = [&](const std::vector<double>& values) { return values[random() % values.size()]; };
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    MadeCopula made{.nu = {one_of({3, 4, 6}), one_of({4, 12, k_infinite})}};
    made.r_ab = one_of({-0.9, -0.5, 0.3, 0.8, 0.95, 0.97});
    made.sign_b = random() % 2 == 0 ? 1 : -1;
    made.u_b = one_of({0.3, 1.0, 1.2});
    made.p = one_of({0.9, 0.95, 0.9545, 0.99});
    if (random() % 3 == 0) {
        made.nu.push_back(one_of({3, 12, k_infinite}));
        made.r_bc = std::abs(made.r_ab) < 0.9 ? one_of({0.0, 0.4}) : 0.0;
    }
    return made;
}

// A law over generated budgets: law of propagation and Monte Carlo take correlated inputs with unlike degrees of freedom as the
// same distribution, k, U and probabilities of conformity alike. Of a - b with r = 0.95 the variance goes and the tail stays.
TEST(ExpandByPropagation, TakesCorrelatedStudentsAsMonteCarloDrawsThem) {
    std::mt19937 random(3);
    for (int i = 0; i < 24; ++i) {
        const MadeCopula made = made_copula(random);
        Budget of = made.budget();
        of.monte_carlo.emplace().trials = 200000;
        const BudgetResult result = evaluate_budget(of, 1);
        const BudgetPointResult& point = result.points[0];
        const BudgetOutputResult& y = point.outputs[0];
        const double half = 0.5 * (y.monte_carlo->symmetric.high - y.monte_carlo->symmetric.low);
        EXPECT_NEAR(*y.expanded_uncertainty / half, 1.0, 0.03)
            << i << ": nu " << made.nu[0] << ", " << made.nu[1] << ", r " << made.r_ab << ", p " << made.p;
        EXPECT_LT(std::abs(y.asymmetry.value_or(0.0)), 1e-3) << i;
        const auto terms = convolution_terms(*point.model, point.propagation, 0);
        ASSERT_TRUE(terms);
        const ConvolutionDistribution distribution(*terms);
        const TrialDistribution trials = count_trials({.model = point.model,
                                                       .output = 0,
                                                       .unit = Unit::parse("1"),
                                                       .seed = point.monte_carlo->seed,
                                                       .streams = point.streams,
                                                       .trials = 200000});
        const double draws = distribution.draws() > 0 ? static_cast<double>(distribution.draws()) : 1e9;
        for (const double x : {0.3 * half, half, 1.5 * half}) {
            const double p = trials.function(x);
            EXPECT_NEAR(distribution(x), p, 3.5 * std::sqrt(p * (1.0 - p) * (1.0 / 200000.0 + 1.0 / draws)) + 1e-4)
                << i;
        }
    }
}

TEST(ExpandByPropagation, DrawsOnlyWhatIsCorrelatedAndNotNormal) {
    const auto evaluated_of = [](const std::string& model, double nu_c) {
        Budget of =
            test::budget({"y = " + model}, {input("a", state_uncertainty(0, 1)), input("b", state_uncertainty(0, 1)),
                                            input("c", state_uncertainty(0, 1, nu_c))});
        correlate(of, "a", "b", 0.5);
        correlate(of, "b", "c", 0.5);
        return test::first_result(of);
    };
    // Of a and b alone c has no effect, and its degrees of freedom none; a and c are independent of each other.
    EXPECT_NEAR(*evaluated_of("a - b + 0*c", 4).expanded_uncertainty,
                coverage_factor(0.9545, std::numeric_limits<double>::infinity()), 1e-5);
    Budget independent =
        test::budget({"y = a + c"}, {input("a", state_uncertainty(0, 1)), input("c", state_uncertainty(0, 1, 4))});
    EXPECT_NEAR(*evaluated_of("a + 0*b + c", 4).expanded_uncertainty,
                *test::first_result(independent).expanded_uncertainty, 1e-9);
    EXPECT_EQ(evaluated_of("a + 0*b + c", 4).k_numerical_error.value_or(0.0), 0.0);
    // With so many degrees of freedom a quantity is normal.
    EXPECT_NEAR(*evaluated_of("a + b + c", 2e6).expanded_uncertainty,
                std::sqrt(5.0) * coverage_factor(0.9545, std::numeric_limits<double>::infinity()), 1e-4);
}

// r = 1 of a normal and a t-distributed input leaves no variance by the law of propagation; the tails stay.
TEST(ExpandByPropagation, KeepsTheTailsOfWhatCancels) {
    Budget of =
        test::budget({"y = a - b + c"}, {input("a", state_uncertainty(0, 1, 4)), input("b", state_uncertainty(0, 1)),
                                         input("c", state_uncertainty(0, 0.1))});
    correlate(of, "a", "b", 1.0);
    of.monte_carlo.emplace().trials = 200000;
    const BudgetOutputResult y = test::first_result(of);
    EXPECT_NEAR(y.standard_uncertainty, 0.1, 1e-9);
    EXPECT_NEAR(*y.expanded_uncertainty / (0.5 * (y.monte_carlo->symmetric.high - y.monte_carlo->symmetric.low)), 1.0,
                0.03);
}

// Reliability of 100 % is half a degree of freedom: no variance and no mean, and an interval all the same.
TEST(ExpandByPropagation, OfDrawsWithoutAVariance) {
    for (const double nu : {0.5, 1.0, 1.5}) {
        Budget of = test::budget({"y = a - b + c"},
                                 {input("a", state_uncertainty(0, 1, nu)), input("b", state_uncertainty(0, 1, 9)),
                                  input("c", state_uncertainty(0, 0.2))});
        correlate(of, "a", "b", 0.5);
        of.monte_carlo.emplace().trials = 400000;
        const BudgetOutputResult y = test::first_result(of);
        const double half = 0.5 * (y.monte_carlo->symmetric.high - y.monte_carlo->symmetric.low);
        EXPECT_NEAR(*y.expanded_uncertainty / half, 1.0, nu < 1.0 ? 0.2 : 0.07) << nu;
        EXPECT_LT(std::abs(y.asymmetry.value_or(0.0)), 0.02) << nu;
    }
}

}  // namespace
}  // namespace gumcert::gum
