// For each rule of readings: a budget that fires, and one that must not.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/audit_rules.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::findings_of;
using test::row;
using test::row_of_readings;
using test::subject_of;

const std::vector<double> k_five = {10.01, 10.03, 9.98, 10.00, 10.02};
constexpr double k_s_of_five = 0.019235384061671353;  // √0.00037

TEST(TypeARules, U01AsksForDegreesOfFreedom) {
    AuditedRow one = row("repeatability", 0.5);
    one.type_a = true;
    one.nu.reset();
    one.n = 5;
    const std::vector<AuditFinding> findings = findings_of("U01", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].expected, "ν = 4");
    EXPECT_NEAR(findings[0].effect->alone.nu_eff, 4.0, 0.01);
    one.n.reset();
    ASSERT_EQ(findings_of("U01", subject_of(one)).size(), 1U);
    EXPECT_FALSE(findings_of("U01", subject_of(one))[0].effect);  // nobody knows ν
    one.nu = exact_number(4.0, "");
    one.used_nu = 4.0;
    EXPECT_TRUE(findings_of("U01", subject_of(one)).empty());
}

TEST(TypeARules, U01LeavesHalfWidthsAlone) {
    AuditedRow one = row("Wiederholbarkeit b'", 0.5);
    one.type_a = true;
    one.nu.reset();
    one.used_nu = test::k_infinite;
    using enum Shape;
    for (const Shape shape : {not_stated, normal, student_t, rectangular, triangular, arcsine, trapezoidal}) {
        one.shape = shape;
        const bool is_bounded = shape >= rectangular && shape <= trapezoidal;
        EXPECT_EQ(findings_of("U01", subject_of(one)).empty(), is_bounded) << static_cast<int>(shape);
    }
}

/// The law: without readings the finding is minor where the printed U is the same for ν = 1 and for an infinite one.
TEST(TypeARules, U01IsAsGraveAsAnyNuMayBe) {
    for (const double share : {0.001, 0.01, 0.1, 0.3, 0.6, 1.0}) {
        AuditedRow one = row("repeatability", share);
        one.type_a = true;
        one.nu.reset();
        one.used_nu = test::k_infinite;
        AuditedBudget budget = budget_of({row("standard", 1.0), one});
        budget.coverage.kind = CoverageRule::Kind::student_t;
        AuditedBudget fewest = budget;
        fewest.rows[1].used_nu = 1.0;
        const std::vector<AuditFinding> found = findings_of("U01", subject_of(budget));
        ASSERT_EQ(found.size(), 1U) << share;
        AuditedBudget fixed = budget;
        fixed.coverage.kind = CoverageRule::Kind::fixed;
        EXPECT_EQ(findings_of("U01", subject_of(fixed))[0].severity, found[0].severity) << "a fixed k hides it";
        EXPECT_EQ(found[0].severity, evaluate(fewest).printed_U == evaluate(budget).printed_U ? FindingSeverity::minor
                                                                                              : FindingSeverity::major)
            << share;
    }
}

TEST(TypeARules, U02IsMinorWhereNuAndKAccountForFewReadings) {
    AuditedRow one = row_of_readings("repeatability", k_five, k_s_of_five / std::sqrt(5.0));
    ASSERT_EQ(findings_of("U02", subject_of(one)).size(), 1U);
    EXPECT_EQ(findings_of("U02", subject_of(one))[0].severity, FindingSeverity::minor);
    one.used_nu = test::k_infinite;
    one.nu = exact_number(test::k_infinite, "");
    const std::vector<AuditFinding> ignored = findings_of("U02", subject_of(budget_of({one})));
    ASSERT_EQ(ignored.size(), 1U);
    EXPECT_EQ(ignored[0].severity, FindingSeverity::critical);  // k = 2.87 in place of 2
    one.pooled_s = 0.02;
    EXPECT_TRUE(findings_of("U02", subject_of(one)).empty());
    AuditedRow ten = one;
    ten.pooled_s.reset();
    ten.readings = std::vector<double>(10, 1.0);
    EXPECT_TRUE(findings_of("U02", subject_of(ten)).empty());
    // Equal readings have no scatter that few of them could tell wrongly.
    EXPECT_TRUE(findings_of("U02", subject_of(row_of_readings("repeatability", {1.0, 1.0, 1.0}, 0.0))).empty());
}

/// Readings taken together: ν_eff of correlated rows does not follow from the formula for independent ones.
TEST(TypeARules, U02TakesNuOfCorrelatedRowsAsStated) {
    const double u = k_s_of_five / std::sqrt(5.0);
    AuditedBudget budget = budget_of({row_of_readings("V", k_five, u), row_of_readings("I", k_five, u)});
    for (const double r : {-0.98, -0.5, 0.5, 0.98}) {
        budget.correlations = {RowCorrelation{.first = 0, .second = 1, .r = r}};
        for (const bool stated : {true, false}) {
            budget.claims.nu_eff = stated ? std::optional(exact_number(4.0, "")) : std::nullopt;
            for (const double k : {2.0, 2.8693}) {  // t of 95.45 % for 4 degrees of freedom
                budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = k, .probability = 0.9545};
                for (const AuditFinding& finding : findings_of("U02", subject_of(budget))) {
                    const std::string said = finding.what.english();
                    EXPECT_NE(said.find(k < 2.5 ? "t_p(ν_eff) is 2.869" : "ν and k account for it"), std::string::npos)
                        << r << ' ' << k << ": " << said;
                }
            }
        }
    }
}

TEST(TypeARules, U02AsksWhetherTheFixedKIsThatOfNu) {
    // k = 2 beside rows of any size: it accounts for ν_eff where t_p(ν_eff) is no more than 1 % larger.
    for (const double beside : {0.001, 0.01, 0.05, 0.2, 1.0, 5.0}) {
        const AuditedRow one = row_of_readings("repeatability", k_five, k_s_of_five / std::sqrt(5.0));
        AuditedBudget budget = budget_of({one, row("standard", beside)});
        budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = 2.0, .probability = 0.9545};
        CoverageRule student = budget.coverage;
        student.kind = CoverageRule::Kind::student_t;
        const double k = evaluate(budget, student).k;
        const std::vector<AuditFinding> findings = findings_of("U02", subject_of(budget));
        ASSERT_EQ(findings.size(), 1U);
        const std::string said = findings[0].what.english();
        EXPECT_NE(said.find(2.0 < 0.99 * k ? "and k does not" : "ν and k account for it"), std::string::npos)
            << beside << ": " << said;
    }
}

TEST(TypeARules, U03WantsTheReadingsOfTheMean) {
    AuditedRow one = row_of_readings("repeatability", k_five, k_s_of_five / std::sqrt(10.0));
    std::vector<AuditFinding> findings = findings_of("U03", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].expected, "divisor √5");
    one.used_u = k_s_of_five / std::sqrt(5.0);
    EXPECT_TRUE(findings_of("U03", subject_of(one)).empty());
    one.used_u = k_s_of_five;  // scatter of a single reading
    EXPECT_TRUE(findings_of("U03", subject_of(one)).empty());
    one.averaged = 5;  // but the certificate states a mean
    EXPECT_EQ(findings_of("U03", subject_of(one)).size(), 1U);
    // A study of ten readings, and a mean of three.
    AuditedRow study = row("repeatability", 0.1, 1.0, 9.0);
    study.type_a = true;
    study.n = 10;
    study.stated = exact_number(0.1 * std::sqrt(10.0), "");
    study.divisor = test::printed("3.16");
    EXPECT_TRUE(findings_of("U03", subject_of(study)).empty());
    study.averaged = 3;
    findings = findings_of("U03", subject_of(study));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.1 * std::sqrt(10.0 / 3.0), 0.01), 1e-12);
}

TEST(TypeARules, U05ControlsTheFamilyOfPoints) {
    // F = 3.7 with 4 and 20 degrees of freedom: p = 0.02 … not below 1 %; F = 7: p = 0.001.
    const auto point = [](double pooled) {
        AuditedRow one = row_of_readings("repeatability", k_five, pooled / std::sqrt(5.0));
        one.pooled_s = pooled;
        one.used_nu = 20.0;
        return budget_of({one, row("rest", 0.001)});
    };
    EXPECT_TRUE(findings_of("U05", subject_of(point(k_s_of_five / std::sqrt(3.7)))).empty());
    const AuditedBudget suspicious = point(k_s_of_five / std::sqrt(7.0));
    ASSERT_EQ(findings_of("U05", subject_of(suspicious)).size(), 1U);
    EXPECT_NEAR(findings_of("U05", subject_of(suspicious))[0].effect->alone.u_c,
                std::hypot(k_s_of_five / std::sqrt(5.0), 0.001), 1e-9);
    // One of a hundred points may look so by chance.
    std::vector<AuditedBudget> table(99, point(k_s_of_five));
    table.push_back(suspicious);
    EXPECT_TRUE(findings_of("U05", subject_of(table)).empty());
}

TEST(TypeARules, U06AllowsACoarseDisplay) {
    const AuditedRow frozen = row_of_readings("repeatability", {5.0, 5.0, 5.0}, 0.0);
    const std::vector<AuditFinding> findings = findings_of("U06", subject_of(frozen));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_TRUE(findings[0].missing_term);
    const AuditedRow display = test::row_from("display", Origin::resolution, 1.0, 0.2887);
    EXPECT_TRUE(findings_of("U06", subject_of(budget_of({frozen, display}))).empty());
    EXPECT_TRUE(findings_of("U06", subject_of(row_of_readings("repeatability", k_five, 0.01))).empty());
}

TEST(TypeARules, U21PoolsTheSeries) {
    AuditedRow one = row("repeatability", 0.4, 1.0, 2.0);
    one.group_deviations = {0.2, 0.3, 0.4};
    one.group_sizes = {3, 3, 3};
    const std::vector<AuditFinding> findings = findings_of("U21", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(std::sqrt(0.29 / 3.0), 0.01), 1e-12);
    EXPECT_NEAR(findings[0].effect->alone.nu_eff, 6.0, 0.02);
    one.used_u = std::sqrt(0.29 / 3.0);
    EXPECT_TRUE(findings_of("U21", subject_of(one)).empty());
}

TEST(TypeARules, U22KnowsTheSpreadOfDeviations) {
    AuditedRow one = row("repeatability", 0.1, 1.0, 6.0);
    one.group_deviations = {0.2, 0.3, 0.4};
    one.group_sizes = {3, 3, 3};
    const std::vector<AuditFinding> findings = findings_of("U22", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].severity, FindingSeverity::critical);
    one.used_u = 0.31;
    EXPECT_TRUE(findings_of("U22", subject_of(one)).empty());
}

TEST(TypeARules, U25WantsARangeForARange) {
    AuditedRow one = row_of_readings("parallelism", {0.0100, 0.0241}, 0.0);
    one.comment = "max - min of two places";
    one.stated = exact_number(0.0141 / std::sqrt(2.0), "");
    one.used_u = one.stated->value;
    const std::vector<AuditFinding> findings = findings_of("U25", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.0141, 0.01), 1e-9);
    one.stated = exact_number(0.0141, "");
    EXPECT_TRUE(findings_of("U25", subject_of(one)).empty());
}

TEST(TypeARules, U03ReadsTheDeviationOfTheWords) {
    AuditedRow one = row("repeatability", 0.12, 1.0, 4.0);
    one.origin = Origin::readings;
    one.type_a = true;
    one.n = one.averaged = 5;
    one.origin_value = 0.12;
    const std::vector<AuditFinding> findings = findings_of("U03", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.12 / std::sqrt(5.0), 0.01), 1e-12);
    one.used_u = 0.12 / std::sqrt(5.0);
    EXPECT_TRUE(findings_of("U03", subject_of(one)).empty());
    one.averaged = 1;  // the result is a single reading
    EXPECT_EQ(findings_of("U03", subject_of(one)).size(), 1U);
}

}  // namespace
}  // namespace gumcert::audit
