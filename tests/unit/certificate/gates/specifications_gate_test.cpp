#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "tests/support/finding_severities.h"
#include "tests/unit/certificate/passed_certificate.h"

namespace gumcert::certificate {
namespace {

constexpr const char* k_before_the_work = "ISO/IEC 17025:2017, 7.1.3";
constexpr const char* k_rule = "ISO/IEC 17025:2017, 7.8.6.2 c";

std::vector<Finding> after(const std::function<void(AgreedSpecification&)>& change,
                           const std::string& status = "accredited") {
    Certificate c = passed_certificate();
    c.data.status = status;
    change(c.data.specifications[0]);
    return specification_findings(c);
}

TEST(SpecificationsGate, HasNothingToSayOfCompleteData) {
    EXPECT_THAT(ids(specification_findings(passed_certificate())), testing::IsEmpty());
}

TEST(SpecificationsGate, BlocksTheSymbolWhereTheRuleCameAfterTheWork) {
    const auto late = [](AgreedSpecification& s) { s.agreed_on = "2026-11-20"; };
    expect_finding(only(after(late)), "D02", k_before_the_work, k_critical, "/specifications/0/agreed_on");
    expect_finding(only(after(late, "not_accredited")), "D02", k_before_the_work, k_major,
                   "/specifications/0/agreed_on");
}

TEST(SpecificationsGate, WantsAPartner) {
    expect_finding(only(after([](AgreedSpecification& s) { s.agreed_by = "unknown"; })), "D02", k_before_the_work,
                   k_major, "/specifications/0/agreed_by");
    // What the page prints is not told as nothing.
    EXPECT_THAT(only(after([](AgreedSpecification& s) { s.agreed_by = "X"; })).what,
                testing::HasSubstr("\"X\" does not say with whom"));
    EXPECT_THAT(ids(after([](AgreedSpecification& s) { s.agreed_by = "Customer"; })), testing::IsEmpty());
    EXPECT_THAT(ids(after([](AgreedSpecification& s) {
                    s.agreed_by.clear();
                    s.rule.prescribed_by = "ISO 3650";
                })),
                testing::IsEmpty());
}

TEST(SpecificationsGate, TellsEachNameThatIsNoResult) {
    const Finding some = only(after([](AgreedSpecification& s) { s.results = {"l", "l[10 mm]", "m"}; }));
    expect_finding(some, "D07", "ISO/IEC 17025:2017, 7.8.6.2 a", k_major, "/specifications/0/results");
    EXPECT_THAT(some.what, testing::HasSubstr("names \"l[10 mm]\", \"m\", which no result of the certificate"));
    const Finding none = only(after([](AgreedSpecification& s) { s.results = {"m"}; }));
    EXPECT_THAT(none.what, testing::HasSubstr("names no result of the certificate, so that nothing is decided"));
}

TEST(SpecificationsGate, WantsTheAuthorOfARuleOfOthers) {
    expect_finding(only(after([](AgreedSpecification& s) { s.rule.id = "DR-12"; })), "D10", k_rule, k_critical,
                   "/specifications/0/rule/prescribed_by");
    EXPECT_THAT(ids(after([](AgreedSpecification& s) {
                    s.rule.id = "DR-12";
                    s.rule.prescribed_by = "ISO 10360-2";
                })),
                testing::IsEmpty());
    const auto agreed = [](AgreedSpecification& s) {
        s.rule.id = "DR-13";
        s.agreement.clear();
    };
    expect_finding(only(after(agreed)), "D10", k_rule, k_major, "/specifications/0/rule/text");
    EXPECT_THAT(ids(after([](AgreedSpecification& s) { s.rule.id = "DR-13"; })), testing::IsEmpty());
}

TEST(SpecificationsGate, WantsADocumentThatIsOne) {
    expect_finding(only(after([](AgreedSpecification& s) { s.document = "see above"; })), "D03",
                   "ISO/IEC 17025:2017, 7.8.6.2 b", k_major, "/specifications/0/document");
}

}  // namespace
}  // namespace gumcert::certificate
