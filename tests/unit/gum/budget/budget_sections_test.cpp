// Sections of one budget: what each of them gives alone, and what they have in common.
#include <gtest/gtest.h>

#include <random>
#include <string>
#include <utility>
#include <vector>

#include "gum/budget/budget_covariance.h"
#include "gum/budget/evaluate_budget.h"
#include "gum/budget/reported_covariance.h"
#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::correlate;
using test::input;

/// Puts budgets over the same inputs together, one section each.
Budget together(const std::vector<Budget>& parts) {
    Budget all = parts.front();
    all.model.clear();
    all.outputs.clear();
    all.points.clear();
    for (std::size_t i = 0; i < parts.size(); ++i) {
        const Budget& part = parts[i];
        all.sections.push_back({.name = "section " + std::to_string(i + 1),
                                .equations = part.model.size(),
                                .unknowns = part.unknowns.size(),
                                .outputs = part.outputs.size(),
                                .points = part.points.size()});
        all.model.insert(all.model.end(), part.model.begin(), part.model.end());
        all.unknowns.insert(all.unknowns.end(), part.unknowns.begin(), part.unknowns.end());
        all.outputs.insert(all.outputs.end(), part.outputs.begin(), part.outputs.end());
        all.points.insert(all.points.end(), part.points.begin(), part.points.end());
    }
    return all;
}

/// Four inputs, two of them correlated, under names a to d.
std::vector<BudgetInput> made_inputs(std::mt19937& generator) {
    std::uniform_real_distribution<double> value(1.0, 3.0);
    std::uniform_real_distribution<double> u(0.001, 0.01);
    std::vector<BudgetInput> inputs;
    for (const char* name : {"a", "b", "c", "d"}) {
        inputs.push_back(input(name, state_uncertainty(value(generator), u(generator))));
    }
    return inputs;
}

Budget budget_of(const std::vector<std::string>& model, const std::vector<BudgetInput>& inputs, double r) {
    Budget of = test::budget(model, inputs);
    correlate(of, "b", "c", r);
    return of;
}

// The law of sections: without points, one model with the equations of all gives the same values and one covariance.
TEST(BudgetSections, HaveTheCovarianceOfOneModelWithAllEquations) {
    std::mt19937 generator(20261124);
    std::uniform_real_distribution<double> r(-0.9, 0.9);
    const std::vector<std::string> models{"y1 = a + 2*b", "y2 = a*c", "y3 = d - b/c", "y4 = c^2", "y5 = sqrt(a*d) - b"};
    for (int trial = 0; trial < 40; ++trial) {
        const std::vector<BudgetInput> inputs = made_inputs(generator);
        const double correlation = r(generator);
        std::vector<std::string> chosen = models;
        std::shuffle(chosen.begin(), chosen.end(), generator);
        const std::vector<std::string> first{chosen[0], chosen[1]};
        const std::vector<std::string> second{chosen[2]};
        const Budget sections =
            together({budget_of(first, inputs, correlation), budget_of(second, inputs, correlation)});
        const Budget whole = budget_of({chosen[0], chosen[1], chosen[2]}, inputs, correlation);
        const BudgetResult of_sections = evaluate_budget(sections, 1);
        const BudgetResult of_whole = evaluate_budget(whole, 1);
        ASSERT_EQ(budget_result_count(of_sections), 3U);
        EXPECT_EQ(budget_result_names(sections, of_sections), budget_result_names(whole, of_whole));
        const Eigen::MatrixXd V = budget_covariance(of_sections);
        const Eigen::MatrixXd W = budget_covariance(of_whole);
        ASSERT_EQ(V.rows(), 3);
        EXPECT_LE((V - W).cwiseAbs().maxCoeff(), 1e-13 * W.cwiseAbs().maxCoeff()) << trial << "\n" << V << "\n\n" << W;
    }
}

// Points of different sections are as much correlated as points of one.
TEST(BudgetSections, ShareInputsBetweenPointsAsOneTableDoes) {
    std::mt19937 generator(4);
    const std::vector<BudgetInput> inputs = made_inputs(generator);
    const auto table = [&](double first, double u) {
        Budget of = budget_of({"y = a*b + c"}, inputs, 0.4);
        of.points = {test::point(of, std::to_string(first), {{"b", state_uncertainty(first, u)}}),
                     test::point(of, std::to_string(first + 1.0), {{"b", state_uncertainty(first + 1.0, 2.0 * u)}})};
        return of;
    };
    Budget one = table(1.0, 0.002);
    const Budget more = table(5.0, 0.003);
    const Budget sections = together({one, more});
    one.points.insert(one.points.end(), more.points.begin(), more.points.end());
    const Eigen::MatrixXd V = budget_covariance(evaluate_budget(sections, 1));
    const Eigen::MatrixXd W = budget_covariance(evaluate_budget(one, 1));
    ASSERT_EQ(V.rows(), 4);
    EXPECT_EQ(V, W);
    EXPECT_GT(std::abs(V(0, 3)), 0.0);
}

// What one section alone gives is what it gives among others, with Monte Carlo too: other inputs are not looked at.
TEST(BudgetSections, GiveWhatEachOfThemGivesAlone) {
    std::mt19937 generator(7);
    const std::vector<BudgetInput> inputs = made_inputs(generator);
    Budget first = budget_of({"y = a + b"}, inputs, 0.5);
    Budget second = budget_of({"z = c*d^2", "w = d"}, inputs, 0.5);
    second.points = {test::point(second, "1", {{"d", state_uncertainty(2.0, 0.1)}}),
                     test::point(second, "2", {{"d", state_uncertainty(4.0, 0.2)}})};
    Budget sections = together({first, second});
    for (Budget* const of : {&first, &second, &sections}) {
        of->monte_carlo.emplace();
        of->monte_carlo->trials = 2000;
    }
    const BudgetResult all = evaluate_budget(sections, 1);
    const BudgetResult alone = evaluate_budget(first, 1);
    const BudgetResult other = evaluate_budget(second, 1);
    ASSERT_EQ(all.points.size(), 3U);
    EXPECT_EQ(all.points[0].outputs.size(), 1U);
    EXPECT_EQ(all.points[1].outputs.size(), 2U);
    EXPECT_EQ(all.points[0].point, std::nullopt);
    EXPECT_EQ(all.points[2].point, 1U);
    EXPECT_EQ(all.points[2].section, 1U);
    const auto equal = [](const BudgetPointResult& a, const BudgetPointResult& b) {
        EXPECT_EQ(a.propagation.value, b.propagation.value);
        EXPECT_EQ(a.propagation.covariance, b.propagation.covariance);
        EXPECT_EQ(a.monte_carlo->outputs.front().standard_uncertainty,
                  b.monte_carlo->outputs.front().standard_uncertainty);
        EXPECT_EQ(a.outputs.front().expanded_uncertainty, b.outputs.front().expanded_uncertainty);
    };
    equal(all.points[0], alone.points[0]);
    equal(all.points[1], other.points[0]);
    equal(all.points[2], other.points[1]);
    EXPECT_EQ(reported_covariance(sections, all).rows(), 5);
}

TEST(BudgetSections, WithoutEquationsHaveTheInputsThatTheyName) {
    std::mt19937 generator(9);
    const std::vector<BudgetInput> inputs = made_inputs(generator);
    Budget first = budget_of({"y = a + b"}, inputs, 0.5);
    Budget second = budget_of({}, inputs, 0.5);
    second.outputs = {{.name = "c", .unit = {}, .coverage_probability = {}, .coverage = {}, .where = {}}};
    const Budget sections = together({first, second});
    const BudgetResult result = evaluate_budget(sections, 1);
    ASSERT_EQ(result.points.size(), 2U);
    ASSERT_EQ(result.points[1].outputs.size(), 1U);
    EXPECT_EQ(result.points[1].outputs[0].name, "c");
    EXPECT_EQ(result.points[1].propagation.value(0), input_total(inputs[2]).value);
    EXPECT_TRUE(result.points[1].model->uses(2));
    EXPECT_FALSE(result.points[1].model->uses(0));
    EXPECT_TRUE(result.points[0].model->uses(0));
    EXPECT_FALSE(result.points[0].model->uses(2));
    const Eigen::MatrixXd V = budget_covariance(result);
    const double expected = 0.5 * input_total(inputs[1]).u * input_total(inputs[2]).u;
    EXPECT_NEAR(V(0, 1), expected, 1e-12 * expected);
}

TEST(BudgetSections, AreBudgetsOfTheirOwn) {
    std::mt19937 generator(1);
    const std::vector<BudgetInput> inputs = made_inputs(generator);
    Budget second = budget_of({"z = c"}, inputs, 0.5);
    second.points = {test::point(second, "1", {{"c", state_uncertainty(2.0, 0.1)}})};
    const Budget sections = together({budget_of({"y = a", "x = b"}, inputs, 0.5), second});
    EXPECT_EQ(budget_of_section(sections, 0).model.size(), 2U);
    EXPECT_EQ(budget_of_section(sections, 1).model.front().text, "z = c");
    EXPECT_EQ(budget_of_section(sections, 1).points.size(), 1U);
    EXPECT_TRUE(budget_of_section(sections, 1).sections.empty());
    EXPECT_EQ(first_point_of(sections, 1), 0U);
    EXPECT_EQ(section_of_point(sections, 0), 1U);
    EXPECT_EQ(section_of_point(second, 0), std::nullopt);
}

}  // namespace
}  // namespace gumcert::gum
