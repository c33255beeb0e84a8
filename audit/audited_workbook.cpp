#include "audit/audited_workbook.h"

#include <algorithm>
#include <string_view>
#include <utility>

#include "gum/quantity/diagnostic.h"

namespace gumcert::audit {

AuditedWorkbook::AuditedWorkbook(workbook::Workbook read)
    : workbook(std::move(read)), evaluation(workbook::evaluate_workbook(workbook)), graph(workbook) {
    for (std::size_t s = 0; s < workbook.sheets.size(); ++s) {
        sheets_.emplace(workbook::quoted_sheet(workbook.sheets[s].name), s);
        for (const workbook::Cell& cell : workbook.sheets[s].cells) {
            if (cell.formula.empty()) {
                continue;
            }
            try {
                formulas.push_back({.cell = {.sheet = s, .address = cell.address},
                                    .formula = workbook::parse_formula(cell.formula, "")});
            } catch (const gum::DiagnosedError&) {
                // The evaluation names it as not evaluated.
                continue;
            }
        }
    }
}

std::string AuditedWorkbook::place(const workbook::CellPlace& cell) const {
    return workbook::sheet_a1(workbook.sheets[cell.sheet].name, cell.address);
}

std::optional<workbook::CellPlace> AuditedWorkbook::cell_at(const std::string& place) const {
    const std::size_t mark = place.rfind('!');
    if (mark == std::string::npos) {
        return std::nullopt;
    }
    const std::string_view text = place;
    const auto sheet = sheets_.find(text.substr(0, mark));
    const std::optional<workbook::CellAddress> address = workbook::read_a1(text.substr(mark + 1));
    if (sheet == sheets_.end() || !address || find_cell(workbook.sheets[sheet->second], *address) == nullptr) {
        return std::nullopt;
    }
    return workbook::CellPlace{.sheet = sheet->second, .address = *address};
}

const SheetFormula* AuditedWorkbook::formula_at(const workbook::CellPlace& cell) const {
    const auto found =
        std::lower_bound(formulas.begin(), formulas.end(), cell,
                         [](const SheetFormula& one, const workbook::CellPlace& wanted) { return one.cell < wanted; });
    return found != formulas.end() && found->cell == cell ? &*found : nullptr;
}

}  // namespace gumcert::audit
