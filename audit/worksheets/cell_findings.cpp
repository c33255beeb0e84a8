#include "audit/worksheets/cell_findings.h"

#include <utility>

#include "audit/row_edits.h"
#include "text/small_letters.h"

namespace gumcert::audit {

AuditFinding finding_in(const std::string& place, Sentence what) {
    AuditFinding finding;
    finding.where = place;
    finding.what = std::move(what);
    return finding;
}

std::string text_of(const WorksheetView& view, const SheetFormula& formula) {
    return "=" + workbook::find_cell(view.workbook().sheets[formula.cell.sheet], formula.cell.address)->formula;
}

bool says(const std::string& text, std::initializer_list<std::string_view> words) {
    return mentions(text::in_small_letters(text), words);
}

std::string place_of(const std::optional<StatedNumber>& number) {
    return number ? number->place : std::string();
}

void tell_limit(const ReadCells& cells, FindingCollector& findings) {
    if (!cells.is_complete()) {
        findings.leave_unchecked(
            say("formulas read more columns than an audit follows; what stands behind was not looked at"));
    }
}

}  // namespace gumcert::audit
