// A budget with planted faults (examples/audit): every cell is read, and every formula has a value or a reason.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/file_content.h"
#include "tests/support/shown_value.h"
#include "workbook/evaluate.h"
#include "workbook/read_xlsx.h"

namespace gumcert::workbook {
namespace {

Workbook planted() {
    return read_xlsx(
        test::file_content(std::string(GUMCERT_SOURCE_DIR) + "/examples/audit/planted_workbook/planted.xlsx"),
        "planted.xlsx");
}

TEST(PlantedWorkbook, EveryCellIsRead) {
    const Workbook workbook = planted();
    ASSERT_EQ(workbook.sheets.size(), 4U);
    std::vector<std::string> sheets;
    std::size_t formulas = 0;
    for (const Sheet& sheet : workbook.sheets) {
        sheets.push_back(sheet.name + " " + std::to_string(sheet.cells.size()) +
                         (sheet.state == SheetState::visible ? "" : " hidden"));
        for (const Cell& cell : sheet.cells) {
            formulas += cell.formula.empty() ? 0U : 1U;
        }
    }
    // Counted in the XML: elements <c> with a value or a formula, and elements <f>.
    EXPECT_THAT(sheets, testing::ElementsAre("Readings 14", "Standards 19", "Budget 78", "Old 1 hidden"));
    EXPECT_EQ(formulas, 36U);
    EXPECT_EQ(find_cell(workbook.sheets[0], {8, 2})->value.text, "800.0.2") << "a text among readings";
    EXPECT_EQ(find_cell(workbook.sheets[2], {3, 4})->value.text, "1.73");
    EXPECT_EQ(find_cell(workbook.sheets[2], {16, 3})->formula, "'[3]INPUT DATA'!I106");
    EXPECT_EQ(find_cell(workbook.sheets[3], {1, 1})->formula, "#REF!+1");
    EXPECT_EQ(workbook.metadata.application, "Microsoft Excel");
}

TEST(PlantedWorkbook, EveryFormulaHasAValueOrAReason) {
    Workbook workbook = planted();
    const auto value = [&](std::size_t sheet, const std::string& address) {
        const Evaluation evaluation = evaluate_workbook(workbook);
        return test::shown(evaluation, workbook, find_evaluated(evaluation, workbook, sheet, *read_a1(address)));
    };
    EXPECT_EQ(value(0, "D3"), "800.500000") << "of five readings: the sixth is a text";
    EXPECT_EQ(value(2, "E4"), std::to_string(0.05 / std::sqrt(3.0)));
    EXPECT_EQ(value(2, "E5"), std::to_string(0.2 / std::pow(3.0, 0.25))) << "the root is taken twice";
    EXPECT_EQ(value(3, "A1"), "#REF!");
    // From 2024-01-24 to the day of storing, 2026-11-22, are 1033 days.
    EXPECT_EQ(value(2, "C3"), std::to_string(0.024 * 1033 / 12)) << "NOW is the day on which the file was stored";
    EXPECT_EQ(value(2, "C16"), "not evaluated: another workbook");
    std::vector<std::string> not_evaluated;
    const Evaluation evaluation = evaluate_workbook(workbook);
    for (const EvaluatedCell& cell : evaluation.cells) {
        EXPECT_NE(cell.agreement, Agreement::differs);
        if (cell.state == EvaluationState::not_evaluated) {
            not_evaluated.push_back(
                sheet_a1(workbook.sheets[cell.sheet].name, workbook.sheets[cell.sheet].cells[cell.cell].address));
        }
    }
    EXPECT_THAT(not_evaluated, testing::ElementsAre("Budget!C16"));
}

TEST(PlantedWorkbook, IsEvaluatedWithAStoredTime) {
    Workbook workbook = planted();
    Sheet& budget = workbook.sheets[2];
    for (Cell& cell : budget.cells) {
        if (cell.address == CellAddress{3, 3}) {
            cell.value = {.kind = CellKind::number, .number = 0.05};
        }
    }
    const Evaluation evaluation = evaluate_workbook(workbook);
    const double contributions[] = {0.36 / 2,
                                    0.05 / 1.73,
                                    0.05 / std::sqrt(3.0),
                                    0.2 / std::pow(3.0, 0.25),
                                    2e-6 / std::sqrt(6.0) * 100,
                                    0.024 / std::sqrt(3.0) * 2};
    double sum = 0.0;
    for (const double one : contributions) {
        sum += one * one;
    }
    const EvaluatedCell* const combined = find_evaluated(evaluation, workbook, 2, {10, 3});
    EXPECT_EQ(combined->state, EvaluationState::volatile_value);
    EXPECT_NEAR(combined->value.number, std::sqrt(sum), 1e-15);
}

}  // namespace
}  // namespace gumcert::workbook
