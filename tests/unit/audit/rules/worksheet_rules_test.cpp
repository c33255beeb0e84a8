// For rules of worksheets that look at rows: tables that fire, and what must not.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/audit_rules.h"
#include "tests/support/audited_budgets.h"

namespace gumcert::audit {
namespace {

using test::findings_of;

/// A row that prints s = 1.10, a root as divisor, and "normal".
AuditedRow normal_row(double divisor) {
    AuditedRow one = test::row("row", 1.10 / divisor);
    one.stated = test::printed("1.10");
    one.divisor = exact_number(divisor, "");
    one.shape = Shape::normal;
    one.shape_text = "normal";
    return one;
}

TEST(WorksheetRules, W02LeavesTheRootOfReadingsAlone) {
    // The law: for every n, each of the ways in which a row says that its divisor is √n.
    for (std::size_t n = 2; n <= 24; ++n) {
        const double root = std::sqrt(static_cast<double>(n));
        AuditedRow type_a = normal_row(root), words = type_a, mean = type_a, nu = type_a;
        type_a.type_a = true;
        words.n = n;
        mean.averaged = n;
        nu.used_nu = static_cast<double>(n) - 1.0;
        for (const AuditedRow& row : {type_a, words, mean, nu}) {
            EXPECT_TRUE(findings_of("W02", test::subject_of(row)).empty()) << n;
        }
        const bool is_other = n == 3 || n == 6;
        EXPECT_EQ(findings_of("W02", test::subject_of(normal_row(root))).size(), is_other ? 1U : 0U) << n;
        AuditedRow other_n = normal_row(root);
        other_n.n = n + 1;
        EXPECT_EQ(findings_of("W02", test::subject_of(other_n)).size(), is_other ? 1U : 0U) << n;
    }
}

TEST(WorksheetRules, W02CorrectsOnlyAUThatItsDivisorGave) {
    AuditedRow row = normal_row(std::sqrt(6.0));
    row.shape = Shape::rectangular;
    std::vector<AuditFinding> findings = findings_of("W02", test::subject_of(row));
    ASSERT_EQ(findings.size(), 1U);
    ASSERT_TRUE(findings[0].effect);
    const double right = std::hypot(1.10 / std::sqrt(3.0), 0.01);
    EXPECT_NEAR(findings[0].effect->alone.u_c, right, 1e-12);
    row.used_u = 1.10 / std::sqrt(3.0);
    row.u = exact_number(row.used_u, "");
    findings = findings_of("W02", test::subject_of(row));
    ASSERT_EQ(findings.size(), 1U) << "the divisor that is printed is not that of its distribution";
    EXPECT_FALSE(findings[0].effect) << "u was divided by the right one";
    EXPECT_EQ(findings[0].severity, FindingSeverity::minor);
    row.used_u = 0.1;
    row.u = exact_number(row.used_u, "");
    findings = findings_of("W02", test::subject_of(row));
    ASSERT_EQ(findings.size(), 1U);
    ASSERT_TRUE(findings[0].effect);
    EXPECT_NEAR(findings[0].effect->alone.u_c, right, 1e-12);
}

}  // namespace
}  // namespace gumcert::audit
