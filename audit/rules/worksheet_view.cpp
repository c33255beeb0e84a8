#include "audit/rules/worksheet_view.h"

#include <algorithm>
#include <set>

namespace gumcert::audit {
namespace {

constexpr std::uint32_t k_farthest = 200;  ///< rows or columns from a label to what it names

std::set<std::string> places_of_claims(const AuditSubject& subject) {
    std::set<std::string> places;
    for (const AuditedBudget& budget : subject.budgets) {
        for (const std::optional<StatedNumber>* claim :
             {&budget.claims.u_c, &budget.claims.nu_eff, &budget.claims.k, &budget.claims.U, &budget.claims.value}) {
            if (*claim) {
                places.insert((*claim)->place);
            }
        }
        const BrokenClaims& broken = budget.claims.broken;
        for (const std::string* place : {&broken.u_c, &broken.nu_eff, &broken.k, &broken.U, &broken.value}) {
            if (!place->empty()) {
                places.insert(*place);
            }
        }
    }
    return places;
}

}  // namespace

WorksheetView::WorksheetView(const AuditSubject& subject) : held_(*subject.workbook) {
    std::vector<workbook::CellPlace> results;
    for (const std::string& place : places_of_claims(subject)) {
        if (const std::optional<workbook::CellPlace> cell = held_.cell_at(place)) {
            results.push_back(*cell);
        }
    }
    under_ = held_.graph.closure(results);
}

const SheetFormula* WorksheetView::formula_at(const std::string& place) const {
    const std::optional<workbook::CellPlace> cell = held_.cell_at(place);
    return cell ? held_.formula_at(*cell) : nullptr;
}

bool WorksheetView::stands_under_results(const workbook::CellPlace& cell) const {
    return std::binary_search(under_.begin(), under_.end(), cell);
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

std::optional<workbook::CellPlace> WorksheetView::only_cell_read(const workbook::CellPlace& cell) const {
    const std::vector<workbook::Area> areas = held_.graph.areas_read(cell);
    if (areas.empty()) {
        return std::nullopt;
    }
    const workbook::Area& first = areas.front();
    const bool is_one = first.range.first == first.range.last &&
                        std::all_of(areas.begin(), areas.end(), [&first](const workbook::Area& other) {
                            return other.sheet == first.sheet && other.range == first.range;
                        });
    return is_one ? std::optional(workbook::CellPlace{first.sheet, first.range.first}) : std::nullopt;
}

std::string WorksheetView::label(const workbook::CellPlace& cell) const {
    const std::vector<workbook::Cell>& cells = held_.workbook.sheets[cell.sheet].cells;
    const workbook::CellAddress leftmost{.row = cell.address.row,
                                         .column = cell.address.column - std::min(cell.address.column - 1, k_farthest)};
    std::string words;
    for (auto left = std::lower_bound(
             cells.begin(), cells.end(), leftmost,
             [](const workbook::Cell&one, const workbook::CellAddress&wanted) { return one.address < wanted; });
         left != cells.end() && left->address < cell.address; ++left) {
        words += left->value.kind == workbook::CellKind::text ? left->value.text + " " : "";
    }
    const workbook::SheetIndex& index = held_.graph.indexes()[cell.sheet];
    const std::size_t at = index.column_from(cell.address.column);
    if (at == index.columns().size() || index.columns()[at].column != cell.address.column) {
        return words;
    }
    const workbook::SheetIndex::Column& column = index.columns()[at];
    for (std::uint32_t place = index.place_from(column, cell.address.row); place-- > column.begin;) {
        const workbook::Cell& above = cells[index.places()[place]];
        if (cell.address.row - above.address.row >= k_farthest) {
            break;
        }
        if (above.formula.empty() && above.value.kind == workbook::CellKind::text) {
            return words + above.value.text;
        }
    }
    return words;
}

std::optional<WorksheetView> worksheet_of(const AuditSubject& subject) {
    return subject.workbook == nullptr ? std::nullopt : std::optional<WorksheetView>(subject);
}

}  // namespace gumcert::audit
