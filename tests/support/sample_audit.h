#pragma once

#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rule.h"
#include "audit/stated_number.h"

namespace gumcert::test {

// An audit of a made-up budget with three rules of its own, so that the forms are tested whatever the registry holds.

/// One number that a table prints: its value, and half a unit of its last digit.
audit::StatedNumber printed_number(const std::string& text, const std::string& place);

audit::AuditedRow sample_row(std::size_t position, const std::string& quantity, const std::string& u,
                             audit::Contributor contributor, double nu, const std::string& source);

/// Calibration of an external micrometer at one length: seven rows, a verdict that its corrections turn.
audit::AuditedBudget sample_audited_budget(const std::string& name = "deviation of indication");

void set_row(audit::AuditFinding& finding, std::size_t row, double u);

/// Overstates: a maximum permissible error as a standard uncertainty.
void find_specification(const audit::AuditSubject& subject, audit::FindingCollector& findings);

/// Understates: U of a certificate that was divided by a k it does not state.
void find_certificate(const audit::AuditSubject& subject, audit::FindingCollector& findings);

/// A contribution that is not there, of a size that nobody knows.
void find_reproducibility(const audit::AuditSubject& subject, audit::FindingCollector& findings);

/// Never finds anything.
inline void find_nothing(const audit::AuditSubject&, audit::FindingCollector&) {}

std::vector<audit::Rule> sample_rules();

audit::AuditReport sample_audit(const std::string& file = "micrometer.csv");

/// Four points of one table; the second is changed most.
audit::AuditReport sample_audit_of_points(const std::string& file = "table.csv");

/// An audit in which a text stands wherever a file puts one.
audit::AuditReport hostile_audit(const std::string& text);

}  // namespace gumcert::test
