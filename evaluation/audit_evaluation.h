#pragma once

#include <span>
#include <string>
#include <vector>

#include "evaluation/evaluation_task.h"
#include "gum/quantity/diagnostic.h"
#include "reports/audit/audit_view.h"

namespace gumcert::evaluation {

/// Audits what was evaluated of a job: the audit stands in the record from then on, and its critical findings, unless
/// somebody accepts them, are findings of the certificate, which they block. The record is not a certificate where the
/// job states no certificate data; then nothing is blocked.
/// \param job_file  its name in its source
void audit_evaluation(Evaluation& evaluation, const std::string& job_file);

/// Whether the audit itself, beside the gates of a certificate, left a critical finding that nobody accepts. Of a
/// comparison the scores are the answer, and what the audit says of them is not another one: false.
[[nodiscard]] bool is_refuted_by_audit(const Evaluation& evaluation);

/// Open critical findings of the audit as messages, GC-AUDIT-0020; none of a certificate, which has them among its findings.
[[nodiscard]] std::vector<gum::Diagnostic> critical_messages(const Evaluation& evaluation);

/// Audits as documents of this program show them.
/// \param digests  SHA-256 of the audited files, in the order of the reports; none, or "": it is not printed
[[nodiscard]] reports::AuditView audit_view(std::span<const audit::AuditReport> reports,
                                            std::vector<std::string> digests = {});
/// \param unaudited  files that were asked for and have no audit
[[nodiscard]] reports::AuditView audit_view(std::vector<reports::AuditedFileView> files,
                                            std::vector<reports::UnauditedFile> unaudited);

}  // namespace gumcert::evaluation
