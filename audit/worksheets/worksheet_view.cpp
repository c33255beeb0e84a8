#include "audit/worksheets/worksheet_view.h"

#include <algorithm>
#include <cmath>
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

/// A number that a node is by itself: one that is written, that of a cell, or a root, power, product or quotient of such.
std::optional<double> constant_of(const WorksheetView& view, const SheetFormula& formula,
                                  const workbook::FormulaNode& node) {
    using Kind = workbook::FormulaNodeKind;
    if (node.kind == Kind::number) {
        return node.number;
    }
    if (const std::optional<workbook::CellPlace> cell = view.cell_of(formula, node)) {
        const workbook::CellValue value = view.value(*cell);
        return value.kind == workbook::CellKind::number ? std::optional(value.number) : std::nullopt;
    }
    std::vector<double> operands;
    for (const std::uint32_t child : formula.formula.children_of(node)) {
        const std::optional<double> operand = constant_of(view, formula, formula.formula.nodes[child]);
        if (!operand) {
            return std::nullopt;
        }
        operands.push_back(*operand);
    }
    const bool two = operands.size() == 2;
    if (node.kind == Kind::call && node.text == "SQRT" && operands.size() == 1) {
        return std::sqrt(operands[0]);
    }
    if (two && node.kind == Kind::power) {
        return std::pow(operands[0], operands[1]);
    }
    if (two && node.kind == Kind::multiply) {
        return operands[0] * operands[1];
    }
    return two && node.kind == Kind::divide ? std::optional(operands[0] / operands[1]) : std::nullopt;
}

bool is_root(const WorksheetView& view, const SheetFormula& formula, const workbook::FormulaNode& node) {
    if (node.kind == workbook::FormulaNodeKind::call) {
        return node.text == "SQRT";
    }
    return node.kind == workbook::FormulaNodeKind::power &&
           constant_of(view, formula, formula.formula.nodes[formula.formula.children_of(node)[1]]) == 0.5;
}

/// Walks down from what a formula gives, through all that multiplies and chooses.
/// \param exponent  of the node in the number of the formula: 1/2 below a root
void add_divisions(const WorksheetView& view, const SheetFormula& formula, const workbook::FormulaNode& node,
                   double exponent, std::vector<FormulaDivision>& divisions) {
    using Kind = workbook::FormulaNodeKind;
    const auto operands = formula.formula.children_of(node);
    const auto operand = [&](std::size_t i) -> const workbook::FormulaNode& {
        return formula.formula.nodes[operands[i]];
    };
    if (node.kind == Kind::divide && operands.size() == 2) {
        const std::optional<double> by = constant_of(view, formula, operand(1));
        divisions.push_back({.by = by ? std::optional(std::pow(*by, exponent)) : std::nullopt,
                             .by_root = exponent == 0.5 || is_root(view, formula, operand(1))});
        add_divisions(view, formula, operand(0), exponent, divisions);
        return;
    }
    const bool below_root = is_root(view, formula, node);
    if (node.kind != Kind::multiply && node.kind != Kind::call && !workbook::is_sign(node.kind) && !below_root) {
        return;
    }
    for (std::size_t i = 0; i < (node.kind == Kind::power ? 1U : operands.size()); ++i) {
        add_divisions(view, formula, operand(i), below_root ? 0.5 * exponent : exponent, divisions);
    }
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

std::optional<workbook::CellPlace> WorksheetView::cell_of(const SheetFormula& formula,
                                                          const workbook::FormulaNode& node) const {
    if (node.kind != workbook::FormulaNodeKind::reference) {
        return std::nullopt;
    }
    const workbook::Reference& reference = formula.formula.references[node.reference];
    if (!reference.workbook.empty() || reference.shape != workbook::ReferenceShape::cell ||
        !reference.last_sheet.empty()) {
        return std::nullopt;
    }
    workbook::CellPlace cell{.sheet = formula.cell.sheet, .address = reference.first.address};
    if (!reference.sheet.empty()) {
        const std::optional<std::size_t> sheet = workbook::find_sheet(held_.workbook, reference.sheet);
        if (!sheet) {
            return std::nullopt;
        }
        cell.sheet = *sheet;
    }
    return cell;
}

const SheetFormula* WorksheetView::maker_of(const std::string& place) const {
    constexpr int k_most_passed_on = 8;  // more, and a circle, are followed no further
    const SheetFormula* formula = formula_at(place);
    for (int i = 0; formula != nullptr && i < k_most_passed_on; ++i) {
        const std::optional<workbook::CellPlace> passed_on =
            cell_of(*formula, formula->formula.nodes[formula->formula.root()]);
        const SheetFormula* next = passed_on ? formula_at(*passed_on) : nullptr;
        if (next == nullptr) {
            break;
        }
        formula = next;
    }
    return formula;
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
    return words + head(cell);
}

std::string WorksheetView::head(const workbook::CellPlace& cell) const {
    const std::vector<workbook::Cell>& cells = held_.workbook.sheets[cell.sheet].cells;
    const workbook::SheetIndex& index = held_.graph.indexes()[cell.sheet];
    const std::size_t at = index.column_from(cell.address.column);
    if (at == index.columns().size() || index.columns()[at].column != cell.address.column) {
        return "";
    }
    const workbook::SheetIndex::Column& column = index.columns()[at];
    for (std::uint32_t place = index.place_from(column, cell.address.row); place-- > column.begin;) {
        const workbook::Cell& above = cells[index.places()[place]];
        if (cell.address.row - above.address.row >= k_farthest) {
            break;
        }
        if (above.formula.empty() && above.value.kind == workbook::CellKind::text) {
            return above.value.text;
        }
    }
    return "";
}

std::vector<FormulaDivision> divisions_in(const WorksheetView& view, const SheetFormula& formula) {
    std::vector<FormulaDivision> divisions;
    add_divisions(view, formula, formula.formula.nodes[formula.formula.root()], 1.0, divisions);
    return divisions;
}

bool is_call(const workbook::FormulaNode& node, std::initializer_list<std::string_view> names) {
    return node.kind == workbook::FormulaNodeKind::call &&
           std::find(names.begin(), names.end(), node.text) != names.end();
}

bool calls_one_of(const workbook::Formula& formula, std::initializer_list<std::string_view> names) {
    return std::any_of(formula.nodes.begin(), formula.nodes.end(),
                       [&names](const workbook::FormulaNode& node) { return is_call(node, names); });
}

std::optional<WorksheetView> worksheet_of(const AuditSubject& subject) {
    return subject.workbook == nullptr ? std::nullopt : std::optional<WorksheetView>(subject);
}

}  // namespace gumcert::audit
