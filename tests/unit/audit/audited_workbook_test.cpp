#include "audit/audited_workbook.h"

#include <gtest/gtest.h>

#include "tests/support/workbook_of.h"

namespace gumcert::audit {
namespace {

TEST(AuditedWorkbook, FindsCellsByTheirPlacesAndFormulasByTheirCells) {
    workbook::Workbook two = test::workbook_of({{"A1", "2"}, {"B1", "=A1*2"}, {"C1", "=A1+"}});
    two.sheets.push_back(test::sheet_of("it's 2", {{"A1", "=Sheet1!B1"}}));
    const AuditedWorkbook held(std::move(two));
    for (std::size_t sheet = 0; sheet < held.workbook.sheets.size(); ++sheet) {
        for (const workbook::Cell& cell : held.workbook.sheets[sheet].cells) {
            const workbook::CellPlace at{.sheet = sheet, .address = cell.address};
            EXPECT_EQ(held.cell_at(held.place(at)), at) << held.place(at);
        }
    }
    EXPECT_EQ(held.place({1, {1, 1}}), "'it''s 2'!A1");
    for (const char* const nowhere : {"", "A1", "Sheet1!Z9", "Other!A1", "row 3, u"}) {
        EXPECT_FALSE(held.cell_at(nowhere)) << nowhere;
    }
    ASSERT_EQ(held.formulas.size(), 2U) << "one is not understood";
    for (const SheetFormula& formula : held.formulas) {
        EXPECT_EQ(held.formula_at(formula.cell), &formula);
    }
    EXPECT_EQ(held.formula_at({0, {1, 1}}), nullptr);
    EXPECT_EQ(held.formula_at({0, {1, 3}}), nullptr);
}

}  // namespace
}  // namespace gumcert::audit
