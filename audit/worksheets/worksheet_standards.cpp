#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "audit/row_edits.h"
#include "audit/worksheets/cell_findings.h"
#include "audit/worksheets/worksheet_rules.h"
#include "audit/worksheets/worksheet_view.h"

namespace gumcert::audit {
namespace {

using workbook::CellKind;
using workbook::CellPlace;
using workbook::CellValue;

// W07, W08 ------------------------------------------------------------------------------------------------------------

/// A table of corrections of a standard: heads of a column of corrections and one of their U.
struct StandardTable {
    std::size_t sheet = 0;
    std::uint32_t head_row = 1, correction = 0, U = 0;
};

std::vector<StandardTable> standard_tables(const WorksheetView& view) {
    std::vector<StandardTable> tables;
    for (std::size_t s = 0; s < view.workbook().sheets.size(); ++s) {
        std::map<std::uint32_t, StandardTable> by_row;
        for (const workbook::Cell& cell : view.workbook().sheets[s].cells) {
            if (cell.value.kind != CellKind::text) {
                continue;
            }
            StandardTable& table = by_row[cell.address.row];
            table.sheet = s;
            table.head_row = cell.address.row;
            const std::string& text = cell.value.text;
            if (says(text, {"correction", "korrektion", "korrektur", "deviation", "abweichung", "error", "fehler"})) {
                table.correction = cell.address.column;
            } else if (text.starts_with("U") || says(text, {"uncertainty", "unsicherheit"})) {
                table.U = cell.address.column;
            }
        }
        for (const auto& [row, table] : by_row) {
            if (table.correction != 0 && table.U != 0) {
                tables.push_back(table);
            }
        }
    }
    return tables;
}

/// Calls `look` with the correction and U of each row below the heads, until both columns are empty or the next table has
/// its heads there.
void for_each_correction(
    const WorksheetView& view,
    const std::function<void(const CellPlace&, const CellValue&, const CellPlace&, const CellValue&)>& look) {
    constexpr std::uint32_t k_longest = 10'000;
    const std::vector<StandardTable> tables = standard_tables(view);
    std::map<std::tuple<std::size_t, std::uint32_t, std::uint32_t>, std::uint32_t> next_heads;
    std::vector<std::uint32_t> ends(tables.size());
    // From the last table to the first: the heads further down end the table above them, however many rows it has.
    for (std::size_t i = tables.size(); i-- > 0;) {
        std::uint32_t& next =
            next_heads.try_emplace({tables[i].sheet, tables[i].correction, tables[i].U}, workbook::k_most_rows + 1)
                .first->second;
        ends[i] = std::min(next, tables[i].head_row + k_longest);
        next = tables[i].head_row;
    }
    for (std::size_t i = 0; i < tables.size(); ++i) {
        const StandardTable& table = tables[i];
        for (std::uint32_t row = table.head_row + 1; row < ends[i]; ++row) {
            const CellPlace c{.sheet = table.sheet, .address = {.row = row, .column = table.correction}};
            const CellPlace u{.sheet = table.sheet, .address = {.row = row, .column = table.U}};
            const CellValue correction = view.value(c), U = view.value(u);
            if (correction.kind == CellKind::blank && U.kind == CellKind::blank) {
                break;
            }
            look(c, correction, u, U);
        }
    }
}

void correction_without_uncertainty(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_correction(
        *view, [&](const CellPlace& c, const CellValue& correction, const CellPlace& u, const CellValue& U) {
            const auto is_nothing = [](const CellValue& value) {
                return value.kind == CellKind::blank || (value.kind == CellKind::number && value.number == 0.0);
            };
            if (is_nothing(correction) && is_nothing(U)) {
                AuditFinding finding = finding_in(
                    view->place(c), say("a correction of 0 with an uncertainty of 0: cells that were never filled in"));
                finding.evidence = {equals(view->place(c), "0"), equals(view->place(u), "0")};
                finding.kind = finding.what.english();
                findings.add(std::move(finding));
            }
        });
}

void uncertainty_not_positive(const AuditSubject& subject, FindingCollector& findings) {
    const std::optional<WorksheetView> view = worksheet_of(subject);
    for_each_correction(
        *view, [&](const CellPlace&, const CellValue& correction, const CellPlace& u, const CellValue& U) {
            if (U.kind != CellKind::number || U.number > 0.0 || (U.number == 0.0 && correction.number == 0.0)) {
                return;
            }
            const bool copied = correction.kind == CellKind::number && correction.number == U.number;
            AuditFinding finding = finding_in(
                view->place(u),
                copied ? say("an expanded uncertainty of {U:number}, the number of the column of corrections",
                             in_words(U.number))
                       : say("an expanded uncertainty of {U:number}", in_words(U.number)));
            finding.expected = "U > 0";
            finding.actual = say_number(in_words(U.number));
            findings.add(std::move(finding));
        });
}

}  // namespace

std::vector<Rule> worksheet_standard_rules() {
    return {
        {.id = "W07",
         .title = "Correction 0 with U 0",
         .clause = {.text = "ISO/IEC 17025:2017, 6.4.11", .verified = true},
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::workbook},
         .detection = "both columns of a table of a standard hold 0 or nothing",
         .correction = "Fill in the certificate, or take the point out of the table.",
         .question = "What does the certificate of the standard state at this point?",
         .examine = correction_without_uncertainty},
        {.id = "W08",
         .title = "Uncertainty of a standard not above 0",
         .clause = {.text = "ISO/IEC 17025:2017, 6.4.11", .verified = true},
         .policy = SeverityPolicy::fixed,
         .severity = FindingSeverity::critical,
         .needs = {Need::workbook},
         .detection = "U ≤ 0 in a table of a standard",
         .correction = "Take U from the certificate of the standard.",
         .question = "What does the certificate of the standard state as U at this point?",
         .examine = uncertainty_not_positive},
    };
}

}  // namespace gumcert::audit
