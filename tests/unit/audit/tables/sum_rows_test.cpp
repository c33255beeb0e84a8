#include "audit/tables/sum_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "text/numbers.h"
#include "workbook/read_csv.h"

namespace gumcert::audit {
namespace {

// Lines of a table that are no contributions: sums between its rows, its last lines where it has names and u alone, parts of a value
// beside numbers with a unit, results beside each other. The law: what a budget comes to does not depend on which
// of them a laboratory writes.

AuditReport audit_of_sums(const std::string& table) {
    return audit(subject_of(workbook::read_csv(table, "b.csv", "b"), "b.csv"), all_rules());
}
const AuditFinding* first_of(const AuditReport& report, std::string_view rule) {
    const auto found = std::find_if(report.findings.begin(), report.findings.end(),
                                    [rule](const AuditFinding& finding) { return finding.rule == rule; });
    return found == report.findings.end() ? nullptr : &*found;
}
std::string critical_of(const AuditReport& report) {
    std::string all;
    for (const AuditFinding& finding : report.findings) {
        if (finding.severity == FindingSeverity::critical) {
            all += finding.rule + " " + finding.where + ": " + finding.what.english() + "\n";
        }
    }
    return all;
}
bool leaves_unread(const AuditReport& report, std::string_view what) {
    return std::any_of(report.subject.not_read.begin(), report.subject.not_read.end(),
                       [what](const Sentence& said) { return said.english().find(what) != std::string::npos; });
}
double root_of_squares(const std::vector<double>& terms) {
    double sum = 0.0;
    for (const double term : terms) {
        sum += term * term;
    }
    return std::sqrt(sum);
}

TEST(SumsBetweenRows, AreNoContributions) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> size(0.1, 0.9);
    const std::vector<std::pair<std::string, std::string>> names = {
        {"Subtotal type A", "Subtotal type B"},
        {"Type A", "Type B"},
        {"Zwischensumme Typ A", "Zwischensumme Typ B"},
        {"u_A", "u_B"},
        {"Combined type A uncertainty", "Combined type B uncertainty"},
        {"RSS of type A", "RSS of type B"},
        {"Teilsumme A", "Teilsumme B"},
        {"小計 A", "小計 B"}};
    for (const auto& [a, b] : names) {
        for (int layout = 0; layout < 3; ++layout) {
            std::vector<double> of_a, of_b;
            std::string table = layout == 2   ? "Component,Unit,u\n"
                                : layout == 1 ? "Component,Unit,a,Divisor,u\n"
                                              : "Component,Unit,u,c,Contribution\n";
            const auto line = [layout](const std::string& name, const std::string& u, bool is_row) {
                return name + ",mg," +
                       (layout == 2   ? u
                        : layout == 1 ? (is_row ? u + ",1," + u : ",," + u)
                                      : (is_row ? u + ",1," + u : ",," + u)) +
                       "\n";
            };
            for (const char* name : {"Handling of the load", "Operator to operator"}) {
                of_a.push_back(std::round(1000.0 * size(random)) / 1000.0);
                table += line(name, text::fixed(of_a.back(), 3), true);
            }
            table += line(a, text::fixed(root_of_squares(of_a), 3), false);
            for (const char* name : {"Balance", "Timer", "Buoyancy"}) {
                of_b.push_back(std::round(1000.0 * size(random)) / 1000.0);
                table += line(name, text::fixed(of_b.back(), 3), true);
            }
            table += line(b, text::fixed(root_of_squares(of_b), 3), false);
            std::vector<double> all = of_a;
            all.insert(all.end(), of_b.begin(), of_b.end());
            const double u_c = root_of_squares(all);
            const std::string claims = line("u_c", text::fixed(u_c, 3), false) + "k,,2\n";
            SCOPED_TRACE(table + claims);
            const AuditReport sound = audit_of_sums(table + claims);
            ASSERT_EQ(sound.results.size(), 1U);
            EXPECT_EQ(sound.subject.budgets[0].rows.size(), 5U);
            EXPECT_NEAR(sound.results[0].recomputed.u_c, u_c, 1e-9);
            EXPECT_EQ(critical_of(sound), "");
        }
    }
}

TEST(SumsBetweenRows, AreFoundWhereTheyWereAddedTwice) {
    const std::string rows =
        "Component,Unit,u,c,Contribution\nHandling,mg,0.3,1,0.3\nOperators,mg,0.2,1,0.2\nSubtotal type A,mg,,,0.36\n"
        "Balance,mg,0.4,1,0.4\nTimer,mg,0.1,1,0.1\nBuoyancy,mg,0.25,1,0.25\nSubtotal type B,mg,,,0.48\n";
    const AuditReport twice = audit_of_sums(rows + "u_c,mg,,,0.72\nk,,,,2\nU,mg,,,1.44\n");
    ASSERT_EQ(twice.results.size(), 1U);
    EXPECT_NEAR(twice.results[0].audited.u_c, std::sqrt(0.09 + 0.04 + 0.16 + 0.01 + 0.0625), 1e-9);
    EXPECT_NE(first_of(twice, "K01"), nullptr);
    // As a formula adds them that reaches over all lines.
    const AuditReport all = audit_of_sums(rows + "u_c,mg,,,0.85\nk,,,,2\nU,mg,,,1.70\n");
    ASSERT_EQ(all.results.size(), 1U);
    EXPECT_NEAR(all.results[0].audited.u_c, std::sqrt(0.09 + 0.04 + 0.16 + 0.01 + 0.0625), 1e-9);
    EXPECT_NE(first_of(all, "K01"), nullptr);
    // One that is wrong is a sum all the same, and its error reaches u_c.
    const std::string of_type =
        "Component,Unit,u,c,Contribution\nHandling,mg,0.30,1,0.30\nType A,mg,,,0.30\nBalance,mg,0.40,1,0.40\n"
        "Timer,mg,0.10,1,0.10\nBuoyancy,mg,0.25,1,0.25\n";
    for (const char* claims : {"Type B,mg,,,0.41\nu_c,mg,,,0.51\nk,,,,2\nU,mg,,,1.02\n",     // a row was left out
                               "Type B,mg,,,0.48\nu_c,mg,,,0.78\nk,,,,2\nU,mg,,,1.56\n"}) {  // A + B
        const AuditReport wrong = audit_of_sums(of_type + claims);
        ASSERT_EQ(wrong.results.size(), 1U);
        EXPECT_NEAR(wrong.results[0].audited.u_c, std::sqrt(0.09 + 0.16 + 0.01 + 0.0625), 1e-9);
        EXPECT_NE(first_of(wrong, "K01"), nullptr);
    }
    // "Type A" and "Type B" may be all that a table has.
    const AuditReport two =
        audit_of_sums("Component,Unit,u\nType A,mg,0.30\nType B,mg,0.40\nu_c,mg,0.50\nk,,2\nU,mg,1.0\n");
    ASSERT_EQ(two.results.size(), 1U);
    EXPECT_EQ(two.subject.budgets[0].rows.size(), 2U);
    EXPECT_EQ(critical_of(two), "");
    // A row that has the size of a sum by chance, and is needed for what is stated, is one.
    const AuditReport row = audit_of_sums(
        "Component,Unit,u,c,Contribution\nBalance,mg,3.0,1,3.0\nTimer,mg,4.0,1,4.0\nFixture total,mg,,,5.0\n"
        "Buoyancy,mg,1.0,1,1.0\nu_c,mg,,,7.14\nk,,,,2\nU,mg,,,14.3\n");
    ASSERT_EQ(row.results.size(), 1U);
    EXPECT_EQ(row.subject.budgets[0].rows.size(), 4U);
    EXPECT_EQ(critical_of(row), "");
    // And one that is not, is none.
    const AuditReport sum = audit_of_sums(
        "Component,Unit,u,c,Contribution\nBalance,mg,1.0,1,1.0\nSensor,mg,3.0,1,3.0\nGradient,mg,4.0,1,4.0\n"
        "Temperature total,mg,,,5.0\nu_c,mg,,,5.10\nk,,,,2\nU,mg,,,10.2\n");
    ASSERT_EQ(sum.results.size(), 1U);
    EXPECT_NEAR(sum.results[0].recomputed.u_c, std::sqrt(26.0), 1e-9);
    EXPECT_EQ(critical_of(sum), "");
}

TEST(SumsBetweenRows, StandAboveTheirPartsAsWell) {
    // The law: a total and what it is made of are one contribution, wherever the total stands.
    std::mt19937 random(12);
    std::uniform_real_distribution<double> size(0.1, 0.9);
    const std::vector<std::array<std::string, 3>> names = {
        {"Temperature (total)", "of which sensor", "of which gradient"},
        {"Temperature, total", "Sensor", "Gradient"},
        {"Summe Temperatur", "davon Fühler", "davon Gradient"},
        {"Temperature", "Sensor", "Gradient"},
        {"Subtotal temperature", "Sensor", "Gradient"}};
    for (const auto& [total, first, second] : names) {
        for (int layout = 0; layout < 2; ++layout) {
            std::vector<double> all;
            const auto next = [&all, &random, &size] {
                all.push_back(std::round(1000.0 * size(random)) / 1000.0);
                return text::fixed(all.back(), 3);
            };
            const auto row = [layout](const std::string& name, const std::string& u) {
                return '"' + name + (layout == 0 ? "\",mg," + u + ",1," + u : "\",mg," + u + ",1,normal," + u) + "\n";
            };
            const auto alone = [layout](const std::string& name, double u) {
                return '"' + name + (layout == 0 ? "\",mg,,," : "\",mg,,,,") + text::fixed(u, 3) + "\n";
            };
            const std::string parts = row(first, next()) + row(second, next());
            const double of_parts = root_of_squares(all);
            const std::string others = row("Balance", next()) + row("Timer", next());
            const double u_c = root_of_squares(all);
            for (const bool is_first : {true, false}) {
                const std::string table = std::string(layout == 0 ? "Component,Unit,u,c,Contribution\n"
                                                                  : "Component,Unit,a,Divisor,Distribution,u\n") +
                                          (is_first ? "" : others) + alone(total, of_parts) + parts +
                                          (is_first ? others : "") + alone("u_c", u_c) + alone("U (k = 2)", 2.0 * u_c);
                SCOPED_TRACE(table);
                const AuditReport report = audit_of_sums(table);
                ASSERT_EQ(report.results.size(), 1U);
                EXPECT_EQ(report.subject.budgets[0].rows.size(), 4U);
                EXPECT_NEAR(report.results[0].recomputed.u_c, u_c, 1e-9);
                EXPECT_TRUE(leaves_unread(report, "is taken for a sum of rows"));
                EXPECT_EQ(first_of(report, "K01"), nullptr);
                EXPECT_EQ(critical_of(report), "");
            }
        }
    }
}

TEST(SumsBetweenRows, AboveTheirPartsAreFoundWhereTheyWereAddedTwice) {
    const std::string rows =
        "Component,Unit,u,c,Contribution\nTemperature,mg,,,0.36\nof which sensor,mg,0.3,1,0.3\n"
        "of which gradient,mg,0.2,1,0.2\nBalance,mg,0.4,1,0.4\nTimer,mg,0.1,1,0.1\n";
    const AuditReport twice = audit_of_sums(rows + "u_c,mg,,,0.66\nk,,,,2\nU,mg,,,1.31\n");
    ASSERT_EQ(twice.results.size(), 1U);
    EXPECT_NEAR(twice.results[0].audited.u_c, root_of_squares({0.3, 0.2, 0.4, 0.1}), 1e-9);
    EXPECT_NE(first_of(twice, "K01"), nullptr);
    // A row that has the size of those below it by chance, and is needed for what is stated, is one.
    const AuditReport row = audit_of_sums(
        "Component,Unit,u,c,Contribution\nFixture total,mg,,,5.0\nBalance,mg,3.0,1,3.0\nTimer,mg,4.0,1,4.0\n"
        "Buoyancy,mg,1.0,1,1.0\nu_c,mg,,,7.14\nk,,,,2\nU,mg,,,14.3\n");
    ASSERT_EQ(row.results.size(), 1U);
    EXPECT_EQ(row.subject.budgets[0].rows.size(), 4U);
    EXPECT_EQ(critical_of(row), "");
    // So is one that u_c leaves out: no other row is a sum of those beside it.
    const AuditReport left_out = audit_of_sums(
        "Component,Unit,a,Divisor,u,c,Contribution\nBalance,mg,0.6,2,0.30,1,0.30\nTimer,mg,0.7,√3,0.40,1,0.40\n"
        "Drift,mg,0.87,√3,0.50,1,0.50\nSensor,mg,0.52,√3,0.30,1,0.30\nGradient,mg,0.8,2,0.40,1,0.40\n"
        "u_c,mg,,,,,0.71\nk,,,,,,2\nU,mg,,,,,1.42\n");
    ASSERT_EQ(left_out.results.size(), 1U);
    EXPECT_EQ(left_out.subject.budgets[0].rows.size(), 5U);
    EXPECT_NE(first_of(left_out, "K01"), nullptr);
}

TEST(SumsBetweenRows, PartsOfAQuantityAreInItsContribution) {
    const std::string heads = "Component,Unit,a,Divisor,u,c,Contribution / nm\n",
                      parts = "Sensor,K,0.06,2,0.0300,,\nGradient,K,0.09,√3,0.0520,,\n",
                      total = "Temperature,K,,,0.0600,575 nm/K,34.5\n",
                      others = "Standard,nm,30,2,15.0,1,15.0\nDrift of the standard,nm,20,√3,11.5,1,11.5\n",
                      claims = "u_c,nm,,,,,39.3\nk,,,,,,2\nU,nm,,,,,79\n";
    for (const std::string& table : {heads + total + parts + others + claims, heads + parts + total + others + claims,
                                     heads + others + total + parts + claims}) {
        const AuditReport report = audit_of_sums(table);
        SCOPED_TRACE(table);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), 3U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, root_of_squares({34.5, 15.0, 11.547}), 0.05);
        EXPECT_TRUE(leaves_unread(report, "is taken for a part of \"Temperature\""));
        EXPECT_EQ(critical_of(report), "");
    }
}

TEST(SumsBetweenRows, OfRowsWithoutACoefficientAreNoPartsByChance) {
    // The law: rows are left out as parts only where what is stated follows without them, and not with them.
    const std::string heads = "Mass\nComponent,Unit,u,c,Contribution / mg\n",
                      rows = "Standard,mg,0.30,,\nDrift,mg,0.40,,\nBuoyancy,mg,0.50,0.5,0.25\n",
                      coarse = "Standard,mg,0.1,,\nDrift,mg,0.1,,\nBuoyancy,mg,0.1,1,0.1\nBalance,mg,0.2,1,0.2\n",
                      open = "Standard,mg,0.30,,\nDrift,mg,0.40,,\nBuoyancy,mg,0.50,1,0.50\nBalance,mg,0.2,1,0.2\n";
    for (const std::string& table : {rows + "U,mg,,,1.2\n", rows + "u_c,mg,,,0.559\nk,,,,2\nU,mg,,,1.12\n",
                                     coarse + "u_c,mg,,,0.3\nk,,,,2\nU,mg,,,0.6\n", open}) {
        const AuditReport report = audit_of_sums(heads + table);
        SCOPED_TRACE(table);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), table.starts_with(rows) ? 3U : 4U);
        EXPECT_FALSE(leaves_unread(report, "is taken for a part of"));
        EXPECT_EQ(critical_of(report), "");
    }
}

TEST(SumsBetweenRows, NameTheQuantityThatPartsAreOf) {
    const AuditReport above = audit_of_sums(
        "Length\nComponent,Unit,u,c,Contribution / µm\nSensor,K,0.030,,\nGradient,K,0.052,,\n"
        "Temperature,K,0.060,5 µm/K,0.300\nStandard,µm,0.40,1,0.40\nFriction,K,0.030,,\nLevel,K,0.052,,\n"
        "Bending,K,0.060,5 µm/K,0.300\nDrift,µm,0.20,1,0.20\nu_c,µm,,,0.616\nk,,,,2\nU,µm,,,1.23\n");
    ASSERT_EQ(above.results.size(), 1U);
    EXPECT_EQ(above.subject.budgets[0].rows.size(), 4U);
    for (const char* said :
         {"\"Sensor\" is taken for a part of \"Temperature\"", "\"Gradient\" is taken for a part of \"Temperature\"",
          "\"Friction\" is taken for a part of \"Bending\"", "\"Level\" is taken for a part of \"Bending\""}) {
        EXPECT_TRUE(leaves_unread(above, said)) << said;
    }
}

TEST(Rows, MayBeNamedLikeStatementsWithAUnit) {
    for (const auto& [name, u_c] : std::vector<std::pair<std::string, std::string>>{{"Correction in µm", "0.539"},
                                                                                    {"Error in mm", "0.539"},
                                                                                    {"Tolerance in µm", "0.539"},
                                                                                    {"CMC / µm", "0.539"}}) {
        const AuditReport report = audit_of_sums("Length\nComponent,u / µm\nStandard,0.30\n" + name +
                                                 ",0.40\nDrift,0.20\nu_c," + u_c + "\nU (k = 2),1.08\n");
        SCOPED_TRACE(name);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), 3U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, 0.5385, 1e-4);
        EXPECT_EQ(first_of(report, "K01"), nullptr);
    }
}

TEST(SumsBetweenRows, OfATypeMayBeContributionsOfTheSizeOfARow) {
    const std::string plain = "Quantity,u / mK\n";
    for (const std::string& table :
         {plain + "Calibration,0.010\nType A,0.010\nStability,0.008\nType B,0.009\nResolution,0.006\n"
                  "u_c,0.0195\nU (k = 2),0.039\n",
          plain + "u_cal,0.50\nu_A,0.30\nu_B,0.30\nu_T,0.10\nStability,0.05\nu_c,0.66\nU (k = 2),1.3\n",
          plain + "Calibration,0.2\nType A,0.2\nType B,0.1\nResolution,0.1\nu_c,0.32\nU (k = 2),0.64\n",
          std::string("Quantity,u / mV,c,Contribution / mV\nReference,0.3,1,0.3\nType A,,,0.3\nType B,,,0.4\n"
                      "Resolution,0.2,1,0.2\nDrift,0.1,1,0.1\nCombined standard uncertainty,,,0.62\n"
                      "Expanded uncertainty (k = 2),,,1.2\n")}) {
        const AuditReport report = audit_of_sums(table);
        SCOPED_TRACE(table);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), table.find("Calibration,0.2") == table.npos ? 5U : 4U);
        EXPECT_EQ(first_of(report, "K01"), nullptr);
        EXPECT_EQ(first_of(report, "K09"), nullptr);
        EXPECT_FALSE(leaves_unread(report, "is taken for a sum"));
    }
    // They are sums where what is stated follows without them, and where several rows make up one of two.
    const std::string of_one =
        "Component,Unit,u,c,Contribution\nHandling,mg,0.30,1,0.30\nType A,mg,,,0.30\nBalance,mg,0.40,1,0.40\n"
        "Timer,mg,0.10,1,0.10\nBuoyancy,mg,0.25,1,0.25\nType B,mg,,,0.48\n";
    for (const bool is_sound : {true, false}) {
        const AuditReport report = audit_of_sums(of_one + (is_sound ? "u_c,mg,,,0.57\n" : "u_c,mg,,,0.80\n") +
                                                 "k,,,,2\nU,mg,,," + (is_sound ? "1.14\n" : "1.60\n"));
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), 4U);
        EXPECT_EQ(first_of(report, "K01") == nullptr, is_sound);
    }
}

TEST(PlainTables, EndWithTheirResultsWhateverTheirNames) {
    const std::string rows =
        "Frequency\nComponent,u / mHz\nReference (certificate; U = 1.0 mHz; k = 2),0.5\n"
        "Drift of the reference,0.3\nCounter resolution,0.6\nRepeatability,0.2\n";
    const double u_c = root_of_squares({0.5, 0.3, 0.6, 0.2});
    for (const auto& [one, other] :
         std::vector<std::pair<std::string, std::string>>{{"u(f)", "U(f)"},
                                                          {"u(f)", "U(f) (k = 2)"},
                                                          {"u_f", "U_f"},
                                                          {"Standard uncertainty u(f)", "Expanded uncertainty U(f)"},
                                                          {"Sum", "2 × Sum"},
                                                          {"RSS", "RSS × 2"},
                                                          {"1 sigma", "2 sigma"},
                                                          {"σ", "2σ"},
                                                          {"Gesamt", "Gesamt (k = 2)"},
                                                          {"u gesamt", "U gesamt"},
                                                          {"What comes out", "Twice that"}}) {
        const AuditReport sound = audit_of_sums(rows + one + ",0.86\n" + other + ",1.72\n");
        SCOPED_TRACE(one);
        ASSERT_EQ(sound.results.size(), 1U);
        EXPECT_EQ(sound.subject.budgets[0].rows.size(), 4U);
        EXPECT_NEAR(sound.results[0].recomputed.u_c, u_c, 1e-9);
        ASSERT_TRUE(sound.subject.budgets[0].claims.U);
        EXPECT_EQ(sound.subject.budgets[0].claims.U->text, "1.72");
        if (other != "U(f) (k = 2)") {  // which is U by its name
            EXPECT_TRUE(leaves_unread(sound, "is taken for u_c of the rows above it"));
            EXPECT_TRUE(leaves_unread(sound, "is taken for U of the rows above it"));
        }
        EXPECT_EQ(critical_of(sound), "");
        const AuditReport planted = audit_of_sums(rows + one + ",0.86\n" + other + ",1.20\n");
        // What nobody states of k, nobody can hold U against.
        EXPECT_TRUE(planted.results.empty() || first_of(planted, "K01") != nullptr ||
                    first_of(planted, "R04") != nullptr);
    }
    // Influences at the end are rows, and so are two that are of such sizes by chance.
    const AuditReport influences = audit_of_sums(
        "Component,u / mHz\nReference,0.3\nDrift of the reference,0.4\nResolution,0.5\nRepeatability,1.0\n"
        "u_c,1.22\nk,2\nU,2.45\n");
    ASSERT_EQ(influences.results.size(), 1U);
    EXPECT_EQ(influences.subject.budgets[0].rows.size(), 4U);
    EXPECT_EQ(critical_of(influences), "");
}

TEST(PlainTables, HaveNoResultsByChance) {
    // Of one digit, numbers fit many sums.
    for (const char* rows : {"Weighing,0.3\nVolume,0.3\nPurity,0.4\nRecovery,0.8\n",
                             "u1,0.1\nu2,0.1\nu3,0.1\nu4,0.2\nu5,0.1\n", "a1,0.3\na2,0.4\na3,0.5\na4,1.0\n"}) {
        const AuditReport open = audit_of_sums(std::string("Quantity,u / %\n") + rows);
        SCOPED_TRACE(rows);
        EXPECT_TRUE(open.results.empty());
        EXPECT_TRUE(leaves_unread(open, "may be the result of the rows above it, or one more contribution"));
    }
    const AuditReport named = audit_of_sums("Quantity,u / %\nWeighing,0.3\nVolume,0.3\nSum,0.4\n2 × Sum,0.8\n");
    ASSERT_EQ(named.results.size(), 1U);
    EXPECT_EQ(named.subject.budgets[0].rows.size(), 2U);
    EXPECT_TRUE(leaves_unread(named, "is taken for U of the rows above it"));
    // Where U is stated, no other line is it; and none is u_c, unless the rows above it give what is stated.
    for (const char* rows :
         {"Reference thermometer,0.02\nu_stab,0.02\nGradient,0.03\nu_res,0.06\nExpanded uncertainty,0.15\n",
          "Reference thermometer,0.020\nu_stab,0.015\nu_grad,0.025\nu_res,0.050\nExpanded uncertainty,0.12\n"}) {
        const AuditReport stated = audit_of_sums(std::string("Quantity,Standard uncertainty / °C\n") + rows);
        SCOPED_TRACE(rows);
        ASSERT_EQ(stated.results.size(), 1U);
        EXPECT_EQ(stated.subject.budgets[0].rows.size(), 4U);
        EXPECT_EQ(critical_of(stated), "");
    }
    const AuditReport again = audit_of_sums(
        "Frequency\nComponent,u / mHz\nReference,0.5\nDrift of the reference,0.3\nCounter resolution,0.6\n"
        "Repeatability,0.2\nWhat comes out,0.86\nTwice that,1.72\nExpanded uncertainty (k = 2),1.72\n");
    ASSERT_EQ(again.results.size(), 1U);
    EXPECT_EQ(again.subject.budgets[0].rows.size(), 4U);
    EXPECT_EQ(critical_of(again), "");
}

TEST(PartsOfAValue, LeaveTheUnitOfTheRows) {
    const std::string rows =
        "Torque 10 N·m\nQuantity,Unit,a,divisor,u\nReference (certificate; U = 0.2 mN·m; k = 2),mN·m,0.2,2,"
        "0.1000\nDrift of the standard,mN·m,0.2,1.732,0.1155\nResolution,mN·m,0.15,1.732,0.0866\n"
        "Repeatability,mN·m,0.06,1,0.0600\nu_c,mN·m,,,0.186\nk,,,2\n";
    for (const char* U : {"U,%,,,0.0037\n", "U,ppm,,,37\n", "U,µN·m/(N·m),,,37\n", "U,,,,0.0037 %\n"}) {
        for (const std::string beside : {"", "U,mN·m,,,0.37\n"}) {
            const AuditReport report = audit_of_sums(rows + U + beside);
            SCOPED_TRACE(U + beside);
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_EQ(report.subject.budgets[0].unit, "mN·m");
            EXPECT_NEAR(report.results[0].recomputed.U, 0.3712, 1e-3);
            EXPECT_EQ(first_of(report, "S01"), nullptr);
            EXPECT_EQ(critical_of(report), "");
            EXPECT_EQ(report.subject.budgets[0].claims.U.has_value(), !beside.empty());
        }
    }
}

TEST(ResultsBesideEachOther, AreWhatTheirHeadsSay) {
    const std::string rows =
        "Torque 10 N·m\nQuantity,Unit,a,divisor,u\nReference (certificate; U = 0.2 mN·m; k = 2),mN·m,0.2,2,"
        "0.1000\nDrift of the standard,mN·m,0.2,1.732,0.1155\nResolution,mN·m,0.15,1.732,0.0866\n"
        "Repeatability,mN·m,0.06,1,0.0600\n";
    for (const std::string U : {"0.37", "0.20"}) {
        for (const std::string& lines :
             {"\nResult,Unit,u_c,k,U\nDeviation,mN·m,0.186,2," + U + "\n", "u_c,k,U\n0.186,2," + U + "\n",
              "\nu_c =,0.186,mN·m,k =,2,U =," + U + ",mN·m\n", "u_c [mN·m],k,U [mN·m]\n0.186,2," + U + "\n",
              "\ny,u(y),k,U\n10.0012 N·m,0.186 mN·m,2," + U + " mN·m\n",
              "Result,u_c,ν_eff,k,U\n10.0012 N·m,0.186 mN·m,∞,2," + U + " mN·m\n"}) {
            const AuditReport report = audit_of_sums(rows + lines);
            SCOPED_TRACE(lines);
            ASSERT_EQ(report.results.size(), 1U);
            const AuditedBudget& budget = report.subject.budgets[0];
            ASSERT_TRUE(budget.claims.U && budget.claims.u_c);
            EXPECT_NEAR(budget.claims.U->value, std::stod(U), 1e-12);
            EXPECT_NEAR(budget.claims.u_c->value, 0.186, 1e-12);
            EXPECT_EQ(budget.coverage.k, 2.0);
            EXPECT_FALSE(budget.value && std::abs(*budget.value - 0.186) < 1e-9);
            EXPECT_EQ(first_of(report, "K01") != nullptr, U == "0.20");
        }
    }
    // What stands behind them, and nobody understands, is named.
    const AuditReport behind =
        audit_of_sums(rows + "\nResult,Unit,u_c,k,U\nDeviation,mN·m,0.186,2,0.37\nSafety margin,mN·m,,,0.5\n");
    EXPECT_TRUE(leaves_unread(behind, "\"Safety margin\" has a number, and is no row and no statement that is known"));
    // Of several points nobody knows which one the rows are of.
    const AuditReport points = audit_of_sums(rows + "\nPoint,u_c,k,U\n10,0.186,2,0.37\n20,0.190,2,0.38\n");
    ASSERT_EQ(points.results.size(), 1U);
    EXPECT_FALSE(points.subject.budgets[0].claims.U);
}

TEST(ResultsBesideEachOther, MayBeWholeCells) {
    const std::string rows =
        "Voltage 10 V\nQuantity,unit,u,c,contribution\nReference,mV,0.10,1,0.10\nDrift,mV,0.20,1,0.20\n"
        "Repeatability,mV,0.30,1,0.30\nResolution,mV,0.05,1,0.05\n";
    for (const std::string lines : {"Result,10.0002 V,U = 0.755 mV,k = 2\nu_c,mV,,,0.377\n",
                                    "u_c,mV,,,0.377\nU,mV,,,0.755\nk = 2 (p = 95.45 %)\n"}) {
        const AuditReport report = audit_of_sums(rows + lines);
        SCOPED_TRACE(lines);
        ASSERT_EQ(report.results.size(), 1U);
        const AuditedBudget& budget = report.subject.budgets[0];
        ASSERT_TRUE(budget.claims.U && budget.claims.k);
        EXPECT_NEAR(budget.claims.U->value, 0.755, 1e-12);
        EXPECT_EQ(budget.claims.k->value, 2.0);
        EXPECT_TRUE(first_of(report, "R04") == nullptr || first_of(report, "R04")->severity == FindingSeverity::minor);
        EXPECT_EQ(critical_of(report), "");
    }
}

TEST(ResultsBesideEachOther, AreAValueAndItsU) {
    const std::string rows =
        "Pressure 10 bar\nQuantity,Unit,u,c,Contribution\nReference (certificate; U = 4 mbar; k = 2),mbar,2,1,2\n"
        "Drift of the reference,mbar,1.15,1,1.15\nResolution,mbar,0.29,1,0.29\nRepeatability,mbar,0.36,1,0.36\n";
    for (const std::string line : {"Result,10.002 bar ± 4.7 mbar (k = 2)", "Result: 10.002 bar ± 4.7 mbar (k = 2)",
                                   "Result: (10.0020 ± 0.0047) bar; k = 2", "Result = (10002.0 +/- 4.7) mbar,k = 2",
                                   "y,10.002 bar ± 4.7 mbar,k = 2"}) {
        for (const bool is_sound : {true, false}) {
            std::string stated = line;
            if (!is_sound) {
                stated.replace(stated.find("47") != std::string::npos ? stated.find("47") : stated.find("4.7"),
                               stated.find("47") != std::string::npos ? 2 : 3,
                               stated.find("47") != std::string::npos ? "25" : "2.5");
            }
            SCOPED_TRACE(stated);
            const AuditReport report = audit_of_sums(rows + stated + "\n");
            ASSERT_EQ(report.results.size(), 1U);
            const AuditedBudget& budget = report.subject.budgets[0];
            ASSERT_TRUE(budget.claims.U);
            ASSERT_TRUE(budget.value);
            const double in_bar = budget.unit == "bar" ? 1.0 : 1e-3;
            EXPECT_NEAR(budget.claims.U->value * in_bar, is_sound ? 0.0047 : 0.0025, 1e-9);
            EXPECT_NEAR(*budget.value * in_bar, 10.002, 1e-9);
            EXPECT_EQ(budget.coverage.k, 2.0);
            EXPECT_EQ(critical_of(report).empty(), is_sound);
        }
    }
}

TEST(Heads, MayStandInTwoLines) {
    const AuditReport merged = audit_of_sums(
        "Source of uncertainty,,Input,,,Standard uncertainty,Sensitivity coefficient,Contribution,Degrees of freedom\n"
        ",unit,value ±,distribution,divisor,u(xi),ci,ui(y),νi\n"
        "Reference (certificate; U = 0.04 Ω; k = 2),Ω,0.04,normal,2,0.02,1,0.02,\nDrift of the "
        "reference,Ω,0.03,rectangular,√3,0.0173,1,0.0173,\n"
        "Resolution,Ω,0.005,rectangular,√3,0.0029,1,0.0029,\nRepeatability,Ω,0.006,normal,1,0.006,1,0.006,9\n"
        "u_c,Ω,,,,,,0.0273,\nk,,,,,,,2\nU,Ω,,,,,,0.055\n");
    ASSERT_EQ(merged.results.size(), 1U);
    EXPECT_EQ(merged.subject.budgets[0].rows.size(), 4U);
    EXPECT_NEAR(merged.results[0].recomputed.u_c, root_of_squares({0.02, 0.0173, 0.0029, 0.006}), 1e-4);
    EXPECT_EQ(critical_of(merged), "");
    // A head that is cut, or whose words stand below each other, is one head.
    for (const char* heads : {"Größe,Grenzwert,Ver-,Teiler,Standard-,Sensitivitäts-,Unsicherheits-,Freiheits-\n"
                              ",,teilung,,unsicherheit,koeffizient,beitrag,grade\n",
                              "Component,Half-width,Probability,Divisor,Standard,Sensitivity,Uncertainty,Degrees of\n"
                              ",,distribution,,uncertainty,coefficient,contribution,freedom\n",
                              "Component,Half-width,Distribution,Divisor,Standard,Sensitivity,Contribution,Degrees of\n"
                              ",(Ω),,,uncertainty (Ω),coefficient,(Ω),freedom\n"}) {
        const AuditReport cut = audit_of_sums(
            "Resistance\n" + std::string(heads) +
            "Reference (certificate; U = 0.04 Ω; k = 2),0.04 Ω,normal,2,0.0200 Ω,1,0.0200 Ω,50\nDrift of the reference,"
            "0.03 Ω,rectangular,√3,0.0173 Ω,1,0.0173 Ω,∞\nRepeatability,0.006 Ω,normal,1,0.0060 Ω,1,0.0060 Ω,9\n"
            "u_c,,,,,,0.0271 Ω,\nU (k = 2),,,,,,0.054 Ω,\n");
        SCOPED_TRACE(heads);
        ASSERT_EQ(cut.results.size(), 1U);
        ASSERT_EQ(cut.subject.budgets[0].rows.size(), 3U);
        EXPECT_TRUE(cut.subject.budgets[0].unread_columns.empty());
        const AuditedRow& row = cut.subject.budgets[0].rows[0];
        EXPECT_TRUE(row.u && row.divisor && row.sensitivity && row.contribution && row.nu);
        EXPECT_EQ(row.shape, Shape::normal);
        EXPECT_EQ(critical_of(cut), "");
    }
    // Symbols below heads are no numbers that could not be read.
    const AuditReport symbols = audit_of_sums(
        "quantity,estimate,standard uncertainty,distribution,sensitivity coefficient,uncertainty contribution\n"
        "X_i,x_i,u(x_i),,c_i,u_i(y)\nm_S,10.005 g,22.5 mg,normal,1,22.5 mg\nm_D,0 g,8.95 mg,rectangular,1,8.95 mg\n"
        "m_X,10.005 g,,,,24.2 mg\n");
    ASSERT_EQ(symbols.results.size(), 1U);
    EXPECT_NEAR(symbols.results[0].recomputed.u_c, root_of_squares({22.5, 8.95}), 1e-9);
    EXPECT_TRUE(std::none_of(symbols.subject.not_read.begin(), symbols.subject.not_read.end(),
                             [](const Sentence& said) { return said.english().find("x_i") != std::string::npos; }));
}

/// A voltage without columns of u and divisors: what is divided, and by what its distribution says.
std::string distributions(const std::string& normal, const std::string& rectangular, const std::string& one) {
    return "Voltage 10 V\nQuantity,unit,U or a,distribution,c\nReference,mV,0.20,\"" + normal +
           "\",1\nDrift of the reference,mV,0.35,\"" + rectangular + "\",1\nRepeatability,mV,0.30,\"" + one +
           "\",1\nTemperature,mV,0.20,\"" + rectangular + "\",1\nu_c,mV,0.397\nk,2\nU,mV,0.79\n";
}

TEST(Distributions, SayWhatIsDividedByOrAreAskedAbout) {
    const double u_c = root_of_squares({0.1, 0.35 / std::sqrt(3.0), 0.3, 0.2 / std::sqrt(3.0)});
    for (const auto& [normal, rectangular, one] :
         std::vector<std::array<std::string, 3>>{{"normal (k = 2)", "rectangular", "normal"},
                                                 {"N (k=2)", "R", "N (k=1)"},
                                                 {"Normal 2σ", "rect.", "Normal 1σ"},
                                                 {"gaussian; 2 sigma", "uniform", "gaussian"},
                                                 {"normal, k = 2", "R (√3)", "Normal (k = 1)"}}) {
        SCOPED_TRACE(normal + rectangular);
        const AuditReport report = audit_of_sums(distributions(normal, rectangular, one));
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, u_c, 1e-9);
        EXPECT_EQ(critical_of(report), "");
    }
    for (const char* open : {"trapezoidal", "log-normal", "T", "B", "normal (95 %)"}) {
        EXPECT_TRUE(audit_of_sums(distributions("normal (k = 2)", open, "normal")).results.empty()) << open;
    }
}

TEST(Divisors, MayBeRootsInAnyForm) {
    for (const char* root : {"√3", "sqrt(3)", "3^0.5", "3^(1/2)", "3^½", "Wurzel 3", "root 3"}) {
        const AuditReport report =
            audit_of_sums(std::string("Voltage 10 V\nQuantity,unit,U or a,divisor,c\nReference,mV,0.20,2,1\nDrift of "
                                      "the reference,mV,0.35,") +
                          root + ",1\nRepeatability,mV,0.30,1,1\nu_c,mV,0.375\nk,2\nU,mV,0.75\n");
        SCOPED_TRACE(root);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_NEAR(report.results[0].recomputed.u_c, root_of_squares({0.1, 0.35 / std::sqrt(3.0), 0.3}), 1e-9);
        EXPECT_EQ(critical_of(report), "");
    }
    // Another power, or a half behind a number, is none that could be guessed.
    for (const char* open : {"3^2", "3½"}) {
        const AuditReport report =
            audit_of_sums(std::string("Voltage 10 V\nQuantity,unit,U or a,divisor,c\nReference,mV,0.20,2,1\nDrift of "
                                      "the reference,mV,0.35,") +
                          open + ",1\nRepeatability,mV,0.30,1,1\nu_c,mV,0.375\nk,2\nU,mV,0.75\n");
        EXPECT_TRUE(
            std::any_of(report.subject.not_read.begin(), report.subject.not_read.end(),
                        [open](const Sentence& said) { return said.english().find(open) != std::string::npos; }));
    }
}

TEST(Rows, OfWhichNoUncertaintyWasReadAreMissing) {
    const auto table = [](const std::string& u) {
        return audit_of_sums("Voltage 10 V\nQuantity,unit,u,c\nReference,mV,0.10,1\nDrift of the reference,mV," + u +
                             ",1\nRepeatability,mV,0.30,1\nu_c,mV,0.374\nk,,2\nU,mV,0.75\n");
    };
    EXPECT_EQ(table("0.20").results.size(), 1U);
    EXPECT_TRUE(table("≈ 0.20").results.empty());
    EXPECT_TRUE(table("(0.20)").results.empty());
    // What is stated needs none of these.
    const AuditReport small = audit_of_sums(
        "Voltage 10 V\nQuantity,unit,u,c\nReference,mV,0.10,1\nHumidity,mV,(0.001),1\nRepeatability,mV,0.30,1\n"
        "Temperature,mV,< 0.01,1\nPressure,mV,negligible,1\nu_c,mV,0.316\nk,,2\nU,mV,0.63\n");
    ASSERT_EQ(small.results.size(), 1U);
    EXPECT_EQ(critical_of(small), "");
}

TEST(StudentFactors, AreCoverageFactors) {
    for (const std::string lines : {"ν_eff,9.9\nt95 (ν_eff),2.28\nU = t95 · u_c,mV,,,0.86\n",
                                    "ν_eff,9.9\nStudent factor,2.28\nExpanded uncertainty,mV,,,0.86\n",
                                    "ν_eff,9.9\nt-Faktor,2.28\nU,mV,,,0.86\n"}) {
        const AuditReport report = audit_of_sums(
            "Voltage 10 V\nQuantity,unit,u,c,contribution,nu\nReference,mV,0.10,1,0.10,inf\nDrift,mV,0.20,1,0.20,inf\n"
            "Repeatability,mV,0.30,1,0.30,4\nResolution,mV,0.05,1,0.05,inf\nu_c,mV,,,0.377\n" +
            lines);
        SCOPED_TRACE(lines);
        ASSERT_EQ(report.results.size(), 1U);
        const Claims& claims = report.subject.budgets[0].claims;
        ASSERT_TRUE(claims.k && claims.U);
        EXPECT_EQ(claims.k->text, "2.28");
        EXPECT_EQ(critical_of(report), "");
    }
}

TEST(Units, MayStandInACellOfTheTitle) {
    const std::string rows =
        "Component,Type,u,c,Contribution\nReference,B,0.3,1,0.3\nDrift,B,0.4,1,0.4\nResolution,B,0.1,1,0.1\n"
        "u_c,,,,0.51\nk,,,,2\nU,,,,1.02\n";
    for (const auto& [title, unit] :
         std::vector<std::pair<std::string, std::string>>{{"Mass flow,all values in g/min", "g/min"},
                                                          {"Mass flow\nall values in g/min", "g/min"},
                                                          {"Frequency of a standard,relative deviation", "1"},
                                                          {"Frequenz eines Normals; relative Abweichung", "1"},
                                                          {"relative uncertainties in %", "%"},
                                                          {"Mass flow,Meyer", ""}}) {
        const AuditReport report = audit_of_sums(title + "\n" + rows);
        SCOPED_TRACE(title);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].unit, unit);
        EXPECT_EQ(critical_of(report).empty(), !unit.empty());
    }
}

TEST(Values, BelowTheRowsMayBeInAnotherUnitThanU) {
    // The law: a value in kN is no row of a table in N, whatever it is called and wherever it stands.
    const std::string rows =
        "Force 10 kN\nSource,u (N),c,c·u (N)\nReference transducer (certificate; W = 0.06 %; k = 2),3.0,1,3.0\n"
        "Drift of the reference,1.7,1,1.7\nRepeatability,1.1,1,1.1\nAlignment,0.9,1,0.9\n";
    for (const char* value :
         {"Force,10.003 kN\n", "Force,10003 N\n", "Force,,,10.003 kN\n", "Measured value,10.003 kN\n", ""}) {
        const AuditReport report = audit_of_sums(rows + value +
                                                 "Combined standard uncertainty,,,3.73 N\nExpanded uncertainty "
                                                 "(k = 2),,,7.5 N\nRelative expanded uncertainty (k = 2),,,0.075 %\n");
        SCOPED_TRACE(value);
        ASSERT_EQ(report.results.size(), 1U);
        EXPECT_EQ(report.subject.budgets[0].rows.size(), 4U);
        EXPECT_EQ(report.subject.budgets[0].unit, "N");
        EXPECT_EQ(critical_of(report), "");
        EXPECT_EQ(first_of(report, "K01"), nullptr);
    }
}

TEST(Heads, MayStandAgainAboveFurtherRows) {
    // The law: rows below heads that stand twice before any result are one budget where the result is that of all of them.
    const std::string heads = "Component,Unit,u,c,Contribution\n",
                      a = "Handling,mg,0.30,1,0.30\nReadings,mg,0.20,1,0.20\n",
                      b = "Balance,mg,0.40,1,0.40\nDrift of the balance,mg,0.10,1,0.10\n";
    for (const char* between : {"", "Type B\n", "Page 2\n", "\n", "\nType B components\n"}) {
        const AuditReport one =
            audit_of_sums("Type A\n" + heads + a + between + heads + b + "u_c,mg,,,0.548\nk,,,,2\nU,mg,,,1.10\n");
        SCOPED_TRACE(between);
        ASSERT_EQ(one.results.size(), 1U);
        EXPECT_EQ(one.subject.budgets[0].rows.size(), 4U);
        EXPECT_NEAR(one.results[0].recomputed.u_c, root_of_squares({0.3, 0.2, 0.4, 0.1}), 1e-9);
        EXPECT_EQ(critical_of(one), "");
        EXPECT_EQ(first_of(one, "K01"), nullptr);
        // Each part may have its sum.
        const AuditReport sums = audit_of_sums("Type A\n" + heads + a + "Subtotal A,mg,,,0.361\n" + between + heads +
                                               b + "Subtotal B,mg,,,0.412\nu_c,mg,,,0.548\nk,,,,2\nU,mg,,,1.10\n");
        ASSERT_EQ(sums.results.size(), 1U);
        EXPECT_EQ(sums.subject.budgets[0].rows.size(), 4U);
        EXPECT_EQ(first_of(sums, "K01"), nullptr);
        // Where the result is that of the rows directly above it, the others are a budget of their own.
        const AuditReport two =
            audit_of_sums("Point 1\n" + heads + a + between + heads + b + "u_c,mg,,,0.412\nk,,,,2\nU,mg,,,0.82\n");
        ASSERT_EQ(two.results.size(), 2U);
        EXPECT_EQ(two.subject.budgets[0].rows.size(), 2U);
        EXPECT_FALSE(two.subject.budgets[0].claims.U);
        ASSERT_TRUE(two.subject.budgets[1].claims.U);
        EXPECT_EQ(two.subject.budgets[1].claims.U->text, "0.82");
        EXPECT_EQ(critical_of(two), "");
    }
}

TEST(Heads, ThatStandAgainKeepWhatOtherTablesState) {
    // The law: what one of two tables states is not said of the other, unless their rows make up one result.
    const std::string heads = "Component,Unit,u,c,Contribution\n",
                      a = "Point 10 mg\n" + heads + "Handling,mg,0.30,1,0.30\nReadings,mg,0.20,1,0.20\n",
                      b = "\nPoint 20 mg\n" + heads + "Balance,mg,0.40,1,0.40\nDrift of the balance,mg,0.10,1,0.10\n";
    const AuditReport capability =
        audit_of_sums(a + "CMC,mg,,,0.9\nν_eff,,,,12\nk,,,,2.2\n" + b + "u_c,mg,,,0.412\nk,,,,2\nU,mg,,,0.82\n");
    ASSERT_EQ(capability.results.size(), 2U);
    EXPECT_EQ(capability.subject.budgets[0].capability, 0.9);
    const AuditedBudget& second = capability.subject.budgets[1];
    EXPECT_FALSE(second.capability);
    EXPECT_FALSE(second.claims.nu_eff);
    ASSERT_TRUE(second.claims.k);
    EXPECT_EQ(second.claims.k->value, 2.0);
    EXPECT_EQ(first_of(capability, "K01"), nullptr);
    EXPECT_EQ(first_of(capability, "K03"), nullptr);
    EXPECT_EQ(first_of(capability, "X01"), nullptr);
    const AuditReport joined = audit_of_sums(a + "CMC,mg,,,0.9\n" + b + "u_c,mg,,,0.548\nk,,,,2\nU,mg,,,1.10\n");
    ASSERT_EQ(joined.results.size(), 1U);
    EXPECT_EQ(joined.subject.budgets[0].rows.size(), 4U);
    EXPECT_EQ(joined.subject.budgets[0].capability, 0.9);
}

TEST(Heads, AreNoRowBelowThem) {
    const AuditReport report = audit_of_sums(
        "Mass\nQuantity,u / mg,\nBalance,≈ 0.20,certificate\nStandard,0.10,\nDrift,0.05,\nU (k = 2),0.46,\n");
    EXPECT_TRUE(leaves_unread(report, "\"≈ 0.20\" is no number; what is meant?"));
    EXPECT_EQ(first_of(report, "K01"), nullptr);
}

TEST(Heads, MayNameContributionsTwice) {
    const AuditReport report = audit_of_sums(
        "Micrometer\nUnsicherheitsbeitrag,Verteilung,Grenzwert / µm,Divisor,Unsicherheitsbeitrag u_i / µm,Anteil\n"
        "Normal (KS 12; U = 0.8 µm; k = 2),Normal,0.8,2,0.400,64 %\nDrift des Normals,Rechteck,0.3,√3,0.173,12 %\n"
        "Auflösung,Rechteck,0.5,√3,0.289,33 %\nu_c,,,,0.523,\nErweiterte Messunsicherheit U / µm (k = 2),,,,1.05,\n");
    ASSERT_EQ(report.results.size(), 1U);
    EXPECT_EQ(report.subject.budgets[0].rows.size(), 3U);
    EXPECT_EQ(report.subject.budgets[0].unit, "µm");
    EXPECT_EQ(critical_of(report), "");
}

TEST(Heads, OfBothTypesBesideEachOther) {
    const std::string rows =
                          "Reference detector,,0.30\nWavelength,,0.20\nRepeatability,0.40,\nAmplifier gain,0.05,0.10\n",
                      claims = "Combined standard uncertainty,,0.55\nExpanded uncertainty (k = 2),,1.10\n";
    const double u_c = root_of_squares({0.3, 0.2, 0.4, 0.05, 0.1});
    for (const char* heads :
         {"Source of uncertainty,Type A (%),Type B (%)", "Uncertainty component,u (Type A) / %,u (Type B) / %",
          "Component,Standard uncertainty Type A / %,Standard uncertainty Type B / %",
          "Component,Standard uncertainty (A) %,Standard uncertainty (B) %",
          "Component,Beitrag Typ A in %,Beitrag Typ B in %"}) {
        for (const char* sums : {"", "Quadratic sum,0.403,0.387\n", "Combined standard uncertainty,0.40,0.39\n"}) {
            const AuditReport report =
                audit_of_sums(std::string("Spectral responsivity\n") + heads + "\n" + rows + sums + claims);
            SCOPED_TRACE(std::string(heads) + sums);
            ASSERT_EQ(report.results.size(), 1U);
            const AuditedBudget& budget = report.subject.budgets[0];
            EXPECT_EQ(budget.unit, "%");
            ASSERT_EQ(budget.rows.size(), 5U);
            EXPECT_EQ(budget.rows[0].type_a, false);
            EXPECT_EQ(budget.rows[2].type_a, true);
            EXPECT_NEAR(report.results[0].recomputed.u_c, u_c, 1e-9);
            EXPECT_EQ(critical_of(report), "");
        }
    }
}

TEST(Units, KeepTheirDotsBehindANumber) {
    const std::string heads = "Air density\nQuantity,Unit,u,Sensitivity,Contribution\n",
                      rest = "Pressure,hPa,0.30,1.18 g/(m³·hPa),0.354 g/m³\nFormula,g/m³,0.026,1,0.026 g/m³\n";
    const AuditReport sound = audit_of_sums(heads + "Temperature,K,0.10,-4.1 g/(m³·K),-0.41 g/m³\n" + rest +
                                            "u_c,g/m³,,,0.542\nk,,,,2\nU,g/m³,,,1.08\n");
    ASSERT_EQ(sound.results.size(), 1U);
    EXPECT_EQ(critical_of(sound), "");
    EXPECT_EQ(sound.subject.budgets[0].rows[0].sensitivity_unit, "g/(m³·K)");
    const AuditReport planted = audit_of_sums(heads + "Temperature,K,0.10,-4.1 g/(m³·hPa),-0.41 g/m³\n" + rest +
                                              "u_c,g/m³,,,0.542\nk,,,,2\nU,g/m³,,,1.08\n");
    EXPECT_NE(first_of(planted, "S01"), nullptr);
}

/// The last factor of a product is in another unit than the result that is stated, whatever its u is the root of.
TEST(SumRows, AskOfNoRowOfAnotherKindThanTheValue) {
    const AuditReport report = audit_of_sums(
        "Quantity,Value,Unit,Standard uncertainty\nTitrant,0.1000,mol/L,0.0002\nVolume used,20.00,mL,0.02\n"
        "Aliquot,10.00,mL,0.03\nResult,0.2000,mol/L,\nCombined standard uncertainty,,mol/L,0.000748\n"
        "Expanded uncertainty (k = 2),,mol/L,0.0015\n");
    EXPECT_FALSE(leaves_unread(report, "may be the result"));
    EXPECT_TRUE(leaves_unread(report, "c = y/x is taken for each"));
    EXPECT_EQ(first_of(report, "K01"), nullptr);
}

/// A last row of one digit is u_c of the rows above it within that digit, and may be a row as well: what it is taken for is said.
TEST(SumRows, SayWhatALastRowOfOneDigitIsTakenFor) {
    const auto with = [](const std::string& last) {
        return audit_of_sums(
            "Quantity,Value,Unit,Standard uncertainty\nIndication,100,V,0.03\nDrift,0,V,0.065\nLast,100,V," + last +
            "\nCombined standard uncertainty,0.07159,V,\n");
    };
    EXPECT_TRUE(leaves_unread(with("0.1"), "\"Last\" is taken for u_c of the rows above it"));
    EXPECT_FALSE(leaves_unread(with("0.072"), "is taken for"));
    EXPECT_NE(first_of(with("0.100"), "K01"), nullptr) << "with more digits it is a row that was left out";
}

}  // namespace
}  // namespace gumcert::audit
