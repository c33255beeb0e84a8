// Tables whose layout says more than words of heads: points in heads, results without a name, deviations, columns and
// correlations that nobody expects. What is not understood is named, and accuses nobody.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "audit/words/column_heads.h"
#include "audit/words/unit_words.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport audit_of(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "budget.csv", "budget"), "budget.csv"), all_rules());
}
const AuditFinding* finding_of(const AuditReport& report, std::string_view rule) {
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [rule](const AuditFinding& finding) { return finding.rule == rule; });
    return found == report.findings.end() ? nullptr : &*found;
}
bool is_named(const AuditReport& report, const std::string& text) {
    return std::any_of(
        report.subject.not_read.begin(), report.subject.not_read.end(),
        [&text](const Sentence& sentence) { return sentence.english().find(text) != std::string::npos; });
}

TEST(WhatTablesSay, APointInAHeadIsNoUnit) {
    for (const char* unit : {"V", "mV", "µm", "°C", "Pa", "kg", "m", "%", "N·m"}) {
        const std::string name = unit;
        EXPECT_EQ(unit_in_head("u / " + name), name);
        EXPECT_EQ(unit_in_head("u [" + name + "]"), name);
        EXPECT_EQ(unit_in_head("Beitrag in " + name), name);
        for (const char* number : {"1", "10", "100", "0.5", "0,5", "20.000"}) {
            for (const char* blank : {"", " "}) {
                const std::string point = std::string(number) + blank + name;
                EXPECT_EQ(unit_in_head("u (" + point + ")"), "") << point;
                EXPECT_EQ(unit_in_head("u [" + point + "]"), "") << point;
                EXPECT_EQ(unit_in_head("u / " + point), "") << point;
            }
        }
    }
    EXPECT_EQ(unit_in_head("c [1/K]"), "1/K");
    EXPECT_EQ(unit_in_head("Half-width / U"), "");
    const AuditReport report = audit_of(
        "Quantity,Unit,u (1 V),u (10 V)\nCalibrator,µV,3,20\nLeads,µV,1,1\nRepeatability,µV,1.5,6\nu_c,µV,3.5,21\n"
        "k,2,2\nU,µV,7.0,42\n");
    ASSERT_EQ(report.results.size(), 2U);  // of each point
    EXPECT_EQ(report.results[0].unit, "µV");
    EXPECT_NEAR(report.results[0].audited.U, 7.0, 1e-9);
    EXPECT_NEAR(report.results[1].audited.U, 41.8, 0.3);
    EXPECT_EQ(finding_of(report, "K01"), nullptr);
    EXPECT_FALSE(is_named(report, "u (10 V)"));
}

TEST(WhatTablesSay, AHeadAndAColumnOfUnitsThatContradictAreAsked) {
    const AuditReport report = audit_of("Quantity,Unit,u [µm],Sensitivity\nLength,µm,3,1\nTemperature,K,0.5,1\n");
    EXPECT_TRUE(is_named(report, "in which unit is the number?"));
    EXPECT_FALSE(is_named(audit_of("Quantity,Unit,u [µm],Sensitivity\nLength,mm,3,1\nForm,nm,0.5,1\n"),
                          "in which unit is the number?"));
}

TEST(WhatTablesSay, ALineOfUnitsBelowTheHeads) {
    const AuditReport report = audit_of(
        "Quantity,Estimate,Standard uncertainty,Sensitivity coefficient,Contribution\n,g,mg,,mg\n"
        "Reference weight,1000,2.5,1,2.5\nDrift of the reference,0,1.2,1,1.2\nAir "
        "buoyancy,0,0.9,1,0.9\nu_c,,,,2.9\nk,2\nU,,,,5.8\n");
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.results[0].unit, "mg");
    EXPECT_EQ(finding_of(report, "R05"), nullptr);
    EXPECT_FALSE(is_named(report, "is no number"));
}

/// A last row whose u is the u_c, or the U over k, that is stated is the result, whatever the rows above it give.
TEST(WhatTablesSay, AResultRowIsNoContribution) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> size(0.05, 0.4), off(0.7, 1.3);
    for (int i = 0; i < 60; ++i) {
        std::string table = "Quantity,Value,Unit,Standard uncertainty,Degrees of freedom\n";
        double squares = 0.0;
        for (const char* name : {"Weighing", "Water density and temperature", "Evaporation", "Resolution"}) {
            const std::string u = text::significant(size(random), 3);
            squares += std::stod(u) * std::stod(u);
            table += std::string(name) + ",0,µL," + u + ",\n";
        }
        const double factor = i % 2 == 0 ? 1.0 : off(random);
        const std::string u_c = text::significant(std::sqrt(squares) * factor, 4);
        table += "Volume V20,998.7,µL," + u_c + ",\n";
        table += i % 3 == 0 ? "u_c," + u_c + ",µL\n" : "";
        table += "k,2\nU," + text::significant(2.0 * std::stod(u_c), 4) + ",µL\n";
        SCOPED_TRACE(table);
        const AuditReport report = audit_of(table);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), 4U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, std::sqrt(squares), 1e-9);
        EXPECT_EQ(finding_of(report, "K01") != nullptr, std::abs(factor - 1.0) > 0.003 && std::abs(factor - 1.0) > 0.0);
        ASSERT_TRUE(report.subject.budgets[0].value);
        EXPECT_EQ(*report.subject.budgets[0].value, 998.7);
    }
}

constexpr const char* k_gauge =
    "Quantity,Estimate,Unit,u,Sensitivity,Contribution\nPressure standard,10.0000,bar,0.0030,1,0.0030\n"
    "Hysteresis,0,bar,0.0058,1,0.0058\nRepeatability,0,bar,0.0070,1,0.0070\n";
constexpr const char* k_limits =
    "k,2\nU,0.019,bar\nlower limit,-0.050,bar\nupper limit,0.050,bar\ndecision rule,DR-03\nverdict,pass\n";

TEST(WhatTablesSay, ADeviationBelowTheRowsIsTheValue) {
    for (const char* name :
         {"Deviation", "Error", "Error of indication", "Error of indication E", "Measurement error", "Correction",
          "Abweichung", "Anzeigeabweichung", "Messabweichung", "Korrektion", "Desviación", "Error de indicación",
          "Corrección", "偏差", "示值誤差", "示值误差", "器差", "修正值"}) {
        for (const bool directly : {true, false}) {
            const std::string line = std::string(name) + ",0.0600,bar\n", u_c = "u_c,0.0096,bar\n";
            const AuditReport report = audit_of(k_gauge + (directly ? line + u_c : u_c + line) + k_limits);
            SCOPED_TRACE(name);
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_EQ(report.results[0].audited.verdict, "fail");
            EXPECT_NE(finding_of(report, "D04"), nullptr);
        }
    }
}

TEST(WhatTablesSay, AConstantThatStandsLastIsUsedOrNamed) {
    for (const char* name : {"l_X", "Something", "Steilheit", "Difference of both"}) {
        const AuditReport report = audit_of(std::string(k_gauge) + name + ",0.0600,bar\nu_c,0.0096,bar\n" + k_limits);
        EXPECT_TRUE(is_named(report, name)) << name;
    }
    // Among the rows it is a constant, as every number without an uncertainty is.
    const AuditReport report = audit_of(
        "Quantity,Estimate,Unit,u,Sensitivity\nStandard,10,bar,0.003,1\nCorrection,0.02,bar,,\nLength,100,mm,,\n"
        "Hysteresis,0,bar,0.004,1\nvalue,0.03,bar\nu_c,0.005,bar\nk,2\nU,0.010,bar\n");
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.subject.budgets[0].rows.size(), 2U);
    EXPECT_EQ(report.subject.budgets[0].value.value_or(0.0), 0.03);
    EXPECT_FALSE(is_named(report, "Length"));
}

/// A unit, an explanation or a symbol behind the word of a head changes nothing of its meaning.
TEST(WhatTablesSay, AHeadKeepsItsMeaningBeforeUnitAndSymbol) {
    struct Head {
        const char* word;
        Column column;
        const char* symbol;
    };
    const Head heads[] = {{"Quantity", Column::quantity, "X_i"},
                          {"Größe", Column::quantity, "X_i"},
                          {"Estimate", Column::estimate, "x_i"},
                          {"Value", Column::estimate, "x"},
                          {"Half-width", Column::stated, "a"},
                          {"Halbweite", Column::stated, "a"},
                          {"Standard uncertainty", Column::u, "u(x)"},
                          {"Std. uncertainty", Column::u, "u(x_i)"},
                          {"Standardunsicherheit", Column::u, "u"},
                          {"Uncertainty", Column::u, "u(x)"},
                          {"Sensitivity", Column::sensitivity, "dT/dx"},
                          {"Sensitivity coefficient", Column::sensitivity, "c_i"},
                          {"Sens.", Column::sensitivity, "c_i"},
                          {"Sensitivity factor", Column::sensitivity, "∂f/∂x"},
                          {"Empfindlichkeitskoeffizient", Column::sensitivity, "c"},
                          {"Contribution", Column::contribution, "u_i(y)"},
                          {"Contrib.", Column::contribution, "c·u"},
                          {"Unsicherheitsbeitrag", Column::contribution, "u_i(y)"},
                          {"Degrees of freedom", Column::nu, "ν_i"}};
    for (const Head& head : heads) {
        const std::string word = head.word, symbol = std::string(" ") + head.symbol;
        const bool says_it_alone = word != "Uncertainty";
        for (const char* unit : {"", " / nm", " [µm]", " (mm)", " in µm"}) {
            if (says_it_alone) {
                EXPECT_EQ(column_of(word + unit), head.column) << word << unit;
            }
            EXPECT_EQ(column_of(word + symbol + unit), head.column) << word << symbol << unit;
        }
    }
    EXPECT_EQ(column_of("Half-width / U"), Column::stated);
    EXPECT_EQ(column_of("U/k"), Column::u);
    EXPECT_EQ(column_of("Half-width a or U"), Column::stated);
    EXPECT_EQ(column_of("Halbweite a oder U"), Column::stated);
    EXPECT_FALSE(column_of("Estimate or divisor"));
    EXPECT_TRUE(is_unused_column("Reading / N·m"));
    EXPECT_FALSE(column_of("Degrees of Doubt"));
    EXPECT_TRUE(is_unused_column("Anteil"));
    EXPECT_TRUE(is_unused_column("Contribution %"));
    EXPECT_FALSE(is_unused_column("Slope"));
}

TEST(WhatTablesSay, AColumnThatIsNotUnderstoodAccusesNobody) {
    for (const char* head : {"Slope", "dT per dV", "Umrechnung", "灵敏度"}) {
        const std::string table = std::string("Quantity,Estimate,Unit,u,") + head +
                                  ",Comment\nReference thermometer,100.002,°C,0.010,1,cert A\n"
                                  "Voltage V,1.3850,mV,0.00050,20 °C/mV,\nBath homogeneity,0,°C,0.005,1,\n"
                                  "u_c,0.015,°C\nk,2\nU,0.030,°C\n";
        const AuditReport report = audit_of(table);
        SCOPED_TRACE(head);
        EXPECT_TRUE(is_named(report, head));
        EXPECT_TRUE(is_named(report, "the table is not looked at"));
        EXPECT_TRUE(report.results.empty());
        // Rows in the unit of the result: what does not follow from them is told, and no grave error.
        const AuditReport one_unit =
            audit_of(std::string("Quantity,Estimate,Unit,u,") + head +
                     "\nThermometer,100.002,°C,0.010,1\nWell,0,°C,0.001,20\nBath,0,°C,0.005,1\n"
                     "u_c,0.0229,°C\nk,2\nU,0.046,°C\n");
        EXPECT_TRUE(is_named(one_unit, head));
        const AuditFinding* const sum = finding_of(one_unit, "K01");
        ASSERT_NE(sum, nullptr);
        EXPECT_LE(sum->severity, FindingSeverity::major);
        const auto tells = [head](const Sentence& said) { return said.english().find(head) != std::string::npos; };
        EXPECT_TRUE(std::any_of(sum->evidence.begin(), sum->evidence.end(), tells));
    }
    // The layout of EURACHEM: relative uncertainties bring the rows together, as the values do. Where these make up no product, nobody
    // knows how.
    const std::string rows =
        "Quantity,Value x,Unit,Standard uncertainty u(x),u(x)/x\nPurity P,0.9998,1,0.000058,0.000058\n"
        "Mass m,100.35,mg,0.06,0.00060\nVolume V,100.0,mL,0.08,0.00080\nResult c,";
    const AuditReport product = audit_of(rows + "1003.3,mg/L,1.0,0.0010\nU,2.0,mg/L\nk,2\n");
    ASSERT_EQ(product.results.size(), 1U);
    EXPECT_NEAR(product.results[0].recomputed.u_c, 1.0, 0.01);
    EXPECT_EQ(finding_of(product, "K01"), nullptr);
    const AuditReport relative = audit_of(rows + "903.3,mg/L,1.0,0.0010\nU,2.0,mg/L\nk,2\n");
    EXPECT_TRUE(relative.results.empty());
    EXPECT_TRUE(is_named(relative, "u(x)/x"));
    const AuditReport read = audit_of(
        "Quantity,Estimate,Unit,u,Sensitivity dT/dx,Comment\nReference thermometer,100.002,°C,0.010,1,cert A\n"
        "Voltage V,1.3850,mV,0.00050,20 °C/mV,\nBath homogeneity,0,°C,0.005,1,\nu_c,0.015,°C\nk,2\nU,0.030,°C\n");
    EXPECT_EQ(finding_of(read, "S01"), nullptr);
    EXPECT_EQ(finding_of(read, "K01"), nullptr);
    ASSERT_EQ(read.results.size(), 1U);
    EXPECT_NEAR(read.results[0].recomputed.u_c, 0.015, 1e-9);
}

TEST(WhatTablesSay, TwoColumnsAreATable) {
    const AuditReport report = audit_of("Quantity,u\nA,1\nB,2\nu_c,2.2\nk,2\nU,4.5\n");
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_NEAR(report.results[0].recomputed.u_c, std::sqrt(5.0), 1e-9);
    EXPECT_TRUE(audit_of("Name,Limit\nA,1\nB,2\n").results.empty());
}

/// The sum of two rows with the correlation that a line states, where its names are words of one row each.
TEST(WhatTablesSay, ACorrelationIsThatOfItsRows) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> size(0.5, 5.0), any(-1.0, 1.0);
    for (int i = 0; i < 40; ++i) {
        const std::string a = text::significant(size(random), 3), b = text::significant(size(random), 3),
                          r = i % 4 == 0 ? "1" : text::fixed(any(random), 2);
        const std::string c = i % 2 == 0 ? "-1" : "1";
        const double x = std::stod(a), y = std::stod(c) * std::stod(b), rest = 1.2;
        const double u_c = std::sqrt(x * x + y * y + 2.0 * std::stod(r) * x * y + rest * rest);
        const char* const names[] = {"Correlation r(T1; T2)", "Korrelation (T2, T1)", "r(T1, T2)"};
        const std::string table = "Quantity,Estimate,Unit,u,Sensitivity,Source\nReading T1 (reference),80.0,mK," + a +
                                  ",1,certificate T-55\nReading T2 (reference),79.0,mK," + b + "," + c +
                                  ",certificate T-55\nRepeatability,0,mK,1.2,1,\n\"" + names[i % 3] + "\"," + r +
                                  "\nvalue,1.0,mK\nu_c," + text::significant(u_c, 4) + ",mK\nk,2\nU," +
                                  text::significant(2.0 * u_c, 4) + ",mK\n";
        SCOPED_TRACE(table);
        const AuditReport report = audit_of(table);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, u_c, 1e-9);
        EXPECT_EQ(finding_of(report, "K01"), nullptr);
        EXPECT_EQ(finding_of(report, "S10"), nullptr);
    }
    const std::string rows =
        "Quantity,Estimate,Unit,u,Sensitivity,Source\nFirst reading,80.0,mK,20,1,certificate T-55\n"
        "Second reading,79.0,mK,20,-1,certificate T-55\nRepeatability,0,mK,9.0,1,\n";
    const std::string claims = "value,1.0,mK\nu_c,9.0,mK\nk,2\nU,18,mK\n";
    // Of which rows it is, nobody says: it is named, and what it explains is asked.
    const AuditReport open = audit_of(rows + "Correlation r(T1; T2),1\n" + claims);
    EXPECT_TRUE(is_named(open, "Correlation"));
    const AuditFinding* const asked = finding_of(open, "K01");
    ASSERT_NE(asked, nullptr);
    EXPECT_EQ(asked->severity, FindingSeverity::minor);
    ASSERT_EQ(open.results.size(), 1U);
    EXPECT_NEAR(open.results[0].audited.U, 18.0, 1e-9);
    // Without one, what r = 0 and 1 give is that of the rows, whatever is claimed.
    const AuditReport none = audit_of(rows + claims);
    const AuditFinding* const neglected = finding_of(none, "S10");
    ASSERT_NE(neglected, nullptr);
    ASSERT_EQ(neglected->evidence.size(), 3U);
    EXPECT_NE(neglected->evidence[0].english().find("29.68 mK"), std::string::npos) << neglected->evidence[0].english();
    EXPECT_NE(neglected->evidence[1].english().find("9 mK"), std::string::npos) << neglected->evidence[1].english();
    EXPECT_NE(neglected->evidence[2].english().find("41 mK"), std::string::npos) << neglected->evidence[2].english();
}

TEST(WhatTablesSay, BudgetsOfOneSheetHaveNamesOfTheirOwn) {
    for (const char* above : {"Load 100 g", ""}) {
        std::string sheet;
        for (int i = 0; i < 4; ++i) {
            sheet += std::string(above) +
                     "\nQuantity,u,Unit\nWeight,1.0,mg\nBalance,0.5,mg\nu_c,1.12,mg\nk,2\nU,2.2,mg\n\n\n";
        }
        const AuditReport report = audit_of(sheet);
        ASSERT_EQ(report.results.size(), 4U);
        std::set<std::string> names;
        for (const AuditedResult& result : report.results) {
            names.insert(result.name);
            EXPECT_NE(result.name.find(above), std::string::npos) << result.name;
        }
        EXPECT_EQ(names.size(), 4U);
    }
}

/// An equation stands behind its name, in a cell of its own or in that of the name.
TEST(WhatTablesSay, OfTheirModelInOneCellOrTwo) {
    const auto with = [](const std::string& line, const std::string& c, const std::string& part) {
        const AuditReport report = audit(
            subject_of(
                workbook::read_csv(line +
                                       "\nQuantity,Value,Unit,Standard uncertainty,Sensitivity coefficient,"
                                       "Contribution\nm,100.00,g,0.0030,0.02,0.00006\nV,50.00,mL,0.010," +
                                       c + "," + part + "\ny,2.0000,g/mL,,," + part + "\nU (k = 2),,g/mL,,,0.0" + "\n",
                                   "b.csv", "b"),
                "b.csv"),
            all_rules());
        return std::any_of(report.findings.begin(), report.findings.end(),
                           [](const AuditFinding& finding) { return finding.rule == "S02" || finding.rule == "S03"; });
    };
    for (const char* const line :
         {"Equation,y = m/V", "Model: y = m/V", "Model equation: y = m/V", "Measurement equation,y = m/V"}) {
        EXPECT_TRUE(with(line, "-0.4", "0.0040")) << line;
        EXPECT_FALSE(with(line, "-0.04", "0.0004")) << line;
    }
    EXPECT_FALSE(with("Model: XY 200", "-0.4", "0.0040")) << "of an instrument";
}

}  // namespace
}  // namespace gumcert::audit
