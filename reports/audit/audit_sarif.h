#pragma once

#include <span>
#include <string>

#include "audit/rule.h"
#include "reports/audit/audit_view.h"

namespace gumcert::reports {

/// The audit in the Static Analysis Results Interchange Format (OASIS SARIF 2.1.0), for tools that show findings beside
/// the files: one run, a rule of the tool for every rule of the audit, a result for every finding.
///
/// critical is the level "error", major "warning", minor and information "note"; the severity itself, the clause and
/// the effect stand among the properties. Rules that were not applied are notifications of the configuration, waivers
/// are suppressions. Names of files become relative references (RFC 3986).
/// \param rules  those that the audits were made with
[[nodiscard]] std::string audit_as_sarif(const AuditView& view, std::span<const audit::Rule> rules);

}  // namespace gumcert::reports
