#include "app/budget_coverage.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "gum/coverage.h"
#include "tests/unit/engine/job/budget_campaign.h"

namespace gumcert::app {
namespace {

using testing::HasSubstr;

BudgetOutputResult evaluate(const std::string& inputs, const std::string& model, const std::string& more = "") {
    return evaluate_budget(
               engine::test::read_budget("\"model\": [\"y = " + model + "\"], \"inputs\": {" + inputs + "}" + more), 1)
        .points.at(0)
        .outputs.at(0);
}

std::string rectangular(const std::string& name) {
    return "\"" + name + R"(": {"value": 0, "half_width": 1})";
}

TEST(ExpandByPropagation, TakesTheConvolutionWhereItMovesTheFactor) {
    const BudgetOutputResult three = evaluate(rectangular("a") + ", " + rectangular("b") + ", " + rectangular("c"),
                                              "a + b + c", R"(, "coverage_probability": 0.99)");
    EXPECT_EQ(three.coverage, "convolution");
    EXPECT_NEAR(*three.coverage_factor, 2.379, 5e-4);
    EXPECT_THAT(three.coverage_note, HasSubstr("would be 2.58"));
    // No step where a criterion of domination begins: the factor goes on, until it is within 1 % of the normal one.
    double last = 1.6;
    bool normal = false;
    for (double u = 0.05; u < 2.0; u += 0.05) {
        const BudgetOutputResult one =
            evaluate(rectangular("a") + R"(, "b": {"value": 0, "u": )" + std::to_string(u) + "}", "a + b");
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
    const BudgetOutputResult alone = evaluate(R"("a": {"value": 1, "u": 1, "nu": 4})", "a");
    EXPECT_EQ(alone.coverage, "student_t");
    EXPECT_NEAR(*alone.coverage_factor, gum::coverage_factor(0.9545, 4.0), 1e-12);
    // Half of the variance with 4 degrees of freedom: Welch and Satterthwaite have 16, the sum is wider than that.
    const BudgetOutputResult half =
        evaluate(R"("a": {"value": 1, "u": 1, "nu": 4}, "b": {"value": 1, "u": 1})", "a + b");
    EXPECT_EQ(half.coverage, "convolution");
    EXPECT_NEAR(half.degrees_of_freedom, 16.0, 1e-9);
    EXPECT_NEAR(*half.coverage_factor, 2.4406, 5e-5);
    EXPECT_GT(*half.coverage_factor, gum::coverage_factor(0.9545, 16.0));
}

TEST(ExpandByPropagation, HonoursTheReliabilityOfLimits) {
    // Half-widths from 0.5 to 1.5, all equally probable: P(|X| ≤ U) = 1 − (1.5 − U)/2 … by the curvilinear trapezoid.
    const BudgetOutputResult inexact = evaluate(R"("x": {"value": 0, "half_width": 1, "reliability": 0.5})", "x");
    EXPECT_EQ(inexact.coverage, "convolution");
    EXPECT_NEAR(inexact.standard_uncertainty, 1.0 / std::sqrt(3.0), 1e-12);
    const double U = *inexact.expanded_uncertainty;
    EXPECT_NEAR(1.5 - U + U * std::log(U / 1.5), 1.0 - 0.9545, 1e-6);  // P(|X| > U)
    const BudgetOutputResult exact = evaluate(R"("x": {"value": 0, "half_width": 1})", "x");
    EXPECT_GT(U, *exact.expanded_uncertainty);
    // Monte Carlo draws the same.
    const BudgetOutputResult drawn = evaluate(R"("x": {"value": 0, "half_width": 1, "reliability": 0.5})", "x",
                                              R"(, "monte_carlo": {"trials": 100000})");
    EXPECT_NEAR(drawn.monte_carlo->symmetric.high, U, 0.01);
}

TEST(ExpandByPropagation, TakesTheLeastDegreesOfFreedomOfCorrelatedInputs) {
    const BudgetOutputResult small =
        evaluate(R"("a": {"value": 1, "u": 0.001, "nu": 1000}, "b": {"value": 1, "u": 0.001, "nu": 1001},
                    "c": {"value": 5, "u": 1})",
                 "a + b + c", R"(, "correlations": [["a", "b", 0.1]])");
    EXPECT_EQ(small.coverage, "student_t");
    EXPECT_NEAR(*small.coverage_factor, 2.0, 1e-3);
    const BudgetOutputResult large = evaluate(R"("a": {"value": 1, "u": 1, "nu": 5}, "b": {"value": 1, "u": 1})",
                                              "a + b", R"(, "correlations": [["a", "b", 0.5]])");
    EXPECT_NEAR(large.degrees_of_freedom, 5.0, 1e-12);
    EXPECT_NEAR(*large.expanded_uncertainty, std::sqrt(3.0) * gum::coverage_factor(0.9545, 5.0), 1e-9);
}

TEST(ExpandByPropagation, KeepsTheShapeOfCorrelatedComponents) {
    const std::string a =
        R"("a": {"components": [{"name": "big", "value": 0, "half_width": 100}, {"name": "small", "value": 0, "u": 1}]},
           "b": {"value": 0, "u": 1})";
    const BudgetOutputResult result = evaluate(a, "a + b", R"(, "correlations": [["a", "b", 0.1]])");
    EXPECT_EQ(result.coverage, "convolution");
    EXPECT_NEAR(*result.expanded_uncertainty, 95.6, 0.6);
}

// ν that k is taken for is the one that is reported and decided with.
TEST(ExpandByPropagation, TruncatesDegreesOfFreedomEverywhere) {
    const BudgetOutputResult result = evaluate(R"("x": {"value": 0, "u": 1, "nu": 2.9})", "x",
                                               R"(, "reporting": {"degrees_of_freedom": "truncated"})");
    EXPECT_EQ(result.coverage, "student_t");
    EXPECT_EQ(result.degrees_of_freedom, 2.0);
    EXPECT_EQ(*result.coverage_factor, gum::coverage_factor(0.9545, 2.0));
}

TEST(ExpandByPropagation, SeesTheAsymmetryOfCorrelatedInputs) {
    const BudgetOutputResult together = evaluate(
        R"("a": {"distribution": {"kind": "exponential", "mean": 1}}, "b": {"distribution": {"kind": "exponential", "mean": 1}})",
        "a + b", R"(, "correlations": [["a", "b", 0.5]])");
    EXPECT_GT(together.asymmetry.value(), 0.3);
    EXPECT_TRUE(together.by_monte_carlo);
    EXPECT_EQ(together.because, "asymmetric");
    // No skewness, and ends that are not equally far away: P(−1) = 1/4, P(0) = 5/8, P(2) = 1/8.
    std::string samples;
    for (int i = 0; i < 16; ++i) {
        samples += std::string(i == 0 ? "" : ", ") + "-1, -1, 0, 0, 0, 0, 0, 2";
    }
    const BudgetOutputResult counted = evaluate(R"("a": {"samples": [)" + samples + "]}", "a");
    EXPECT_GT(std::abs(counted.asymmetry.value()), 0.1);
    EXPECT_TRUE(counted.by_monte_carlo);
}

// k follows from what the inputs are, not from their order; one without an effect changes nothing.
TEST(ExpandByPropagation, DoesNotDependOnTheOrderOfCorrelatedInputs) {
    const std::string a = rectangular("a");
    const std::string b = rectangular("b");
    const std::string c = R"("c": {"value": 0, "half_width": 1.2, "distribution": "triangular"})";
    const auto factor = [](const std::string& inputs, const std::string& model) {
        return evaluate(inputs, model, R"(, "correlations": [["a", "c", 0.5], ["b", "c", 0.3]])")
            .coverage_factor.value();
    };
    for (const char* model : {"a + b + c", "a - b + c", "c - b"}) {
        // But for the last bit, in which sums of another order differ.
        EXPECT_NEAR(factor(a + ", " + b + ", " + c, model), factor(b + ", " + a + ", " + c, model), 1e-13) << model;
        EXPECT_NEAR(factor(a + ", " + b + ", " + c, model), factor(c + ", " + b + ", " + a, model), 1e-13) << model;
    }
    EXPECT_EQ(factor(a + ", " + b + ", " + c, "c"), evaluate(c, "c").coverage_factor.value());
}

TEST(ExpandByPropagation, TellsWhereTheResultIsNotSymmetric) {
    const BudgetOutputResult skewed =
        evaluate(R"("x": {"distribution": {"kind": "exponential", "mean": 1}}, "b": {"value": 0, "u": 1})", "x + b");
    EXPECT_EQ(skewed.coverage, "convolution");
    EXPECT_GT(skewed.asymmetry.value(), 0.1);
    EXPECT_EQ(evaluate(rectangular("a"), "a").asymmetry.value(), 0.0);
}

// What is stated as the error of k is what other draws would change it by.
TEST(ExpandByPropagation, StatesTheErrorOfADrawnFactor) {
    const std::string pair = R"("a": {"value": 0, "half_width": 1}, "b": {"value": 0, "half_width": 1})";
    const BudgetOutputResult drawn = evaluate(pair, "a + b", R"(, "correlations": [["a", "b", 0.5]])");
    ASSERT_EQ(drawn.coverage, "convolution");
    ASSERT_TRUE(drawn.k_numerical_error.has_value());
    EXPECT_THAT(drawn.coverage_note,
                HasSubstr("; the numerical error of k from 65536 draws of correlated inputs is 0.00"));
    EXPECT_GT(*drawn.k_numerical_error, 0.0005);
    EXPECT_LT(*drawn.k_numerical_error, 0.01);
    const BudgetOutputResult trials =
        evaluate(pair, "a + b", R"(, "correlations": [["a", "b", 0.5]], "monte_carlo": {"trials": 2000000})");
    const gum::MonteCarloOutput& mc = *trials.monte_carlo;
    EXPECT_NEAR(0.5 * (mc.symmetric.high - mc.symmetric.low) / drawn.standard_uncertainty, *drawn.coverage_factor,
                5.0 * *drawn.k_numerical_error);
    // Nothing is drawn of independent inputs, nor of normal ones.
    EXPECT_FALSE(evaluate(pair, "a + b").k_numerical_error.has_value());
}

// Samples are values with probabilities of their own: U is one of their differences, not the edge of a cell.
TEST(ExpandByPropagation, TakesTheQuantileOfDiscreteSamples) {
    std::string samples;
    for (int i = 0; i < 120; ++i) {
        samples += std::string(i == 0 ? "" : ", ") + (i % 12 == 0   ? "1.3"
                                                      : i % 12 == 1 ? "0.7"
                                                      : i % 2 == 0  ? "1.1"
                                                                    : "0.9");
    }
    const BudgetOutputResult one = evaluate("\"x\": {\"samples\": [" + samples + "]}", "x");
    ASSERT_EQ(one.coverage, "convolution");
    EXPECT_NEAR(*one.expanded_uncertainty, 0.3, 1e-12);
    const BudgetOutputResult two =
        evaluate("\"x\": {\"samples\": [" + samples + "]}, \"z\": {\"samples\": [" + samples + "]}", "x + 2*z");
    const double tenths = *two.expanded_uncertainty * 10.0;
    EXPECT_NEAR(tenths, std::round(tenths), 1e-9);
    // Trials have the same values, however many they are.
    for (const char* trials : {"200000", "3000000"}) {
        const BudgetOutputResult drawn = evaluate("\"x\": {\"samples\": [" + samples + "]}", "x",
                                                  std::string(R"(, "monte_carlo": {"trials": )") + trials + "}");
        EXPECT_NEAR(drawn.monte_carlo->symmetric.high, 1.3, 1e-12) << trials;
        EXPECT_NEAR(drawn.monte_carlo->symmetric.low, 0.7, 1e-12) << trials;
    }
}

}  // namespace
}  // namespace gumcert::app
