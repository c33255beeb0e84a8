// Sound budgets in the layouts that other laboratories use, and the same with an error planted. The law: a layout accuses
// nobody, and hides no error.
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
#include "audit/words/column_heads.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport report_on(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
std::string accused_of(const AuditReport& report) {
    std::string all;
    for (const AuditFinding& finding : report.findings) {
        if (finding.severity == FindingSeverity::critical || finding.severity == FindingSeverity::major) {
            all += finding.rule + " " + finding.where + ": " + finding.what.english() + "\n";
        }
    }
    return all;
}
bool tells(const AuditReport& report, const std::string& text) {
    return std::any_of(
        report.subject.not_read.begin(), report.subject.not_read.end(),
        [&text](const Sentence& sentence) { return sentence.english().find(text) != std::string::npos; });
}
bool finds(const AuditReport& report, std::string_view rule) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [rule](const AuditFinding& finding) { return finding.rule == rule; });
}

/// One row of a thermometer's budget; its contribution is in millikelvin.
struct Source {
    std::string name;
    double value;
    std::string unit, distribution, divisor_text;
    double divisor, coefficient;
    std::string coefficient_text, nu;
};
const std::vector<Source> k_sources = {
    {"Reference thermometer (certificate 24-118: U = 10 mK, k = 2)", 10.0, "mK", "normal", "2", 2.0, 1.0, "1", ""},
    {"Drift of the reference", 5.0, "mK", "rectangular", "1.7321", std::sqrt(3.0), 1.0, "1", ""},
    {"Homogeneity of the bath", 12.0, "mK", "rectangular", "1.7321", std::sqrt(3.0), 1.0, "1", ""},
    {"Bridge", 2.0, "mΩ", "rectangular", "1.7321", std::sqrt(3.0), 2.6, "2.6 mK/mΩ", ""},
    {"Resolution of the item", 0.5, "mK", "rectangular", "1.7321", std::sqrt(3.0), 1.0, "1", ""},
    {"Repeatability", 1.8, "mK", "normal", "1", 1.0, 1.0, "1", "9"},
    {"Reproducibility", 2.0, "mK", "normal", "1", 1.0, 1.0, "1", "12"},
};
double u_c_of(const std::vector<Source>& sources) {
    double variance = 0.0;
    for (const Source& one : sources) {
        const double part = one.value / one.divisor * one.coefficient;
        variance += part * part;
    }
    return std::sqrt(variance);
}
/// \param head     of the column of contributions
/// \param combined  name and distribution of the line of u_c
std::string written(const std::vector<Source>& sources, const std::string& head, const std::string& combined,
                    double u_c) {
    std::string table = "Component,Value ±,Unit,Distribution,Divisor,c_i,\"" + head + "\",nu\n";
    for (const Source& one : sources) {
        table += "\"" + one.name + "\"," + text::shortest(one.value) + "," + one.unit + "," + one.distribution + "," +
                 one.divisor_text + "," + one.coefficient_text + "," +
                 text::significant(one.value / one.divisor * one.coefficient, 3) + "," + one.nu + "\n";
    }
    return table + combined + ",,," + text::significant(u_c, 3) + ",> 1000\n" +
           "Expanded uncertainty,,mK,Normal (k = 2),2,," + text::significant(2.0 * u_c, 2) +
           ",\ncoverage probability,95.45 %\n";
}

TEST(LayoutsOfTables, AColumnHoldsWhatItsNumbersAre) {
    const double u_c = u_c_of(k_sources);
    for (const char* const head : {"u_i (mK)", "u_i in mK", "Standard uncertainty (mK)", "u (mK)", "u_i(y) (mK)",
                                   "Contribution / mK", "Standardunsicherheit in mK"}) {
        for (const char* const combined :
             {"Combined standard uncertainty,,mK,Normal", "Standard uncertainty,,mK,Normal",
              "Standardunsicherheit,,mK,", "u_c,,mK,Normal", "Result,,mK,Normal"}) {
            const AuditReport sound = report_on(written(k_sources, head, combined, u_c));
            ASSERT_EQ(sound.results.size(), 1U) << head << combined;
            EXPECT_EQ(accused_of(sound), "") << head << combined;
            EXPECT_NEAR(sound.results[0].audited.u_c, u_c, 0.002 * u_c) << head << combined;
            EXPECT_EQ(sound.results[0].unit, "mK");
            // A row left out of the sum is found, with the U that is right.
            std::vector<Source> fewer = k_sources;
            fewer.erase(fewer.begin() + 2);
            if (std::string_view(combined).starts_with("Result")) {
                continue;  // which of the two it is has to be asked
            }
            const AuditReport planted = report_on(written(k_sources, head, combined, u_c_of(fewer)));
            EXPECT_TRUE(finds(planted, "K01")) << head << combined;
            ASSERT_EQ(planted.results.size(), 1U);
            EXPECT_NEAR(planted.results[0].audited.U, 2.0 * u_c, 0.004 * u_c) << head << combined;
        }
    }
}

TEST(LayoutsOfTables, AStandardUncertaintyWithoutCoefficientStaysOne) {
    // u(x_i), of which nobody has formed |c| u: read with the coefficient.
    std::string table = "Component,Value ±,Unit,Distribution,Divisor,c_i,u_i,nu\n";
    for (const Source& one : k_sources) {
        table += "\"" + one.name + "\"," + text::shortest(one.value) + "," + one.unit + "," + one.distribution + "," +
                 one.divisor_text + "," + one.coefficient_text + "," + text::significant(one.value / one.divisor, 3) +
                 "," + one.nu + "\n";
    }
    const double u_c = u_c_of(k_sources);
    const AuditReport report = report_on(table + "u_c,mK," + text::significant(u_c, 3) + "\nk,,2\nU,mK," +
                                         text::significant(2.0 * u_c, 2) + "\ncoverage probability,,95.45 %\n");
    EXPECT_EQ(accused_of(report), "");
    EXPECT_NEAR(report.results.at(0).audited.u_c, u_c, 0.002 * u_c);
}

TEST(LayoutsOfTables, TheUnitOfRowsThatAreAddedIsThatOfTheResult) {
    for (const char* const unit : {"N m", "1", "dB", "µV/V"}) {
        const AuditReport report =
            report_on("Component,Value ±,Unit,Distribution,Divisor,c,u_i\nReference,0.020," + std::string(unit) +
                      ",normal,2,1,0.010\nDrift of the reference,0.010," + unit +
                      ",rectangular,1.732,1,0.0058\nResolution of the item,0.005," + unit +
                      ",rectangular,1.732,1,0.0029\nu_c,,,,,,0.0119\nk,2\nU,,,,,,0.024\n");
        EXPECT_FALSE(finds(report, "R05")) << unit;
    }
    // EA-4/02, S6: all factors are of dimension one, whatever their coefficients.
    EXPECT_FALSE(
        finds(report_on("Quantity,Estimate,Unit,u,Distribution,c,Contribution\nK_S,0.957,1,0.0055,normal,0.972,"
                        "0.00535\nM,1.000,1,0.0200,U-shaped,0.933,0.0187\np,0.976,1,0.0032,normal,0.956,"
                        "0.00306\nK_X,0.933,,,,,0.0197\nU,0.039\nk,2\n"),
              "R05"));
    // Rows without units, or in several, say nothing of the result.
    EXPECT_TRUE(
        finds(report_on("Component,u\nReference,0.01\nDrift,0.02\nResolution,0.03\nu_c,0.037\nk,2\nU,0.075\n"), "R05"));
}

TEST(LayoutsOfTables, APointOfSeveralIsABudgetOfItsOwn) {
    const auto table = [](const std::string& U_100) {
        return "Source of uncertainty,Distribution,Divisor,u (1 V) in µV,u bei 10 V in µV,u at 100 V in µV\n"
               "Calibrator,normal,2,1.5,12,150\nDrift of the calibrator,rectangular,1.732,0.9,8,90\n"
               "Resolution of the item,rectangular,1.732,0.29,2.9,29\nReproducibility,rectangular,1.732,0.4,3,25\n"
               "Temperature,rectangular,1.732,0.3,3,30\nCombined standard uncertainty,,,1.84,15.3,182\n"
               "Expanded uncertainty (k = 2),,,3.7,31," +
               U_100 + "\n";
    };
    const AuditReport sound = report_on(table("360"));
    ASSERT_EQ(sound.results.size(), 3U);
    for (const char* const rule : {"K01", "K02", "K03", "S01"}) {
        EXPECT_FALSE(finds(sound, rule)) << rule;
    }
    EXPECT_EQ(sound.results[0].name, "b.csv, 1 V");
    EXPECT_EQ(sound.results[2].name, "b.csv, 100 V");
    EXPECT_NEAR(sound.results[2].audited.u_c, std::sqrt(150.0 * 150 + 90 * 90 + 29 * 29 + 25 * 25 + 30 * 30), 0.5);
    const AuditReport planted = report_on(table("260"));
    EXPECT_TRUE(finds(planted, "K01")) << "in the last column";
    EXPECT_NEAR(planted.results.at(2).audited.U, 2.0 * 181.5, 2.0);
    // Columns without points: one is audited, and it is said which are not.
    const AuditReport constant_and_length = report_on(
        "Component,Divisor,u (constant) in nm,u (growing) in nm/mm\nReference,2,10,0.1\nDrift,1.732,5,0.05\n"
        "Repeatability,1,6,\nu_c,,12.7,0.112\n");
    EXPECT_TRUE(tells(constant_and_length, "is NOT audited"));
}

TEST(LayoutsOfTables, RowsMayStandInColumns) {
    const auto table = [](const std::string& corner, const std::string& drift) {
        return "Calibration of a length bar\n\n" + corner +
               ",Reference standard,Drift of the reference,Resolution of the item,Repeatability,Temperature,"
               "Reproducibility\nValue ±,0.010,0.006,0.005,0.004,0.003,0.002\nUnit,mm,mm,mm,mm,mm,mm\n"
               "Distribution,normal,rectangular,rectangular,normal,rectangular,rectangular\n"
               "Divisor,2,1.732,1.732,1,1.732,1.732\nSensitivity coefficient,1,1,1,1,1,1\n"
               "Standard uncertainty,0.0050," +
               drift +
               ",0.0029,0.0040,0.0017,0.0012\nDegrees of freedom,∞,∞,∞,9,∞,∞\nu_c,0.0081,mm\nk,2\nU,0.016,mm\n"
               "coverage probability,95 %\n";
    };
    for (const char* const corner : {"Component", "Quantity", ""}) {
        const AuditReport sound = report_on(table(corner, "0.0035"));
        ASSERT_EQ(sound.results.size(), 1U) << corner;
        EXPECT_EQ(sound.subject.budgets[0].rows.size(), 6U);
        EXPECT_EQ(accused_of(sound), "") << corner;
        EXPECT_NEAR(sound.results[0].audited.u_c, 0.00812, 2e-5);
        EXPECT_EQ(sound.subject.budgets[0].rows[1].place, "b!C3") << "a cell of the file";
        EXPECT_TRUE(finds(report_on(table(corner, "0.0060")), "U26")) << corner << ": u is not 0.006/1.732";
    }
    // Results further to the right, and a table of results, which is none.
    const AuditReport beside = report_on(
        "Quantity,Reference,Drift of the reference,Resolution,Repeatability,,u_c,k,U\nUnit,mm,mm,mm,mm,,mm,,mm\n"
        "u,0.010,0.006,0.0029,0.003,,0.0124,2,0.025\n");
    ASSERT_EQ(beside.results.size(), 1U);
    EXPECT_NEAR(beside.results[0].audited.u_c, 0.01238, 1e-4);
    EXPECT_TRUE(
        report_on("Quantity,10 V,100 V\nValue,10.001,100.02\nUnit,V,V\nu,0.001,0.01\nU,0.002,0.02\n").results.empty());
    EXPECT_TRUE(
        report_on("Quantity,gauge 1,gauge 2,gauge 3\nValue,1,2,3\nUnit,V,V,V\nU,0.1,0.1,0.1\n").results.empty());
}

TEST(LayoutsOfTables, WhatIsNotUnderstoodOfHeadsIsNamed) {
    const AuditReport points = report_on("Source of uncertainty,1 V,10 V\nCalibrator,1.5,12\nDrift,0.9,8\n");
    EXPECT_TRUE(points.results.empty());
    const AuditReport relative = report_on(
        "Component,Type,Relative standard uncertainty (%)\nDetector,B,0.18\nDrift of detector,B,0.15\n"
        "Repeatability,A,0.08\nCombined standard uncertainty,,0.25\nExpanded uncertainty (k=2),,0.50\n");
    ASSERT_EQ(relative.results.size(), 1U);
    EXPECT_EQ(relative.results[0].unit, "%");
    EXPECT_TRUE(tells(report_on("Quantity,Unit,Standard thing\na,mm,0.1\n"), "not known are \"Standard thing\""));
    EXPECT_EQ(report_on("Where it comes from,Value ±,Distribution,Divisor,u\nReference,0.2,normal,2,0.1\n"
                        "Drift,0.2,rectangular,1.732,0.115\nu_c,0.15\n")
                  .results.size(),
              1U)
        << "the first column is that of the quantities";
    EXPECT_TRUE(report_on("Point,Value,Unit,U\n1,10.1,V,0.2\n2,20.1,V,0.2\n").results.empty())
        << "results are no budget";
}

/// Rows in groups with a sum each: what a row is called stands beside its group, which stands once, or again.
TEST(LayoutsOfTables, GroupsHaveTheirSumsBesideThem) {
    for (const char* const heads : {"Group,Source", "Category,Uncertainty source", "Quantity,Source",
                                    "Component,Influence", "Symbol,Description"}) {
        for (const char* const again : {"Reference", ""}) {
            const auto table = [&](const std::string& u_c, const std::string& U) {
                return std::string(heads) + ",Value (%),Divisor,u (%)\nReference,Certificate,0.10,2,0.0500\n" + again +
                       ",Drift,0.06,1.732,0.0346\n,Subtotal reference,,,0.0608\nItem,Resolution,0.02,1.732,0.0115\n" +
                       (*again == '\0' ? "" : "Item") + ",Repeatability,0.03,1,0.0300\n,Subtotal item,,,0.0321\n" +
                       ",Total (k=1),,," + u_c + "\n,Expanded (k=2),,," + U + "\n";
            };
            const AuditReport sound = report_on(table("0.0688", "0.14"));
            ASSERT_EQ(sound.subject.budgets.size(), 1U) << heads << "; " << again;
            EXPECT_FALSE(finds(sound, "K01")) << heads << "; " << again << accused_of(sound);
            EXPECT_NEAR(sound.results.at(0).recomputed.u_c, 0.0688, 5e-5) << heads << "; " << again;
            const AuditReport wrong = report_on(table("0.0788", "0.16"));
            EXPECT_TRUE(finds(wrong, "K01")) << heads << "; " << again;
            EXPECT_NEAR(wrong.results.at(0).recomputed.u_c, 0.0688, 5e-5) << heads << "; " << again;
        }
    }
}

/// A product in chemistry: u(x) of its factors in their units, u(x)/x beside it, and the result made up of the latter (EURACHEM/CITAC
/// CG 4, A1). As long as that column is not read, no u_c is made of what cannot be added.
TEST(LayoutsOfTables, RelativeUncertaintiesBesideUAreAskedAbout) {
    const auto table = [](const std::string& head, const std::string& mass, const std::string& volume) {
        return "Description,Value,u," + head + "\nPurity P,0.9999,0.000058,0.000058\nMass m," + mass + "," + volume +
               "\nVolume V,100.0,0.07,0.0007\nCombined,,,0.00086\nU (k = 2),,,0.0018\n";
    };
    for (const char* const head :
         {"u(x)/x", "RSU", "u_rel", "Relative standard uncertainty", "rel. u", "w", "relative Standardunsicherheit"}) {
        ASSERT_TRUE(is_of_relative_uncertainty(head)) << head;
        const AuditReport report = report_on(table(head, "100.28", "0.05,0.0005"));
        EXPECT_TRUE(report.results.empty()) << head << accused_of(report);
        EXPECT_TRUE(tells(report, "has relative uncertainties and is not read")) << head;
        EXPECT_TRUE(report_on(table(head, "100.28 mg", "0.05 mg,0.0005")).results.empty()) << head;
    }
    for (const char* const head : {"u", "u(x)", "Standard uncertainty", "relative humidity", "Relative to", "Value",
                                   "Relative contribution to uncertainty / %", "relativer Unsicherheitsbeitrag"}) {
        EXPECT_FALSE(is_of_relative_uncertainty(head)) << head;
    }
    // Beside u in one unit it is for the reader.
    const std::string same =
        "Quantity,Value / V,u / V,u_rel (%)\nStandard,10.0,0.0030,0.030\nDrift,10.0,0.0040,0.040\nu_c,,0.0050,\n"
        "U (k = 2),,0.010,\n";
    EXPECT_EQ(report_on(same).results.size(), 1U);
}

TEST(LayoutsOfTables, SeveralStandardsAreAddedUp) {
    const auto rows = [](const std::string& comment) {
        return report_on(
            "quantity,unit,U or a,divisor,distribution,u,sensitivity,contribution,nu,comment\nReference "
            "weights 50 g + 50 g,mg,0.10,2,normal,0.05,1,0.05,,\"" +
            comment +
            "\"\nDrift of the weights,mg,0.06,1.732,rectangular,0.0346,1,0.0346,,\nRepeatability,mg,0.04,1,"
            "normal,0.04,1,0.04,9,\nReproducibility,mg,0.02,1.732,rectangular,0.0115,1,0.0115,,\nu_c,mg,"
            "0.0737\nk,,2\nU,mg,0.15\ncoverage probability,,95 %\n");
    };
    for (const char* const words : {"two weights, U = 0.05 mg each, k = 2, added linearly; certificate M-1",
                                    "zwei Gewichte, je U = 0.05 mg, k = 2; Kalibrierschein M-1"}) {
        EXPECT_FALSE(finds(rows(words), "U13")) << words;
    }
    EXPECT_TRUE(finds(rows("U = 0.05 mg, k = 2; certificate M-1"), "U13")) << "twice the U of the certificate";
}

TEST(LayoutsOfTables, AMaterialMeasureHasNoResolution) {
    const auto titled = [](const std::string& title) {
        return report_on(
            title +
            "\nquantity,unit,U or a,divisor,distribution,u\nReference standard,mg,0.10,2,normal,0.05\nDrift "
            "of the reference standard,mg,0.06,1.732,rectangular,0.0346\nRepeatability,mg,0.04,1,normal,"
            "0.04\nTemperature,mg,0.01,1.732,rectangular,0.0058\nReproducibility,mg,0.02,1.732,rectangular,"
            "0.0115\nu_c,mg,0.0737\nk,,2\nU,mg,0.15\n");
    };
    for (const char* const title : {"Calibration of a weight of 100 g", "Einstellring 20 mm", "Standard resistor 100 Ω",
                                    "Parallelendmaß 10 mm", "Kalibrierung eines Gewichtsstücks"}) {
        EXPECT_FALSE(finds(titled(title), "B01")) << title;
    }
    for (const char* const title : {"Calibration of a voltmeter", "Balance of 200 g with weights",
                                    "Messschieber 150 mm", "Micrometer with gauge blocks", "Budget"}) {
        EXPECT_TRUE(finds(titled(title), "B01")) << title;
    }
}

TEST(LayoutsOfTables, KIsHeldAgainstTheProbabilityBesideIt) {
    const auto with_k = [](const std::string& k, const std::string& p, double large, const std::string& shape) {
        const double divisor = shape == "rectangular" ? std::sqrt(3.0) : 2.0;
        const double u = large / divisor, u_c = std::sqrt(u * u + 0.01 * 0.01 + 0.012 * 0.012);
        return report_on(
            "quantity,unit,U or a,divisor,distribution,u\nReference standard,V," + text::shortest(large) + "," +
            text::significant(divisor, 5) + "," + shape + "," + text::significant(u, 4) +
            "\nDrift of the reference standard,V,0.01732,1.7321,rectangular,0.01\nReproducibility,V,0.012,1,"
            "normal,0.012\nu_c,V," +
            text::significant(u_c, 4) + "\nk,," + k + "\nU,V," + text::significant(std::stod(k) * u_c, 4) +
            "\ncoverage probability,," + p + "\n");
    };
    // k of one end of the interval in place of both.
    for (const auto& [k, p] : std::vector<std::pair<std::string, std::string>>{
             {"1.645", "95 %"}, {"1.69", "95.45 %"}, {"1.72", "95 %"}, {"1.80", "95 %"}, {"2.33", "99 %"}}) {
        const AuditReport report = with_k(k, p, 0.04, "normal");
        EXPECT_TRUE(finds(report, "K03")) << k << " " << p;
        const AuditedResult& result = report.results.at(0);
        EXPECT_GT(result.audited.k, 1.95) << "t_p of the rows";
        EXPECT_NEAR(result.audited.U, result.audited.k * result.audited.u_c, 1e-9);
    }
    EXPECT_EQ(accused_of(with_k("1.645", "95 %", 0.04, "normal")).substr(0, 3), "K03");
    for (const auto& [k, p] : std::vector<std::pair<std::string, std::string>>{
             {"1.96", "95 %"}, {"2", "95 %"}, {"2", "95.45 %"}, {"2.58", "99 %"}, {"1.645", "90 %"}, {"1", "68 %"}}) {
        EXPECT_FALSE(finds(with_k(k, p, 0.04, "normal"), "K03")) << k << " " << p;
    }
    // A rectangular row that dominates (EA-4/02, S9), and two that make a trapezium.
    EXPECT_FALSE(finds(with_k("1.65", "95 %", 0.15, "rectangular"), "K03"));
    EXPECT_FALSE(finds(with_k("1.83", "95 %", 0.05, "rectangular"), "K03"));
}

TEST(LayoutsOfTables, ALineThatSlippedIsAskedAbout) {
    // A separator within a name: each cell of the line stands under the next head.
    const AuditReport report = report_on(
        "Größe;Einheit;Halbweite;Divisor;Verteilung;u;c;Beitrag\nNormal (U = 0,4 µm; k = "
        "2);µm;0,4;2;Normal;0,20;1;0,20\n"
        "Drift des Normals;µm;0,2;1,732;Rechteck;0,115;1;0,115\nWiederholbarkeit;µm;0,15;1;Normal;0,15;1;0,15\n"
        "u_c;;;;;;;0,28\nk;2\nU;;;;;;;0,55\n");
    for (const AuditFinding& finding : report.findings) {
        EXPECT_NE(finding.severity, FindingSeverity::critical) << finding.rule << finding.what.english();
    }
    EXPECT_TRUE(tells(report, "is no number"));
}

/// A budget of a voltmeter in one of several layouts: what stands before its rows, the names of two distributions, and how its result is
/// stated.
struct Layout {
    std::string heads, rectangular, normal, u_c, U;
};
const std::vector<Layout> k_layouts = {
    // Two lines of heads, the second one with symbols and a unit (VDI/VDE/DGQ 2618).
    {"Nr.,Einflussgröße,Verteilung,Grenzwert,Teiler,Standardunsicherheit,Empfindlichkeitskoeffizient,Beitrag\n"
     ",,,a_i,,u(x_i),c_i,u_i in mV\n",
     "Rechteck", "Normal", ",kombinierte Standardunsicherheit u_c,,,,,,",
     ",erweiterte Messunsicherheit U = 2 · u_c,,,,,,"},
    {"No.,Magnitud,Distribución,Semiancho a (mV),Divisor,Incertidumbre típica u(x_i) (mV),Coeficiente de sensibilidad "
     "c_i,"
     "Contribución a la incertidumbre u_i(y) (mV)\n",
     "rectangular", "normal", ",Incertidumbre típica combinada,,,,,,", ",Incertidumbre expandida (k = 2),,,,,,"},
    {"No.,Grandeur d’entrée,Loi de distribution,Demi-étendue a (mV),Diviseur,Incertitude-type u(x_i) (mV),"
     "Coefficient de sensibilité c_i,Contribution à l’incertitude u_i(y) (mV)\n",
     "rectangulaire", "normale", ",Incertitude-type composée,,,,,,", ",Incertitude élargie (k = 2),,,,,,"},
    {"項次,不確定度來源,機率分布,半寬 a (mV),除數,標準不確定度 u(x_i) (mV),靈敏係數 c_i,不確定度貢獻 u_i(y) (mV)\n",
     "矩形", "常態", ",組合標準不確定度,,,,,,", ",擴充不確定度 (k = 2),,,,,,"},
    {"序号,不确定度来源,概率分布,半宽度 (mV),除数,标准不确定度 (mV),灵敏系数,不确定度贡献 (mV)\n", "均匀", "正态",
     ",合成标准不确定度,,,,,,", ",扩展不确定度 (k = 2),,,,,,"},
};
/// \param divisor      of the second row, which is rectangular
/// \param is_left_out  whether u_c and U are made without that row
std::string in_layout(const Layout& layout, double divisor, bool is_left_out) {
    const double second = 11.0 / divisor, u_c = std::hypot(5.0, is_left_out ? 0.0 : second, 3.0);
    const auto row = [](const std::string& name, const std::string& shape, double a, double by) {
        const std::string u = text::significant(a / by, 4);
        return name + "," + shape + "," + text::shortest(a) + "," + text::significant(by, 4) + "," + u + ",1," + u +
               "\n";
    };
    return layout.heads + row("1,V_s", layout.normal, 10.0, 2.0) + row("2,δV_D", layout.rectangular, 11.0, divisor) +
           row("3,δV_X", layout.normal, 3.0, 1.0) + layout.u_c + text::significant(u_c, 4) + "\n" + layout.U +
           text::significant(2.0 * u_c, 3) + "\n";
}

TEST(LayoutsOfTables, WithHeadsOfOtherLanguagesAndOfTwoLines) {
    const double root_3 = std::sqrt(3.0);
    for (const Layout& layout : k_layouts) {
        const AuditReport sound = report_on(in_layout(layout, root_3, false));
        ASSERT_EQ(sound.results.size(), 1U) << layout.heads;
        EXPECT_EQ(accused_of(sound), "") << layout.heads;
        EXPECT_TRUE(sound.subject.not_read.empty()) << layout.heads;
        EXPECT_NEAR(sound.results[0].claimed.U, 2.0 * std::hypot(5.0, 11.0 / root_3, 3.0), 0.06) << layout.heads;
        EXPECT_EQ(sound.results[0].unit, "mV") << layout.heads;
        EXPECT_EQ(sound.subject.budgets.at(0).rows.at(1).quantity, "δV_D") << layout.heads;
        const AuditReport left_out = report_on(in_layout(layout, root_3, true));
        EXPECT_TRUE(finds(left_out, "K01")) << layout.heads;
        const AuditReport undivided = report_on(in_layout(layout, 1.0, false));
        EXPECT_TRUE(finds(undivided, "W02")) << layout.heads;
        EXPECT_NEAR(undivided.results.at(0).audited.U, 2.0 * std::hypot(5.0, 11.0 / root_3, 3.0), 0.06) << layout.heads;
    }
}

/// Words of rows are read in English and German: what rows of another language do not say in these, they are not accused of.
TEST(LayoutsOfTables, WhatWordsOfOtherLanguagesDoNotSayIsNotChecked) {
    const auto with = [](const std::string& heads, const std::vector<std::string>& names) {
        std::string table = heads + "\n";
        for (const std::string& name : names) {
            table += name + ";mV;0.10;2;0.05\n";
        }
        return report_on(table + "u_c;;;;" + text::significant(0.05 * std::sqrt(names.size()), 4) + "\n");
    };
    for (const auto& [heads, names] : std::vector<std::pair<std::string, std::vector<std::string>>>{
             {"Magnitud;Unidad;Semiancho;Divisor;Incertidumbre típica",
              {"Patrón de referencia", "División de escala", "Operador", "Condiciones ambientales"}},
             {"Grandeur;Unité;Incertitude;Diviseur;Incertitude-type",
              {"Étalon de référence", "Fidélité", "Opérateur", "Conditions d'environnement"}},
             {"不確定度來源;單位;半寬;除數;標準不確定度", {"标准器", "分辨力", "人员", "环境温度"}}}) {
        const AuditReport report = with(heads, names);
        ASSERT_EQ(report.results.size(), 1U) << heads;
        for (const char* const rule : {"B01", "B02", "B04", "B05"}) {
            EXPECT_FALSE(finds(report, rule)) << rule << heads;
        }
        EXPECT_TRUE(std::any_of(report.not_checked.begin(), report.not_checked.end(), [](const RuleNotChecked& rule) {
            return rule.rule == "B01";
        })) << heads;
    }
    const AuditReport english =
        with("Quantity;Unit;Half-width;Divisor;Standard uncertainty", {"Reference standard", "Scale", "Loading"});
    EXPECT_TRUE(finds(english, "B01"));
    EXPECT_TRUE(finds(english, "B05"));
}

/// U as a product of numbers: k is the one that is no u.
TEST(LayoutsOfTables, KOfAProductIsNoU) {
    const auto with = [](const std::string& line) {
        return report_on(
            "Quantity;Unit;U or a;Distribution;Divisor;c_i;Contribution\nStandard;mV;0.10;normal;2;1;0.05\n"
            "Resolution;mV;0.05;rectangular;1.732;1;0.02887\nRepeatability;mV;0.03;normal;1;1;0.03\n"
            "u_c;mV;;;;;0.0651\n" +
            line + ";;;;;;\n");
    };
    for (const char* const line : {"U = k·u_c = 0.0651·2 = 0.13 mV", "U = k × u_c = 0.0651 × 2.00 = 0.13 mV",
                                   "U = k·u_c = 2·0.0651 mV = 0.13 mV", "U = k·u_c = 2·0.0651 = 0.13 mV",
                                   "U = k · u(y) = 2 × (0.05² + 0.0289² + 0.03²)^(1/2) = 0.13 mV"}) {
        const AuditReport report = with(line);
        ASSERT_EQ(report.results.size(), 1U) << line;
        EXPECT_EQ(report.results[0].claimed.k, 2.0) << line;
        EXPECT_FALSE(finds(report, "K03")) << line;
        EXPECT_FALSE(finds(report, "K01")) << line;
    }
    EXPECT_TRUE(finds(with("U = k·u_c = 2·0.0651 mV = 0.26 mV"), "K01"));
}

/// Where either number of a product may be k, the one is that beside which u_c of the rows stands, whether a line states u_c or not.
TEST(LayoutsOfTables, KOfAProductIsTheOneBesideUcOfTheRows) {
    const auto with = [](double scale, const std::string& product, const std::string& u_c) {
        std::string rows = "Quantity;Unit;Standard uncertainty;c_i;Contribution\n";
        for (const auto& [name, u] :
             std::vector<std::pair<std::string, double>>{{"Reference", 1.4}, {"Drift", 1.2}, {"Recovery", 0.76}}) {
            const std::string number = std::to_string(scale * u).substr(0, 6);
            rows += name + ";mg/kg;" + number + ";1;" + number + "\n";
        }
        return report_on(rows + (u_c.empty() ? "" : "u_c;mg/kg;;;" + u_c + "\n") + "U = k·u_c = " + product + ";;;;\n");
    };
    struct Case {
        double scale;  // u_c of the rows is 1.994 times that
        const char *product, *u_c;
        double k;
    };
    for (const Case& one :
         {Case{1.0, "2.65·2.0 = 5.3 mg/kg", "2.0", 2.65}, Case{1.0, "2.0·2.65 = 5.3 mg/kg", "2.0", 2.65},
          Case{1.329, "2.65·2 = 5.3 mg/kg", "2.65", 2.0}, Case{1.329, "2·2.65 = 5.3 mg/kg", "2.65", 2.0},
          Case{1.0, "2.31·1.99 = 4.6 mg/kg", "1.99", 2.31}, Case{1.0, "1.99·2.31 = 4.6 mg/kg", "1.99", 2.31}}) {
        for (const std::string& u_c : {std::string(one.u_c), std::string()}) {
            const AuditReport report = with(one.scale, one.product, u_c);
            ASSERT_EQ(report.results.size(), 1U) << one.product;
            EXPECT_EQ(report.results[0].claimed.k, one.k) << one.product << " " << u_c;
            EXPECT_FALSE(finds(report, "K01")) << one.product << " " << u_c;
        }
        EXPECT_TRUE(finds(with(1.2 * one.scale, one.product, one.u_c), "K01")) << one.product;
    }
}

/// "U = u_c·k": the factor stands behind u, whose number may have its unit.
TEST(LayoutsOfTables, KOfAProductMayStandBehindU) {
    const auto with = [](const std::string& line) {
        return report_on("Quantity;Unit;Standard uncertainty\nReference;mg;1.30\nDrift;mg;0.90\nRounding;mg;0.40\n" +
                         line + ";;\n");  // u_c = 1.631 mg
    };
    struct Case {
        const char* line;
        double k;
    };
    for (const Case& one :
         {Case{"U = u_c·k = 1.63 · 3 = 4.89 mg", 3.0}, Case{"U = u_c · k = 1.63 mg · 2 = 3.26 mg", 2.0},
          Case{"U = u(y) × 2.05 = 3.34 mg", 2.05}, Case{"U = uc*k = 1.63*1.96 = 3.20 mg", 1.96},
          Case{"U = u_c·k = 1.65 · 1.63 = 2.69 mg", 1.65}}) {
        const AuditReport report = with(one.line);
        ASSERT_EQ(report.results.size(), 1U) << one.line;
        EXPECT_EQ(report.results[0].claimed.k, one.k) << one.line;
        EXPECT_FALSE(finds(report, "K01")) << one.line;
    }
    EXPECT_TRUE(finds(with("U = u_c·k = 1.63 mg · 2 = 4.89 mg"), "K01"));
    EXPECT_TRUE(finds(with("U = u_c·k = 1.36 · 2 = 2.72 mg"), "K01"));
}

TEST(LayoutsOfTables, OfPublishedTables) {
    // JCGM 100:2008, table H.1: symbols and what they stand for in the heads.
    const std::string of_gum =
        "Standard uncertainty component u(x_i),Source of uncertainty,Value of standard uncertainty u(x_i),c_i ≡ "
        "∂f/∂x_i,"
        "u_i ≡ |c_i| u(x_i) (nm),Degrees of freedom\n"
        "u(l_s),Calibration of standard end gauge,25 nm,1,25,18\nu(d),Measured difference,9.7 nm,1,9.7,25.6\n"
        "u(δθ),Difference in temperatures,0.029 °C,575,16.7,2\n";
    const AuditReport gum = report_on(of_gum + "u_c = 31.6 nm\n");
    ASSERT_EQ(gum.results.size(), 1U);
    EXPECT_FALSE(finds(gum, "K01"));
    EXPECT_NEAR(gum.results[0].recomputed.u_c, std::hypot(25.0, 9.7, 16.7), 0.05);
    EXPECT_TRUE(finds(report_on(of_gum + "u_c = 26.8 nm\n"), "K01"));
    // EA-4/02 writes what k is in the product.
    for (const char* const words :
         {"Expanded uncertainty U = k · u(y) = 1.65 × 31.6 nm", "U = k·u(l_X) = 1.65·31.6 nm"}) {
        const AuditReport ea = report_on(
            "Quantity X_i,Estimate x_i,Standard uncertainty u(x_i),Probability distribution,Sensitivity coefficient "
            "c_i,"
            "Uncertainty contribution u_i(y)\nl_S,50.000 mm,25 nm,normal,1.0,25 nm\nδl,0 nm,9.7 nm,normal,1.0,9.7 nm\n"
            "δt,0 °C,0.029 °C,rectangular,575 nm/°C,16.7 nm\nl_X,50.000 mm,,,,31.6 nm\n\n" +
            std::string(words) + ",52.1 nm\n");
        ASSERT_EQ(ea.results.size(), 1U) << words;
        EXPECT_NEAR(ea.results[0].claimed.k, 1.65, 1e-12) << words;
        EXPECT_FALSE(finds(ea, "K01")) << words;
    }
    for (const char* const again : {"", ",53 nm"}) {
        const AuditReport one_cell = report_on(
            "Quantity X_i,Standard uncertainty u(x_i),Sensitivity coefficient c_i,Uncertainty contribution u_i(y)\n"
            "l_S,25 nm,1.0,25 nm\nδl,9.7 nm,1.0,9.7 nm\nl_X,,,26.8 nm\n\nU = k·u(l_X) = 2·26.8 nm ≅ 53 nm" +
            std::string(again) + "\n");
        ASSERT_EQ(one_cell.results.size(), 1U) << again;
        EXPECT_EQ(one_cell.results[0].claimed.U, 53.0) << again;
        EXPECT_EQ(one_cell.results[0].claimed.k, 2.0) << again;
    }
    // ISO 14253-2: the component has a name in one column, and a number in another.
    const std::string puma =
        "Component name,Evaluation type,Distribution type,Variation limit a [µm],Distribution factor b,"
        "Uncertainty component u_xx [µm]\nMicrometer,B,Rectangular,3.0,0.6,1.8\nTemperature,B,U,1.5,0.7,1.05\n"
        "Repeatability,A,Gaussian,,,1.2\nCombined standard uncertainty u_c,,,,,";
    const AuditReport iso = report_on(puma + "2.41\nExpanded uncertainty U (k = 2),,,,,4.8\n");
    ASSERT_EQ(iso.results.size(), 1U);
    EXPECT_FALSE(finds(iso, "K01"));
    const AuditReport two_lines = report_on(
        "Component,Evaluation,Distribution,Variation limit,Variation limit,Distribution factor,Uncertainty "
        "component\n"
        "name,type,type,a* [influence units],a [µm],b,u_xx [µm]\nMicrometer,B,Rectangular,,6.0,0.6,3.6\n"
        "Temperature,B,U,2 °C,2.8,0.7,1.96\nRepeatability,A,,,,,1.2\nCombined standard uncertainty "
        "u_c,,,,,,4.27\n");
    ASSERT_EQ(two_lines.results.size(), 1U);
    EXPECT_EQ(two_lines.results[0].claimed.u_c, 4.27);
    EXPECT_FALSE(finds(two_lines, "K01"));
    EXPECT_TRUE(finds(report_on(puma + "1.59\nExpanded uncertainty U (k = 2),,,,,3.2\n"), "K01"));
}

TEST(LayoutsOfTables, TwiceTheDivisorOfAShapeIsThatOfAFullWidth) {
    const auto with = [](const char* distribution, const char* divisor) {
        return report_on(
            "Größe;Breite 2a;Einheit;Verteilung;Teiler;Standardunsicherheit;Beitrag / mV\nDrift;0,100;mV;" +
            std::string(distribution) + ";" + divisor +
            ";0,0204;0,0204\nNormal (k = 2);0,02;mV;Normal;2;0,010;0,010\n");
    };
    EXPECT_FALSE(finds(with("Dreieck", "4,899"), "W02"));
    EXPECT_FALSE(finds(with("Rechteck", "3,464"), "W02"));
    EXPECT_FALSE(finds(with("U-förmig", "2,828"), "W02"));
    EXPECT_TRUE(finds(with("Dreieck", "1,732"), "W02"));
}

}  // namespace
}  // namespace gumcert::audit
