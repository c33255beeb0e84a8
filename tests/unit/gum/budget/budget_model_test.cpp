#include "gum/budget/budget_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/evaluate_budget.h"
#include "gum/monte_carlo/trial_distribution.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::correlate;
using test::first_result;
using test::input;
using test::rectangular;
using test::samples;
using test::shaped;
using test::sum_of;
using test::tells;
using testing::HasSubstr;

Budget drawn(Budget of, std::uint64_t trials = 200000) {
    of.monte_carlo.emplace().trials = trials;
    return of;
}

/// u of the law of propagation, which Monte Carlo must have too: the models are linear.
double checked_u(const Budget& of) {
    const BudgetOutputResult output = first_result(drawn(of));
    EXPECT_NEAR(output.monte_carlo->standard_uncertainty / output.standard_uncertainty, 1.0, 0.008);
    return output.standard_uncertainty;
}

std::vector<double> wave(double shift) {
    std::vector<double> values;
    for (int i = 0; i < 500; ++i) {
        values.push_back(std::sin(0.7 * i) + 0.5 * std::cos(1.3 * i * i) + shift * std::sin(2.9 * i * i));
    }
    return values;
}

TEST(BudgetModel, TurnsAnglesThatLeapAndLeavesOtherOutputsAlone) {
    // The direction of (s, c) about 179°, 0.02 rad wide, and a number.
    const double angle = 179.0 * std::numbers::pi / 180.0;
    const StatedQuantity s = shaped(DistributionKind::normal, std::sin(angle), 0.02);
    const StatedQuantity c = shaped(DistributionKind::normal, std::cos(angle), 0.02);
    const BudgetResult result =
        evaluate_budget(drawn(test::budget({"t = atan2(s, c)", "l = 7*s"}, {input("s", s), input("c", c)})), 1);
    const BudgetPointResult& point = result.points[0];
    Eigen::MatrixXd x(2, 2);
    x << -0.01, -1.0, 0.01, -1.0;
    Eigen::MatrixXd y(2, 2);
    point.model->evaluate_trials(x, y);
    EXPECT_GT(y(0, 0), std::numbers::pi);
    EXPECT_LT(y(1, 0), std::numbers::pi);
    EXPECT_NEAR(y(0, 0) - y(1, 0), 0.02, 1e-5);
    EXPECT_EQ(y(0, 1), -0.07);
    EXPECT_EQ(point.model->evaluate(x.row(0).transpose()), y.row(0).transpose());
    // Whoever draws the trials again, as a decision on conformity does, sees those that are stated.
    const TrialDistribution again = count_trials({.model = point.model,
                                                  .output = 0,
                                                  .unit = Unit::parse("rad"),
                                                  .seed = point.monte_carlo->seed,
                                                  .streams = point.streams,
                                                  .trials = point.outputs[0].trials});
    const CoverageInterval& stated = point.outputs[0].monte_carlo->symmetric;
    EXPECT_NEAR(again.function(stated.high) - again.function(stated.low), 0.9545, 1e-3);
    EXPECT_NEAR(again.function(angle), 0.5, 0.01);
}

TEST(BudgetModel, DrawsSamplesOfOneFileByItsRows) {
    const Budget joint =
        test::budget({"y = a - b"}, {input("a", samples(wave(0.0), "s")), input("b", samples(wave(0.1), "s"))});
    EXPECT_NEAR(checked_u(joint), 0.0707, 0.003);
    const BudgetResult result = evaluate_budget(drawn(joint), 1);
    EXPECT_TRUE(tells(result, "GC-BUDGET-0013"));
    EXPECT_EQ(result.points[0].model->inputs().size(), 1U);
    // The interval, too, is that of the differences in the file.
    EXPECT_NEAR(*result.points[0].outputs[0].expanded_uncertainty,
                0.5 * (result.points[0].outputs[0].monte_carlo->symmetric.high -
                       result.points[0].outputs[0].monte_carlo->symmetric.low),
                0.003);
    const Budget apart =
        test::budget({"y = a - b"}, {input("a", samples(wave(0.0), "s")), input("b", samples(wave(0.1), "t"))});
    EXPECT_EQ(evaluate_budget(apart, 1).points[0].model->inputs().size(), 2U);
}

TEST(BudgetModel, RefusesCorrelationsBesideJointSamples) {
    for (const auto& [second, r] : {std::pair{"b", 0.9}, std::pair{"x", 0.2}}) {
        Budget of =
            test::budget({"y = a + b + x"}, {input("a", samples(wave(0.0), "s")), input("b", samples(wave(0.1), "s")),
                                             input("x", state_uncertainty(1.0, 1.0))});
        correlate(of, "a", second, r);
        try {
            (void)evaluate_budget(of, 1);
            ADD_FAILURE() << second;
        } catch (const InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-BUDGET-0003");
        }
    }
}

TEST(BudgetModel, HasThePearsonCoefficientOfAnyPair) {
    Budget uniform = test::budget({"y = a + b"}, {input("a", rectangular(0, 1)), input("b", rectangular(0, 1))});
    correlate(uniform, "a", "b", -0.9);
    EXPECT_NEAR(checked_u(uniform), 0.2582, 5e-5);
    const auto mixed = [](double r_ab) {
        Budget of = test::budget({"y = a + 2*b - c"}, {input("a", shaped(DistributionKind::exponential, 0, 1)),
                                                       input("b", rectangular(0, 1)),
                                                       input("c", shaped(DistributionKind::lognormal, 0, 1, 0.5))});
        correlate(of, "a", "b", r_ab);
        correlate(of, "b", "c", 0.4);
        correlate(of, "a", "c", 0.2);
        return of;
    };
    (void)checked_u(mixed(-0.5));
    // Possible for normal quantities, but not for these: told.
    EXPECT_TRUE(tells(evaluate_budget(mixed(-0.7), 1), "GC-BUDGET-0014"));
    Budget opposed = test::budget({"y = a + b"}, {input("a", shaped(DistributionKind::exponential, 0, 1)),
                                                  input("b", shaped(DistributionKind::exponential, 0, 1))});
    correlate(opposed, "a", "b", -1.0);
    try {
        (void)evaluate_budget(opposed, 1);
        ADD_FAILURE();
    } catch (const InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-BUDGET-0002");
        EXPECT_THAT(error.diagnostics().front().rule, HasSubstr("-0.6449"));  // 1 − π²/6
    }
}

TEST(BudgetModel, KeepsTheShapeOfComponentsThatAreCorrelated) {
    const auto of = [](double r) {
        Budget made = test::budget({"y = a + b"}, {sum_of("a", {rectangular(0, 100), state_uncertainty(0, 1)}),
                                                   sum_of("b", {rectangular(0, 2), state_uncertainty(0, 1)})});
        correlate(made, "a", "b", r);
        return made;
    };
    EXPECT_NEAR(checked_u(of(0.8)),
                std::sqrt(1e4 / 3.0 + 1.0 + 7.0 / 3.0 + 1.6 * std::sqrt((1e4 / 3.0 + 1.0) * (7.0 / 3.0))), 1e-9);
    EXPECT_NEAR(first_result(drawn(of(0.1))).monte_carlo->symmetric.high, 95.6, 0.6);
}

TEST(BudgetModel, TellsWhichDegreesOfFreedomCorrelatedInputsGet) {
    const auto evaluated = [](double nu_a, double nu_b) {
        Budget of = test::budget(
            {"y = a + b"}, {input("a", state_uncertainty(1, 1, nu_a)), input("b", state_uncertainty(1, 1, nu_b))});
        correlate(of, "a", "b", 0.5);
        return evaluate_budget(of, 1);
    };
    constexpr double k_infinite = std::numeric_limits<double>::infinity();
    EXPECT_TRUE(tells(evaluated(9, 9), "GC-BUDGET-0010"));
    const BudgetResult different = evaluated(9, k_infinite);
    EXPECT_TRUE(tells(different, "GC-BUDGET-0012"));
    EXPECT_EQ(different.points[0].model->inputs()[0].degrees_of_freedom, 9.0);
    EXPECT_TRUE(evaluated(k_infinite, k_infinite).notes.empty());
}

TEST(BudgetModel, PointsShareTheStreamsOfWhatIsCommon) {
    Budget of = test::budget({"y = a + b"}, {input("a", state_uncertainty(0, 1)), input("b", state_uncertainty(0, 1))});
    of.points = {test::point(of, "1", {{"b", state_uncertainty(1, 1)}}),
                 test::point(of, "2", {{"b", state_uncertainty(2, 1)}})};
    const BudgetInputs first = budget_inputs(of, {}, 0);
    const BudgetInputs second = budget_inputs(of, {}, 1);
    EXPECT_EQ(first.streams[0], second.streams[0]);
    EXPECT_NE(first.streams[1], second.streams[1]);
    EXPECT_EQ(second.groups[1].value(0), 2.0);
}

/// Readings of some inputs that were taken together, with a linear combination of them.
struct JointReadings {
    std::vector<std::vector<double>> columns;
    std::vector<double> c;

    [[nodiscard]] Budget together(std::string model = "") const {
        std::vector<BudgetInput> inputs;
        std::string sum = "y = 0";
        for (std::size_t j = 0; j < columns.size(); ++j) {
            const std::string name(1, static_cast<char>('a' + j));
            inputs.push_back(input(name, state_observations(columns[j])));
            if (model.empty()) {
                sum += " + (" + test::digits(c[j]) + ")*" + name;
            }
        }
        Budget of = test::budget({model.empty() ? sum : std::move(model)}, std::move(inputs));
        test::take_together(of);
        return of;
    }
    /// The same as one input: the combination of each row.
    [[nodiscard]] Budget by_rows() const {
        std::vector<double> y(columns.front().size(), 0.0);
        for (std::size_t j = 0; j < c.size(); ++j) {
            for (std::size_t i = 0; i < y.size(); ++i) {
                y[i] += c[j] * columns[j][i];
            }
        }
        return test::budget({"y = y_rows"}, {input("y_rows", state_observations(y))});
    }
};

JointReadings joint_readings(std::mt19937& random) {
    JointReadings readings;
    const std::size_t n = 4 + random() % 5;  // with three readings there is no variance to agree on
    const std::size_t m = 2 + random() % 5;  // also more inputs than readings
    std::normal_distribution<double> normal;
    std::vector<double> shared(n);
    std::generate(shared.begin(), shared.end(), [&] { return normal(random); });
    for (std::size_t j = 0; j < m; ++j) {
        std::vector<double> column(n);
        const double weight = normal(random);
        std::transform(shared.begin(), shared.end(), column.begin(),
                       [&](double z) { return 10.0 + weight * z + normal(random); });
        readings.columns.push_back(std::move(column));
        readings.c.push_back(normal(random));
    }
    return readings;
}

TEST(BudgetModel, SimultaneousObservationsAreTheMeanOfTheirRows) {
    std::mt19937 random(20);
    for (int i = 0; i < 40; ++i) {
        const JointReadings readings = joint_readings(random);
        const BudgetResult together = evaluate_budget(drawn(readings.together()), 1);
        const BudgetOutputResult& y = together.points[0].outputs[0];
        const BudgetOutputResult rows = first_result(readings.by_rows());
        EXPECT_NEAR(*y.expanded_uncertainty / *rows.expanded_uncertainty, 1.0, 1e-9);
        EXPECT_NEAR(*y.coverage_factor, *rows.coverage_factor, 1e-12);
        EXPECT_FALSE(y.by_monte_carlo) << y.because;
        const double value = together.points[0].propagation.value(0);
        const MonteCarloOutput& trials = *y.monte_carlo;
        EXPECT_NEAR(trials.symmetric.high, value + *y.expanded_uncertainty,
                    4.5 * trials.numerical_error.symmetric.high);
        EXPECT_NEAR(trials.symmetric.low, value - *y.expanded_uncertainty, 4.5 * trials.numerical_error.symmetric.low);
    }
}

// Readings that happen to have r = 0 were taken together all the same.
TEST(BudgetModel, SimultaneousObservationsWithoutCorrelationAreOneEnsemble) {
    const JointReadings readings{.columns = {{1, 2, 2, 1}, {3, 3, 4, 4}, {0, 1, 0, 1}}, .c = {1, 1, 2}};
    const BudgetOutputResult y = first_result(drawn(readings.together()));
    EXPECT_NEAR(y.degrees_of_freedom, 3.0, 1e-12);
    EXPECT_FALSE(y.by_monte_carlo);
    EXPECT_NEAR(0.5 * (y.monte_carlo->symmetric.high - y.monte_carlo->symmetric.low), *y.expanded_uncertainty,
                4.5 * y.monte_carlo->numerical_error.symmetric.high);
}

// Whoever asks for trials gets those that are run without being asked for; more inputs than readings are no obstacle.
TEST(BudgetModel, SimultaneousObservationsAreDrawnAlikeWhoeverAsks) {
    const JointReadings readings{
        .columns = {{1, -2, 2.5, 0, 1}, {0.5, 1, -1, 2, 0}, {2, 0, -2.5, 1, 1}, {1, 1, 2, 0, 0}, {0, 1, 0, 2, 1}},
        .c = {}};
    const Budget of = readings.together("y = a*b*c + d*e");
    const MonteCarloOutput asked = *first_result(drawn(of, 1000000)).monte_carlo;
    for (const CoverageChoice choice : {CoverageChoice::as_validated, CoverageChoice::monte_carlo}) {
        Budget other = of;
        other.coverage = choice;
        const MonteCarloOutput unasked = *first_result(other).monte_carlo;
        EXPECT_NEAR(unasked.symmetric.high, asked.symmetric.high,
                    4.5 * std::hypot(unasked.numerical_error.symmetric.high, asked.numerical_error.symmetric.high));
        EXPECT_NEAR(unasked.symmetric.low, asked.symmetric.low,
                    4.5 * std::hypot(unasked.numerical_error.symmetric.low, asked.numerical_error.symmetric.low));
    }
}

}  // namespace
}  // namespace gumcert::gum
