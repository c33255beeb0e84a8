#include "audit/sources/workbook_subject.h"

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "audit/audited_workbook.h"
#include "audit/claims.h"
#include "audit/sources/foreign_table.h"

namespace gumcert::audit {
namespace {

using workbook::CellPlace;

/// Marks the rows that the formula of u_c leaves out.
void mark_sum(AuditedBudget& budget, const AuditedWorkbook& held) {
    const std::map<std::string, CellPlace>& cells = held.cells;
    if (!budget.claims.u_c || !cells.contains(budget.claims.u_c->place)) {
        return;
    }
    const CellPlace u_c = cells.at(budget.claims.u_c->place);
    const std::vector<CellPlace> list = held.graph.closure(std::vector{u_c});
    const std::set<CellPlace> under(list.begin(), list.end());
    const auto reached = [&](const AuditedRow& row) {
        for (const std::optional<StatedNumber>* number : {&row.contribution, &row.u, &row.stated}) {
            if (*number && cells.contains((*number)->place) && under.contains(cells.at((*number)->place))) {
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
        for (AuditedBudget& budget : subject.budgets) {
            mark_sum(budget, *held);
        }
        for (const workbook::NotEvaluated& reason : held->evaluation.reasons) {
            const workbook::Sheet& sheet = held->workbook.sheets[reason.sheet];
            subject.not_read.push_back(workbook::sheet_a1(sheet.name, sheet.cells[reason.cell].address) +
                                       ": not evaluated here (" + reason.what +
                                       "); the value that the file stored is taken");
        }
        subject.workbook = std::move(held);
    }
    return subject;
}

}  // namespace gumcert::audit
