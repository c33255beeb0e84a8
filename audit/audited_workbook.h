#pragma once

#include <cstddef>
#include <map>
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
    std::string place;  ///< "Budget!D5"
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
    std::vector<SheetFormula> formulas;                ///< those that are understood, sheet by sheet, row by row
    std::map<std::string, workbook::CellPlace> cells;  ///< that hold anything, by their places
    std::map<std::string, std::size_t> formula_at;     ///< positions in `formulas`, by their places
};

}  // namespace gumcert::audit
