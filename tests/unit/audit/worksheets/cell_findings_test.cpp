#include "audit/worksheets/cell_findings.h"

#include <gtest/gtest.h>

#include "audit/rules/registry.h"

namespace gumcert::audit {
namespace {

TEST(CellFindings, SayWhereAndWhat) {
    const AuditFinding finding = finding_in("Budget!D5", say("nothing"));
    EXPECT_EQ(finding.where, "Budget!D5");
    EXPECT_EQ(finding.what.english(), "nothing");
    EXPECT_EQ(place_of(std::nullopt), "");
    EXPECT_EQ(place_of(exact_number(2.0, "Budget!D5")), "Budget!D5");
}

TEST(CellFindings, LookForWordsInCapitalsToo) {
    EXPECT_TRUE(says("Drift per YEAR", {"month", "year"}));
    EXPECT_FALSE(says("Drift", {"month", "year"}));
}

TEST(WorksheetRules, StandInTheOrderOfTheirIdsEachOnce) {
    std::string last;
    for (const Rule& rule : all_rules()) {
        if (rule.id.starts_with("W")) {
            EXPECT_LT(last, rule.id);
            last = rule.id;
        }
    }
    EXPECT_EQ(last, "W17");
}

}  // namespace
}  // namespace gumcert::audit
