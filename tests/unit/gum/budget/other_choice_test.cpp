#include "gum/budget/other_choice.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include "tests/unit/gum/budget/made_budgets.h"

namespace gumcert::gum {
namespace {

using test::input;
using testing::HasSubstr;

/// An equation of a, b and c, and a number of its own for each set of choices that it can make.
struct ChoosingModel {
    const char* equation;
    std::function<int(double, double, double)> choice;
};

int largest(double a, double b, double c) {
    return a >= b && a >= c ? 0 : b >= c ? 1 : 2;
}

const std::vector<ChoosingModel>& choosing_models() {
    static const std::vector<ChoosingModel> models{
        {"y = max(a, b) + 0*c", [](double a, double b, double) { return a >= b ? 0 : 1; }},
        {"y = 3*min(a, b) - c", [](double a, double b, double) { return a <= b ? 0 : 1; }},
        {"y = abs(a - b) + 0*c", [](double a, double b, double) { return a >= b ? 0 : 1; }},
        {"y = (a + b + abs(a - b))/2 + 0*c", [](double a, double b, double) { return a >= b ? 0 : 1; }},
        {"y = max(max(a, b), c) - min(min(a, b), c)",
         [](double a, double b, double c) { return 3 * largest(a, b, c) + largest(-a, -b, -c); }},
        {"y = exp(max(a, max(b, c))/10)", largest}};
    return models;
}

/// Share of draws of our own in which another choice is made than at the estimates.
double share_of(const ChoosingModel& model, const std::vector<double>& at, const std::vector<double>& u) {
    constexpr int k_draws = 20000;
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal;
    const int here = model.choice(at[0], at[1], at[2]);
    int others = 0;
    for (int i = 0; i < k_draws; ++i) {
        const double a = at[0] + u[0] * normal(engine);
        const double b = at[1] + u[1] * normal(engine);
        const double c = at[2] + u[2] * normal(engine);
        others += model.choice(a, b, c) == here ? 0 : 1;
    }
    return static_cast<double>(others) / k_draws;
}

Budget with_few_trials(Budget of) {
    of.monte_carlo.emplace().trials = 20000;
    return of;
}

// The law: whoever chooses otherwise in many trials is told, and nobody who never does. Where the law of propagation is
// reported it is adequate, and its value is that at the estimates.
TEST(OtherChoice, IsToldWhereverTrialsChooseOtherwiseAndNowhereElse) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> size(0.3, 3.0);
    std::uniform_real_distribution<double> step(0.0, 1.0);
    int told = 0;
    int clear = 0;
    for (int i = 0; i < 120; ++i) {
        const ChoosingModel& model = choosing_models()[static_cast<std::size_t>(i) % choosing_models().size()];
        const std::vector<double> u{size(engine), size(engine), size(engine)};
        const double gap = i % 3 == 0 ? 30.0 : 3.0 * step(engine);
        const std::vector<double> at{gap, 0.0, (i % 2 == 0 ? -1.0 : 0.4) * gap};
        SCOPED_TRACE(std::string(model.equation) + " at " + std::to_string(gap) + " u " + std::to_string(u[0]) + " " +
                     std::to_string(u[1]) + " " + std::to_string(u[2]));
        const Budget of = with_few_trials(test::budget(
            {model.equation}, {input("a", state_uncertainty(at[0], u[0])), input("b", state_uncertainty(at[1], u[1])),
                               input("c", state_uncertainty(at[2], u[2]))}));
        const BudgetResult result = evaluate_budget(of, 1);
        const BudgetOutputResult& y = result.points[0].outputs[0];
        const bool tells = test::tells(result, "GC-BUDGET-0044");
        const double share = share_of(model, at, u);
        EXPECT_EQ(tells, y.by_monte_carlo && y.other_choice >= k_other_choice_matters);
        if (share > 0.08) {
            EXPECT_TRUE(tells) << share;
            EXPECT_LT(y.other_choice, share + 0.03);
            ++told;
        }
        if (share == 0.0) {
            EXPECT_FALSE(tells);
            EXPECT_EQ(y.other_choice, 0.0);
            ++clear;
        }
    }
    EXPECT_GT(told, 30);
    EXPECT_GT(clear, 10);
}

double share_in(const std::string& equation, std::vector<BudgetInput> inputs) {
    Budget of = with_few_trials(test::budget({equation}, std::move(inputs)));
    of.coverage = CoverageChoice::monte_carlo;
    return test::first_result(of).other_choice;
}

TEST(OtherChoice, CountsOnlyWhatTheResultIsAnotherBy) {
    const BudgetInput a = input("a", state_uncertainty(0.1, 1.0));
    const BudgetInput b = input("b", state_uncertainty(0.0, 1.0));
    EXPECT_NEAR(share_in("y = max(a, b)", {a, b}), 0.47, 0.03);
    EXPECT_EQ(share_in("y = max(a, b) + min(a, b)", {a, b}), 0.0);
    EXPECT_EQ(share_in("y = b + abs(a)/1000000", {a, b}), 0.0);
    EXPECT_EQ(share_in("y = abs(a)*abs(a) + b", {a, b}), 0.0);
    EXPECT_EQ(share_in("y = hypot(a, b)", {a, b}), 0.0);
    EXPECT_EQ(share_in("y = 2*a + b", {a, b}), 0.0);
}

// max(x, 0) keeps to what can be: its interval is that of x, cut at 0.
TEST(OtherChoice, IsNoLimitWithoutUncertainty) {
    const BudgetInput a = input("a", state_uncertainty(0.1, 1.0));
    EXPECT_EQ(share_in("y = max(a, 0)", {a}), 0.0);
    EXPECT_EQ(share_in("y = min(a, l)", {a, input("l", state_constant(0.2))}), 0.0);
    EXPECT_NEAR(share_in("y = min(a, l)", {a, input("l", state_uncertainty(0.1, 1e-6))}), 0.5, 0.03);
    // What has no value without the choice.
    EXPECT_NEAR(share_in("y = sqrt(max(a, b)) + c",
                         {input("a", state_uncertainty(0.5, 1.0)), input("b", test::rectangular(0.2, 0.1)),
                          input("c", state_uncertainty(1.0, 0.01))}),
                0.38, 0.03);
}

// Implicit equations that choose otherwise have another solution.
TEST(OtherChoice, IsSeenInImplicitEquations) {
    Budget of = with_few_trials(
        test::budget({"0 = x^3 + x - max(a, b)", "y = x + a"},
                     {input("a", state_uncertainty(2.0, 0.1)), input("b", state_uncertainty(1.9, 0.1))}));
    of.unknowns = {{.name = "x", .start = 1.0, .unit = {}}};
    EXPECT_NEAR(test::first_result(of).other_choice, 0.24, 0.03);
    of.inputs[1] = input("b", state_uncertainty(0.5, 0.1));
    of.coverage = CoverageChoice::monte_carlo;
    EXPECT_EQ(test::first_result(of).other_choice, 0.0);
}

TEST(OtherChoice, SaysBothValuesAndThePointWhereItIsWorst) {
    Budget of = with_few_trials(test::budget({"y = abs(a)"}, {input("a", state_uncertainty(9.0, 1.0))}));
    for (const auto& [name, value] : {std::pair("clear", 9.0), std::pair("near", 0.5), std::pair("at 0", 0.2)}) {
        of.points.push_back(test::point(of, name, {{"a", state_uncertainty(value, 1.0)}}));
    }
    const BudgetResult result = evaluate_budget(of, 1);
    const auto message = other_choice_message(of, result, "y");
    ASSERT_TRUE(message.has_value());
    EXPECT_EQ(message->code, "GC-BUDGET-0044");
    EXPECT_EQ(message->where, "result y at point at 0, and at 1 more");
    EXPECT_THAT(message->what,
                HasSubstr("the equations give 0.20 at the estimates, and the mean of the trials is 0.8"));
    EXPECT_EQ(message->severity, Severity::warning);
    EXPECT_EQ(std::count_if(result.notes.begin(), result.notes.end(),
                            [](const Diagnostic& note) { return note.code == "GC-BUDGET-0044"; }),
              1);
    EXPECT_EQ(other_choice_message(of, result, "z"), std::nullopt);
}

}  // namespace
}  // namespace gumcert::gum
