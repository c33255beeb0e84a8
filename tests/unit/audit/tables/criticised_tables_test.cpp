// The six budgets of criticised_budgets_test.cpp once more, as an assessor types them from the sheets: what the audit
// reads of the words and numbers of a table is enough for every effect that was stated of them.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

constexpr const char* k_heads = "quantity,unit,U or a,divisor,distribution,type,u,sensitivity,nu,source,comment\n";

AuditReport audited(const std::string& rows) {
    return audit(subject_of(workbook::read_csv(k_heads + rows, "budget.csv", "budget"), "budget.csv"), all_rules());
}

const Effect* effect_of(const AuditReport& report, const std::string& rule) {
    for (const AuditFinding& finding : report.findings) {
        if (finding.rule == rule && finding.effect) {
            return &*finding.effect;
        }
    }
    return nullptr;
}

/// \param dU_percent  change of the claimed U by this correction alone
void expect_effect(const AuditReport& report, const std::string& rule, double U, double dU_percent) {
    const Effect* const effect = effect_of(report, rule);
    ASSERT_NE(effect, nullptr) << rule;
    EXPECT_NEAR(effect->alone.U, U, 1e-7 * U) << rule;
    EXPECT_NEAR(100.0 * effect->relative_change_alone(), dU_percent, 1e-5) << rule;
}

TEST(CriticisedTables, IndicatorInMeasureMode) {
    const AuditReport report = audited(
        "calibrator,degC,0.36,2,normal,B,0.18,1,inf,,\n"
        "drift,degC,0.012,1.7320508,rectangular,B,0.0069282032302755096,1,inf,,\n"
        "resolution,degC,0.05,1.7320508,rectangular,B,0.02886751345948129,1,inf,,\n"
        "AC pick-up,degC,0.2,1.3160740,rectangular,B,0.15196713713031854,1,inf,,\n"
        "repeatability,degC,,,,A,0.2643650674519664,1,2,,\"largest s of 9 points / sqrt 3, n = 3 per direction\"\n"
        "u_c,,0.355336788117697\nnu_eff,,6.5279138367\nk,,2.399735731036956\nU,,0.852714386997945\n"
        "coverage probability,95 %\n");
    expect_effect(report, "W02", 0.851576241738357, -0.1334732551848905);  // the root was taken twice
    expect_effect(report, "U21", 0.7110902709896362, -16.608622789502757);
}

TEST(CriticisedTables, IndicatorInSourceMode) {
    const AuditReport report = audited(
        "calibrator,degC,0.56,2,normal,B,0.28,1,inf,calibrator,\n"
        "drift,degC,0.056,1.7320508,rectangular,B,0.03233161507461905,1,inf,calibrator,\n"
        "resolution,degC,0.05,1.7320508,rectangular,B,0.02886751345948129,1,inf,,\n"
        "drift (2),degC,0.38,1.7320508,rectangular,B,0.2193931022920578,2,inf,calibrator,\n"
        "AC pick-up,degC,0.2,1.3160740,rectangular,B,0.15196713713031854,1,inf,,\n"
        "repeatability,degC,,,,A,0.18973665961010094,1,2,,\n"
        "u_c,,0.5761128455151685\nnu_eff,,170.002469110580\nk,,1.974016502090822\nU,,1.137256264113443\n"
        "coverage probability,95 %\nCMC,,1.2\n");
    expect_effect(report, "S09", 0.7624595454663643, -32.95622371790182);
    EXPECT_NE(effect_of(report, "X01"), nullptr) << "U below the capability of 1.2, which hides both";
}

TEST(CriticisedTables, ViscometerWithFixedCoverageFactor) {
    const AuditReport report = audited(
        "standard oil,mPa.s,0.169405,2,normal,B,0.0847025,1,200,,\n"
        "resolution,mPa.s,0.05,1.7320508,rectangular,B,0.02886751345948129,1,1000000,,\n"
        "temperature,K,,,,,0.20856653614614212,0.08999586748324892,50,,\n"
        "repeatability,mPa.s,,,,A,0.22891046284519068,1,4,,n = 5\n"
        "u_c,,0.2464957697055255\nnu_eff,,5.376144439333904\nk,,2\nU,,0.492991539411051\ncoverage probability,95 %\n");
    expect_effect(report, "K02", 0.620532625287289, 25.87084679558682);
    EXPECT_NEAR(report.results[0].audited.U, 0.620532625287289, 1e-7) << "ν_eff is cut by those who cut it";
}

TEST(CriticisedTables, ViscometerWithTextAmongItsReadings) {
    const AuditReport report = audited(
        "standard oil,mPa.s,135.7069,2,normal,B,67.85345,1,200,,\n"
        "resolution,mPa.s,0.05,1.7320508,rectangular,B,0.02886751345948129,1,1000000,,\n"
        "temperature,K,,,,,0.20856653614614212,53.286765369936134,50,,\n"
        "repeatability,mPa.s,48.19436342,2.2360680,,A,21.553174553492212,1,4,,n = 4; one of five cells holds text\n"
        "u_c,,72.05656247619179\nnu_eff,,168.2349490679\nk,,1.974165189489374\nU,,142.2515573147641\n"
        "coverage probability,95 %\n");
    expect_effect(report, "U03", 144.1528575954103, 1.3365760744812993);
}

TEST(CriticisedTables, WeightsWithTheSpreadOfDailyDeviations) {
    // Six daily s with the stated spread 0.0464 and pooled value 0.1124.
    const AuditReport report = audited(
        "repeatability of the balance,mg,,,,A,0.046363,1,54,,\"spread of the daily s 0.146495537, 0.061848667, "
        "0.146495537, 0.061848667, 0.146495537, 0.061848667; n = 10\"\n"
        "all other rows,mg,,,,B,0.04397365382817306,1,inf,,\n"
        "u_c,,0.0639\nnu_eff,,194.8547838154\nk,,1.9722132290931\nU,,0.12602442533905\ncoverage probability,95 %\n");
    expect_effect(report, "U22", 0.2406920611652541, 90.98842190131691);
    EXPECT_EQ(report.findings.front().rule, "U22");
}

TEST(CriticisedTables, CaliperWithDriftPerYearTimesDaysOverTwelve) {
    const AuditReport report = audited(
        "all rows but drift,mm,,,,A,0.016798596073906494,1,150.04,,\n"
        "drift,mm,,,,B,0.0011980018085684736,1,inf,,(0.02+0.00025 L) um/yr x days/12\n"
        "u_c,,0.01684126\nnu_eff,,151.5700619451609\nk,,1.9757388984673\nU,,0.03327393248120\n"
        "coverage probability,95 %\n");
    expect_effect(report, "S15", 0.0331924512733074, -0.2448800061111034);
}

}  // namespace
}  // namespace gumcert::audit
