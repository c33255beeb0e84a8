#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
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
    [[nodiscard]] const SheetFormula* formula_at(const workbook::CellPlace& cell) const {
        return held_.formula_at(cell);
    }
    /// The value of a cell: computed here where we do, else as stored.
    [[nodiscard]] workbook::CellValue value(const workbook::CellPlace& cell) const;
    [[nodiscard]] std::vector<workbook::Area> areas_read(const workbook::CellPlace& cell) const {
        return held_.graph.areas_read(cell);
    }
    /// The cell that a node of a formula refers to by itself; nothing for a range, another workbook or anything else.
    [[nodiscard]] std::optional<workbook::CellPlace> cell_of(const SheetFormula& formula,
                                                             const workbook::FormulaNode& node) const;
    /// The formula that makes the number of a cell: its own, or that of the cell that it passes on ("=Readings!B9"); nullptr
    /// where there is none.
    [[nodiscard]] const SheetFormula* maker_of(const std::string& place) const;
    /// The one cell that a formula reads; nothing where it reads none or several.
    [[nodiscard]] std::optional<workbook::CellPlace> only_cell_read(const workbook::CellPlace& cell) const;
    /// The cells that a formula reads, blank ones too, each once.
    [[nodiscard]] std::vector<workbook::CellPlace> cells_read(const workbook::CellPlace& cell, std::size_t most) const {
        return held_.graph.precedents(cell, most);
    }
    /// How many cells a formula reads, blank ones too, each once.
    [[nodiscard]] std::size_t count_of_read(const workbook::CellPlace& cell, std::size_t most) const {
        return held_.graph.precedents(cell, most).size();
    }
    /// Cells that no formula reads, in order.
    [[nodiscard]] std::vector<workbook::CellPlace> unread_cells() const { return held_.graph.unread_cells(); }
    [[nodiscard]] const std::vector<workbook::SheetIndex>& indexes() const { return held_.graph.indexes(); }
    [[nodiscard]] std::string place(const workbook::CellPlace& cell) const { return held_.place(cell); }
    /// The cell of such a place as "Budget!D5", where it holds anything.
    [[nodiscard]] std::optional<workbook::CellPlace> cell_at(const std::string& place) const {
        return held_.cell_at(place);
    }
    [[nodiscard]] bool stands_under_results(const workbook::CellPlace& cell) const;
    /// The next text above a cell, within 200 rows; "" where there is none.
    [[nodiscard]] std::string head(const workbook::CellPlace& cell) const;
    /// Words that say what a cell is: the texts to its left in the row, and the next text above it, as far as they stand
    /// within 200 columns and rows.
    [[nodiscard]] std::string label(const workbook::CellPlace& cell) const;

private:
    const AuditedWorkbook& held_;
    std::vector<workbook::CellPlace> under_;  ///< on which the claims stand, in order
};

/// Something by which a formula divides its number.
struct FormulaDivision {
    std::optional<double> by;  ///< nothing where it is not known without its readings: √COUNT(…)
    bool by_root = false;      ///< a root was taken of it
};
/// What the number of a formula was divided by: "=0.01/2/SQRT(3)" has 2 and √3, "=SQRT(VAR.S(B2:B7)/6)" has √6. Operands of sums
/// are not looked at: they are parts of the number.
[[nodiscard]] std::vector<FormulaDivision> divisions_in(const WorksheetView& view, const SheetFormula& formula);
/// Whether a node of a formula calls one of some functions, whose names stand in capitals.
[[nodiscard]] bool is_call(const workbook::FormulaNode& node, std::initializer_list<std::string_view> names);
/// Whether a formula calls one of some functions, whose names stand in capitals.
[[nodiscard]] bool calls_one_of(const workbook::Formula& formula, std::initializer_list<std::string_view> names);

/// The walk of a subject; nothing where it has no workbook.
[[nodiscard]] std::optional<WorksheetView> worksheet_of(const AuditSubject& subject);

}  // namespace gumcert::audit
