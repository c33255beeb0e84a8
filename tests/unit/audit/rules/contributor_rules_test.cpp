#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "tests/support/audit_subject.h"

namespace gumcert::audit {
namespace {

using test::audited_row;
using test::found_by;
using test::sound_budget;
using test::subject_with;
using testing::HasSubstr;

std::string contributor_finding(std::string_view id, const AuditedBudget& budget) {
    return found_by(contributor_rules(), id, subject_with({budget}));
}
void drop(AuditedBudget& budget, Contributor contributor) {
    std::erase_if(budget.rows, [contributor](const AuditedRow& row) { return row.contributor == contributor; });
}

TEST(ContributorRules, find_nothing_in_a_complete_budget) {
    for (const Rule& rule : contributor_rules()) {
        EXPECT_EQ(contributor_finding(rule.id, sound_budget()), "") << rule.id;
    }
}

TEST(ContributorRules, B01_asks_for_the_minimum_of_every_method) {
    AuditedBudget budget = sound_budget();
    drop(budget, Contributor::temperature);
    EXPECT_EQ(contributor_finding("B01", budget), "no row for environment");
    budget = sound_budget();
    budget.rows[3].used_u = 0.0;
    EXPECT_EQ(contributor_finding("B01", budget), "named without a number: repeatability");
    // Equal readings were taken, and the step of the display is their contribution (JCGM 100:2008, F.2.2.1).
    budget.rows[3].type_a = true;
    budget.rows[3].readings = {10.01};
    EXPECT_EQ(contributor_finding("B01", budget), "named without a number: repeatability");
    budget.rows[3].readings = {10.01, 10.01, 10.01};
    EXPECT_EQ(contributor_finding("B01", budget), "");
    // The step of another quantity, as of a thermometer, is no scatter of these readings, nor is one that the sum leaves out.
    AuditedBudget other = budget;
    for (AuditedRow& row : other.rows) {
        row.unit = row.contributor == Contributor::item_resolution ? "degC" : "mm";
    }
    EXPECT_EQ(contributor_finding("B01", other), "named without a number: repeatability");
    for (AuditedRow& row : other.rows) {
        row.unit = row.contributor == Contributor::item_resolution ? "um" : "mm";
    }
    EXPECT_EQ(contributor_finding("B01", other), "");
    for (AuditedRow& row : other.rows) {
        row.in_sum = row.contributor != Contributor::item_resolution;
    }
    EXPECT_EQ(contributor_finding("B01", other), "named without a number: repeatability");
    drop(budget, Contributor::item_resolution);
    EXPECT_THAT(contributor_finding("B01", budget), HasSubstr("named without a number: repeatability"));
}

TEST(ContributorRules, B01_asks_for_the_checklist_of_the_method) {
    AuditedBudget budget = sound_budget();
    budget.method = "end_gauge_comparison";
    const std::string found = contributor_finding("B01", budget);
    EXPECT_THAT(found, HasSubstr("thermal expansion coefficients"));
    EXPECT_THAT(found, HasSubstr("central length"));
    EXPECT_THAT(found, testing::Not(HasSubstr("reference")));
    budget.rows.push_back(audited_row("alpha", 0.01, Contributor::expansion));
    budget.rows.push_back(audited_row("place of the contact", 0.01, Contributor::other));
    EXPECT_EQ(contributor_finding("B01", budget), "");
}

TEST(ContributorRules, B01_says_how_large_the_missing_contribution_must_be) {
    AuditedBudget budget = sound_budget(), second = sound_budget();
    drop(budget, Contributor::temperature);
    drop(second, Contributor::temperature);
    const AuditReport report = audit(subject_with({budget, second}), contributor_rules());
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].severity, FindingSeverity::major);
    EXPECT_EQ(report.findings[0].budgets, (std::vector<std::size_t>{0, 1}));
    EXPECT_EQ(report.findings[0].where, "length and 1 more");
    ASSERT_TRUE(report.findings[0].missing_term);
    EXPECT_GT(report.findings[0].missing_term->u_for_digit, 0.0);
}

TEST(ContributorRules, B01_is_minor_where_rows_were_not_recognised) {
    AuditedBudget budget = sound_budget();
    drop(budget, Contributor::temperature);
    budget.rows.push_back(audited_row("x3", 0.01, Contributor::other));
    const auto findings = test::findings_of(contributor_rules(), "B01", subject_with({budget}));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].severity, FindingSeverity::minor);
    EXPECT_THAT(findings[0].evidence, testing::Contains("rows that were not recognised: 1"));
}

TEST(ContributorRules, B02_asks_for_the_drift_of_a_reference) {
    AuditedBudget budget = sound_budget();
    budget.rows[1].used_u = 0.0;
    AuditSubject subject = test::subject_with_certificate({budget});
    certificate::StandardUsed standard;
    standard.identification = "EX-7";
    standard.calibrated = "2026-01-01";
    subject.certificate->data.standards = {standard};
    subject.certificate->data.dates.performed_from = "2026-03-02";
    const auto findings = test::findings_of(contributor_rules(), "B02", subject);
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_THAT(findings[0].evidence, testing::Contains("EX-7: calibrated 60 days before the work"));
    EXPECT_TRUE(findings[0].contribution_missing);
    drop(budget, Contributor::reference);
    EXPECT_EQ(contributor_finding("B02", budget), "");
}

TEST(ContributorRules, B03_counts_the_calibrations_behind_a_drift) {
    AuditedBudget budget = sound_budget();
    budget.rows[1].comment = "from 2 calibrations";
    EXPECT_EQ(contributor_finding("B03", budget), "the drift is estimated from 2 calibrations");
    budget.rows[1].comment = "aus 3 Kalibrierungen";
    EXPECT_EQ(contributor_finding("B03", budget), "");
}

TEST(ContributorRules, B04_asks_for_the_customers_device) {
    AuditedBudget budget = sound_budget();
    drop(budget, Contributor::item_resolution);
    EXPECT_EQ(contributor_finding("B04", budget), "");
    drop(budget, Contributor::repeatability);
    EXPECT_THAT(contributor_finding("B04", budget), HasSubstr("customer's device"));
    budget.rows.push_back(audited_row("zero of the DUT", 0.01, Contributor::other));
    EXPECT_EQ(contributor_finding("B04", budget), "");
}

TEST(ContributorRules, B05_asks_for_reproducibility) {
    AuditedBudget budget = sound_budget();
    drop(budget, Contributor::reproducibility);
    EXPECT_THAT(contributor_finding("B05", budget), HasSubstr("reproducibility"));
    budget.rows.push_back(audited_row("operator", 0.01, Contributor::other));
    EXPECT_EQ(contributor_finding("B05", budget), "");
}

TEST(ContributorRules, B06_asks_for_the_uncertainty_of_a_fit) {
    AuditedBudget budget = sound_budget();
    budget.equation = "y = a + b x, fit by least squares";
    EXPECT_THAT(contributor_finding("B06", budget), HasSubstr("comes from a fit"));
    budget.rows.push_back(audited_row("parameters of the curve", 0.01, Contributor::fit));
    EXPECT_EQ(contributor_finding("B06", budget), "");
}

TEST(ContributorRules, B07_asks_for_the_interpolation) {
    AuditedBudget budget = sound_budget();
    budget.rows[0].comment = "interpolated between the points 10 and 20";
    EXPECT_THAT(contributor_finding("B07", budget), HasSubstr("interpolated"));
    budget.rows.push_back(audited_row("interpolation", 0.01, Contributor::fit));
    EXPECT_EQ(contributor_finding("B07", budget), "");
}

TEST(ContributorRules, B08_compares_the_rows_of_one_method) {
    AuditedBudget other = sound_budget();
    other.method = "weights";
    AuditedBudget budget = other;
    budget.rows.push_back(audited_row("buoyancy", 0.01, Contributor::environment));
    EXPECT_EQ(found_by(contributor_rules(), "B08", subject_with({other, budget})),
              "this budget and that of length, of the same method, have different rows: buoyancy");
    EXPECT_EQ(found_by(contributor_rules(), "B08", subject_with({other, other})), "");
    budget.method = "torque_wrench";
    EXPECT_EQ(found_by(contributor_rules(), "B08", subject_with({other, budget})), "");
}

}  // namespace
}  // namespace gumcert::audit
