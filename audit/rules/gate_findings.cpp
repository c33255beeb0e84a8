#include "audit/rules/gate_findings.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "audit/claims.h"

namespace gumcert::audit {
namespace {

constexpr std::array k_gate_findings{
    // completeness
    GateFinding{"R07-", "R07"},
    GateFinding{"R08", "R08"},
    GateFinding{"R09", "R09"},
    GateFinding{"R12", "P02", "/amendment/reason"},
    GateFinding{"R12", "P07", "/amendment/number", "the certificate has the number"},
    GateFinding{"R12", "R12"},
    GateFinding{"R13", "R11"},
    GateFinding{"R14", "R07"},
    GateFinding{"R15", "R07"},
    GateFinding{"R16", "P10"},
    GateFinding{"R17", "R11"},
    GateFinding{"R18", "R07"},
    GateFinding{"Q01", "R07"},
    GateFinding{"Q02", "R07"},
    // environment
    GateFinding{"E01", "E01"},
    GateFinding{"E02", "E05"},
    GateFinding{"E03", "E05"},
    GateFinding{"E04", "P09"},
    GateFinding{"E05", "E01"},
    // persons and dates
    GateFinding{"P03", "P03"},
    GateFinding{"P04", "P04"},
    GateFinding{"P05", "P05"},
    GateFinding{"P06", "P04"},
    GateFinding{"P07", "P04"},
    GateFinding{"P08", "P08"},
    GateFinding{"P09", "P03"},
    GateFinding{"P10", "P05"},
    GateFinding{"P11", "P05"},
    GateFinding{"P12", "P05"},
    GateFinding{"P13", "P04"},
    GateFinding{"X10", "P03"},
    // standards
    GateFinding{"T01", "T01"},
    GateFinding{"T02", "T02"},
    GateFinding{"T03", "T03"},
    GateFinding{"T04", "T04"},
    GateFinding{"T05", "T01"},
    GateFinding{"T06", "T05"},
    GateFinding{"T07", "T07"},
    GateFinding{"T08", "T05"},
    GateFinding{"T09", "T07"},
    // the register of the laboratory
    GateFinding{"T10", "T05"},
    GateFinding{"T11", "T06"},
    GateFinding{"T12", "T11"},
    GateFinding{"T13", "T05"},
    GateFinding{"T14", "T01"},
    GateFinding{"L01", "R07"},
    GateFinding{"P14", "P03"},
    // conformity
    GateFinding{"D01", "D01"},
    GateFinding{"D02", "D02"},
    GateFinding{"D03", "D03"},
    GateFinding{"D04", "D04"},
    GateFinding{"D05", "D05"},
    GateFinding{"D07", "D07"},
    GateFinding{"D08", "D05"},
    GateFinding{"D09", "D07"},
    GateFinding{"D10", "D01"},
    GateFinding{"D11", "D05"},
    GateFinding{"D12", "D04"},
    // the printed statement
    GateFinding{"R01", "R01"},
    GateFinding{"R02", "R02"},
    GateFinding{"R04", "R04"},
    GateFinding{"R06", "R06"},
    GateFinding{"K03", "K03"},
    GateFinding{"S05", "S05"},
    GateFinding{"S18", "S18"},
    GateFinding{"M01", "S01"},
    GateFinding{"M02", "R03"},
    // what the data say of the uncertainties that were stated for them
    GateFinding{"F01", "B06"},
    GateFinding{"F02", "B06"},
    GateFinding{"F03", "B06"},
    GateFinding{"G01", "B06"},
    GateFinding{"G02", "B06"},
    GateFinding{"G03", "B06"},
    GateFinding{"G04", "B06"},
    GateFinding{"G05", "B06"},
    GateFinding{"G06", "B06"},
    GateFinding{"G07", "B06"},
    GateFinding{"C01", "B06"},
    GateFinding{"C02", "B06"},
    GateFinding{"C03", "B06"},
    GateFinding{"C04", "E06"},
    GateFinding{"C05", "E06"},
    GateFinding{"A01", "U05"},
    GateFinding{"A02", "E06"},
    GateFinding{"A03", "U05"},
    // symbol and scope
    GateFinding{"X01", "X01"},
    GateFinding{"X02", "X02"},
    GateFinding{"X03", "X03"},
    GateFinding{"X04", "X04"},
    GateFinding{"X05", "X05"},
    GateFinding{"X06", "X06"},
    GateFinding{"X07", "X06"},
    GateFinding{"X08", "X02"},
    GateFinding{"X09", "X04"},
    GateFinding{"X11", "X05"},
    GateFinding{"X12", "X02"},
    GateFinding{"X13", "X05"},
    GateFinding{"X14", "X08"},
    GateFinding{"X15", "X06"},
    // checks of digital certificates (docs/messages.md)
    GateFinding{"GC-DCC-0040", "R07"},
    GateFinding{"GC-DCC-0041", "P01"},
    GateFinding{"GC-DCC-0042", "P01"},
    GateFinding{"DCC-form", "R07"},
    GateFinding{"GC-DCC-0046", "K03"},
    GateFinding{"GC-DCC-0047", "R07"},
    GateFinding{"GC-DCC-0048", "P05"},
    GateFinding{"GC-DCC-0049", "R07"},
    GateFinding{"GC-DCC-0116", "D04"},
    GateFinding{"GC-DCC-0117", "K03"},
};

}  // namespace

std::span<const GateFinding> gate_findings() {
    return k_gate_findings;
}

std::string_view rule_of_gate_finding(const certificate::Finding& finding) {
    for (const GateFinding& entry : k_gate_findings) {
        const bool same = entry.gate.ends_with('-') ? finding.id.starts_with(entry.gate) : finding.id == entry.gate;
        if (same && (entry.where.empty() || finding.where == entry.where) && finding.what.starts_with(entry.what)) {
            return entry.rule;
        }
    }
    return "";
}

bool takes_gate_findings(std::string_view rule) {
    return std::any_of(k_gate_findings.begin(), k_gate_findings.end(),
                       [rule](const GateFinding& entry) { return entry.rule == rule; });
}

namespace {

/// Whether the rule itself looks at the number that a check of a digital certificate names, with more of the document
/// than the check has: the decision rule beside a verdict, the degrees of freedom beside a factor. It is told once then.
bool is_left_to_rule(const certificate::Finding& gate, const AuditSubject& subject) {
    const auto names = [&gate](const std::string& before, const std::optional<StatedNumber>& number) {
        return number && !number->text.empty() && gate.what.find(before + number->text + " ") != std::string::npos;
    };
    return std::any_of(subject.budgets.begin(), subject.budgets.end(), [&](const AuditedBudget& budget) {
        const Claims& claims = budget.claims;
        if (gate.id == "GC-DCC-0116") {
            return budget.rule && !claims.verdict.empty() && names(claims.verdict + " for ", claims.value);
        }
        return gate.id == "GC-DCC-0117" && claims.coverage_probability && is_normal_or_student(claims.distribution) &&
               names("coverage factor ", claims.k);
    });
}

}  // namespace

void take_gate_findings(const AuditSubject& subject, FindingCollector& findings) {
    for (const certificate::Finding& gate :
         subject.certificate ? subject.certificate->findings : subject.of_evaluation) {
        if (rule_of_gate_finding(gate) != findings.rule() || is_left_to_rule(gate, subject)) {
            continue;
        }
        AuditFinding finding;
        finding.of_gate = true;
        finding.where = gate.where;
        finding.what = say("{finding:sentence}", gate.what);
        finding.correction = gate.action;
        const bool of_check = gate.id.find("DCC-") != std::string::npos;
        finding.evidence = {of_check ? say("check {id}, {clause}", gate.id, gate.clause)
                                     : say("gate {id}, {clause}", gate.id, gate.clause)};
        // Equal capability and U is what a floor does: to know, and no fault (see X07).
        const FindingSeverity severity = gate.id == "X03" ? FindingSeverity::information : gate.severity;
        findings.add(std::move(finding), severity);
    }
}

}  // namespace gumcert::audit
