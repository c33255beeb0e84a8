#include "jobs/budget/budget_job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <set>

#include "jobs/input_codes.h"
#include "jobs/laboratory/laboratory_use.h"
#include "tests/support/budget_campaign.h"
#include "tests/support/campaign.h"

namespace gumcert::jobs {
namespace {

using gum::DistributionKind;
using test::read_budget;
using test::read_one_input;
using testing::ElementsAre;
using testing::HasSubstr;

constexpr double k_infinity = std::numeric_limits<double>::infinity();

/// A statement in a unit and what it must come to, coherent SI.
struct StatementCase {
    std::string statement;
    std::string row;
    double value, u, nu;
    DistributionKind kind;
    double scale, shape;
    gum::Evaluation evaluation = gum::Evaluation::type_b;
};

std::string repeated(const std::string& text, int times) {
    std::string all = text;
    for (int i = 1; i < times; ++i) {
        all += ", " + text;
    }
    return all;
}

// Expected numbers by hand from the formulas of JCGM 100 and JCGM 101; t quantiles from table G.2 of JCGM 100.
TEST(BudgetJob, EvaluatesEveryStatement) {
    const double s3 = std::sqrt(3.0);
    const double s_obs = std::sqrt(0.02 / 3.0);  // of 9.9, 10.0, 10.1, 10.0
    const std::vector<StatementCase> cases{
        {R"j({"value": 215, "unit": "nm", "u": 5.8, "nu": 24})j", "u", 215e-9, 5.8e-9, 24, DistributionKind::student_t,
         5.8e-9, 24},
        {R"j({"value": 215, "unit": "nm", "u": 5.8})j", "u", 215e-9, 5.8e-9, k_infinity, DistributionKind::normal,
         5.8e-9, 0},
        {R"j({"value": 1, "unit": "m", "u": 0.1, "nu": "inf", "distribution": "normal"})j", "u", 1, 0.1, k_infinity,
         DistributionKind::normal, 0.1, 0},
        {R"j({"value": 1000.000325, "unit": "g", "U": 240e-6, "k": 3})j", "U, k", 1.000000325, 80e-9, k_infinity,
         DistributionKind::normal, 80e-9, 0},
        {R"j({"value": 10, "U": 129e-6, "p": 0.99})j", "U, p", 10, 129e-6 / 2.5758293035489004, k_infinity,
         DistributionKind::normal, 129e-6 / 2.5758293035489004, 0},
        {R"j({"value": 10, "U": 2.7764451051977934, "p": 0.95, "nu": 4})j", "U, p", 10, 1, 4,
         DistributionKind::student_t, 1, 4},
        {R"j({"value": 20, "unit": "degC", "half_width": 0.5})j", "half_width", 20, 0.5 / s3, k_infinity,
         DistributionKind::uniform, 0.5, 0},
        {R"j({"value": 0, "unit": "1/K", "half_width": 1e-6, "distribution": "rectangular", "nu": 50})j", "half_width",
         0, 1e-6 / s3, 50, DistributionKind::curvilinear_trapezoid, 1e-6, 0.1},
        {R"j({"limits": [-1, 1], "reliability": 0.5})j", "limits", 0, 1 / s3, 2,
         DistributionKind::curvilinear_trapezoid, 1, 0.5},
        {R"j({"value": 20, "specification": {"floor": 0.3}, "nu": 0.5})j", "specification", 20, 0.3 / s3, 0.5,
         DistributionKind::curvilinear_trapezoid, 0.3, 1},
        {R"j({"value": 0, "half_width": 6, "distribution": "triangular"})j", "half_width", 0, std::sqrt(6.0),
         k_infinity, DistributionKind::triangular, 6, 0},
        {R"j({"value": 0, "half_width": 6, "distribution": "u_shaped"})j", "half_width", 0, 6 / std::sqrt(2.0),
         k_infinity, DistributionKind::arcsine, 6, 0},
        {R"j({"value": 0, "half_width": 6, "distribution": "trapezoidal", "beta": 0.5})j", "half_width", 0,
         6 * std::sqrt(1.25 / 6), k_infinity, DistributionKind::trapezoidal, 6, 0.5},
        {R"j({"value": 0, "half_width": 6, "distribution": "curvilinear_trapezoid", "d": 3})j", "half_width", 0,
         std::sqrt(36.0 / 3 + 9.0 / 9), k_infinity, DistributionKind::curvilinear_trapezoid, 6, 0.5},
        {R"j({"limits": [9, 15], "unit": "mm", "distribution": "arcsine"})j", "limits", 0.012, 0.003 / std::sqrt(2.0),
         k_infinity, DistributionKind::arcsine, 0.003, 0},
        {R"j({"value": 12.3, "resolution": 0.1})j", "resolution", 12.3, 0.1 / std::sqrt(12.0), k_infinity,
         DistributionKind::uniform, 0.05, 0},
        {R"j({"value": 1, "mpe": 0.3})j", "mpe", 1, 0.3 / s3, k_infinity, DistributionKind::uniform, 0.3, 0},
        {R"j({"unit": "V", "observations": [9.9, 10.0, 10.1, 10.0]})j", "observations", 10, s_obs / 2, 3,
         DistributionKind::student_t, s_obs / 2, 3, gum::Evaluation::type_a},
        {R"j({"observations": [7], "pooled": {"s": 0.4, "nu": 19}})j", "observations", 7, 0.4, 19,
         DistributionKind::student_t, 0.4, 19, gum::Evaluation::type_a},
        {R"j({"observations": [1, 2, 3, 2], "pooled": {"s": 0.4, "nu": "inf"}})j", "observations", 2, 0.2, k_infinity,
         DistributionKind::normal, 0.2, 0, gum::Evaluation::type_a},
        // Means 2, 4 and 6: s = 2.
        {R"j({"groups": [[1, 3], [3, 5], [5, 7]]})j", "groups", 4, 2 / s3, 2, DistributionKind::student_t, 2 / s3, 2,
         gum::Evaluation::type_a},
        {R"j({"groups": {"means": [2, 4, 6], "standard_deviations": [1, 1, 1], "sizes": [5, 5, 5]}})j", "groups", 4,
         2 / s3, 2, DistributionKind::student_t, 2 / s3, 2, gum::Evaluation::type_a},
        {R"j({"samples": [)j" + repeated("3, 1, 2, 2", 25) + R"j(], "unit": "um"})j", "samples", 2e-6,
         std::sqrt(0.5) * 1e-6, 99, DistributionKind::empirical, 1, 0},
        {R"j({"value": -50, "relative_u": 0.01, "unit": "mm"})j", "relative_u", -0.05, 5e-4, k_infinity,
         DistributionKind::normal, 5e-4, 0},
        {R"j({"value": 50, "relative_U": 0.01, "k": 2})j", "relative_U, k", 50, 0.25, k_infinity,
         DistributionKind::normal, 0.25, 0},
        // 0.1 % of 20 V, 0.05 % of 100 V and 10 mV: 0.08 V.
        {R"j({"value": 20, "unit": "V", "specification":
            {"percent_of_reading": 0.1, "percent_of_range": 0.05, "range": 100, "floor": 0.01}})j",
         "specification", 20, 0.08 / s3, k_infinity, DistributionKind::uniform, 0.08, 0},
        {R"j({"value": 20, "unit": "mV", "specification": {"floor": 0.3, "k": 3}, "reliability": 0.25})j",
         "specification", 0.02, 1e-4, 8, DistributionKind::student_t, 1e-4, 8},
        {R"j({"value": 3.2, "constant": true})j", "constant", 3.2, 0, k_infinity, DistributionKind::constant, 0, 0},
        {R"j({"value": 3.2, "u": 0, "constant": true})j", "constant", 3.2, 0, k_infinity, DistributionKind::constant, 0,
         0},
        {R"j({"distribution": {"kind": "normal", "mean": 20, "sd": 0.1}, "unit": "degC"})j", "distribution", 20, 0.1,
         k_infinity, DistributionKind::normal, 0.1, 0},
        {R"j({"distribution": {"kind": "uniform", "lower": 1, "upper": 3}})j", "distribution", 2, 1 / s3, k_infinity,
         DistributionKind::uniform, 1, 0},
        {R"j({"distribution": {"kind": "triangular", "lower": 1, "upper": 3}})j", "distribution", 2, 1 / std::sqrt(6.0),
         k_infinity, DistributionKind::triangular, 1, 0},
        {R"j({"distribution": {"kind": "trapezoidal", "lower": 1, "upper": 3, "beta": 1}})j", "distribution", 2, 1 / s3,
         k_infinity, DistributionKind::trapezoidal, 1, 1},
        {R"j({"distribution": {"kind": "curvilinear_trapezoid", "lower": -3, "upper": 3, "d": 3}})j", "distribution", 0,
         2, k_infinity, DistributionKind::curvilinear_trapezoid, 3, 1},
        // The law of propagation takes the scale, as for a Type A evaluation.
        {R"j({"distribution": {"kind": "t", "location": 5, "scale": 0.5, "nu": 4}})j", "distribution", 5, 0.5, 4,
         DistributionKind::student_t, 0.5, 4},
        {R"j({"distribution": {"kind": "gamma", "shape": 4, "scale": 0.5}})j", "distribution", 2, 1, k_infinity,
         DistributionKind::gamma, 0.5, 4},
        {R"j({"distribution": {"kind": "exponential", "mean": 3}})j", "distribution", 3, 3, k_infinity,
         DistributionKind::exponential, 3, 0},
        {R"j({"distribution": {"kind": "lognormal", "mu": 0, "sigma": 0.5}, "unit": "km"})j", "distribution",
         1000 * std::exp(0.125), 1000 * std::sqrt(std::exp(0.5) - std::exp(0.25)), k_infinity,
         DistributionKind::lognormal, 1000, 0.5},
        {R"j({"distribution": {"kind": "beta", "alpha": 1, "beta": 1, "lower": 2, "upper": 6}})j", "distribution", 4,
         2 / s3, k_infinity, DistributionKind::beta, 4, 1},
        {R"j({"distribution": {"kind": "poisson_counts", "counts": 8}})j", "distribution", 9, 3, k_infinity,
         DistributionKind::gamma, 1, 9},
    };
    for (const StatementCase& expected : cases) {
        SCOPED_TRACE(expected.statement);
        const gum::BudgetInput input = read_one_input(expected.statement);
        ASSERT_EQ(input.components.size(), 1U);
        const gum::StatedQuantity& q = input.components.front();
        EXPECT_EQ(q.statement, expected.row);
        const double close = 1e-14;
        EXPECT_NEAR(q.value, expected.value, close * std::max(std::abs(expected.value), expected.u));
        EXPECT_NEAR(q.u, expected.u, close * expected.u);
        EXPECT_EQ(q.degrees_of_freedom, expected.nu);
        EXPECT_EQ(q.distribution.kind, expected.kind);
        EXPECT_NEAR(q.distribution.scale, expected.scale, close * expected.scale);
        EXPECT_NEAR(q.distribution.shape, expected.shape, close);
        EXPECT_EQ(q.evaluation, expected.evaluation);
        EXPECT_EQ(input.constant, expected.row == "constant");
        EXPECT_NEAR(gum::expectation(q.distribution), expected.value,
                    close * std::max(std::abs(expected.value), expected.u));
    }
}

TEST(BudgetJob, RemembersWithHowManyDecimalsReadingsAreWritten) {
    const auto decimals = [](const std::string& input) {
        return read_one_input(input).components.front().observation_decimals;
    };
    EXPECT_EQ(decimals(R"j({"observations": [10.10, 10.20, 10.10]})j"), 2) << "each ends in 0";
    EXPECT_EQ(decimals(R"j({"observations": [10.0, 11, 10.5]})j"), 1);
    EXPECT_EQ(decimals(R"j({"observations": [7, 8, 8]})j"), 0);
}

TEST(BudgetJob, ConvertsTemperaturesAsScalesAndTheirUncertaintiesAsDifferences) {
    const gum::StatedQuantity q =
        read_one_input(R"j({"unit": "degF", "observations": [50, 68, 59]})j").components.front();
    EXPECT_NEAR(q.value, 15.0, 1e-12);  // 59 °F
    EXPECT_NEAR(q.u, 5.0 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(q.observations.at(1), 20.0, 1e-12);
    EXPECT_DOUBLE_EQ(q.stated_value, 59.0);
    const gum::BudgetInput sum = read_one_input(R"j({"unit": "degF", "components": [
        {"name": "reading", "value": 68, "u": 0.9}, {"name": "correction", "value": 1.8, "half_width": 1.8}]})j");
    EXPECT_NEAR(sum.components[0].value + sum.components[1].value, 21.0, 1e-12);
    EXPECT_NEAR(sum.components[0].u, 0.5, 1e-15);
    EXPECT_NEAR(sum.components[1].distribution.scale, 1.0, 1e-15);
}

/// A percentage of a reading is one of what its scale shows, whether the reading states it or a correction beside it.
TEST(BudgetJob, TakesAPercentageOfWhatAScaleShows) {
    for (const char* const reading : {R"j("value": 68, "unit": "degF")j", R"j("value": -40.1, "unit": "degF")j",
                                      R"j("value": 20, "unit": "degC")j", R"j("value": 293, "unit": "K")j"}) {
        const std::string percent = R"j("specification": {"percent_of_reading": 0.5)j";
        const double own = read_one_input("{" + std::string(reading) + ", " + percent + "}}").components.front().u;
        for (const char* const unit : {"K", "mK", "delta_degF"}) {
            const BudgetJob job = read_budget(R"j("inputs": {"t": {)j" + std::string(reading) +
                                              R"j(, "constant": true}, "e": {"value": 0, "unit": ")j" + unit +
                                              R"j(", )j" + percent + R"j(, "of": "t"}}}, "model": "y = t + e")j");
            EXPECT_NEAR(job.inputs.at(1).components.front().u, own, 1e-14 * own) << reading << " " << unit;
        }
    }
}

TEST(BudgetJob, ReadsTheExampleOfTheContract) {
    const BudgetJob job = read_budget(R"j("title": "End gauge",
  "model": ["l = l_s + d - l_s*(d_alpha*theta + alpha_s*d_theta)"],
  "inputs": {
    "l_s": {"value": 50000623, "unit": "nm", "u": 25, "nu": 18},
    "d":   {"unit": "nm", "components": [
              {"name": "repeatability", "value": 215, "u": 5.8, "nu": 24, "type": "A"},
              {"name": "comparator, random", "value": 0, "u": 3.9, "nu": 5},
              {"name": "comparator, systematic", "value": 0, "u": 6.7, "nu": 8} ]},
    "d_alpha": {"value": 0, "unit": "1/K", "half_width": 1e-6, "distribution": "uniform", "nu": 50},
    "theta": {"value": -0.1, "unit": "K", "u": 0.41}, "alpha_s": {"value": 11.5e-6, "unit": "1/K", "half_width": 2e-6},
    "d_theta": {"value": 0, "unit": "K", "half_width": 0.05, "reliability": 0.5} },
  "correlations": [["l_s", "d", 0.0]],
  "outputs": {"l": {"unit": "nm", "coverage_probability": 0.99}},
  "monte_carlo": {"trials": 1000000, "seed": 1})j");
    EXPECT_EQ(job.title, "End gauge");
    EXPECT_EQ(test::texts(job.warnings), "");
    ASSERT_EQ(job.inputs.size(), 6U);
    EXPECT_EQ(job.inputs[0].name, "l_s");  // the order of the file
    EXPECT_EQ(job.inputs[5].name, "d_theta");
    EXPECT_DOUBLE_EQ(job.inputs[0].components[0].value, 0.050000623);
    ASSERT_EQ(job.inputs[1].components.size(), 3U);
    EXPECT_EQ(job.inputs[1].components[0].name, "repeatability");
    EXPECT_EQ(job.inputs[1].components[0].evaluation, gum::Evaluation::type_a);
    EXPECT_EQ(job.inputs[1].components[0].stated_value, 215.0);
    EXPECT_DOUBLE_EQ(job.inputs[1].components[2].u, 6.7e-9);
    EXPECT_EQ(job.inputs[2].components[0].degrees_of_freedom, 50.0);
    EXPECT_EQ(job.inputs[5].components[0].degrees_of_freedom, 2.0);
    EXPECT_TRUE(job.correlations.empty());
    ASSERT_EQ(job.outputs.size(), 1U);
    EXPECT_EQ(job.outputs[0].coverage_probability, 0.99);
    ASSERT_TRUE(job.monte_carlo);
    EXPECT_EQ(job.monte_carlo->trials, 1'000'000U);
    EXPECT_EQ(job.monte_carlo->seed, 1U);
    EXPECT_THAT(job.files, ElementsAre("job.json"));
    EXPECT_EQ(job.document.at("kind"), "budget");
    EXPECT_EQ(gum::model_inputs(job).size(), 6U);
    EXPECT_EQ(gum::model_outputs(job).front().name, "l");
}

TEST(BudgetJob, TakesCorrelationsFromEveryStatement) {
    // GUM H.2: means of five simultaneous observations, r = -0.36, 0.86 and -0.65.
    const BudgetJob job = read_budget(R"j("inputs": {
        "V": {"unit": "V", "observations": [5.007, 4.994, 5.005, 4.990, 4.999]},
        "I": {"unit": "mA", "observations": [19.663, 19.639, 19.640, 19.685, 19.678]},
        "phi": {"unit": "rad", "observations": [1.0456, 1.0438, 1.0468, 1.0428, 1.0433]},
        "a": {"value": 1, "unit": "mm"}, "b": {"value": 2, "unit": "mm", "u": 0.4},
        "c": {"value": 1, "u": 0.1}, "e": {"value": 1, "u": 0.1}},
        "simultaneous": [["V", "I", "phi"]],
        "covariance": {"inputs": ["a", "b"], "matrix": [[0.09, -0.06], [-0.06, 0.16]]},
        "correlations": [["e", "c", 1], ["a", "c", 0]])j");
    ASSERT_EQ(job.correlations.size(), 5U);
    EXPECT_NEAR(job.correlations[0].r, -0.36, 0.005);
    EXPECT_NEAR(job.correlations[1].r, 0.86, 0.005);
    EXPECT_NEAR(job.correlations[2].r, -0.65, 0.005);
    EXPECT_EQ(job.correlations[3].first, 3U);
    EXPECT_NEAR(job.correlations[3].r, -0.5, 1e-15);
    EXPECT_EQ(job.correlations[4].r, 1.0);
    EXPECT_NEAR(job.inputs[3].components[0].u, 0.3e-3, 1e-18);
    EXPECT_EQ(job.inputs[3].components[0].statement, "covariance");
    ASSERT_EQ(job.simultaneous.size(), 1U);
    EXPECT_EQ(job.simultaneous[0].observations, 5U);
    EXPECT_THAT(job.simultaneous[0].inputs, ElementsAre(0, 1, 2));
}

TEST(BudgetJob, ReadsPointsFromTheJob) {
    const BudgetJob job = read_budget(R"j("model": "e = x + s - r", "inputs": {
        "x": {"value": 0, "unit": "mm", "resolution": 0.01}, "r": {"value": 1, "unit": "mm", "relative_u": 0.001},
        "s": {"unit": "mm", "specification": {"percent_of_reading": 0.1, "floor": 0.001, "of": "x"}},
        "c": {"value": 1, "unit": "mm", "u": 1, "between_points": "common"}},
        "points": [{"x": 10, "r": 9.99, "point": "low"}, {"x": 100, "r": {"value": 99.9, "relative_u": 0.01}, "c": 3}])j");
    ASSERT_EQ(job.points.size(), 2U);
    EXPECT_EQ(job.points[0].name, "low");
    EXPECT_EQ(job.points[1].name, "2");
    ASSERT_EQ(job.points[0].inputs.size(), 3U);
    const auto& [x, x_input] = job.points[0].inputs[0];
    EXPECT_EQ(x, 0U);
    EXPECT_FALSE(x_input.common);
    EXPECT_DOUBLE_EQ(x_input.components[0].value, 0.01);
    EXPECT_DOUBLE_EQ(x_input.components[0].u, 0.01e-3 / std::sqrt(12.0));
    EXPECT_DOUBLE_EQ(job.points[0].inputs[1].second.components[0].u, 9.99e-6);
    // A specification of what was read is evaluated again and stays common.
    const auto& [s, s_input] = job.points[1].inputs[2];
    EXPECT_EQ(s, 2U);
    EXPECT_TRUE(s_input.common);
    EXPECT_DOUBLE_EQ(s_input.components[0].distribution.scale, 0.101e-3);
    EXPECT_DOUBLE_EQ(job.points[1].inputs[1].second.components[0].u, 0.999e-3);
    EXPECT_TRUE(job.points[1].inputs[3].second.common);
}

TEST(BudgetJob, ReadsPointsFromATable) {
    const BudgetJob job = read_budget(R"j("inputs": {"x": {"value": 1, "unit": "mm", "u": 0.1},
        "k": {"value": 2, "constant": true}}, "points": {"file": "points.csv"})j",
                                      {{"points.csv", "point,x,x.u,k\nA,5,0.2,2\nB,6,0.1,3\n"}});
    ASSERT_EQ(job.points.size(), 2U);
    EXPECT_EQ(job.points[1].name, "B");
    ASSERT_EQ(job.points[0].inputs.size(), 2U);
    EXPECT_DOUBLE_EQ(job.points[0].inputs[0].second.components[0].value, 0.005);
    EXPECT_DOUBLE_EQ(job.points[0].inputs[0].second.components[0].u, 2e-4);
    EXPECT_DOUBLE_EQ(job.points[1].inputs[0].second.components[0].u, 1e-4);
    EXPECT_EQ(job.points[1].inputs[1].second.components[0].value, 3.0);
    EXPECT_THAT(job.files, ElementsAre("job.json", "points.csv"));
    // A constant that a point changes cannot be an exponent of the model.
    EXPECT_FALSE(gum::model_inputs(job)[1].constant);
}

/// A law: what numbers state in the job, columns state at the points, with the same value, u and degrees of freedom.
TEST(BudgetJob, TakesEveryStatementOfNumbersFromColumns) {
    const std::vector<std::vector<std::pair<std::string, std::string>>> statements{
        {{"value", "5"}, {"u", "0.2"}},
        {{"value", "5"}, {"u", "0.2"}, {"nu", "7"}},
        {{"value", "5"}, {"U", "0.2"}, {"k", "2"}},
        {{"value", "5"}, {"U", "0.2"}, {"p", "0.95"}, {"nu", "7"}},
        {{"value", "5"}, {"half_width", "0.2"}, {"reliability", "0.25"}},
        {{"value", "5"}, {"resolution", "0.2"}},
        {{"value", "5"}, {"mpe", "0.2"}},
        {{"value", "5"}, {"relative_u", "0.002"}},
        {{"value", "5"}, {"relative_U", "0.002"}, {"k", "2"}},
        {{"value", "-5"}, {"relative_U", "0.002"}, {"p", "0.95"}}};
    for (const auto& statement : statements) {
        std::string object, header, row;
        for (const auto& [key, number] : statement) {
            object += (object.empty() ? "" : ", ") + ('"' + key + "\": ") + number;
            header += (header.empty() ? "x" : ",x") + (key == "value" ? "" : "." + key);
            row += (row.empty() ? "" : ",") + number;
        }
        SCOPED_TRACE(header);
        const BudgetJob in_job = read_budget(R"j("inputs": {"x": {"unit": "mm", )j" + object + "}}");
        const BudgetJob in_file = read_budget(R"j("inputs": {"x": {"unit": "mm"}}, "points": {"file": "p.csv"})j",
                                              {{"p.csv", header + "\n" + row + "\n"}});
        const gum::StatedQuantity& stated = in_job.inputs.at(0).components.at(0);
        const gum::StatedQuantity& read = in_file.points.at(0).inputs.at(0).second.components.at(0);
        EXPECT_EQ(read.value, stated.value);
        EXPECT_EQ(read.u, stated.u);
        EXPECT_EQ(read.degrees_of_freedom, stated.degrees_of_freedom);
    }
}

/// "k": 0.95 is a coverage probability, and "U": 2, "k": 0.01 are exchanged: told in a job and in a table, once for a column.
TEST(BudgetJob, TellsCoverageFactorsBelowOne) {
    const auto told = [](const BudgetJob& job) {
        return std::count_if(job.warnings.begin(), job.warnings.end(), [](const gum::Diagnostic& one) {
            return one.code == k_warn_unusual_coverage_factor.code;
        });
    };
    for (const auto& [statement, expected] :
         std::vector<std::pair<std::string, int>>{{R"j("U": 0.01, "k": 0.95)j", 1},
                                                  {R"j("U": 2, "k": 0.01)j", 1},
                                                  {R"j("relative_U": 0.01, "k": 0.5)j", 1},
                                                  {R"j("U": 0.01, "k": 1)j", 0},
                                                  {R"j("U": 0.01, "k": 2)j", 0},
                                                  {R"j("U": 0.01, "p": 0.95)j", 0},
                                                  {R"j("U": 0.01, "p": 0.5)j", 0},
                                                  {R"j("specification": {"floor": 0.1, "k": 0.5})j", 1},
                                                  {R"j("specification": {"floor": 0.1, "k": 95})j", 1},
                                                  {R"j("specification": {"floor": 0.1, "k": 2})j", 0},
                                                  {R"j("specification": {"floor": 0.1, "p": 0.5})j", 0}}) {
        EXPECT_EQ(told(read_budget(R"j("inputs": {"x": {"value": 1, )j" + statement + "}}")), expected) << statement;
    }
    EXPECT_EQ(told(read_budget(R"j("inputs": {"x": {"unit": "V"}}, "points": {"file": "p.csv"})j",
                               {{"p.csv", "x,x.U,x.k\n1,0.1,0.95\n2,0.1,0.95\n3,0.1,2\n"}})),
              1);
}

TEST(BudgetJob, LeavesInputsToThePoints) {
    // No statement, half of one, readings, and a specification that waits for a value.
    const BudgetJob job = read_budget(R"j("model": "e = x - r + s + m", "inputs": {
        "x": {"unit": "mm"}, "r": {"unit": "mm", "resolution": 0.1}, "m": {"unit": "mm", "description": "readings"},
        "s": {"unit": "mm", "specification": {"percent_of_reading": 0.1, "floor": 0.001, "of": "r"}}},
        "points": [{"x": {"value": 1, "u": 0.1}, "r": 10, "m": {"observations": [1, 2, 3]}},
                   {"x": {"value": 2, "half_width": 3}, "r": 100, "m": {"groups": [[1, 2], [3, 5]]}}])j");
    ASSERT_EQ(job.points.size(), 2U);
    ASSERT_EQ(job.points[0].inputs.size(), 4U);
    EXPECT_DOUBLE_EQ(job.points[1].inputs[0].second.components[0].u, 3e-3 / std::sqrt(3.0));
    EXPECT_DOUBLE_EQ(job.points[0].inputs[1].second.components[0].value, 0.01);
    EXPECT_DOUBLE_EQ(job.points[1].inputs[3].second.components[0].distribution.scale, 0.101e-3);
    EXPECT_EQ(job.points[0].inputs[2].second.components[0].observations.size(), 3U);
    for (const gum::BudgetInput& input : job.inputs) {
        EXPECT_FALSE(input.stated) << input.name;
    }
    EXPECT_TRUE(job.warnings.empty()) << job.warnings.front().what;
    // A column of values beside a statement without one.
    const BudgetJob table = read_budget(R"j("inputs": {"x": {"unit": "mm", "u": 0.1}}, "points": {"file": "p.csv"})j",
                                        {{"p.csv", "x\n1\n2\n"}});
    EXPECT_DOUBLE_EQ(table.points[1].inputs[0].second.components[0].value, 0.002);
}

TEST(BudgetJob, TellsWhatOfTheInputsThePointsLeaveUnused) {
    const BudgetJob job = read_budget(R"j("inputs": {"x": {"observations": [100, 200]}, "y": {"value": 3, "u": 1}},
        "points": [{"x": {"observations": [1, 2, 3]}, "y": 4}, {"x": {"observations": [1, 2, 4]}}])j");
    ASSERT_EQ(job.warnings.size(), 1U);
    EXPECT_EQ(job.warnings[0].severity, gum::Severity::note);
    EXPECT_THAT(job.warnings[0].what, HasSubstr("\"x.observations\" of the inputs"));
}

TEST(BudgetJob, ReadsFits) {
    const BudgetJob job =
        read_budget(R"j("model": ["t_x = (V_x - a)/b"], "inputs": {"V_x": {"value": 1, "unit": "mV", "u": 0.1}},
        "fits": {"calibration": {"equation": "V = a + b*t", "units": {"V": "mV", "t": "degC"},
            "parameters": {"b": {"unit": "mV/K"}, "a": {"unit": "mV"}},
            "data": {"t": [0, 10, 20], "V": [1, 2, 3.5], "u_V": 0.01}},
          "decay": {"equation": "y = y0*exp(-x/s)", "parameters": {"y0": {"start": 2}, "s": {"start": 1}},
            "data": {"file": "decay.csv"}, "covariance": {"y": {"file": "v.csv"}}, "scale_by_residuals": true
}
})j",
                    {{"decay.csv", "x,y\n0,2\n1,1\n2,0.5\n"}, {"v.csv", "4,0,0\n0,4,1\n0,1,4\n"}});
    ASSERT_EQ(job.fits.size(), 2U);
    const gum::BudgetFit& line = job.fits[0];
    EXPECT_EQ(line.name, "calibration");
    EXPECT_EQ(line.ordinate, "V");
    EXPECT_THAT(line.regressors, ElementsAre("t"));
    EXPECT_EQ(line.parameters[0].name, "b");
    EXPECT_FALSE(line.parameters[0].start);
    EXPECT_DOUBLE_EQ(line.y(2), 0.0035);
    EXPECT_DOUBLE_EQ(line.x(1, 0), 10.0);
    ASSERT_EQ(line.y_uncertainty.cols(), 1);
    EXPECT_DOUBLE_EQ(line.y_uncertainty(1, 0), 1e-5);
    EXPECT_EQ(job.fits[1].y_uncertainty(1, 2), 1.0);
    EXPECT_TRUE(job.fits[1].scale_by_residuals);
    EXPECT_EQ(gum::model_inputs(job).back().name, "s");
}

TEST(BudgetJob, ReadsSamplesFromAFile) {
    std::string csv = "trial,X,Y\n";
    for (int i = 0; i < 50; ++i) {
        csv += "1,2,9\n2,4,5\n";
    }
    const test::BudgetFiles files{{"mc.csv", csv}};
    EXPECT_EQ(read_one_input(R"j({"samples": "mc.csv"})j", files).components[0].value, 3.0);
    const gum::StatedQuantity q =
        read_one_input(R"j({"samples": {"file": "mc.csv", "column": "Y"}})j", files).components[0];
    EXPECT_EQ(q.value, 7.0);
    EXPECT_NEAR(q.u, 2.0, 1e-14);
    EXPECT_EQ(q.degrees_of_freedom, 99.0);
    EXPECT_EQ(q.distribution.samples->front(), 5.0);
    EXPECT_EQ(q.sample_file, "mc.csv");
    EXPECT_EQ((*q.sample_rows)[0], 9.0) << "in the order of the file";
    EXPECT_EQ((*q.sample_rows)[1], 5.0);
}

// A specification holds within its range; whoever states another range has no message.
TEST(BudgetJob, TellsAReadingBeyondTheRangeOfItsSpecification) {
    const auto codes = [](const std::string& reading, const std::string& specification) {
        std::vector<std::string> all;
        const BudgetJob job = read_budget(R"j("inputs": {"a": {"value": )j" + reading +
                                          R"j(, "unit": "V", "specification": {)j" + specification + "}}}");
        for (const gum::Diagnostic& warning : job.warnings) {
            all.emplace_back(warning.code);
        }
        return all;
    };
    using Codes = std::vector<std::string>;
    const std::string of_range = R"j("percent_of_range": 0.05, "range": 10)j";
    const Codes beyond{std::string(k_warn_beyond_range.code)};
    EXPECT_EQ(codes("9.9", of_range), Codes());
    EXPECT_EQ(codes("10", of_range), Codes());
    EXPECT_EQ(codes("-10", of_range), Codes());
    EXPECT_EQ(codes("10.1", of_range), beyond);
    EXPECT_EQ(codes("-12", of_range + R"j(, "percent_of_reading": 0.1)j"), beyond);
    EXPECT_EQ(codes("12", R"j("percent_of_range": 0.05, "range": 100)j"), Codes()) << "the cure";
    EXPECT_EQ(codes("12", R"j("percent_of_reading": 0.05)j"), Codes());
}

// Kessel 2006: r with seven digits, whose matrix has the eigenvalue -2.2e-8.
TEST(BudgetJob, TakesCorrelationsWithinTheirDigits) {
    const auto read = [](const std::string& last) {
        return read_budget(
            R"j("inputs": {"a": {"value": 0, "u": 1}, "b": {"value": 0, "u": 1}, "c": {"value": 0, "u": 1},
            "d": {"value": 0, "u": 1}}, "correlations": [["a", "b", 0.3099065], ["a", "c", -0.2040958],
            ["a", "d", -0.1701139], ["b", "c", -0.6122649], ["b", "d", -0.1294786], ["c", "d", )j" +
            last + "]]");
    };
    const std::vector<double> stated{0.3099065, -0.2040958, -0.1701139, -0.6122649, -0.1294786, -0.6950289};
    const BudgetJob job = read("-0.6950289");
    ASSERT_EQ(job.warnings.size(), 1U);
    EXPECT_EQ(job.warnings[0].code, k_warn_correlations_repaired.code);
    ASSERT_EQ(job.correlations.size(), 6U);
    for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_NEAR(job.correlations[i].r, stated[i], 5.0001e-8);
    }
    // More digits, less room; and digits that are written as zeros are digits.
    const auto refusals = [](const std::string& r) {
        return test::budget_refusals(
            R"j("inputs": {"a": {"value": 0, "u": 1}, "b": {"value": 0, "u": 1}, "c": {"value": 0, "u": 1}},
                "correlations": [["a", "b", )j" +
            r + R"j(], ["b", "c", )j" + r + R"j(], ["a", "c", 0.5200]])j");
    };
    // a and b, b and c at r need r(a, c) ≥ 2 r² − 1: 0.5206 for 0.872.
    EXPECT_TRUE(refusals("0.872").empty());
    EXPECT_EQ(refusals("0.87200").size(), 1U);
    EXPECT_EQ(refusals("0.9").size(), 1U) << "one digit gives no room of 0.05";
}

TEST(BudgetJob, SaysWhichCorrelationsAreNotStated) {
    const auto refusals = test::budget_refusals(
        R"j("inputs": {"a": {"value": 0, "u": 1}, "b": {"value": 0, "u": 1}, "c": {"value": 0, "u": 1}},
            "correlations": [["a", "b", 0.9], ["b", "c", 0.9]])j");
    ASSERT_EQ(refusals.size(), 1U);
    EXPECT_THAT(refusals[0].what, testing::HasSubstr("2 of 3 pairs are stated, and the others count as 0"));
}

TEST(BudgetJob, SolvesForUnknowns) {
    const BudgetJob job =
        read_budget(R"j("model": ["0 = R - R0*(1 + A*(t - t0))"], "solve_for": {"t": {"start": 20, "unit": "degC"}},
        "inputs": {"R": {"value": 104, "unit": "ohm", "u": 0.01}, "R0": {"value": 100, "unit": "ohm", "constant": true},
                   "A": {"value": 0.0039, "unit": "1/K", "constant": true}, "t0": {"value": 0, "unit": "degC", "constant": true}})j");
    ASSERT_EQ(job.unknowns.size(), 1U);
    EXPECT_EQ(job.unknowns[0].start, 20.0);
    EXPECT_TRUE(job.unknowns[0].unit.is_celsius_temperature());
}

TEST(BudgetJob, WarnsOfWhatAPersonShouldSee) {
    const BudgetJob job = read_budget(R"j("model": ["y = a"], "inputs": {"a": {"components": [
        {"name": "readings", "observations": [5, 5, 5]}, {"name": "display", "resolution": 1}]},
        "A": {"value": 1, "u": 1}}, "monte_carlo": {"trials": 10000, "validate": true, "digits": 1})j");
    const std::string texts = test::texts(job.warnings);
    EXPECT_THAT(texts, testing::HasSubstr("GC-WARN-0008"));
    EXPECT_THAT(texts, testing::HasSubstr("\"A\" and \"a\" differ by capital letters only"));
    EXPECT_THAT(texts, testing::HasSubstr("GC-WARN-0010"));
    EXPECT_THAT(texts, testing::HasSubstr("GC-WARN-0011"));
    EXPECT_EQ(job.monte_carlo->digits, 1);
    EXPECT_EQ(job.inputs[0].components[0].u, 0.0);
}

TEST(BudgetJob, HasTheDocumentedDefaults) {
    const BudgetJob job = read_budget(R"j("inputs": {"a": {"value": 1, "u": 1}}, "monte_carlo": {})j");
    EXPECT_EQ(job.coverage_probability, 0.9545);
    EXPECT_FALSE(job.monte_carlo->trials);
    EXPECT_EQ(job.monte_carlo->digits, 2);
    EXPECT_EQ(job.monte_carlo->seed, 1U);
    EXPECT_EQ(job.monte_carlo->most_trials, 1'000'000'000U);
    EXPECT_TRUE(job.inputs[0].common);
    EXPECT_EQ(job.inputs[0].unit.text(), "1");
}

/// The same readings as columns of a file and as a list in the job, with what the input states beside them.
std::vector<BudgetJob> with_readings(const std::string& beside, const std::string& more = "") {
    const auto keys = [&](const std::string& points) {
        return R"j("model": ["e = p - s)j" + std::string(more.empty() ? "" : " + d") +
               R"j("], "inputs": {"p": {"unit": "bar")j" + beside +
               R"j(}, "s": {"unit": "mbar", "value": 1, "u": 1})j" + more +
               R"j(}, "outputs": {"e": {"unit": "bar"}}, "points": )j" + points;
    };
    std::vector<BudgetJob> jobs;
    jobs.push_back(test::read_budget(keys(R"({"file": "points.csv"})"),
                                     {{"points.csv", "p.1,p.2,p.3\n0.00,0.00,0.00\n10.00,10.05,10.05\n"}}));
    jobs.push_back(test::read_budget(
        keys(R"([{"p": {"observations": [0.00, 0.00, 0.00]}}, {"p": {"observations": [10.00, 10.05, 10.05]}}])")));
    return jobs;
}

// A gauge at zero shows equal readings every day: its resolution is the contribution then (JCGM 100:2008, F.2.2.1).
TEST(BudgetJobTest, ReadingsStandBesideWhatTheDisplayAdds) {
    const double u_display = 0.05e5 / std::sqrt(12.0);
    for (const std::string beside :
         {R"(, "resolution": 0.05)", R"(, "components": [{"name": "display", "value": 0, "resolution": 0.05}])"}) {
        SCOPED_TRACE(beside);
        for (const BudgetJob& job : with_readings(beside)) {
            EXPECT_THAT(job.warnings, testing::IsEmpty());
            for (std::size_t p = 0; p < 2; ++p) {
                const gum::BudgetInput& input = gum::input_at(job, 0, p);
                ASSERT_EQ(input.components.size(), 2U);
                EXPECT_EQ(input.components[0].name, "readings");
                EXPECT_EQ(input.components[0].observations.size(), 3U);
                EXPECT_NEAR(input.components[1].u, u_display, 1e-9 * u_display);
                const double u_readings = p == 0 ? 0.0 : 0.05e5 / 3.0;  // s = 0.05/√3, over √3
                EXPECT_NEAR(input.components[0].u, u_readings, 1e-9 * u_display);
                EXPECT_NEAR(gum::input_total(input).u, std::hypot(u_readings, u_display), 1e-9 * u_display);
                EXPECT_NEAR(gum::input_total(input).value, p == 0 ? 0.0 : 1.00333333333e6, 1e-2);
            }
        }
    }
}

TEST(BudgetJobTest, EqualReadingsAreToldWhereAnotherInputHoldsTheResolution) {
    for (const std::string d : {R"(, "d": {"unit": "mbar", "value": 0, "resolution": 50})",
                                R"(, "d": {"unit": "bar", "components": [{"name": "x", "resolution": 0.05}]})"}) {
        for (const BudgetJob& job : with_readings("", d)) {
            ASSERT_EQ(job.warnings.size(), 1U) << d;
            EXPECT_EQ(job.warnings[0].code, "GC-WARN-0011");
            EXPECT_THAT(gum::message(job.warnings[0]), testing::HasSubstr("resolution of \"d\""));
            EXPECT_EQ(gum::input_total(gum::input_at(job, 0, 0)).u, 0.0);
        }
    }
}

TEST(BudgetJobTest, EqualReadingsWithoutAResolutionAreRefused) {
    for (const std::string d : {"", R"(, "d": {"unit": "bar", "value": 0, "u": 0.05})",
                                R"(, "d": {"unit": "K", "value": 0, "resolution": 0.05})"}) {
        const std::vector<gum::Diagnostic> refused = test::budget_refusals(
            R"j("model": ["e = p"], "inputs": {"p": {"unit": "bar", "observations": [1, 1, 1]})j" + d + "}");
        ASSERT_EQ(refused.size(), 1U) << d;
        EXPECT_EQ(refused[0].code, "GC-INPUT-0305");
        EXPECT_THAT(refused[0].action, testing::HasSubstr("state \"resolution\" beside them"));
    }
}

/// What the register says, line by line.
std::string told_by(const std::optional<certificate::LaboratoryRegister>& facts) {
    std::string text = facts ? "" : "nothing";
    if (facts) {
        for (const auto& one : facts->contradictions) {
            text += one.where + " " + one.subject + " " + one.stated + " " + one.registered + "\n";
        }
        for (const auto& one : facts->overdue) {
            text += one.standard + " " + one.day + " " + one.due + "\n";
        }
        for (const auto& one : facts->uses) {
            text += one.standard + " " + one.input + " " + one.answer + " " + one.because + "\n";
        }
        for (const auto* const list : {&facts->not_registered, &facts->not_listed}) {
            for (const std::string& one : *list) {
                text += one + "\n";
            }
        }
        for (const auto& one : facts->signatories) {
            text += one.name + " " + one.from + " " + one.to + " " + std::to_string(one.methods.size()) + "\n";
        }
    }
    return text;
}

/// The reader hands on what register_of_job() reads a second time, whatever the certificate states otherwise.
TEST(BudgetJobOfALaboratory, SaysOfTheRegisterWhatAReadingAloneSays) {
    namespace fs = std::filesystem;
    const fs::path folder = fs::path(testing::TempDir()) / "job_of_a_laboratory";
    fs::remove_all(folder);
    fs::copy(fs::path(GUMCERT_SOURCE_DIR) / "examples" / "laboratory", folder, fs::copy_options::recursive);
    const auto document_of = [&](const char* file) {
        std::ifstream stream(folder / file);
        return nlohmann::json::parse(stream, nullptr, true, true);
    };
    const nlohmann::json job = document_of("end_gauge.json");
    const nlohmann::json certificate = document_of("end_gauge_certificate.json");
    const std::vector<nlohmann::json> others = {
        R"({})"_json,
        R"({"standards": []})"_json,
        R"({"standards": ["STD-017"]})"_json,
        R"({"standards": [{"identification": "STD-017", "certificate": "another", "name": "gauge"}]})"_json,
        R"({"dates": {"performed_from": "2031-01-02", "performed_to": "2031-01-03"}})"_json,
        R"({"persons": {"authorised_by": {"name": "N. Obody"}}})"_json};
    std::set<std::string> told;
    for (const nlohmann::json& other : others) {
        nlohmann::json stated = certificate;
        stated.merge_patch(other);
        std::ofstream(folder / "end_gauge_certificate.json") << stated.dump();
        for (const bool is_used : {true, false}) {
            nlohmann::json changed = job;
            if (!is_used) {
                changed["inputs"]["l_s"] = R"({"unit": "nm", "value": 50000623, "u": 25, "nu": 18})"_json;
            }
            std::ofstream(folder / "end_gauge.json") << changed.dump();
            const auto alone = register_of_job(DiskFileSource::of_job(folder / "end_gauge.json"), "end_gauge.json");
            try {
                EXPECT_EQ(told_by(read_budget_job(folder / "end_gauge.json").registered), told_by(alone)) << other;
                told.insert(told_by(alone));
            } catch (const gum::InputError& refused) {
                EXPECT_FALSE(refused.diagnostics().empty()) << "nothing is handed on";
            }
        }
    }
    EXPECT_GE(told.size(), 4U) << "they differ";
}

}  // namespace
}  // namespace gumcert::jobs
