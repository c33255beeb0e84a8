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

/// An equation of a, b and c, a number of its own for each set of choices that it can make, and its value with one of them.
struct ChoosingModel {
    const char* equation;
    std::function<int(double, double, double)> choice;
    std::function<double(double, double, double, int)> value;
};

double one_of(double a, double b, double c, int which) {
    return which == 0 ? a : which == 1 ? b : c;
}

int largest(double a, double b, double c) {
    return a >= b && a >= c ? 0 : b >= c ? 1 : 2;
}

int median(double a, double b, double c) {
    return (a >= b) == (c >= a) ? 0 : (b >= a) == (c >= b) ? 1 : 2;
}

const std::vector<ChoosingModel>& choosing_models() {
    static const std::vector<ChoosingModel> models{
        {"y = max(a, b) + 0*c", [](double a, double b, double) { return a >= b ? 0 : 1; }, one_of},
        {"y = 3*min(a, b) - c", [](double a, double b, double) { return a <= b ? 0 : 1; },
         [](double a, double b, double c, int which) { return 3 * one_of(a, b, c, which) - c; }},
        {"y = abs(a - b) + 0*c", [](double a, double b, double) { return a >= b ? 0 : 1; },
         [](double a, double b, double, int which) { return which == 0 ? a - b : b - a; }},
        {"y = (a + b + abs(a - b))/2 + 0*c", [](double a, double b, double) { return a >= b ? 0 : 1; }, one_of},
        {"y = max(max(a, b), c) - min(min(a, b), c)",
         [](double a, double b, double c) { return 3 * largest(a, b, c) + largest(-a, -b, -c); },
         [](double a, double b, double c, int which) {
             return one_of(a, b, c, which / 3) - one_of(a, b, c, which % 3);
         }},
        {"y = exp(max(a, max(b, c))/10)", largest,
         [](double a, double b, double c, int which) { return std::exp(one_of(a, b, c, which) / 10); }},
        {"y = max(min(a, b), min(max(a, b), c))", median, one_of}};
    return models;
}

struct OtherDraws {
    double share = 0.0;  ///< in which another choice is made than at the estimates
    double moved = 0.0;  ///< by the choices, on the mean, in standard deviations of the result
};

OtherDraws draws_of(const ChoosingModel& model, const std::vector<double>& at, const std::vector<double>& u) {
    constexpr int k_draws = 20000;
    std::mt19937_64 engine(7);
    std::normal_distribution<double> normal;
    const int here = model.choice(at[0], at[1], at[2]);
    double others = 0.0;
    double moved = 0.0;
    double sum = 0.0;
    double squares = 0.0;
    for (int i = 0; i < k_draws; ++i) {
        const double a = at[0] + u[0] * normal(engine);
        const double b = at[1] + u[1] * normal(engine);
        const double c = at[2] + u[2] * normal(engine);
        const int other = model.choice(a, b, c);
        const double y = model.value(a, b, c, other);
        others += other == here ? 0.0 : 1.0;
        moved += y - model.value(a, b, c, here);
        sum += y;
        squares += y * y;
    }
    const double mean = sum / k_draws;
    return {others / k_draws, std::abs(moved / k_draws) / std::sqrt(squares / k_draws - mean * mean)};
}

Budget with_few_trials(Budget of) {
    of.monte_carlo.emplace().trials = 20000;
    return of;
}

// The law: who chooses otherwise in many trials and is another one by it on the mean is told, and nobody else. Where the law of propagation is
// reported it is adequate, and its value is that at the estimates.
TEST(OtherChoice, IsToldWhereverTrialsChooseOtherwiseAndNowhereElse) {
    std::mt19937_64 engine(1);
    std::uniform_real_distribution<double> size(0.3, 3.0);
    std::uniform_real_distribution<double> step(0.0, 1.0);
    int told = 0;
    int clear = 0;
    for (int i = 0; i < 140; ++i) {
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
        const auto [share, moved] = draws_of(model, at, u);
        EXPECT_EQ(tells, y.by_monte_carlo && y.other_choice >= k_other_choice_matters);
        if (share > 0.08 && moved > 0.15) {
            EXPECT_TRUE(tells) << share << " " << moved;
            EXPECT_LT(y.other_choice, share + 0.03);
            ++told;
        }
        if (share == 0.0 || moved < 0.06) {
            EXPECT_FALSE(tells) << share << " " << moved;
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
    EXPECT_EQ(share_in("y = max(min(a, b), min(max(a, b), c))", {a, b, input("c", state_uncertainty(-0.1, 1.0))}), 0.0);
    EXPECT_EQ(share_in("y = abs(a)", {input("a", state_uncertainty(1.8, 1.0))}), 0.0);
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

// Whatever the equations are: hypot() of values near 0 is an abs(). JCGM 101:2008, 9.4.2, is not accused.
TEST(OtherChoice, SaysThatTheValueLiesOutsideOfTheInterval) {
    const auto code_of = [](const std::string& equation, double at) {
        const BudgetResult result =
            evaluate_budget(with_few_trials(test::budget({equation}, {input("a", state_uncertainty(at, 1.0)),
                                                                      input("b", state_uncertainty(0.0, 1.0)),
                                                                      input("c", state_uncertainty(0.0, 1.0))})),
                            1);
        std::string codes;
        for (const Diagnostic& note : result.notes) {
            codes += note.code == "GC-BUDGET-0044" || note.code == "GC-BUDGET-0045" ? note.code : "";
        }
        return codes;
    };
    EXPECT_EQ(code_of("y = hypot(a, b) + 0*c", 0.02), "GC-BUDGET-0045");
    EXPECT_EQ(code_of("y = sqrt(a^2 + b^2 + c^2)", 0.1), "GC-BUDGET-0045");
    EXPECT_EQ(code_of("y = 5 - hypot(a, b) + 0*c", 0.02), "GC-BUDGET-0045");
    EXPECT_EQ(code_of("y = hypot(a, b) + 0*c", 3.0), "");
    EXPECT_EQ(code_of("y = a^2 + b^2 + 0*c", 0.0), "");
    EXPECT_EQ(code_of("y = a^2 + 0*b*c", 0.0), "");
    EXPECT_EQ(code_of("y = abs(a) + 0*b*c", 0.2), "GC-BUDGET-0044");
}

}  // namespace
}  // namespace gumcert::gum
