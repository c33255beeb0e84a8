#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using testing::HasSubstr;

AuditedRow row_of_number(const std::string& name, double estimate, double u, Shape shape = Shape::normal) {
    AuditedRow row = test::audited_row(name, u, Contributor::other);
    row.unit = "1";
    row.estimate = exact_number(estimate, "row " + name);
    row.shape = shape;
    return row;
}

AuditSubject subject_of_equation(const std::string& equation, std::vector<AuditedRow> rows) {
    AuditedBudget budget;
    budget.name = "y";
    budget.unit = "1";
    budget.place = "table";
    budget.equation = equation;
    budget.rows = std::move(rows);
    budget.coverage.kind = CoverageRule::Kind::fixed;
    return test::subject_with({budget});
}

AuditReport bounded(const AuditSubject& subject) {
    const std::vector<Rule> rules{certified_bound_rule()};
    return audit(subject, rules);
}

TEST(CertifiedBound, AsksNothingOfAResultThatRestsOnTrials) {
    AuditSubject subject = subject_of_equation("y = a*a", {row_of_number("a", 0.0, 1.0)});
    subject.budgets[0].variance_beyond_tangent = 2.0;
    ASSERT_EQ(bounded(subject).findings.size(), 1U);
    subject.budgets[0].rests_on_trials = true;
    const AuditReport report = bounded(subject);
    EXPECT_TRUE(report.findings.empty());
    ASSERT_EQ(report.not_checked.size(), 1U);
    EXPECT_THAT(report.not_checked[0].because.english(), HasSubstr("Monte Carlo trials"));
}

TEST(CertifiedBound, AnswersWhereNothingIsLost) {
    std::vector<AuditedRow> rows{row_of_number("a", 10.0, 0.01), row_of_number("b", 2.0, 0.002)};
    rows[0].used_sensitivity = 2.0;
    rows[1].used_sensitivity = 10.0;
    // U = 2·√(0.02² + 0.02²) = 0.057: half a unit of its last digit is 0.0005; the product leaves out 0.02·0.004.
    const AuditReport report = bounded(subject_of_equation("y = a*b", rows));
    EXPECT_TRUE(report.findings.empty());
    EXPECT_TRUE(report.not_checked.empty());
    ASSERT_EQ(report.notes.size(), 1U);
    EXPECT_EQ(report.notes.front().rule, "S19");
    EXPECT_THAT(report.notes.front().what.english(), HasSubstr("bounded by 8.005e-05"));
    EXPECT_THAT(report.notes.front().what.english(), HasSubstr("half a unit of the last digit of U is 0.0005"));
}

TEST(CertifiedBound, IsMajorWhereTheEquationCertainlyLeavesItsTangent) {
    // y = a² at 0.1 with u = 0.1: what is left out reaches (2·0.1)² = 0.04; U = 0.04, its last digit 0.001.
    std::vector<AuditedRow> rows{row_of_number("a", 0.1, 0.1)};
    rows[0].used_sensitivity = 0.2;
    const AuditReport report = bounded(subject_of_equation("y = a^2", rows));
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings.front().severity, FindingSeverity::major);
    EXPECT_THAT(report.findings.front().what.english(), HasSubstr("leaves its tangent by 0.03998 at least"));
    EXPECT_TRUE(report.notes.empty());
}

TEST(CertifiedBound, IsMilderWhereTheLawWasValidated) {
    std::vector<AuditedRow> rows{row_of_number("a", 0.1, 0.1)};
    rows[0].used_sensitivity = 0.2;
    AuditSubject subject = subject_of_equation("y = a^2", rows);
    subject.budgets.front().monte_carlo = StatedMonteCarlo{};
    EXPECT_EQ(bounded(subject).findings.front().severity, FindingSeverity::information);
}

TEST(CertifiedBound, LooksAtBoundedQuantitiesWithinTheirLimits) {
    const auto evidence = [](Shape shape) {
        std::vector<AuditedRow> rows{row_of_number("a", 0.1, 0.1, shape)};
        rows[0].used_sensitivity = 0.2;
        return bounded(subject_of_equation("y = a^2", rows)).findings.front().evidence.front().english();
    };
    EXPECT_THAT(evidence(Shape::normal), HasSubstr("to 0.04"));
    EXPECT_THAT(evidence(Shape::rectangular), HasSubstr("to 0.03"));
    EXPECT_THAT(evidence(Shape::triangular), HasSubstr("to 0.06"));
    EXPECT_THAT(evidence(Shape::arcsine), HasSubstr("to 0.02"));
}

TEST(CertifiedBound, SaysWhatItCannotLookAt) {
    const auto because = [](const std::string& equation, std::vector<AuditedRow> rows) {
        const AuditReport report = bounded(subject_of_equation(equation, std::move(rows)));
        EXPECT_TRUE(report.findings.empty() && report.notes.empty()) << equation;
        EXPECT_EQ(report.not_checked.size(), 1U) << equation;
        return report.not_checked.empty() ? "" : report.not_checked.front().because.english();
    };
    EXPECT_EQ(because("y = 1/a", {row_of_number("a", 0.1, 0.1)}), "y: \"1/a\": the divisor may be 0 there");
    EXPECT_EQ(because("y = abs(a)", {row_of_number("a", 0.1, 0.1)}), "y: \"abs(a)\": a kink may lie there");
    EXPECT_THAT(because("y = a*b", {row_of_number("a", 0.1, 0.1)}),
                HasSubstr("no row, or more than one, stands for b"));
    EXPECT_THAT(because("0 = y - a", {row_of_number("a", 0.1, 0.1)}), HasSubstr("implicit"));
    EXPECT_EQ(because("", {row_of_number("a", 0.1, 0.1)}), "no equation of the measurement is stated");
}

}  // namespace
}  // namespace gumcert::audit
