#include "audit/tables/workbook_subject.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/rules/registry.h"
#include "tests/support/workbook_of.h"
#include "text/numbers.h"
#include "workbook/evaluate.h"
#include "workbook/read_csv.h"
#include "workbook/read_xlsx.h"

namespace gumcert::audit {
namespace {

std::string bytes_of(const std::string& file) {
    std::ifstream stream(std::string(GUMCERT_SOURCE_DIR) + "/" + file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

TEST(SubjectOfWorkbook, ATableOfValuesHasNoFormulas) {
    const AuditSubject subject =
        subject_of(workbook::read_csv("quantity,unit,u,sensitivity\na,um,0.3,1\nU,0.6,um\n", "b.csv", "b"), "b.csv");
    EXPECT_EQ(subject.kind, AuditSubject::Kind::table);
    EXPECT_EQ(subject.workbook, nullptr);
    ASSERT_EQ(subject.budgets.size(), 1U);
}

/// The workbook with thirteen planted patterns: each of them is found, in the cell where it was planted.
TEST(SubjectOfWorkbook, ThePlantedPatternsAreFoundWithTheirCells) {
    const std::string bytes = bytes_of("examples/audit/planted_workbook/planted.xlsx");
    ASSERT_FALSE(bytes.empty());
    const AuditReport report =
        audit(subject_of(workbook::read_xlsx(bytes, "planted.xlsx"), "planted.xlsx"), all_rules());
    EXPECT_EQ(report.subject.kind, AuditSubject::Kind::workbook);
    const auto found = [&report](const std::string& rule, const std::string& cell) {
        for (const AuditFinding& finding : report.findings) {
            if (finding.rule == rule && finding.where.find(cell) != std::string::npos) {
                return true;
            }
        }
        return false;
    };
    EXPECT_TRUE(found("W01", "Budget!E5"));
    EXPECT_TRUE(found("W02", "Budget!D3"));
    EXPECT_TRUE(found("W02", "Budget!D6"));
    EXPECT_TRUE(found("W03", "Budget!C3"));
    EXPECT_TRUE(found("W04", "Readings!B8"));
    EXPECT_TRUE(found("W04", "Budget!D8"));
    EXPECT_TRUE(found("W05", "Budget!C7"));
    EXPECT_TRUE(found("W06", "Readings!F6"));
    EXPECT_TRUE(found("W07", "Standards!B4"));
    EXPECT_TRUE(found("W08", "Standards!C5"));
    EXPECT_TRUE(found("W09", "Budget!A8"));
    EXPECT_TRUE(found("W10", "Budget!C15"));
    EXPECT_TRUE(found("W11", "Budget!C16"));
    EXPECT_TRUE(found("W12", "Old!A1"));
    EXPECT_TRUE(found("W13", "Budget!C3"));
}

TEST(SubjectOfWorkbook, RowsThatTheSumDoesNotReachAreNotInIt) {
    const std::string bytes = bytes_of("examples/audit/planted_workbook/planted.xlsx");
    const AuditSubject subject = subject_of(workbook::read_xlsx(bytes, "planted.xlsx"), "planted.xlsx");
    ASSERT_EQ(subject.budgets.size(), 1U);
    for (const AuditedRow& row : subject.budgets.front().rows) {
        EXPECT_EQ(row.in_sum, row.quantity != "repeatability") << row.quantity;
    }
}

/// A budget with ν_eff and a k that is rounded from it, or typed.
workbook::Workbook budget_with_nu(double scatter, const std::string& k) {
    workbook::Workbook made = test::workbook_of({{"A1", "quantity"},
                                                 {"B1", "U or a"},
                                                 {"C1", "divisor"},
                                                 {"D1", "distribution"},
                                                 {"E1", "u"},
                                                 {"F1", "nu"},
                                                 {"A2", "standard"},
                                                 {"B2", "0.05"},
                                                 {"C2", "2"},
                                                 {"D2", "normal"},
                                                 {"E2", "=B2/C2"},
                                                 {"A3", "repeatability"},
                                                 {"B3", text::shortest(scatter)},
                                                 {"C3", "1"},
                                                 {"D3", "normal"},
                                                 {"E3", "=B3/C3"},
                                                 {"F3", "4"},
                                                 {"A5", "u_c"},
                                                 {"B5", "=SQRT(SUMSQ(E2:E3))"},
                                                 {"A6", "nu_eff"},
                                                 {"B6", "=B5^4/(E3^4/F3)"},
                                                 {"A7", "k"},
                                                 {"B7", k},
                                                 {"A8", "U"},
                                                 {"B8", "=B7*B5"},
                                                 {"A9", "coverage probability"},
                                                 {"B9", "95.45 %"}});
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(made);
    for (const workbook::EvaluatedCell& cell : evaluation.cells) {
        made.sheets[cell.sheet].cells[cell.cell].value = cell.value;
    }
    return made;
}

/// The law: a k whose cell computes with ν_eff follows it, whatever it shows; one that is typed does not.
TEST(SubjectOfWorkbook, KFollowsNuWhereItsFormulaReadsIt) {
    for (const double scatter : {0.001, 0.004, 0.01, 0.02, 0.05}) {
        const AuditSubject following =
            subject_of(budget_with_nu(scatter, "=ROUND(T.INV.2T(1-0.9545,INT(B6)),2)"), "b.xlsx");
        ASSERT_EQ(following.budgets.size(), 1U);
        EXPECT_TRUE(following.budgets[0].claims.k_follows_nu);
        EXPECT_EQ(following.budgets[0].coverage.kind, CoverageRule::Kind::student_t) << scatter;
        for (const AuditFinding& finding : audit(following, all_rules()).findings) {
            EXPECT_FALSE(finding.rule == "K01" || finding.rule == "K02" || finding.rule == "K03")
                << scatter << " " << finding.what.english();
        }
        const AuditSubject typed = subject_of(budget_with_nu(scatter, "2"), "b.xlsx");
        EXPECT_FALSE(typed.budgets[0].claims.k_follows_nu);
        EXPECT_EQ(typed.budgets[0].coverage.kind, CoverageRule::Kind::fixed) << scatter;
    }
    const AuditSubject chosen = subject_of(budget_with_nu(0.001, "=ROUND(IF(F3<10,2,3),2)"), "b.xlsx");
    EXPECT_TRUE(chosen.budgets[0].claims.k_follows_nu) << "through the ν of a row";
}

/// The law: the readings of a row without ν are those of which its cell takes the standard deviation.
TEST(SubjectOfWorkbook, CountsTheReadingsOfAStandardDeviation) {
    const auto readings = [](const std::string& formula, const std::string& last) {
        const workbook::Workbook made = test::workbook_of({{"A1", "quantity"},
                                                           {"B1", "U or a"},
                                                           {"C1", "divisor"},
                                                           {"D1", "distribution"},
                                                           {"E1", "u"},
                                                           {"A2", "standard"},
                                                           {"B2", "0.05"},
                                                           {"C2", "2"},
                                                           {"D2", "normal"},
                                                           {"E2", "=B2/C2"},
                                                           {"J2", "1.001"},
                                                           {"K2", "=STDEV(J2:J5)"},
                                                           {"A3", "repeatability"},
                                                           {"B3", formula},
                                                           {"C3", "1"},
                                                           {"D3", "normal"},
                                                           {"E3", "=B3/C3"},
                                                           {"J3", "1.003"},
                                                           {"J4", "1.002"},
                                                           {"A5", "u_c"},
                                                           {"B5", "=SQRT(SUMSQ(E2:E3))"},
                                                           {"J5", last}});
        const AuditSubject subject = subject_of(made, "b.xlsx");
        return subject.budgets.empty() ? std::nullopt : subject.budgets[0].rows.at(1).n;
    };
    EXPECT_EQ(readings("=STDEV(J2:J5)", "1.004"), 4U);
    EXPECT_EQ(readings("=STDEV(J2:J5)", "not read"), 3U);
    EXPECT_EQ(readings("=STDEV.S(J2:J5)/SQRT(COUNT(J2:J5))", "1.004"), 4U);
    EXPECT_EQ(readings("=K2", "1.004"), 4U) << "handed on";
    EXPECT_EQ(readings("=STDEV(J2:J5)*J2", "1.004"), std::nullopt) << "something else is in it";
    EXPECT_EQ(readings("=MAX(J2:J5)-MIN(J2:J5)", "1.004"), std::nullopt);
    EXPECT_EQ(readings("0.001", "1.004"), std::nullopt);
}

/// A small budget with formulas, all of whose computed values are stored.
workbook::Workbook stored_budget() {
    workbook::Workbook made = test::workbook_of({{"A1", "quantity"},    {"B1", "U or a"},
                                                 {"C1", "divisor"},     {"D1", "distribution"},
                                                 {"E1", "u"},           {"A2", "standard"},
                                                 {"B2", "0.05"},        {"C2", "2"},
                                                 {"D2", "normal"},      {"E2", "=B2/C2"},
                                                 {"A3", "limit"},       {"B3", "0.04"},
                                                 {"C3", "=SQRT(3)"},    {"D3", "rectangular"},
                                                 {"E3", "=B3/C3"},      {"A4", "nothing"},
                                                 {"B4", "0"},           {"C4", "=SQRT(3)"},
                                                 {"D4", "rectangular"}, {"E4", "=(1000.1-1000-0.1)/C4"},
                                                 {"A6", "u_c"},         {"B6", "=SQRT(SUMSQ(E2:E4))"},
                                                 {"A7", "k"},           {"B7", "2"},
                                                 {"A8", "U"},           {"B8", "=B7*B6"}});
    const workbook::Evaluation evaluation = workbook::evaluate_workbook(made);
    for (const workbook::EvaluatedCell& cell : evaluation.cells) {
        made.sheets[cell.sheet].cells[cell.cell].value = cell.value;
    }
    return made;
}
workbook::Cell& cell_at(workbook::Workbook& made, const std::string& address) {
    return *std::find_if(made.sheets[0].cells.begin(), made.sheets[0].cells.end(),
                         [&](const workbook::Cell& cell) { return cell.address == *workbook::read_a1(address); });
}
std::vector<AuditFinding> stale_of(const AuditReport& report) {
    std::vector<AuditFinding> all = report.findings;
    std::erase_if(all, [](const AuditFinding& finding) { return finding.rule != "W17" && finding.rule != "K01"; });
    return all;
}

/// The law: every stored number of a cell under the result counts, within what computing may leave; what the file shows is
/// what it claims, and its correction leads to what its formulas give.
TEST(SubjectOfWorkbook, WhatTheFileShowsIsWhatItClaims) {
    const AuditReport sound = audit(subject_of(stored_budget(), "b.xlsx"), all_rules());
    ASSERT_EQ(sound.results.size(), 1U);
    EXPECT_TRUE(stale_of(sound).empty());
    const double U = sound.results[0].claimed.U;
    for (const char* const address : {"E2", "E3", "C3", "B6", "B8"}) {
        const bool is_result = address[0] == 'B';
        for (const double factor : {0.7, 1.0 + 1e-4, 1.4}) {
            workbook::Workbook stale = stored_budget();
            cell_at(stale, address).value.number *= factor;
            const AuditReport report = audit(subject_of(stale, "b.xlsx"), all_rules());
            const std::vector<AuditFinding> found = stale_of(report);
            ASSERT_EQ(found.size(), 1U) << address << " times " << factor;
            EXPECT_EQ(found[0].rule, "W17");
            EXPECT_EQ(found[0].effect.has_value(), is_result) << address;
            ASSERT_EQ(report.results.size(), 1U);
            EXPECT_NEAR(report.results[0].claimed.U, address == std::string("B8") ? factor * U : U, 1e-12);
            EXPECT_NEAR(report.results[0].audited.U, U, 1e-12);
        }
        for (const bool is_blank : {true, false}) {
            workbook::Workbook same = stored_budget();
            workbook::CellValue& value = cell_at(same, address).value;
            value.number *= 1.0 + 1e-9;
            value = is_blank ? workbook::CellValue{} : value;
            EXPECT_TRUE(stale_of(audit(subject_of(same, "b.xlsx"), all_rules())).empty()) << address;
        }
    }
    workbook::Workbook bits = stored_budget();
    cell_at(bits, "E4").value.number = 1e-17;
    EXPECT_TRUE(stale_of(audit(subject_of(bits, "b.xlsx"), all_rules())).empty());
    workbook::Workbook of_the_day = stored_budget();
    cell_at(of_the_day, "E3").formula = "B3/C3*(1+0*TODAY())";
    cell_at(of_the_day, "B8").value.number *= 1.1;
    EXPECT_TRUE(stale_of(audit(subject_of(of_the_day, "b.xlsx"), all_rules())).empty()) << "another day, another U";
}

}  // namespace
}  // namespace gumcert::audit
