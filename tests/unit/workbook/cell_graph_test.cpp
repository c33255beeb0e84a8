#include "workbook/cell_graph.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "tests/support/workbook_of.h"

namespace gumcert::workbook {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

std::vector<std::string> texts_of(const Workbook& workbook, const std::vector<CellPlace>& cells) {
    std::vector<std::string> texts;
    for (const CellPlace& cell : cells) {
        texts.push_back((cell.sheet == 0 ? "" : workbook.sheets[cell.sheet].name + "!") + a1_text(cell.address));
    }
    return texts;
}

CellPlace at(const std::string& address, std::size_t sheet = 0) {
    return {sheet, *read_a1(address)};
}

Workbook budget() {
    Workbook workbook = test::workbook_of({{"A1", "0.36"},
                                           {"B1", "2"},
                                           {"C1", "=A1/B1"},
                                           {"A2", "0.05"},
                                           {"B2", "=SQRT(3)"},
                                           {"C2", "=A2/B2"},
                                           {"A3", "7"},
                                           {"C3", "=A3*2"},
                                           {"C5", "=SQRT(SUMSQ(C1:C2,C4))"},
                                           {"C6", "=k*C5+Other!A1"}});
    workbook.sheets.push_back(test::sheet_of("Other", {{"A1", "=Sheet1!$A$2"}, {"A2", "5"}}));
    workbook.defined_names = {{.name = "k", .formula = "k_factor", .sheet = {}},
                              {.name = "k_factor", .formula = "Other!$A$2", .sheet = {}}};
    return workbook;
}

TEST(CellGraph, SaysWhatAFormulaReads) {
    const Workbook workbook = budget();
    const CellGraph graph(workbook);
    EXPECT_TRUE(graph.is_complete());
    EXPECT_THAT(texts_of(workbook, graph.precedents(at("C5"), 10)), ElementsAre("C1", "C2", "C4"))
        << "a blank cell as well";
    EXPECT_THAT(texts_of(workbook, graph.precedents(at("C5"), 2)), ElementsAre("C1", "C2"));
    EXPECT_THAT(texts_of(workbook, graph.precedents(at("C6"), 10)), ElementsAre("C5", "Other!A1", "Other!A2"))
        << "through two names";
    EXPECT_THAT(graph.precedents(at("A1"), 10), IsEmpty());
    EXPECT_EQ(graph.areas_read(at("C5")).at(0).range, (CellRange{{1, 3}, {2, 3}}));
}

TEST(CellGraph, SaysWhoReadsACell) {
    const Workbook workbook = budget();
    const CellGraph graph(workbook);
    EXPECT_THAT(texts_of(workbook, graph.dependents(at("A2"))), ElementsAre("C2", "Other!A1"));
    EXPECT_THAT(texts_of(workbook, graph.dependents(at("C2"))), ElementsAre("C5"));
    EXPECT_THAT(texts_of(workbook, graph.dependents(at("C4"))), ElementsAre("C5")) << "a blank one";
    EXPECT_THAT(texts_of(workbook, graph.dependents(at("A2", 1))), ElementsAre("C6"));
    EXPECT_THAT(graph.dependents(at("C3")), IsEmpty());
}

TEST(CellGraph, FindsWhatResultsStandOn) {
    const Workbook workbook = budget();
    const CellGraph graph(workbook);
    const std::array results{at("C6")};
    EXPECT_THAT(texts_of(workbook, graph.closure(results)),
                ElementsAre("A1", "B1", "C1", "A2", "B2", "C2", "C5", "C6", "Other!A1", "Other!A2"));
    EXPECT_THAT(texts_of(workbook, graph.dead_cells(results)), ElementsAre("C3"));
    EXPECT_THAT(texts_of(workbook, graph.unread_cells()), ElementsAre("C3", "C6"));
}

TEST(CellGraph, ClosuresOfSeveralResultsEndAtEachOther) {
    const Workbook workbook =
        test::workbook_of({{"A1", "1"}, {"B1", "=A1"}, {"C1", "=B1+D1"}, {"D1", "=E1"}, {"E1", "2"}});
    const CellGraph graph(workbook);
    std::vector<std::vector<std::string>> told;
    graph.each_closure(
        std::vector{at("C1"), at("B1"), at("C1")},
        [&](std::size_t, const std::vector<CellPlace>& cells) { told.push_back(texts_of(workbook, cells)); });
    ASSERT_EQ(told.size(), 3U);
    EXPECT_THAT(told[0], ElementsAre("B1", "C1", "D1", "E1"));
    EXPECT_THAT(told[1], ElementsAre("A1", "B1"));
    EXPECT_EQ(told[2], told[0]) << "nothing is left of the others";
}

TEST(CellGraph, LeavesOutWhatItCannotFollow) {
    const Workbook workbook =
        test::workbook_of({{"A1", "=[1]Old!B2+Sheet1:Sheet1!B3+Nowhere!B4"}, {"A2", "=B5+"}, {"A3", "=A4"}});
    const CellGraph graph(workbook);
    EXPECT_FALSE(graph.is_complete());
    EXPECT_THAT(graph.precedents(at("A1"), 9), IsEmpty());
    EXPECT_THAT(texts_of(workbook, graph.precedents(at("A3"), 9)), ElementsAre("A4"));
    const Workbook other = budget();
    EXPECT_FALSE(CellGraph(other, 1).is_complete());
}

TEST(CellGraph, TakesLinearTimeForRangesOverTheSameCells) {
    test::Contents contents;
    for (int row = 1; row <= 20'000; ++row) {
        contents.emplace_back("A" + std::to_string(row), "=SUM(B$1:B$20000,A$1:A$20000)");
        contents.emplace_back("B" + std::to_string(row), "1");
    }
    const Workbook workbook = test::workbook_of(contents);
    const CellGraph graph(workbook);
    const std::array results{at("A1")};
    EXPECT_EQ(graph.closure(results).size(), 40'000U);  // 8e8 pairs of a formula and a cell
    EXPECT_THAT(graph.unread_cells(), IsEmpty());
}

}  // namespace
}  // namespace gumcert::workbook
