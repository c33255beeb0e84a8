#include "audit/tables/named_line.h"

#include <gtest/gtest.h>

#include "workbook/evaluate.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

class NamedLines : public ::testing::Test {
protected:
    explicit NamedLines(const std::string& csv =
                            "U = k·u_c,2,mV\nCurrent,3,A\nx,u_c,0.187\nResult,(10.0020 ± 0.0047) bar\n"
                            "Result,5,1\n")
        : workbook_(workbook::read_csv(csv, "b.csv", "b")),
          evaluation_(workbook::evaluate_workbook(workbook_)),
          sheet_(workbook_, evaluation_, 0, DecimalSign::point) {}

    [[nodiscard]] const SheetView::Row& row(std::uint32_t number) const { return sheet_.rows().at(number); }
    [[nodiscard]] std::optional<NamedLine> line(std::uint32_t number) const {
        return name_of_line(sheet_, row(number), nullptr);
    }

    workbook::Workbook workbook_;
    workbook::Evaluation evaluation_;
    SheetView sheet_;
};

TEST_F(NamedLines, BeginWithTheirNameOrItsSymbol) {
    ASSERT_TRUE(line(1));
    EXPECT_EQ(line(1)->named.statement, Statement::U);
    EXPECT_EQ(line(1)->cell, 0U);
    EXPECT_FALSE(line(2));
    ASSERT_TRUE(line(3));
    EXPECT_EQ(line(3)->named.statement, Statement::u_c);
    EXPECT_EQ(line(3)->cell, 1U);
    EXPECT_EQ(line(3)->from, 2U);
}

TEST_F(NamedLines, MayHaveAValueWithItsUncertainty) {
    const std::optional<ValueWithU> both = value_with_U(sheet_, *row(4)[1], sheet_.words(*row(4)[1]));
    ASSERT_TRUE(both);
    EXPECT_DOUBLE_EQ(both->value.number.value, 10.002);
    EXPECT_DOUBLE_EQ(both->U.number.value, 0.0047);
    EXPECT_EQ(both->value.unit, "bar");
    EXPECT_EQ(both->U.unit, "bar");
    EXPECT_FALSE(value_with_U(sheet_, *row(4)[1], "10.002 bar"));
}

TEST_F(NamedLines, MayHaveTheUnitOneBesideTheirNumber) {
    ASSERT_TRUE(line(5));
    EXPECT_TRUE(is_number_with_one(sheet_, row(5), *line(5)));
    EXPECT_FALSE(is_number_with_one(sheet_, row(1), *line(1)));
}

}  // namespace
}  // namespace gumcert::audit
