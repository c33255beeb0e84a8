// Law: what the rules of worksheets take grows as the workbook, whatever its formulas read.
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "audit/audit.h"
#include "audit/audited_workbook.h"
#include "audit/worksheets/worksheet_rules.h"
#include "tests/support/growth.h"
#include "tests/support/workbook_of.h"

namespace gumcert::audit {
namespace {

struct GrowingSheet {
    const char* name;
    std::size_t n;
    void (*add_row)(test::Contents& contents, const std::string& row, std::size_t n);
};

const GrowingSheet k_growing_sheets[] = {
    {"running sums", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, "0.5");
         contents.emplace_back("B" + row, "=SUM(A$2:A" + row + ")");
     }},
    {"running means with texts", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, row.ends_with("7") ? "6.3.7" : "0.5");
         contents.emplace_back("B" + row, "=AVERAGE(A$2:A" + row + ")");
     }},
    {"running maxima", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, "0.5");
         contents.emplace_back("B" + row, "=MAX(A$2:A" + row + ")");
     }},
    {"maxima of one number", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, row == "2" ? "0.5" : "TRUE");
         contents.emplace_back("B" + row, "=MAX(A$2:A" + row + ")");
     }},
    {"the whole column each", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t n) {
         contents.emplace_back("A" + row, "0.5");
         contents.emplace_back("B" + row, "=STDEV(A$2:A$" + std::to_string(n) + ")");
     }},
    {"corrections that nobody uses", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, "correction");
         contents.emplace_back("B" + row, "=1+1");
     }},
    {"one reading copied", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, row);
         contents.emplace_back("B" + row, "=A2");
     }},
    {"heads of standards", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, "correction");
         contents.emplace_back("B" + row, "U");
     }},
    {"standards that were never filled in", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, row == "2" ? "correction" : "0");
         contents.emplace_back("B" + row, row == "2" ? "U" : "0");
     }},
    {"errors", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) { contents.emplace_back("A" + row, "#REF!"); }},
    {"other workbooks", 1000,
     [](test::Contents& contents, const std::string& row, std::size_t) {
         contents.emplace_back("A" + row, "=[1]S!A" + row);
     }},
};

TEST(Growth, LookingAtAWorkbookIsLinear) {
    const std::vector<Rule> rules = worksheet_rules();
    for (const GrowingSheet& sheet : k_growing_sheets) {
        const auto make = [&sheet](std::size_t n) {
            test::Contents contents;
            for (std::size_t i = 2; i <= n; ++i) {
                sheet.add_row(contents, std::to_string(i), n);
            }
            AuditSubject subject;
            subject.kind = AuditSubject::Kind::workbook;
            subject.workbook = std::make_shared<const AuditedWorkbook>(test::workbook_of(contents));
            return subject;
        };
        const auto look = [&rules](const AuditSubject& subject) { (void)audit(subject, rules); };
        EXPECT_LT(test::growth_of(sheet.n, make, look, test::k_linear), test::k_linear) << sheet.name;
    }
}

/// The same of a budget whose rows read all rows above them.
TEST(Growth, LookingAtRowsOfRunningSumsIsLinear) {
    const std::vector<Rule> rules = worksheet_rules();
    const auto make = [](std::size_t n) {
        test::Contents contents;
        AuditedBudget budget;
        for (std::size_t i = 2; i <= n; ++i) {
            const std::string row = std::to_string(i);
            contents.emplace_back("A" + row, "0.5");
            contents.emplace_back("B" + row, "=SUM(A" + row + ":A" + std::to_string(n) + ")");
            AuditedRow& read = budget.rows.emplace_back();
            read.quantity = "x" + row;
            read.used_u = 1.0;
            read.u = exact_number(1.0, "Sheet1!B" + row);
        }
        AuditSubject subject;
        subject.kind = AuditSubject::Kind::workbook;
        subject.budgets.push_back(budget);
        subject.workbook = std::make_shared<const AuditedWorkbook>(test::workbook_of(contents));
        return subject;
    };
    const auto look = [&rules](const AuditSubject& subject) {
        for (const Rule& rule : rules) {
            FindingCollector findings(rule);
            rule.examine(subject, findings);
        }
    };
    EXPECT_LT(test::growth_of(500, make, look, test::k_linear), test::k_linear);
}

}  // namespace
}  // namespace gumcert::audit
