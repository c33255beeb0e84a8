#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "audit/audited_workbook.h"
#include "audit/subject.h"
#include "workbook/cell_graph.h"

namespace gumcert::audit {

/// A workbook as the rules of worksheets walk over it.
class WorksheetView {
public:
    /// \param subject  with a workbook
    explicit WorksheetView(const AuditSubject& subject);

    [[nodiscard]] const workbook::Workbook& workbook() const { return held_.workbook; }
    [[nodiscard]] const std::vector<SheetFormula>& formulas() const { return held_.formulas; }
    /// The formula of a cell; nullptr where it has none that was understood.
    [[nodiscard]] const SheetFormula* formula_at(const std::string& place) const;
    [[nodiscard]] const SheetFormula* formula_at(const workbook::CellPlace& cell) const;
    /// The value of a cell: computed here where we do, else as stored.
    [[nodiscard]] workbook::CellValue value(const workbook::CellPlace& cell) const;
    /// Cells that a formula reads, each once, blank ones too, up to 10 000.
    [[nodiscard]] std::vector<workbook::CellPlace> read_by(const workbook::CellPlace& cell) const;
    [[nodiscard]] std::vector<workbook::Area> areas_read(const workbook::CellPlace& cell) const {
        return held_.graph.areas_read(cell);
    }
    [[nodiscard]] std::string place(const workbook::CellPlace& cell) const;
    [[nodiscard]] bool stands_under_results(const workbook::CellPlace& cell) const { return under_.contains(cell); }
    /// Words that say what a cell is: the texts to its left in the row, and the next text above it.
    [[nodiscard]] std::string label(const workbook::CellPlace& cell) const;

private:
    const AuditedWorkbook& held_;
    std::set<workbook::CellPlace> under_;  ///< on which the claims stand
};

/// The walk of a subject; nothing where it has no workbook.
[[nodiscard]] std::optional<WorksheetView> worksheet_of(const AuditSubject& subject);

}  // namespace gumcert::audit
