#include "audit/words/correlation_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

AuditReport audit_of_correlated(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
bool has_critical(const AuditReport& report) {
    return std::any_of(report.findings.begin(), report.findings.end(),
                       [](const AuditFinding& finding) { return finding.severity == FindingSeverity::critical; });
}

TEST(Correlations, AreReadWhereverTheirLineHasR) {
    const std::string
        heads = "Difference of two thermometers\nQuantity,symbol,unit,u,c,contribution\n",
        rows = "Thermometer 1,T1,mK,5,1,5\nThermometer 2,T2,mK,5,-1,-5\nRepeatability (s of 10),d,mK,2,1,2\n",
        claims = "Combined standard uncertainty,,mK,,,4.9\nExpanded uncertainty (k=2),,mK,,,9.8\n";
    for (const std::string line :
         {"Correlation r(T1; T2),,,0.6", "\"r(T1, T2)\",,,0.6", "\"r(T1, T2) = 0.6\"",
          "Correlation coefficient T1-T2,,,0.6", "Correlation T1/T2,,1,0.6",
          "\"Correlation r(T1, T2) = 0.6\",,mK,,,-5.5", "Korrelation r(T1; T2),,,0.6",
          "Correlation of T1 and T2 (r = 0.6)", "Correlation r(T1; T2),0.6", "Korrelation T1 und T2,,,,,0.6"}) {
        for (const std::string& table : {heads + rows + line + "\n" + claims, heads + rows + claims + line + "\n"}) {
            SCOPED_TRACE(table);
            const AuditReport report = audit_of_correlated(table);
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_EQ(report.subject.budgets[0].rows.size(), 3U);
            EXPECT_NEAR(report.results[0].recomputed.u_c, std::sqrt(24.0), 1e-9);
            EXPECT_FALSE(has_critical(report));
        }
    }
    // A covariance is a term that no row has; nobody knows whose.
    const std::string covariance = "Covariance term,,mK²,,,-30\n";
    EXPECT_TRUE(audit_of_correlated(heads + rows + covariance + claims).results.empty());
    EXPECT_TRUE(audit_of_correlated(heads + rows + claims + covariance).results.empty());
    const AuditReport both = audit_of_correlated(heads + rows + "Correlation r(T1; T2),0.6\n" + covariance + claims);
    ASSERT_EQ(both.results.size(), 1U);
    EXPECT_NEAR(both.results[0].recomputed.u_c, std::sqrt(24.0), 1e-9);
    // What has a coefficient is a row whatever its name.
    const AuditReport row =
        audit_of_correlated(heads + rows + "Correlation of the readings,,mK,0.6,1,0.6\nu_c,,mK,,,7.37\n");
    ASSERT_EQ(row.results.size(), 1U);
    EXPECT_EQ(row.subject.budgets[0].rows.size(), 4U);
}

/// A difference of two rows that correlate has as many degrees of freedom as both: k = 2 is no fixed k of few, whatever the formula
/// of independent rows would say; and a claim by either way is explained.
TEST(Correlations, LeaveTheDegreesOfFreedomOfOneContribution) {
    const std::string rows =
        "Quantity,Estimate,Unit,u,nu,Sensitivity,Contribution\nGauge A,0,um,0.02,50,1,0.02\nGauge "
        "B,0,um,0.02,50,-1,-0.02\n"
        "Indication,0,um,0.01,9,1,0.01\nResolution,0,um,0.003,inf,1,0.003\n\"r(A, B)\",0.9,,,,,\nu_c,,um,0.0137,,,\n";
    const auto rules_of = [&](const std::string& claims) {
        const AuditReport report = audit_of_correlated(rows + claims);
        std::string rules;
        for (const AuditFinding& finding : report.findings) {
            const bool is_looked_at =
                finding.rule == "K01" || finding.rule == "K02" || finding.rule == "K03" || finding.rule == "S12";
            rules += is_looked_at ? finding.rule : "";
        }
        return report.results.size() == 1U ? rules : "none";
    };
    EXPECT_EQ(rules_of("k,,,2,,,\nU,,um,0.027,,,\n"), "");
    EXPECT_EQ(rules_of("nu_eff,,,28,,,\nk,,,2.09,,,\nU,,um,0.029,,,\n"), "");
    EXPECT_EQ(rules_of("nu_eff,,,28.8,,,\nk,,,2.09,,,\nU,,um,0.029,,,\n"), "");
    EXPECT_EQ(rules_of("nu_eff,,,4.8,,,\nk,,,2.69,,,\nU,,um,0.037,,,\n"), "S12");
    // One source in two rows that add, whose four degrees of freedom the table states: k = 2 is a fixed k of few.
    const std::string sum =
        "Quantity,Estimate,Unit,u,nu,Sensitivity,Contribution\nGauge A,0,um,0.0200,4,1,0.0200\nGauge "
        "B,0,um,0.0200,4,1,0.0200\nIndication,0,um,0.0010,9,1,0.0010\n\"r(A, B)\",0.9,,,,,\nu_c,,um,0.0390,,,\n";
    const auto fixed_k = [&](const std::string& nu_eff) {
        const AuditReport report = audit_of_correlated(sum + nu_eff + "k,,,2,,,\nU,,um,0.078,,,\n");
        return std::any_of(report.findings.begin(), report.findings.end(),
                           [](const AuditFinding& finding) { return finding.rule == "K02"; });
    };
    EXPECT_TRUE(fixed_k("nu_eff,,,4,,,\n"));
    EXPECT_FALSE(fixed_k("nu_eff,,,28,,,\n"));
    EXPECT_FALSE(fixed_k(""));
}

TEST(Correlations, InANoteAreOfRowsOrOfAFit) {
    for (const char* const rows :
         {"Note: A and B were calibrated together, r = 0.9", "A und B gemeinsam kalibriert: r = 0.9",
          "Fit parameters a and b: r = -0.97", "A 與 B 一起校準 r = 0.9"}) {
        EXPECT_EQ(noted_correlation(rows), NotedCorrelation::of_rows) << rows;
    }
    for (const char* const fit : {"Drift line: r = 0.98 over 6 years", "Linear fit of drift: r = 0.95",
                                  "Note: the regression has r = 0.3", "Kalibrierkurve mit r = 0.999",
                                  "Ausgleichsgerade r = 0.99", "Regresión lineal, r = 0.99", "線性迴歸 r = 0.99"}) {
        EXPECT_EQ(noted_correlation(fit), NotedCorrelation::of_fit) << fit;
    }
    EXPECT_EQ(noted_correlation("Note: r = 0.9 of certificate 77-A, online"), NotedCorrelation::open);
}

/// The r of a regression is no correlation of two rows: it explains no u_c, and states none of one certificate.
TEST(Correlations, OfAFitExplainNothing) {
    const auto has = [](const AuditReport& report, const std::string& rule) {
        return std::any_of(report.findings.begin(), report.findings.end(),
                           [&](const AuditFinding& finding) { return finding.rule == rule; });
    };
    const std::string heads = "Quantity,Estimate,Unit,u,nu,Sensitivity,Contribution,Source\n",
                      claims = "u_c,,um,0.030\nk,,,2\nU,,um,0.060\n";
    const auto rows = [](const std::string& sign) {
        return "Standard gauge A,0,um,0.02,50,1,0.02,certificate 77-A\nStandard gauge B,0,um,0.02,50," + sign + "1," +
               sign + "0.02,certificate 77-A\nIndication,0,um,0.01,9,1,0.01,\n";
    };
    for (const char* const note : {"", "\"Drift line: r = 0.98 over 6 years\"\n", "\"Linear fit: r = 0.95\"\n",
                                   "\"Note: r = 0.9 of the year\"\n"}) {
        EXPECT_TRUE(has(audit_of_correlated(heads + rows("") + note + claims), "S10")) << note;
    }
    const std::string together = "\"A and B were calibrated together, r = 0.95\"\n";
    EXPECT_FALSE(has(audit_of_correlated(heads + rows("") + together + claims), "S10"));
    const std::string small = "u_c,,um,0.0118\nk,,,2\nU,,um,0.0237\n";
    EXPECT_TRUE(has_critical(audit_of_correlated(heads + rows("-") + "\"Linear fit of drift: r = 0.95\"\n" + small)));
    EXPECT_FALSE(has_critical(audit_of_correlated(heads + rows("-") + together + small)));
}

/// A sum of rows with r = 1 is the plain sum, and right (JCGM 100:2008, 5.2.2): K09 asks.
TEST(Correlations, MakeAPlainSum) {
    struct Case {
        std::string r, third, u_c, U;
    };
    for (const Case& one :
         {Case{"r = 1", "", "0.040", "0.080"}, Case{"r=0.75", "Indication,0,um,0.01,9,1,0.01\n", "0.0387", "0.077"},
          Case{"r = 1", "Indication,0,um,0.01,9,1,0.01\n", "0.0412", "0.082"}}) {
        const auto table = [&](const std::string& note) {
            return "Quantity,Estimate,Unit,u,nu,Sensitivity,Contribution\nStandard gauge A,0,um,0.02,50,1,0.02\n"
                   "Standard gauge B,0,um,0.02,50,1,0.02\n" +
                   one.third + note + "u_c,,um," + one.u_c + "\nk,,,2\nU,,um," + one.U + "\n";
        };
        const auto is_accused = [](const AuditReport& report) {
            return std::any_of(report.findings.begin(), report.findings.end(), [](const AuditFinding& finding) {
                return (finding.rule == "K01" || finding.rule == "K09") && finding.severity >= FindingSeverity::major;
            });
        };
        EXPECT_TRUE(is_accused(audit_of_correlated(table("")))) << one.u_c;
        const AuditReport noted =
            audit_of_correlated(table("\"Note: A and B were calibrated together, " + one.r + "\"\n"));
        EXPECT_FALSE(is_accused(noted)) << one.u_c;
        // A thousand notes are no work: each r is tried once, and eight at most.
        std::string many;
        for (int i = 0; i < 1000; ++i) {
            many += "\"Note " + std::to_string(i) + ": r = -0." + std::to_string(1000 + i) + "\"\n";
        }
        EXPECT_TRUE(is_accused(audit_of_correlated(table(many)))) << one.u_c;
    }
}

/// Three masses of one set, each of which correlates with each other one: no pair of rows explains the sum, all of them do.
TEST(Correlations, OfSeveralRowsThatWereCalibratedTogether) {
    struct Case {
        std::string r, u_c, U;
    };
    const auto table = [](const std::string& note, const Case& one) {
        return "Quantity,Estimate,Unit,u,nu,Sensitivity,Contribution\nMass 1,0,mg,0.020,50,1,0.020\n"
               "Mass 2,0,mg,0.020,50,1,0.020\nMass 3,0,mg,0.020,50,1,0.020\nBalance,0,mg,0.010,9,1,0.010\n" +
               note + "u_c,,mg," + one.u_c + "\nk,,,2\nU,,mg," + one.U + "\n";
    };
    const auto accused = [](const AuditReport& report) {
        return std::count_if(report.findings.begin(), report.findings.end(), [](const AuditFinding& finding) {
            return (finding.rule == "K01" || finding.rule == "K09") && finding.severity >= FindingSeverity::major;
        });
    };
    for (const Case& one : {Case{"0.9", "0.0591", "0.118"}, Case{"1", "0.0608", "0.122"},
                            Case{"0.5", "0.0500", "0.100"}, Case{"-0.3", "0.0241", "0.048"}}) {
        EXPECT_EQ(accused(audit_of_correlated(table("", one))), 1) << one.r;
        const std::string note = "\"Note: the masses were calibrated together, r = " + one.r + "\"\n";
        EXPECT_EQ(accused(audit_of_correlated(table(note, one))), 0) << one.r;
    }
    // Three quantities cannot all have −0.9 with each other; and a sum that no rows explain is accused all the same.
    EXPECT_EQ(accused(audit_of_correlated(
                  table("\"The masses were calibrated together, r = -0.9\"\n", {"", "0.005", "0.010"}))),
              1);
    EXPECT_EQ(accused(audit_of_correlated(
                  table("\"The masses were calibrated together, r = 0.9\"\n", {"", "0.0555", "0.111"}))),
              1);
}

/// A coefficient in a cell is read with its symbol; a term with the sign of a correlation is none of the rows.
TEST(Correlations, AreStatedByTheirSymbolInACell) {
    EXPECT_EQ(stated_correlation("r = 0.9"), 0.9);
    EXPECT_EQ(stated_correlation("ρ(A; B) = -0.25"), -0.25);
    EXPECT_FALSE(stated_correlation("r = 12"));
    EXPECT_FALSE(stated_correlation("error = 0.6"));
    // A radius, a density, a percentage and a fraction are none.
    for (const char* const other : {"r = 0.9 mm", "r = 0.9 mm (radius)", "ρ = 0.9982 g/cm3 at 20 °C", "r = 0.9 %",
                                    "r = 1/2", "r = 0.5 ± 0.1", "r = 0.9 in"}) {
        EXPECT_FALSE(stated_correlation(other)) << other;
    }
    for (const char* const same : {"r = 0.9 (estimated)", "r = 0.9, of both", "r = 0.9 in both cells",
                                   "r = 0.9 estimated", "r = 0.9 1", "r = 0.9 – from the certificate"}) {
        EXPECT_EQ(stated_correlation(same), 0.9) << same;
    }
    const std::string rows =
        "Quantity,Estimate,Unit,u,Sensitivity,Contribution\nGauge A,0,um,0.02,1,0.02\nGauge B,0,um,0.02,-1,-0.02\n"
        "Indication,0,um,0.01,1,0.01\n";
    const std::string claims = "u_c,,um,0.0134,,\nk,,,2,,\nU,,um,0.027,,\n";
    // With an estimate it is a row, whatever its name.
    EXPECT_EQ(audit_of_correlated(rows + "Correction of the correlation filter,0,um,,,-0.01\n" + claims).results.size(),
              1U);
    const AuditReport named = audit_of_correlated(rows + "\"Correlation r(A; B)\",r = 0.9,,,,\n" + claims);
    ASSERT_EQ(named.results.size(), 1U);
    EXPECT_NEAR(named.results[0].recomputed.u_c, std::sqrt(1.8e-4), 1e-9);
    EXPECT_FALSE(has_critical(named));
    EXPECT_FALSE(has_critical(audit_of_correlated(rows + "Correlation of A and B,r = 0.9,,,,\n" + claims)));
    EXPECT_FALSE(has_critical(audit_of_correlated(rows + "Correlation of both gauges,r = 0.9,,,,\n" + claims)));
    // What is no coefficient is not taken for one: u_c is asked of independent rows, as it is claimed here.
    for (const char* const cell : {"r = 0.9 %", "r = 1.2", "r = 0.9 mm"}) {
        const AuditReport plain = audit_of_correlated(rows + "\"Correlation r(A; B)\"," + cell +
                                                      ",,,,\nu_c,,um,0.03,,\nk,,,2,,\nU,,um,0.06,,\n");
        ASSERT_EQ(plain.results.size(), 1U) << cell;
        EXPECT_NEAR(plain.results[0].recomputed.u_c, 0.03, 1e-9) << cell;
    }
    for (const char* const term : {"Correlation,,um,,,-0.0268\n", "Correlation term,,um,,,-0.00072\n"}) {
        const AuditReport open = audit_of_correlated(rows + term + claims);
        EXPECT_TRUE(open.results.empty()) << term;
        EXPECT_FALSE(has_critical(open));
    }
}

TEST(Correlations, AreNoQuantitiesWithAnArgument) {
    const std::string heads = "Quantity,Value,u / %,Contribution / %\n",
                      claims = "Combined standard uncertainty,,,0.23\nExpanded uncertainty (k = 2),,,0.46\n";
    for (const auto& [one, other] : std::vector<std::pair<std::string, std::string>>{
             {"r(1)", "r(2)"}, {"ρ(20 °C)", "ρ(25 °C)"}, {"ρ(20 °C; 1 bar)", "r(2; 5)"}, {"r(x; y)", "r(x; z)"}}) {
        const AuditReport report = audit_of_correlated(heads + one + ",0.90,0.10,0.10\n" + other +
                                                       ",0.45,0.20,0.20\nh,10,0.05,0.05\n" + claims);
        SCOPED_TRACE(one);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), 3U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, std::sqrt(0.0525), 1e-9);
        EXPECT_FALSE(has_critical(report));
    }
    // Of two rows that are there, it is one.
    const AuditReport two =
        audit_of_correlated(heads + "d1,0.90,0.10,0.10\nd2,0.45,0.20,0.20\nh,10,0.05,0.05\n" + "r(d1; d2),,,0.5\n" +
                            "Combined standard uncertainty,,,0.27\nExpanded uncertainty (k = 2),,,0.54\n");
    ASSERT_EQ(two.results.size(), 1U);
    EXPECT_EQ(two.subject.budgets[0].rows.size(), 3U);
    EXPECT_NEAR(two.results[0].recomputed.u_c, std::sqrt(0.0725), 1e-9);
}

TEST(Correlations, AreNamedByWords) {
    EXPECT_FALSE(correlation_words("Temperature of the reference"));
    EXPECT_FALSE(correlation_words("r"));
    EXPECT_FALSE(correlation_words("Error r = 0.6 mm"));
    const std::optional<CorrelationWords> words = correlation_words("Correlation (t_S, t_X): r = -0.25");
    ASSERT_TRUE(words);
    EXPECT_TRUE(words->is_coefficient);
    EXPECT_EQ(words->r, -0.25);
    ASSERT_FALSE(words->pairs.empty());
    EXPECT_EQ(words->pairs.front(), std::pair(std::string("t_S"), std::string("t_X")));
    EXPECT_TRUE(correlation_words("Kovarianz u(a; b)")->is_covariance);
    EXPECT_FALSE(correlation_words("Correlation")->is_coefficient);
    for (const char* quantity : {"r(1)", "ρ(20 °C)", "ρ(20 °C; 1 bar)", "r(1, 2)", "r(", "r(;)", "r)(a; b)"}) {
        EXPECT_FALSE(correlation_words(quantity)) << quantity;
    }
    EXPECT_FALSE(correlation_words("r(T1; T2)")->is_coefficient);
    EXPECT_TRUE(correlation_words("ρ(T1; T2) = 0.6")->is_coefficient);
    EXPECT_TRUE(correlation_words("Correlation r(T1; T2)")->is_coefficient);
}

}  // namespace
}  // namespace gumcert::audit
