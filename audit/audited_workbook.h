#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "workbook/cell_graph.h"
#include "workbook/evaluate.h"
#include "workbook/formula.h"
#include "workbook/workbook.h"

namespace gumcert::audit {

/// A formula of a workbook, read into a tree.
struct SheetFormula {
    workbook::CellPlace cell;
    workbook::Formula formula;
};

/// A workbook with all that is worked out of its formulas: once, for whoever looks at it. It is not moved or copied,
/// because the graph refers to the workbook.
struct AuditedWorkbook {
    explicit AuditedWorkbook(workbook::Workbook read);
    AuditedWorkbook(const AuditedWorkbook&) = delete;
    AuditedWorkbook& operator=(const AuditedWorkbook&) = delete;

    workbook::Workbook workbook;
    workbook::Evaluation evaluation;
    workbook::CellGraph graph;
    std::vector<SheetFormula> formulas;  ///< those that are understood, sheet by sheet, row by row

    /// "Budget!D5".
    [[nodiscard]] std::string place(const workbook::CellPlace& cell) const;
    /// The cell of such a place, where it holds anything.
    [[nodiscard]] std::optional<workbook::CellPlace> cell_at(const std::string& place) const;
    /// The formula of a cell; nullptr where it has none that is understood.
    [[nodiscard]] const SheetFormula* formula_at(const workbook::CellPlace& cell) const;
    /// The number that the file shows in a cell, where its formula gives another one (to 1e-6, and beyond what the digits of
    /// the numbers that it reads leave of their difference). Nothing for functions that are volatile or not evaluated, where
    /// nothing is stored, and where the formula gives an error.
    [[nodiscard]] std::optional<double> stale_number(const workbook::CellPlace& cell) const;

private:
    /// The number of a cell: computed, or as stored.
    [[nodiscard]] double number_in(const workbook::CellPlace& cell) const;

    std::map<std::string, std::size_t, std::less<>> sheets_;  ///< by their names as formulas write them
};

}  // namespace gumcert::audit
