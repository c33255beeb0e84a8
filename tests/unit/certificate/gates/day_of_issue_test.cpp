#include "certificate/gates/day_of_issue.h"

#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

TEST(DayOfIssue, BlocksACertificateThatIsDatedAhead) {
    Certificate c = passed_certificate();
    pass_gates(c);
    ASSERT_FALSE(c.blocked);
    ASSERT_TRUE(c.symbol);
    c.data.dates.issued = "2099-11-21";
    EXPECT_TRUE(block_issue_ahead_of_time(c, "2026-11-21"));
    EXPECT_TRUE(c.blocked);
    EXPECT_FALSE(c.symbol);
    expect_finding(c.findings.at(0), "P12", "ISO/IEC 17025:2017, 7.8.2.1 j", FindingSeverity::critical,
                   "/dates/issued");
}

TEST(DayOfIssue, LeavesTodayTheDayAfterAndThePast) {
    for (const char* today : {"2026-11-20", "2026-11-21", "2026-11-22", "2030-01-01", "", "today"}) {
        Certificate c = passed_certificate();
        EXPECT_FALSE(block_issue_ahead_of_time(c, today)) << today;  // issued on 2026-11-21
        EXPECT_FALSE(c.blocked);
        EXPECT_TRUE(c.findings.empty());
    }
    Certificate c = passed_certificate();
    EXPECT_TRUE(block_issue_ahead_of_time(c, "2026-11-19"));
    c = passed_certificate();
    c.data.status = "specimen";
    EXPECT_FALSE(block_issue_ahead_of_time(c, "2026-11-19"));
}

}  // namespace
}  // namespace gumcert::certificate
