#include "audit/rule.h"

#include <gtest/gtest.h>

#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

TEST(FindingCollector, FillsInWhatTheRuleSays) {
    const Rule rule{.id = "Z01",
                    .title = "",
                    .clause = {.text = ""},
                    .severity = FindingSeverity::minor,
                    .correction = "Do it.",
                    .question = "Why?"};
    FindingCollector collector(rule);
    AuditFinding one;
    one.where = "row 1";
    one.what = "wrong";
    one.budgets = {0};
    collector.add(one);
    one.budgets = {3};
    collector.add(one);  // the same at another point
    one.what = "otherwise wrong";
    one.question = "Really?";
    collector.add(one);
    const std::vector<AuditFinding> findings = collector.take();
    ASSERT_EQ(findings.size(), 2U);
    EXPECT_EQ(findings[0].rule, "Z01");
    EXPECT_EQ(findings[0].severity, FindingSeverity::minor);
    EXPECT_EQ(findings[0].correction, "Do it.");
    EXPECT_EQ(findings[0].question, "Why?");
    EXPECT_EQ(findings[0].budgets, (std::vector<std::size_t>{0, 3}));
    EXPECT_EQ(findings[1].question, "Really?");
    EXPECT_TRUE(collector.take().empty());
}

TEST(Rule, AppliesWhereItsNeedsAreMet) {
    const Rule needs{.id = "Z01", .title = "", .clause = {.text = ""}, .needs = {Need::rows, Need::model}};
    AuditedBudget budget = test::budget_of({});
    EXPECT_EQ(why_not_applicable(needs, test::subject_of(budget)), "no rows of an uncertainty budget were found");
    budget.rows.push_back(test::row("a", 1.0));
    EXPECT_EQ(why_not_applicable(needs, test::subject_of(budget)), "no equation of the measurement is stated");
    budget.equation = "y = a";
    EXPECT_EQ(why_not_applicable(needs, test::subject_of(budget)), "");
}

TEST(Rule, KnowsResultsWithoutRowsAndCertificatesOfOthers) {
    const Rule results{.id = "Z01", .title = "", .clause = {.text = ""}, .needs = {Need::results}};
    const Rule gates{.id = "Z02", .title = "", .clause = {.text = ""}, .needs = {Need::gates}};
    AuditSubject subject = test::subject_of(test::budget_of({}));
    EXPECT_EQ(why_not_applicable(results, subject), "no results were found");
    subject.budgets.front().claims.U = exact_number(1.0, "");
    EXPECT_EQ(why_not_applicable(results, subject), "");
    EXPECT_NE(why_not_applicable(gates, subject), "");
    subject.certificate.emplace();
    EXPECT_EQ(why_not_applicable(gates, subject), "");
    subject.kind = AuditSubject::Kind::certificate;
    EXPECT_NE(why_not_applicable(gates, subject), "");
}

TEST(Rule, AnswersAndSaysWhatItLeftUnchecked) {
    const Rule rule{.id = "Z01", .title = "", .clause = {.text = ""}};
    FindingCollector collector(rule);
    collector.note("bounded");
    collector.leave_unchecked("y: a kink");
    EXPECT_EQ(collector.notes(), std::vector<Sentence>{"bounded"});
    EXPECT_EQ(collector.unchecked(), std::vector<Sentence>{"y: a kink"});
    EXPECT_TRUE(collector.take().empty());
}

}  // namespace
}  // namespace gumcert::audit
