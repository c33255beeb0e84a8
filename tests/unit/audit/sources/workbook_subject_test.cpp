#include "audit/sources/workbook_subject.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>
#include <string>

#include "audit/audit.h"
#include "audit/rules/registry.h"
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

}  // namespace
}  // namespace gumcert::audit
