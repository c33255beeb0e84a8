// For rules of worksheets: sheets with formulas that fire, and what must not.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "audit/audit.h"
#include "audit/budget_outcome.h"
#include "audit/rules/registry.h"
#include "audit/tables/workbook_subject.h"
#include "tests/support/workbook_of.h"

namespace gumcert::audit {
namespace {

/// A budget of two rows with formulas; contents of some cells are replaced.
AuditReport audited_sheet(const test::Contents& replaced) {
    test::Contents contents = {{"A1", "quantity"},
                               {"B1", "U or a"},
                               {"C1", "divisor"},
                               {"D1", "distribution"},
                               {"E1", "u"},
                               {"A2", "standard"},
                               {"B2", "0.05"},
                               {"C2", "2"},
                               {"D2", "normal"},
                               {"E2", "=B2/C2"},
                               {"A3", "drift of the standard"},
                               {"B3", "0.04"},
                               {"C3", "=SQRT(3)"},
                               {"D3", "rectangular"},
                               {"E3", "=B3/C3"},
                               {"A4", "buoyancy"},
                               {"B4", "0.03"},
                               {"C4", "=SQRT(3)"},
                               {"D4", "rectangular"},
                               {"E4", "=B4/C4"},
                               {"A6", "u_c"},
                               {"B6", "=SQRT(SUMSQ(E2:E4))"},
                               {"A7", "k"},
                               {"B7", "2"},
                               {"A8", "U"},
                               {"B8", "=B7*B6"}};
    for (const auto& [address, content] : replaced) {
        for (auto& [at, held] : contents) {
            held = at == address ? content : held;
        }
    }
    return audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules());
}
std::vector<AuditFinding> of_rule(const AuditReport& report, std::string_view rule) {
    std::vector<AuditFinding> found = report.findings;
    std::erase_if(found, [rule](const AuditFinding& finding) { return finding.rule != rule; });
    return found;
}

TEST(WorksheetFindings, W04SeesADeviationOverN) {
    const auto found = [](const std::string& name, const std::string& u, const std::string& label,
                          const std::string& nu) {
        const test::Contents contents = {{"A1", "quantity"}, {"B1", "u"},     {"C1", "sensitivity"},
                                         {"D1", "nu"},       {"F1", label},   {"G1", "0.012"},
                                         {"A2", "standard"}, {"B2", "0.001"}, {"C2", "1"},
                                         {"D2", "inf"},      {"F2", "n"},     {"G2", "10"},
                                         {"A3", name},       {"B3", u},       {"C3", "1"},
                                         {"D3", nu},         {"A4", "u_c"},   {"B4", "=SQRT(SUMSQ(B2:B3))"},
                                         {"A5", "k"},        {"B5", "2"},     {"A6", "U"},
                                         {"B6", "=B5*B4"}};
        return of_rule(audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules()), "W04");
    };
    const std::string row = "Repeatability, mean of 10 readings", label = "s of 10 readings";
    for (const char* const nu : {"9", ""}) {
        for (const char* const u : {"=G1/G2", "=G1/10"}) {
            const std::vector<AuditFinding> findings = found(row, u, label, nu);
            ASSERT_EQ(findings.size(), 1U) << u;
            ASSERT_TRUE(findings[0].effect) << u;
            EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(0.012 / std::sqrt(10.0), 0.001), 1e-12) << u;
        }
    }
    for (const char* const u : {"=G1/SQRT(G2)", "=G1/10^0.5", "=G1", "=G1/2"}) {
        EXPECT_TRUE(found(row, u, label, "9").empty()) << u;
    }
    EXPECT_TRUE(found(row, "=G1/G2", "sum of the deviations", "9").empty());
    EXPECT_TRUE(found(row, "=G1/G2", "standard deviation of the mean", "9").empty());
    for (const char* const other : {"differences of both readings", "half range of readings of the scale",
                                    "standard deviation, average of 10 readings", "mass of 10 sheets"}) {
        EXPECT_TRUE(found(row, "=G1/G2", other, "9").empty()) << other;
    }
    EXPECT_TRUE(found("Repeatability", "=G1/10", label, "4").empty()) << "ten of what?";
    // s of a stack over its sheets is that of one sheet: asked, and not corrected.
    for (const char* const pieces :
         {"Thickness of a sheet, stack of 10 sheets, 10 readings", "Period, 10 swings, mean of 10 readings"}) {
        const std::vector<AuditFinding> findings = found(pieces, "=G1/10", label, "9");
        ASSERT_EQ(findings.size(), 1U) << pieces;
        EXPECT_EQ(findings[0].severity, FindingSeverity::minor) << pieces;
        EXPECT_FALSE(findings[0].effect) << pieces;
    }
    EXPECT_TRUE(found("Sheet, 10 readings", "=G1/10", label, "9").at(0).effect);
}

/// n of s/√n counts what stands above or below the readings as well.
TEST(WorksheetFindings, W04SeesACountBeyondTheReadings) {
    const auto found = [](const std::string& u) {
        const test::Contents contents = {{"A1", "quantity"},
                                         {"B1", "u"},
                                         {"C1", "sensitivity"},
                                         {"D1", "nu"},
                                         {"F1", "readings"},
                                         {"A2", "standard"},
                                         {"B2", "0.001"},
                                         {"C2", "1"},
                                         {"D2", "inf"},
                                         {"F2", "10.02"},
                                         {"A3", "readings"},
                                         {"B3", u},
                                         {"C3", "1"},
                                         {"D3", "3"},
                                         {"F3", "10.04"},
                                         {"A4", "u_c"},
                                         {"B4", "=SQRT(SUMSQ(B2:B3))"},
                                         {"F4", "10.03"},
                                         {"A5", "k"},
                                         {"B5", "2"},
                                         {"F5", "10.05"},
                                         {"A6", "U"},
                                         {"B6", "=B5*B4"},
                                         {"F6", "=AVERAGE(F2:F5)"},
                                         {"F7", "=STDEV(F2:F5)"}};
        return of_rule(audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules()), "W04");
    };
    for (const char* const u :
         {"=F7/SQRT(COUNT(F2:F7))", "=STDEV(F2:F5)/SQRT(COUNT(F2:F6))", "=F7/SQRT(COUNTA(F1:F5))"}) {
        const std::vector<AuditFinding> findings = found(u);
        ASSERT_EQ(findings.size(), 1U) << u;
        ASSERT_TRUE(findings[0].effect) << u;
        const double s = std::sqrt(5e-4 / 3.0);
        EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(s / 2.0, 0.001), 1e-9) << u;
    }
    for (const char* const u : {"=F7/SQRT(COUNT(F2:F5))", "=F7/SQRT(COUNTA(F2:F5))", "=F7/SQRT(3)", "=F7",
                                "=STDEV(F2:F4)/SQRT(COUNT(F2:F5))"}) {  // s of earlier readings, and the mean of all
        EXPECT_TRUE(found(u).empty()) << u;
    }
}

TEST(WorksheetFindings, W12TellsOfWhatIsHiddenInTheSum) {
    const auto found = [](std::vector<workbook::Span> rows, std::vector<workbook::Span> columns) {
        workbook::Workbook made = test::workbook_of({{"A1", "quantity"},
                                                     {"B1", "u"},
                                                     {"D1", "sensitivity"},
                                                     {"A2", "standard"},
                                                     {"B2", "0.05"},
                                                     {"D2", "1"},
                                                     {"A3", "drift"},
                                                     {"B3", "0.04"},
                                                     {"D3", "1"},
                                                     {"A4", "u_c"},
                                                     {"B4", "=SQRT(SUMSQ(B2:B3))"},
                                                     {"A5", "k"},
                                                     {"B5", "2"},
                                                     {"A6", "U"},
                                                     {"B6", "=B5*B4"},
                                                     {"F8", "1"}});
        made.sheets[0].hidden_rows = std::move(rows);
        made.sheets[0].hidden_columns = std::move(columns);
        std::string where;
        for (const AuditFinding& one : of_rule(audit(subject_of(std::move(made), "b.xlsx"), all_rules()), "W12")) {
            EXPECT_EQ(one.severity, FindingSeverity::minor);
            where += one.where + ";";
        }
        return where;
    };
    EXPECT_EQ(found({}, {}), "");
    EXPECT_EQ(found({{.first = 3, .last = 3}}, {}), "Sheet1!B3;");
    EXPECT_EQ(found({{.first = 2, .last = 3}}, {}), "Sheet1!B2;") << "told once a sheet";
    EXPECT_EQ(found({}, {{.first = 2, .last = 2}}), "Sheet1!B2;");
    EXPECT_EQ(found({{.first = 7, .last = 9}}, {{.first = 6, .last = 6}}), "") << "not under the result";
}

TEST(WorksheetFindings, W12IsCriticalWhereAResultIsAnError) {
    EXPECT_TRUE(of_rule(audited_sheet({}), "W12").empty());
    // Wherever the error begins, it reaches U, which the file then does not claim.
    for (const char* const address : {"B2", "E3", "B6", "B7", "B8"}) {
        for (const char* const error : {"#REF!", "=#REF!*2", "=1/0"}) {
            const AuditReport report = audited_sheet({{address, error}});
            const std::vector<AuditFinding> errors = of_rule(report, "W12");
            ASSERT_EQ(errors.size(), 1U) << address << " " << error;
            EXPECT_EQ(errors[0].severity, FindingSeverity::critical) << address << " " << error;
            for (const AuditFinding& unused : of_rule(report, "W14")) {  // of what the error reads no longer
                EXPECT_FALSE(unused.where == "Sheet1!B6" || unused.where == "Sheet1!B8") << address << " " << error;
            }
            const Claims& claims = report.subject.budgets.at(0).claims;
            EXPECT_FALSE(claims.U) << address;
            EXPECT_EQ(claims.broken.U, "Sheet1!B8") << address << " " << error;
            EXPECT_EQ(claims.broken.k.empty(), address != std::string("B7")) << address;
        }
    }
    const std::vector<AuditFinding> elsewhere = of_rule(audited_sheet({{"A4", "=1/0"}}), "W12");
    ASSERT_EQ(elsewhere.size(), 1U);
    EXPECT_EQ(elsewhere[0].severity, FindingSeverity::minor);
}

TEST(WorksheetFindings, W05SeesTheNumberOfAnotherRow) {
    const AuditReport sound = audited_sheet({});
    EXPECT_TRUE(of_rule(sound, "W05").empty());
    const double U = sound.results.at(0).claimed.U;
    // u of one row from what another one divides, however it is addressed: corrected by its own number.
    for (const auto& [address, formula] :
         test::Contents{{"E3", "=$B$2/C3"}, {"E3", "=B2/C3"}, {"E4", "=$B$2/C4"}, {"E4", "=E3"}, {"E2", "=B$3/C2"}}) {
        const AuditReport report = audited_sheet({{address, formula}});
        const std::vector<AuditFinding> found = of_rule(report, "W05");
        ASSERT_EQ(found.size(), 1U) << address << formula;
        EXPECT_TRUE(of_rule(report, "U26").empty()) << "told already";
        ASSERT_TRUE(found[0].effect);
        EXPECT_NEAR(found[0].effect->alone.U, U, 1e-12) << address << formula;
    }
    // A number of another row that is passed on counts twice; one that is computed with is another number.
    EXPECT_EQ(of_rule(audited_sheet({{"B3", "=$B$2"}}), "W05").size(), 1U);
    for (const auto& [address, formula] :
         test::Contents{{"B3", "=0.1*$B$2"}, {"B3", "=B2"}, {"E3", "=(B3+0*$B$2)/C3"}, {"E3", "=B3/C$4"}}) {
        EXPECT_TRUE(of_rule(audited_sheet({{address, formula}}), "W05").empty()) << address << formula;
    }
}

TEST(WorksheetFindings, TwoFindingsOfOneCellCorrectItOnce) {
    // s of six readings over √10: U03 reads it of the row, W04 of the formula. Right: over √6.
    const test::Contents contents = {{"A1", "quantity"},
                                     {"B1", "U or a"},
                                     {"C1", "divisor"},
                                     {"D1", "distribution"},
                                     {"E1", "u"},
                                     {"F1", "nu"},
                                     {"G1", "comment"},
                                     {"A2", "standard"},
                                     {"B2", "1.2"},
                                     {"C2", "2"},
                                     {"D2", "normal"},
                                     {"E2", "=B2/C2"},
                                     {"I2", "1"},
                                     {"A3", "repeatability"},
                                     {"B3", "=STDEV.S(I2:I7)"},
                                     {"C3", "=SQRT(10)"},
                                     {"D3", "normal"},
                                     {"E3", "=B3/C3"},
                                     {"F3", "5"},
                                     {"G3", "s; mean of 6 readings"},
                                     {"I3", "3"},
                                     {"I4", "2"},
                                     {"I5", "5"},
                                     {"I6", "4"},
                                     {"I7", "6"},
                                     {"A9", "u_c"},
                                     {"B9", "=SQRT(SUMSQ(E2:E3))"},
                                     {"A10", "k"},
                                     {"B10", "2"},
                                     {"A11", "U"},
                                     {"B11", "=B9*B10"}};
    const AuditReport report = audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules());
    EXPECT_EQ(of_rule(report, "U03").size(), 1U);
    EXPECT_EQ(of_rule(report, "W04").size(), 1U);
    EXPECT_NEAR(report.results.at(0).audited.u_c, std::sqrt(0.36 + 3.5 / 6.0), 1e-9);
}

/// What k is made of in a sheet: its cell is exact, whether a formula, a rounded formula or a typed number stands there.
TEST(WorksheetFindings, KOfNuIsTakenFromNuWhateverItsCellHolds) {
    const auto audited = [](double s, double nu, const std::string& k) {
        return audit(subject_of(test::workbook_of({{"A1", "quantity"},
                                                   {"B1", "U or a"},
                                                   {"C1", "divisor"},
                                                   {"D1", "distribution"},
                                                   {"E1", "u"},
                                                   {"F1", "nu"},
                                                   {"A2", "standard"},
                                                   {"B2", "1.2"},
                                                   {"C2", "2"},
                                                   {"D2", "normal"},
                                                   {"E2", "=B2/C2"},
                                                   {"A3", "repeatability"},
                                                   {"B3", std::to_string(s)},
                                                   {"C3", "1"},
                                                   {"D3", "normal"},
                                                   {"E3", "=B3/C3"},
                                                   {"F3", std::to_string(nu)},
                                                   {"A9", "u_c"},
                                                   {"B9", "=SQRT(SUMSQ(E2:E3))"},
                                                   {"A10", "nu_eff"},
                                                   {"B10", "=B9^4/(E3^4/F3)"},
                                                   {"A11", "k"},
                                                   {"B11", k},
                                                   {"A12", "U"},
                                                   {"B12", "=B9*B11"}}),
                                "b.xlsx"),
                     all_rules())
            .subject.budgets.at(0);
    };
    for (const double s : {0.5, 0.9, 1.7}) {
        for (const double nu : {3.0, 5.0, 9.0}) {
            for (const char* const p : {"0.0455", "0.05"}) {
                const std::string factor = std::string("T.INV.2T(") + p + ",INT(B10))";
                for (const std::string& formula : {factor, "ROUND(" + factor + ",2)", "ROUND(" + factor + ",3)"}) {
                    const AuditedBudget budget = audited(s, nu, "=" + formula);
                    EXPECT_EQ(budget.coverage.kind, CoverageRule::Kind::student_t) << s << " " << nu << " " << formula;
                    EXPECT_EQ(budget.k_over_rows, 1.0);
                    EXPECT_EQ(budget.U_over_k_u_c, 1.0);
                    EXPECT_NEAR(evaluate(budget).U / budget.claims.U->value, 1.0, 0.003) << formula;
                }
            }
            // A k for all budgets stays.
            EXPECT_EQ(audited(s, nu, "2").coverage.kind, CoverageRule::Kind::fixed);
        }
    }
    for (const char* const typed : {"2.27", "2.28", "2.22", "2.23", "2.216"}) {  // 95.45 % or 95 % of 10.43 or 10
        EXPECT_EQ(audited(0.9, 5.0, typed).coverage.kind, CoverageRule::Kind::student_t) << typed;
    }
    EXPECT_EQ(audited(0.9, 5.0, "2.25").coverage.kind, CoverageRule::Kind::fixed);
    EXPECT_EQ(audited(0.9, 5.0, "2.4").coverage.kind, CoverageRule::Kind::fixed);
}

TEST(WorksheetFindings, W13SeesDaysHoweverTheyAreCounted) {
    const auto found = [](const std::string& formula, const std::string& label) {
        test::Contents contents = {{"A1", "quantity"},
                                   {"B1", "U or a"},
                                   {"C1", "divisor"},
                                   {"D1", "distribution"},
                                   {"E1", "u"},
                                   {"A2", "standard"},
                                   {"B2", "0.05"},
                                   {"C2", "2"},
                                   {"D2", "normal"},
                                   {"E2", "=B2/C2"},
                                   {"A3", "drift"},
                                   {"B3", formula},
                                   {"C3", "=SQRT(3)"},
                                   {"D3", "rectangular"},
                                   {"E3", "=B3/C3"},
                                   {"A6", "u_c"},
                                   {"B6", "=SQRT(SUMSQ(E2:E3))"}};
        workbook::Workbook made = test::workbook_of(contents);
        made.sheets.push_back(test::sheet_of("Drift", {{"A1", label},
                                                       {"B1", "0.02"},
                                                       {"A2", "calibrated"},
                                                       {"B2", "45000"},
                                                       {"A3", "used"},
                                                       {"B3", "45200"},
                                                       {"A4", "length"},
                                                       {"B4", "300"},
                                                       {"A5", "part"},
                                                       {"B5", "100"}}));
        return of_rule(audit(subject_of(std::move(made), "b.xlsx"), all_rules()), "W13").size();
    };
    for (const char* const days : {"(Drift!B3-Drift!B2)", "DAYS(Drift!B3,Drift!B2)", "(Drift!B3-DATE(2023,3,15))"}) {
        const std::string rate = std::string("=Drift!B1*") + days;
        EXPECT_EQ(found(rate + "/12", "rate in mg per year"), 1U) << days;
        EXPECT_EQ(found(rate + "/12/2", "rate in mg per year"), 1U) << days;
        EXPECT_EQ(found(rate + "/365", "rate in mg per year"), 0U) << days;
        EXPECT_EQ(found(rate + "/365.25/2", "rate in mg per year"), 0U) << days;
        EXPECT_EQ(found(rate + "/12", "rate in mg per month"), 0U) << days;
    }
    EXPECT_EQ(found("=Drift!B1*(Drift!B4-Drift!B5)/12", "rate in mg per year"), 0U) << "no days";
}

TEST(WorksheetFindings, W02SeesWhatAFormulaHasDivided) {
    // The law: however a formula divides by the divisor of its distribution, 1 beside it is right.
    for (const char* const formula : {"=0.04/SQRT(3)", "=0.04/3^0.5", "=0.04*1/SQRT(3)", "=0.04/1.732",
                                      "=0.08/2/SQRT(3)", "=0.08/SQRT(12)", "=SQRT(0.04^2/3)", "=B4*4/3/SQRT(3)"}) {
        EXPECT_TRUE(of_rule(audited_sheet({{"B3", formula}, {"C3", "1"}}), "W02").empty()) << formula;
    }
    EXPECT_EQ(of_rule(audited_sheet({{"B3", "0.04"}, {"C3", "1"}}), "W02").size(), 1U);
    EXPECT_EQ(of_rule(audited_sheet({{"B3", "=0.08/2"}, {"C3", "1"}}), "W02").size(), 1U);
    // Divided once more by something else: what the formula gives is u.
    const std::vector<AuditFinding> twice = of_rule(audited_sheet({{"B3", "=0.04/SQRT(3)"}, {"C3", "2"}}), "W02");
    ASSERT_EQ(twice.size(), 1U);
    ASSERT_TRUE(twice[0].effect);
    EXPECT_NEAR(twice[0].effect->alone.u_c, std::sqrt(0.025 * 0.025 + 0.04 * 0.04 / 3.0 + 0.03 * 0.03 / 3.0), 1e-12);
}

/// A row of six readings on the same sheet, of which the budget has a number.
std::vector<AuditFinding> u03_of(const std::string& stated, const std::string& divisor, const std::string& distribution,
                                 const std::string& comment = "mean of 6 readings") {
    const test::Contents contents = {{"A1", "quantity"},      {"B1", "U or a"}, {"C1", "divisor"},
                                     {"D1", "distribution"},  {"E1", "u"},      {"F1", "comment"},
                                     {"A2", "standard"},      {"B2", "0.05"},   {"C2", "2"},
                                     {"D2", "normal"},        {"E2", "=B2/C2"}, {"J2", "50.03"},
                                     {"A3", "repeatability"}, {"B3", stated},   {"C3", divisor},
                                     {"D3", distribution},    {"E3", "=B3/C3"}, {"F3", comment},
                                     {"J3", "50.04"},         {"A4", "u_c"},    {"B4", "=SQRT(SUMSQ(E2:E3))"},
                                     {"J4", "50.03"},         {"A5", "k"},      {"B5", "2"},
                                     {"J5", "50.02"},         {"A6", "U"},      {"B6", "=B5*B4"},
                                     {"J6", "50.03"},         {"J7", "50.04"},  {"J8", "=STDEV(J2:J7)/SQRT(6)"}};
    return of_rule(audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules()), "U03");
}

TEST(WorksheetFindings, U03SeesWhatAFormulaHasDivided) {
    for (const char* const stated : {"=STDEV.S(J2:J7)/SQRT(COUNT(J2:J7))", "=STDEV.S(J2:J7)/SQRT(6)",
                                     "=SQRT(VAR.S(J2:J7)/6)", "=STDEV(J2:J7)/6^0.5", "=STDEV(J2:J7)/2.449",
                                     "=SQRT(VAR(J2:J7)/COUNT(J2:J7))", "=J8", "=STDEV(J2:J7)*SQRT(1/6)"}) {
        EXPECT_TRUE(u03_of(stated, "1", "normal").empty()) << stated;
    }
    for (const char* const divisor : {"=SQRT(12)", "=2*SQRT(3)", "=SQRT(3)"}) {
        EXPECT_TRUE(u03_of("=MAX(J2:J7)-MIN(J2:J7)", divisor, "rectangular").empty()) << divisor;
    }
    EXPECT_TRUE(u03_of("=MAX(J2:J7)-MIN(J2:J7)", "=SQRT(12)", "normal").empty());
    EXPECT_EQ(u03_of("=STDEV(J2:J7)", "1", "normal").size(), 1U);
    EXPECT_EQ(u03_of("=STDEV(J2:J7)", "=SQRT(12)", "rectangular").size(), 1U);
}

TEST(WorksheetFindings, W14LeavesSharesAlone) {
    const auto unused = [](const std::string& head) {
        const test::Contents contents = {{"A1", "quantity"},
                                         {"B1", "U or a"},
                                         {"C1", "divisor"},
                                         {"D1", "u"},
                                         {"E1", head},
                                         {"A2", "standard"},
                                         {"B2", "0.05"},
                                         {"C2", "2"},
                                         {"D2", "=B2/C2"},
                                         {"E2", "=100*D2^2/B4^2"},
                                         {"A3", "Drift of the standard"},
                                         {"B3", "0.04"},
                                         {"C3", "=SQRT(3)"},
                                         {"D3", "=B3/C3"},
                                         {"E3", "=100*D3^2/B4^2"},
                                         {"A4", "u_c"},
                                         {"B4", "=SQRT(SUMSQ(D2:D3))"},
                                         {"A5", "k"},
                                         {"B5", "2"},
                                         {"A6", "U"},
                                         {"B6", "=B5*B4"}};
        return of_rule(audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules()), "W14").size();
    };
    for (const char* const head : {"Anteil / %", "share", "Varianzanteil", "u^2", "rank", "Index / %", "remark"}) {
        EXPECT_EQ(unused(head), 0U) << head;
    }
    EXPECT_GE(unused("correction"), 1U);
}

TEST(WorksheetFindings, W14LeavesWhatAPageOfResultsShowsAlone) {
    const auto unused = [](const std::string& name, const std::string& formula) {
        const test::Contents contents = {{"A1", "quantity"}, {"B1", "U or a"},
                                         {"C1", "divisor"},  {"D1", "u"},
                                         {"A2", "standard"}, {"B2", "0.05"},
                                         {"C2", "2"},        {"D2", "=B2/C2"},
                                         {"A3", "Drift"},    {"B3", "0.04"},
                                         {"C3", "=SQRT(3)"}, {"D3", "=B3/C3"},
                                         {"A4", "u_c"},      {"B4", "=SQRT(SUMSQ(D2:D3))"},
                                         {"A5", "k"},        {"B5", "2"},
                                         {"A6", "U"},        {"B6", "=B5*B4"},
                                         {"A9", name},       {"B9", formula}};
        return of_rule(audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules()), "W14").size();
    };
    EXPECT_EQ(unused("Expanded uncertainty (certificate)", "=ROUND(B6;3)"), 0U);
    EXPECT_EQ(unused("Uncertainty on the certificate", "=B6*1000"), 0U);
    EXPECT_EQ(unused("Uncertainty of the buoyancy", "=B3/SQRT(3)"), 1U);
    EXPECT_EQ(unused("Drift since the last calibration", "=B6-B3"), 1U);
    // k is in no result of its own.
    EXPECT_EQ(unused("Uncertainty of the thermometer", "=0.3/B5"), 1U);
}

/// The readings stand in I2 to I6; k, u_c and the cells of the repeatability as given.
AuditReport with_readings(const std::string& s, const std::string& divisor, const std::string& nu, const std::string& k,
                          const std::string& u_c, const std::string& comment = "s; mean of 5 readings") {
    test::Contents contents = {{"A1", "quantity"},
                               {"B1", "U or a"},
                               {"C1", "divisor"},
                               {"D1", "distribution"},
                               {"E1", "u"},
                               {"F1", "c"},
                               {"G1", "contribution"},
                               {"H1", "nu"},
                               {"J1", "comment"},
                               {"A2", "standard"},
                               {"B2", "0.6"},
                               {"C2", "2"},
                               {"D2", "normal"},
                               {"E2", "=B2/C2"},
                               {"F2", "1"},
                               {"G2", "=E2*F2"},
                               {"I2", "1"},
                               {"A3", "repeatability"},
                               {"B3", s},
                               {"C3", divisor},
                               {"D3", "normal"},
                               {"E3", "=B3/C3"},
                               {"F3", "1"},
                               {"G3", "=E3*F3"},
                               {"H3", nu},
                               {"I3", "3"},
                               {"J3", comment},
                               {"I4", "2"},
                               {"I5", "5"},
                               {"I6", "4"},
                               {"L2", "1"},
                               {"M2", "13.97"},
                               {"L3", "2"},
                               {"M3", "4.53"},
                               {"L4", "5"},
                               {"M4", "2.65"},
                               {"L5", "8"},
                               {"M5", "2.37"},
                               {"L6", "20"},
                               {"M6", "2.13"},
                               {"A9", "u_c"},
                               {"B9", u_c},
                               {"A10", "nu_eff"},
                               {"B10", "=B9^4/(G3^4/H3)"},
                               {"A11", "k"},
                               {"B11", k},
                               {"A12", "U"},
                               {"B12", "=B9*B11"}};
    std::sort(contents.begin(), contents.end(), [](const auto& a, const auto& b) {
        return *workbook::read_a1(a.first) < *workbook::read_a1(b.first);  // row by row
    });
    return audit(subject_of(test::workbook_of(contents), "b.xlsx"), all_rules());
}
constexpr const char* k_sum = "=SQRT(SUMSQ(G2:G3))";

/// The law: a k that a sheet computes with ν_eff, by a table or by parts, is for every corrected budget what the sheet would show.
TEST(WorksheetFindings, AKOfTheSheetIsAskedOfTheSheet) {
    const double s = std::sqrt(2.5), u_c = std::sqrt(0.09 + 0.5), nu = 4.0 * std::pow(u_c, 4) / 0.25;
    for (const auto& [k, right] :
         std::vector<std::pair<std::string, double>>{{"=VLOOKUP(B10,L2:M6,2,TRUE)", 2.65},
                                                     {"=INDEX(M2:M6,MATCH(B10,L2:L6,1))", 2.65},
                                                     {"=IF(B10>5,2,T.INV.2T(0.0455,B10))", 2.0},
                                                     {"=IF(B10<5,3,IF(B10<7,2.4,2))", 2.4}}) {
        // Undivided, ν_eff is 4.3; divided by √5, it is 5.6.
        const AuditReport report = with_readings("=STDEV.S(I2:I6)", "1", "4", k, k_sum);
        ASSERT_EQ(of_rule(report, "U03").size(), 1U) << k;
        const AuditedResult& result = report.results.at(0);
        EXPECT_NEAR(result.claimed.u_c, std::sqrt(0.09 + s * s), 1e-9);
        EXPECT_NEAR(result.audited.nu_eff, nu, 1e-6);
        EXPECT_NEAR(of_rule(report, "U03")[0].effect->alone.k, right, 1e-9) << k;
        EXPECT_TRUE(report.subject.budgets.at(0).coverage.k_of_nu) << k;
    }
    // t_p(ν_eff), rounded or cut, is the t-distribution, and a number that is typed stays.
    for (const char* const k : {"=T.INV.2T(0.0455,B10)", "=ROUND(T.INV.2T(0.05,INT(B10)),2)", "2"}) {
        EXPECT_FALSE(with_readings("=STDEV.S(I2:I6)", "=SQRT(5)", "4", k, k_sum).subject.budgets.at(0).coverage.k_of_nu)
            << k;
    }
}

TEST(WorksheetFindings, W04SeesDeviationsDividedByN) {
    const double s = std::sqrt(2.5), right = std::sqrt(0.09 + s * s / 5.0);
    for (const auto& [formula, divisor] : test::Contents{
             {"=STDEV.P(I2:I6)", "=SQRT(5)"}, {"=STDEVP(I2:I6)/SQRT(5)", "1"}, {"=SQRT(VAR.P(I2:I6))", "=SQRT(5)"}}) {
        const AuditReport report = with_readings(formula, divisor, "4", "2", k_sum);
        const std::vector<AuditFinding> found = of_rule(report, "W04");
        ASSERT_EQ(found.size(), 1U) << formula;
        ASSERT_TRUE(found[0].effect);
        EXPECT_NEAR(found[0].effect->alone.u_c, right, 1e-9) << formula;
    }
    for (const auto& [formula, divisor] : test::Contents{{"=STDEV.S(I2:I6)", "=SQRT(5)"},
                                                         {"=STDEV.P(I2:I6)", "=SQRT(5-1)"},
                                                         {"=STDEV.P(I2:I6)/SQRT(COUNT(I2:I6)-1)", "1"},
                                                         {"=SQRT(DEVSQ(I2:I6)/20)", "1"}}) {
        const AuditReport report = with_readings(formula, divisor, "4", "2", k_sum, "");
        EXPECT_TRUE(of_rule(report, "W04").empty()) << formula;
        EXPECT_NEAR(report.results.at(0).audited.u_c, right, 1e-9) << formula;
    }
    // s/sqrt(2) of two readings is what STDEV.P makes of them: it needs no divisor, and another one is wrong.
    EXPECT_TRUE(of_rule(with_readings("=STDEV.P(I2:I3)", "1", "1", "2", k_sum, ""), "W04").empty());
    EXPECT_EQ(of_rule(with_readings("=STDEV.P(I2:I3)", "=SQRT(2)", "1", "2", k_sum, ""), "W04").size(), 1U);
}

TEST(WorksheetFindings, NuIsOneLessThanTheReadings) {
    const AuditReport report = with_readings("=STDEV.S(I2:I6)", "=SQRT(5)", "5", "=T.INV.2T(0.0455,B10)", k_sum);
    const std::vector<AuditFinding> found = of_rule(report, "U02");
    ASSERT_EQ(found.size(), 1U);
    ASSERT_TRUE(found[0].effect);
    EXPECT_NEAR(found[0].effect->alone.nu_eff, found[0].effect->claimed.nu_eff * 0.8, 1e-9);
    EXPECT_FALSE(of_rule(with_readings("=STDEV.S(I2:I6)", "=SQRT(5)", "4", "2", k_sum), "U02")[0].effect);
    // Of a pooled s, five degrees of freedom beside five readings are a coincidence.
    for (const char* const words : {"s; mean of 5 readings; from an earlier study", "pooled s; mean of 5 readings"}) {
        const AuditReport pooled =
            with_readings("=STDEV.S(I2:I6)", "=SQRT(5)", "5", "=T.INV.2T(0.0455,B10)", k_sum, words);
        for (const AuditFinding& one : of_rule(pooled, "U02")) {
            EXPECT_FALSE(one.effect) << words;
        }
    }
}

TEST(WorksheetFindings, ContributionsMayBeShownAlone) {
    const auto unused = [](const std::string& u_c) {
        return of_rule(with_readings("=STDEV.S(I2:I6)", "=SQRT(5)", "4", "2", u_c), "W14").size();
    };
    EXPECT_EQ(unused("=SQRT(SUMPRODUCT(E2:E3^2,F2:F3^2))"), 0U);
    EXPECT_EQ(unused("=SQRT((E2*F2)^2+(E3*F3)^2)"), 0U);
    EXPECT_EQ(unused(k_sum), 0U);
}

}  // namespace
}  // namespace gumcert::audit
