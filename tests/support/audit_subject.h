#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/rule.h"
#include "audit/subject.h"

namespace gumcert::test {

inline audit::AuditedRow audited_row(const std::string& quantity, double u, audit::Contributor contributor) {
    audit::AuditedRow row;
    row.quantity = quantity;
    row.unit = "um";
    row.place = "row " + quantity;
    row.used_u = u;
    row.contributor = contributor;
    return row;
}

/// A budget on which no rule about contributors, capability, reporting or conformity remarks anything: u_c = 0.155 µm,
/// k = 2, U = 0.31 µm.
inline audit::AuditedBudget sound_budget() {
    using audit::Contributor;
    audit::AuditedBudget budget;
    budget.name = "length";
    budget.unit = "um";
    budget.rows = {audited_row("reference standard", 0.10, Contributor::reference),
                   audited_row("drift of the reference", 0.05, Contributor::reference_drift),
                   audited_row("resolution", 0.03, Contributor::item_resolution),
                   audited_row("repeatability", 0.08, Contributor::repeatability),
                   audited_row("reproducibility", 0.04, Contributor::reproducibility),
                   audited_row("temperature", 0.05, Contributor::temperature)};
    budget.coverage.kind = audit::CoverageRule::Kind::fixed;
    budget.value = 10.0;
    budget.claims.value = audit::read_number("10.00", "result");
    budget.claims.u_c = audit::read_number("0.155", "result");
    budget.claims.k = audit::read_number("2", "result");
    budget.claims.U = audit::read_number("0.31", "result");
    budget.claims.coverage_probability = 0.95;
    return budget;
}

inline audit::AuditSubject subject_with(std::vector<audit::AuditedBudget> budgets) {
    audit::AuditSubject subject;
    subject.kind = audit::AuditSubject::Kind::table;
    subject.name = "budget.csv";
    subject.budgets = std::move(budgets);
    return subject;
}
/// A subject with certificate data and no findings of gates.
inline audit::AuditSubject subject_with_certificate(std::vector<audit::AuditedBudget> budgets = {sound_budget()}) {
    audit::AuditSubject subject = subject_with(std::move(budgets));
    subject.certificate.emplace();
    return subject;
}

inline const audit::Rule& rule_named(const std::vector<audit::Rule>& family, std::string_view id) {
    return *std::find_if(family.begin(), family.end(), [id](const audit::Rule& rule) { return rule.id == id; });
}

/// What one rule of a family finds; nothing where it cannot be applied.
inline std::vector<audit::AuditFinding> findings_of(const std::vector<audit::Rule>& family, std::string_view id,
                                                    const audit::AuditSubject& subject) {
    const audit::Rule& rule = rule_named(family, id);
    audit::FindingCollector collector(rule);
    if (audit::why_not_applicable(rule, subject).empty() && rule.examine != nullptr) {
        rule.examine(subject, collector);
    }
    return collector.take();
}
/// Their sentences, one a line.
inline std::string found_by(const std::vector<audit::Rule>& family, std::string_view id,
                            const audit::AuditSubject& subject) {
    std::string all;
    for (const audit::AuditFinding& finding : findings_of(family, id, subject)) {
        all += (all.empty() ? "" : "\n") + finding.what.english();
    }
    return all;
}

}  // namespace gumcert::test
