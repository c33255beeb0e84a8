#include "audit/audited_workbook.h"

#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {

AuditedWorkbook::AuditedWorkbook(workbook::Workbook read)
    : workbook(std::move(read)), evaluation(workbook::evaluate_workbook(workbook)), graph(workbook) {
    for (std::size_t s = 0; s < workbook.sheets.size(); ++s) {
        for (const workbook::Cell& cell : workbook.sheets[s].cells) {
            const workbook::CellPlace at{.sheet = s, .address = cell.address};
            const std::string place = workbook::sheet_a1(workbook.sheets[s].name, cell.address);
            cells.emplace(place, at);
            if (cell.formula.empty()) {
                continue;
            }
            try {
                formulas.push_back(
                    {.cell = at, .place = place, .formula = workbook::parse_formula(cell.formula, place)});
                formula_at[place] = formulas.size() - 1;
            } catch (const gum::DiagnosedError&) {
                // The evaluation names it as not evaluated.
                continue;
            }
        }
    }
}

}  // namespace gumcert::audit
