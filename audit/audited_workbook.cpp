#include "audit/audited_workbook.h"

#include <algorithm>
#include <cmath>
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

double AuditedWorkbook::number_in(const workbook::CellPlace& cell) const {
    const workbook::EvaluatedCell* computed = workbook::find_evaluated(evaluation, workbook, cell.sheet, cell.address);
    const workbook::Cell* stored = find_cell(workbook.sheets[cell.sheet], cell.address);
    const bool is_computed = computed != nullptr && computed->state == workbook::EvaluationState::evaluated;
    const workbook::CellValue value = is_computed         ? computed->value
                                      : stored != nullptr ? stored->value
                                                          : workbook::CellValue{};
    return value.kind == workbook::CellKind::number ? value.number : 0.0;
}

std::optional<double> AuditedWorkbook::stale_number(const workbook::CellPlace& cell) const {
    constexpr double k_other_number = 1e-6, k_cancelled = 1e-12;
    constexpr std::size_t k_most_read = 1000;
    using workbook::CellKind;
    const workbook::EvaluatedCell* computed = workbook::find_evaluated(evaluation, workbook, cell.sheet, cell.address);
    const workbook::Cell* stored = find_cell(workbook.sheets[cell.sheet], cell.address);
    if (computed == nullptr || stored == nullptr || computed->state != workbook::EvaluationState::evaluated ||
        computed->agreement != workbook::Agreement::differs || stored->value.kind != CellKind::number) {
        return std::nullopt;
    }
    if (computed->value.kind != CellKind::number) {
        return std::nullopt;
    }
    const double shown = stored->value.number, given = computed->value.number;
    double open = k_other_number * std::max(std::abs(shown), std::abs(given));
    // What is left of a difference of large numbers is their last bits.
    for (const workbook::CellPlace& read : graph.precedents(cell, k_most_read)) {
        open = std::max(open, k_cancelled * std::abs(number_in(read)));
    }
    return std::abs(shown - given) > open ? std::optional(shown) : std::nullopt;
}

}  // namespace gumcert::audit
