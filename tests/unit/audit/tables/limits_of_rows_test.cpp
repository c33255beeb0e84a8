// Limits of what rows divide, "Lower | Upper": taken where u shows that it was made of them, and named as not read elsewhere.
#include "audit/tables/limits_of_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport report_of_limits(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
std::string accusations_of_limits(const AuditReport& report) {
    std::string all;
    for (const AuditFinding& finding : report.findings) {
        const bool is_of_rows = finding.rule == "U08" || finding.rule == "U17" || finding.rule == "U26" ||
                                finding.rule == "K01" || finding.rule == "K09" || finding.rule.front() == 'S' ||
                                finding.rule.front() == 'W';
        if (is_of_rows) {
            all += finding.rule + " " + finding.where + ": " + finding.what.english() + "\n";
        }
    }
    return all;
}
bool names_as_unread(const AuditReport& report, const std::string& head) {
    return std::any_of(report.subject.not_read.begin(), report.subject.not_read.end(), [&head](const Sentence& said) {
        return said.english().find("\"" + head + "\"") != std::string::npos;
    });
}

struct ShapeOfLimits {
    std::string name;
    double divisor;
};
const std::vector<ShapeOfLimits> k_shapes_of_limits = {
    {"rectangular", std::sqrt(3.0)}, {"triangular", std::sqrt(6.0)}, {"U-shaped", std::sqrt(2.0)}};

/// The law: limits of any size, shape and estimate accuse nobody where u was made of them, and u of one row that was not divided by the
/// divisor of its shape is found beside those that were.
TEST(TakeLimits, AccusesNoSoundBudgetAndFindsAnUndividedRow) {
    std::mt19937 random(20261130);
    const auto any = [&random](int low, int high) {
        return low + static_cast<int>(random() % static_cast<unsigned>(high - low + 1));
    };
    const std::vector<std::vector<std::string>> heads = {
        {"Lower", "Upper"}, {"a-", "a+"}, {"Lower limit", "Upper limit"}, {"Untergrenze", "Obergrenze"}};
    for (int trial = 0; trial < 150; ++trial) {
        const std::vector<std::string>& head = heads[static_cast<std::size_t>(trial) % heads.size()];
        const bool about_estimate = any(0, 1) == 0, in_head = any(0, 1) == 0;
        const std::string unit = in_head ? " / mV" : "";
        const auto table = [&, rows = any(2, 6), first = random()](int wrong) {
            std::mt19937 same(first);
            std::string text = "Quantity,Estimate,Unit," + head[0] + unit + "," + head[1] + unit +
                               ",Distribution,Standard uncertainty" + unit + "\n" +
                               "Certificate (k = 2),10,mV,,,normal,0.150\n";
            double squares = 0.150 * 0.150;
            for (int i = 0; i < rows; ++i) {
                const ShapeOfLimits& shape = k_shapes_of_limits[same() % k_shapes_of_limits.size()];
                const double a = 0.10123 + static_cast<double>(same() % 400) * 0.005;
                const double estimate = about_estimate ? static_cast<double>(same() % 50) : 0.0;
                const double u = std::stod(text::significant(i == wrong ? a : a / shape.divisor, 4));
                squares += u * u;
                text += "Effect " + std::string(1, static_cast<char>('A' + i)) + "," + text::shortest(estimate) +
                        ",mV," + text::significant(estimate - a, 8) + "," + text::significant(estimate + a, 8) + "," +
                        shape.name + "," + text::significant(u, 4) + "\n";
            }
            return text + "u_c,,mV,,,," + text::significant(std::sqrt(squares), 4) + "\nU (k = 2),,mV,,,," +
                   text::significant(2.0 * std::sqrt(squares), 4) + "\n";
        };
        const AuditReport sound = report_of_limits(table(-1));
        ASSERT_EQ(sound.results.size(), 1U) << table(-1);
        EXPECT_EQ(accusations_of_limits(sound), "") << table(-1);
        EXPECT_FALSE(names_as_unread(sound, head[0] + unit)) << table(-1);
        const AuditReport planted = report_of_limits(table(1));
        EXPECT_NE(accusations_of_limits(planted).find("U08"), std::string::npos) << table(1);
    }
}

TEST(TakeLimits, LeavesRangesThatUWasNotMadeOf) {
    for (const char* const shape : {"rectangular", "normal", ""}) {
        for (const char* const estimate : {"20.3", "20.0", ""}) {
            for (const char* const u : {"0.20", "1.0", "2.0", "2", "4.00"}) {
                const double sum = std::hypot(0.3, std::stod(u));
                const AuditReport report = report_of_limits(
                    "Quantity,Estimate,Unit,Lower,Upper,Distribution,Standard uncertainty\n"
                    "Certificate (k = 2),0,°C,,,normal,0.30\nAmbient temperature," +
                    std::string(estimate) + ",°C,18,22," + shape + "," + u + "\nu_c,,°C,,,," +
                    text::significant(sum, 3) + "\nU (k = 2),,°C,,,," + text::significant(2.0 * sum, 3) + "\n");
                EXPECT_EQ(accusations_of_limits(report), "") << shape << estimate << u;
                EXPECT_TRUE(names_as_unread(report, "Lower") && names_as_unread(report, "Upper")) << shape << u;
            }
        }
    }
}

TEST(TakeLimits, LeavesCoverageIntervalsAndMagnitudes) {
    for (const char* const bracket : {" (95 %)", " (k = 2)", " 95 %", " (p = 0.95)"}) {
        const AuditReport coverage = report_of_limits("Quantity,Unit,Standard uncertainty,Distribution,Lower" +
                                                      std::string(bracket) + ",Upper" + bracket +
                                                      "\nCertificate (k = 2),mV,0.0182,normal,-0.0357,0.0357\n"
                                                      "Drift,mV,0.0173,rectangular,-0.0285,0.0285\nu_c,mV,0.0251,,,\n");
        EXPECT_EQ(accusations_of_limits(coverage), "");
        EXPECT_TRUE(names_as_unread(coverage, "Lower" + std::string(bracket)));
    }
    const AuditReport magnitudes = report_of_limits(
        "Quantity,Estimate,Unit,a-,a+,Distribution,Standard uncertainty\nCertificate (k = 2),0,mV,,,normal,0.0182\n"
        "Drift,0,mV,0.03,0.05,rectangular,0.0231\nOffset,0,mV,0.03,0.03,rectangular,0.0173\nu_c,,mV,,,,0.0341\n");
    EXPECT_EQ(accusations_of_limits(magnitudes), "");
    EXPECT_TRUE(names_as_unread(magnitudes, "a-") && names_as_unread(magnitudes, "a+"));
}

TEST(TakeLimits, LeavesAHalfWidthWhatItIs) {
    const auto finds_undivided = [](const std::string& table) {
        return accusations_of_limits(report_of_limits(table)).find("U08") != std::string::npos;
    };
    // No row shows that they are limits.
    EXPECT_TRUE(
        finds_undivided("Quantity,Estimate,Unit,a-,a+,Distribution,Standard uncertainty\n"
                        "Reference,0,mV,-0.2,0.2,triangular,0.200\nDrift,0,mV,-0.02,0.02,rectangular,0.0200\n"
                        "u_c,,mV,,,,0.201\nU (k = 2),,mV,,,,0.402\n"));
    // Of one size in each row.
    EXPECT_TRUE(
        finds_undivided("Quantity,Estimate,Unit,a-,a+,Distribution,Standard uncertainty\n"
                        "Reference,0,mV,0.2,0.2,triangular,0.200\nDrift,0,mV,0.05,0.05,triangular,0.0204\n"
                        "u_c,,mV,,,,0.201\nU (k = 2),,mV,,,,0.402\n"));
    for (const char* const head : {"a+", "a-", "Limit a-"}) {
        EXPECT_TRUE(finds_undivided("Quantity,Unit," + std::string(head) +
                                    ",Distribution,Standard uncertainty\nReference,mV,0.05,rectangular,0.0289\n"
                                    "Drift,mV,0.08,rectangular,0.0800\nu_c,mV,,,0.0851\nU (k = 2),mV,,,0.170\n"))
            << head;
    }
}

TEST(HalfWidthOfLimits, IsNothingWithoutLimits) {
    const workbook::Workbook book = workbook::read_csv("Quantity,u\nA,1\n", "b.csv", "b");
    const workbook::Evaluation evaluation;
    const SheetView sheet(book, evaluation, 0, DecimalSign::point);
    EXPECT_FALSE(half_width_of_limits(sheet, Heads{}, sheet.rows().begin()->second));
}

}  // namespace
}  // namespace gumcert::audit
