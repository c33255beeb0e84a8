#pragma once

#include <span>
#include <string_view>

#include "audit/rule.h"

namespace gumcert::audit {

// The gates of a certificate (certificate/gates) and the evaluation behind it find much of what the catalogue of the
// audit names, some of it under other ids. The audit takes their findings, and knows them by the ids of the catalogue.

/// A finding of the gates and the rule of the catalogue that reports it.
struct GateFinding {
    std::string_view gate;     ///< id in docs/findings.md; "R07-" stands for all that begin so
    std::string_view rule;     ///< id of the catalogue
    std::string_view where{};  ///< only findings at this place; "" for all others of the id
    std::string_view what{};   ///< and only those whose sentence begins so
};
[[nodiscard]] std::span<const GateFinding> gate_findings();

/// The rule of the catalogue that reports a finding of the gates; "" where none does.
[[nodiscard]] std::string_view rule_of_gate_finding(const certificate::Finding& finding);

[[nodiscard]] bool takes_gate_findings(std::string_view rule);

/// Adds the findings of the gates that a rule of the catalogue reports, with the severity that the gate gives them.
/// \param findings  of the rule
void take_gate_findings(const AuditSubject& subject, FindingCollector& findings);

}  // namespace gumcert::audit
