#pragma once

#include <string>

#include "audit/subject.h"
#include "workbook/workbook.h"

namespace gumcert::audit {

/// What an audit looks at of a workbook, or of a CSV file read as one: its budgets, and the formulas where there are any.
///
/// Rows that the formula of u_c does not reach, where it reaches others of the same table, are not in the sum.
/// \param name  of the file
[[nodiscard]] AuditSubject subject_of(workbook::Workbook workbook, const std::string& name);

}  // namespace gumcert::audit
