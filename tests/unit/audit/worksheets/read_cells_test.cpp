#include "audit/worksheets/read_cells.h"

#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <random>
#include <set>
#include <string>

#include "audit/rules/registry.h"
#include "tests/support/workbook_of.h"

namespace gumcert::audit {
namespace {

using workbook::CellKind;
using workbook::CellPlace;

AuditSubject subject_of_workbook(const test::Contents& contents) {
    AuditSubject subject;
    subject.kind = AuditSubject::Kind::workbook;
    subject.workbook = std::make_shared<const AuditedWorkbook>(test::workbook_of(contents));
    return subject;
}

/// Numbers, texts and formulas that read areas of them, with gaps.
test::Contents generated_sheet(unsigned seed) {
    std::mt19937 dice(seed);
    const auto below = [&dice](std::uint32_t n) { return static_cast<std::uint32_t>(dice() % n); };
    const auto address = [&below] {
        return workbook::a1_text(workbook::CellAddress{.row = 1 + below(12), .column = 1 + below(5)});
    };
    test::Contents contents;
    for (std::uint32_t row = 1; row <= 12; ++row) {
        for (std::uint32_t column = 1; column <= 5; ++column) {
            if (below(4) != 0) {
                contents.emplace_back(workbook::a1_text(workbook::CellAddress{.row = row, .column = column}),
                                      below(3) == 0 ? "text" : std::to_string(below(100)));
            }
        }
        std::string formula = "=SUM(";
        for (std::uint32_t areas = 1 + below(3); areas > 0; --areas) {
            formula += address() + (below(3) == 0 ? "" : ":" + address()) + (areas > 1 ? "," : ")");
        }
        contents.emplace_back("H" + std::to_string(row), formula);
    }
    return contents;
}

TEST(ReadCells, AreThoseThatTheGraphListsOneByOne) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const AuditSubject subject = subject_of_workbook(generated_sheet(seed));
        const WorksheetView view(subject);
        ReadCells cells(view);
        for (const SheetFormula& formula : view.formulas()) {
            std::set<CellPlace> one_by_one, in_runs;
            std::size_t numbers = 0, texts = 0;
            for (const CellPlace& cell : subject.workbook->graph.precedents(formula.cell, 1000)) {
                const CellKind kind = view.value(cell).kind;
                numbers += kind == CellKind::number ? 1U : 0U;
                texts += kind == CellKind::text ? 1U : 0U;
                if (kind != CellKind::blank) {
                    one_by_one.insert(cell);
                }
            }
            for (const CellRun& run : cells.runs(formula.cell)) {
                numbers -= cells.numbers(run);
                texts -= cells.texts(run);
                for (std::uint32_t at = run.begin; at < run.end; ++at) {
                    EXPECT_TRUE(in_runs.insert(cells.cell(run.sheet, at)).second) << "each once";
                }
                if (const auto text = cells.text(run)) {
                    EXPECT_EQ(view.value(cells.cell(run.sheet, *text)).kind, CellKind::text);
                }
            }
            EXPECT_EQ(in_runs, one_by_one) << view.place(formula.cell) << ", seed " << seed;
            EXPECT_EQ(numbers, 0U);
            EXPECT_EQ(texts, 0U);
            for (const workbook::Area& area : view.areas_read(formula.cell)) {
                std::optional<CellPlace> blank;
                for (std::uint32_t column = area.range.first.column; column <= area.range.last.column; ++column) {
                    for (std::uint32_t row = area.range.first.row; row <= area.range.last.row && !blank; ++row) {
                        const CellPlace cell{area.sheet, {row, column}};
                        blank = view.value(cell).kind == CellKind::blank ? std::optional(cell) : std::nullopt;
                    }
                }
                EXPECT_EQ(cells.blank(area), blank) << view.place(formula.cell) << ", seed " << seed;
            }
        }
        EXPECT_TRUE(cells.is_complete());
    }
}

TEST(ReadCells, FirstReadersAreThoseOfEachCell) {
    for (unsigned seed = 1; seed <= 40; ++seed) {
        const AuditSubject subject = subject_of_workbook(generated_sheet(seed));
        const WorksheetView view(subject);
        ReadCells cells(view);
        FirstReaders first;
        std::map<std::uint32_t, std::size_t> reader_of;  // places of the index
        std::size_t reader = 0;
        for (const SheetFormula& formula : view.formulas()) {
            for (const CellRun& run : cells.runs(formula.cell)) {
                std::optional<std::uint32_t> expected;
                for (std::uint32_t at = run.begin; at < run.end && !expected; ++at) {
                    const CellPlace cell = cells.cell(run.sheet, at);
                    if (reader_of.contains(at) && view.value(cell).kind == CellKind::number &&
                        view.formula_at(cell) == nullptr) {
                        expected = at;
                    }
                }
                const std::optional<FirstReaders::Shared> shared = first.shared(cells, run);
                ASSERT_EQ(shared.has_value(), expected.has_value()) << "seed " << seed;
                if (shared) {
                    EXPECT_EQ(shared->at, *expected);
                    EXPECT_EQ(shared->reader, reader_of.at(*expected));
                }
                first.add(run, reader);
                for (std::uint32_t at = run.begin; at < run.end; ++at) {
                    reader_of.emplace(at, reader);
                }
                ++reader;
            }
        }
    }
}

TEST(ReadCells, SaysWhereItHandsOutNoMore) {
    const AuditSubject subject = subject_of_workbook({{"A1", "1"}, {"B1", "=A1"}, {"C1", "=A1+B1"}});
    const WorksheetView view(subject);
    ReadCells cells(view, 2);
    EXPECT_EQ(cells.runs({0, *workbook::read_a1("B1")}).size(), 1U);
    EXPECT_TRUE(cells.is_complete());
    EXPECT_TRUE(cells.runs({0, *workbook::read_a1("C1")}).empty());
    EXPECT_FALSE(cells.is_complete());
}

}  // namespace
}  // namespace gumcert::audit
