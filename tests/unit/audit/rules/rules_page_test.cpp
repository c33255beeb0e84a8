#include "audit/rules/rules_page.h"

#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/file_content.h"

namespace gumcert::audit {
namespace {

TEST(RulesPage, is_the_one_in_the_tree) {
    EXPECT_EQ(rules_page(all_rules(), rules_left_out()),
              test::file_content(std::string(GUMCERT_SOURCE_DIR) + "/docs/audit_rules.md"))
        << "build and run write_audit_rules";
}

TEST(RulesPage, has_every_rule) {
    for (const Rule& rule : all_rules()) {
        EXPECT_NE(rules_page(std::span(&rule, 1), {}).find("| " + std::string(rule.id) + " |"), std::string::npos)
            << "no family for " << rule.id;
    }
}

TEST(RulesPage, says_what_is_not_verified_and_what_is_left_out) {
    const std::vector<Rule> rules{{.id = "X99",
                                   .title = "a|b",
                                   .clause = {.text = "a clause", .verified = false},
                                   .policy = SeverityPolicy::fixed,
                                   .severity = FindingSeverity::minor}};
    const std::vector<RuleLeftOut> left_out{{"X98", "something", "no data"}};
    const std::string page = rules_page(rules, left_out);
    EXPECT_THAT(page, testing::HasSubstr("## Capability and scope"));
    EXPECT_THAT(page, testing::HasSubstr("| X99 | a\\|b | a clause (clause to be verified) | fixed: minor |"));
    EXPECT_THAT(page, testing::HasSubstr("| X98 | something | no data |"));
    EXPECT_THAT(page, testing::Not(testing::HasSubstr("## Conformity")));
}

}  // namespace
}  // namespace gumcert::audit
