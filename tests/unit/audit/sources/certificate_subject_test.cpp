#include "audit/sources/certificate_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/budget_outcome.h"
#include "audit/rules/registry.h"
#include "reports/dcc/dcc_element.h"

namespace gumcert::audit {
namespace {

AuditSubject subject_of_text(const std::string& xml, std::vector<gum::Diagnostic> checks = {}) {
    return subject_of(reports::parse_dcc(xml, "c.xml"), checks, "c.xml");
}

std::string uncertainty(const std::string& U, const std::string& k, const std::string& p,
                        const std::string& distribution = "") {
    return "<si:measurementUncertaintyUnivariate><si:expandedMU><si:valueExpandedMU>" + U +
           "</si:valueExpandedMU><si:coverageFactor>" + k + "</si:coverageFactor>" +
           (p.empty() ? "" : "<si:coverageProbability>" + p + "</si:coverageProbability>") +
           (distribution.empty() ? "" : "<si:distribution>" + distribution + "</si:distribution>") +
           "</si:expandedMU></si:measurementUncertaintyUnivariate>";
}

std::string limit(const std::string& ref_type, const std::string& value, const std::string& unit = "\\micro\\metre") {
    return "<dcc:quantity refType=\"" + ref_type + "\"><si:real><si:value>" + value + "</si:value><si:unit>" + unit +
           "</si:unit></si:real></dcc:quantity>";
}

/// A certificate with one length of 10.00 µm.
std::string document(const std::string& stated, const std::string& meta = "", const std::string& statements = "",
                     const std::string& unit = "\\micro\\metre") {
    return R"(<dcc:digitalCalibrationCertificate xmlns:dcc="https://ptb.de/dcc" xmlns:si="https://ptb.de/si" schemaVersion="3.3.0">
<dcc:administrativeData><dcc:coreData><dcc:uniqueIdentifier>K-17</dcc:uniqueIdentifier></dcc:coreData>
<dcc:statements>)" +
           statements + R"(</dcc:statements></dcc:administrativeData>
<dcc:measurementResults><dcc:measurementResult><dcc:results><dcc:result><dcc:name><dcc:content>Lengths</dcc:content></dcc:name>
<dcc:data><dcc:quantity refType="basic_measuredValue"><dcc:name><dcc:content>length</dcc:content></dcc:name>
<si:real><si:value>10.00</si:value><si:unit>)" +
           unit + "</si:unit>" + stated + "</si:real>" +
           (meta.empty() ? ""
                         : "<dcc:measurementMetaData><dcc:metaData refId=\"s\" refType=\"basic_conformity\">" + meta +
                               "</dcc:metaData></dcc:measurementMetaData>") +
           R"(</dcc:quantity></dcc:data></dcc:result></dcc:results></dcc:measurementResult></dcc:measurementResults>
</dcc:digitalCalibrationCertificate>)";
}

std::string rule_statement(const std::string& words) {
    return "<dcc:statement id=\"s\" refType=\"basic_conformity\"><dcc:declaration><dcc:content>" + words +
           "</dcc:content></dcc:declaration></dcc:statement>";
}

std::vector<std::string> rules_found(const AuditSubject& subject) {
    std::vector<std::string> found;
    for (const AuditFinding& finding : audit(subject, all_rules()).findings) {
        found.push_back(finding.rule);
    }
    return found;
}
bool finds(const AuditSubject& subject, const std::string& rule) {
    const std::vector<std::string> found = rules_found(subject);
    return std::find(found.begin(), found.end(), rule) != found.end();
}

TEST(SubjectOfCertificate, TakesResultsAsTheyArePrinted) {
    const AuditSubject subject = subject_of_text(document(uncertainty("0.31", "2.00", "0.9545")));
    EXPECT_EQ(subject.kind, AuditSubject::Kind::certificate);
    ASSERT_EQ(subject.budgets.size(), 1U);
    const AuditedBudget& budget = subject.budgets.front();
    EXPECT_EQ(budget.name, "length");
    EXPECT_EQ(budget.place, "Lengths / length (basic_measuredValue)");
    EXPECT_EQ(budget.unit, "um");
    EXPECT_TRUE(budget.rows.empty());
    EXPECT_EQ(budget.claims.value->text, "10.00");
    EXPECT_EQ(budget.claims.U->text, "0.31");
    EXPECT_EQ(budget.claims.k->value, 2.0);
    EXPECT_EQ(budget.claims.coverage_probability, 0.9545);
    EXPECT_EQ(rules_found(subject), std::vector<std::string>{});
    const AuditReport report = audit(subject, all_rules());
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_NEAR(report.results.front().claimed.u_c, 0.155, 1e-12);
    EXPECT_EQ(report.results.front().audited.printed_U, "0.31");
}

TEST(SubjectOfCertificate, SaysWhatNeedsRows) {
    const AuditReport report = audit(subject_of_text(document(uncertainty("0.31", "2.00", "0.9545"))), all_rules());
    for (const char* rule : {"B01", "U10", "R07", "T01"}) {
        EXPECT_TRUE(std::any_of(report.not_checked.begin(), report.not_checked.end(),
                                [rule](const RuleNotChecked& one) { return one.rule == rule; }))
            << rule;
    }
    for (const char* rule : {"R01", "R02", "R04", "K03", "K13"}) {
        EXPECT_FALSE(std::any_of(report.not_checked.begin(), report.not_checked.end(),
                                 [rule](const RuleNotChecked& one) { return one.rule == rule; }))
            << rule;
    }
}

TEST(SubjectOfCertificate, FindsWhatIsWrongWithTheStatementOfUncertainty) {
    EXPECT_TRUE(finds(subject_of_text(document(uncertainty("0.3125", "2.00", "0.9545"))), "R01"));
    EXPECT_TRUE(finds(subject_of_text(document(uncertainty("0.3", "2.00", "0.9545"))), "R02"));
    EXPECT_TRUE(finds(subject_of_text(document(uncertainty("0.31", "2.00", ""))), "R04"));
    EXPECT_TRUE(finds(subject_of_text(document(uncertainty("0.31", "1.60", "0.9545"))), "K03"));
    EXPECT_FALSE(finds(subject_of_text(document(uncertainty("0.31", "2.13", "0.9545"))), "K03"))
        << "nobody knows its ν_eff";
    EXPECT_TRUE(finds(subject_of_text(document(uncertainty("0.31", "2.00", "0.9545"), "", "", "")), "R05"));
}

/// The law: k is accused where the stated distribution cannot have it at its p, and nowhere else.
TEST(SubjectOfCertificate, HoldsTheFactorAgainstTheStatedDistribution) {
    const auto is_accused = [](const char* k, const std::string& distribution) {
        return finds(subject_of_text(document(uncertainty("0.31", k, "0.9545", distribution))), "K03");
    };
    for (const char* const k : {"1.50", "1.66", "1.83", "1.91", "1.97", "2.00", "2.13", "2.40"}) {
        const double number = std::stod(k);
        EXPECT_EQ(is_accused(k, "normal"), number < 1.98 || number > 2.12) << k;
        EXPECT_EQ(is_accused(k, "student_t"), number < 1.98 && number != 1.98) << k;
        EXPECT_EQ(is_accused(k, ""), number < 1.63) << k << ": a rectangular contribution may dominate";
        for (const char* const name : {"convolution", "Convolution", "monte_carlo", "arcsine"}) {
            EXPECT_FALSE(is_accused(k, name)) << k << " " << name;
            AuditSubject subject = subject_of_text(document(uncertainty("0.31", k, "0.9545", name)));
            subject.budgets.at(0).claims.nu_eff = exact_number(std::numeric_limits<double>::infinity(), "");
            EXPECT_FALSE(finds(subject, "K03")) << k << " " << name << ": its nu_eff is not that of a t-distribution";
        }
    }
}

TEST(SubjectOfCertificate, TellsAWrongVerdictOrFactorOnce) {
    const auto check = [](const char* code, const std::string& what) {
        return gum::Diagnostic{.code = code,
                               .where = "c.xml:3:4",
                               .what = what,
                               .rule = "a rule",
                               .action = "do it",
                               .severity = gum::Severity::error};
    };
    const auto times = [](const AuditSubject& subject, const std::string& rule) {
        const std::vector<std::string> found = rules_found(subject);
        return std::count(found.begin(), found.end(), rule);
    };
    const std::string meta =
        "<dcc:conformity>pass</dcc:conformity><dcc:data>" + limit("basic_toleranceLimitUpper", "9.90") + "</dcc:data>";
    const gum::Diagnostic beyond =
        check("GC-DCC-0116", "pass for 10.00 \\micro\\metre, which is outside of a limit beside it");
    const std::string stated = uncertainty("0.31", "2.00", "0.9545");
    EXPECT_EQ(times(subject_of_text(document(stated, meta, rule_statement("DR-01")), {beyond}), "D04"), 1);
    EXPECT_EQ(times(subject_of_text(document(stated, meta, rule_statement("As agreed.")), {beyond}), "D04"), 1)
        << "where the rule cannot decide, the check says it";
    const gum::Diagnostic other =
        check("GC-DCC-0116", "pass for 0.04 \\micro\\metre, which is outside of a limit beside it");
    EXPECT_EQ(times(subject_of_text(document(stated, meta, rule_statement("DR-01")), {other}), "D04"), 2);
    const gum::Diagnostic factor =
        check("GC-DCC-0117", "coverage factor 1.70 and probability 0.9545 of a distribution that is called normal");
    EXPECT_EQ(times(subject_of_text(document(uncertainty("0.31", "1.70", "0.9545", "normal")), {factor}), "K03"), 1);
}

TEST(SubjectOfCertificate, AsksForNoFactorOfAnInterval) {
    const AuditSubject subject = subject_of_text(document(
        "<si:measurementUncertaintyUnivariate><si:coverageIntervalMU><si:valueStandardMU>0.10</si:valueStandardMU>"
        "<si:intervalMin>9.90</si:intervalMin><si:intervalMax>10.28</si:intervalMax>"
        "<si:coverageProbability>0.95</si:coverageProbability></si:coverageIntervalMU>"
        "</si:measurementUncertaintyUnivariate>"));
    ASSERT_EQ(subject.budgets.size(), 1U);
    EXPECT_NEAR(subject.budgets.front().coverage.k, 2.8, 1e-12) << "10.28 is farther from 10.00 than 9.90";
    EXPECT_EQ(rules_found(subject), std::vector<std::string>{});
}

/// A rule with U takes of an interval the larger distance of an end from the value, or half of its width: a verdict is accused where
/// neither gives it.
TEST(SubjectOfCertificate, DecidesByAnIntervalAsTheCertificateDid) {
    const std::string interval =
        "<si:measurementUncertaintyUnivariate><si:coverageIntervalMU><si:valueStandardMU>0.10</si:valueStandardMU>"
        "<si:intervalMin>9.90</si:intervalMin><si:intervalMax>10.28</si:intervalMax>"
        "<si:coverageProbability>0.95</si:coverageProbability></si:coverageIntervalMU>"
        "</si:measurementUncertaintyUnivariate>";
    for (const double upper : {10.10, 10.18, 10.20, 10.27, 10.29, 10.40}) {
        for (const std::string verdict : {"pass", "fail"}) {
            const std::string meta = "<dcc:conformity>" + verdict + "</dcc:conformity><dcc:data>" +
                                     limit("basic_toleranceLimitUpper", std::to_string(upper)) + "</dcc:data>";
            const AuditSubject subject = subject_of_text(document(interval, meta, rule_statement("DR-03")));
            const bool may_pass = upper > 10.19, may_fail = upper < 10.28;
            const bool is_explained = verdict == "pass" ? may_pass : may_fail;
            EXPECT_EQ(finds(subject, "D04"), !is_explained) << upper << " " << verdict;
            EXPECT_EQ(evaluate(subject.budgets.at(0)).verdict == verdict, is_explained) << upper << " " << verdict;
        }
    }
}

/// Where one limit is stated, an interval that lies within it with its nearer end passes; and numbers out of all range are no end of
/// the audit.
TEST(SubjectOfCertificate, DecidesByTheEndOfAnIntervalOnTheSideOfTheLimit) {
    const auto accused = [](const std::string& low, const std::string& high, const std::string& u, const char* side,
                            const std::string& limit_value, const std::string& verdict) {
        const std::string interval =
            "<si:measurementUncertaintyUnivariate><si:coverageIntervalMU><si:valueStandardMU>" + u +
            "</si:valueStandardMU><si:intervalMin>" + low + "</si:intervalMin><si:intervalMax>" + high +
            "</si:intervalMax><si:coverageProbability>0.95</si:coverageProbability></si:coverageIntervalMU>"
            "</si:measurementUncertaintyUnivariate>";
        const std::string meta =
            "<dcc:conformity>" + verdict + "</dcc:conformity><dcc:data>" + limit(side, limit_value) + "</dcc:data>";
        return finds(subject_of_text(document(interval, meta, rule_statement("DR-03"))), "D04");
    };
    const char *const upper = "basic_toleranceLimitUpper", *const lower = "basic_toleranceLimitLower";
    EXPECT_FALSE(accused("9.60", "10.10", "0.10", upper, "10.15", "pass"));
    EXPECT_TRUE(accused("9.60", "10.10", "0.10", upper, "10.09", "pass"));
    EXPECT_FALSE(accused("9.60", "10.10", "0.10", lower, "9.59", "pass"));
    EXPECT_TRUE(accused("9.60", "10.10", "0.10", lower, "9.80", "pass"));
    EXPECT_FALSE(accused("9.60", "10.10", "0.10", lower, "9.80", "fail"));
    EXPECT_NO_THROW(static_cast<void>(accused("-1e300", "1e300", "1e-200", upper, "10.15", "pass")));
}

TEST(SubjectOfCertificate, DecidesAgainByARuleThatIsNamed) {
    const std::string limits = "<dcc:conformity>pass</dcc:conformity><dcc:data>" +
                               limit("basic_toleranceLimitUpper", "10.20") +
                               limit("basic_toleranceLimitLower", "-10.20") + "</dcc:data>";
    const std::string stated = uncertainty("0.31", "2.00", "0.9545");
    const AuditSubject guarded =
        subject_of_text(document(stated, limits, rule_statement("Decision rule: DR-03, w = U")));
    ASSERT_EQ(guarded.budgets.size(), 1U);
    EXPECT_EQ(guarded.budgets.front().rule, gum::DecisionRule::guard_band_u);
    EXPECT_EQ(guarded.budgets.front().limits.upper, 10.2);
    EXPECT_TRUE(finds(guarded, "D04")) << "10.00 + 0.31 is outside";
    const AuditSubject simple = subject_of_text(document(stated, limits, rule_statement("Decision rule: DR-01")));
    EXPECT_FALSE(finds(simple, "D04"));
    EXPECT_EQ(simple.budgets.front().claims.verdict, "pass");
}

TEST(SubjectOfCertificate, DecidesByAcceptanceLimits) {
    const std::string stated = uncertainty("0.31", "2.00", "0.9545");
    const auto meta = [](const std::string& upper) {
        return "<dcc:conformity>pass</dcc:conformity><dcc:data>" + limit("basic_acceptanceLimitUpper", upper) +
               "</dcc:data>";
    };
    EXPECT_FALSE(finds(subject_of_text(document(stated, meta("10.05"), rule_statement("As agreed."))), "D04"));
    EXPECT_TRUE(finds(subject_of_text(document(stated, meta("9.95"), rule_statement("As agreed."))), "D04"));
    // In another unit of the same kind.
    const std::string metres = "<dcc:conformity>pass</dcc:conformity><dcc:data>" +
                               limit("basic_acceptanceLimitUpper", "0.00000995", "\\metre") + "</dcc:data>";
    EXPECT_TRUE(finds(subject_of_text(document(stated, metres, rule_statement("As agreed."))), "D04"));
}

TEST(SubjectOfCertificate, AsksForARuleAndSaysWhatItCannotDecide) {
    const std::string stated = uncertainty("0.31", "2.00", "0.9545");
    EXPECT_TRUE(finds(subject_of_text(document(stated, "<dcc:conformity>pass</dcc:conformity>")), "D01"));
    const AuditSubject words =
        subject_of_text(document(stated, "<dcc:conformity>pass</dcc:conformity>", rule_statement("As agreed.")));
    EXPECT_FALSE(finds(words, "D01"));
    ASSERT_EQ(words.not_read.size(), 1U);
    EXPECT_NE(words.not_read.front().english().find("was not decided again"), std::string::npos);
}

TEST(SubjectOfCertificate, TakesChecksOfTheDocument) {
    const std::string xml = document(uncertainty("0.31", "2.00", "0.9545"));
    const auto check = [](const char* code, gum::Severity severity) {
        return gum::Diagnostic{.code = code,
                               .where = "c.xml:3:4",
                               .what = std::string("what ") + code + " says",
                               .rule = "a rule",
                               .action = "do it",
                               .severity = severity};
    };
    const AuditSubject subject =
        subject_of_text(xml, {check("GC-DCC-0041", gum::Severity::error), check("GC-DCC-0048", gum::Severity::warning),
                              check("GC-DCC-0112", gum::Severity::error), check("GC-DCC-0113", gum::Severity::error),
                              check("GC-DCC-0021", gum::Severity::warning), check("GC-DCC-0044", gum::Severity::note)});
    std::vector<std::string> found = rules_found(subject);
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, (std::vector<std::string>{"P01", "P05", "R07"})) << "what concerns the form is one finding";
    EXPECT_EQ(subject.not_read.size(), 1U);
}

TEST(SubjectOfCertificate, SaysThatAStandardWasNotValid) {
    std::string xml = document(uncertainty("0.31", "2.00", "0.9545"));
    xml.insert(xml.find("<dcc:results>"),
               "<dcc:measuringEquipments><dcc:measuringEquipment><dcc:name><dcc:content>bench</dcc:content></dcc:name>"
               "<dcc:certificate><dcc:inValidityRange>false</dcc:inValidityRange></dcc:certificate>"
               "</dcc:measuringEquipment></dcc:measuringEquipments>");
    EXPECT_EQ(rules_found(subject_of_text(xml)), std::vector<std::string>{"T01"});
}

TEST(SubjectOfCertificate, TakesOneLimitForAllRowsAndNamesPoints) {
    const std::string list =
        R"(<dcc:list><dcc:quantity refType="basic_referenceValue"><si:realListXMLList><si:valueXMLList>300 400</si:valueXMLList>
<si:unitXMLList>\kelvin</si:unitXMLList></si:realListXMLList></dcc:quantity>
<dcc:quantity refType="basic_measurementError"><dcc:name><dcc:content>error</dcc:content></dcc:name>
<si:realListXMLList><si:valueXMLList>0.10 0.90</si:valueXMLList><si:unitXMLList>\kelvin</si:unitXMLList>
<si:expandedUncXMLList><si:uncertaintyXMLList>0.06</si:uncertaintyXMLList><si:coverageFactorXMLList>2</si:coverageFactorXMLList>
<si:coverageProbabilityXMLList>0.95</si:coverageProbabilityXMLList></si:expandedUncXMLList></si:realListXMLList>
<dcc:measurementMetaData><dcc:metaData refType="basic_conformity"><dcc:declaration><dcc:content>agreed</dcc:content></dcc:declaration>
<dcc:conformityXMLList>pass</dcc:conformityXMLList><dcc:data><dcc:quantity refType="basic_acceptanceLimitUpper"><si:realListXMLList>
<si:valueXMLList>0.23</si:valueXMLList><si:unitXMLList>\kelvin</si:unitXMLList></si:realListXMLList></dcc:quantity></dcc:data></dcc:metaData>
</dcc:measurementMetaData></dcc:quantity></dcc:list>)";
    std::string xml = document("");
    const std::size_t from = xml.find("<dcc:quantity"), to = xml.find("</dcc:data></dcc:result>");
    xml.replace(from, to - from, list);
    const AuditSubject subject = subject_of_text(xml);
    ASSERT_EQ(subject.budgets.size(), 2U);
    EXPECT_EQ(subject.budgets[1].name, "error, 400 K");
    EXPECT_EQ(subject.budgets[0].limits.upper, 0.23);
    EXPECT_EQ(subject.budgets[1].limits.upper, 0.23);
    const AuditReport report = audit(subject, all_rules());
    const auto verdict = std::find_if(report.findings.begin(), report.findings.end(),
                                      [](const AuditFinding& finding) { return finding.rule == "D04"; });
    ASSERT_NE(verdict, report.findings.end());
    EXPECT_EQ(verdict->budgets, std::vector<std::size_t>{1}) << "0.10 K passes, 0.90 K does not";
}

TEST(SubjectOfCertificate, SeesPersonsAndSaysWhichTextsItDoesNotRead) {
    const auto with_persons = [](const std::string& persons) {
        std::string xml =
            document(uncertainty("0.31", "2.00", "0.9545"), "",
                     "<dcc:statement refType=\"basic_recalibration\"><dcc:declaration><dcc:content>Again in a "
                     "year</dcc:content></dcc:declaration></dcc:statement>"
                     "<dcc:statement refType=\"gumcert_opinion\"><dcc:declaration><dcc:content>It will "
                     "last.</dcc:content></dcc:declaration></dcc:statement>");
        xml.insert(xml.find("<dcc:statements>"), "<dcc:respPersons>" + persons + "</dcc:respPersons>");
        return subject_of_text(xml);
    };
    const auto person = [](const std::string& name, const std::string& role) {
        return "<dcc:respPerson><dcc:person><dcc:name><dcc:content>" + name + "</dcc:content></dcc:name></dcc:person>" +
               (role.empty() ? "" : "<dcc:role>" + role + "</dcc:role>") + "</dcc:respPerson>";
    };
    const AuditSubject sound =
        with_persons(person("A. N.", "calibration") + person("B. M.", "review") + person("C. O.", "approval"));
    EXPECT_EQ(sound.certificate->data.persons.authorised_by->name, "C. O.");
    EXPECT_FALSE(finds(sound, "P04"));
    EXPECT_FALSE(finds(sound, "R07"));
    EXPECT_EQ(sound.not_read,
              std::vector<Sentence>{"statements in words were not read: basic_recalibration, gumcert_opinion"});
    EXPECT_TRUE(finds(with_persons(person("A. N.", "calibration") + person("A.N.", "review")), "P04"));
    EXPECT_TRUE(finds(with_persons(person("A. N.", "") + person("B. M.", "")), "R07")) << "who authorised it?";
    EXPECT_FALSE(finds(with_persons(person("A. N.", "")), "R07")) << "the only one";
}

TEST(SubjectOfCertificate, CriticisesNoGoodExampleOfOthers) {
    const std::filesystem::path examples = std::filesystem::path(GUMCERT_SHARED_DIR) / "dcc" / "examples";
    std::error_code error;
    if (!std::filesystem::is_directory(examples, error)) {
        GTEST_SKIP() << examples << " is not there";
    }
    for (const auto& entry : std::filesystem::directory_iterator(examples)) {
        if (entry.path().extension() != ".xml") {
            continue;
        }
        std::ifstream stream(entry.path(), std::ios::binary);
        const std::string xml{std::istreambuf_iterator<char>(stream), {}};
        const AuditSubject subject = subject_of_text(xml);
        EXPECT_FALSE(subject.budgets.empty()) << entry.path();
        EXPECT_FALSE(audit(subject, all_rules()).has_critical()) << entry.path();
    }
}

}  // namespace
}  // namespace gumcert::audit
