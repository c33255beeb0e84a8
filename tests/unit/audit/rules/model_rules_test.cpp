// For each rule of models: a budget that fires, and one that must not.
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
using test::subject_of;

AuditedRow quantity(const std::string& name, const std::string& estimate, double u, double c,
                    const std::string& unit = "1") {
    AuditedRow one = row(name, u, c);
    one.unit = unit;
    one.estimate = test::printed(estimate);
    return one;
}
AuditedBudget model_of(const std::string& equation, std::vector<AuditedRow> rows) {
    AuditedBudget budget = budget_of(std::move(rows));
    budget.unit = "1";
    budget.equation = equation;
    return budget;
}

TEST(ModelRules, S01HoldsUnitsTogether) {
    AuditedRow temperature = row("temperature", 0.1, 11.5);
    temperature.unit = "K";
    temperature.sensitivity_unit = "um/K";
    EXPECT_TRUE(findings_of("S01", subject_of(temperature)).empty());
    temperature.sensitivity_unit = "um";
    EXPECT_EQ(findings_of("S01", subject_of(temperature)).size(), 1U);
    // Without a coefficient: added as it stands.
    AuditedRow bare = row("temperature", 0.1);
    bare.unit = "K";
    EXPECT_TRUE(findings_of("S01", subject_of(bare)).empty());  // c = 1 may be 1 µm/K
    bare.sensitivity.reset();
    ASSERT_EQ(findings_of("S01", subject_of(bare)).size(), 1U);
    EXPECT_EQ(findings_of("S01", subject_of(bare))[0].severity, FindingSeverity::critical);
    bare.unit = "nm";
    const std::vector<AuditFinding> findings = findings_of("S01", subject_of(bare));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.1e-3, 0.01), 1e-12);
    bare.unit = "\u00B5m";
    EXPECT_TRUE(findings_of("S01", subject_of(bare)).empty());
}

TEST(ModelRules, S01AsksWhereAPartOfAValueIsAddedAsItStands) {
    for (const char* const unit : {"%", "percent", "ppm", "ppb", "\u2030"}) {
        AuditedRow part = row("standard", 0.01);
        part.unit = unit;
        part.contribution = exact_number(0.01, "");
        part.contributor = Contributor::reference;
        const std::vector<AuditFinding> findings = findings_of("S01", subject_of(part));
        ASSERT_EQ(findings.size(), 1U) << unit;
        EXPECT_EQ(findings[0].severity, FindingSeverity::major) << unit;
        // With a coefficient of its own, in a result of the same kind, and where percent is no part of the value.
        AuditedRow scaled = part;
        scaled.sensitivity = exact_number(100.0, "");
        scaled.used_sensitivity = 100.0;
        EXPECT_TRUE(findings_of("S01", subject_of(scaled)).empty()) << unit;
        AuditedBudget relative = budget_of({part});
        relative.unit = unit;
        EXPECT_TRUE(findings_of("S01", subject_of(relative)).empty()) << unit;
        part.quantity = "relative humidity";
        EXPECT_TRUE(findings_of("S01", subject_of(part)).empty()) << unit;
        part.quantity = "influence";
        part.contributor = Contributor::environment;
        EXPECT_TRUE(findings_of("S01", subject_of(part)).empty()) << unit;
    }
}

TEST(ModelRules, S02DifferentiatesTheEquation) {
    const AuditedBudget right = model_of("y = a*b", {quantity("a", "2.0", 0.1, 3.0), quantity("b", "3.0", 0.1, 2.0)});
    EXPECT_TRUE(findings_of("S02", subject_of(right)).empty());
    AuditedBudget wrong = right;
    wrong.rows[0].used_sensitivity = 2.0;
    const std::vector<AuditFinding> findings = findings_of("S02", subject_of(wrong));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].expected, "c = 3");
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.3, 0.2), 1e-12);
    // The estimate 3.0 stands for up to 3.05: a coefficient of 3.04 is nothing but rounding.
    wrong.rows[0].used_sensitivity = 3.06;
    EXPECT_TRUE(findings_of("S02", subject_of(wrong)).empty());
}

TEST(ModelRules, S02KnowsUnits) {
    AuditedBudget budget = model_of(
        "l = ls + ls*a*t", {quantity("ls", "100.000", 0.0001, 1.0, "mm"), quantity("a", "11.5e-6", 1e-6, 0.0, "1/K"),
                            quantity("t (deviation of temperature)", "2.0", 0.1, 1.15, "K")});
    budget.unit = "um";
    budget.rows[0].used_sensitivity = 1000.0;
    budget.rows[1].used_sensitivity = 2e5;  // µm per 1/K
    EXPECT_TRUE(findings_of("S02", subject_of(budget)).empty());
    budget.rows[2].used_sensitivity = 0.115;
    ASSERT_EQ(findings_of("S02", subject_of(budget)).size(), 1U);
    EXPECT_NE(findings_of("S02", subject_of(budget))[0].what.english().find("1.15"), std::string::npos);
    // Units that do not balance say nothing about numbers.
    budget.rows[2].unit = "mm";
    EXPECT_TRUE(findings_of("S02", subject_of(budget)).empty());
}

TEST(ModelRules, S03ComparesNames) {
    const AuditedBudget complete = model_of(
        "y = a + b",
        {quantity("a", "1.0", 0.1, 1.0), quantity("b", "1.0", 0.1, 1.0), quantity("repeatability", "0", 0.1, 1.0)});
    EXPECT_TRUE(findings_of("S03", subject_of(complete)).empty());
    AuditedBudget incomplete = complete;
    incomplete.equation = "y = a + b + c";
    const std::vector<AuditFinding> findings = findings_of("S03", subject_of(incomplete));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NE(findings[0].what.english().find("has c"), std::string::npos);
    EXPECT_TRUE(findings[0].missing_term);
    AuditedBudget extra = complete;
    extra.rows[2].quantity = "d";
    EXPECT_EQ(findings_of("S03", subject_of(extra)).size(), 1U);
    AuditedBudget in_words = complete;
    in_words.equation = "y = p + q";
    EXPECT_TRUE(findings_of("S03", subject_of(in_words)).empty());
}

/// JCGM 100:2008, H.1.7: the products of second order are 11.7 nm and 1.7 nm of the end gauge.
AuditedBudget end_gauge_model() {
    AuditedBudget budget =
        model_of("l = ls + d - ls*(da*th + as*dt)",
                 {quantity("ls", "50.000623", 25e-6, 1.0, "mm"), quantity("d", "0.000215", 9.7e-6, 1.0, "mm"),
                  quantity("da", "0", 0.58e-6, 5.0, "1/K"), quantity("th", "-0.1", 0.41, 0.0, "K"),
                  quantity("as", "11.5e-6", 1.2e-6, 0.0, "1/K"), quantity("dt", "0", 0.029, 5.75e-4, "K")});
    budget.unit = "mm";
    return budget;
}

TEST(ModelRules, S04AddsSecondOrderOfTheEndGauge) {
    const std::vector<AuditFinding> findings = findings_of("S04", subject_of(end_gauge_model()));
    ASSERT_EQ(findings.size(), 1U);
    const Effect& effect = *findings[0].effect;
    const double added = std::sqrt(effect.alone.u_c * effect.alone.u_c - effect.claimed.u_c * effect.claimed.u_c);
    EXPECT_NEAR(added, std::hypot(11.7e-6, 1.7e-6), 0.2e-6);
    EXPECT_NEAR(effect.alone.u_c, 34e-6, 0.5e-6);  // the GUM prints 34 nm
    AuditedBudget with_row = end_gauge_model();
    with_row.rows.push_back(row("second-order terms", 11.8e-6));
    EXPECT_TRUE(findings_of("S04", subject_of(with_row)).empty());
    AuditedBudget small = end_gauge_model();
    small.rows[3].used_u = 0.1;
    EXPECT_TRUE(findings_of("S04", subject_of(small)).empty());  // less than 5 % of u_c²
}

TEST(ModelRules, S05AndS18SeeCurvature) {
    // y = x²: second order ½ (2)² u⁴, shift u².
    AuditedBudget bent = model_of("y = x^2", {quantity("x", "1.0", 0.4, 2.0)});
    bent.value = 1.0;
    const std::vector<AuditFinding> findings = findings_of("S05", subject_of(bent));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::sqrt(0.64 + 2.0 * 0.0256), 1e-9);
    const std::vector<AuditFinding> shifts = findings_of("S18", subject_of(bent));
    ASSERT_EQ(shifts.size(), 1U);
    EXPECT_NEAR(*shifts[0].effect->alone.value, 1.16, 1e-12);
    AuditedBudget nearly_linear = bent;
    nearly_linear.rows[0].used_u = 0.001;
    EXPECT_TRUE(findings_of("S05", subject_of(nearly_linear)).empty());
    EXPECT_TRUE(findings_of("S18", subject_of(nearly_linear)).empty());
    bent.monte_carlo = StatedMonteCarlo{};
    EXPECT_TRUE(findings_of("S05", subject_of(bent)).empty());
}

TEST(ModelRules, S05UsesThirdDerivatives) {
    // y = x³ at 1: ½ 6² u⁴ + 3·6 u⁴ = 36 u⁴ (the terms of 5.1.2, note).
    AuditedBudget bent = model_of("y = x^3", {quantity("x", "1.0", 0.2, 3.0)});
    const std::vector<AuditFinding> findings = findings_of("S05", subject_of(bent));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::sqrt(0.36 + 36.0 * std::pow(0.2, 4)), 1e-9);
}

TEST(ModelRules, S06AsksForTheNumericalErrorFirst) {
    AuditedBudget budget = budget_of({row("a", 0.5)});
    EXPECT_TRUE(findings_of("S06", subject_of(budget)).empty());
    budget.monte_carlo = StatedMonteCarlo{.trials = 1e4, .converged = {}, .numerical_error = {}, .low = {}, .high = {}};
    EXPECT_EQ(findings_of("S06", subject_of(budget)).size(), 1U);
    budget.monte_carlo->numerical_error = 0.01;  // U = 1.0, δ = 0.05
    EXPECT_TRUE(findings_of("S06", subject_of(budget)).empty());
    budget.monte_carlo->numerical_error = 0.03;
    EXPECT_EQ(findings_of("S06", subject_of(budget)).size(), 1U);
    budget.monte_carlo = StatedMonteCarlo{.trials = 1e6, .converged = {}, .numerical_error = {}, .low = {}, .high = {}};
    EXPECT_TRUE(findings_of("S06", subject_of(budget)).empty());
    budget.monte_carlo->converged = false;
    EXPECT_EQ(findings_of("S06", subject_of(budget)).size(), 1U);
}

TEST(ModelRules, S07WantsASeed) {
    AuditedBudget budget = budget_of({row("a", 0.5)});
    budget.monte_carlo = StatedMonteCarlo{};
    EXPECT_TRUE(findings_of("S07", subject_of(budget)).empty());
    budget.monte_carlo->repeatable = false;
    EXPECT_EQ(findings_of("S07", subject_of(budget)).size(), 1U);
}

TEST(ModelRules, S08AppliesAKnownCorrection) {
    AuditedBudget budget = budget_of({row("standard", 0.1, 2.0)});
    budget.value = 10.0;
    EXPECT_TRUE(findings_of("S08", subject_of(budget)).empty());
    budget.rows[0].unapplied_correction = -0.3;
    const std::vector<AuditFinding> findings = findings_of("S08", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(*findings[0].effect->alone.value, 9.4, 1e-12);
    EXPECT_EQ(findings[0].severity, FindingSeverity::major);
}

TEST(ModelRules, S09CountsADriftOnce) {
    AuditedRow drift = row("drift", 0.3), other = row("drift since 2020", 0.2);
    drift.contributor = other.contributor = Contributor::reference_drift;
    drift.source = "calibrator 17";
    other.source = "Calibrator-17";
    const std::vector<AuditFinding> findings = findings_of("S09", subject_of(budget_of({drift, other})));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, 0.3, 1e-12);
    other.source = "calibrator 18";
    EXPECT_TRUE(findings_of("S09", subject_of(budget_of({drift, other}))).empty());
    AuditedRow limit = test::row_from("accuracy", Origin::specification, 0.5, 0.29);
    limit.source = drift.source;
    EXPECT_EQ(findings_of("S09", subject_of(budget_of({drift, limit}))).size(), 1U);
}

TEST(ModelRules, S10AndS13AskForCorrelation) {
    AuditedRow first = test::row_from("first block", Origin::certificate, 0.2, 0.1);
    AuditedRow second = test::row_from("second block", Origin::certificate, 0.2, 0.1);
    first.source = second.source = "certificate 4711";
    AuditedBudget budget = budget_of({first, second});
    const std::vector<AuditFinding> findings = findings_of("S10", subject_of(budget));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].evidence[1], "with r = 1: 0.2 µm");
    EXPECT_EQ(findings[0].severity, FindingSeverity::major);
    budget.correlations = {{.first = 1, .second = 0, .r = 0.0}};
    EXPECT_TRUE(findings_of("S10", subject_of(budget)).empty());
    budget.correlations.clear();
    budget.rows[0].contributor = budget.rows[1].contributor = Contributor::fit;
    EXPECT_TRUE(findings_of("S10", subject_of(budget)).empty());
    EXPECT_EQ(findings_of("S13", subject_of(budget)).size(), 1U);
    budget.rows[1].source = "another fit";
    EXPECT_TRUE(findings_of("S13", subject_of(budget)).empty());
}

TEST(ModelRules, S11RefusesImpossibleCorrelations) {
    AuditedBudget budget = budget_of({row("a", 1.0), row("b", 1.0), row("c", 1.0)});
    budget.correlations = {{0, 1, 0.9}, {1, 2, 0.9}, {0, 2, 0.62}};
    EXPECT_TRUE(findings_of("S11", subject_of(budget)).empty());
    budget.correlations[2].r = 0.618;  // 0.62 rounded: two decimals are forgiven
    EXPECT_TRUE(findings_of("S11", subject_of(budget)).empty());
    budget.correlations[2].r = -0.9;
    ASSERT_EQ(findings_of("S11", subject_of(budget)).size(), 1U);
    EXPECT_EQ(findings_of("S11", subject_of(budget))[0].severity, FindingSeverity::critical);
    budget.correlations = {{0, 1, 1.2}};
    EXPECT_EQ(findings_of("S11", subject_of(budget)).size(), 1U);
}

TEST(ModelRules, S12KnowsWhatWelchSatterthwaiteNeeds) {
    AuditedBudget budget = budget_of({row("a", 1.0, 1.0, 4.0), row("b", 1.0, 1.0, 4.0)});
    EXPECT_TRUE(findings_of("S12", subject_of(budget)).empty());
    budget.correlations = {{0, 1, 0.5}};
    EXPECT_EQ(findings_of("S12", subject_of(budget)).size(), 1U);
    budget.coverage.kind = CoverageRule::Kind::fixed;
    EXPECT_TRUE(findings_of("S12", subject_of(budget)).empty());
}

TEST(ModelRules, S15FindsSlipsOfAPowerOfTen) {
    AuditedRow steel = quantity("thermal expansion of steel", "11.5e-6", 1e-6, 1.0, "1/K");
    EXPECT_TRUE(findings_of("S15", subject_of(steel)).empty());
    steel.estimate = test::printed("11.5e-5");
    const std::vector<AuditFinding> findings = findings_of("S15", subject_of(steel));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NE(findings[0].evidence[1].english().find("10^-1"), std::string::npos);
    steel.unit = "um/m/K";
    steel.estimate = test::printed("11.5");
    EXPECT_TRUE(findings_of("S15", subject_of(steel)).empty());
    AuditedRow difference = quantity("difference of the thermal expansions of steel", "1e-7", 1e-6, 1.0, "1/K");
    EXPECT_TRUE(findings_of("S15", subject_of(difference)).empty());
}

TEST(ModelRules, S15FindsDaysDividedByMonths) {
    AuditedRow drift = row("drift", 0.3);
    drift.comment = "0.5 um/yr x days/365";
    EXPECT_TRUE(findings_of("S15", subject_of(drift)).empty());
    drift.comment = "0.5 um/yr x days/12";
    const std::vector<AuditFinding> findings = findings_of("S15", subject_of(drift));
    ASSERT_EQ(findings.size(), 1U);
    AuditedBudget budget = subject_of(drift).budgets.front();
    findings[0].correct(budget);
    EXPECT_DOUBLE_EQ(budget.rows[0].used_u, 0.3 * 12.0 / 365.0);
}

TEST(ModelRules, S16KnowsOneContributionUnderTwoNames) {
    const auto two = [](const std::string& first, const std::string& second) {
        return budget_of({row(first, 0.3, 2.0), row(second, 0.3, 2.0)});
    };
    const std::vector<AuditFinding> findings = findings_of("S16", subject_of(two("dT·alpha·L", "L*alpha*dT")));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, 0.6, 1e-12);
    EXPECT_EQ(findings_of("S16", subject_of(two("drift", "Drift (2)"))).size(), 1U);
    EXPECT_TRUE(findings_of("S16", subject_of(two("block 1", "block 2"))).empty());
    AuditedBudget displays = two("display", "display");
    displays.rows[0].origin = displays.rows[1].origin = Origin::resolution;
    EXPECT_TRUE(findings_of("S16", subject_of(displays)).empty());
}

TEST(ModelRules, S17FindsTheCoefficientOfAnotherPoint) {
    AuditedBudget low = model_of("y = x^2", {quantity("x", "1.00", 0.01, 2.0)});
    AuditedBudget high = model_of("y = x^2", {quantity("x", "5.00", 0.01, 10.0)});
    EXPECT_TRUE(findings_of("S17", subject_of({low, high})).empty());
    high.rows[0].used_sensitivity = 2.0;
    const std::vector<AuditFinding> findings = findings_of("S17", subject_of({low, high}));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, 0.1, 1e-12);
    EXPECT_TRUE(findings_of("S02", subject_of({low, high})).empty());
}

TEST(ModelRules, S01SeesAnotherUnitBesideACoefficientOfOne) {
    AuditedRow slip = row("drift", 0.0116);
    slip.unit = "mm";  // beside micrometres, with c = 1
    const std::vector<AuditFinding> findings = findings_of("S01", subject_of(slip));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(11.6, 0.01), 1e-9);
    slip.sensitivity = exact_number(1000.0, "");
    slip.used_sensitivity = 1000.0;
    EXPECT_TRUE(findings_of("S01", subject_of(slip)).empty());
}

TEST(ModelRules, S02TakesAnEquationOfNumbersWhereItGivesTheValue) {
    // 60000 kg/(kg/m³ · s) is meant in litres per minute.
    AuditedBudget budget = model_of("q = 60000*m/(rho*t)", {quantity("m", "50.00", 0.01, 1.0, "kg"),
                                                            quantity("rho", "1000.0", 0.1, -0.05, "kg/m^3"),
                                                            quantity("t", "60.00", 0.01, -0.8333, "s")});
    budget.unit = "L/min";
    budget.value = 50.0;
    EXPECT_TRUE(findings_of("S02", subject_of(budget)).empty());
    budget.rows[2].used_sensitivity = -1.6667;
    EXPECT_EQ(findings_of("S02", subject_of(budget)).size(), 1U);
}

TEST(ModelRules, S09KnowsOneHistoryByItsWords) {
    AuditedRow drift = row("drift", 0.1), change = row("change of the standard", 0.1);
    drift.contributor = change.contributor = Contributor::reference_drift;
    drift.comment = change.comment = "history of 5 calibrations since 2019";
    EXPECT_EQ(findings_of("S09", subject_of(budget_of({drift, change}))).size(), 1U);
    change.comment = "specification of the maker, 1 year";
    EXPECT_TRUE(findings_of("S09", subject_of(budget_of({drift, change}))).empty());
}

}  // namespace
}  // namespace gumcert::audit
