#include "app/budget_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "app/evaluate_budget.h"
#include "gum/quantity/diagnostic.h"
#include "tests/unit/engine/job/budget_campaign.h"

namespace gumcert::app {
namespace {

using testing::HasSubstr;

engine::BudgetJob job(const std::string& inputs, const std::string& model, const std::string& more,
                      engine::test::BudgetFiles files = {}) {
    return engine::test::read_budget("\"model\": [\"y = " + model + "\"], \"inputs\": {" + inputs + "}" + more,
                                     std::move(files));
}

const std::string k_trials = R"(, "monte_carlo": {"trials": 200000})";

/// u of the law of propagation, which Monte Carlo must have too: the models are linear.
double checked_u(const engine::BudgetJob& job) {
    const BudgetOutputResult output = evaluate_budget(job, 1).points.at(0).outputs.at(0);
    EXPECT_NEAR(output.monte_carlo->standard_uncertainty / output.standard_uncertainty, 1.0, 0.008);
    return output.standard_uncertainty;
}

bool tells(const BudgetResult& result, const std::string& code) {
    return std::any_of(result.notes.begin(), result.notes.end(),
                       [&](const gum::Diagnostic& note) { return note.code == code; });
}

std::string samples_csv() {
    std::string csv = "a,b,c\n";
    for (int i = 0; i < 500; ++i) {
        const double x = std::sin(0.7 * i) + 0.5 * std::cos(1.3 * i * i);
        csv += std::to_string(x) + "," + std::to_string(x + 0.1 * std::sin(2.9 * i * i)) + "," +
               std::to_string(std::cos(5.1 * i)) + "\n";
    }
    return csv;
}

TEST(BudgetModel, DrawsSamplesOfOneFileByItsRows) {
    const std::string inputs = R"("a": {"samples": {"file": "s.csv", "column": "a"}}, "b": {"samples": "s.csv"})";
    const engine::BudgetJob joint = job(inputs, "a - b", k_trials, {{"s.csv", samples_csv()}});
    EXPECT_NEAR(checked_u(joint), 0.0707, 0.003);
    EXPECT_NEAR(joint.inputs[0].components[0].degrees_of_freedom, 499.0, 0.0);
    const BudgetResult result = evaluate_budget(joint, 1);
    EXPECT_TRUE(tells(result, "GC-BUDGET-0013"));
    // The interval, too, is that of the differences in the file.
    EXPECT_NEAR(*result.points[0].outputs[0].expanded_uncertainty,
                0.5 * (result.points[0].outputs[0].monte_carlo->symmetric.high -
                       result.points[0].outputs[0].monte_carlo->symmetric.low),
                0.003);
    const engine::BudgetJob apart = job(inputs, "a - b", "", {{"s.csv", samples_csv()}, {"t.csv", samples_csv()}});
    EXPECT_EQ(evaluate_budget(apart, 1).points[0].model->inputs().size(), 1U);
}

TEST(BudgetModel, RefusesCorrelationsBesideJointSamples) {
    const std::string inputs = R"("a": {"samples": "s.csv"}, "b": {"samples": "s.csv"}, "x": {"value": 1, "u": 1})";
    for (const char* pair : {R"(["a", "b", 0.9])", R"(["a", "x", 0.2])"}) {
        try {
            (void)evaluate_budget(
                job(inputs, "a + b + x", std::string(", \"correlations\": [") + pair + "]", {{"s.csv", samples_csv()}}),
                1);
            ADD_FAILURE() << pair;
        } catch (const gum::InputError& error) {
            EXPECT_EQ(error.diagnostics().front().code, "GC-BUDGET-0003");
        }
    }
}

TEST(BudgetModel, HasThePearsonCoefficientOfAnyPair) {
    const std::string uniform = R"("a": {"value": 0, "half_width": 1}, "b": {"value": 0, "half_width": 1})";
    EXPECT_NEAR(checked_u(job(uniform, "a + b", k_trials + R"(, "correlations": [["a", "b", -0.9]])")), 0.2582, 5e-5);
    const std::string mixed =
        R"("a": {"distribution": {"kind": "exponential", "mean": 1}}, "b": {"value": 0, "half_width": 1},
           "c": {"distribution": {"kind": "lognormal", "mu": 0, "sigma": 0.5}})";
    (void)checked_u(job(mixed, "a + 2*b - c",
                        k_trials + R"(, "correlations": [["a", "b", -0.5], ["b", "c", 0.4], ["a", "c", 0.2]])"));
    // Possible for normal quantities, but not for these: told.
    EXPECT_TRUE(tells(
        evaluate_budget(
            job(mixed, "a + 2*b - c", R"(, "correlations": [["a", "b", -0.7], ["b", "c", 0.4], ["a", "c", 0.2]])"), 1),
        "GC-BUDGET-0014"));
    try {
        (void)evaluate_budget(job(R"("a": {"distribution": {"kind": "exponential", "mean": 1}},
                                     "b": {"distribution": {"kind": "exponential", "mean": 1}})",
                                  "a + b", R"(, "correlations": [["a", "b", -1]])"),
                              1);
        ADD_FAILURE();
    } catch (const gum::InputError& error) {
        EXPECT_EQ(error.diagnostics().front().code, "GC-BUDGET-0002");
        EXPECT_THAT(error.diagnostics().front().rule, HasSubstr("-0.6449"));
    }
}

TEST(BudgetModel, KeepsTheShapeOfComponentsThatAreCorrelated) {
    const std::string inputs =
        R"("a": {"components": [{"name": "big", "value": 0, "half_width": 100}, {"name": "small", "value": 0, "u": 1}]},
           "b": {"components": [{"name": "one", "value": 0, "half_width": 2}, {"name": "two", "value": 0, "u": 1}]})";
    EXPECT_NEAR(checked_u(job(inputs, "a + b", k_trials + R"(, "correlations": [["a", "b", 0.8]])")),
                std::sqrt(1e4 / 3.0 + 1.0 + 7.0 / 3.0 + 1.6 * std::sqrt((1e4 / 3.0 + 1.0) * (7.0 / 3.0))), 1e-9);
    const BudgetResult result =
        evaluate_budget(job(inputs, "a + b", k_trials + R"(, "correlations": [["a", "b", 0.1]])"), 1);
    EXPECT_NEAR(result.points[0].outputs[0].monte_carlo->symmetric.high, 95.6, 0.6);
}

TEST(BudgetModel, TellsWhichDegreesOfFreedomCorrelatedInputsGet) {
    const auto notes = [](const std::string& nu_a, const std::string& nu_b) {
        return evaluate_budget(
            job(R"("a": {"value": 1, "u": 1, "nu": )" + nu_a + R"(}, "b": {"value": 1, "u": 1, "nu": )" + nu_b + "}",
                "a + b", R"(, "correlations": [["a", "b", 0.5]])"),
            1);
    };
    EXPECT_TRUE(tells(notes("9", "9"), "GC-BUDGET-0010"));
    const BudgetResult different = notes("9", "\"inf\"");
    EXPECT_TRUE(tells(different, "GC-BUDGET-0012"));
    EXPECT_EQ(different.points[0].model->inputs()[0].degrees_of_freedom, 9.0);
    EXPECT_TRUE(notes("\"inf\"", "\"inf\"").notes.empty());
}

/// Readings of some inputs that were taken together, with a linear combination of them.
struct JointReadings {
    std::vector<std::vector<double>> columns;
    std::vector<double> c;

    [[nodiscard]] std::string inputs() const {
        std::string text;
        for (std::size_t j = 0; j < columns.size(); ++j) {
            text += (j == 0 ? "" : ", ") + statement(std::string(1, static_cast<char>('a' + j)), columns[j]);
        }
        return text;
    }
    [[nodiscard]] std::string set() const {
        std::string names;
        for (std::size_t j = 0; j < columns.size(); ++j) {
            names += (j == 0 ? "\"" : ", \"") + std::string(1, static_cast<char>('a' + j)) + "\"";
        }
        return ", \"simultaneous\": [[" + names + "]]";
    }
    [[nodiscard]] std::string model() const {
        std::string sum;
        for (std::size_t j = 0; j < c.size(); ++j) {
            sum += (j == 0 ? "" : " + ") + std::string("(") + exact(c[j]) + ")*" + static_cast<char>('a' + j);
        }
        return sum;
    }
    /// The same as one input: the combination of each row.
    [[nodiscard]] std::string by_rows() const {
        std::vector<double> y(columns.front().size(), 0.0);
        for (std::size_t j = 0; j < c.size(); ++j) {
            for (std::size_t i = 0; i < y.size(); ++i) {
                y[i] += c[j] * columns[j][i];
            }
        }
        return statement("y_rows", y);
    }
    static std::string exact(double value) {
        std::ostringstream text;
        text.precision(17);
        text << value;
        return text.str();
    }
    static std::string statement(const std::string& name, const std::vector<double>& values) {
        std::string text;
        for (const double value : values) {
            text += (text.empty() ? "" : ", ") + exact(value);
        }
        return "\"" + name + R"(": {"observations": [)" + text + "]}";
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
        const BudgetResult together = evaluate_budget(
            job(readings.inputs(), readings.model(), readings.set() + R"(, "monte_carlo": {"trials": 200000})"), 1);
        const BudgetOutputResult& y = together.points[0].outputs[0];
        const BudgetOutputResult rows = evaluate_budget(job(readings.by_rows(), "y_rows", ""), 1).points[0].outputs[0];
        EXPECT_NEAR(*y.expanded_uncertainty / *rows.expanded_uncertainty, 1.0, 1e-9);
        EXPECT_NEAR(*y.coverage_factor, *rows.coverage_factor, 1e-12);
        EXPECT_FALSE(y.by_monte_carlo) << y.because;
        const double value = together.points[0].propagation.value(0);
        const gum::MonteCarloOutput& trials = *y.monte_carlo;
        EXPECT_NEAR(trials.symmetric.high, value + *y.expanded_uncertainty,
                    4.5 * trials.numerical_error.symmetric.high);
        EXPECT_NEAR(trials.symmetric.low, value - *y.expanded_uncertainty, 4.5 * trials.numerical_error.symmetric.low);
    }
}

// Readings that happen to have r = 0 were taken together all the same.
TEST(BudgetModel, SimultaneousObservationsWithoutCorrelationAreOneEnsemble) {
    const JointReadings readings{.columns = {{1, 2, 2, 1}, {3, 3, 4, 4}, {0, 1, 0, 1}}, .c = {1, 1, 2}};
    const BudgetOutputResult y =
        evaluate_budget(job(readings.inputs(), readings.model(), readings.set() + k_trials), 1).points[0].outputs[0];
    EXPECT_NEAR(y.degrees_of_freedom, 3.0, 1e-12);
    EXPECT_FALSE(y.by_monte_carlo);
    EXPECT_NEAR(0.5 * (y.monte_carlo->symmetric.high - y.monte_carlo->symmetric.low), *y.expanded_uncertainty,
                4.5 * y.monte_carlo->numerical_error.symmetric.high);
}

// Whoever asks for trials gets those that the program runs by itself; more inputs than readings are no obstacle.
TEST(BudgetModel, SimultaneousObservationsAreDrawnAlikeWhoeverAsks) {
    const JointReadings readings{
        .columns = {{1, -2, 2.5, 0, 1}, {0.5, 1, -1, 2, 0}, {2, 0, -2.5, 1, 1}, {1, 1, 2, 0, 0}, {0, 1, 0, 2, 1}},
        .c = {}};
    const auto trials = [&](const std::string& more) {
        const BudgetResult result = evaluate_budget(job(readings.inputs(), "a*b*c + d*e", readings.set() + more), 1);
        return *result.points[0].outputs[0].monte_carlo;
    };
    const gum::MonteCarloOutput asked = trials(R"(, "monte_carlo": {"trials": 1000000})");
    for (const char* more : {"", R"(, "coverage": "monte_carlo")"}) {
        const gum::MonteCarloOutput unasked = trials(more);
        EXPECT_NEAR(unasked.symmetric.high, asked.symmetric.high,
                    4.5 * std::hypot(unasked.numerical_error.symmetric.high, asked.numerical_error.symmetric.high));
        EXPECT_NEAR(unasked.symmetric.low, asked.symmetric.low,
                    4.5 * std::hypot(unasked.numerical_error.symmetric.low, asked.numerical_error.symmetric.low));
    }
}

}  // namespace
}  // namespace gumcert::app
