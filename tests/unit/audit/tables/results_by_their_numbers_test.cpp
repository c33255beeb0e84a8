// Lines of results under any name, numbers with powers of ten, and units that a line states for all of a table. The law: whatever
// a laboratory calls its u_c and U, they are no contributions.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport audit_of_lines(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
bool has_finding(const AuditReport& report, std::string_view rule) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [rule](const AuditFinding& finding) { return finding.rule == rule; });
}
std::string accusations_of(const AuditReport& report) {
    std::string all;
    for (const AuditFinding& finding : report.findings) {
        if (finding.severity == FindingSeverity::critical || finding.severity == FindingSeverity::major) {
            all += finding.rule + " " + finding.where + ": " + finding.what.english() + "\n";
        }
    }
    return all;
}

const std::string k_voltage_rows =
    "Reference,mV,0.20,2,0.10,1,0.10,inf\nDrift of the reference,mV,0.35,√3,0.202,1,0.202,inf\n"
    "Repeatability,mV,0.30,1,0.30,1,0.30,19\nTemperature,mV,0.20,√3,0.115,1,0.115,inf\n"
    "Resolution,mV,0.02,√3,0.0115,1,0.0115,inf\nReproducibility,mV,0.17,√3,0.098,1,0.098,inf\n";
const double k_voltage_u_c = std::sqrt(0.01 + 0.202 * 0.202 + 0.09 + 0.115 * 0.115 + 0.0115 * 0.0115 + 0.098 * 0.098);
std::string voltage_with(const std::string& lines) {
    return "Voltage\nQuantity,unit,U or a,divisor,u,c,Contribution,nu\n" + k_voltage_rows + lines;
}

TEST(ResultsByTheirNumbers, AreNoContributionsWhateverTheirNames) {
    for (const auto& [u_c, U] : std::vector<std::pair<std::string, std::string>>{
             {"Standard uncertainty of the result", "Expanded uncertainty of the result (k = 2)"},
             {"u(E)", "U(E) = k·u(E)"},
             {"Overall standard uncertainty", "Overall uncertainty at k=2"},
             {"Total standard uncertainty", "Total expanded uncertainty (k = 2; 95 %)"},
             {"Root sum of squares", "Two times that (k = 2)"},
             {"Measurement uncertainty (k=1)", "Measurement uncertainty (k=2)"},
             {"Combined u", "Expanded U (k=2)"},
             {"Total u_c", "Total U (k = 2)"},
             {"Gesamtunsicherheit u", "Gesamtunsicherheit U (k=2)"},
             {"Standardunsicherheit des Ergebnisses u(y)", "U = 2 · u(y)"},
             {"u_c", "U = k·u_c"},
             {"Standardmessunsicherheit", "Messunsicherheit U (95 %)"},
             {"What comes out", "Uncertainty (k = 2)"}}) {
        const AuditReport sound =
            audit_of_lines(voltage_with("\"" + u_c + "\",mV,,,,,0.405\n\"" + U + "\",mV,,,,,0.81\nk,,2\n"));
        ASSERT_EQ(sound.results.size(), 1U) << u_c;
        EXPECT_EQ(sound.subject.budgets[0].rows.size(), 6U) << u_c;
        EXPECT_NEAR(sound.results[0].audited.u_c, k_voltage_u_c, 0.002) << u_c;
        EXPECT_EQ(accusations_of(sound), "") << u_c;
        ASSERT_TRUE(sound.subject.budgets[0].claims.U) << U;
        EXPECT_EQ(sound.subject.budgets[0].claims.U->text, "0.81") << U;
        // The same with a U that is not k u_c, where its name says that it is one.
        const AuditReport planted =
            audit_of_lines(voltage_with("\"" + u_c + "\",mV,,,,,0.405\n\"" + U + "\",mV,,,,,0.60\nk,,2\n"));
        const bool is_asked = planted.results.empty();
        EXPECT_TRUE(is_asked || has_finding(planted, "K01")) << U;
    }
}

// NIST states gauge blocks so (JCGM 100:2008, H.1).
TEST(ResultsByTheirNumbers, StateTheirProbabilityInTheSymbol) {
    for (const auto& [k, U] : std::vector<std::pair<std::string, std::string>>{{"k99", "U99"}, {"t_99", "U_99"}}) {
        const AuditReport sound = audit_of_lines(
            "Gauge block\nQuantity,unit,u,nu,c,Contribution\nStandard,nm,25,18,1,25\nComparator,nm,9.7,25.6,1,9.7\n"
            "Expansion,nm,2.9,50,1,2.9\nTemperature difference,nm,16.6,2,1,16.6\nu_c,nm,31.7\nnu_eff,,16\n" +
            k + ",,2.92\n" + U + ",nm,93\n");
        ASSERT_EQ(sound.results.size(), 1U);
        EXPECT_FALSE(has_finding(sound, "K01") || has_finding(sound, "K02") || has_finding(sound, "R04")) << U;
        const Claims& claims = sound.subject.budgets[0].claims;
        ASSERT_TRUE(claims.U && claims.k) << U;
        EXPECT_EQ(claims.U->text, "93");
        EXPECT_EQ(claims.coverage_probability, 0.99);
    }
}

TEST(ResultsByTheirNumbers, LeaveInfluencesAtTheEndWhereTheyAre) {
    // Rows with an amount alone that are named as influences, and are needed for what is stated.
    const double u_c = std::sqrt(k_voltage_u_c * k_voltage_u_c + 0.405 * 0.405);
    const AuditReport report =
        audit_of_lines(voltage_with("Drift of the meter,mV,,,,,0.405\nu_c,mV,,,,,0.573\nk,,2\nU,mV,,,,,1.15\n"));
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.subject.budgets[0].rows.size(), 7U);
    EXPECT_NEAR(report.results[0].audited.u_c, u_c, 0.003);
    EXPECT_FALSE(has_finding(report, "K01"));
    // An uncertainty of something else, which nothing explains, is asked about and not added.
    EXPECT_TRUE(audit_of_lines(voltage_with("Uncertainty as agreed,mV,,,,,0.7\n")).results.empty());
}

TEST(ResultsByTheirNumbers, AReportedUIsTheOneThatCounts) {
    for (const char* const name : {"U reported", "U angegeben", "Reported expanded uncertainty", "Stated U"}) {
        for (const char* const computed : {"U", "U calculated", "U berechnet", "Expanded uncertainty"}) {
            const AuditReport report =
                audit_of_lines(voltage_with("u_c,mV,,,,,0.405\nk,,2\n" + std::string(computed) +
                                            ",mV,,,,,0.81\nCMC,mV,,,,,1.0\n" + name + ",mV,,,,,1.0\n"));
            EXPECT_EQ(accusations_of(report), "") << name << computed;
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_EQ(report.subject.budgets[0].claims.U->text, "1.0") << name << computed;
        }
    }
    EXPECT_EQ(accusations_of(
                  audit_of_lines(voltage_with("u_c,mV,,,,,0.405\nk,,2\nU,mV,,,,,0.81\nU reported (CMC),mV,,,,,1.0\n"))),
              "");
    EXPECT_TRUE(
        has_finding(audit_of_lines(voltage_with("u_c,mV,,,,,0.405\nk,,2\nU,mV,,,,,0.81\nCMC,mV,,,,,1.0\n")), "X01"));
}

TEST(ResultsByTheirNumbers, KMayBeAColumn) {
    const auto table = [](const std::string& head, const std::string& result) {
        return audit_of_lines(
            "Flow\nSource,U (%)," + head +
            ",u (%),c,Contribution (%)\nReference,0.50,2,0.25,1,0.25\nDrift of the reference,0.20,1.73,"
            "0.115,1,0.115\nRepeatability,0.10,1,0.10,1,0.10\nResolution,0.05,1.73,0.029,1,0.029\n"
            "Temperature,0.10,1.73,0.058,1,0.058\nReproducibility,0.20,2,0.10,1,0.10\n" +
            result);
    };
    for (const char* const head : {"k", "Coverage factor", "Coverage factor k", "k-factor", "Erweiterungsfaktor"}) {
        for (const char* const result :
             {"Combined,,,,,0.316\nExpanded uncertainty,0.63,2,,,\n", "Total,0.63,2,0.316,,\n"}) {
            const AuditReport report = table(head, result);
            ASSERT_EQ(report.results.size(), 1U) << head;
            EXPECT_NEAR(report.results[0].audited.u_c, 0.3161, 0.0005) << head << result;
            EXPECT_NEAR(report.results[0].audited.k, 2.0, 1e-9) << head << result;
            EXPECT_FALSE(has_finding(report, "K01")) << head << result;
            EXPECT_EQ(accusations_of(report).find("R04"), std::string::npos) << head << result;
        }
    }
    EXPECT_TRUE(audit_of_lines("Quantity,Value,Unit,U,k\na,10.1,V,0.2,2\nb,20.1,V,0.2,2\n").results.empty())
        << "results are no budget";
}

TEST(ResultsByTheirNumbers, SayWhichOfTwoIsUsedAndWhatIsNotStated) {
    const auto says = [](const AuditReport& report, const std::string& text) {
        return std::any_of(
            report.subject.not_read.begin(), report.subject.not_read.end(),
            [&text](const Sentence& sentence) { return sentence.english().find(text) != std::string::npos; });
    };
    const AuditReport of_one = audit_of_lines(voltage_with("U (k = 1),mV,,,,,0.405\nU (k = 2),mV,,,,,0.81\n"));
    EXPECT_EQ(of_one.subject.budgets.at(0).claims.U->text, "0.81");
    EXPECT_EQ(of_one.subject.budgets.at(0).claims.u_c->text, "0.405");
    EXPECT_FALSE(says(of_one, "which one holds"));
    const AuditReport two =
        audit_of_lines(voltage_with("u_c,mV,,,,,0.405\nU (k = 2),mV,,,,,0.81\nU (k = 3),mV,,,,,1.2\n"));
    EXPECT_EQ(two.subject.budgets.at(0).claims.U->text, "0.81");
    EXPECT_TRUE(says(two, "\"U (k = 3)\" has another number than"));
    const std::string once = "u_c,mV,,,,,0.405\nk,,2\n";
    EXPECT_TRUE(says(audit_of_lines(voltage_with(once)), "no U was read"));
    EXPECT_FALSE(says(audit_of_lines(voltage_with(once + "U,mV,,,,,0.81\nU,µV,,,,,810\nU,%,,,,,0.0081\n")), "U"));
    // An uncorrected bias that is added (JCGM 100, F.2.4.5) is no k u_c.
    EXPECT_TRUE(says(audit_of_lines(voltage_with(once + "U = k u_c + |b|,mV,,,,,0.93\n")), "no U was read"));
}

TEST(ResultsByTheirNumbers, OfATableBelowAreNotOfTheBudget) {
    const AuditReport report = audit_of_lines(
        voltage_with("u_c,mV,,,,,0.405\nU (k = 2),mV,,,,,0.81\n\nQuantity,Value,Unit,U,k\np1,1.0002,V,0.0008,2\n"
                     "p2,10.001,V,0.0008,2\n"));
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_NEAR(report.results[0].audited.u_c, k_voltage_u_c, 0.002);
    EXPECT_EQ(report.subject.budgets[0].claims.U->text, "0.81");
}

TEST(ResultsByTheirNumbers, AreNotMadeUpWhereNothingSaysHow) {
    // EURACHEM QUAM, A5: a product of factors, with relative uncertainties.
    const std::string units = "c,mg/L,0.26,0.018,0.069\nV,L,0.332,0.0018,0.0054\na,dm2,5.73,0.19,0.033\n";
    EXPECT_TRUE(audit_of_lines("Quantity,Unit,Value,u(x),u(x)/x\n" + units).results.empty());
    EXPECT_TRUE(audit_of_lines("Quantity,Unit,Value,u(x),Comment\n" + units).results.empty());
    EXPECT_TRUE(
        audit_of_lines("Quantity,Value,u(x),u(x)/x\nc,0.26,0.018,0.069\nV,0.332,0.0018,0.0054\n").results.empty());
    // Rows that can be added are, with or without a stated result.
    EXPECT_EQ(audit_of_lines("Quantity,Unit,Value,u(x)\na,mm,1.2,0.018\nb,µm,332,1.8\n").results.size(), 1U);
    EXPECT_EQ(audit_of_lines("Quantity,Unit,Value,u(x),c\na,mm,1.2,0.018,1\nb,K,0.3,0.2,0.01\n").results.size(), 1U);
}

TEST(ResultsByTheirNumbers, PowersOfTenAreRead) {
    const auto table = [](const std::string& number) {
        return audit_of_lines(
            "Frequency, relative\nQuantity,unit,u,c,Contribution,nu\nReference,1,1.0E-13,1,1.0E-13,inf\n"
            "Drift of the reference,1,2.0E-13,1,2.0E-13,inf\nRepeatability,1," +
            number + ",1," + number + ",19\nTemperature,1,1.2E-13,1,1.2E-13,inf\nu_c,1,3.9E-13\nk,,2\nU,1,7.9E-13\n");
    };
    for (const char* const number :
         {"3.0·10⁻¹³", "3.0×10⁻¹³", "3.0 × 10⁻¹³", "3.0⋅10⁻¹³", "3.0∙10⁻¹³", "3.0•10^-13", "3.0*10⁻¹³", "3.0E–13",
          "3.0 E-13", "3.0·10^–13", "3.0·10**-13", "3.0∙10^(-13)", "3.0 x 10⁻¹³", "3.0e−13"}) {
        const AuditReport report = table(number);
        ASSERT_EQ(report.results.size(), 1U) << number;
        EXPECT_NEAR(report.results[0].audited.u_c, 3.929e-13, 1e-15) << number;
        EXPECT_FALSE(has_finding(report, "K01")) << number;
    }
    // The first number of a product or quotient is another one.
    for (const char* const number : {"2×1.5E-13", "6E-13/2", "2 * 1.5", "6/√3"}) {
        const AuditReport report = table(number);
        for (const AuditedRow& row :
             report.subject.budgets.empty() ? std::vector<AuditedRow>() : report.subject.budgets[0].rows) {
            EXPECT_LT(row.used_u, 1e-12) << number;
        }
    }
}

TEST(ResultsByTheirNumbers, AUnitMayStandInALineForAllOfTheTable) {
    const std::string rows =
        "Quantity;u;c;Beitrag\nNormal;1,0;1;1,0\nDrift des Normals;0,5;1;0,5\nAuflösung;2,9;1;2,9\n"
        "Temperatur;0,4;1;0,4\nReproduzierbarkeit;0,5;1;0,5\nu_c;;;3,2\nk;2\nU;6,4\n";
    for (const char* const line : {"Druck 10 bar, alle Angaben in mbar", "Pressure, all values in mbar",
                                   "Standardunsicherheiten in mbar", "Calibration, all in mbar (k = 2)"}) {
        for (const bool above : {true, false}) {
            const AuditReport report =
                audit_of_lines(above ? std::string(line) + "\n" + rows : "Druck\n" + rows + line + "\n");
            ASSERT_EQ(report.results.size(), 1U) << line;
            EXPECT_FALSE(has_finding(report, "R05")) << line;
            EXPECT_EQ(report.results[0].unit, "mbar") << line << above;
        }
    }
    for (const char* const line : {"Pressure", "All tests in order", "Wall thickness in mm", "Values in the table"}) {
        EXPECT_TRUE(has_finding(audit_of_lines(std::string(line) + "\n" + rows), "R05")) << line;
    }
}

}  // namespace
}  // namespace gumcert::audit
