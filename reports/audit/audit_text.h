#pragma once

#include <string>

#include "reports/audit/audit_view.h"
#include "reports/wording.h"

namespace gumcert::reports {

/// The audit for a terminal: UTF-8, lines of at most 100 columns. What the corrections do to the worst result comes
/// first, then the findings by severity and effect, the questions, and what was not checked.
/// \param verbose  names every rule that was not checked, and why; else their number
/// \throws gum::StorageError  if the wording is damaged
[[nodiscard]] std::string audit_as_text(const AuditView& view, const Wording& wording, bool verbose = false);

}  // namespace gumcert::reports
