#include "audit/rules/budget_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

AuditedRow quantity(const std::string& name, const std::string& estimate, const std::string& unit) {
    AuditedRow row = test::row(name, 0.1);
    row.unit = unit;
    row.estimate = test::printed(estimate);
    return row;
}
AuditedBudget power_budget() {
    AuditedBudget budget = test::budget_of(
        {quantity("I", "2.0", "mA"), quantity("R (resistance)", "3.0", "kohm"), quantity("drift", "0", "W")});
    budget.unit = "mW";
    budget.equation = "P = U*I; U = R*I";
    return budget;
}

TEST(BudgetModel, FindsRowsByTheirNames) {
    const std::optional<BudgetModel> model = BudgetModel::of(power_budget());
    ASSERT_TRUE(model);
    EXPECT_EQ(model->quantities(), (std::vector<std::string>{"I", "R"}));
    EXPECT_EQ(model->rows(), (std::vector<std::size_t>{0, 1}));
    EXPECT_TRUE(model->without_row().empty());
    EXPECT_TRUE(model->can_be_evaluated());
}

TEST(BudgetModel, DifferentiatesInTheUnitsOfTheTable) {
    const AuditedBudget budget = power_budget();
    const BudgetModel model = *BudgetModel::of(budget);
    const std::vector<double> x = model.estimates(budget);
    EXPECT_EQ(x, (std::vector<double>{2.0, 3.0}));
    const std::vector<double> c = *model.derivatives(x), h = *model.second_derivatives(x);
    EXPECT_NEAR(c[0], 12.0, 1e-12);  // 2 R I: mW per mA
    EXPECT_NEAR(c[1], 4.0, 1e-12);   // I²: mW per kohm
    EXPECT_NEAR(h[0], 6.0, 1e-12);
    EXPECT_NEAR(h[1], 4.0, 1e-12);
    EXPECT_NEAR(h[2], 4.0, 1e-12);
    EXPECT_NEAR(h[3], 0.0, 1e-12);
}

TEST(BudgetModel, DoesNotGuess) {
    AuditedBudget budget = power_budget();
    budget.rows[1].quantity = "resistance";
    ASSERT_TRUE(BudgetModel::of(budget));
    EXPECT_EQ(BudgetModel::of(budget)->without_row(), (std::vector<std::string>{"R"}));
    EXPECT_FALSE(BudgetModel::of(budget)->can_be_evaluated());
    EXPECT_FALSE(BudgetModel::of(budget)->derivatives({2.0}));

    budget = power_budget();
    budget.unit = "um";  // no power
    EXPECT_FALSE(BudgetModel::of(budget)->can_be_evaluated());
    budget = power_budget();
    budget.rows[0].unit = "clicks";
    EXPECT_FALSE(BudgetModel::of(budget)->can_be_evaluated());
    budget = power_budget();
    budget.rows.push_back(budget.rows[0]);  // two rows for one name
    EXPECT_EQ(BudgetModel::of(budget)->without_row(), (std::vector<std::string>{"I"}));
    for (const char* equation : {"", "P = U*", "the power", "0 = P - R*I^2"}) {
        budget = power_budget();
        budget.equation = equation;
        EXPECT_FALSE(BudgetModel::of(budget)) << equation;
    }
}

TEST(BudgetModel, HasNoDerivativeWhereThereIsNone) {
    AuditedBudget budget = test::budget_of({quantity("x", "0", "1")});
    budget.unit = "1";
    budget.equation = "y = 1/x";
    const BudgetModel model = *BudgetModel::of(budget);
    EXPECT_FALSE(model.derivatives({0.0}));
    EXPECT_FALSE(model.second_derivatives({0.0}));
    EXPECT_TRUE(model.derivatives({1.0}));
}

/// An input that is a sum, as a job states it: three parts, each with a distribution of its own.
AuditedBudget with_parts() {
    AuditedBudget budget =
        test::budget_of({quantity("a, length: certificate", "1.2", "1"), quantity("b", "2.0", "1"),
                         quantity("a, length: drift", "-0.2", "1"), quantity("a, length: resolution", "0.0", "1")});
    budget.unit = "1";
    budget.equation = "y = a*b + exp(a)/b";
    const std::vector<double> u{0.02, 0.1, 0.03, 0.01};
    for (std::size_t i = 0; i < u.size(); ++i) {
        budget.rows[i].used_u = u[i];
        budget.rows[i].part_of = i == 1 ? "" : "a";
    }
    budget.rows[2].shape = Shape::rectangular;
    budget.rows[3].shape = Shape::triangular;
    return budget;
}

TEST(BudgetModel, TakesAllPartsOfAQuantity) {
    AuditedBudget budget = with_parts();
    const std::optional<BudgetModel> model = BudgetModel::of(budget);
    ASSERT_TRUE(model && model->can_be_evaluated());
    ASSERT_EQ(model->quantities(), (std::vector<std::string>{"a", "b"}));
    EXPECT_DOUBLE_EQ(model->estimates(budget)[0], 1.0);
    const std::vector<double> reach = model->reach(budget, 2.0);
    EXPECT_DOUBLE_EQ(reach[0], 2.0 * 0.02 + std::sqrt(3.0) * 0.03 + std::sqrt(6.0) * 0.01);
    EXPECT_DOUBLE_EQ(reach[1], 0.2);
    budget.rows[3].in_sum = false;
    EXPECT_DOUBLE_EQ(model->reach(budget, 2.0)[0], 2.0 * 0.02 + std::sqrt(3.0) * 0.03);
    budget.rows[2].estimate.reset();
    EXPECT_TRUE(std::isnan(model->estimates(budget)[0]));
}

/// Wherever the parts are within their own limits, the equation leaves its tangent by no more than the bound.
TEST(BudgetModel, BoundHoldsForEveryPlaceOfTheParts) {
    std::mt19937 random(20261124);
    std::uniform_real_distribution<double> part(-1.0, 1.0), size(0.2, 5.0);
    for (int trial = 0; trial < 40; ++trial) {
        AuditedBudget budget = with_parts();
        for (AuditedRow& one : budget.rows) {
            one.used_u *= size(random);
            one.estimate->value += 0.1 * part(random);
        }
        const std::optional<BudgetModel> model = BudgetModel::of(budget);
        ASSERT_TRUE(model && model->can_be_evaluated());
        const std::vector<double> x = model->estimates(budget), reach = model->reach(budget, 2.0);
        const gum::OutputBound bound = model->tangent_bound(x, reach);
        ASSERT_TRUE(bound.bound) << bound.why_not;
        const auto f = [](double a, double b) { return a * b + std::exp(a) / b; };
        const std::vector<double> c = *model->derivatives(x);
        const double rounding = 1e-12 * (1.0 + bound.bound->largest());
        double largest = 0.0;
        for (int sample = 0; sample < 500; ++sample) {
            // Each part within its own limits; every fourth time all at an end.
            const auto place = [&] {
                const double at = part(random);
                return sample % 4 == 0 ? std::copysign(1.0, at) : at;
            };
            const double d_a = 2.0 * budget.rows[0].used_u * place() +
                               std::sqrt(3.0) * budget.rows[2].used_u * place() +
                               std::sqrt(6.0) * budget.rows[3].used_u * place();
            const double d_b = 2.0 * budget.rows[1].used_u * place();
            const double left = f(x[0] + d_a, x[1] + d_b) - f(x[0], x[1]) - c[0] * d_a - c[1] * d_b;
            EXPECT_GE(left, bound.bound->low - rounding);
            EXPECT_LE(left, bound.bound->high + rounding);
            largest = std::max(largest, std::abs(left));
        }
        EXPECT_GE(largest, 0.05 * bound.bound->largest()) << "the bound is one of this size";
    }
}

}  // namespace
}  // namespace gumcert::audit
