#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::found_by;
using test::sound_budget;
using test::subject_with;
using testing::HasSubstr;

AuditSubject printed_as(const std::string& value, const std::string& U) {
    AuditedBudget budget = sound_budget();
    budget.claims.value = read_number(value, "");
    budget.claims.U = read_number(U, "");
    return subject_with({budget});
}

TEST(ReportingRules, find_nothing_in_a_sound_statement) {
    for (const Rule& rule : reporting_rules()) {
        EXPECT_EQ(found_by(reporting_rules(), rule.id, subject_with({sound_budget()})), "") << rule.id;
    }
}

TEST(ReportingRules, R01_counts_significant_digits) {
    EXPECT_THAT(found_by(reporting_rules(), "R01", printed_as("10.000", "0.312")), HasSubstr("more than two"));
    EXPECT_EQ(found_by(reporting_rules(), "R01", printed_as("10.000", "0.031")), "");
    EXPECT_EQ(found_by(reporting_rules(), "R01", printed_as("12340", "1200")), "");
    EXPECT_NE(found_by(reporting_rules(), "R01", printed_as("12340", "1230")), "");
    // Nobody prints all digits of a double: formulas were replaced by their numbers, and a format shows fewer.
    EXPECT_EQ(found_by(reporting_rules(), "R01", printed_as("12.345678901234567", "0.31234567890123456")), "");
    EXPECT_EQ(found_by(reporting_rules(), "R02", printed_as("12.345678901234567", "0.31234567890123456")), "");
    // A frequency is printed with more digits than an uncertainty ever is.
    EXPECT_NE(found_by(reporting_rules(), "R02", printed_as("10000000.00012", "0.0003")), "");
    AuditSubject workbook = printed_as("10.000", "0.312");
    workbook.kind = AuditSubject::Kind::workbook;
    EXPECT_EQ(found_by(reporting_rules(), "R01", workbook), "");
    AuditSubject record = printed_as("10.000", "0.312");
    record.kind = AuditSubject::Kind::record;
    EXPECT_EQ(test::findings_of(reporting_rules(), "R01", record).at(0).severity, FindingSeverity::major);
}

TEST(ReportingRules, R02_compares_the_last_places) {
    EXPECT_THAT(found_by(reporting_rules(), "R02", printed_as("10.0", "0.31")), HasSubstr("different decimal places"));
    EXPECT_EQ(found_by(reporting_rules(), "R02", printed_as("10.00", "0.31")), "");
    EXPECT_EQ(found_by(reporting_rules(), "R02", printed_as("12340", "120")), "");
}

TEST(ReportingRules, R03_sees_rows_that_were_rounded_before_they_were_added) {
    AuditedBudget budget = sound_budget();
    budget.rows.resize(1);
    AuditedRow& row = budget.rows[0];
    row.stated = read_number("0.240", "");
    row.divisor = read_number("√3", "");
    row.u = read_number("0.1", "");
    row.used_u = 0.1;
    row.u_half_step = 0.05;
    const AuditReport report = audit(subject_with({budget}), reporting_rules());
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].rule, "R03");
    EXPECT_EQ(report.findings[0].expected, "0.28");
    EXPECT_EQ(report.findings[0].actual, "0.20");
    EXPECT_EQ(report.findings[0].severity, FindingSeverity::critical);  // U understated by 39 %
    budget.rows[0].u = read_number("0.139", "");
    budget.rows[0].used_u = 0.139;
    EXPECT_EQ(found_by(reporting_rules(), "R03", subject_with({budget})), "");
    budget.rows[0].u = read_number("0.3", "");  // no rounding of 0.139
    budget.rows[0].used_u = 0.3;
    EXPECT_EQ(found_by(reporting_rules(), "R03", subject_with({budget})), "");
}

TEST(ReportingRules, R04_asks_for_k_and_probability) {
    AuditedBudget budget = sound_budget();
    budget.claims.coverage_probability.reset();
    EXPECT_THAT(found_by(reporting_rules(), "R04", subject_with({budget})),
                HasSubstr("without its coverage probability"));
    budget.claims.coverage_sentence = "k = 2, 95 %";
    EXPECT_EQ(found_by(reporting_rules(), "R04", subject_with({budget})), "");
    budget.claims.k.reset();
    EXPECT_EQ(found_by(reporting_rules(), "R04", subject_with({budget})), "");
    budget.claims.coverage_sentence = "";
    AuditSubject subject = subject_with({budget});
    EXPECT_THAT(found_by(reporting_rules(), "R04", subject), HasSubstr("without coverage factor"));
    EXPECT_EQ(test::findings_of(reporting_rules(), "R04", subject)[0].severity, FindingSeverity::major);
    subject.kind = AuditSubject::Kind::record;
    EXPECT_EQ(test::findings_of(reporting_rules(), "R04", subject)[0].severity, FindingSeverity::critical);
}

TEST(ReportingRules, R05_asks_for_the_unit_and_one_decimal_sign) {
    AuditedBudget budget = sound_budget();
    budget.unit = "";
    EXPECT_EQ(found_by(reporting_rules(), "R05", subject_with({budget})), "the result has no unit");
    budget = sound_budget();
    budget.rows[0].u = read_number("0,10", "");
    EXPECT_EQ(found_by(reporting_rules(), "R05", subject_with({budget})),
              "decimal point and decimal comma stand in one table");
}

TEST(ReportingRules, R06_reads_misprints) {
    EXPECT_THAT(found_by(reporting_rules(), "R06", printed_as("-0.00", "0.31")), HasSubstr("minus sign: -0.00"));
    AuditedBudget budget = sound_budget();
    budget.rows[0].sensitivity = read_number("1.5×10-6", "");
    EXPECT_THAT(found_by(reporting_rules(), "R06", subject_with({budget})), HasSubstr("exponent"));
    EXPECT_EQ(found_by(reporting_rules(), "R06", printed_as("-0.01", "0.31")), "");
}

}  // namespace
}  // namespace gumcert::audit
