#include "audit/tables/parts_of_value.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

// The law: U of a result is the same whether it is stated in its unit or as a part of its value, and is held against the rows either
// way. A part of something else, as of a full scale, accuses nobody.

AuditReport audit_of_parts(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
bool finds_part(const AuditReport& report, const std::string& rule) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [&rule](const AuditFinding& finding) { return finding.rule == rule; });
}
bool is_free_of_critical(const AuditReport& report) {
    return std::none_of(report.findings.begin(), report.findings.end(),
                        [](const AuditFinding& finding) { return finding.severity == FindingSeverity::critical; });
}
std::string said_of_parts(const AuditReport& report) {
    std::string all;
    for (const Sentence& sentence : report.subject.not_read) {
        all += sentence.english() + "\n";
    }
    return all;
}
const std::string k_rows_of_parts =
    "Torque\nQuantity,Unit,a,divisor,u\nReference (certificate; U = 3.0 mN·m; k = 2),mN·m,3.0,2,1.50\n"
    "Drift of the standard,mN·m,2.2,√3,1.27\nResolution,mN·m,0.5,√3,0.289\nRepeatability,mN·m,0.9,1,0.900\n";

TEST(PartsOfAValue, AreHeldAgainstTheRows) {
    // u_c = 2.18 mN·m, U = 4.37 mN·m; the value is 10.0023 N·m.
    for (const std::string line :
         {"Relative expanded uncertainty,%,,,0.044\n", "U,%,,,0.044\n", "U,ppm,,,437\n", "U,ppm,,,440\n",
          "U,mN·m/(N·m),,,0.437\n", "U (k = 2),,,,0.044 %\n", "Relative expanded uncertainty,%,,,0.0437\n"}) {
        const AuditReport report =
            audit_of_parts(k_rows_of_parts + "Measured value,N·m,,,10.0023\nu_c,mN·m,,,2.18\nk,,,2\n" + line);
        SCOPED_TRACE(line + said_of_parts(report));
        ASSERT_EQ(report.results.size(), 1U);
        ASSERT_TRUE(report.subject.budgets[0].claims.U);
        EXPECT_NEAR(report.subject.budgets[0].claims.U->value, 4.37, 0.04);
        EXPECT_EQ(report.subject.budgets[0].unit, "mN·m");
        EXPECT_NE(said_of_parts(report).find(" is taken as "), std::string::npos);
        EXPECT_TRUE(is_free_of_critical(report));
    }
    const AuditReport both =
        audit_of_parts(k_rows_of_parts +
                       "Measured value,N·m,,,10.0023\nRelative standard uncertainty,%,,,0.0218\nk,,,2\nU,mN·m,,,4.4\n");
    ASSERT_EQ(both.results.size(), 1U);
    ASSERT_TRUE(both.subject.budgets[0].claims.u_c);
    EXPECT_NEAR(both.subject.budgets[0].claims.u_c->value, 2.18, 0.01);
    EXPECT_TRUE(is_free_of_critical(both));
}

TEST(PartsOfAValue, ThatAreTooSmallAreFoundWhereTheyAreCalledRelative) {
    const std::string claims = "Measured value,N·m,,,10.0023\nu_c,mN·m,,,2.18\nk,,,2\n";
    const AuditReport named = audit_of_parts(k_rows_of_parts + claims + "Relative expanded uncertainty,%,,,0.022\n");
    ASSERT_EQ(named.results.size(), 1U);
    EXPECT_TRUE(finds_part(named, "K01"));
    const AuditReport open = audit_of_parts(k_rows_of_parts + claims + "U,%,,,0.022\n");
    ASSERT_EQ(open.results.size(), 1U);
    EXPECT_FALSE(finds_part(open, "K01"));
    EXPECT_FALSE(open.subject.budgets[0].claims.U);
    EXPECT_NE(said_of_parts(open).find("to which value does it belong?"), std::string::npos);
}

TEST(PartsOfAValue, OfSomethingElseAccuseNobody) {
    // Of a full scale, of the nominal value beside a deviation, of no value at all.
    for (const std::string value :
         {"Measured value,N·m,,,2.5006\n", "Deviation,mN·m,,,2.3\n", "Value,mN·m,,,0\n", ""}) {
        for (const std::string U : {"U,%,,,0.044\n", "Relative expanded uncertainty,%,,,0.044\n"}) {
            const AuditReport report = audit_of_parts(k_rows_of_parts + value + "u_c,mN·m,,,2.18\nk,,,2\n" + U);
            SCOPED_TRACE(value + U + said_of_parts(report));
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_FALSE(report.subject.budgets[0].claims.U);
            EXPECT_TRUE(is_free_of_critical(report));
            EXPECT_NE(said_of_parts(report).find("is not used"), std::string::npos);
        }
    }
    // A temperature in degrees Celsius has no parts.
    EXPECT_FALSE(has_parts(read_number("20.0", ""), "°C"));
    EXPECT_FALSE(has_parts(read_number("0", ""), "V"));
    EXPECT_FALSE(has_parts(read_number("0.5", ""), "%"));
    EXPECT_TRUE(has_parts(read_number("10.0", ""), "V"));
}

TEST(PartsOfAValue, OfWhatIsSaidBesideThemAreAskedAbout) {
    for (const char* line :
         {"Relative expanded uncertainty (of full scale),%,,,0.044\n",
          "Relative expanded uncertainty (full scale),%,,,0.044\n", "Relative expanded uncertainty (FS),%,,,0.044\n",
          "Relative expanded uncertainty (% of span),,,,0.044 %\n",
          "Relative erweiterte Messunsicherheit (v. E.),%,,,0.044\n",
          "Relative expanded uncertainty (k = 2) of the nominal torque,%,,,0.044\n",
          "Relative expanded uncertainty (related to 10 N·m),%,,,0.044\n",
          "Relative expanded uncertainty,%,,,0.044,of full scale\n"}) {
        const AuditReport report =
            audit_of_parts(k_rows_of_parts + "Measured value,N·m,,,6.0012\nu_c,mN·m,,,2.18\nk,,,2\n" + line);
        SCOPED_TRACE(line + said_of_parts(report));
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_FALSE(report.subject.budgets[0].claims.U);
        EXPECT_TRUE(is_free_of_critical(report));
        EXPECT_NE(said_of_parts(report).find("to which value does it belong?"), std::string::npos);
    }
}

TEST(PartsOfAValue, MayBeBothUncertainties) {
    for (const char* value : {"10.0023", "6.0012"}) {
        for (const auto& [u_c, U] : std::vector<std::pair<std::string, std::string>>{
                 {"u_c", "U"}, {"Relative combined standard uncertainty", "Relative expanded uncertainty"}}) {
            const std::string of = std::string(value) == "6.0012" ? "0.0363 0.073" : "0.0218 0.044";
            const AuditReport report =
                audit_of_parts(k_rows_of_parts + "Measured value,N·m,,," + value + "\n" + u_c + ",%,,," +
                               of.substr(0, 6) + "\nk,,,2\n" + U + ",%,,," + of.substr(7) + "\n");
            SCOPED_TRACE(u_c + " " + value + said_of_parts(report));
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_TRUE(is_free_of_critical(report));
            EXPECT_FALSE(finds_part(report, "S01"));
            ASSERT_TRUE(report.subject.budgets[0].claims.u_c && report.subject.budgets[0].claims.U);
            EXPECT_NEAR(report.results[0].recomputed.u_c, report.subject.budgets[0].claims.u_c->value,
                        0.01 * report.results[0].recomputed.u_c);
        }
    }
}

TEST(PartsOfAValue, AreNoneWhereNothingSaysSo) {
    // Rows in percent make up no U in °C, and none of a value of 0.
    const std::string rows = "Dew point\nQuantity,Unit,u\nHumidity standard,%,0.15\nDrift,%,0.07\nHysteresis,%,0.05\n";
    for (const char* lines : {"k,,2\nU,°C,0.35\n", "Measured value,N·m,0\nk,,2\nU,N·m,0.35\n"}) {
        const AuditReport report = audit_of_parts(rows + lines);
        SCOPED_TRACE(lines + said_of_parts(report));
        EXPECT_TRUE(finds_part(report, "S01"));
    }
    // U below a head in percent, and then in the unit of the value, is looked at twice.
    const AuditReport both = audit_of_parts(
        "Pressure\nQuantity,w (%),c,Contribution (%)\nStandard,0.030,1,0.030\nDrift,0.020,1,0.020\n"
        "Hysteresis,0.029,1,0.029\nMeasured value,50.02 bar,,\nu_c,,,0.0463\nk,,,2\nU,,,0.093\n"
        "Expanded uncertainty U,0.093 bar,,\n");
    ASSERT_EQ(both.results.size(), 1U);
    EXPECT_EQ(both.subject.budgets[0].unit, "%");
    EXPECT_TRUE(is_free_of_critical(both));
    EXPECT_NE(said_of_parts(both).find("to which value does it belong?"), std::string::npos) << said_of_parts(both);
}

TEST(PartsOfAValue, BesideTheNumberAreHeldAgainstIt) {
    const std::string claims = "Measured value,N·m,,,10.0023\nu_c,mN·m,,,2.18\nk,,,2\nU,mN·m,,,4.4\n";
    for (const auto& [part, is_same] :
         std::vector<std::pair<std::string, bool>>{{"0.044", true}, {"0.0437", true}, {"0.088", false}}) {
        for (const std::string& lines : {claims + "Relative expanded uncertainty,%,,," + part + "\n",
                                         "Relative expanded uncertainty,%,,," + part + "\n" + claims}) {
            const AuditReport report = audit_of_parts(k_rows_of_parts + lines);
            SCOPED_TRACE(lines + said_of_parts(report));
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_EQ(report.subject.budgets[0].claims.U->text, "4.4");
            EXPECT_EQ(said_of_parts(report).find("to which value does it belong?") == std::string::npos, is_same);
            EXPECT_TRUE(is_free_of_critical(report));
        }
    }
}

TEST(PartsOfAValue, MayBeTheRowsThemselves) {
    // u_c = 0.0218 %, U = 0.0437 %; of 100.02 N·m U is 0.0437 N·m.
    const std::string rows =
        "Torque 100 N·m\nInfluence,Half-width (%),Distribution,Divisor,w (%),Contribution (%)\n"
        "Reference machine (certificate; W = 0.03 %; k = 2),0.030,normal,2,0.0150,0.0150\n"
        "Reproducibility,0.022,rectangular,√3,0.0127,0.0127\nResolution,0.005,rectangular,√3,0.00289,0.00289\n"
        "Repeatability,0.009,normal,1,0.00900,0.00900\n";
    const std::string in_percent = "Relative combined standard uncertainty w_c,,,,,0.0218 %\nCoverage factor,,,,,2\n";
    for (const std::string& lines : {in_percent + "Relative expanded uncertainty W,,,,,0.044 %\nMeasured value,100.02 "
                                                  "N·m\nExpanded uncertainty U,0.044 N·m\n",
                                     in_percent + "Measured value,100.02 N·m\nExpanded uncertainty U,0.044 N·m\n",
                                     in_percent + "Measured value,100.02 N·m\nU,44 mN·m\nU,0.044 %\n",
                                     in_percent + "Expanded uncertainty U,0.044 N·m\n"}) {
        const AuditReport report = audit_of_parts(rows + lines);
        SCOPED_TRACE(lines + said_of_parts(report));
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].unit, "%");
        EXPECT_NEAR(report.results[0].recomputed.U, 0.0437, 1e-4);
        EXPECT_FALSE(finds_part(report, "S01"));
        EXPECT_TRUE(is_free_of_critical(report));
    }
    const AuditReport wrong = audit_of_parts(rows + in_percent +
                                             "Relative expanded uncertainty W,,,,,0.022 %\n"
                                             "Measured value,100.02 N·m\nExpanded uncertainty U,0.022 N·m\n");
    ASSERT_EQ(wrong.results.size(), 1U);
    EXPECT_TRUE(finds_part(wrong, "K01"));
    // Where u_c is that of the rows by the value, so has U to be.
    for (const char* U : {"0.044", "0.022"}) {
        const AuditReport whole = audit_of_parts(
            rows +
            "Measured value,100.02 N·m\nCombined standard uncertainty,0.0218 N·m\nExpanded uncertainty (k = 2)," + U +
            " N·m\n");
        ASSERT_EQ(whole.results.size(), 1U);
        EXPECT_EQ(finds_part(whole, "K01"), std::string(U) == "0.022") << said_of_parts(whole);
    }
    // Shares of the variance are no parts of the value.
    const AuditReport shares = audit_of_parts(
        "Voltage\nQuantity,u / mV,Contribution (%)\nReference (certificate; U = 0.6 mV; k = 2),0.30,36\nDrift of the "
        "reference,0.40,64\nU (k = 2),1.00 mV\n");
    ASSERT_EQ(shares.results.size(), 1U);
    EXPECT_EQ(shares.subject.budgets[0].unit, "mV");
    EXPECT_TRUE(is_free_of_critical(shares));
}

}  // namespace
}  // namespace gumcert::audit
