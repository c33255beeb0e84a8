#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/row_edits.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::found_by;
using test::subject_with;
using testing::HasSubstr;

/// Value 10.00 with U = 0.31 within 9 and 11, decided with a guard band of U.
AuditedBudget decided_budget(const std::string& verdict) {
    AuditedBudget budget = test::sound_budget();
    budget.limits = {.lower = 9.0, .upper = 11.0};
    budget.rule = gum::DecisionRule::guard_band_u;
    budget.claims.verdict = verdict;
    return budget;
}

TEST(ConformityRules, find_nothing_in_a_sound_decision) {
    for (const Rule& rule : conformity_rules()) {
        EXPECT_EQ(found_by(conformity_rules(), rule.id, subject_with({decided_budget("pass")})), "") << rule.id;
    }
}

TEST(ConformityRules, D01_and_D03_ask_for_rule_and_limits) {
    AuditedBudget budget = decided_budget("pass");
    budget.rule.reset();
    EXPECT_THAT(found_by(conformity_rules(), "D01", subject_with({budget})), HasSubstr("without a decision rule"));
    EXPECT_EQ(found_by(conformity_rules(), "D03", subject_with({budget})), "");
    budget.limits = {};
    EXPECT_THAT(found_by(conformity_rules(), "D03", subject_with({budget})), HasSubstr("without limits"));
}

TEST(ConformityRules, D04_applies_the_rule_to_what_is_stated) {
    EXPECT_THAT(found_by(conformity_rules(), "D04", subject_with({decided_budget("not conforming")})),
                HasSubstr("gives \"pass\""));
    AuditedBudget outside = decided_budget("i.O.");
    outside.value = 10.8;
    outside.claims.value = read_number("10.80", "");
    EXPECT_THAT(found_by(conformity_rules(), "D04", subject_with({outside})), HasSubstr("does not follow"));
    // 10.6908 + 0.309 is inside of 11, and 10.69 + 0.31 is on the limit; 10.6912 prints the same and is outside.
    AuditedBudget rounded = decided_budget("");
    rounded.value = 10.6912;
    rounded.claims.value = read_number("10.69", "");
    EXPECT_THAT(found_by(conformity_rules(), "D04", subject_with({rounded})), HasSubstr("with the unrounded numbers"));
    rounded.value = 10.6905;
    EXPECT_EQ(found_by(conformity_rules(), "D04", subject_with({rounded})), "");
}

TEST(ConformityRules, D05_holds_the_ratio_against_the_rule) {
    AuditedBudget budget = decided_budget("pass");
    budget.rule_parameters.test_uncertainty_ratio = 4.0;
    EXPECT_THAT(found_by(conformity_rules(), "D05", subject_with({budget})), HasSubstr("ratio is 3.23, below the 4"));
    budget.rule_parameters.alternative = gum::DecisionRule::guard_band_u;
    EXPECT_EQ(found_by(conformity_rules(), "D05", subject_with({budget})), "");
    budget.rule_parameters.alternative.reset();
    budget.rule_parameters.test_uncertainty_ratio = 3.0;
    EXPECT_EQ(found_by(conformity_rules(), "D05", subject_with({budget})), "");
}

TEST(ConformityRules, D06_asks_for_the_results_before_adjustment) {
    AuditSubject subject = test::subject_with_certificate();
    certificate::CertifiedColumn column;
    column.values.emplace_back().verdict.emplace();
    subject.certificate->tables.emplace_back().columns = {column};
    EXPECT_EQ(found_by(conformity_rules(), "D06", subject), "");
    subject.certificate->data.adjustment.emplace().adjusted = true;
    EXPECT_THAT(found_by(conformity_rules(), "D06", subject), HasSubstr("was adjusted"));
    subject.certificate->data.adjustment->as_found.by_language = {{"en", "table 1 shows the results before"}};
    EXPECT_EQ(found_by(conformity_rules(), "D06", subject), "");
}

TEST(ConformityRules, D08_follows_from_findings_on_the_same_budget) {
    static const auto reports_row_0 = [](const AuditSubject& subject, FindingCollector& findings) {
        AuditFinding finding = finding_of(subject, 0, "u is too small");
        finding.correct = scale_u(0, 2.0);
        findings.add(std::move(finding));
    };
    std::vector<Rule> rules = conformity_rules();
    rules.push_back({.id = "U08", .title = "planted", .examine = reports_row_0});
    const auto d08 = [&](const AuditSubject& subject) {
        std::vector<std::string> found;
        for (const AuditFinding& finding : audit(subject, rules).findings) {
            if (finding.rule == "D08") {
                found.push_back(finding.what.english());
            }
        }
        return found;
    };
    EXPECT_THAT(d08(subject_with({decided_budget("pass")})), testing::ElementsAre(HasSubstr("findings are open: U08")));
    EXPECT_THAT(d08(subject_with({test::sound_budget(), decided_budget("pass")})), testing::IsEmpty());
    // The word is that of the gravity.
    const auto planted = [](FindingSeverity severity, std::string_view id) {
        return Rule{.id = id,
                    .title = "planted",
                    .policy = SeverityPolicy::fixed,
                    .severity = severity,
                    .examine = reports_row_0};
    };
    const auto said = [&](std::vector<Rule> of_uncertainty) {
        rules = conformity_rules();
        rules.insert(rules.end(), of_uncertainty.begin(), of_uncertainty.end());
        const std::vector<std::string> found = d08(subject_with({decided_budget("pass")}));
        return found.size() == 1 ? found.front() : "";
    };
    using enum FindingSeverity;
    EXPECT_THAT(said({planted(critical, "U08"), planted(critical, "U09")}),
                HasSubstr("critical findings are open: U08 and U09"));
    EXPECT_THAT(said({planted(major, "U08")}), HasSubstr("major findings are open: U08"));
    EXPECT_THAT(said({planted(major, "U08"), planted(critical, "U09")}),
                HasSubstr("critical findings are open: U09, and major ones: U08"));
    EXPECT_EQ(said({planted(minor, "U08")}), "");
    // What somebody accepts is not open, also where it is accepted behind the audit.
    rules = conformity_rules();
    rules.push_back(planted(major, "U08"));
    rules.push_back(planted(major, "U09"));
    AuditSubject subject = subject_with({decided_budget("pass")});
    const certificate::Waiver waiver{
        .finding = "U08", .where = {}, .by = "A. N.", .date = "2026-03-04", .reason = "Seen and left by agreement."};
    AuditReport report = audit(subject, rules);
    accept_findings(report, std::span(&waiver, 1), rules);
    const auto open = [](const AuditReport& of) {
        std::string words;
        for (const AuditFinding& finding : of.findings) {
            words += finding.rule == "D08" ? finding.what.english() : "";
        }
        return words;
    };
    EXPECT_THAT(open(report), testing::EndsWith("findings are open: U09"));
    subject.waivers = {waiver};
    EXPECT_EQ(open(audit(subject, rules)), open(report));
    rules.pop_back();
    EXPECT_EQ(open(audit(subject, rules)), "");
}

}  // namespace
}  // namespace gumcert::audit
