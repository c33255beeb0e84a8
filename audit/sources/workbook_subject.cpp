#include "audit/sources/workbook_subject.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "audit/audited_workbook.h"
#include "audit/claims.h"
#include "audit/sources/foreign_table.h"

namespace gumcert::audit {
namespace {

using workbook::CellPlace;

/// Marks the rows that the formula of u_c leaves out.
/// \param under  the cells on which u_c stands, in order
void mark_sum(AuditedBudget& budget, const AuditedWorkbook& held, const std::vector<CellPlace>& under) {
    const auto reached = [&](const AuditedRow& row) {
        for (const std::optional<StatedNumber>* number : {&row.contribution, &row.u, &row.stated}) {
            const std::optional<CellPlace> cell = *number ? held.cell_at((*number)->place) : std::nullopt;
            if (cell && std::binary_search(under.begin(), under.end(), *cell)) {
                return true;
            }
        }
        return false;
    };
    std::size_t in = 0;
    for (const AuditedRow& row : budget.rows) {
        in += reached(row) ? 1U : 0U;
    }
    if (in < 2 || in == budget.rows.size()) {
        return;
    }
    for (AuditedRow& row : budget.rows) {
        row.in_sum = reached(row);
    }
    note_unexplained(budget);
}

void mark_sums(std::vector<AuditedBudget>& budgets, const AuditedWorkbook& held) {
    std::vector<CellPlace> sums;
    std::vector<AuditedBudget*> of;
    for (AuditedBudget& budget : budgets) {
        const std::optional<StatedNumber>& u_c = budget.claims.u_c;
        if (const std::optional<CellPlace> cell = u_c ? held.cell_at(u_c->place) : std::nullopt) {
            sums.push_back(*cell);
            of.push_back(&budget);
        }
    }
    held.graph.each_closure(sums,
                            [&](std::size_t i, const std::vector<CellPlace>& under) { mark_sum(*of[i], held, under); });
}

/// What the file shows is what it claims, also where its formulas give something else.
void take_shown_claims(AuditedBudget& budget, const AuditedWorkbook& held) {
    const ComputedClaims computed{.claims = budget.claims,
                                  .coverage = budget.coverage,
                                  .u_c_over_rows = budget.u_c_over_rows,
                                  .k_over_rows = budget.k_over_rows,
                                  .U_over_k_u_c = budget.U_over_k_u_c};
    Claims& claims = budget.claims;
    bool any = false;
    for (std::optional<StatedNumber>* claim : {&claims.value, &claims.u_c, &claims.nu_eff, &claims.k, &claims.U}) {
        const std::optional<CellPlace> cell = *claim ? held.cell_at((*claim)->place) : std::nullopt;
        if (const std::optional<double> shown = cell ? held.stale_number(*cell) : std::nullopt) {
            (*claim)->value = *shown;
            any = true;
        }
    }
    if (any) {
        budget.computed_claims = computed;
        if (claims.k) {
            budget.coverage = {
                .kind = CoverageRule::Kind::fixed, .k = claims.k->value, .probability = budget.coverage.probability};
        }
        note_claims_beyond_rows(budget);
    }
}

}  // namespace

AuditSubject subject_of(workbook::Workbook workbook, const std::string& name) {
    AuditSubject subject;
    subject.name = name;
    auto held = std::make_shared<const AuditedWorkbook>(std::move(workbook));
    ForeignTables tables = budgets_in(held->workbook, held->evaluation, name);
    subject.budgets = std::move(tables.budgets);
    subject.not_read = std::move(tables.not_read);
    subject.kind = AuditSubject::Kind::table;
    if (!held->evaluation.cells.empty()) {
        subject.kind = AuditSubject::Kind::workbook;
        mark_sums(subject.budgets, *held);
        for (AuditedBudget& budget : subject.budgets) {
            take_shown_claims(budget, *held);
        }
        for (const workbook::NotEvaluated& reason : held->evaluation.reasons) {
            const workbook::Sheet& sheet = held->workbook.sheets[reason.sheet];
            const std::string cell = workbook::sheet_a1(sheet.name, sheet.cells[reason.cell].address);
            const bool names_function = reason.what.find(' ') == std::string::npos;
            subject.not_read.push_back(
                names_function
                    ? say("{cell}: not evaluated here ({function}); the value that the file stored is taken", cell,
                          reason.what)
                    : say("{cell}: not evaluated here ({reason:sentence}); the value that the file stored is taken",
                          cell, reason.what));
        }
        subject.workbook = std::move(held);
    }
    return subject;
}

}  // namespace gumcert::audit
