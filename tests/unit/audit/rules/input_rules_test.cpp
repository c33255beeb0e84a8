// For each rule of Type B inputs: a budget that fires, and one that must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/support/audit_rules.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::budget_of;
using test::findings_of;
using test::row;
using test::row_from;
using test::subject_of;
constexpr double k_root_of_3 = std::numbers::sqrt3;

bool fires(std::string_view id, const AuditedRow& one) {
    return !findings_of(id, subject_of(one)).empty();
}
/// u_c where a row of 0.01 µm stands beside.
double beside(double u) {
    return std::hypot(u, 0.01);
}

TEST(InputRules, U08ClassifiesTheDivisor) {
    const auto limit = [](double ratio, Shape shape) {
        return row_from("limit", Origin::limits, 0.6, 0.6 * ratio, shape);
    };
    EXPECT_FALSE(fires("U08", limit(1.0 / k_root_of_3, Shape::rectangular)));
    EXPECT_FALSE(fires("U08", limit(1.0 / 1.73, Shape::rectangular)));
    EXPECT_FALSE(fires("U08", limit(1.0 / std::sqrt(6.0), Shape::triangular)));
    EXPECT_FALSE(fires("U08", limit(1.0 / std::numbers::sqrt2, Shape::arcsine)));
    EXPECT_FALSE(fires("U08", limit(0.5, Shape::normal)));
    EXPECT_FALSE(fires("U08", limit(0.5, Shape::not_stated)));
    EXPECT_FALSE(fires("U08", limit(1.0 / std::sqrt(12.0), Shape::rectangular)));  // 0.6 may be the width
    for (const double ratio : {1.0, 0.5, 1.0 / 3.0, 1.0 / std::sqrt(6.0), std::pow(3.0, -0.25)}) {
        const std::vector<AuditFinding> findings = findings_of("U08", subject_of(limit(ratio, Shape::rectangular)));
        ASSERT_EQ(findings.size(), 1U) << ratio;
        EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.6 / k_root_of_3), 1e-12) << ratio;
    }
    EXPECT_NE(
        findings_of("U08", subject_of(limit(std::pow(3.0, -0.25), Shape::rectangular)))[0].what.english().find("twice"),
        std::string::npos);
    EXPECT_TRUE(fires("U08", limit(1.0 / k_root_of_3, Shape::triangular)));
    AuditedRow half = limit(1.0 / std::sqrt(12.0), Shape::rectangular);
    half.comment = "\u00B1 0.6";
    EXPECT_TRUE(fires("U08", half));
}

TEST(InputRules, U08DoesNotAccuseRounding) {
    // a = 0.6 printed with one digit, u = 0.35 computed from 0.61.
    AuditedRow one = row("limit", 0.35);
    one.shape = Shape::rectangular;
    one.stated = test::printed("0.6");
    one.u_half_step = 0.005;
    EXPECT_FALSE(fires("U08", one));
    one.used_u = 0.40;
    EXPECT_TRUE(fires("U08", one));
}

TEST(InputRules, U08AndU13BelieveColumnsBeforeWords) {
    // "accuracy over 1 year": the 1 is no half-width, where the columns give u.
    AuditedRow one = row_from("calibrator", Origin::specification, 1.0, 0.0000693, Shape::rectangular);
    one.u_half_step = 0.00000005;
    one.divisor = exact_number(k_root_of_3, "");
    EXPECT_FALSE(fires("U08", one));
    one.stated = test::printed("0.00012");
    EXPECT_FALSE(fires("U08", one));
    one.stated = test::printed("0.00024");
    one.divisor = test::printed("3.46");
    EXPECT_TRUE(fires("U08", one));
    AuditedRow standard = row_from("standard", Origin::certificate, 12.0, 0.18);
    standard.certificate_k = 2.0;
    EXPECT_TRUE(fires("U13", standard));
    standard.stated = test::printed("0.36");
    standard.divisor = test::printed("2");
    EXPECT_FALSE(fires("U13", standard));
}

/// A row as a table prints it: half-width 0.080, divisor √3, and some u, among others that agree.
AuditedBudget printed_columns(Origin origin, Shape shape, const std::string& u) {
    AuditedRow one = row_from("drift", origin, 0.080, 0.0, shape);
    one.stated = test::printed("0.080");
    one.divisor = test::printed("\u221A3");
    one.u = test::printed(u);
    one.used_u = one.u->value;
    one.u_half_step = one.u->half_step;
    return budget_of({std::move(one), row("standard", 0.025)});
}

TEST(InputRules, WhateverTheWordsSayARowDividesWhatItSays) {
    // The law: of any words and shape, a u that is not stated/divisor is told, once, and corrected to a u that the words or
    // the columns give; one that is the quotient within its digits is no U26.
    const Origin origins[] = {Origin::not_stated, Origin::certificate, Origin::specification, Origin::limits,
                              Origin::resolution};
    const Shape shapes[] = {Shape::not_stated, Shape::normal, Shape::rectangular, Shape::triangular, Shape::arcsine};
    for (const Origin origin : origins) {
        for (const Shape shape : shapes) {
            const auto of_row = [&](const std::string& u) {
                std::vector<AuditFinding> all =
                    audit(subject_of(printed_columns(origin, shape, u)), test::rules_of_families("U")).findings;
                std::erase_if(all, [](const AuditFinding& finding) { return !finding.correct; });
                return all;
            };
            for (const char* const right : {"0.0462", "0.046", "0.05"}) {
                for (const AuditFinding& finding : of_row(right)) {
                    EXPECT_NE(finding.rule, "U26") << right;
                }
            }
            for (const char* const wrong :
                 {"0.00462", "0.0264", "0.0412", "0.0500", "0.0782", "0.139", "0.462", "4.62"}) {
                const std::vector<AuditFinding> findings = of_row(wrong);
                EXPECT_FALSE(findings.empty()) << wrong << " of shape " << static_cast<int>(shape);
                EXPECT_LE(std::count_if(findings.begin(), findings.end(),
                                        [](const AuditFinding& finding) { return finding.where.ends_with(", u"); }),
                          1)
                    << wrong << " of shape " << static_cast<int>(shape);
            }
        }
    }
}

TEST(InputRules, U26HoldsARowAgainstItsOwnColumns) {
    for (const char* const wrong : {"0.00462", "0.139", "0.0642"}) {
        const std::vector<AuditFinding> findings =
            findings_of("U26", subject_of(printed_columns(Origin::limits, Shape::rectangular, wrong)));
        ASSERT_EQ(findings.size(), 1U) << wrong;
        ASSERT_TRUE(findings[0].effect) << wrong;
        EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.080 / k_root_of_3, 0.025), 1e-12) << wrong;
    }
    // What the words give is right, whatever the columns beside it.
    AuditedBudget of_words = printed_columns(Origin::limits, Shape::rectangular, "0.0462");
    of_words.rows[0].stated = test::printed("0.80");
    std::vector<AuditFinding> findings = findings_of("U26", subject_of(of_words));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_FALSE(findings[0].correct);
    EXPECT_EQ(findings[0].severity, FindingSeverity::minor);
    // A percentage of something is no half-width in the unit of u; nor are columns that agree nowhere.
    AuditedBudget percent = printed_columns(Origin::limits, Shape::rectangular, "0.139");
    percent.rows[0].stated = test::printed("8 %");
    EXPECT_TRUE(findings_of("U26", subject_of(percent)).empty());
    AuditedBudget other_unit = printed_columns(Origin::limits, Shape::rectangular, "46.2");
    other_unit.rows.push_back(other_unit.rows[0]);
    const AuditReport report = test::report_of({"U26"}, subject_of(other_unit));
    EXPECT_TRUE(report.findings.empty());
    EXPECT_EQ(report.not_checked.size(), 1U);
    AuditedBudget ours = printed_columns(Origin::limits, Shape::rectangular, "0.139");
    ours.evaluated_here = true;
    EXPECT_TRUE(findings_of("U26", subject_of(ours)).empty());
}

TEST(InputRules, U26IsCorrectedBeforeWhatFollowsFromTheRows) {
    // Ten times too large, the row is nearly all of u_c, and k is that of its distribution (K04): of the error alone.
    AuditedBudget budget = printed_columns(Origin::limits, Shape::rectangular, "0.462");
    budget.coverage = {.kind = CoverageRule::Kind::fixed, .k = 2.0};
    const AuditReport report = audit(subject_of(budget), test::rules_of_families("UK"));
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_NEAR(report.results[0].audited.U, 2.0 * std::hypot(0.080 / k_root_of_3, 0.025), 1e-12);
    EXPECT_TRUE(std::any_of(report.findings.begin(), report.findings.end(),
                            [](const AuditFinding& finding) { return finding.rule == "K04"; }));
}

TEST(InputRules, U09AllowsADifferenceOfTwoReadings) {
    const auto display = [](double u) { return row_from("display, step 0.1", Origin::resolution, 0.1, u); };
    EXPECT_FALSE(fires("U09", display(0.1 / std::sqrt(12.0))));
    EXPECT_FALSE(fires("U09", display(0.1 * std::numbers::sqrt2 / std::sqrt(12.0))));
    for (const double u : {0.1, 0.1 / k_root_of_3, 0.05, 0.05 / std::sqrt(12.0)}) {
        const std::vector<AuditFinding> findings = findings_of("U09", subject_of(display(u)));
        ASSERT_EQ(findings.size(), 1U) << u;
        EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.1 / std::sqrt(12.0)), 1e-12) << u;
    }
    // A column of half-widths, and words without a number.
    AuditedRow column = row_from("display", Origin::resolution, 0.05, 0.05 / k_root_of_3, Shape::rectangular);
    column.stated = test::printed("0.05");
    EXPECT_FALSE(fires("U09", column));
}

TEST(InputRules, U09SeesAStepThatIsCalledRepeatability) {
    AuditedRow row = row_from("repeatability", Origin::not_stated, 0.0, 0.0289);
    row.contributor = Contributor::repeatability;
    row.origin_value.reset();
    row.u_half_step = 0.00005;
    for (const char* const words : {"0.0289 = 0.1/sqrt(12)", "0,1 / √12", "step 0.1/√12"}) {
        row.comment = words;
        const std::vector<AuditFinding> findings = findings_of("U09", subject_of(row));
        ASSERT_EQ(findings.size(), 1U) << words;
        EXPECT_TRUE(findings[0].missing_term.has_value()) << "how large the repeatability must be";
    }
    for (const char* const words : {"0.2/sqrt(12)", "s of 10 readings/sqrt(12)", "/sqrt(12)", ""}) {
        row.comment = words;
        EXPECT_FALSE(fires("U09", row)) << words;
    }
    row.comment = "0.1/sqrt(12)";
    row.n = 12;
    EXPECT_FALSE(fires("U09", row)) << "s of twelve readings is divided so, too";
    row.n.reset();
    row.contributor = Contributor::item_resolution;
    EXPECT_FALSE(fires("U09", row));
}

TEST(InputRules, U10AndU24ReadAPermissibleError) {
    EXPECT_TRUE(fires("U10", row_from("reference", Origin::specification, 0.4, 0.4)));
    EXPECT_FALSE(fires("U10", row_from("reference", Origin::specification, 0.4, 0.4 / k_root_of_3)));
    const std::vector<AuditFinding> halved =
        findings_of("U24", subject_of(row_from("reference", Origin::specification, 0.4, 0.2)));
    ASSERT_EQ(halved.size(), 1U);
    EXPECT_NEAR(halved[0].effect->alone.u_c, beside(0.4 / k_root_of_3), 1e-12);
    EXPECT_FALSE(fires("U24", row_from("reference", Origin::specification, 0.4, 0.4 / k_root_of_3)));
    AuditedRow with_k = row_from("reference", Origin::specification, 0.4, 0.2);
    with_k.certificate_k = 2.0;
    EXPECT_FALSE(fires("U24", with_k));
    // One finding for one slip.
    EXPECT_FALSE(fires("U08", row_from("reference", Origin::specification, 0.4, 0.4, Shape::rectangular)));
    EXPECT_FALSE(fires("U08", row_from("reference", Origin::specification, 0.4, 0.2, Shape::rectangular)));
}

TEST(InputRules, U11IsMinorWhereUFalls) {
    AuditedRow one = row_from("reference", Origin::specification, 0.4, 0.4 / k_root_of_3);
    EXPECT_FALSE(fires("U11", one));
    one.certificate_U = 0.1;
    one.certificate_k = 2.0;
    const std::vector<AuditFinding> findings = findings_of("U11", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].severity, FindingSeverity::minor);
    EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.05), 1e-12);
    one.certificate_U = 1.0;  // the certificate says that the instrument is worse
    EXPECT_EQ(findings_of("U11", subject_of(one))[0].severity, FindingSeverity::critical);
}

TEST(InputRules, U12AsksForEvidence) {
    AuditedRow one = row_from("reference", Origin::specification, 0.4, 0.4 / k_root_of_3);
    EXPECT_TRUE(fires("U12", one));
    one.comment = "verified, report 17";
    EXPECT_FALSE(fires("U12", one));
}

TEST(InputRules, U13DividesByTheKOfTheCertificate) {
    const auto standard = [](double u) {
        AuditedRow one = row_from("standard", Origin::certificate, 0.36, u);
        one.certificate_k = 2.0;
        return one;
    };
    EXPECT_FALSE(fires("U13", standard(0.18)));
    for (const double u : {0.36, 0.36 / k_root_of_3, 0.36 / 1.96, 0.12}) {
        const std::vector<AuditFinding> findings = findings_of("U13", subject_of(standard(u)));
        ASSERT_EQ(findings.size(), 1U) << u;
        EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.18), 1e-12) << u;
    }
    // 1.96 in place of 2 is two percent: not critical.
    EXPECT_LT(findings_of("U13", subject_of(standard(0.36 / 1.96)))[0].severity, FindingSeverity::critical);
    EXPECT_EQ(findings_of("U13", subject_of(standard(0.12)))[0].severity, FindingSeverity::critical);
}

TEST(InputRules, U14WantsKOnRecord) {
    AuditedRow one = row_from("standard", Origin::certificate, 0.36, 0.18);
    EXPECT_TRUE(fires("U14", one));
    one.divisor = test::printed("2");
    EXPECT_FALSE(fires("U14", one));
    one.divisor.reset();
    one.certificate_probability = 0.95;
    EXPECT_FALSE(fires("U14", one));
}

TEST(InputRules, U15TakesThePartOfTheRightBase) {
    AuditedRow one = row("pressure", 0.01 / k_root_of_3);
    one.estimate = test::printed("2.00");
    one.stated = exact_number(0.01, "");
    one.relative_uncertainty = 0.005;
    one.relative_to = RelativeTo::full_scale;
    one.full_scale = 10.0;
    const std::vector<AuditFinding> findings = findings_of("U15", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.05 / k_root_of_3), 1e-12);
    EXPECT_EQ(findings[0].severity, FindingSeverity::critical);
    one.stated = exact_number(0.05, "");
    EXPECT_FALSE(fires("U15", one));
}

TEST(InputRules, U16AsksForInterpolation) {
    AuditedRow one = row_from("standard", Origin::certificate, 0.36, 0.18);
    one.estimate = test::printed("150.0");
    one.certificate_low = 0.0;
    one.certificate_high = 100.0;
    EXPECT_TRUE(fires("U16", one));
    one.certificate_high = 150.0;
    EXPECT_FALSE(fires("U16", one));
    one.certificate_high = 100.0;
    AuditedRow fit = row("extrapolation", 0.1);
    fit.contributor = Contributor::fit;
    EXPECT_TRUE(findings_of("U16", subject_of(budget_of({one, fit}))).empty());
}

TEST(InputRules, U17TakesBothLimits) {
    AuditedRow one = row("limit", 0.1 / k_root_of_3);
    one.lower_limit = -0.1;
    one.upper_limit = 0.3;
    const std::vector<AuditFinding> findings = findings_of("U17", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.4 / std::sqrt(12.0)), 1e-12);
    one.used_u = 0.4 / std::sqrt(12.0);
    EXPECT_FALSE(fires("U17", one));
}

TEST(InputRules, U18FindsImpossibleNumbers) {
    AuditedRow one = row("a", 0.1);
    EXPECT_FALSE(fires("U18", one));
    one.u = exact_number(-0.1, "");
    EXPECT_TRUE(fires("U18", one));
    one = row("a", 0.1);
    one.divisor = exact_number(0.0, "");
    EXPECT_TRUE(fires("U18", one));
    one = row("a", 0.1);
    one.nu = exact_number(-1.0, "");
    EXPECT_TRUE(fires("U18", one));
    one = row("a", 0.1, -2.0);
    EXPECT_FALSE(fires("U18", one));
    one.sensitivity = exact_number(std::nan(""), "");
    EXPECT_TRUE(fires("U18", one));
    EXPECT_EQ(findings_of("U18", subject_of(one))[0].severity, FindingSeverity::critical);
}

TEST(InputRules, U19TurnsReliabilityIntoNu) {
    AuditedRow one = row("limit", 0.1);
    one.reliability = 0.25;
    const std::vector<AuditFinding> findings = findings_of("U19", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].expected, "ν = 8");
    one.used_nu = 8.0;
    EXPECT_FALSE(fires("U19", one));
}

TEST(InputRules, U20KnowsSwingingQuantities) {
    AuditedRow one = row_from("room", Origin::limits, 0.5, 0.5 / k_root_of_3, Shape::rectangular);
    EXPECT_FALSE(fires("U20", one));
    one.cyclic = true;
    const std::vector<AuditFinding> findings = findings_of("U20", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.5 / std::numbers::sqrt2), 1e-12);
    one.used_u = 0.5 / std::numbers::sqrt2;
    EXPECT_FALSE(fires("U20", one));
}

TEST(InputRules, U23FindsAValueThatIsItsOwnUncertainty) {
    AuditedRow one = row("alpha", 11.5e-6 / k_root_of_3);
    one.estimate = test::printed("11.5e-6");
    one.stated = test::printed("11.5e-6");
    EXPECT_TRUE(fires("U23", one));
    one.stated = test::printed("1e-6");
    EXPECT_FALSE(fires("U23", one));
    one.stated.reset();
    EXPECT_TRUE(fires("U23", one));
    one.shape_text = "exponential";  // its mean is its standard deviation
    EXPECT_FALSE(fires("U23", one));
    one.shape_text = "rectangular";
    EXPECT_TRUE(fires("U23", one));
    one.origin_value = 11.5e-6;  // a column of limits
    EXPECT_FALSE(fires("U23", one));
}

TEST(InputRules, U08AndU13SeeASlipBetweenWordsAndColumn) {
    AuditedRow one = row_from("temperature", Origin::limits, 0.05, 0.5 / k_root_of_3, Shape::rectangular);
    one.comment = "\u00B10.05 K";
    one.stated = test::printed("0.5");
    one.divisor = exact_number(k_root_of_3, "");
    const std::vector<AuditFinding> findings = findings_of("U08", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.05 / k_root_of_3), 1e-12);
    one.stated = test::printed("0.10");  // the whole width
    one.used_u = 0.10 / k_root_of_3;
    EXPECT_TRUE(fires("U08", one));
    one.stated = test::printed("0.06");  // another number is meant
    one.used_u = 0.06 / k_root_of_3;
    EXPECT_FALSE(fires("U08", one));
    AuditedRow standard = row_from("standard", Origin::certificate, 0.042, 0.21);
    standard.certificate_k = 2.0;
    standard.stated = test::printed("0.42");
    standard.divisor = test::printed("2");
    EXPECT_TRUE(fires("U13", standard));
}

TEST(InputRules, U08KnowsDivisorsThatNoDistributionHas) {
    AuditedRow one = row_from("drift", Origin::limits, 0.6, 0.6 / std::sqrt(12.0));
    one.comment = "\u00B10.6";
    EXPECT_TRUE(fires("U08", one));
    one.used_u = 0.2;  // three standard deviations
    EXPECT_FALSE(fires("U08", one));
}

TEST(InputRules, U09SeesTheRootTakenTwice) {
    AuditedRow one = row_from("resolution", Origin::resolution, 0.1, 0.05 / 3.0);
    one.comment = "resolution 0.1 um";
    const std::vector<AuditFinding> findings = findings_of("U09", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_NEAR(findings[0].effect->alone.u_c, beside(0.1 / std::sqrt(12.0)), 1e-12);
}

TEST(InputRules, U13ReadsTheDivisorOfTheColumn) {
    // U = 0.3 has one digit: 0.173 would be half of a number that is printed so, but the column says √3.
    AuditedRow one = row_from("standard", Origin::certificate, 0.3, 0.3 / k_root_of_3);
    one.certificate_k = 2.0;
    one.stated = test::printed("0.3");
    one.divisor = test::printed("1.732");
    ASSERT_EQ(findings_of("U13", subject_of(one)).size(), 1U);
    EXPECT_NEAR(findings_of("U13", subject_of(one))[0].effect->alone.u_c, beside(0.15), 1e-12);
}

TEST(InputRules, U23SaysWhatTheOtherRowsGive) {
    AuditedRow one = row("correction", 0.3 / k_root_of_3);
    one.estimate = test::printed("0.3");
    one.stated = test::printed("0.3");
    const std::vector<AuditFinding> findings = findings_of("U23", subject_of(one));
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].evidence.back(), "without this row U = 0.02 µm");
}

TEST(InputRules, U24AndU10AskTheColumnsBehindARoundedU) {
    // 0.173/√3 is printed as 0.1, which may be half of 0.173 by its digits alone; 0.1/√3 as 0.1, which is no 0.1.
    AuditedRow one = test::row_from("gauge", Origin::specification, 0.173, 0.1, Shape::rectangular);
    one.u_half_step = 0.05;
    one.u = test::printed("0.1");
    EXPECT_EQ(findings_of("U24", test::subject_of(one)).size(), 1U);
    one.stated = test::printed("0.173");
    one.divisor = test::printed("1.732");
    EXPECT_TRUE(findings_of("U24", test::subject_of(one)).empty());
    one.divisor = test::printed("2");
    EXPECT_EQ(findings_of("U24", test::subject_of(one)).size(), 1U);
    one.origin_value = 0.1;
    one.stated = test::printed("0.10");
    one.divisor = test::printed("1.732");
    EXPECT_TRUE(findings_of("U10", test::subject_of(one)).empty());
    one.divisor = test::printed("1");
    EXPECT_EQ(findings_of("U10", test::subject_of(one)).size(), 1U);
}

}  // namespace
}  // namespace gumcert::audit
