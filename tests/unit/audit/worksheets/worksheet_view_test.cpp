#include "audit/worksheets/worksheet_view.h"

#include <gtest/gtest.h>

#include <memory>

#include "tests/support/workbook_of.h"

namespace gumcert::audit {
namespace {

using workbook::CellKind;
using workbook::CellPlace;

/// A budget of two rows: its result stands in B4, which D4 rounds; nothing reads B5.
AuditSubject small_worksheet() {
    AuditSubject subject;
    subject.kind = AuditSubject::Kind::workbook;
    subject.workbook = std::make_shared<const AuditedWorkbook>(test::workbook_of({{"A1", "contribution"},
                                                                                  {"B1", "u in nm"},
                                                                                  {"A2", "standard"},
                                                                                  {"B2", "3"},
                                                                                  {"A3", "reading"},
                                                                                  {"B3", "4"},
                                                                                  {"A4", "combined"},
                                                                                  {"B4", "=SQRT(SUMSQ(B2:B3))"},
                                                                                  {"D4", "=ROUND(B4,0)"},
                                                                                  {"B5", "7"},
                                                                                  {"B6", "=2*B5+D4"}}));
    AuditedBudget& budget = subject.budgets.emplace_back();
    budget.claims.u_c = StatedNumber{.value = 5.0, .half_step = 0.5, .text = "5", .place = "Sheet1!D4"};
    return subject;
}

CellPlace cell(const char* address) {
    return {0, *workbook::read_a1(address)};
}

TEST(WorksheetView, IsOfAWorkbookOnly) {
    EXPECT_FALSE(worksheet_of(AuditSubject{}));
    const AuditSubject subject = small_worksheet();
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ASSERT_TRUE(view);
    EXPECT_EQ(view->workbook().sheets.size(), 1U);
    EXPECT_EQ(view->formulas().size(), 3U);
}

TEST(WorksheetView, FindsFormulasByPlace) {
    const AuditSubject subject = small_worksheet();
    const WorksheetView view(subject);
    ASSERT_NE(view.formula_at("Sheet1!B4"), nullptr);
    EXPECT_EQ(view.formula_at("Sheet1!B4"), view.formula_at(cell("B4")));
    EXPECT_EQ(view.formula_at("Sheet1!B2"), nullptr) << "a number";
    EXPECT_EQ(view.formula_at("Elsewhere!B4"), nullptr) << "no such sheet";
    EXPECT_EQ(view.formula_at("row 4"), nullptr) << "no address";
}

TEST(WorksheetView, ValuesAreComputedOrThoseOfTheFile) {
    const AuditSubject subject = small_worksheet();
    const WorksheetView view(subject);
    EXPECT_DOUBLE_EQ(view.value(cell("B4")).number, 5.0);
    EXPECT_DOUBLE_EQ(view.value(cell("B2")).number, 3.0);
    EXPECT_EQ(view.value(cell("A2")).text, "standard");
    EXPECT_EQ(view.value(cell("Z99")).kind, CellKind::blank);
}

TEST(WorksheetView, TellsWhatACellReads) {
    const AuditSubject subject = small_worksheet();
    const WorksheetView view(subject);
    EXPECT_EQ(view.only_cell_read(cell("D4")), cell("B4"));
    EXPECT_FALSE(view.only_cell_read(cell("B4"))) << "an area of two";
    EXPECT_FALSE(view.only_cell_read(cell("B6"))) << "two cells";
    EXPECT_FALSE(view.only_cell_read(cell("B2"))) << "none";
    EXPECT_EQ(view.count_of_read(cell("B4"), 100), 2U);
}

TEST(WorksheetView, ResultsStandOnWhatTheyRead) {
    const AuditSubject subject = small_worksheet();
    const WorksheetView view(subject);
    for (const char* const address : {"B2", "B3", "B4"}) {
        EXPECT_TRUE(view.stands_under_results(cell(address))) << address;
    }
    for (const char* const address : {"B5", "B6", "A2"}) {
        EXPECT_FALSE(view.stands_under_results(cell(address))) << address;
    }
}

TEST(WorksheetView, LabelsAreTextsToTheLeftAndTheNextAbove) {
    const AuditSubject subject = small_worksheet();
    const WorksheetView view(subject);
    EXPECT_EQ(view.label(cell("B3")), "reading u in nm");
    EXPECT_EQ(view.label(cell("B5")), "u in nm");
    EXPECT_EQ(view.label(cell("D4")), "combined ");
}

}  // namespace
}  // namespace gumcert::audit
