#include "certificate/gates/gates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

TEST(Gates, GiveTheSymbolToAPassedCertificateOnly) {
    Certificate c = passed_certificate();
    pass_gates(c);
    EXPECT_THAT(c.findings, testing::IsEmpty());
    EXPECT_FALSE(c.blocked);
    EXPECT_TRUE(c.symbol);

    c.data.status = "not_accredited";
    pass_gates(c);
    EXPECT_FALSE(c.blocked);
    EXPECT_FALSE(c.symbol);
}

TEST(Gates, AreClosedByWhatIsFoundLater) {
    Certificate c = passed_certificate();
    pass_gates(c);
    add_findings(c, {});
    EXPECT_TRUE(c.symbol);
    add_findings(
        c,
        {{.id = "audit-K02", .clause = {}, .severity = FindingSeverity::major, .where = {}, .what = {}, .action = {}}});
    EXPECT_FALSE(c.blocked);
    EXPECT_TRUE(c.symbol);
    add_findings(c, {{.id = "audit-U13",
                      .clause = {},
                      .severity = FindingSeverity::critical,
                      .where = {},
                      .what = {},
                      .action = {}}});
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    ASSERT_EQ(c.findings.size(), 2U);
    EXPECT_EQ(c.findings.front().id, "audit-U13") << "the gravest first";
    c.data.status = "specimen";
    add_findings(c, {});
    EXPECT_FALSE(c.blocked);
}

TEST(Gates, BlockByOneCriticalFinding) {
    Certificate c = passed_certificate();
    c.data.method.no_deviations = false;  // major
    pass_gates(c);
    EXPECT_FALSE(c.blocked);
    EXPECT_TRUE(c.symbol);
    c.data.customer.name = {};  // critical
    pass_gates(c);
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    EXPECT_THAT(ids(c.findings), testing::ElementsAre("R07-e", "R07-n"));
    c.data.status = "not_accredited";
    pass_gates(c);
    EXPECT_TRUE(c.blocked);
}

TEST(Gates, NeverBlockASpecimen) {
    Certificate c = passed_certificate();
    c.data.status = "specimen";
    c.data.customer.name = {};
    pass_gates(c);
    EXPECT_FALSE(c.blocked);
    EXPECT_FALSE(c.symbol);
    EXPECT_THAT(ids(c.findings), testing::ElementsAre("R07-e"));
}

TEST(Gates, TakeFindingsOfTheAuditToTheirs) {
    Certificate c = passed_certificate();
    c.data.method.no_deviations = false;
    pass_gates(
        c,
        {{.id = "S05", .clause = {}, .severity = FindingSeverity::information, .where = {}, .what = {}, .action = {}},
         {.id = "U13", .clause = {}, .severity = k_critical, .where = {}, .what = {}, .action = {}}});
    EXPECT_THAT(ids(c.findings), testing::ElementsAre("U13", "R07-n", "S05"));
    EXPECT_TRUE(c.blocked);
}

}  // namespace
}  // namespace gumcert::certificate
