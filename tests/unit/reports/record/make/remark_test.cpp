#include "reports/record/make/remark.h"

#include <gtest/gtest.h>

namespace gumcert::reports {
namespace {

using certificate::FindingSeverity;

std::vector<Remark> one_remark() {
    return {{.message = {.code = "GC-X-0001", .where = "here", .what = "this", .rule = "that", .action = "do it"},
             .id = "Z01",
             .clause = "clause 1",
             .severity = FindingSeverity::minor,
             .accredited = FindingSeverity::critical}};
}

TEST(Remark, IsAMessageAndAFinding) {
    ASSERT_EQ(messages_of(one_remark()).size(), 1U);
    EXPECT_EQ(messages_of(one_remark()).front().code, "GC-X-0001");
    const auto findings = findings_of(one_remark(), {});
    ASSERT_EQ(findings.size(), 1U);
    EXPECT_EQ(findings[0].id, "Z01");
    EXPECT_EQ(findings[0].clause, "clause 1");
    EXPECT_EQ(findings[0].where + findings[0].what + findings[0].action, "herethisdo it");
}

TEST(Remark, IsAsGraveAsTheCertificateMakesIt) {
    reports::EvaluationRecord record;
    EXPECT_EQ(findings_of(one_remark(), record).at(0).severity, FindingSeverity::minor);
    record.certificate.emplace();
    record.certificate->data.status = "not_accredited";
    EXPECT_EQ(findings_of(one_remark(), record).at(0).severity, FindingSeverity::minor);
    record.certificate->data.status = "accredited";
    EXPECT_EQ(findings_of(one_remark(), record).at(0).severity, FindingSeverity::critical);
}

}  // namespace
}  // namespace gumcert::reports
