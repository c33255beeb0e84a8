#include "workbook/sheet_index.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/support/workbook_of.h"

namespace gumcert::workbook {
namespace {

std::vector<std::string> walked(const SheetIndex& index, const CellRange& range) {
    std::vector<std::string> cells;
    AreaCursor cursor(index, range);
    for (std::uint32_t place = cursor.next(); place != k_no_place; place = cursor.next()) {
        cells.push_back(a1_text(index.sheet().cells[place].address));
    }
    return cells;
}

TEST(SheetIndex, WalksOverTheCellsOfARectangleOnly) {
    const Workbook workbook =
        test::workbook_of({{"A1", "1"}, {"C1", "1"}, {"B2", "1"}, {"A3", "1"}, {"C3", "1"}, {"C9", "1"}});
    const SheetIndex index(workbook.sheets[0]);
    EXPECT_THAT(walked(index, {{1, 1}, {3, 3}}), testing::ElementsAre("A1", "A3", "B2", "C1", "C3"));
    EXPECT_THAT(walked(index, {{2, 2}, {k_most_rows, k_most_columns}}), testing::ElementsAre("B2", "C3", "C9"));
    EXPECT_THAT(walked(index, {{4, 1}, {8, 9}}), testing::IsEmpty());
    EXPECT_EQ(index.last_used(), (CellAddress{9, 3}));
    EXPECT_EQ(index.column_from(2), 1U);
    const Sheet blank;
    EXPECT_EQ(SheetIndex(blank).last_used(), (CellAddress{1, 1}));
}

TEST(SheetIndex, CountsWhatItLookedAt) {
    const Workbook workbook = test::workbook_of({{"A1", "1"}, {"B1", "1"}, {"C1", "1"}});
    const SheetIndex index(workbook.sheets[0]);
    AreaCursor cursor(index, {{5, 1}, {5, 3}});
    EXPECT_EQ(cursor.next(), k_no_place);
    EXPECT_EQ(cursor.take_steps(), 3U) << "three columns without a cell in row 5";
    EXPECT_EQ(cursor.take_steps(), 0U);
}

TEST(UntakenPlaces, SkipsWhatWasTaken) {
    UntakenPlaces places(5);
    for (const std::uint32_t place : {1U, 2U, 3U}) {
        places.take(place);
    }
    EXPECT_EQ(places.first_from(0), 0U);
    EXPECT_EQ(places.first_from(1), 4U);
    places.take(4);
    EXPECT_EQ(places.first_from(2), 5U) << "none";
    for (const std::uint32_t place : {1U, 2U, 3U, 4U}) {
        places.give_back(place);
    }
    EXPECT_EQ(places.first_from(2), 2U);
}

TEST(WorkbookNames, FindsTheNearestDefinition) {
    Workbook workbook = test::workbook_of({});
    workbook.sheets.push_back(test::sheet_of("My data", {}));
    workbook.defined_names = {{.name = "k", .formula = "2", .sheet = {}}, {.name = "K", .formula = "3", .sheet = 1}};
    const WorkbookNames names(workbook);
    EXPECT_EQ(names.sheet("MY DATA"), 1U);
    EXPECT_EQ(names.sheet("other"), k_no_place);
    EXPECT_EQ(names.defined_name("K", 0), 0U);
    EXPECT_EQ(names.defined_name("k", 1), 1U) << "the one of the sheet";
    EXPECT_EQ(names.defined_name("'My data'!k", 0), 1U);
    EXPECT_EQ(names.defined_name("other!k", 0), k_no_place);
    EXPECT_EQ(names.defined_name("nu", 0), k_no_place);
}

}  // namespace
}  // namespace gumcert::workbook
