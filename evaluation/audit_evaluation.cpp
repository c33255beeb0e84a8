#include "evaluation/audit_evaluation.h"

#include <gumcert_build_info.h>

#include <algorithm>
#include <memory>
#include <span>
#include <utility>

#include "audit/rules/registry.h"
#include "audit/sources/record_subject.h"
#include "certificate/gates/gates.h"
#include "certificate/waiver.h"
#include "reports/audit/audit_json.h"
#include "reports/record/make/certificate/evaluation_findings.h"

namespace gumcert::evaluation {

namespace {

using certificate::Finding;
using certificate::FindingSeverity;

/// What the audit alone found, and nobody accepts, as findings of the certificate.
std::vector<Finding> critical_findings(const audit::AuditReport& report, std::span<const audit::Rule> rules) {
    std::vector<Finding> critical;
    for (const audit::AuditFinding& found : report.findings) {
        if (found.of_gate || !audit::is_open_critical(found, report.subject.waivers)) {
            continue;
        }
        std::string clause;
        for (const audit::Rule& rule : rules) {
            clause = rule.id == found.rule ? std::string(rule.clause.text) : clause;
        }
        critical.push_back({.id = "audit-" + found.rule,
                            .clause = std::move(clause),
                            .severity = FindingSeverity::critical,
                            .where = found.where,
                            .what = found.what.english(),
                            .action = found.correction});
    }
    return critical;
}

}  // namespace

reports::AuditView audit_view(std::span<const audit::AuditReport> reports, std::vector<std::string> digests) {
    return reports::make_audit_view(reports, audit::all_rules(),
                                    {.program = "gumcert " + std::string(k_version), .digests = std::move(digests)});
}

reports::AuditView audit_view(std::vector<reports::AuditedFileView> files,
                              std::vector<reports::UnauditedFile> unaudited) {
    return reports::make_audit_view(
        std::move(files), {.program = "gumcert " + std::string(k_version), .unaudited = std::move(unaudited)});
}

bool is_refuted_by_audit(const Evaluation& evaluation) {
    if (!evaluation.audit || evaluation.record.kind == "comparison") {
        return false;  // the scores of a comparison are its answer
    }
    // A measurement that is compared with a reference has its own result; what rules N say of its scores is no fault of it.
    return std::any_of(evaluation.critical_of_audit.begin(), evaluation.critical_of_audit.end(),
                       [](const certificate::Finding& found) { return !found.id.starts_with("audit-N"); });
}

std::vector<gum::Diagnostic> critical_messages(const Evaluation& evaluation) {
    std::vector<gum::Diagnostic> messages;
    if (evaluation.record.certificate || !evaluation.audit) {
        return messages;
    }
    for (const audit::AuditFinding& finding : evaluation.audit->findings) {
        if (audit::is_open_critical(finding, evaluation.audit->subject.waivers)) {
            messages.push_back({.code = "GC-AUDIT-0020",
                                .where = "audit " + finding.rule + ", " + finding.where,
                                .what = finding.what.english(),
                                .rule = "a critical finding: an assessor would not accept this result",
                                .action = finding.correction,
                                .severity = gum::Severity::warning});
        }
    }
    return messages;
}

void audit_evaluation(Evaluation& evaluation, const std::string& job_file) {
    const std::span<const audit::Rule> rules = audit::all_rules();
    audit::AuditSubject subject = audit::subject_of(evaluation.record, job_file);
    subject.kind = audit::AuditSubject::Kind::job;
    if (!evaluation.record.certificate) {
        subject.of_evaluation = reports::evaluation_findings(evaluation.record);
    }
    if (evaluation.add_nested_budgets) {
        evaluation.add_nested_budgets(subject);
    }
    for (const certificate::Waiver& waiver : evaluation.waivers) {
        if (certificate::has_effect(waiver, "")) {
            subject.waivers.push_back(waiver);
        }
    }
    auto report = std::make_shared<audit::AuditReport>(audit::audit(std::move(subject), rules));
    evaluation.record.audit_json = reports::audit_as_json(audit_view(std::span(report.get(), 1)));
    evaluation.critical_of_audit = critical_findings(*report, rules);
    if (evaluation.record.certificate) {
        certificate::add_findings(*evaluation.record.certificate, evaluation.critical_of_audit);
        evaluation.blocked = evaluation.record.certificate->blocked;
    }
    evaluation.audit = std::move(report);
}

}  // namespace gumcert::evaluation
