#include "reports/record/make/budget/budget_readings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <string>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/budget_model.h"
#include "gum/budget/evaluate_budget.h"
#include "reports/record/make/budget/budget_record.h"
#include "tests/support/budget_campaign.h"

namespace gumcert::reports {
namespace {

using reports::EvaluationRecord;

EvaluationRecord record_of(const jobs::BudgetJob& job) {
    const gum::BudgetResult result = gum::evaluate_budget(job, 1);
    return budget_record(job, result, {}, gum::budget_covariance(result), "");
}

TEST(BudgetReadings, AreThoseOfThePoints) {
    const EvaluationRecord record = record_of(jobs::test::read_budget(
        R"("model": ["y = x"], "inputs": {"x": {"observations": [100, 200], "unit": "V"}},
           "points": [{"point": "A", "x": {"observations": [1.1, 1.2, 1.3]}},
                      {"point": "B", "x": {"observations": [2.1, 2.2, 2.4]}}])"));
    ASSERT_EQ(record.readings.size(), 2U);
    EXPECT_EQ(record.readings[0].point, "A");
    EXPECT_DOUBLE_EQ(record.readings[0].mean.number, 1.2);
    EXPECT_EQ(record.readings[1].point, "B");
    EXPECT_EQ(record.readings[1].n, 3);
}

TEST(BudgetReadings, OfTheJobHoldAtTheOtherPoints) {
    const EvaluationRecord record = record_of(jobs::test::read_budget(
        R"("model": ["y = x"], "inputs": {"x": {"observations": [100, 200], "unit": "V"}},
           "points": [{"point": "A", "x": {"observations": [1.1, 1.2, 1.3]}}, {"point": "B"}])"));
    ASSERT_EQ(record.readings.size(), 2U);
    EXPECT_EQ(record.readings[0].point, "");
    EXPECT_DOUBLE_EQ(record.readings[0].mean.number, 150.0);
    EXPECT_EQ(record.readings[1].point, "A");
    EXPECT_EQ(record.readings[1].observations, (std::vector<std::string>{"1.1", "1.2", "1.3"}));
}

TEST(BudgetReadings, PrintTheResolutionWithWhichTheyWereWritten) {
    const std::string keys =
        R"("model": ["y = x + d"], "inputs": {"x": {"unit": "V", "components": [{"name": "a", "observations": [10.10, 10.12, 9.9]},
                                                                            {"name": "b", "half_width": 0.1, "value": 0}]},
                                              "d": {"unit": "V", "value": 0, "u": 0.1}})";
    EXPECT_EQ(record_of(jobs::test::read_budget(keys)).readings.at(0).observations,
              (std::vector<std::string>{"10.10", "10.12", "9.90"}));
    // A table knows that all of them had two decimals; each point has its own.
    const EvaluationRecord record = record_of(jobs::test::read_budget(
        R"("model": ["y = x"], "inputs": {"x": {"unit": "V"}}, "points": {"file": "points.csv"})",
        {{"points.csv", "point,x.1,x.2\nA,10.10,10.20\nB,100.0,101.0\n"}}));
    ASSERT_EQ(record.readings.size(), 2U);
    EXPECT_EQ(record.readings[0].observations, (std::vector<std::string>{"10.10", "10.20"}));
    EXPECT_EQ(record.readings[1].observations, (std::vector<std::string>{"100.0", "101.0"}));
}

TEST(BudgetReadings, OutliersAreFoundInPointsGroupsAndMeans) {
    const EvaluationRecord record = record_of(jobs::test::read_budget(
        R"("model": ["y = x + g"], "inputs": {"x": {"unit": "mV"}, "g": {"unit": "mV",
             "groups": [[1.01, 1.02, 1.00, 7.5, 1.01], [1.00, 1.02, 1.01], [1.00, 1.01]]}},
           "points": [{"point": "A", "x": {"observations": [5.00, 5.01, 4.99, 5.00, 49.99, 5.01]}},
                      {"point": "B", "x": {"observations": [5.00, 5.01, 4.99, 5.00, 5.02, 5.01]}}])"));
    ASSERT_EQ(record.outliers.size(), 3U);
    EXPECT_EQ(record.outliers[0].point, "A");
    EXPECT_EQ(record.outliers[0].of, "observations");
    EXPECT_EQ(record.outliers[0].position, 5);
    EXPECT_EQ(record.outliers[0].value.text, "49.99");
    EXPECT_EQ(record.outliers[1].of, "group");
    EXPECT_EQ(record.outliers[1].group, 1);
    EXPECT_EQ(record.outliers[1].position, 4);
    EXPECT_EQ(record.outliers[2].of, "group_means");  // of the mean that it spoils
    EXPECT_EQ(record.outliers[2].position, 1);
}

/// Over generated jobs: every readings table of a record is the statement in force at its point, and every statement of
/// readings in force is in the record.
TEST(BudgetReadings, EveryPrintedNumberIsOfAStatementInForce) {
    std::mt19937_64 random(3);
    const auto chance = [&](double p) { return std::uniform_real_distribution<double>()(random) < p; };
    const auto readings = [&] {
        const std::size_t n = 2 + random() % 5;
        std::string list;
        for (std::size_t i = 0; i < n; ++i) {
            list += (i == 0 ? "" : ", ") +
                    std::to_string(static_cast<double>(random() % 100000) / 1000.0 + 1e-3 * static_cast<double>(i));
        }
        return list;
    };
    for (int trial = 0; trial < 150; ++trial) {
        const std::size_t inputs = 1 + random() % 3;
        const std::size_t points = 1 + random() % 4;
        std::vector<bool> has_base(inputs);
        std::vector<bool> grouped(inputs);
        const auto statement = [&](std::size_t i) {
            return grouped[i] ? "\"groups\": [[" + readings() + "], [" + readings() + "]]"
                              : "\"observations\": [" + readings() + "]";
        };
        std::string model;
        std::string stated;
        for (std::size_t i = 0; i < inputs; ++i) {
            const std::string name = "x" + std::to_string(i);
            has_base[i] = chance(0.6);
            grouped[i] = chance(0.3);
            model += (i == 0 ? "" : " + ") + name;
            stated += (i == 0 ? "" : ", ") + ("\"" + name + "\": {\"unit\": \"mV\"") +
                      (has_base[i] ? ", " + statement(i) : "") + "}";
        }
        std::string table;
        for (std::size_t p = 0; p < points; ++p) {
            std::string own;
            for (std::size_t i = 0; i < inputs; ++i) {
                if (!has_base[i] || chance(0.5)) {
                    own += ", \"x" + std::to_string(i) + "\": {" + statement(i) + "}";
                }
            }
            table += (p == 0 ? "" : ", ") + ("{\"point\": \"P" + std::to_string(p)) + "\"" + own + "}";
        }
        const std::string text =
            "\"model\": [\"y = " + model + "\"], \"inputs\": {" + stated + "}, \"points\": [" + table + "]";
        SCOPED_TRACE(text);
        const jobs::BudgetJob job = jobs::test::read_budget(text);
        const EvaluationRecord record = record_of(job);

        const auto mean_of = [&](const std::string& input, const std::string& point) -> std::optional<double> {
            for (const auto& r : record.readings) {
                if (r.input == input && r.point == point) {
                    return r.mean.number;
                }
            }
            for (const auto& v : record.variance_analyses) {
                if (v.input == input && v.point == point) {
                    return v.mean.number;
                }
            }
            return std::nullopt;
        };
        std::size_t expected = 0;
        for (std::size_t i = 0; i < inputs; ++i) {
            bool base_in_force = false;
            for (std::size_t p = 0; p < points; ++p) {
                const gum::BudgetInput& at = gum::input_at(job, i, p);
                const bool own = &at != &job.inputs[i];
                base_in_force = base_in_force || !own;
                const std::optional<double> mean = mean_of(at.name, own ? job.points[p].name : "");
                ASSERT_TRUE(mean) << at.name << " at " << job.points[p].name;
                EXPECT_NEAR(*mean, at.components[0].stated_value, 1e-9);
                expected += own ? 1 : 0;
            }
            expected += base_in_force ? 1 : 0;
        }
        EXPECT_EQ(record.readings.size() + record.variance_analyses.size(), expected);
        // Every row of every budget is an input in force there.
        for (std::size_t p = 0; p < points; ++p) {
            for (std::size_t i = 0; i < inputs; ++i) {
                const reports::BudgetRow& row = record.results.at(p).budget.at(i);
                EXPECT_EQ(row.input, job.inputs[i].name);
                EXPECT_NEAR(*row.value.number, gum::input_at(job, i, p).components[0].stated_value, 1e-9);
            }
        }
    }
}

}  // namespace
}  // namespace gumcert::reports
