#include "audit/rules/worksheet_view.h"

#include <algorithm>
#include <set>

namespace gumcert::audit {
namespace {

constexpr std::size_t k_most_read = 10'000;

std::set<std::string> places_of_claims(const AuditSubject& subject) {
    std::set<std::string> places;
    for (const AuditedBudget& budget : subject.budgets) {
        for (const std::optional<StatedNumber>* claim :
             {&budget.claims.u_c, &budget.claims.nu_eff, &budget.claims.k, &budget.claims.U, &budget.claims.value}) {
            if (*claim) {
                places.insert((*claim)->place);
            }
        }
    }
    return places;
}

}  // namespace

WorksheetView::WorksheetView(const AuditSubject& subject) : held_(*subject.workbook) {
    std::vector<workbook::CellPlace> results;
    for (const std::string& place : places_of_claims(subject)) {
        if (const auto cell = held_.cells.find(place); cell != held_.cells.end()) {
            results.push_back(cell->second);
        }
    }
    for (const workbook::CellPlace& cell : held_.graph.closure(results)) {
        under_.insert(cell);
    }
}

const SheetFormula* WorksheetView::formula_at(const std::string& place) const {
    const auto found = held_.formula_at.find(place);
    return found == held_.formula_at.end() ? nullptr : &held_.formulas[found->second];
}
const SheetFormula* WorksheetView::formula_at(const workbook::CellPlace& cell) const {
    return formula_at(place(cell));
}

workbook::CellValue WorksheetView::value(const workbook::CellPlace& cell) const {
    const workbook::EvaluatedCell* evaluated =
        workbook::find_evaluated(held_.evaluation, held_.workbook, cell.sheet, cell.address);
    if (evaluated != nullptr && evaluated->state != workbook::EvaluationState::not_evaluated) {
        return evaluated->value;
    }
    const workbook::Cell* stored = workbook::find_cell(held_.workbook.sheets[cell.sheet], cell.address);
    return stored == nullptr ? workbook::CellValue{} : stored->value;
}

std::vector<workbook::CellPlace> WorksheetView::read_by(const workbook::CellPlace& cell) const {
    return held_.graph.precedents(cell, k_most_read);
}

std::string WorksheetView::place(const workbook::CellPlace& cell) const {
    return workbook::sheet_a1(held_.workbook.sheets[cell.sheet].name, cell.address);
}

std::string WorksheetView::label(const workbook::CellPlace& cell) const {
    const workbook::Sheet& sheet = held_.workbook.sheets[cell.sheet];
    std::string words;
    for (std::uint32_t column = 1; column < cell.address.column; ++column) {
        const workbook::Cell* left = workbook::find_cell(sheet, {.row = cell.address.row, .column = column});
        if (left != nullptr && left->value.kind == workbook::CellKind::text) {
            words += left->value.text + " ";
        }
    }
    constexpr std::uint32_t k_farthest = 200;
    for (std::uint32_t up = 1; up < std::min(cell.address.row, k_farthest); ++up) {
        const workbook::Cell* above =
            workbook::find_cell(sheet, {.row = cell.address.row - up, .column = cell.address.column});
        if (above != nullptr && above->formula.empty() && above->value.kind == workbook::CellKind::text) {
            return words + above->value.text;
        }
    }
    return words;
}

std::optional<WorksheetView> worksheet_of(const AuditSubject& subject) {
    return subject.workbook == nullptr ? std::nullopt : std::optional<WorksheetView>(subject);
}

}  // namespace gumcert::audit
