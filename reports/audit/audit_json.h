#pragma once

#include <string>

#include "reports/audit/audit_view.h"

namespace gumcert::reports {

/// The audit for programs: canonical JSON, "gumcert/audit/1" (docs/audit.md, schemas/audit-1.schema.json).
///
/// `claimed`, `recomputed` and `audited` at the top are those of the worst result; all results stand under `results`.
/// With several files, the top is that of the worst file, and each stands under `files`. Infinite degrees of freedom,
/// and what does not apply, are null.
/// \param run  for the texts of many files
/// \throws gum::NoResultError  where a number is not finite
[[nodiscard]] std::string audit_as_json(const AuditView& view, const TaskRunner& run = {});

}  // namespace gumcert::reports
