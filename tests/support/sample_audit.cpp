#include "tests/support/sample_audit.h"

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

namespace gumcert::test {

audit::StatedNumber printed_number(const std::string& text, const std::string& place) {
    return audit::read_number(text, place).value_or(audit::exact_number(0.0, place));
}

audit::AuditedRow sample_row(std::size_t position, const std::string& quantity, const std::string& u,
                             audit::Contributor contributor, double nu, const std::string& source) {
    audit::AuditedRow row;
    row.quantity = quantity;
    row.unit = "µm";
    row.place = "row " + std::to_string(position);
    row.source = source;
    row.contributor = contributor;
    row.u = printed_number(u, row.place + ", u");
    row.used_u = row.u->value;
    row.u_half_step = row.u->half_step;
    row.used_nu = nu;
    if (std::isfinite(nu)) {
        row.nu = audit::exact_number(nu, row.place + ", nu");
    }
    row.shape = std::isfinite(nu) ? audit::Shape::student_t : audit::Shape::rectangular;
    return row;
}

audit::AuditedBudget sample_audited_budget(const std::string& name) {
    using audit::Contributor;
    const double infinite = std::numeric_limits<double>::infinity();
    audit::AuditedBudget budget;
    budget.name = name;
    budget.unit = "µm";
    budget.place = "budget.csv";
    budget.equation = "E = l_ind - l_gb + L α Δθ";
    budget.rows = {
        sample_row(1, "gauge block, certificate", "0.28", Contributor::reference, infinite,
                   "certificate 4711, U = 0.56 µm, k = 2"),
        sample_row(2, "resolution of the display", "0.29", Contributor::item_resolution, infinite, "step 1 µm"),
        sample_row(3, "repeatability of ten readings", "0.31", Contributor::repeatability, 9.0,
                   "readings of 2026-03-02"),
        sample_row(4, "parallelism of the faces", "0.40", Contributor::other, infinite,
                   "maximum permissible error 0.4 µm"),
        sample_row(5, "temperature difference", "0.12", Contributor::temperature, infinite, "thermometer T-17"),
        sample_row(6, "expansion coefficient", "0.035", Contributor::expansion, infinite, "data sheet"),
        sample_row(7, "drift of the gauge block", "0", Contributor::reference_drift, infinite, ""),
    };
    budget.rows[0].stated = printed_number("0.56", "row 1, stated");
    budget.rows[0].divisor = printed_number("2", "row 1, divisor");
    budget.rows[0].certificate_k = 2.0;
    budget.rows[0].origin_value = 0.56;
    budget.rows[0].origin = audit::Origin::certificate;
    budget.rows[0].shape = audit::Shape::normal;
    budget.rows[3].origin = audit::Origin::specification;
    budget.rows[3].origin_value = 0.4;
    budget.rows[4].comment = "room 20 °C ± 0.5 °C";
    budget.rows[6].comment = "two calibrations only, no trend seen";
    budget.coverage = {.kind = audit::CoverageRule::Kind::student_t, .probability = 0.9545};
    budget.value = 2.1;
    budget.limits = {.lower = -3.5, .upper = 3.5};
    budget.rule = gum::DecisionRule::guard_band_u;
    budget.capability = 0.9;
    budget.reference = audit::ComparedReference{.value = 0.6, .expanded_uncertainty = 0.5, .name = "pilot laboratory"};
    budget.claims.value = printed_number("2.1", "row 8");
    budget.claims.u_c = printed_number("0.66", "row 9");
    budget.claims.U = printed_number("1.3", "row 10");
    budget.claims.verdict = "pass";
    return budget;
}

void set_row(audit::AuditFinding& finding, std::size_t row, double u) {
    finding.budgets = {0};
    finding.correct = [row, u](audit::AuditedBudget& budget) { budget.rows[row].used_u = u; };
}

void find_specification(const audit::AuditSubject& subject, audit::FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        const std::vector<audit::AuditedRow>& rows = subject.budgets[i].rows;
        for (std::size_t r = 0; r < rows.size(); ++r) {
            if (rows[r].origin != audit::Origin::specification || !rows[r].origin_value) {
                continue;
            }
            audit::AuditFinding finding;
            finding.where = rows[r].place + " (" + rows[r].quantity + "), u";
            finding.what = "the maximum permissible error stands as the standard uncertainty";
            finding.evidence = {"u = 0.40 µm", "source: " + rows[r].source};
            finding.expected = "0.2309 µm";
            finding.actual = "0.4 µm";
            set_row(finding, r, *rows[r].origin_value / std::numbers::sqrt3);
            finding.budgets = {i};
            findings.add(std::move(finding));
        }
    }
}

void find_certificate(const audit::AuditSubject& subject, audit::FindingCollector& findings) {
    for (std::size_t i = 0; i < subject.budgets.size(); ++i) {
        if (subject.budgets[i].rows.empty()) {
            continue;
        }
        audit::AuditFinding finding;
        finding.where =
            subject.budgets[i].rows.front().place + " (" + subject.budgets[i].rows.front().quantity + "), divisor";
        finding.what =
            "U of the certificate is 1.12 µm with k = 2; it was divided by 2 once before it came into the table";
        finding.evidence = {"U = 0.56 µm", "certificate 4711: U = 1.12 µm, k = 2"};
        set_row(finding, 0, 0.56);
        finding.budgets = {i};
        findings.add(std::move(finding));
    }
}

void find_reproducibility(const audit::AuditSubject& subject, audit::FindingCollector& findings) {
    audit::AuditFinding finding;
    finding.where = subject.budgets.front().place;
    finding.what = "no row stands for the reproducibility between operators and days";
    finding.evidence = {"rows: 7"};
    finding.budgets = {0};
    finding.contribution_missing = true;
    findings.add(std::move(finding));
}

std::vector<audit::Rule> sample_rules() {
    using audit::Need;
    return {
        {.id = "U10",
         .title = "Maximum permissible error used as a standard uncertainty",
         .clause = {.text = "JCGM 100:2008, 4.3.7", .verified = true},
         .needs = {Need::rows},
         .detection = "a row that comes from a specification, with u equal to the maximum permissible error",
         .correction = "Divide the maximum permissible error by √3, or state why another distribution is known.",
         .question = "On what is the standard uncertainty of this row based?",
         .examine = find_specification},
        {.id = "U13",
         .title = "Certificate uncertainty divided by the wrong number",
         .clause = {.text = "JCGM 100:2008, 4.3.3", .verified = false},
         .needs = {Need::rows},
         .detection = "u times k of the certificate is not its U",
         .correction = "Divide U of the certificate by the k that stands beside it, once.",
         .question = "Which U and which k does the certificate state at this length?",
         .examine = find_certificate},
        {.id = "B05",
         .title = "No contribution of reproducibility",
         .clause = {.text = "ISO/IEC 17025:2017, 7.6.1", .verified = false},
         .policy = audit::SeverityPolicy::fixed,
         .severity = audit::FindingSeverity::minor,
         .needs = {Need::rows},
         .detection = "no row is tagged as reproducibility",
         .correction = "Measure on another day with another operator, or state why this changes nothing.",
         .question = "Who measured, on how many days, and what changed between them?",
         .examine = find_reproducibility},
        {.id = "T01",
         .title = "Calibration of a standard expired",
         .clause = {.text = "ISO/IEC 17025:2017, 6.4.7", .verified = false},
         .policy = audit::SeverityPolicy::fixed,
         .severity = audit::FindingSeverity::critical,
         .needs = {Need::certificate},
         .detection = "",
         .correction = "Use standards whose calibration is valid on the day of use.",
         .question = "",
         .examine = find_nothing},
        {.id = "S05",
         .title = "Law of propagation not validated",
         .clause = {.text = "JCGM 101:2008, 8", .verified = false},
         .policy = audit::SeverityPolicy::fixed,
         .needs = {Need::workbook},
         .detection = "",
         .correction = "",
         .question = "",
         .examine = find_nothing},
    };
}

audit::AuditReport sample_audit(const std::string& file) {
    audit::AuditSubject subject;
    subject.name = file;
    subject.budgets = {sample_audited_budget()};
    subject.not_read = {"row 12: \"see sheet 2\" is no number of the column u"};
    return audit::audit(std::move(subject), sample_rules());
}

audit::AuditReport sample_audit_of_points(const std::string& file) {
    audit::AuditSubject subject;
    subject.name = file;
    for (const std::string point : {"0 mm", "10 mm", "20 mm", "25 mm"}) {
        audit::AuditedBudget budget = sample_audited_budget("deviation at " + point);
        budget.claims = {};
        budget.rows[2].used_u *= 1.0 + 0.2 * static_cast<double>(subject.budgets.size());
        if (point == "10 mm") {
            budget.rows[4].used_u = 0.02;
            budget.rows[2].used_u = 0.05;
        }
        subject.budgets.push_back(std::move(budget));
    }
    return audit::audit(std::move(subject), sample_rules());
}

audit::AuditReport hostile_audit(const std::string& text) {
    audit::AuditSubject subject;
    subject.name = text;
    audit::AuditedBudget budget = sample_audited_budget(text);
    budget.unit = budget.place = budget.equation = budget.method = text;
    budget.reference->name = text;
    budget.claims.verdict = text;
    for (audit::AuditedRow& row : budget.rows) {
        row.quantity = row.unit = row.source = row.comment = row.shape_text = text;
    }
    budget.claims.U->text = text;
    subject.budgets = {budget};
    subject.not_read = {text};
    audit::AuditReport report = audit::audit(std::move(subject), sample_rules());
    for (audit::AuditFinding& finding : report.findings) {
        finding.where += text;
        finding.what = finding.expected = finding.actual = finding.correction = finding.question = text;
        finding.evidence = {text};
    }
    report.not_checked.push_back({.rule = text, .because = text});
    return report;
}

}  // namespace gumcert::test
