// Six budgets of two accredited laboratories that were criticised in public, with what each correction does to them.
// The numbers were recomputed with an independent program; they hold to a relative 1e-9. Its quantiles of t are off by
// 2e-9 where ν is 5.56 and 5.38; k, U and ΔU of these two cases are the root of the incomplete beta function instead.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "audit/correction_effect.h"
#include "audit/row_edits.h"
#include "tests/support/audit_rules.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::report_of;
using test::row;
using test::row_from;
using test::subject_of;

constexpr double k_many = 1e12;  ///< degrees of freedom of a Type B row in the sheets

struct Expected {
    double u_c, nu, k, U, dU_percent;
};

void expect_outcome(const BudgetOutcome& outcome, double u_c, double nu, double k, double U) {
    EXPECT_NEAR(outcome.u_c, u_c, 1e-9 * u_c);
    EXPECT_NEAR(outcome.nu_eff, nu, 1e-9 * nu);
    EXPECT_NEAR(outcome.k, k, 1e-9 * k);
    EXPECT_NEAR(outcome.U, U, 1e-9 * U);
}
void expect_after(const BudgetOutcome& claimed, const BudgetOutcome& after, const Expected& expected) {
    expect_outcome(after, expected.u_c, expected.nu, expected.k, expected.U);
    EXPECT_NEAR(100.0 * (after.U / claimed.U - 1.0), expected.dU_percent, 1e-9 * 100.0);
}

AuditedRow with_nu(AuditedRow one, double nu) {
    one.used_nu = nu;
    one.nu = exact_number(nu, "");
    return one;
}
AuditedRow type_b(const std::string& name, double u, double c = 1.0, double nu = k_many) {
    return row(name, u, c, nu);
}

AuditedBudget percent_95(std::vector<AuditedRow> rows) {
    AuditedBudget budget = budget_of(std::move(rows));
    budget.coverage.probability = 0.95;
    budget.claims.coverage_probability = 0.95;
    return budget;
}

/// Another sheet of the laboratory, which cuts ν_eff.
AuditedBudget sheet_that_cuts() {
    AuditedBudget budget = percent_95({row("repeatability", 1.0, 1.0, 4.5), type_b("rest", 1.0)});
    budget.name = "another sheet";
    budget.coverage.truncate = true;
    return budget;
}

AuditedRow pick_up() {
    return with_nu(row_from("AC pick-up", Origin::limits, 0.2, 0.15196713713031854, Shape::rectangular), k_many);
}

AuditedBudget indicator_measure() {
    AuditedRow repeatability = row("repeatability", 0.2643650674519664, 1.0, 2.0);
    repeatability.type_a = true;
    repeatability.origin = Origin::readings;
    repeatability.n = 3;
    repeatability.comment = "largest s of 9 points / sqrt 3";
    repeatability.group_sizes = std::vector<std::size_t>(9, 3);
    return percent_95({type_b("calibrator", 0.18), type_b("drift", 0.0069282032302755096),
                       type_b("resolution", 0.02886751345948129), pick_up(), repeatability});
}

TEST(CriticisedBudgets, IndicatorInMeasureMode) {
    const AuditReport report = report_of({"U08", "K11"}, subject_of({indicator_measure(), sheet_that_cuts()}));
    const BudgetOutcome& claimed = report.results[0].claimed;
    expect_outcome(claimed, 0.35533678811769703, 6.5279138367002005, 2.3997357310369565, 0.8527143869979458);
    ASSERT_EQ(report.findings.size(), 2U);
    for (const AuditFinding& finding : report.findings) {
        ASSERT_TRUE(finding.effect);
        if (finding.rule == "U08") {
            EXPECT_NE(finding.what.english().find("the root was taken twice"), std::string::npos);
            expect_after(
                claimed, finding.effect->alone,
                {0.34132617179986274, 5.55766139011921, 2.494904616449044, 0.851576241738357, -0.1334732551848905});
        } else {
            expect_after(
                claimed, finding.effect->alone,
                {0.35533678811769703, 6.5279138367002005, 2.4469118487916806, 0.8694777971567718, 1.9658880411110413});
        }
        expect_after(
            claimed, finding.effect->audited,
            {0.34132617179986274, 5.55766139011921, 2.5705818366147395, 0.8774068575899693, 2.895749264763259});
    }
    // Effects do not add up.
    EXPECT_NEAR(report.findings[0].effect->share + report.findings[1].effect->share, 0.02895749264763259, 1e-9);
}

TEST(CriticisedBudgets, IndicatorWithTheLargestOfNineDeviations) {
    const AuditReport report = report_of({"U21"}, subject_of(indicator_measure()));
    ASSERT_EQ(report.findings.size(), 1U);
    expect_after(
        report.results[0].claimed, report.findings[0].effect->alone,
        {0.35533678811769703, 58.751224530301805, 2.0011726755241117, 0.7110902709896362, -16.608622789502757});
}

TEST(CriticisedBudgets, IndicatorInSourceMode) {
    AuditedRow drift = type_b("drift", 0.03233161507461905), other = type_b("drift", 0.2193931022920578, 2.0);
    for (AuditedRow* one : {&drift, &other}) {
        one->contributor = Contributor::reference_drift;
        one->source = "calibrator";
    }
    const AuditReport report =
        report_of({"S09", "S16"},
                  subject_of(percent_95({type_b("calibrator", 0.28), drift, type_b("resolution", 0.02886751345948129),
                                         other, pick_up(), row("repeatability", 0.18973665961010094, 1.0, 2.0)})));
    const BudgetOutcome& claimed = report.results[0].claimed;
    expect_outcome(claimed, 0.5761128455151685, 170.00246911058036, 1.9740165020908218, 1.137256264113443);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].rule, "S09");
    expect_after(claimed, report.findings[0].effect->alone,
                 {0.3733265024536177, 29.976455579000817, 2.0423397226161106, 0.7624595454663643, -32.95622371790182});
}

TEST(CriticisedBudgets, ViscometerWithFixedCoverageFactor) {
    AuditedBudget budget =
        percent_95({row("standard oil", 0.0847025, 1.0, 200.0), row("resolution", 0.02886751345948129, 1.0, 1e6),
                    row("temperature", 0.20856653614614212, 0.08999586748324892, 50.0),
                    row("repeatability", 0.22891046284519068, 1.0, 4.0)});
    budget.coverage.kind = CoverageRule::Kind::fixed;
    const AuditReport report = report_of({"K02", "K11"}, subject_of(budget));
    const BudgetOutcome& claimed = report.results[0].claimed;
    expect_outcome(claimed, 0.2464957697055255, 5.376144439333904, 2.0, 0.492991539411051);
    ASSERT_EQ(report.findings.size(), 2U);
    const AuditFinding& fixed = report.findings[0];
    EXPECT_EQ(fixed.rule, "K02");
    EXPECT_EQ(fixed.severity, FindingSeverity::critical);
    expect_after(claimed, fixed.effect->alone,
                 {0.2464957697055255, 5.376144439333904, 2.5174169359117364, 0.620532625287289, 25.87084679558682});
    EXPECT_EQ(fixed.effect->audited.U, fixed.effect->alone.U);
    EXPECT_EQ(report.findings[1].rule, "K11");
    EXPECT_EQ(report.findings[1].severity, FindingSeverity::information);
    EXPECT_FALSE(report.findings[1].effect) << "both ways are allowed";
}

TEST(CriticisedBudgets, ViscometerWithTextAmongItsReadings) {
    AuditedRow repeatability = row("repeatability", 21.553174553492212, 1.0, 4.0);
    repeatability.type_a = true;
    repeatability.origin = Origin::readings;
    repeatability.n = 4;  // of five cells, one holds the text 631.74.2
    repeatability.stated = exact_number(21.553174553492212 * std::sqrt(5.0), "");
    repeatability.divisor = exact_number(std::sqrt(5.0), "");
    const AuditReport report = report_of(
        {"U03"}, subject_of(percent_95(
                     {row("standard oil", 67.85345, 1.0, 200.0), row("resolution", 0.02886751345948129, 1.0, 1e6),
                      row("temperature", 0.20856653614614212, 53.286765369936134, 50.0), repeatability})));
    const BudgetOutcome& claimed = report.results[0].claimed;
    expect_outcome(claimed, 72.05656247619179, 168.23494906791524, 1.9741651894893744, 142.2515573147641);
    ASSERT_EQ(report.findings.size(), 1U);
    expect_after(claimed, report.findings[0].effect->alone,
                 {72.85796476171055, 128.84990004004, 1.9785463135962829, 144.1528575954103, 1.3365760744812993});
}

TEST(CriticisedBudgets, WeightsWithTheSpreadOfDailyDeviations) {
    constexpr double k_pooled = 0.11244154036653892, k_spread = 0.046363;
    // Six daily s with the stated spread and pooled value.
    const double mean = std::sqrt(k_pooled * k_pooled - 5.0 / 6.0 * k_spread * k_spread);
    const double step = std::sqrt(5.0 / 6.0) * k_spread;
    AuditedRow repeatability = row("repeatability of the balance", k_spread, 1.0, 54.0);
    repeatability.comment = "mean of s";
    for (int day = 0; day < 6; ++day) {
        repeatability.group_deviations.push_back(mean + (day % 2 == 0 ? step : -step));
        repeatability.group_sizes.push_back(10);
    }
    const AuditReport report = report_of(
        {"U21", "U22"}, subject_of(percent_95({repeatability, type_b("all other rows", 0.04397365382817306)})));
    const BudgetOutcome& claimed = report.results[0].claimed;
    expect_outcome(claimed, 0.0639, 194.85478381543732, 1.9722132290931076, 0.12602442533904956);
    ASSERT_EQ(report.findings.size(), 1U);
    EXPECT_EQ(report.findings[0].rule, "U22");
    EXPECT_EQ(report.findings[0].severity, FindingSeverity::critical);
    expect_after(claimed, report.findings[0].effect->alone,
                 {0.12073434569748577, 71.78107288497871, 1.9935674457402255, 0.2406920611652541, 90.98842190131691});
}

TEST(CriticisedBudgets, CaliperWithDriftPerYearTimesDaysOverTwelve) {
    // (0.02 + 0.00025 L) µm a year, L = 600 mm, over 146 days, in mm. Text alone shows it: no rule of this family.
    const AuditedBudget budget = percent_95(
        {row("all rows but drift", 0.016798596073906494, 1.0, 150.04), type_b("drift", 0.0011980018085684736)});
    const Correction per_year = set_u(1, 0.17e-3 * (146.0 / 365.0) / std::sqrt(3.0));
    const std::vector<Effect> effects = effects_of(budget, {&per_year});
    ASSERT_EQ(effects.size(), 1U);
    expect_outcome(effects[0].claimed, 0.01684126, 151.5700619451609, 1.9757388984672626, 0.03327393248120077);
    expect_after(
        effects[0].claimed, effects[0].alone,
        {0.016798641950693517, 150.0416390372843, 1.9759008716735629, 0.0331924512733074, -0.2448800061111034});
}

}  // namespace
}  // namespace gumcert::audit
