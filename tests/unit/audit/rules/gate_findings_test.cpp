#include "audit/rules/gate_findings.h"

#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

certificate::Finding gate_finding(std::string_view id, std::string_view where) {
    certificate::Finding finding;
    finding.id = std::string(id) + (id.ends_with('-') ? "e" : "");
    finding.clause = "a clause";
    finding.severity = FindingSeverity::minor;
    finding.where = where.empty() ? "/somewhere" : std::string(where);
    finding.what = "what the gate says";
    finding.action = "what to do";
    return finding;
}

TEST(GateFindings, are_reported_by_one_rule_of_the_catalogue_each) {
    for (const GateFinding& entry : gate_findings()) {
        EXPECT_TRUE(takes_gate_findings(entry.rule));
        AuditSubject subject = test::subject_with_certificate({});
        certificate::Finding gate = gate_finding(entry.gate, entry.where);
        gate.what = std::string(entry.what) + " says the gate";
        subject.certificate->findings = {gate};
        EXPECT_EQ(rule_of_gate_finding(gate), entry.rule);
        std::vector<std::string> reported;
        for (const AuditFinding& finding : audit(subject, all_rules()).findings) {
            if (finding.what == gate.what) {
                reported.push_back(finding.rule);
                EXPECT_EQ(finding.correction, "what to do");
                EXPECT_EQ(finding.severity,
                          entry.gate == "X03" ? FindingSeverity::information : FindingSeverity::minor);
            }
        }
        EXPECT_EQ(reported, std::vector{std::string(entry.rule)}) << entry.gate;
    }
}

/// What a gate says and an audit does not, the audit hides: "0 critical" of a certificate that is blocked.
TEST(GateFindings, of_every_id_are_reported) {
    std::ifstream page(GUMCERT_SOURCE_DIR "/docs/findings.md");
    std::size_t ids = 0;
    for (std::string line; std::getline(page, line);) {
        static const std::regex row(R"(\| ([A-Z][0-9]{2}|R07-[0-9a-z]+) \| .*)");
        std::smatch found;
        if (std::regex_match(line, found, row)) {
            ++ids;
            EXPECT_NE(rule_of_gate_finding(gate_finding(found[1].str(), "")), "") << line;
        }
    }
    EXPECT_GT(ids, 60U);
}

TEST(GateFindings, without_a_certificate_there_are_none) {
    AuditSubject subject = test::subject_with({});
    const std::vector<Rule> rules = record_rules();
    FindingCollector collector(rules.front());
    take_gate_findings(subject, collector);
    EXPECT_TRUE(collector.take().empty());
    EXPECT_EQ(rule_of_gate_finding(gate_finding("Z99", "")), "");
}

TEST(GateFindings, without_a_certificate_are_those_of_the_evaluation) {
    AuditSubject subject = test::subject_with({});
    subject.of_evaluation = {gate_finding("G01", "adjustment")};
    std::vector<std::string> reported;
    for (const AuditFinding& finding : audit(subject, all_rules()).findings) {
        if (finding.of_gate) {
            reported.push_back(finding.rule + " " + finding.where);
        }
    }
    EXPECT_EQ(reported, std::vector<std::string>{"B06 adjustment"});
}

TEST(GateFindings, tell_the_reason_of_an_amendment_from_its_reference) {
    EXPECT_EQ(rule_of_gate_finding(gate_finding("R12", "/amendment/reason")), "P02");
    EXPECT_EQ(rule_of_gate_finding(gate_finding("R12", "/amendment/number")), "R12");
    EXPECT_FALSE(takes_gate_findings("U10"));
}

}  // namespace
}  // namespace gumcert::audit
