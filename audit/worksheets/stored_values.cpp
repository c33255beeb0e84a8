#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "audit/claims.h"
#include "audit/row_edits.h"
#include "audit/worksheets/worksheet_rules.h"
#include "audit/worksheets/worksheet_view.h"
#include "text/numbers.h"

namespace gumcert::audit {
namespace {

/// "Budget!I15 shows 0.045, its formula gives 0.0627": with as many digits as tell them apart.
Sentence both_numbers(const AuditedWorkbook& held, const workbook::CellPlace& cell) {
    constexpr int k_fewest = 4, k_most = 15;
    const double shown = *held.stale_number(cell);
    const double given =
        workbook::find_evaluated(held.evaluation, held.workbook, cell.sheet, cell.address)->value.number;
    int digits = k_fewest;
    while (digits < k_most && text::significant(shown, digits) == text::significant(given, digits)) {
        ++digits;
    }
    return say("{cell} shows {shown:number}, its formula gives {given:number}", held.place(cell),
               text::significant(shown, digits), text::significant(given, digits));
}

/// What the formulas give of the claims, in place of what the file shows.
Correction take_computed_claims(const AuditedBudget& budget) {
    const AuditedBudget computed = with_computed_claims(budget);
    return [shown = budget.coverage, given = computed.coverage, of_u_c = computed.u_c_over_rows,
            of_k = computed.k_over_rows, of_U = computed.U_over_k_u_c](AuditedBudget& corrected) {
        corrected.u_c_over_rows = of_u_c;
        corrected.k_over_rows = of_k;
        corrected.U_over_k_u_c = of_U;
        const auto is_shown = [&shown](const CoverageRule& rule) {
            return rule.kind == shown.kind && rule.k == shown.k && rule.probability == shown.probability;
        };
        if (is_shown(corrected.coverage)) {  // no other correction has taken another rule
            corrected.coverage = given;
        }
    };
}

/// W17
void stored_before_the_last_change(const AuditSubject& subject, FindingCollector& findings) {
    constexpr std::size_t k_most_named = 4;
    const AuditedWorkbook& held = *subject.workbook;
    const std::optional<WorksheetView> view = worksheet_of(subject);
    std::vector<workbook::CellPlace> stale;
    for (const workbook::EvaluatedCell& one : held.evaluation.cells) {
        const workbook::CellPlace cell{.sheet = one.sheet,
                                       .address = held.workbook.sheets[one.sheet].cells[one.cell].address};
        if (one.agreement == workbook::Agreement::differs && view->stands_under_results(cell) &&
            held.stale_number(cell)) {
            stale.push_back(cell);
        }
    }
    if (stale.empty()) {
        return;
    }
    std::vector<Sentence> evidence;
    for (std::size_t i = 0; i < std::min(stale.size(), k_most_named); ++i) {
        evidence.push_back(both_numbers(held, stale[i]));
    }
    if (stale.size() > k_most_named) {
        evidence.push_back(say_count(stale.size() - k_most_named, "the same of {count:number} more cell",
                                     "the same of {count:number} more cells"));
    }
    bool any = false;
    for (std::size_t b = 0; b < subject.budgets.size(); ++b) {
        const AuditedBudget& budget = subject.budgets[b];
        if (!budget.computed_claims) {
            continue;
        }
        any = true;
        const std::optional<StatedNumber>& claim = budget.claims.U ? budget.claims.U : budget.claims.u_c;
        AuditFinding finding = finding_of(subject, b,
                                          say("the file shows results that its formulas do not give: it was stored "
                                              "before the last change was computed"));
        finding.where = claim ? claim->place : finding.where;
        finding.evidence = evidence;
        finding.kind = "claims of " + budget.place;
        finding.correct = take_computed_claims(budget);
        findings.add(std::move(finding));
    }
    if (!any) {
        AuditFinding finding;
        finding.where = held.place(stale.front());
        finding.what =
            say("cells under the result show numbers that their formulas do not give; the result itself is "
                "what its formulas give");
        finding.evidence = std::move(evidence);
        findings.add(std::move(finding), FindingSeverity::minor);
    }
}

}  // namespace

Rule stored_value_rule() {
    return {.id = "W17",
            .title = "Stored value is not what the formula gives",
            .clause = {.text = "ISO/IEC 17025:2017, 7.11.6", .verified = true},
            .severity = FindingSeverity::major,
            .needs = {Need::workbook},
            .detection =
                "a cell under a result whose stored number, which readers of the file see, is another one than "
                "its formula gives, beyond 1e-6; not of volatile functions, nor where nothing is stored",
            .correction = "Let the spreadsheet compute the file again, store it, and look at what was issued since.",
            .question = "Which of the two numbers was issued, and what was changed after it was computed?",
            .examine = stored_before_the_last_change};
}

}  // namespace gumcert::audit
