#include "workbook/workbook.h"

#include <gtest/gtest.h>

#include "tests/support/workbook_of.h"

namespace gumcert::workbook {
namespace {

TEST(CellAddresses, HaveLettersForColumnsAndNumbersForRows) {
    EXPECT_EQ(column_letters(1), "A");
    EXPECT_EQ(column_letters(26), "Z");
    EXPECT_EQ(column_letters(27), "AA");
    EXPECT_EQ(column_letters(702), "ZZ");
    EXPECT_EQ(column_letters(703), "AAA");
    EXPECT_EQ(column_letters(k_most_columns), "XFD");
    EXPECT_EQ(a1_text(CellAddress{.row = 5, .column = 2}), "B5");
    EXPECT_EQ(a1_text(CellRange{{2, 2}, {9, 3}}), "B2:C9");
    EXPECT_EQ(a1_text(CellRange{{2, 2}, {2, 2}}), "B2");
}

TEST(CellAddresses, AreReadBackFromTheirText) {
    for (const std::uint32_t column : {1U, 26U, 27U, 52U, 702U, 703U, 16384U}) {
        const CellAddress address{.row = column * 60 + 1, .column = column};
        EXPECT_EQ(read_a1(a1_text(address)), address) << a1_text(address);
    }
    EXPECT_EQ(read_a1("$B$5"), (CellAddress{5, 2}));
    EXPECT_EQ(read_a1("xfd1048576"), (CellAddress{k_most_rows, k_most_columns}));
    for (const char* const none :
         {"", "B", "5", "5B", "B0", "B05", "XFE1", "A1048577", "AAAA1", "B5x", "B-5", "$$B5", "B5:C6"}) {
        EXPECT_FALSE(read_a1(none)) << none;
    }
}

TEST(CellAddresses, AreOrderedRowByRow) {
    EXPECT_LT((CellAddress{1, 9}), (CellAddress{2, 1}));
    EXPECT_LT((CellAddress{2, 1}), (CellAddress{2, 2}));
}

TEST(SheetNames, StandInQuotesWhereFormulasNeedThem) {
    EXPECT_EQ(quoted_sheet("Budget_2"), "Budget_2");
    EXPECT_EQ(quoted_sheet("My sheet"), "'My sheet'");
    EXPECT_EQ(quoted_sheet("Bob's"), "'Bob''s'");
    EXPECT_EQ(quoted_sheet("2024"), "'2024'");
    EXPECT_EQ(quoted_sheet("AB12"), "'AB12'") << "it would be read as a cell";
    EXPECT_EQ(quoted_sheet(""), "''");
    EXPECT_EQ(sheet_a1("Budget", {5, 2}), "Budget!B5");
}

TEST(ErrorValues, HaveTheWordsOfSpreadsheets) {
    for (const char* const word : {"#NULL!", "#DIV/0!", "#VALUE!", "#REF!", "#NAME?", "#NUM!", "#N/A"}) {
        ASSERT_TRUE(read_error(word)) << word;
        EXPECT_EQ(error_text(*read_error(word)), word);
    }
    EXPECT_EQ(read_error("#SPILL!"), CellError::other);
    EXPECT_FALSE(read_error("N/A"));
}

TEST(Workbooks, FindCellsAndSheets) {
    Workbook workbook = test::workbook_of({{"B1", "1"}, {"A2", "2"}, {"C2", "3"}});
    workbook.sheets.push_back(test::sheet_of("Budget", {}));
    EXPECT_EQ(find_cell(workbook.sheets[0], {2, 3})->value.number, 3.0);
    EXPECT_EQ(find_cell(workbook.sheets[0], {2, 2}), nullptr);
    EXPECT_EQ(find_cell(workbook.sheets[1], {1, 1}), nullptr);
    EXPECT_EQ(find_sheet(workbook, "BUDGET"), 1U);
    EXPECT_FALSE(find_sheet(workbook, "budget2"));
}

}  // namespace
}  // namespace gumcert::workbook
