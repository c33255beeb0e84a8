#include "audit/tables/table_sums.h"
#include "audit/words/column_heads.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gumcert::audit {
namespace {

StatedResult result_of(double value, double half_step) {
    return {.number = {.value = value, .half_step = half_step, .text = "", .place = ""}, .unit = "mg", .column = 2};
}

class TableSumsTest : public ::testing::Test {
protected:
    void SetUp() override {
        heads_.columns = {{Column::quantity, 0}, {Column::u, 2}};
        heads_.all_units = {{2, "mg"}};
    }
    void add(double u) {
        AuditedRow row;
        row.quantity = "row";
        row.u = exact_number(u, "u");
        rows_.push_back(row);
        units_.push_back({.estimate = "", .stated = "", .u = "mg", .sensitivity = "", .contribution = ""});
    }
    TableSums sums() { return {rows_, units_, heads_, statements_}; }

    std::vector<AuditedRow> rows_;
    std::vector<RowUnits> units_;
    Heads heads_;
    Statements statements_;
};

TEST_F(TableSumsTest, AreRootsOfSumsOfSquares) {
    std::mt19937_64 chance(5);
    std::uniform_real_distribution<double> size(0.1, 9.0);
    double squares = 0.0;
    for (int i = 0; i < 12; ++i) {
        const double u = size(chance);
        add(u);
        const double before = std::sqrt(squares);
        squares += u * u;
        const auto all = sums().sum_above(result_of(1.0, 0.0));
        ASSERT_TRUE(all);
        EXPECT_NEAR(all->low, std::sqrt(squares), 1e-9);
        EXPECT_NEAR(all->high, std::sqrt(squares), 1e-9);
        const auto others = sums().sum_above(result_of(1.0, 0.0), true);
        EXPECT_EQ(others.has_value(), i > 0);
        EXPECT_NEAR(others ? others->high : 0.0, before, 1e-9);
    }
    rows_.front().unit = "V";
    EXPECT_FALSE(sums().sum_above(result_of(1.0, 0.0))) << "a row in V has no use of its u in mg";
}

TEST_F(TableSumsTest, AreHeldAgainstWhatIsStated) {
    const Interval five{4.999, 5.001};
    EXPECT_FALSE(sums().gives_statements(five).has_value()) << "nothing is stated";
    sums().state(Statement::U, result_of(10.0, 0.05));
    EXPECT_FALSE(sums().gives_statements(five).has_value()) << "U without a k";
    sums().state(Statement::k, result_of(2.0, 0.0));
    EXPECT_EQ(sums().gives_statements(five), true);
    EXPECT_EQ(sums().gives_statements({5.4, 5.5}), false);
    EXPECT_TRUE(sums().is_stated_u_c(result_of(5.0, 0.05)));
    EXPECT_FALSE(sums().is_stated_u_c(result_of(5.3, 0.05)));
    sums().state(Statement::u_c, result_of(6.0, 0.05));
    EXPECT_EQ(sums().gives_statements(five), false) << "u_c goes before U";
    sums().state(Statement::u_c, result_of(5.0, 0.05));
    EXPECT_EQ(sums().stated(Statement::u_c)->value, 6.0) << "what was stated first stays";
    EXPECT_EQ(sums().stated_of_sum()->number.value, 6.0);
}

TEST_F(TableSumsTest, ShowWhichKMakesUOfASum) {
    const Interval five{4.999, 5.001};
    EXPECT_EQ(sums().k_to(result_of(10.0, 0.05), "Gesamt (k = 2)", five), 2.0);
    EXPECT_EQ(sums().k_to(result_of(10.0, 0.05), "Gesamt", five), 0.0);
    EXPECT_EQ(sums().column_of(Column::u), 2U);
    EXPECT_EQ(sums().column_of(Column::nu), 0U);
}

}  // namespace
}  // namespace gumcert::audit
