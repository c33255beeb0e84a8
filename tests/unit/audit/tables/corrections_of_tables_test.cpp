// Tables with one error in one row: whichever rules see it, and however the table rounds, it is corrected once; and what is not
// corrected is printed as it stands.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "gum/rounding.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport report_of_table(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "budget.csv", "budget"), "budget.csv"), all_rules());
}

const AuditFinding* finding_in(const AuditReport& report, const std::string& rule) {
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [&rule](const AuditFinding& finding) { return finding.rule == rule; });
    return found == report.findings.end() ? nullptr : &*found;
}

constexpr const char* k_columns = "quantity,estimate,unit,U or a,divisor,distribution,u,sensitivity,nu,comment\n";
constexpr const char* k_sound_rows =
    "Standard,0,bar,0.0060,2,normal,0.0030,1,,\"U = 0.0060 bar, k = 2, certificate A-5\"\n"
    "Repeatability,0,bar,,,,0.0040,1,11,\n";

TEST(CorrectionsOfTables, TakeTheHalfWidthAndNotTheRoundedU) {
    const std::string rest = "u_c,0.00573,bar\nk,2\nU,0.011,bar\ncoverage probability,95 %\n";
    for (const char* row : {"Hysteresis,0,bar,0.0085,3,rectangular,0.0028,1,,±0.0085 bar\n",
                            "Resolution of the gauge,0,bar,0.0085,3,rectangular,0.0028,1,,resolution 0.017 bar\n",
                            "Indicating device,0,bar,0.0085,3,rectangular,0.0028,1,,MPE 0.0085 bar verified\n"}) {
        const AuditReport report = report_of_table(k_columns + (k_sound_rows + (row + rest)));
        ASSERT_EQ(report.results.size(), 1U) << row;
        // 2 √(0.003² + 0.004² + 0.0085²/3)
        EXPECT_NEAR(report.results[0].audited.U, 0.014011900, 1e-8) << row;
        const AuditFinding* const divisor = finding_in(report, "W02");
        ASSERT_NE(divisor, nullptr) << row;
        EXPECT_EQ(divisor->what.english(), "the divisor 3 is not that of the distribution \"rectangular\"") << row;
    }
}

/// Over what a row may say of its half-width, its distribution, what it is divided by, and how u is printed: each
/// correction alone and all of them together give the same u.
TEST(CorrectionsOfTables, GiveTheOneRightU) {
    struct Words {
        const char* name;
        const char* comment;
        double number;  // of the words, of a half-width of 0.0085
    };
    const Words words[] = {{"Hysteresis", "±0.0085 bar", 1.0},
                           {"Hysteresis", "", 1.0},
                           {"Indicating device", "MPE 0.0085 bar verified", 1.0},
                           {"Resolution of the gauge", "resolution 0.017 bar", 2.0}};
    struct Distribution {
        const char* name;
        double divisor;
    };
    const Distribution distributions[] = {
        {"rectangular", std::sqrt(3.0)}, {"triangular", std::sqrt(6.0)}, {"arcsine", std::sqrt(2.0)}};
    const double divisors[] = {
        1.0, 2.0, 3.0, std::sqrt(3.0), std::sqrt(6.0), std::sqrt(2.0), std::sqrt(12.0), std::pow(3.0, 0.25)};
    std::size_t corrected = 0, twice = 0;
    for (const Words& said : words) {
        for (const Distribution& of : distributions) {
            for (const double divisor : divisors) {
                for (const int digits : {0, 2, 3}) {
                    const double u = 0.0085 / divisor, right = 0.0085 / of.divisor;
                    const std::string table =
                        k_columns + (k_sound_rows + (said.name + (",0,bar,0.0085," + text::significant(divisor, 4))) +
                                     "," + of.name + "," + (digits > 0 ? text::significant(u, digits) : "") + ",1,," +
                                     said.comment + "\n");
                    SCOPED_TRACE(table);
                    const AuditReport report = report_of_table(table);
                    ASSERT_EQ(report.results.size(), 1U);
                    const double u_c = std::sqrt(0.003 * 0.003 + 0.004 * 0.004 + right * right);
                    std::size_t corrections = 0;
                    for (const AuditFinding& finding : report.findings) {
                        if (finding.effect && finding.rule != "R03") {  // the rounding of u is another matter
                            ++corrections;
                            EXPECT_NEAR(finding.effect->alone.u_c / u_c, 1.0, 1e-6) << finding.rule;
                        }
                    }
                    if (corrections > 0) {
                        EXPECT_NEAR(report.results[0].audited.u_c / u_c, 1.0, 1e-6);
                    }
                    corrected += corrections > 0 ? 1U : 0U;
                    twice += corrections > 1 ? 1U : 0U;
                }
            }
        }
    }
    EXPECT_GT(corrected, 150U);
    EXPECT_GT(twice, 20U);
}

TEST(CorrectionsOfTables, PrintWhatWasRoundedOnTheWayAsItIsStated) {
    const std::string rows =
        "quantity,u,unit,sensitivity,nu,comment\nResolution,5.77,µm,1,,\nAbbe offset,12.7,µm,1,,\n"
        "Temperature,1.33,µm,1,,\nRepeatability,6.0,µm,1,40,\n";
    const std::string claims = "u_c,15.3,µm\nk,2\nU,31,µm\ncoverage probability,95 %\n";
    const AuditReport sound = report_of_table(rows + "Gauge block,0.40,µm,1,,\n" + claims);
    ASSERT_EQ(sound.results.size(), 1U);
    EXPECT_NEAR(sound.results[0].recomputed.U, 30.496675, 1e-5);
    EXPECT_EQ(sound.results[0].recomputed.printed_U, "31");
    EXPECT_EQ(sound.results[0].audited.printed_U, "31");
    const AuditFinding* const missing = finding_in(sound, "B05");
    ASSERT_NE(missing, nullptr);
    ASSERT_TRUE(missing->missing_term);
    EXPECT_NEAR(missing->missing_term->u_for_digit, 3.9434, 1e-3);  // √((31.5/2)² − 15.24834²)
    // A U of a certificate that was divided by 4 makes 30.488 µm of 30.512 µm: both are the 31 µm of the file.
    const AuditReport halved =
        report_of_table(rows + "Gauge block,0.30,µm,1,,\"U = 1.2 µm, k = 2, certificate 77\"\n" + claims);
    const AuditFinding* const quarter = finding_in(halved, "U13");
    ASSERT_NE(quarter, nullptr);
    ASSERT_TRUE(quarter->effect);
    EXPECT_EQ(quarter->severity, FindingSeverity::minor);
    EXPECT_EQ(quarter->effect->claimed.printed_U, "31");
    EXPECT_EQ(quarter->effect->alone.printed_U, "31");
}

/// However a laboratory rounds on the way to its U, what nobody corrects has one printed text, and is changed only by what
/// changes that.
TEST(CorrectionsOfTables, HaveOneTextOfAnUncorrectedU) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> size(0.5, 9.0), share(0.1, 1.0);
    std::size_t apart = 0, seen = 0;
    for (int i = 0; i < 200; ++i) {
        const double u[] = {size(random), share(random), share(random)};
        const double u_c = std::sqrt(u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
        std::string table = "quantity,u,unit,sensitivity,nu\n";
        for (const double one : u) {
            table += "contribution " + text::significant(one, 6) + "," + text::significant(one, 12) + ",µm,1,\n";
        }
        const int digits = 1 + i % 4;
        const std::string of_sum = text::significant(u_c, 3);
        const double U = 2.0 * std::stod(of_sum);
        const std::string stated = text::significant(U, digits);
        table += "u_c," + of_sum + ",µm\nk,2\nU," + stated + ",µm\n";
        SCOPED_TRACE(table);
        const AuditReport report = report_of_table(table);
        ASSERT_EQ(report.results.size(), 1U);
        if (finding_in(report, "K01") != nullptr) {
            continue;
        }
        ++seen;
        const AuditedResult& result = report.results[0];
        EXPECT_EQ(result.claimed.printed_U, stated);
        EXPECT_EQ(result.recomputed.printed_U, stated);
        EXPECT_EQ(result.audited.printed_U, stated);
        apart += gum::round_to_uncertainty(0.0, 2.0 * u_c).U != gum::round_to_uncertainty(0.0, std::stod(stated)).U
                     ? 1U
                     : 0U;
        for (const AuditFinding& finding : report.findings) {
            if (finding.effect) {
                EXPECT_EQ(finding.effect->claimed.printed_U, stated) << finding.rule;
            }
            if (finding.missing_term && digits == 2) {
                const double step = std::stod(stated) < 9.95 ? 0.1 : 1.0;
                const double next = 0.5 * (std::stod(stated) + 0.5 * step);
                const double least = std::sqrt(std::max(0.0, next * next - u_c * u_c));
                EXPECT_GE(finding.missing_term->u_for_digit, least * (1.0 - 1e-4)) << finding.rule;
            }
        }
    }
    EXPECT_GT(seen, 150U);
    EXPECT_GT(apart, 5U);
}

}  // namespace
}  // namespace gumcert::audit
