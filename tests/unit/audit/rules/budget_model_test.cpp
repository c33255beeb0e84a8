#include "audit/rules/budget_model.h"

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace gumcert::audit
