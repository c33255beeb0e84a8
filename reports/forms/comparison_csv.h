#pragma once

#include <string>

#include "reports/record/evaluation_record.h"

namespace gumcert::reports {

/// The points of a comparison as CSV (RFC 4180, UTF-8, LF, decimal point): one row a point or a result in the order of
/// the record, numbers unrounded (the shortest that read back the same), with every number that is needed to recompute
/// the scores. Columns that no row has are left out; an empty cell says that there is no such number.
///
/// A text that a spreadsheet would take for a formula gets an apostrophe in front: one that begins with = + - @, a tab
/// or a line break, or has one of the four behind a separator, unless it is a number or a sign alone.
/// \throws gum::InputError  GC-REPORT-0040 where the record holds no comparison
[[nodiscard]] std::string comparison_csv(const EvaluationRecord& record);

}  // namespace gumcert::reports
