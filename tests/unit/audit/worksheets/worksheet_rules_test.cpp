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

/// U used as u is seen where the distribution states its k: "normal (k = 3)" beside the divisor 2. Beside 1 it is asked, for u may
/// have been stated, and k be that of the certificate behind it.
TEST(WorksheetRules, W02SeesTheKOfADistribution) {
    const auto row_of = [](double k, double divisor) {
        AuditedRow row = normal_row(divisor);
        row.shape_text = "normal (k = " + std::to_string(k) + ")";
        row.distribution_k = k;
        row.u = exact_number(row.used_u, "");
        return row;
    };
    for (const double k : {2.0, 2.13, 2.58, 3.0}) {
        for (const double divisor : {1.0, 1.65, 1.96, 2.0, 2.13, 2.2, 2.58, 3.0}) {
            const std::vector<AuditFinding> findings = findings_of("W02", test::subject_of(row_of(k, divisor)));
            const bool is_one = std::abs(k - divisor) > 0.03 * divisor;
            ASSERT_EQ(findings.size(), is_one ? 1U : 0U) << k << ", " << divisor;
            if (is_one && divisor == 1.0) {
                EXPECT_EQ(findings[0].severity, FindingSeverity::minor) << k;
                EXPECT_FALSE(findings[0].effect) << k;
            } else if (is_one) {
                ASSERT_TRUE(findings[0].effect) << k << ", " << divisor;
                EXPECT_NEAR(findings[0].effect->alone.u_c, std::hypot(1.10 / k, 0.01), 1e-12) << k << ", " << divisor;
            }
        }
        EXPECT_TRUE(findings_of("W02", test::subject_of(row_of(1.0, k))).empty())
            << "k = 1 is said of what was divided";
        AuditedRow readings = row_of(k, std::sqrt(10.0));
        readings.type_a = true;
        EXPECT_TRUE(findings_of("W02", test::subject_of(readings)).empty());
        AuditedRow words = row_of(k, 1.0);  // U13 looks at U and k of the certificate
        words.origin = Origin::certificate;
        words.origin_value = 1.10;
        words.certificate_k = k;
        EXPECT_TRUE(findings_of("W02", test::subject_of(words)).empty());
        // Beside 2 k it is asked where the words may speak of the whole width; else U was divided twice.
        for (const char* const of_width : {"span of the level", "full width of U", "Gesamtbreite"}) {
            AuditedRow width = row_of(k, 2.0 * k);
            width.quantity = of_width;
            const std::vector<AuditFinding> findings = findings_of("W02", test::subject_of(width));
            ASSERT_EQ(findings.size(), 1U) << of_width;
            EXPECT_FALSE(findings[0].effect) << of_width;
        }
        EXPECT_TRUE(findings_of("W02", test::subject_of(row_of(k, 2.0 * k))).at(0).effect);
        for (const char* const of_half : {"Spannung des Normals", "zweites Multimeter", "erweiterte Messunsicherheit",
                                          "range 10 V", "certificate \u00B1 1.10 V"}) {
            AuditedRow half = row_of(k, 2.0 * k);
            half.quantity = of_half;
            EXPECT_TRUE(findings_of("W02", test::subject_of(half)).at(0).effect) << of_half;
        }
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
