#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "audit/audited_budget.h"
#include "audit/rule.h"
#include "audit/worksheets/read_cells.h"
#include "audit/worksheets/worksheet_view.h"

namespace gumcert::audit {

/// A finding about a cell.
[[nodiscard]] AuditFinding finding_in(const std::string& place, Sentence what);
/// "=SQRT(B3)", as it stands in its cell.
[[nodiscard]] std::string text_of(const WorksheetView& view, const SheetFormula& formula);
/// The place of the cell that holds a number; "" where there is none.
[[nodiscard]] std::string place_of(const std::optional<StatedNumber>& number);
/// mentions() of a text in any letters.
[[nodiscard]] bool says(const std::string& text, std::initializer_list<std::string_view> words);
/// Leaves unchecked what was left out of formulas that read too much.
void tell_limit(const ReadCells& cells, FindingCollector& findings);

}  // namespace gumcert::audit
