#include "gum/budget/budget.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/gum/budget/made_budgets.h"
#include "tests/unit/gum/printed.h"

namespace gumcert::gum {
namespace {

using test::input;

TEST(Budget, OffersItsInputsAndTheParametersOfItsFitsToTheEquations) {
    Budget of = test::budget({"y = k*a + x"}, {input("k", state_constant(3)), input("x", state_uncertainty(1, 1))});
    of.fits = {test::line({0, 1, 2}, 0.1)};
    const std::vector<InputSymbol> symbols = model_inputs(of);
    ASSERT_EQ(symbols.size(), 4U);
    EXPECT_EQ(symbols[0].constant, 3.0);
    EXPECT_FALSE(symbols[1].constant.has_value());
    EXPECT_EQ(symbols[2].name, "a");
    EXPECT_EQ(symbols[3].name, "b");
    // A constant that a point states anew has no value of its own.
    of.points = {test::point(of, "1", {{"k", state_constant(4)}})};
    EXPECT_FALSE(model_inputs(of)[0].constant.has_value());
}

TEST(Budget, AsksForItsOutputsWithTheirUnits) {
    Budget of;
    of.outputs = {{.name = "l",
                   .unit = Unit::parse("mm"),
                   .coverage_probability = {},
                   .coverage = {},
                   .where = "job.json#/outputs/l"}};
    const std::vector<OutputSymbol> symbols = model_outputs(of);
    ASSERT_EQ(symbols.size(), 1U);
    EXPECT_EQ(symbols[0].unit->text(), "mm");
    EXPECT_EQ(symbols[0].where, "job.json#/outputs/l");
}

TEST(Budget, HasTheInputOfAPointOrItsOwn) {
    Budget of = test::budget({}, {input("a", state_uncertainty(1, 1)), input("b", state_uncertainty(2, 1))});
    of.points = {test::point(of, "1", {{"b", state_uncertainty(5, 1)}})};
    EXPECT_EQ(input_at(of, 1, 0).components.front().value, 5.0);
    EXPECT_EQ(input_at(of, 0, 0).components.front().value, 1.0);
    EXPECT_EQ(input_at(of, 1, std::nullopt).components.front().value, 2.0);
}

// The difference of the end gauges of JCGM 100:2008, H.1.3.2: 5.8 nm, 3.9 nm and 6.7 nm with 24, 5 and 8 degrees of
// freedom are u(d) = 9.7 nm, and ν_eff(d) = 25.6 (H.1.6).
TEST(Budget, AddsTheComponentsOfAnInput) {
    const InputTotal d = input_total(test::sum_of(
        "d", {state_uncertainty(215, 5.8, 24), state_uncertainty(0, 3.9, 5), state_uncertainty(0, 6.7, 8)}));
    EXPECT_EQ(d.value, 215.0);
    EXPECT_TRUE(test::prints_as(d.u, "9.7"));
    EXPECT_NEAR(d.degrees_of_freedom, 25.6, 0.2);  // from rounded numbers: 25.45 without rounding
    const InputTotal one = input_total(input("x", state_uncertainty(1, 2, 7)));
    EXPECT_EQ(one.u, 2.0);
    EXPECT_EQ(one.degrees_of_freedom, 7.0);
}

}  // namespace
}  // namespace gumcert::gum
