#include <algorithm>
#include <map>
#include <optional>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/row_meaning.h"
#include "audit/worksheets/cell_findings.h"
#include "audit/worksheets/read_cells.h"
#include "audit/worksheets/worksheet_rules.h"
#include "audit/worksheets/worksheet_view.h"

namespace gumcert::audit {
namespace {

using workbook::CellPlace;
using workbook::Formula;
using workbook::FormulaNode;

// W05 -----------------------------------------------------------------------------------------------------------------

bool has_absolute_reference(const Formula& formula) {
    // A relative address moves when its row is copied. An absolute one stays, and the copy reads the cell of the row
    // that it comes from.
    return std::any_of(formula.references.begin(), formula.references.end(), [](const workbook::Reference& reference) {
        return reference.first.row_is_absolute || reference.first.column_is_absolute;
    });
}

/// The formula that gives u of a row, or what it is divided from.
const SheetFormula* formula_of_row(const WorksheetView& view, const AuditedRow& row) {
    return view.formula_at(place_of(row.stated ? row.stated : row.u));
}

/// The row of a budget whose number stands in a cell: what it divides, or its u.
using OwnersOfCells = std::map<CellPlace, std::size_t>;
OwnersOfCells owners_of(const WorksheetView& view, const AuditedBudget& budget) {
    OwnersOfCells owners;
    for (std::size_t r = 0; r < budget.rows.size(); ++r) {
        for (const std::optional<StatedNumber>* number : {&budget.rows[r].stated, &budget.rows[r].u}) {
            const std::optional<CellPlace> cell = view.cell_at(place_of(*number));
            if (cell) {
                owners.emplace(*cell, r);
            }
        }
    }
    return owners;
}

/// The first cell of another row among those that a formula names one by one; nothing where it names one of its own row.
std::optional<CellPlace> number_of_other_row(const WorksheetView& view, const SheetFormula& formula,
                                             const OwnersOfCells& owners, std::size_t row) {
    std::optional<CellPlace> other;
    for (const FormulaNode& node : formula.formula.nodes) {
        const std::optional<CellPlace> cell = view.cell_of(formula, node);
        const auto owner = cell ? owners.find(*cell) : owners.end();
        if (owner == owners.end()) {
            continue;
        }
        if (owner->second == row) {
            return std::nullopt;
        }
        other = other ? other : cell;
    }
    return other;
}

/// W05 of a row that computes u from what another row divides, in place of its own, or passes on the number of another row by
/// an absolute address as its own. One that computes with it, as a drift that is a tenth of U, is another number.
void number_of_another_row(const WorksheetView& view, const AuditSubject& subject, FindingCollector& findings) {
    for_each_row(subject, [&view, &findings, owners = OwnersOfCells(),
                           of = std::optional<std::size_t>()](const RowAt& at) mutable {
        if (of != at.budget) {
            of = at.budget;
            owners = owners_of(view, at.of);
        }
        const AuditedRow& row = at.is;
        const SheetFormula* of_u = row.stated ? view.formula_at(place_of(row.u)) : nullptr;
        const SheetFormula* of_stated = view.formula_at(place_of(row.stated ? row.stated : row.u));
        const bool copies =
            of_stated != nullptr && of_stated->formula.nodes.size() == 1 && has_absolute_reference(of_stated->formula);
        std::optional<CellPlace> read =
            of_u != nullptr ? number_of_other_row(view, *of_u, owners, at.row) : std::nullopt;
        const SheetFormula* formula = read ? of_u : of_stated;
        const bool in_u = read.has_value();
        if (!read && copies) {
            read = number_of_other_row(view, *of_stated, owners, at.row);
        }
        if (!read) {
            return;
        }
        const AuditedRow& other = at.of.rows[owners.at(*read)];
        AuditFinding finding = finding_at(
            at, view.place(formula->cell),
            in_u ? say("u is computed from {cell}, the number of the row \"{quantity}\", and its own is not read",
                       view.place(*read), other.quantity)
                 : say("passes on {cell}, the number of the row \"{quantity}\", by an absolute address: it counts "
                       "twice, or another cell was meant",
                       view.place(*read), other.quantity));
        finding.evidence = {text_of(view, *formula), equals(view.place(*read), in_words(view.value(*read).number))};
        const std::optional<StatedNumber> quotient = quotient_of_columns(row);
        if (in_u && quotient) {
            finding.expected = equals("u", in_words(quotient->value, row.unit));
            finding.actual = equals("u", in_words(row.used_u, row.unit));
            finding.correct = set_u(at.row, quotient->value);
        } else if (!in_u) {
            finding.correct = leave_out(at.row);
        }
        findings.add(std::move(finding));
    });
}

void stray_address(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    ReadCells cells(*view);
    number_of_another_row(*view, subject, findings);
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        FirstReaders all, by_absolute_address;
        for (std::size_t r = 0; r < budget.rows.size(); ++r) {
            const SheetFormula* formula = formula_of_row(*view, budget.rows[r]);
            if (formula == nullptr) {
                continue;
            }
            const bool is_absolute = has_absolute_reference(formula->formula);
            const std::vector<CellRun> runs = cells.runs(formula->cell);
            std::optional<FirstReaders::Shared> shared;
            std::size_t sheet = 0;
            for (const CellRun& run : runs) {
                if (!shared) {
                    shared = (is_absolute ? all : by_absolute_address).shared(cells, run);
                    sheet = run.sheet;
                }
                all.add(run, r);
                if (is_absolute) {
                    by_absolute_address.add(run, r);
                }
            }
            if (!shared) {
                continue;
            }
            const CellPlace read = cells.cell(sheet, shared->at);
            const AuditedRow& other = budget.rows[shared->reader];
            const RowAt at{.budget = b, .row = r, .of = budget, .is = budget.rows[r]};
            AuditFinding finding = finding_at(at, view->place(formula->cell),
                                              say("reads the same cell as the row \"{quantity}\" by an absolute "
                                                  "address: {cell} counts twice, or another cell was meant",
                                                  other.quantity, view->place(read)));
            finding.evidence = {equals(view->place(read), in_words(view->value(read).number)),
                                say("read by {first} and {second}", view->place(formula->cell),
                                    view->place(formula_of_row(*view, other)->cell))};
            finding.correct = leave_out(r);
            findings.add(std::move(finding));
        }
    }
    tell_limit(cells, findings);
}

}  // namespace

Rule worksheet_address_rule() {
    return {.id = "W05",
            .title = "One cell feeds two rows by an absolute address",
            .clause = {.text = "JCGM 100:2008, 4.3.10", .verified = true},
            .needs = {Need::workbook},
            .detection =
                "two rows of a budget read the same number, one of them by an absolute address; u of a row computed "
                "from what another row divides; the number of another row passed on by an absolute address",
            .correction = "Let each row read its own cell, or leave the second row out.",
            .question = "Which cell was the second row meant to read?",
            .examine = stray_address};
}

}  // namespace gumcert::audit
